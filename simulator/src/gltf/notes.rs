//! What is said of a file: once for all parts of which it is true.

/// What was added to a file's scene and what was left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes(Vec<Note>);

#[derive(Clone, Debug)]
struct Note {
    what: String,
    /// The first part of which it is true, and how many follow it.
    first: String,
    more: usize,
}

impl Notes {
    /// Says this of a part of the file; the same is said once for many.
    pub(super) fn add(&mut self, part: impl Into<String>, what: impl Into<String>) {
        let (part, what) = (part.into(), what.into());
        match self.0.iter_mut().find(|note| note.what == what) {
            Some(note) if note.first == part => {}
            Some(note) => note.more = note.more.saturating_add(1),
            None => self.0.push(Note { what, first: part, more: 0 }),
        }
    }

    /// A line for each.
    pub(super) fn lines(self) -> Vec<String> {
        let line = |Note { what, first, more }| match more {
            0 => format!("{first}: {what}"),
            more => format!("{first}, and {more} more: {what}"),
        };
        self.0.into_iter().map(line).collect()
    }
}
