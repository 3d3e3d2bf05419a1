//! What an image generation controller has to send for the instructions that it takes, bit by bit.

use std::collections::VecDeque;
use std::sync::LazyLock;

use tilewright_hdl::Codes;
use tilewright_rtl::pixel_planes::instruction::{Instruction, Microcode, Operation};
use tilewright_rtl::pixel_planes::pixel::{Control, Enabling, Mask, Source};
use tilewright_rtl::pixel_planes::programs::clear;
use tilewright_rtl::pixel_planes::schedule::{Schedule, Step as Clocks, Times};

use super::bit_of;
use crate::looks::fields;
use crate::told::Checks;

/// The nets of a controller that are looked at, after its path.
pub(super) static NETS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut nets = HANDSHAKE.map(str::to_owned).to_vec();
    nets.extend(fields::<Instruction>("instructions", &clear(0)[0]));
    nets.extend(BESIDE.map(str::to_owned));
    nets.extend(fields::<Control>("control", &Control::ZERO));
    nets.push("idle".to_owned());
    nets
});
/// The handshake of instructions.
const HANDSHAKE: [&str; 2] = ["instructions_valid", "instructions_ready"];
/// Its other inputs, and what it sends to the tree.
const BESIDE: [&str; 6] = ["side_by_side", "store_free", "coefficients_a", "coefficients_b", "coefficients_c", "first"];

/// What it sends to the backing store, and for a quadratic tree.
pub(super) const SAVES: [&str; 3] = ["save_claim", "save_region", "save_plane"];
pub(super) const CURVE: [&str; 3] = ["curve_0_d", "curve_0_e", "curve_0_f"];

/// An instruction that was taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    /// Its number, of all that were taken.
    pub number: usize,
    pub instruction: Instruction<u64>,
    pub code: Microcode<u64>,
    pub times: Times,
    /// The coefficients of the curve before it.
    pub curve: [u64; 3],
}

impl Taken {
    pub fn is_expression(&self) -> bool {
        self.code.source == Source::Expression.code()
    }

    /// The bit of its word that is sent in that clock.
    fn bit(&self, clock: u64) -> Option<u64> {
        let first = self.times.ends - self.instruction.length;
        clock.checked_sub(first).filter(|_| clock < self.times.ends)
    }
}

/// The model of a controller.
pub(super) struct Commands {
    schedule: Schedule,
    lag: u64,
    quadratic: bool,
    count: usize,
    /// The coefficients of a curve whose expression has not come.
    curve: [u64; 3],
    /// The instruction that was last offered, and what it needs.
    offered: Option<(Instruction<u64>, Clocks)>,
    /// Instructions whose bits are under way, to the pixels.
    pub under_way: VecDeque<Taken>,
}

impl Commands {
    pub fn new(lag: u32, quadratic: bool, side_by_side: bool) -> Commands {
        Commands {
            schedule: Schedule::new(side_by_side),
            lag: lag.into(),
            quadratic,
            count: 0,
            curve: [0; 3],
            offered: None,
            under_way: VecDeque::new(),
        }
    }

    /// Compares all outputs in a clock. Returns the instruction that is taken.
    pub fn look(
        &mut self,
        clock: u64,
        nets: &[u64; 28],
        [claim, region, plane]: [u64; 3],
        curve: [u64; 3],
        checks: &mut Checks,
    ) -> Option<Taken> {
        let [valid, ready, operation, skip, length, read, write, a, b, c, _, store_free, rest @ ..] = *nets;
        self.under_way.retain(|it| clock <= it.times.ends + self.lag);
        self.coefficients(clock, &rest, curve, checks);
        let is_plane = self.control(clock, &rest, checks);
        checks.bit("save_plane", plane, is_plane);

        let coefficients = tilewright_rtl::pixel_planes::linear_tree::Coefficients { a, b, c };
        let instruction = Instruction { operation, skip, length, read, write, coefficients };
        let is_instruction = valid == 1 && (operation as usize) < Operation::ALL.len() && (1..=64).contains(&length);
        let clocks = is_instruction.then(|| self.offers(instruction));
        let may = clocks.map(|step| clock >= self.schedule.ready(&step) && (!step.saves || store_free == 1));
        if let Some(may) = may {
            checks.bit("instructions_ready", ready, may);
        }
        let is_idle = valid == 0 && (self.count == 0 || clock >= self.schedule.idle());
        checks.bit("idle", rest[15], is_idle);
        let taken = clocks.filter(|_| valid & ready == 1).map(|step| self.take(clock, instruction, &step));
        let claims = clocks.is_some_and(|step| step.saves) && valid & ready == 1;
        checks.bit("save_claim", claim, claims);
        if claims {
            checks.same("save_region", region, c & 0xffff);
        }
        taken
    }

