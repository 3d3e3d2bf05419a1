//! The ring clock by clock, and against a plain loop with round robin.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::linear_tree::Coefficients;
use super::*;

/// An instruction identified by a number.
fn instruction(number: u64) -> Instruction<u64> {
    let coefficients = Coefficients { a: 0, b: 0, c: number };
    Instruction { operation: 0, skip: 0, length: 1, read: 0, write: 0, coefficients }
}

/// The inputs of the ring: the numbers of instructions, and regions' planes.
#[derive(Debug, Clone)]
struct Waiting {
    bins: Vec<Option<u64>>,
    room: Vec<bool>,
    finished: Vec<Option<BitPlane<u64>>>,
}

impl Waiting {
    fn inputs(&self) -> RingIn<u64> {
        let none = BitPlane { region: 0, line: 0, plane: 0, bits: 0 };
        RingIn {
            bins: self.bins.iter().map(|bin| Stream::of(bin.is_some().into(), instruction(bin.unwrap_or(0)))).collect(),
            room: (0..).zip(&self.room).map(|(number, room)| u64::from(*room) << number).sum(),
            finished: self.finished.iter().map(|it| Stream::of(it.is_some().into(), it.unwrap_or(none))).collect(),
        }
    }
}

/// The ring by its rules.
struct Plain {
    ring: Ring,
    credit: u32,
    last: Option<usize>,
    line_of: Option<usize>,
}

impl Plain {
    fn new(ring: &Ring) -> Plain {
        Plain { ring: ring.clone(), credit: ring.most_credit(), last: None, line_of: None }
    }

    /// The numbers of the stations whose message passes in a clock, in the sequence of arbitration.
    fn clock(&mut self, waiting: &Waiting) -> Vec<usize> {
        let renderers = waiting.bins.len();
        let stations = 2 * renderers;
        let first = self.last.map_or(0, |last| last + 1);
        let (mut goes, mut line_of, mut plane_goes) = (Vec::new(), self.line_of, false);
        for station in (first..first + stations).map(|station| station % stations) {
            let plane = station.checked_sub(renderers);
            let wants = match plane {
                None => waiting.bins[station].is_some() && waiting.room[station],
                Some(number) => {
                    let has_line = self.line_of.is_none_or(|other| other == number);
                    waiting.finished[number].is_some() && has_line && !plane_goes
                }
            };
            if !wants {
                continue;
            }
            let bits = if plane.is_some() { self.ring.side } else { Ring::INSTRUCTION };
            if self.credit < bits {
                break;
            }
            self.credit -= bits;
            goes.push(station);
            if let Some(number) = plane {
                plane_goes = true;
                let is_last = waiting.finished[number].expect("it goes").plane == 47;
                line_of = (!is_last).then_some(number);
            }
        }
        (self.last, self.line_of) = (goes.last().copied().or(self.last), line_of);
        self.credit = (self.credit + self.ring.rate).min(self.ring.most_credit());
        goes
    }
}

type Running = Simulation<RingIn, RingOut>;

fn started(ring: &Ring) -> Running {
    let mut sim = Simulation::of(ring).unwrap();
    sim.reset();
    let ready: Vec<_> = sim.o.instructions.iter().map(|out| out.ready).chain([sim.o.planes.ready]).collect();
    ready.into_iter().for_each(|port| sim.set(port, 1));
    sim
}

/// The messages of a clock: the number of the instruction that each renderer gets, and the plane.
fn clock(sim: &mut Running, waiting: &Waiting) -> (Vec<Option<u64>>, Option<BitPlane<u64>>) {
    sim.drive(waiting.inputs());
    let out = sim.read_u64();
    let shown = out.instructions.iter().map(|out| (out.valid == 1).then_some(out.payload.coefficients.c)).collect();
    let plane = (out.planes.valid == 1).then_some(out.planes.payload);
    (shown, plane)
}

#[test]
fn an_instruction_has_as_many_bits_as_its_fields() {
    let mut bits = 0;
    let _ = Instruction::widths().map(|width: &Width| {
        bits += width.bits();
        *width
    });
    assert_eq!(bits, Ring::INSTRUCTION);
}

#[test]
fn all_take_turns_as_long_as_the_credit_lasts() {
    let ring = Ring { renderers: 2, side: 8, rate: 80 };
    let mut sim = started(&ring);
    let wave = sim.record([
        "room[0]",
        "room[1]",
        "credit",
        "instructions_0_valid",
        "instructions_1_valid",
        "planes_valid",
        "planes_region",
    ]);
    let plane = |region| Some(BitPlane { region, line: 0, plane: 47, bits: 0 });
    for clock in 0..8 {
        let room = vec![true, !(2..=4).contains(&clock)];
        sim.drive(Waiting { bins: vec![Some(1), Some(2)], room, finished: vec![plane(3), plane(4)] }.inputs());
        sim.step();
    }
    // While an instruction waits for its 154 bits, a plane of 8 bits after it waits, too.
    wave.expect(
        r"
        clk                  |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        room[0]              |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        room[1]              |~~~~~~~~~\______________/~~~~~~~~~~~~~~~
        credit               | e9 | 9f | 55 | 9d | e5 | 93 | db | 91 |
        instructions_0_valid |~~~~\______________/~~~~\____/~~~~\_____
        instructions_1_valid |____/~~~~\______________________________
        planes_valid         |_________/~~~~~~~~~~~~~~~~~~~\__________
        planes_region        | 3            | 4  | 3  | 4  | 3       |
        ",
    );
}

