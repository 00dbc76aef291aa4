//! The words of an NFF file, each with its line.

use std::iter::Peekable;

use rayline::{LinearRgb, Vec3};

use super::{NffError, NffFault};

/// The words of a file from front to back, without comments.
pub(super) struct Tokens<'t> {
    words: Peekable<Words<'t>>,
    /// The line of the last word.
    line: usize,
    last_line: usize,
}

type Words<'t> = Box<dyn Iterator<Item = (usize, &'t str)> + 't>;

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        let words: Words<'t> = Box::new(text.lines().zip(1..).flat_map(|(line, number)| {
            let statement = line.split('#').next().unwrap_or_default();
            statement.split_whitespace().map(move |word| (number, word))
        }));
        Self { words: words.peekable(), line: 1, last_line: text.lines().count().max(1) }
    }

    /// The line of the last word.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The last line of the file.
    pub(super) fn last_line(&self) -> usize {
        self.last_line
    }

    pub(super) fn next(&mut self) -> Option<&'t str> {
        let (line, word) = self.words.next()?;
        self.line = line;
        Some(word)
    }

    /// Whether the next word is a number, and so an optional part of a statement follows.
    pub(super) fn number_follows(&mut self) -> bool {
        self.words.peek().is_some_and(|(_, word)| word.parse::<f32>().is_ok())
    }

    /// The next word, or an error at the end of the file.
    fn word(&mut self, expected: &'static str) -> Result<&'t str, NffError> {
        let last_line = self.last_line;
        self.next().ok_or(NffError { line: last_line, fault: NffFault::EndOfFile { expected } })
    }

    /// Reads the next word, which must be `expected` without its back quotes.
    pub(super) fn keyword(&mut self, expected: &'static str) -> Result<(), NffError> {
        let found = self.word(expected)?;
        if found == expected.trim_matches('`') { Ok(()) } else { Err(self.unexpected(expected, found)) }
    }

    pub(super) fn number(&mut self, meaning: &'static str) -> Result<f32, NffError> {
        let found = self.word(meaning)?;
        match found.parse::<f32>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(self.error(NffFault::NotFinite { meaning, found: found.to_owned() })),
            Err(_) => Err(self.unexpected(meaning, found)),
        }
    }

    /// A whole number of at least `least` and at most `most`.
    pub(super) fn count(&mut self, expected: &'static str, least: u32, most: u32) -> Result<u32, NffError> {
        let found = self.word(expected)?;
        match found.parse::<u32>() {
            Ok(count) if (least..=most).contains(&count) => Ok(count),
            _ => Err(self.unexpected(expected, found)),
        }
    }

    pub(super) fn vector(&mut self, meaning: &'static str) -> Result<Vec3, NffError> {
        Ok(Vec3::new(self.number(meaning)?, self.number(meaning)?, self.number(meaning)?))
    }

    /// A direction; zero if one of its numbers is not finite.
    pub(super) fn direction(&mut self, meaning: &'static str) -> Result<Vec3, NffError> {
        let mut numbers = [0.0; 3];
        for number in &mut numbers {
            let found = self.word(meaning)?;
            *number = found.parse::<f32>().map_err(|_| self.unexpected(meaning, found))?;
        }
        let [x, y, z] = numbers;
        Ok(if numbers.iter().all(|number| number.is_finite()) { Vec3::new(x, y, z) } else { Vec3::ZERO })
    }

    pub(super) fn color(&mut self, meaning: &'static str) -> Result<LinearRgb, NffError> {
        Ok(LinearRgb::new(self.number(meaning)?, self.number(meaning)?, self.number(meaning)?))
    }

    /// An error in the line of the last word.
    pub(super) fn error(&self, fault: NffFault) -> NffError {
        NffError { line: self.line, fault }
    }

    fn unexpected(&self, expected: &'static str, found: &str) -> NffError {
        self.error(NffFault::Expected { expected, found: found.to_owned() })
    }
}
