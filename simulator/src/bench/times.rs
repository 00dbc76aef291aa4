//! Times of repeated work.

/// The times of repeated work in seconds, sorted.
#[derive(Clone, Debug, Default)]
pub(super) struct Times(Vec<f64>);

impl Times {
    pub(super) fn push(&mut self, seconds: f64) {
        let place = self.0.partition_point(|other| *other < seconds);
        self.0.insert(place, seconds);
    }

    /// The shortest time, which was disturbed least.
    pub(super) fn best(&self) -> f64 {
        self.0.first().copied().unwrap_or(f64::NAN)
    }

    /// The median; the lower of the two in the middle.
    pub(super) fn median(&self) -> f64 {
        self.0.get(self.0.len().saturating_sub(1) / 2).copied().unwrap_or(f64::NAN)
    }
}

/// Seconds as text in milliseconds, with one digit after the point.
pub(super) fn milliseconds(seconds: f64) -> String {
    format!("{:.1}", seconds * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn best_and_median() {
        let mut times = Times::default();
        for seconds in [0.4, 0.1, 0.3, 0.2] {
            times.push(seconds);
        }
        assert_eq!((times.best(), times.median()), (0.1, 0.2));
        times.push(9.0);
        assert_eq!(times.median(), 0.3);
        assert_eq!(milliseconds(times.best()), "100.0");
    }
}