#[test]
fn the_planes_of_a_line_stay_together() {
    let mut sim = started(&Ring { renderers: 3, side: 8, rate: 1000 });
    let mut next = [[7, 44], [8, 46], [9, 47]];
    let mut seen = Vec::new();
    for _ in 0..10 {
        let plane = |[region, plane]: [u64; 2]| Some(BitPlane { region, line: 0, plane, bits: 0 });
        let finished = next.map(plane).to_vec();
        let gone = clock(&mut sim, &Waiting { bins: vec![None; 3], room: vec![true; 3], finished }).1;
        let gone = gone.expect("there is always one, and credit for it");
        seen.push(gone.region);
        let of = &mut next[gone.region as usize - 7];
        of[1] = if of[1] == 47 { 47 } else { of[1] + 1 };
        sim.step();
    }
    assert_eq!(seen, [7, 7, 7, 7, 8, 8, 9, 7, 8, 9]);
}

#[test]
fn what_goes_has_to_be_taken_and_only_that() {
    for slow in 0..3 {
        let mut sim = started(&Ring { renderers: 2, side: 8, rate: 1000 });
        let mut waiting = Waiting { bins: vec![None; 2], room: vec![true; 2], finished: vec![None; 2] };
        let mut ready = [sim.o.instructions[0].ready, sim.o.instructions[1].ready, sim.o.planes.ready].into_iter();
        sim.set(ready.nth(slow).unwrap(), 0);
        sim.drive(waiting.inputs());
        sim.step();
        let message = match slow {
            0 | 1 => {
                waiting.bins[slow] = Some(1);
                "a queue that has room takes an instruction"
            }
            _ => {
                waiting.finished[0] = Some(BitPlane { region: 0, line: 0, plane: 0, bits: 0 });
                "the frame buffer takes each plane"
            }
        };
        sim.drive(waiting.inputs());
        let problem = sim.try_step().unwrap_err().to_string();
        assert!(problem.contains(message), "{problem}");
    }
}

#[test]
fn a_rate_has_to_be_a_number_of_bits_in_each_clock() {
    let complaint = |megabits| Ring::bits_a_clock(megabits).unwrap_err().to_string();
    let sentence = "a ring of 5001 Mbit/s: it carries a whole number of bits in each clock of 25 ns, \
                    so it has to be a multiple of 40 from 40 to 327680";
    assert_eq!(complaint(5001), sentence);
    assert!(complaint(0).starts_with("a ring of 0 Mbit/s"));
    assert!(complaint(327_720).ends_with("from 40 to 327680"));
    assert_eq!([40, 5000, 327_680].map(|megabits| Ring::bits_a_clock(megabits).unwrap()), [1, 125, 8192]);
    let is_refused = |renderers, side, rate| Ring { renderers, side, rate }.checked().is_err();
    assert!(!is_refused(1, 8, 8192) && is_refused(0, 8, 1) && is_refused(1, 9, 1) && is_refused(1, 8, 8193));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    /// Every message in its clock, and in any interval no more bits than the rate allows plus one message.
    #[test]
    fn messages_go_as_their_turns_are_taken(
        (renderers, side) in (1..5u32, prop::sample::select(vec![8u32, 32, 256])),
        rate in prop_oneof![1..60u32, 100..300u32, 300..1500u32],
        seed in any::<u64>(),
        percent in prop::array::uniform3(20..100u64),
    ) {
        let ring = Ring { renderers, side, rate };
        let mut sim = started(&ring);
        let mut plain = Plain::new(&ring);
        let count = renderers as usize;
        let mut waiting = Waiting { bins: vec![None; count], room: vec![true; count], finished: vec![None; count] };
        let mut next_plane = vec![0; count];
        let mut state = seed | 1;
        let mut chance = |percent: u64| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state >> 32 < (percent << 32) / 100
        };
        let mut sent = Vec::new();
        for now in 0..400u64 {
            for (number, next) in next_plane.iter_mut().enumerate() {
                waiting.room[number] = chance(percent[0]);
                if waiting.bins[number].is_none() && chance(percent[1]) {
                    waiting.bins[number] = Some(now << 8 | number as u64);
                }
                if waiting.finished[number].is_none() && chance(percent[2]) {
                    // The last few planes of lines, so that many lines end.
                    let plane = *next;
                    let bits = now % 256;
                    waiting.finished[number] = Some(BitPlane { region: number as u64, line: now % 8, plane, bits });
                    *next = if plane == 47 { 40 } else { plane + 1 };
                }
            }
            let (instructions, plane) = clock(&mut sim, &waiting);
            let goes = plain.clock(&waiting);
            let mut expected = (vec![None; count], None);
            let mut bits = 0;
            for station in goes {
                match station.checked_sub(count) {
                    None => {
                        expected.0[station] = waiting.bins[station];
                        bits += Ring::INSTRUCTION;
                    }
                    Some(number) => {
                        expected.1 = waiting.finished[number];
                        bits += side;
                    }
                }
            }
            sent.push(u64::from(bits));
            prop_assert_eq!(&(instructions, plane), &expected, "clock {}", now);
            for (bin, gone) in waiting.bins.iter_mut().zip(&expected.0) {
                *bin = bin.filter(|_| gone.is_none());
            }
            if let Some(plane) = expected.1 {
                waiting.finished[plane.region as usize] = None;
            }
            sim.step();
        }
        for begin in (0..sent.len()).step_by(7) {
            for clocks in [1, 2, 5, 50] {
                let bits: u64 = sent[begin..].iter().take(clocks).sum();
                let message = u64::from(Ring::INSTRUCTION.max(side));
                prop_assert!(bits < clocks as u64 * u64::from(rate) + message);
            }
        }
    }
}
