//! How much stack was used: paint what is free, and look later how much paint is left.

use core::ptr;

/// Stands where nothing was ever written.
const PAINT: u32 = 0xC0DE_FEED;

/// Stays free of paint below the caller's frame, which may still grow while it paints.
const MARGIN: usize = 128;

#[allow(unsafe_code)]
unsafe extern "C" {
    /// The stack grows down from here.
    static _stack_start: u32;
    /// It must not grow beyond here: the end of all statics.
    static _stack_end: u32;
}

/// The free part of the stack, from its lower end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaintedStack {
    lowest: *mut u32,
    painted_words: usize,
}

impl PaintedStack {
    /// Paints what is free.
    #[inline(never)]
    pub(crate) fn paint() -> Self {
        let here = 0u32;
        let lowest = ptr::addr_of!(_stack_end).cast_mut();
        let free = (ptr::addr_of!(here) as usize).saturating_sub(MARGIN).saturating_sub(lowest as usize);
        let painted_words = free / size_of::<u32>();
        for word in 0..painted_words {
            // SAFETY: the word lies between the statics and the frame of this function, where nothing lives.
            #[allow(unsafe_code)]
            unsafe {
                lowest.add(word).write_volatile(PAINT);
            }
        }
        Self { lowest, painted_words }
    }

    /// Bytes of stack that were in use at some time, or `None` if it ever filled all of its room.
    pub(crate) fn used(&self) -> Option<u32> {
        let mut word = 0;
        // SAFETY: the words below `painted_words` are the ones that were painted.
        #[allow(unsafe_code)]
        while word < self.painted_words && unsafe { self.lowest.add(word).read_volatile() } == PAINT {
            word += 1;
        }
        let deepest = self.lowest.wrapping_add(word) as usize;
        let used = (ptr::addr_of!(_stack_start) as usize).saturating_sub(deepest);
        (word > 0).then_some(used as u32)
    }
}
