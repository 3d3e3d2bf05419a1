//! A controller of a memory, against a chip that is a program.

mod chip;
mod exact;
pub mod on_pads;
mod predicted;
mod traffic;

use chip::{Cells, Chip, Seen, Sheet};
use proptest::prelude::*;
use std::collections::VecDeque;
use tilewright_blocks::*;
use tilewright_hdl::{Period, Stream};
use tilewright_sim::{Port, Simulation, Testbench};

/// A request, as a program thinks of it: written bytes or none, a bank, a row and a column.
#[derive(Debug, Clone, Copy)]
struct Wish {
    write: Option<(u64, u64)>,
    bank: u64,
    row: u64,
    column: u64,
}

impl Wish {
    fn read(bank: u64, row: u64, column: u64) -> Wish {
        Wish { write: None, bank, row, column }
    }

    /// The same with numbers that the chip has.
    fn within(self, block: &SdramController) -> Wish {
        let bytes = (1 << block.bytes) - 1;
        let word = u64::MAX >> (64 - 8 * block.bytes);
        let write = self.write.map(|(data, strobe)| (data & word, strobe & bytes));
        Wish { write, column: self.column & ((1 << block.column_bits) - 1), ..self }
    }

    /// The request for a chip with so many bits of a column.
    fn request(self, columns: u32) -> SdramRequest<u64> {
        let address = self.row << (columns + 2) | self.bank << columns | self.column;
        let (data, strobe) = self.write.unwrap_or((0, 0));
        SdramRequest { write: self.write.is_some().into(), address, data, strobe }
    }
}

/// The words that are read, and the contents of all places in the end, of a plain array.
fn array(chip: &Chip, wishes: &[Wish]) -> (Vec<u64>, Cells) {
    let (mut words, mut array) = (Vec::new(), Cells::new());
    for wish in wishes {
        let place = (wish.bank, wish.row, wish.column);
        let word = array.entry(place).or_insert_with(|| chip.word(wish.bank, wish.row, wish.column));
        match wish.write {
            None => words.push(*word),
            Some((data, strobe)) => {
                let bits = (0..64).filter(|bit| strobe >> (bit / 8) & 1 == 1);
                *word = bits.fold(*word, |word, bit| word & !(1 << bit) | data & 1 << bit);
            }
        }
    }
    (words, array)
}

/// The pins that a chip sees.
#[derive(Debug, Clone, Copy)]
struct Lines {
    pins: SdramPins<Port>,
    dq_out: Port,
    dq_enable: Port,
    dq: Port,
    bytes: u32,
}

impl Lines {
    fn of(sim: &Simulation<SdramControllerIn, SdramControllerOut>, block: &SdramController) -> Lines {
        let (i, o) = (&sim.i, &sim.o);
        Lines { pins: o.pins, dq_out: o.dq_out, dq_enable: o.dq_enable, dq: i.dq, bytes: block.bytes }
    }

    fn all_ones(&self) -> u64 {
        u64::MAX >> (64 - 8 * self.bytes)
    }

    fn seen(&self, mut get: impl FnMut(Port) -> u64) -> Seen {
        let SdramPins { cke, cs_n, ras_n, cas_n, we_n, ba, a, dqm } = self.pins;
        let command = [cs_n, ras_n, cas_n, we_n].map(&mut get);
        let [cke, ba, a, dqm, dq, driven] = [cke, ba, a, dqm, self.dq_out, self.dq_enable].map(&mut get);
        Seen { cke, command, ba, a, dqm, dq, driven: driven == 1 }
    }

    /// Runs a chip whose words come `late` clocks late.
    async fn runs(&self, t: &Testbench<'_>, chip: &mut Chip, late: u32) {
        let mut delayed: VecDeque<_> = (0..late).map(|_| None).collect();
        loop {
            t.step().await;
            delayed.push_back(chip.edge(self.seen(|port| t.get_u64(port))));
            // Where nothing is driven, the bus shows something else each time.
            let nothing = t.time().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
            let word = delayed.pop_front().flatten().unwrap_or(nothing);
            t.set(self.dq, word & self.all_ones());
        }
    }
}

/// A controller for a chip of few rows, columns and refreshes, with its sheet.
fn systems() -> impl Strategy<Value = (SdramController, Sheet)> {
    let shape = (1u32..5, prop_oneof![Just(1u32), Just(2), Just(4)], 2u32..4, 0u32..3);
    let times = (1u32..5, 1u32..5, 1u32..9, 1u32..13, 1u32..10, 1u32..5, 1u32..4);
    (shape, times, 0u32..60, 1u32..20).prop_map(|(shape, times, spare, power_up)| {
        let (column_bits, bytes, cas_latency, late) = shape;
        let (rcd, rp, ras, rc, rfc, wr, mrd) = times;
        let latest = ras.max(rc).max(rcd + wr);
        let closed = ras.max(rc.saturating_sub(rp)).max(rcd + wr);
        let refresh = closed + rp + rcd + rfc + 4 + spare;
        let block = SdramController {
            row_bits: 11,
            column_bits,
            bytes,
            cas_latency,
            late,
            rcd,
            rp,
            ras,
            rc,
            rfc,
            wr,
            mrd,
            refresh,
            power_up,
        };
        (block.clone(), sheet(&block, latest))
    })
}

