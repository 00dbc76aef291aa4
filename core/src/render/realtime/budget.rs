//! The rays of a frame, shared out among its bands of lines.

/// How closely a band is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Pixels are traced wherever neighbors differ.
    Full,
    /// Pixels are traced only where the colors of neighbors differ much.
    Coarse,
    /// Only the pixels of the grid are traced.
    Grid,
}

/// How many times its share a band may take before the next band is drawn more coarsely. Bands differ: often
/// a few of them show most of what there is to see, and a smaller factor would draw these coarsely in frames
/// that have rays enough.
const MOST: u32 = 8;

/// The least factor in place of [`MOST`]. Each band that runs out of rays halves the factor, down to this.
const LEAST: u32 = 2;

/// The rays that a frame may still spend.
///
/// The pixels of the grid come first: the rays that they will take in the bands below are kept back,
/// estimated by those of the last row. Each band has an equal share of the rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    /// The rays of the whole frame; `u32::MAX`: there is no limit.
    rays: u32,
    /// How many of them are left.
    left: u32,
    /// The lines of the whole frame.
    lines: u32,
    /// The rays of the last traced row of the grid.
    row: u32,
    /// The rays that the current row of the grid has taken.
    row_spent: u32,
    /// Whether the lower row of the grid is traced in the current band.
    traces_row: bool,
    /// The rays that the current band may spend between the pixels of the grid.
    limit: u32,
    /// How many of them it has spent.
    spent: u32,
    /// How many times its share a band may take.
    most: u32,
    /// How closely the current band is drawn while it has rays.
    detail: Detail,
}

impl Budget {
    /// `rays` for a frame of this many lines.
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

    /// Begins a band of `lines`. `lines_left` lines are still to be drawn, those of this band among them.
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
        // The bands below keep half of their shares.
        let kept = free.saturating_sub(share) / 2;
        let limit = share.saturating_mul(self.most).min(free - kept);
        // If there are too few rays for the grid, rows of it are left out evenly: this row is traced if the
        // frame has spent no more than is due by the end of this band.
        let due = part(self.rays, self.lines.saturating_sub(lines_left) + lines, self.lines);
        let taken = self.rays.saturating_sub(self.left).saturating_add(self.row);
        self.traces_row = grid <= self.left || taken <= due;
        (self.limit, self.spent, self.row_spent, self.detail) = (limit, 0, 0, next);
    }

    /// Counts the rays of a cell of the current band.
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

    /// Whether the row of the grid below the current band is traced.
    pub(super) fn traces_row(&self) -> bool {
        self.traces_row
    }

    /// How many rays the current band has left for pixels between those of the grid.
    pub(super) fn refines(&self) -> u32 {
        self.limit.saturating_sub(self.spent).min(self.left)
    }

    /// How closely the next cell is drawn: without rays, only the pixels of the grid are traced.
    pub(super) fn detail(&self) -> Detail {
        if self.refines() == 0 { Detail::Grid } else { self.detail }
    }
}

/// The part of `rays` that falls to `lines` of `of` lines, rounded down. Both are below 2¹⁶, so that 32 bits
/// are enough for each product.
fn part(rays: u32, lines: u32, of: u32) -> u32 {
    let of = of.max(1);
    (rays / of).saturating_mul(lines).saturating_add(rays % of * lines / of)
}

/// The rays that a cell took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spent {
    /// All of them.
    pub(super) all: u32,
    /// The rays of its lower right corner, which belongs to the row of the grid below the band.
    pub(super) row: u32,
    /// The rays between its corners.
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
    fn without_a_limit_every_band_is_drawn_in_full() {
        let mut budget = Budget::new(u32::MAX, 8);
        budget.share(4, 8);
        budget.spend(refined(u32::MAX));
        budget.share(4, 4);
        assert_eq!((budget.detail(), budget.refines(), budget.left()), (Detail::Full, u32::MAX, u32::MAX));
        assert!(budget.traces_row());
    }

    #[test]
    fn bands_after_an_expensive_one_are_drawn_coarsely() {
        let mut budget = Budget::new(1000, 40);
        budget.share(4, 40);
        assert_eq!((budget.detail(), budget.refines()), (Detail::Full, 550));
        budget.spend(refined(549));
        assert_eq!(budget.detail(), Detail::Full);
        budget.spend(refined(2));
        assert_eq!((budget.detail(), budget.refines()), (Detail::Grid, 0));
        // 449 rays are left for 36 lines: 49 for four.
        budget.share(4, 36);
        assert_eq!(budget.detail(), Detail::Coarse);
        budget.spend(refined(10));
        budget.share(4, 32);
        assert_eq!(budget.detail(), Detail::Full);
    }

    #[test]
    fn rays_for_the_grid_below_are_kept_back() {
        let mut budget = Budget::new(1000, 40);
        budget.share(4, 40);
        budget.spend(Spent { all: 120, row: 60, refined: 0 });
        budget.share(4, 36);
        // 880 rays are left. Nine rows of the grid take 540, so that a band's share is 37. The bands below
        // keep 151.
        assert_eq!((budget.refines(), budget.traces_row()), (189, true));
        // The last row took no rays, so that none are kept back in the last band.
        budget.share(4, 4);
        assert_eq!(budget.refines(), 880);
    }

    #[test]
    fn with_too_few_rays_rows_of_the_grid_are_left_out_evenly() {
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
