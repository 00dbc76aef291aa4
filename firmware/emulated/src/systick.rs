//! Counting instructions with the timer of every Cortex-M.
//!
//! The emulator, run with `-icount shift=0`, spends one nanosecond of its time on every instruction, so the
//! timer's ticks are instructions divided by a constant: the nanoseconds of one period of the board's clock. The
//! count is the same on every run, and exact to a tick.

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;

use crate::InstructionCounter;

/// The timer counts down in 24 bits; an interrupt counts how often it ran out.
const PERIOD: u32 = 1 << 24;

static ROUNDS: AtomicU32 = AtomicU32::new(0);

/// The timer, counting instructions.
#[derive(Clone, Copy, Debug)]
pub struct SysTick {
    half_nanoseconds_per_tick: u64,
}

impl SysTick {
    /// Starts the timer on a board whose clock has this period.
    pub fn start(mut timer: SYST, half_nanoseconds_per_tick: u64) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(PERIOD - 1);
        timer.clear_current();
        timer.enable_interrupt();
        timer.enable_counter();
        Self { half_nanoseconds_per_tick }
    }

    fn ticks() -> u64 {
        loop {
            let rounds = ROUNDS.load(Ordering::SeqCst);
            let left = SYST::get_current();
            // Read again if the timer ran out in between.
            if ROUNDS.load(Ordering::SeqCst) == rounds {
                // A round begins with 0, and with the interrupt; then the timer starts over from the top.
                let elapsed = PERIOD.wrapping_sub(left) & (PERIOD - 1);
                return u64::from(rounds) * u64::from(PERIOD) + u64::from(elapsed);
            }
        }
    }
}

impl InstructionCounter for SysTick {
    fn now(&self) -> u64 {
        (Self::ticks() * self.half_nanoseconds_per_tick) >> 1
    }
}

#[exception]
fn SysTick() {
    ROUNDS.store(ROUNDS.load(Ordering::SeqCst).wrapping_add(1), Ordering::SeqCst);
}
