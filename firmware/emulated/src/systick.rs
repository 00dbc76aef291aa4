//! Counts instructions with the timer that every Cortex-M has.
//!
//! The emulator runs with `-icount shift=0`: each instruction takes one nanosecond of its time. So a tick of
//! the timer stands for as many instructions as one period of the board's clock has nanoseconds. The count is
//! the same on every run, and exact to one tick.

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;

/// Ticks until the timer starts over: it counts down in 24 bits.
const PERIOD: u32 = 1 << 24;

/// Half nanoseconds, which are half instructions, of one tick. Periods of the boards' clocks are whole
/// numbers of them.
const HALF_NANOSECONDS_PER_TICK: u64 = 2_000_000_000 / CLOCK_HZ;
const _: () = assert!(2_000_000_000 % CLOCK_HZ == 0, "a tick is a whole number of half nanoseconds");

include!(concat!(env!("OUT_DIR"), "/clock.rs"));

/// How often the timer has started over.
static ROUNDS: AtomicU32 = AtomicU32::new(0);

/// The timer, counting instructions.
#[derive(Clone, Copy, Debug)]
pub struct SysTick(());

impl SysTick {
    /// Starts the timer from zero.
    pub fn start() -> Self {
        // SAFETY: no other part of the program uses the timer, and a second start only sets it back to zero.
        #[allow(unsafe_code)]
        let mut timer = unsafe { Peripherals::steal() }.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(PERIOD - 1);
        timer.clear_current();
        timer.enable_interrupt();
        timer.enable_counter();
        Self(())
    }

    /// The number of instructions since the start.
    pub(crate) fn now(self) -> u64 {
        (ticks() * HALF_NANOSECONDS_PER_TICK) >> 1
    }
}

/// The number of ticks since the start.
fn ticks() -> u64 {
    loop {
        let rounds = ROUNDS.load(Ordering::SeqCst);
        let left = SYST::get_current();
        // Read again if the timer started over between the two reads.
        if ROUNDS.load(Ordering::SeqCst) == rounds {
            // A round begins when the timer reaches 0, which raises the interrupt; the next tick loads the
            // period.
            let elapsed = PERIOD.wrapping_sub(left) & (PERIOD - 1);
            return u64::from(rounds) * u64::from(PERIOD) + u64::from(elapsed);
        }
    }
}

/// The interrupt at the end of each round.
#[exception]
fn SysTick() {
    ROUNDS.store(ROUNDS.load(Ordering::SeqCst).wrapping_add(1), Ordering::SeqCst);
}
