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

/// The state of the arbitration within a clock, after some of the requests.
struct Turn {
    /// The remaining credit.
    credit: Signal,
    /// One of these requests has to wait for credit.
    waits: Signal,
    /// One of these requests is a plane, and passes.
    plane_goes: Signal,
    /// The last of these requests that passes, one-hot; if none does, the last one of earlier clocks.
    last: Signal,
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
    fn grant(&self, m: Module, requests: Signal) -> Signal {
        let stations = 2 * self.renderers;
        let most = self.most_credit();
        def!(credit = m.reg(up_to(most)).reset(most));
        def!(last = m.reg(stations).reset(0));
        def!(behind_last = requests & !(last | (last - 1)));
        def!(up_to_last = requests & (last | (last - 1)));
        let mut goes = vec![lit(1, 0); stations as usize];
        let mut turn = Turn { credit: *credit, waits: lit(1, 0), plane_goes: lit(1, 0), last: *last };
        for (part, first_place) in [(behind_last, 0), (up_to_last, stations)] {
            for station in 0..stations {
                let grant = self.visit(&mut turn, station, part.bit(station), first_place + station);
                goes[station as usize] |= grant;
            }
        }
        last.next(turn.last);
        let sum = turn.credit.zext(up_to(most + self.rate)) + self.rate;
        credit.next(mux(sum.gt(most), most, sum.trunc(up_to(most))));
        goes.reverse();
        concat(&goes)
    }

    /// Whether the request of a station, if any, is granted. `place` counts the stations visited in the clock.
    fn visit(&self, turn: &mut Turn, station: u32, request: Signal, place: u32) -> Signal {
        let is_plane = station >= self.renderers;
        let bits = if is_plane { self.side } else { Ring::INSTRUCTION };
        let may = !turn.waits & if is_plane { !turn.plane_goes } else { lit(1, 1) };
        let wants = (request & may).named(&format!("wants{place}"));
        let pays = turn.credit.ge(bits);
        let goes = (wants & pays).named(&format!("goes{place}"));
        turn.waits |= wants & !pays;
        turn.credit = mux(goes, turn.credit - bits, turn.credit).named(&format!("credit{place}"));
        turn.last = mux(goes, lit(2 * self.renderers, 1u64 << station), turn.last);
        if is_plane {
            turn.plane_goes |= goes;
        }
        goes
    }
}

#[cfg(test)]
mod tests;