    /// What an instruction needs.
    fn offers(&mut self, instruction: Instruction<u64>) -> Clocks {
        match self.offered {
            Some((before, clocks)) if before == instruction => clocks,
            _ => self.offered.insert((instruction, Clocks::from(&instruction))).1,
        }
    }

    fn take(&mut self, clock: u64, instruction: Instruction<u64>, step: &Clocks) -> Taken {
        let times = self.schedule.take_at(step, clock);
        let code = instruction.microcode();
        let mut taken = Taken { number: self.count, instruction, code, times, curve: [0; 3] };
        self.count += 1;
        if instruction.operation == Operation::Curve as u64 {
            let c = instruction.coefficients;
            self.curve = [c.a, c.b, c.c];
        } else if taken.is_expression() {
            taken.curve = std::mem::take(&mut self.curve);
        }
        self.under_way.push_back(taken);
        taken
    }

    /// Compares the bits for the tree.
    fn coefficients(&self, clock: u64, sent: &[u64; 16], curve: [u64; 3], checks: &mut Checks) {
        let is_sent = |it: &&Taken| it.is_expression() && (it.times.begins..it.times.ends).contains(&clock);
        let expression = self.under_way.iter().find(is_sent);
        checks.bit("first", sent[3], expression.is_some_and(|it| it.times.begins == clock));
        let Some(it) = expression else { return };
        let (bit, of) = (clock - it.times.begins, it.instruction.coefficients);
        let names = ["coefficients_a", "coefficients_b", "coefficients_c"];
        for ((name, seen), number) in names.into_iter().zip(&sent[..3]).zip([of.a, of.b, of.c]) {
            checks.bit(name, *seen, bit_of(number, bit));
        }
        if self.quadratic {
            for ((name, seen), number) in CURVE.into_iter().zip(curve).zip(it.curve) {
                checks.bit(name, seen, bit_of(number, bit));
            }
        }
    }

    /// Compares what of the pixels' control has an effect. Returns whether a plane is saved.
    fn control(&self, clock: u64, sent: &[u64; 16], checks: &mut Checks) -> bool {
        let [_, _, _, _, source, constant, adds, first, mask, compares, gates, enabling, captures, read, write, _] =
            *sent;
        let Some(sent_in) = clock.checked_sub(self.lag) else { return false };
        let words = || self.under_way.iter().filter_map(|it| Some((it, it.bit(sent_in)?)));
        let on_memory = words().find(|(it, _)| it.code.on_memory == 1);
        let on_tree = words().find(|(it, _)| it.code.on_tree == 1);
        let code = on_memory.map(|(it, _)| it.code);
        let of = |of: fn(&Microcode<u64>) -> u64| code.as_ref().map_or(0, of);
        let (will_mask, will_add, will_compare) = (of(|it| it.mask), of(|it| it.adds), of(|it| it.compares));
        let saves = of(|it| it.saves) == 1;
        checks.same("control_mask", mask, will_mask);
        checks.same("control_adds", adds, will_add);
        checks.same("control_compares", compares, will_compare);
        let works = will_mask != Mask::Nobody.code() || will_add + will_compare > 0;
        if let (Some((it, bit)), Some(code)) = (on_memory, code.as_ref()) {
            if works {
                checks.same("control_source", source, code.source);
            }
            if works && code.source == Source::Constant.code() {
                checks.bit("control_constant", constant, bit_of(it.instruction.coefficients.c, bit));
            }
            if will_add + will_compare > 0 {
                checks.bit("control_first", first, code.begins == 1 && bit == 0);
            }
            if will_compare == 1 {
                checks.same("control_gates", gates, code.gates);
            }
            if saves || will_add + will_compare > 0 || works && code.source == Source::Memory.code() {
                checks.same("control_read", read, it.instruction.read + bit);
            }
            if saves || will_mask != Mask::Nobody.code() {
                checks.same("control_write", write, it.instruction.write + bit);
            }
        }
        let last = on_tree.filter(|(it, bit)| bit + 1 == it.instruction.length).map(|(it, _)| it.code);
        checks.same("control_enabling", enabling, last.as_ref().map_or(Enabling::Keep.code(), |code| code.enabling));
        checks.same("control_captures", captures, last.as_ref().map_or(0, |code| code.captures));
        saves
    }
}
