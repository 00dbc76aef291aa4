//! Memory that the caller lends to `prepare`.

use core::mem::{MaybeUninit, align_of, size_of};

use crate::fault::{Fault, Inner};

/// Memory for a prepared scene, in bytes.
///
/// The macro [`prepared_bytes!`](crate::prepared_bytes!) computes how many bytes a scene needs, and the
/// function [`prepared_bytes`](fn@crate::prepared_bytes) does so for numbers of items. The [guide on
/// shapes](crate::shape::guide#how-much-memory-to-lend) has examples.
///
/// On the desktop, where sizes are known only at run time, [`PreparedScene::new`](crate::PreparedScene::new)
/// takes any slice of bytes.
#[derive(Debug)]
#[repr(C, align(16))]
pub struct Workspace<const BYTES: usize>([MaybeUninit<u8>; BYTES]);

impl<const BYTES: usize> Workspace<BYTES> {
    /// Uninitialized memory, for a `static` or a local variable. Nothing is written before a scene is
    /// prepared.
    pub const fn new() -> Self {
        Self([MaybeUninit::uninit(); BYTES])
    }

    /// The bytes to lend.
    pub const fn lend(&mut self) -> &mut [MaybeUninit<u8>] {
        &mut self.0
    }
}

impl<const BYTES: usize> Default for Workspace<BYTES> {
    fn default() -> Self {
        Self::new()
    }
}

/// Hands out pieces of lent memory, from front to back, for the lifetime of the loan.
#[derive(Debug)]
pub struct Arena<'m> {
    free: &'m mut [MaybeUninit<u8>],
    lent: usize,
    /// The part of a compound shape that was refused.
    blamed: Option<Inner>,
}

impl<'m> Arena<'m> {
    /// Takes over the memory.
    pub(crate) fn new(memory: &'m mut [MaybeUninit<u8>]) -> Self {
        Self { lent: memory.len(), free: memory, blamed: None }
    }

    /// An upper bound on the bytes that `count` values of `T` take, including padding for their alignment.
    pub const fn bytes<T>(count: usize) -> usize {
        if count == 0 {
            return 0;
        }
        // Saturating: no caller can lend `usize::MAX` bytes, so the memory is then refused as too small.
        size_of::<T>().saturating_mul(count).saturating_add(align_of::<T>() - 1)
    }

