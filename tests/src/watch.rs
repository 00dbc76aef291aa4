//! A probe of any kind behind one type.

use rayline::{Event, Probe};

/// Any probe. The tracer is compiled once for each type of probe and number system, so tests give it this
/// one, or `()`.
pub struct Watch<'p, R>(pub &'p mut dyn Probe<R>);

impl<R> Probe<R> for Watch<'_, R> {
    fn record(&mut self, event: Event<R>) {
        self.0.record(event);
    }

    fn is_enabled(&self) -> bool {
        self.0.is_enabled()
    }

    fn needs_order(&self) -> bool {
        self.0.needs_order()
    }
}

impl<R> core::fmt::Debug for Watch<'_, R> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("Watch")
    }
}
