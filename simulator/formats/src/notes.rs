//! Notes about a file; equal notes about several parts are merged into one.

/// Notes about everything that was added to the contents of a file, or left out.
#[derive(Clone, Debug, Default)]
pub struct Notes(Vec<Note>);

#[derive(Clone, Debug)]
struct Note {
    what: String,
    /// The first part that the note is about, and the number of further ones in `more`.
    first: String,
    more: usize,
}

impl Notes {
    /// Adds a note about a part of the file, or counts the part if there is such a note.
    pub fn add(&mut self, part: impl Into<String>, what: impl Into<String>) {
        let (part, what) = (part.into(), what.into());
        match self.0.iter_mut().find(|note| note.what == what) {
            Some(note) if note.first == part => {}
            Some(note) => note.more = note.more.saturating_add(1),
            None => self.0.push(Note { what, first: part, more: 0 }),
        }
    }

    /// Adds all notes of another list.
    pub(crate) fn append(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    /// The notes as lines of text.
    pub fn lines(self) -> Vec<String> {
        let line = |Note { what, first, more }| match more {
            0 => format!("{first}: {what}"),
            more => format!("{first}, and {more} more: {what}"),
        };
        self.0.into_iter().map(line).collect()
    }
}
