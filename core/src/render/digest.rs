//! A checksum of a picture's bytes, to compare boards.

/// One number for a whole picture, the same on every processor: a board that reports it shows that it drew
/// the right bytes. The hash is FNV-1a with 64 bits (Fowler, Noll and Vo 1991).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Digest {
    /// The digest of nothing.
    pub const fn new() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }

    /// Takes in the next bytes.
    pub fn update(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    /// The digest of all bytes so far.
    pub const fn value(&self) -> u64 {
        self.0
    }
}

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // From the authors' own test suite.
        for (bytes, value) in
            [("", 0xcbf29ce484222325), ("a", 0xaf63dc4c8601ec8c), ("foobar", 0x85944171f73967e8)]
        {
            let mut digest = Digest::new();
            digest.update(bytes.as_bytes());
            assert_eq!(digest.value(), value);
        }
    }
}