    /// Stores one value.
    ///
    /// # Errors
    /// [`Fault::Memory`]: the lent memory is too small.
    pub fn store<T: Copy>(&mut self, value: T) -> Result<&'m T, Fault> {
        self.store_with(1, |_| value)?.first().ok_or(Fault::Memory { needed: 0, lent: self.lent })
    }

    /// Stores `count` values: the closure `value` makes each from its index, 0 to `count - 1`.
    ///
    /// # Errors
    /// [`Fault::Memory`]: the lent memory is too small.
    pub fn store_with<T: Copy>(
        &mut self,
        count: usize,
        mut value: impl FnMut(usize) -> T,
    ) -> Result<&'m [T], Fault> {
        let values = self.try_store_with(count, |index, _| Ok::<T, Fault>(value(index)))?;
        Ok(values)
    }

    /// Stores `count` values whose closure may fail and may use the arena itself. The values can be changed
    /// later.
    pub(crate) fn try_store_with<T: Copy, E: From<Fault>>(
        &mut self,
        count: usize,
        mut value: impl FnMut(usize, &mut Self) -> Result<T, E>,
    ) -> Result<&'m mut [T], E> {
        let mut room = self.room(count)?;
        for index in 0..count {
            room.push(value(index, self)?)?;
        }
        Ok(room.filled())
    }

    /// Sets memory for `count` values aside.
    pub(crate) fn room<T: Copy>(&mut self, count: usize) -> Result<Room<'m, T>, Fault> {
        Ok(Room { slots: self.take(count)?, len: 0 })
    }

    /// Remembers which part of a shape was refused, for the error. A refused solid inside of an instanced
    /// model is reported as that solid, not as the model.
    pub(crate) fn blame(&mut self, inner: Inner) {
        if inner != Inner::Model || self.blamed.is_none() {
            self.blamed = Some(inner);
        }
    }

    /// The part of a shape that was refused; `None` where the shape as a whole was refused.
    pub(crate) fn blamed(&self) -> Option<Inner> {
        self.blamed
    }

    /// Cuts memory for `count` values off the front of the free memory.
    fn take<T>(&mut self, count: usize) -> Result<&'m mut [MaybeUninit<T>], Fault> {
        if count == 0 {
            return Ok(&mut []);
        }
        // Saturating, as in `bytes`.
        let padding = self.free.as_ptr().align_offset(align_of::<T>());
        let room = self.take_bytes(padding, size_of::<T>().saturating_mul(count))?;
        // SAFETY: `room` is exclusively borrowed for 'm, begins at a multiple of T's alignment, and holds
        // `count` times T's size; `MaybeUninit<T>` may hold any bytes.
        #[allow(unsafe_code)]
        let slots = unsafe { core::slice::from_raw_parts_mut(room.as_mut_ptr().cast(), count) };
        Ok(slots)
    }

    /// Cuts bytes off the front of the free memory, after the padding. It is one function for all types, so
    /// that programs are small.
    fn take_bytes(&mut self, padding: usize, bytes: usize) -> Result<&'m mut [MaybeUninit<u8>], Fault> {
        let free = core::mem::take(&mut self.free);
        let end = padding.saturating_add(bytes);
        if end > free.len() {
            let missing = end.saturating_sub(free.len());
            self.free = free;
            return Err(Fault::Memory { needed: self.lent.saturating_add(missing), lent: self.lent });
        }
        let (used, rest) = free.split_at_mut_checked(end).unwrap_or_default();
        self.free = rest;
        used.get_mut(padding..).ok_or(Fault::Memory { needed: end, lent: self.lent })
    }
}

/// Memory for a known number of values, filled from front to back.
pub(crate) struct Room<'m, T> {
    slots: &'m mut [MaybeUninit<T>],
    /// The number of slots that were written.
    len: usize,
}

impl<'m, T: Copy> Room<'m, T> {
    /// Writes the next value.
    ///
    /// # Errors
    /// [`Fault::Full`]: all slots are filled.
    pub(crate) fn push(&mut self, value: T) -> Result<(), Fault> {
        let full = Fault::Full { room: self.slots.len() };
        self.slots.get_mut(self.len).ok_or(full)?.write(value);
        self.len += 1;
        Ok(())
    }

    /// The values that were written.
    pub(crate) fn filled(self) -> &'m mut [T] {
        let filled = self.slots.get_mut(..self.len).unwrap_or_default();
        // SAFETY: the first `len` slots were written, one by one, by `push`.
        #[allow(unsafe_code)]
        unsafe {
            &mut *(core::ptr::from_mut(filled) as *mut [T])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_aligned_and_kept() {
        let mut workspace = Workspace::<64>::new();
        let mut arena = Arena::new(&mut workspace.lend()[1..]);
        let bytes = arena.store_with(3, |i| i as u8).unwrap();
        let words = arena.store_with(4, |i| i as u64 * 1_000_000_007).unwrap();
        assert_eq!(bytes, [0, 1, 2]);
        assert_eq!(words, [0, 1_000_000_007, 2_000_000_014, 3_000_000_021]);
        assert!(words.as_ptr().is_aligned());
    }

    #[test]
    fn empty_lists_need_no_memory() {
        let mut arena = Arena::new(&mut []);
        assert!(arena.store_with(0, |i| i as u64).unwrap().is_empty());
    }

    #[test]
    fn too_little_memory_is_an_error_that_says_how_much() {
        let mut workspace = Workspace::<16>::new();
        let mut arena = Arena::new(workspace.lend());
        let Err(Fault::Memory { needed, lent: 16 }) = arena.store_with(5, |i| i as u32) else { panic!() };
        assert!((20..=23).contains(&needed), "{needed}");
        assert!(arena.store_with(usize::MAX, |i| i as u32).is_err());
        assert_eq!(arena.store_with(4, |i| i as u32).unwrap(), [0, 1, 2, 3]);
    }
}
