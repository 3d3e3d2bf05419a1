//! The ring: carries instructions to the renderers and finished planes to the frame buffer, at a limited number of bits
//! a clock (facts E3).
//!
//! ```text
//!                 .------------------------.
//! bins.0 ========>|                        |=======> instructions.0, to renderer 0
//! bins.1 ========>|  round robin, while    |=======> instructions.1, to renderer 1
//!   ..            |  the credit lasts      |               ..
//! finished.0 ====>|                        |=======> planes, to the frame buffer
//! finished.1 ====>|        [credit]        |
//!   ..            '------------------------'
//!                   ^
//! room of queues ---'
//! ```
//!
//! A message passes in the clock in which it is granted. An instruction requests only if its renderer's queue has room.
//! Requests are served round robin, the instructions before the planes, starting after the last one served. In a clock,
//! as many messages pass as the credit pays for, at most one to each receiver. If a message has to wait for credit, all
//! messages after it wait, too.
//!
//! The credit grows by `rate` bits a clock. Its limit is `rate` plus the size of the largest message, less one bit. So in
//! any n clocks the ring carries less than n `rate` bits plus one message. While messages wait for credit, none of these
//! bits is lost. An instruction costs all of its bits; a plane costs a bit for each pixel of the line. Addresses
//! cost nothing. The planes of a line stay together, as the frame buffer requires.
//!
//! Latency: none. A message can be taken in the clock in which it is offered.

use super::backing_store::BitPlane;
use super::instruction::Instruction;
use super::{PERIOD, SIDES, fields};
use crate::prelude::*;
use tilewright_blocks::first;

block! {
    /// Carries instructions to renderers, and their planes to the frame buffer, at `rate` bits a clock.
    pub struct Ring {
        /// The number of renderers.
        pub renderers: u32,
        /// Pixels in a line of a region.
        pub side: u32,
        /// Bits that the ring carries in a clock: 125 bits in 25 ns are 5 Gbit/s.
        pub rate: u32,
    }
    ranges { renderers: 1..=Ring::MOST_RENDERERS, side: powers_of_two(SIDES), rate: 1..=Ring::MOST }
    latency(self) = format!("none; {} bits a clock", self.rate);
    source = "Pixel-planes 5, section I.3.2.1 (PP5-ARCH)";
    in(self) RingIn {
        /// The instructions for each renderer.
        bins: [stream(Instruction); self.renderers],
        /// The renderers whose queues have room for an instruction in this clock.
        room: bit().of(row(self.renderers)),
        /// The finished regions of each renderer.
        finished: [stream(BitPlane = BitPlane::widths(self.side)); self.renderers],
    }
    out(self) RingOut {
        /// The instructions to each renderer.
        instructions: [stream(Instruction); self.renderers],
        /// The planes to the frame buffer.
        planes: stream(BitPlane = BitPlane::widths(self.side)),
    }
}

impl Ring {
    /// The greatest number of renderers.
    pub const MOST_RENDERERS: u32 = 64;
    /// The largest rate; 32 renderers cannot take that much.
    pub const MOST: u32 = 8192;
    /// The number of bits of an instruction.
    pub const INSTRUCTION: u32 = 154;

    /// The bits per clock of a ring of `megabits` Mbit/s.
    ///
    /// # Errors
    ///
    /// The rate is not a whole number of bits a clock, or is out of range.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::ring::Ring;
    ///
    /// assert_eq!(Ring::bits_a_clock(5000)?, 125);
    /// assert!(Ring::bits_a_clock(5010).is_err());
    /// # Ok::<(), tilewright_rtl::parameter::ParameterError>(())
    /// ```
    pub fn bits_a_clock(megabits: u32) -> Result<u32, ParameterError> {
        // One bit in each clock, in Mbit/s.
        let step = (1_000_000 / PERIOD.picoseconds()) as u32;
        let most = step * Ring::MOST;
        if megabits.is_multiple_of(step) && (step..=most).contains(&megabits) {
            return Ok(megabits / step);
        }
        let clock = PERIOD.picoseconds() / 1000;
        Err(ParameterError(format!(
            "a ring of {megabits} Mbit/s: it carries a whole number of bits in each clock of {clock} ns, \
             so it has to be a multiple of {step} from {step} to {most}"
        )))
    }

    /// The greatest credit, which is also the initial credit. With a lower limit, bits of the next clock would be lost
    /// while a message waits.
    pub fn most_credit(&self) -> u32 {
        Ring::INSTRUCTION.max(self.side) - 1 + self.rate
    }

