//! Changes at random: to bytes, and to text.

use crate::choices::Choices;

/// The longest input that changes make of a shorter one.
const LONGEST: usize = 1 << 17;

/// Numbers that scenes are sensitive to.
const NUMBERS: [f32; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    1e-3,
    1e-6,
    1e-20,
    1e-40,
    65_535.0,
    1e5,
    -1e5,
    1e6,
    -1e6,
    1e38,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    1e7,
];

/// Changes bytes in one to four places. `others` are parts of what is put in.
pub(crate) fn bytes(choices: &mut Choices<'_>, bytes: &mut Vec<u8>, others: &[Vec<u8>]) {
    for _ in 0..choices.one_of([1, 1, 2, 1, 3, 4]) {
        let at = choices.below(bytes.len() + 1);
        let end = (at + choices.one_of([1, 4, 12, 2, 40, 200])).min(bytes.len());
        match choices.below(10) {
            // A number, as postcard writes it: four bytes anywhere.
            0..=3 => {
                if let Some(place) = bytes.get_mut(at..).and_then(|rest| rest.first_chunk_mut::<4>()) {
                    let number = f32::from_le_bytes(*place);
                    let number = match choices.below(4) {
                        0 => number * choices.one_of([-1.0, 0.5, 2.0, 10.0, 1e3, 1e-3]),
                        1 => number + choices.one_of([1.0, -1.0, 1e-3, 100.0]),
                        2 => choices.one_of(NUMBERS),
                        _ => choices.coordinate(),
                    };
                    *place = number.to_le_bytes();
                }
            }
            4 => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << choices.below(8);
                }
            }
            5 => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte = choices.below(256) as u8;
                }
            }
            6 => drop(bytes.drain(at..end)),
            7 => {
                let copy: Vec<u8> = bytes.get(at..end).unwrap_or_default().to_vec();
                let to = choices.below(bytes.len() + 1);
                drop(bytes.splice(to..to, copy));
            }
            8 => {
                let copy: Vec<u8> = bytes.get(at..end).unwrap_or_default().to_vec();
                let to = choices.below(bytes.len() + 1);
                let over = (to + copy.len()).min(bytes.len());
                drop(bytes.splice(to..over, copy));
            }
            _ => splice(choices, bytes, others),
        }
    }
    bytes.truncate(LONGEST);
}

/// Puts a part of another input in place of a part of this one.
fn splice(choices: &mut Choices<'_>, bytes: &mut Vec<u8>, others: &[Vec<u8>]) {
    let Some(other) = others.get(choices.below(others.len())) else { return };
    let from = choices.below(other.len() + 1);
    let length = choices.one_of([4, 16, 60, 300]);
    let part = other.get(from..(from + length).min(other.len())).unwrap_or_default();
    let to = choices.below(bytes.len() + 1);
    let over = (to + choices.one_of([0, 4, 16, 60, 300])).min(bytes.len());
    drop(bytes.splice(to..over, part.iter().copied()));
}

/// Words that importers are sensitive to, besides numbers.
#[cfg(feature = "importers")]
const WORDS: [&str; 24] = [
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "1",
    "2",
    "1e39",
    "1e-46",
    "65535",
    "65536",
    "4294967295",
    "4294967296",
    "18446744073709551616",
    "-0",
    "\"\"",
    "..",
    "true",
    "null",
    "{}",
    "[]",
    "()",
    "\u{e4}",
    "\0",
];

/// Changes text in one to four places. `others` are texts of the same format.
#[cfg(feature = "importers")]
pub(crate) fn text(choices: &mut Choices<'_>, text: &mut Vec<u8>, others: &[Vec<u8>]) {
    for _ in 0..choices.one_of([1, 1, 2, 1, 3, 4]) {
        match choices.below(16) {
            // Most texts are read on only if they keep their grammar.
            0..=9 => {
                let number = number_from(text, choices.below(text.len() + 1));
                let word = match choices.below(8) {
                    0 => choices.one_of(WORDS).to_owned(),
                    1..=2 => choices.one_of(NUMBERS).to_string(),
                    _ => choices.coordinate().to_string(),
                };
                drop(text.splice(number, word.bytes()));
            }
            10 => {
                let line = line_at(text, choices.below(text.len() + 1));
                drop(text.drain(line));
            }
            11 => {
                let line = line_at(text, choices.below(text.len() + 1));
                let copy: Vec<u8> = text.get(line).unwrap_or_default().to_vec();
                let to = line_at(text, choices.below(text.len() + 1)).start;
                drop(text.splice(to..to, copy));
            }
            12 => {
                let at = choices.below(text.len() + 1);
                let open = choices.one_of(["[", "(", "{\"a\":", "[[", "\"", "\\"]);
                drop(text.splice(at..at, open.repeat(choices.one_of([1, 2, 200, 5000])).into_bytes()));
            }
            13 => splice(choices, text, others),
            _ => bytes(choices, text, others),
        }
    }
    text.truncate(LONGEST);
}

/// The first number at or after this place.
#[cfg(feature = "importers")]
fn number_from(text: &[u8], at: usize) -> core::ops::Range<usize> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e');
    let rest = text.get(at..).unwrap_or_default();
    let start = at + rest.iter().position(u8::is_ascii_digit).unwrap_or(0);
    let length = text.get(start..).unwrap_or_default().iter().take_while(|byte| is_part(byte)).count();
    start..start + length
}

/// The line around this place, with the line feed that ends it.
#[cfg(feature = "importers")]
fn line_at(text: &[u8], at: usize) -> core::ops::Range<usize> {
    let (before, after) = text.split_at(at.min(text.len()));
    let start = before.iter().rposition(|byte| *byte == b'\n').map_or(0, |place| place + 1);
    let end =
        after.iter().position(|byte| *byte == b'\n').map_or(text.len(), |place| before.len() + place + 1);
    start..end
}