/// The sheet of a chip with 6 rows, one clock of which takes 1000 ps, where a refresh is late by `latest` clocks or less.
fn sheet(block: &SdramController, latest: u32) -> Sheet {
    let time = |clocks: u32| u64::from(clocks) * 1000;
    Sheet {
        clock: 1000,
        rcd: time(block.rcd),
        rp: time(block.rp),
        ras: time(block.ras),
        longest_ras: time(block.refresh + latest),
        rc: time(block.rc),
        rrd: time(block.rcd + 1),
        rfc: time(block.rfc),
        wr: time(block.wr),
        power_up: time(block.power_up),
        period: time(6 * block.refresh + latest),
        // The first refresh comes as much later.
        settled: block.rp + 2,
        rows: 6,
        mrd: block.mrd.into(),
        latency: block.cas_latency.into(),
        columns: block.column_bits,
        bytes: block.bytes,
    }
}

/// What an MT48LC16M16A2-75 demands at 100 MHz, by its data sheet.
fn micron() -> Sheet {
    Sheet {
        clock: 10_000,
        rcd: 20_000,
        rp: 20_000,
        ras: 44_000,
        longest_ras: 120_000_000,
        rc: 66_000,
        rrd: 15_000,
        rfc: 66_000,
        wr: 15_000,
        power_up: 100_000_000,
        period: 64_000_000_000,
        settled: 0,
        rows: 8192,
        mrd: 2,
        latency: 2,
        columns: 9,
        bytes: 2,
    }
}

/// A controller and a chip that are stepped together.
struct Rig {
    sim: Simulation<SdramControllerIn, SdramControllerOut>,
    lines: Lines,
    chip: Chip,
    delayed: VecDeque<Option<u64>>,
    block: SdramController,
    /// Clocks since the reset.
    clock: u64,
}

impl Rig {
    fn new(block: &SdramController, sheet: Sheet) -> Rig {
        let mut sim = Simulation::of(block).unwrap().seeded(5);
        sim.reset();
        sim.set(sim.o.words.ready, 1);
        let delayed = (0..block.late).map(|_| None).collect();
        Rig { lines: Lines::of(&sim, block), sim, chip: Chip::new(sheet), delayed, block: block.clone(), clock: 0 }
    }

    /// Goes through a clock: whether the request is taken, and the word that is shown.
    fn step(&mut self, wish: Option<Wish>) -> (bool, Option<u64>) {
        let request = wish.unwrap_or(Wish::read(0, 0, 0)).request(self.block.column_bits);
        let dq = self.sim.get_u64(self.lines.dq);
        self.sim.drive(SdramControllerIn { request: Stream::of(wish.is_some().into(), request), dq });
        let taken = wish.is_some() && self.sim.get_u64(self.sim.i.request.ready) == 1;
        let words = self.sim.o.words;
        let word = (self.sim.get_u64(words.valid) == 1).then(|| self.sim.get_u64(words.payload));
        let seen = self.lines.seen(|port| self.sim.get_u64(port));
        self.delayed.push_back(self.chip.edge(seen));
        self.sim.step();
        let driven = self.delayed.pop_front().flatten();
        self.sim.set(self.lines.dq, driven.unwrap_or(0xee));
        self.clock += 1;
        (taken, word)
    }

    /// Goes on until no more command comes: the chip is ready.
    fn start(&mut self) {
        let end = self.clock + 100_000;
        while self.chip.counts[0] == 0 {
            assert!(self.clock < end, "the controller does not begin");
            self.step(None);
        }
        (0..self.block.mrd).for_each(|_| {
            self.step(None);
        });
    }

    /// Asks for one after the other, as soon as each is taken. The result is the words, with the clocks in which they are
    /// shown.
    fn asks(&mut self, wishes: &[Wish]) -> Vec<(u64, u64)> {
        let reads = wishes.iter().filter(|wish| wish.write.is_none()).count();
        let (mut rest, mut words) = (wishes.iter(), Vec::new());
        let mut wish = rest.next();
        let end = self.clock + 100_000;
        while wish.is_some() || words.len() < reads {
            let clock = self.clock;
            assert!(clock < end, "nothing comes");
            let (taken, word) = self.step(wish.copied());
            words.extend(word.map(|word| (word, clock)));
            if taken {
                wish = rest.next();
            }
        }
        words
    }
}
