//! Measures the stack: paints the free memory, and later counts how much paint is left.

#[cfg(feature = "gallery")]
use core::mem::MaybeUninit;
use core::ptr;

/// The value of memory that was not written since it was painted.
const PAINT: u32 = 0xC0DE_FEED;

/// Bytes below the stack pointer that are not painted, for the frames of the functions that paint.
const MARGIN: usize = 128;

#[allow(unsafe_code)]
unsafe extern "C" {
    /// The upper end of the stack, which grows down.
    static _stack_start: u32;
    /// The lower end of the stack: the end of all statics.
    static _stack_end: u32;
}

/// The largest stack that `gallery` needs, in bytes: six times that of its deepest scene.
#[cfg(feature = "gallery")]
const MOST_STACK: usize = 64 * 1024;

/// The free RAM above the statics, without the stack's part: five eighths of it, which are 10 KB of the
/// smallest board's 16 KB, and at most [`MOST_STACK`].
///
/// # Safety
/// Call this once. The stack must not grow beyond its part: [`PaintedStack::used`] checks that afterwards.
#[cfg(feature = "gallery")]
#[allow(unsafe_code)]
pub(crate) unsafe fn memory_below() -> &'static mut [MaybeUninit<u8>] {
    let lowest = ptr::addr_of!(_stack_end).cast_mut().cast();
    let free = (ptr::addr_of!(_stack_start) as usize).saturating_sub(lowest as usize);
    let stack = (free / 8 * 5).min(MOST_STACK);
    // A multiple of four: the stack above it is painted in words.
    let memory = (free - stack) & !3;
    // SAFETY: the linker places nothing between the two symbols, and the caller keeps the stack out of this
    // part.
    unsafe { core::slice::from_raw_parts_mut(lowest, memory) }
}

/// The painted part of the stack, from its lower end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PaintedStack {
    lowest: *mut u32,
    painted_words: usize,
}

impl PaintedStack {
    /// Paints the free memory above the statics.
    pub(crate) fn paint() -> Self {
        Self::paint_above(ptr::addr_of!(_stack_end).cast_mut())
    }

    /// Paints the free memory above this word, which must not be in use.
    // Not inlined, so that its frame lies below that of the caller.
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

    /// The largest number of bytes of stack that were in use, or `None` if the stack has filled its room.
    pub(crate) fn used(&self) -> Option<u32> {
        let mut word = 0;
        // SAFETY: only words that were painted are read.
        #[allow(unsafe_code)]
        while word < self.painted_words && unsafe { self.lowest.add(word).read_volatile() } == PAINT {
            word += 1;
        }
        let deepest = self.lowest.wrapping_add(word) as usize;
        let used = (ptr::addr_of!(_stack_start) as usize).saturating_sub(deepest);
        (word > 0).then_some(used as u32)
    }
}
