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

/// How many times its share a band may take, and the one below is still looked at as closely. Bands differ: where what is
/// to be seen lies in a few of them, less costs quality in frames that have rays enough (four times: 5 dB where there are
/// 5 % more than all bands want).
const MOST: u32 = 8;

/// The same after bands have come to their end, each of which halves it: there are too few for all.
const LEAST: u32 = 2;

/// The rays that a frame may still spend.
///
/// Each band gets its share of what the pixels of the grid leave. These are traced first, so that what those of the
/// lines below will take is kept back: as much for each row as the last one took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    /// For the frame, and what is left of it.
    rays: u32,
    left: u32,
    /// The frame's lines.
    lines: u32,
    /// What the last row of the grid took that was traced, and what the current one has taken.
    row: u32,
    row_spent: u32,
    /// Whether the lower row of the current band is traced.
    traces_row: bool,
    /// What the current band may spend beside the grid, and what it has spent.
    limit: u32,
    spent: u32,
    /// How many times its share a band may take.
    most: u32,
    detail: Detail,
}

impl Budget {
    pub(super) fn new(rays: u32, lines: u32) -> Self {
        Self {
            rays,
            left: rays,
            lines,
            row: 0,
            row_spent: 0,
            traces_row: true,
            limit: u32::MAX,
            spent: 0,
            most: MOST,
            detail: Detail::Full,
        }
    }

    /// Begins a band of `lines`, where `lines_left` are to be drawn with it.
    pub(super) fn share(&mut self, lines: u32, lines_left: u32) {
        if self.rays == u32::MAX {
            return;
        }
        if self.traces_row {
            self.row = self.row_spent;
        }
        let lines = lines.clamp(1, lines_left.max(1));
        let grid = self.row.saturating_mul(lines_left.div_ceil(lines));
        let free = self.left.saturating_sub(grid);
        let share = part(free, lines, lines_left);
        if self.spent >= self.limit {
            self.most = (self.most / 2).max(LEAST);
        }
        let next = match self.detail {
            Detail::Full | Detail::Coarse if self.spent > share.saturating_mul(self.most) => {
                self.detail.coarser()
            }
            Detail::Coarse | Detail::Grid if self.spent / 2 < share => self.detail.finer(),
            same => same,
        };
        // Those below keep half of theirs.
        let kept = free.saturating_sub(share) / 2;
        let limit = share.saturating_mul(self.most).min(free - kept);
        // Where there are too few for the grid, its rows are left out evenly.
        let due = part(self.rays, self.lines.saturating_sub(lines_left) + lines, self.lines);
        let taken = self.rays.saturating_sub(self.left).saturating_add(self.row);
        self.traces_row = grid <= self.left || taken <= due;
        (self.limit, self.spent, self.row_spent, self.detail) = (limit, 0, 0, next);
    }

    /// Counts rays of the current band.
    pub(super) fn spend(&mut self, rays: Spent) {
        if self.rays == u32::MAX {
            return;
        }
        self.left = self.left.saturating_sub(rays.all);
        self.row_spent = self.row_spent.saturating_add(rays.row);
        self.spent = self.spent.saturating_add(rays.refined);
    }

    /// How many rays the frame has left.
    pub(super) fn left(&self) -> u32 {
        self.left
    }

    /// Whether the pixels of the grid below the band are traced.
    pub(super) fn traces_row(&self) -> bool {
        self.traces_row
    }

    /// How many rays the current band has left for what lies between the pixels of the grid.
    pub(super) fn refines(&self) -> u32 {
        self.limit.saturating_sub(self.spent).min(self.left)
    }

    /// How closely to look now: a band that has spent all it may sees only the grid.
    pub(super) fn detail(&self) -> Detail {
        if self.refines() == 0 { Detail::Grid } else { self.detail }
    }
}

/// What falls to some of a picture's lines. Both are below 2¹⁶: no product overflows, and none takes 64 bits.
fn part(rays: u32, lines: u32, of: u32) -> u32 {
    let of = of.max(1);
    (rays / of).saturating_mul(lines).saturating_add(rays % of * lines / of)
}

/// The rays that a cell took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    /// All of them.
    pub(super) all: u32,
    /// Those of its lower right corner: one pixel of the row below.
    pub(super) row: u32,
    /// Those between its corners.
    pub(super) refined: u32,
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

    fn refined(rays: u32) -> Spent {
        Spent { all: rays, row: 0, refined: rays }
    }

    #[test]
    fn without_a_limit_all_is_looked_at() {
        let mut budget = Budget::new(u32::MAX, 8);
        budget.share(4, 8);
        budget.spend(refined(u32::MAX));
        budget.share(4, 4);
        assert_eq!((budget.detail(), budget.refines(), budget.left()), (Detail::Full, u32::MAX, u32::MAX));
        assert!(budget.traces_row());
    }

    #[test]
    fn what_is_spent_too_fast_is_made_up_for() {
        let mut budget = Budget::new(1000, 40);
        budget.share(4, 40);
        assert_eq!((budget.detail(), budget.refines()), (Detail::Full, 550));
        budget.spend(refined(549));
        assert_eq!(budget.detail(), Detail::Full);
        budget.spend(refined(2));
        assert_eq!((budget.detail(), budget.refines()), (Detail::Grid, 0));
        // 449 rays for 36 lines: 49 for four.
        budget.share(4, 36);
        assert_eq!(budget.detail(), Detail::Coarse);
        budget.spend(refined(10));
        budget.share(4, 32);
        assert_eq!(budget.detail(), Detail::Full);
    }

    #[test]
    fn what_the_grid_takes_below_is_kept_back() {
        let mut budget = Budget::new(1000, 40);
        budget.share(4, 40);
        budget.spend(Spent { all: 120, row: 60, refined: 0 });
        budget.share(4, 36);
        // 880 are left, of which nine rows take 540: 37 a band. Those below keep 151.
        assert_eq!((budget.refines(), budget.traces_row()), (189, true));
        // The last band may take all that its own row leaves.
        budget.share(4, 4);
        assert_eq!(budget.refines(), 880);
    }

    #[test]
    fn where_there_are_too_few_rays_rows_are_left_out_evenly() {
        let mut budget = Budget::new(300, 80);
        let mut rows = Vec::new();
        for band in 0..20 {
            budget.share(4, 80 - band * 4);
            rows.push(budget.traces_row());
            if budget.traces_row() {
                budget.spend(Spent { all: 60, row: 60, refined: 0 });
            }
        }
        let traced: Vec<_> = (0..20).filter(|band| rows[*band]).collect();
        assert_eq!(traced, [0, 7, 11, 15, 19]);
        assert_eq!((budget.left(), budget.refines()), (0, 0));
    }
}