    fn build(&self, m: Module, i: RingIn) -> RingOut {
        let renderers = self.renderers;
        def!(granted = m.wire(2 * renderers));
        let mut wants = Vec::new();
        let mut instructions = Vec::new();
        for (bin, number) in i.bins.iter().zip(0..) {
            wants.push(bin.valid & i.room.lane(number));
            let (stream, _) = m.offer(granted.bit(number), bin.take_when(granted.bit(number)).payload);
            m.assume(stream.valid.implies(stream.ready), "a queue that has room takes an instruction");
            instructions.push(stream);
        }

        // A line's planes come one after another from one renderer.
        def!(line_of = m.reg(renderers).reset(0));
        def!(of_plane = granted.slice(renderers..2 * renderers));
        let mut lines = Vec::new();
        for (region, number) in i.finished.iter().zip(0..) {
            wants.push(region.valid & (line_of.eq(0) | line_of.bit(number)));
            lines.push((of_plane.bit(number), region.take_when(of_plane.bit(number)).payload));
        }
        let first = lines[0].1;
        let plane = select(lines.into_iter().skip(1).collect::<Vec<_>>(), first);
        let (planes, _) = m.offer(of_plane.any_one(), plane);
        m.assume(planes.valid.implies(planes.ready), "the frame buffer takes each plane");
        def!(line_ends = plane.plane.eq(fields::WORD.bits - 1));
        line_of.when(of_plane.any_one(), mux(line_ends, 0, of_plane));

        wants.reverse();
        def!(requests = concat(&wants));
        granted.drive(self.grant(m, requests));
        RingOut { instructions, planes }
    }

    /// The requests that are granted: one pass over all, starting after the one that passed last.
    ///
    /// The credit does not go from station to station. Prefix sums say what each request costs with all before it, and
    /// the requests pass that the credit pays for. So the depth is logarithmic in the number of stations.
    fn grant(&self, m: Module, requests: Signal) -> Signal {
        let (stations, most) = (2 * self.renderers, self.most_credit());
        def!(credit = m.reg(up_to(most)).reset(most));
        def!(last = m.reg(stations).reset(0));

        // A pass visits the stations behind the last one, and then those up to it: a place for each visit.
        let places = row(2 * stations);
        def!(up_to_last = requests & (last | (last - 1)));
        def!(behind_last = requests & !(last | (last - 1)));
        let visited = concat(&[up_to_last, behind_last]);
        let planes = constants(bit().of(places), |place| u32::from(place % stations >= self.renderers));
        def!(first_plane = first(visited & planes.pack()));
        def!(wants = visited.unpack(places) & (!planes | first_plane.unpack(places)));

        // The cost of all messages up to each place. The sums never fall, so the credit pays for the first ones.
        let dearest = self.renderers * Ring::INSTRUCTION + self.side;
        let bits = constants(up_to(dearest.max(most)).of(places), |place| self.bits(place % stations));
        let mut sums = mux(wants, bits, 0);
        for span in (0..).map(|level| 1 << level).take_while(|span| *span < 2 * stations) {
            sums = (sums + sums.take_or(2 * stations, |place| place - span, 0)).named(&format!("sums_of{}", 2 * span));
        }
        def!(fits = sums.le(credit.zext(sums.width())));
        def!(goes = (wants & fits).pack());

        def!(last_that_fits = fits & !fits.take_or(2 * stations, |place| place + 1, 0));
        def!(paid = mux(last_that_fits, sums, 0).or_all().trunc(up_to(most)));
        let sum = (credit - paid).zext(up_to(most + self.rate)) + self.rate;
        credit.next(mux(sum.gt(most), most, sum.trunc(up_to(most))));
        let backwards = |word: Signal| word.unpack(places).reversed().pack();
        def!(last_to_go = backwards(first(backwards(goes))));
        last.when(goes.any_one(), either(last_to_go, stations));
        either(goes, stations)
    }

    /// The bits that a station's message costs.
    fn bits(&self, station: u32) -> u32 {
        if station < self.renderers { Ring::INSTRUCTION } else { self.side }
    }
}

/// A bit for each station, of bits for both of its places.
fn either(visited: Signal, stations: u32) -> Signal {
    visited.slice(0..stations) | visited.slice(stations..2 * stations)
}

#[cfg(test)]
mod tests;
