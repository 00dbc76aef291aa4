//! How much stack was used: paint what is free, and look later how much paint is left.

#[cfg(feature = "gallery")]
use core::mem::MaybeUninit;
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

/// The most that is left for the stack: six times what the deepest scene of the gallery takes.
#[cfg(feature = "gallery")]
const MOST_STACK: usize = 64 * 1024;

/// The RAM above the statics, but for what is left for the stack: five eighths, which are 10 KB of the smallest board's 16 KB, and at most
/// [`MOST_STACK`].
///
/// # Safety
/// Call it once, and let the stack grow no further: whether it did, [`PaintedStack::used`] tells afterwards.
#[cfg(feature = "gallery")]
#[allow(unsafe_code)]
pub(crate) unsafe fn memory_below() -> &'static mut [MaybeUninit<u8>] {
    let lowest = ptr::addr_of!(_stack_end).cast_mut().cast();
    let free = (ptr::addr_of!(_stack_start) as usize).saturating_sub(lowest as usize);
    let stack = (free / 8 * 5).min(MOST_STACK);
    // Paint is in words.
    let memory = (free - stack) & !3;
    // SAFETY: the linker places nothing between the two symbols, and whoever calls this keeps the stack out.
    unsafe { core::slice::from_raw_parts_mut(lowest, memory) }
}

/// The free part of the stack, from its lower end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaintedStack {
    lowest: *mut u32,
    painted_words: usize,
}

impl PaintedStack {
    /// Paints what is free above the statics.
    #[inline(always)]
    pub(crate) fn paint() -> Self {
        Self::paint_above(ptr::addr_of!(_stack_end).cast_mut())
    }

    /// Paints what is free above this word, which nothing else may use.
    #[inline(never)]
    pub(crate) fn paint_above(lowest: *mut u32) -> Self {
        let here = 0u32;
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
