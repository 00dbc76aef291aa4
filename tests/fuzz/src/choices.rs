//! Choices that a search makes: read from a byte string, or drawn from a seed.

use rayline::Vec3;

/// A source of choices.
///
/// From bytes, each choice takes as few bytes as it needs, so that a fuzzer that changes one byte changes
/// one choice; after the last byte every choice is its first possibility. From a seed, choices never end.
#[derive(Clone, Debug)]
pub struct Choices<'b> {
    bytes: &'b [u8],
    /// State of the generator; `None`: choices come from bytes alone.
    state: Option<u64>,
    /// The shortest and the longest length.
    lengths: (f32, f32),
}

/// The lengths that a scene may name.
const ANY_LENGTH: (f32, f32) = (1e-6, 1e6);

impl<'b> Choices<'b> {
    /// Choices that a byte string holds.
    pub fn from_bytes(bytes: &'b [u8]) -> Self {
        Self { bytes, state: None, lengths: ANY_LENGTH }
    }

    /// Choices by the generator SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number
    /// Generators", OOPSLA 2014).
    pub fn from_seed(seed: u64) -> Self {
        Self { bytes: &[], state: Some(seed), lengths: ANY_LENGTH }
    }

    /// A number of so many bytes, 1 to 8.
    fn take(&mut self, bytes: usize) -> u64 {
        if let Some(state) = &mut self.state {
            *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = *state;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            return z ^ (z >> 31);
        }
        let (taken, rest) = self.bytes.split_at(bytes.min(self.bytes.len()));
        self.bytes = rest;
        taken.iter().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
    }

    /// Any number.
    pub fn word(&mut self) -> u64 {
        self.take(8)
    }

    /// A number below `count`; 0 where `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        let bytes = if count <= 256 { 1 } else { 4 };
        (self.take(bytes) % (count as u64).max(1)) as usize
    }

    /// A number from `least` to `most`.
    pub fn between(&mut self, least: usize, most: usize) -> usize {
        least + self.below((most + 1).saturating_sub(least))
    }

    /// True in so many of 100 cases.
    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) + percent >= 100
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> Option<T> {
        of.get(self.below(of.len())).copied()
    }

    /// One of these; they are never none.
    pub fn one_of<T: Copy, const N: usize>(&mut self, of: [T; N]) -> T {
        const { assert!(N > 0) }
        let mut left = self.below(N);
        let mut chosen = of[0];
        for value in of {
            chosen = value;
            if left == 0 {
                break;
            }
            left -= 1;
        }
        chosen
    }

    /// A number from 0 to less than 1.
    pub fn share(&mut self) -> f32 {
        (self.take(2) & 0xFFFF) as f32 / 65_536.0
    }

    /// A number from `least` to less than `most`.
    pub fn within(&mut self, least: f32, most: f32) -> f32 {
        least + (most - least) * self.share()
    }

    /// Chooses between which bounds [lengths](Self::length) are: fixed point refuses what is tiny against
    /// the rest of a scene.
    pub fn choose_lengths(&mut self) {
        self.lengths = match self.below(10) {
            0..=2 => ANY_LENGTH,
            3..=6 => (0.05, 20.0),
            7 => (0.5, 400.0),
            8 => (200.0, 65_535.0),
            _ => (1e-3, 1.0),
        };
    }

    /// A length: mostly near 1, sometimes as extreme as scenes may have.
    pub fn length(&mut self) -> f32 {
        let (least, most) = self.lengths;
        let length = match self.below(16) {
            0..=4 => self.one_of([1.0, 0.5, 2.0, 0.25, 3.0, 1.5, 0.1]),
            5..=10 => self.within(0.05, 3.0),
            11..=12 => self.one_of([65_535.0, 1e5, 1e4, 999_999.0, 500_000.0, 1000.0, 100.0]),
            13 => self.one_of([1e-3, 1e-4, 1e-2, 1e-6]),
            _ => {
                let exponent = self.within(-4.0, 5.7);
                10f32.powf(exponent)
            }
        };
        length.clamp(least, most)
    }

    /// A coordinate: often a small whole number, so that surfaces touch and lie in one plane.
    pub fn coordinate(&mut self) -> f32 {
        match self.below(16) {
            0..=6 => self.between(0, 8) as f32 - 4.0,
            7..=9 => (self.between(0, 16) as f32 - 8.0) * 0.5,
            10..=13 => self.within(-4.0, 4.0),
            14 => self.within(-30.0, 30.0),
            _ => {
                let length = self.length();
                if self.chance(50) { -length } else { length }
            }
        }
    }

    /// A point of such coordinates.
    pub fn point(&mut self) -> Vec3 {
        let [x, y, z] = [(); 3].map(|()| self.coordinate());
        Vec3::new(x, y, z)
    }

    /// A direction of length 1, often along an axis.
    pub fn direction(&mut self) -> Vec3 {
        let (x, y, z) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
        if self.chance(45) {
            return self.one_of([y, x, z, -x, -y, -z]);
        }
        let [a, b, c] = [(); 3].map(|()| self.within(-1.0, 1.0));
        Vec3::new(a, b, c).normalized().unwrap_or(y)
    }

    /// Another direction, square to this one.
    pub fn across(&mut self, direction: Vec3) -> Vec3 {
        let aside = self.direction();
        let across = direction.cross(aside).normalized();
        across.or_else(|| direction.cross(Vec3::new(0.36, 0.48, 0.8)).normalized()).unwrap_or(aside)
    }
}
