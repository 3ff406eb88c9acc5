//! Milliseconds, from the timer that every Cortex-M has.

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::syst::SystClkSource;

#[cfg(feature = "lm3s6965evb")]
const CYCLES_PER_MS: u32 = 12_500;
#[cfg(not(feature = "lm3s6965evb"))]
const CYCLES_PER_MS: u32 = 25_000;

/// Only the interrupt writes it, so it needs no exchange, which small cores do not have.
static NOW: AtomicU32 = AtomicU32::new(0);

/// Starts the timer and returns the clock.
pub fn start() -> impl FnMut() -> u32 {
    if let Some(mut peripherals) = cortex_m::Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(CYCLES_PER_MS - 1);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
        peripherals.SYST.enable_interrupt();
    }
    || NOW.load(Ordering::Relaxed)
}

#[cortex_m_rt::exception]
fn SysTick() {
    NOW.store(NOW.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}
