//! Samples in the cells of a grid.

use core::num::NonZeroU32;

use super::hash::hash;
use super::permutation::permute;

/// The center of a cell: the samples stand in rows, and each row has nearly the same number.
pub(super) fn grid(index: u32, samples: u32) -> [u16; 2] {
    let samples = samples.max(1);
    // In an order in which few samples lie apart, for adaptive sampling: always the same.
    let index = permute(index, samples, 0);
    let rows = rows(samples);
    let row = index * rows.get() / at_least_one(samples);
    // The first sample of a row.
    let first = |row: u32| (row * samples + rows.get() - 1) / rows;
    let in_row = at_least_one(first(row + 1) - first(row));
    [center(index - first(row), in_row), center(row, rows)]
}

/// A place in a cell. Each sample has another one of at least as many cells; the key chooses which, and the
/// place in it.
pub(super) fn jittered(index: u32, samples: u32, key: u32) -> [u16; 2] {
    let rows = rows(samples);
    let columns = at_least_one((samples + rows.get() - 1) / rows);
    let cells = at_least_one(rows.get() * columns.get());
    // Beyond the last cell, cells are taken again in another order.
    let cell = permute(index % cells, cells.get(), key.wrapping_add(index / cells));
    let inside = hash(index, key);
    let place = |cell: u32, inside: u32, cells: NonZeroU32| (((cell << 16) + inside) / cells) as u16;
    [place(cell % columns, inside >> 16, columns), place(cell / columns, inside & 0xFFFF, rows)]
}

/// The number of rows in a grid of cells that are about as wide as high.
fn rows(cells: u32) -> NonZeroU32 {
    at_least_one(cells.isqrt())
}

/// The center of one of several cells, in 65536ths of all.
fn center(cell: u32, cells: NonZeroU32) -> u16 {
    (((cell << 16) + 0x8000) / cells) as u16
}

fn at_least_one(number: u32) -> NonZeroU32 {
    NonZeroU32::new(number).unwrap_or(NonZeroU32::MIN)
}
