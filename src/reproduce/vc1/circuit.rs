//! The clocks of single parts of the circuit: the scan of the merger, the accesses of a local frame buffer, the bus.

use tilewright_machines::Error;
use tilewright_rtl::bus::BroadcastBus;
use tilewright_rtl::clocks::PE;
use tilewright_rtl::gfb::{GfbSequencer, SCAN_LATENCY};
use tilewright_rtl::lfb::{LfbUnit, Patches};
use tilewright_rtl::parameter::Screen;
use tilewright_rtl::vc1::OVERHEAD;
use tilewright_sim::Simulation;

/// The measurements, in clocks.
pub struct Circuit {
    /// T_m, from the first pixel that enters the chain to the last one stored, for the paper's screen and for one with twice its sides.
    pub merging: [u64; 2],
    /// From one round of the scan to the next.
    pub round: u64,
    /// From access to access, if each patch has a page, and if none has.
    pub accesses: [u64; 2],
    /// Bytes a clock of the processing elements.
    pub bus: f64,
}

impl Circuit {
    /// Runs the parts.
    ///
    /// # Errors
    /// The simulator's.
    pub fn measured() -> Result<Circuit, Error> {
        let (t_m, round) = merging(Screen::VC1)?;
        let (larger, _) = merging(Screen::new(2 * Screen::VC1.width, 2 * Screen::VC1.height)?)?;
        Ok(Circuit { merging: [t_m, larger], round, accesses: [hits()?, misses()?], bus: bus()? })
    }
}

/// T_m of 16 merging units, and the clocks from a round to the next.
fn merging(screen: Screen) -> Result<(u64, u64), Error> {
    let sequencer = GfbSequencer { screen, units: 16, overhead: OVERHEAD };
    let mut sim = Simulation::of(&sequencer)?;
    sim.try_reset()?;
    let (pixels, mut read, mut entered, mut stored) = (u64::from(screen.pixels()), 0, Vec::new(), None);
    for clock in 0.. {
        // A pixel enters the chain this number of enabled clocks after it was read.
        if sim.get_u64(sim.o.scan.enable) == 1 {
            if read >= u64::from(SCAN_LATENCY) && (read - u64::from(SCAN_LATENCY)) % pixels == 0 {
                entered.push(clock);
            }
            read += 1;
        }
        if sim.get_u64(sim.o.stores) == 1 && sim.get_u64(sim.o.store) == pixels - 1 {
            stored.get_or_insert(clock + 1);
        }
        if let (Some(stored), [first, second, ..]) = (stored, &entered[..]) {
            return Ok((stored - first, second - first));
        }
        sim.try_step()?;
    }
    unreachable!("the scan runs freely")
}

/// Accesses that follow one another without a pause.
const ACCESSES: usize = 32;

/// Clocks from access to access in one patch, which has a page from the first on.
fn hits() -> Result<u64, Error> {
    accesses((0..ACCESSES).map(|_| [8, 8]))
}

/// The same with each access in another patch.
fn misses() -> Result<u64, Error> {
    accesses((0..ACCESSES as u64).map(|patch| [4 * patch, 8]))
}

/// The clocks between accesses, without the first two.
fn accesses(pixels: impl Iterator<Item = [u64; 2]>) -> Result<u64, Error> {
    let unit = LfbUnit { patches: Patches::new(Screen::VC1, 4)?, pages: 4096 };
    let mut sim = Simulation::of(&unit)?;
    sim.try_reset()?;
    let (request, mut taken) = (sim.i.request, Vec::new());
    sim.set(request.valid, 1);
    for [x, y] in pixels {
        sim.set(request.x, x);
        sim.set(request.y, y);
        while sim.get_u64(request.ready) == 0 {
            sim.step_clock(PE, 1);
        }
        taken.push(sim.cycles(PE).expect("the unit has that clock"));
        sim.step_clock(PE, 1);
    }
    let between = taken.windows(2).skip(1).map(|pair| pair[1] - pair[0]);
    let (least, most) = (between.clone().min(), between.max());
    // If they differ there is no single number, and the rule reports a difference from the paper's.
    Ok(if least == most { least.unwrap_or_default() } else { 0 })
}

/// Bytes a clock on the bus while a sender always has a word and all receivers take it.
fn bus() -> Result<f64, Error> {
    const CLOCKS: u64 = 6000;
    let mut sim = Simulation::of(&BroadcastBus::vc1(16))?;
    sim.try_reset()?;
    let sender = sim.i.senders[0];
    sim.set(sender.valid, 1);
    sim.set(sender.last, 1);
    for port in sim.o.received.clone() {
        sim.set(port.ready, 1);
    }
    let mut words = 0;
    for _ in 0..CLOCKS {
        words += sim.get_u64(sender.ready);
        sim.try_step()?;
    }
    Ok((4 * words) as f64 / CLOCKS as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_take_what_the_paper_says() {
        let Circuit { merging: [merging, larger], round, accesses, bus } = Circuit::measured().expect("they run");
        assert_eq!((merging, round, accesses), (316_864, 316_800, [3, 4]));
        assert_eq!(larger, 1300 * 960 + 64);
        assert!((bus - 4.0 / 6.0).abs() < 0.01, "{bus}");
    }
}
