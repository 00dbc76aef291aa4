//! A driver crate in the table.

use crate::trial::Trial;

/// A driver crate and what is tested with it.
pub struct Entry {
    /// The name of the crate.
    pub name: &'static str,
    /// Lines that a user writes to draw a picture, beyond those that set the driver up.
    pub glue: usize,
    /// A warning for users; empty if there is none.
    pub note: &'static str,
    /// Its panels, in all orientations.
    pub trials: Vec<Trial>,
}

impl Entry {
    /// Checks all panels.
    pub fn check(&self) {
        assert!(!self.trials.is_empty());
        for trial in &self.trials {
            trial.check();
        }
    }
}
