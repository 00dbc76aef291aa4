//! Rays for a frame, shared out among its bands of lines.

/// How closely a band is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Wherever neighbors differ.
    Full,
    /// Only where their colors differ much.
    Coarse,
    /// Nowhere but at the points of the grid.
    Grid,
}

/// The rays that a frame may still spend.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    left: u32,
    /// What the current band may spend, and what it has spent.
    limit: u32,
    spent: u32,
    detail: Detail,
}

impl Budget {
    pub(super) fn new(rays: u32) -> Self {
        Self { left: rays, limit: u32::MAX, spent: 0, detail: Detail::Full }
    }

    /// Begins a band of `lines`, where `lines_left` are to be drawn with it.
    pub(super) fn share(&mut self, lines: u32, lines_left: u32) {
        if self.left == u32::MAX {
            return;
        }
        let share = u64::from(self.left) * u64::from(lines) / u64::from(lines_left.max(1));
        let share = u32::try_from(share).unwrap_or(u32::MAX);
        let next = match self.detail {
            Detail::Full | Detail::Coarse if self.spent / 4 > share => self.detail.coarser(),
            Detail::Coarse | Detail::Grid if self.spent / 2 < share => self.detail.finer(),
            same => same,
        };
        // Bands differ: where there is much to see, one may take five times its share, as long as half is left for those below.
        let half = if lines_left > lines { self.left / 2 } else { self.left };
        let limit = share.saturating_mul(5).min(half);
        (self.limit, self.spent, self.detail) = (limit, 0, next);
    }

    /// Counts rays of the current band.
    pub(super) fn spend(&mut self, rays: u32) {
        if self.left == u32::MAX {
            return;
        }
        self.left = self.left.saturating_sub(rays);
        self.spent = self.spent.saturating_add(rays);
    }

    /// How closely to look now: a band that has spent all it may sees only the grid.
    pub(super) fn detail(&self) -> Detail {
        if self.spent > self.limit { Detail::Grid } else { self.detail }
    }
}

impl Detail {
    fn coarser(self) -> Self {
        match self {
            Self::Full => Self::Coarse,
            Self::Coarse | Self::Grid => Self::Grid,
        }
    }

    fn finer(self) -> Self {
        match self {
            Self::Grid => Self::Coarse,
            Self::Coarse | Self::Full => Self::Full,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_limit_all_is_looked_at() {
        let mut budget = Budget::new(u32::MAX);
        budget.share(4, 8);
        budget.spend(u32::MAX);
        budget.share(4, 4);
        assert_eq!(budget.detail(), Detail::Full);
    }

    #[test]
    fn what_is_spent_too_fast_is_made_up_for() {
        let mut budget = Budget::new(1000);
        budget.share(4, 40);
        budget.spend(500);
        assert_eq!(budget.detail(), Detail::Full);
        budget.spend(1);
        assert_eq!(budget.detail(), Detail::Grid);
        // 499 rays for 36 lines: 55 for four.
        budget.share(4, 36);
        assert_eq!(budget.detail(), Detail::Coarse);
        budget.spend(10);
        budget.share(4, 32);
        assert_eq!(budget.detail(), Detail::Full);
    }
}
