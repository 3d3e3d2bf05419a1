//! The Verilog of every block, at small and at uneven sizes, and of every chip: no linter complains, and Icarus agrees with the simulator.

use crate::pins::sdram::on_pads::random_requests;
use crate::{chips, formal};
use tilewright_blocks::catalog::ENTRIES;
use tilewright_blocks::*;
use tilewright_gen::{VerilogFile, testbench, tools, verilog};
use tilewright_hdl::ir::{self, Input, Kind};
use tilewright_hdl::{Block, Clock, Design, Module, Period, Reset, Width, below, elaborate, stream};
use tilewright_sim::Simulation;

fn designed<B: Block>(block: B) -> (String, Design) {
    (format!("{block:?}"), elaborate(&block).unwrap())
}

fn blocks() -> Vec<(String, Design)> {
    let clocks = (Clock::new("write", Period::ns(4)), Clock::new("read", Period::ns(6)));
    let mut blocks = Vec::new();
    for depth in [1, 2, 5, 16] {
        for storage in [Storage::Registers, Storage::BlockRam] {
            blocks.push(designed(Fifo::new(depth, 8, storage)));
        }
    }
    for depth in [1, 2, 5] {
        blocks.push(designed(Lifo::new(depth, 8)));
    }
    for cuts in [Slice::Forward, Slice::Backward, Slice::Both] {
        blocks.push(designed(RegisterSlice { width: 1, cuts }));
        blocks.push(designed(RegisterSlice { width: 70, cuts }));
    }
    for count in [1, 2, 5] {
        blocks.push(designed(Fork::new(count, 8)));
        blocks.push(designed(Split::new(count, 8)));
        blocks.push(designed(Join::new(count, 3)));
        blocks.push(designed(Decoder::new(count + 1)));
        blocks.push(designed(Encoder::new(count + 1)));
        blocks.push(designed(PriorityEncoder::new(count + 1)));
        blocks.push(designed(Arbiter::new(count, 8, Turns::RoundRobin)));
        blocks.push(designed(Arbiter::new(count, 8, Turns::Priority)));
        blocks.push(designed(Narrow::new(count, 8)));
        blocks.push(designed(Widen::new(count, 8)));
        blocks.push(designed(Counter::new(count.into())));
        blocks.push(designed(ShiftRegister::new(count + 1)));
        blocks.push(designed(Lfsr::new(count + 1)));
    }
    for depth in [2, 16] {
        blocks.push(designed(DualClockFifo::new(depth, 8, clocks.0, clocks.1)));
    }
    for depth in [4, 5] {
        blocks.push(designed(Ram::new(depth, 3)));
        blocks.push(designed(DualClockRam::new(depth, 2, clocks.0, clocks.1)));
        blocks.push(designed(VectorRegisters::new(depth, 2, 5)));
    }
    blocks.push(designed(Multiplier::new(6, 1)));
    blocks.push(designed(Multiplier::new(6, 3)));
    for (sums, factor) in [(2, 1), (4, 3), (5, 4)] {
        blocks.push(designed(MultiplyAccumulate::new(sums, factor, 2 * factor + 1)));
    }
    for words in [2, 5, 8] {
        blocks.push(designed(Minimum::new(words, 3)));
        blocks.push(designed(PipelinedMinimum::new(words, 3)));
    }
    blocks.push(designed(BoxFilter::new(2, 2, 1)));
    blocks.push(designed(BoxFilter::new(3, 5, 3)));
    blocks.push(designed(Shifter::new(9)));
    blocks.push(designed(Rotator::new(2)));
    blocks.push(designed(Rotator::new(9)));
    blocks.push(designed(SevenSegment));
    blocks.push(designed(FromDecimal::new(1)));
    blocks.push(designed(FromDecimal::new(4)));
    blocks.push(designed(UpDownCounter::new(2)));
    blocks.push(designed(UpDownCounter::new(5)));
    blocks.push(designed(Divider::new(5)));
    blocks.push(designed(SquareRoot::new(3)));
    blocks.push(designed(SineCosine::new(8)));
    blocks.push(designed(Crc::new(16, 0x1021, 0xffff, BitOrder::MostFirst)));
    blocks.push(designed(Crc::new(5, 0x05, 0x1f, BitOrder::LeastFirst)));
    blocks.push(designed(Quadrature::new(4)));
    for (clocks, idle) in [(1, true), (5, false)] {
        blocks.push(designed(Debouncer { clocks, idle }));
    }
    for (mode, half_period) in (0..4).zip([1, 1, 2, 3]) {
        blocks.push(designed(SpiMaster { width: 5 - mode, half_period, mode }));
    }
    for (nanoseconds, bytes, late) in [(8, 1, 2), (10, 2, 0), (15, 4, 1)] {
        let usual = SdramController::of_32_megabytes(Period::ns(nanoseconds));
        blocks.push(designed(SdramController { power_up: 2, bytes, late, ..usual }));
    }
    for (half_period, fast) in [(1, false), (2, true)] {
        blocks.push(designed(SpiFlashReader { half_period, fast, length: 1 + half_period }));
    }
    for (low, high, filter) in [(5, 2, 1), (9, 11, 3)] {
        blocks.push(designed(I2cMaster { low, high, filter }));
    }
    blocks.push(designed(TmdsEncoder));
    for (columns, rows) in [
        (Scan::new(5, [1, 2, 3], false), Scan::new(3, [2, 1, 0], true)),
        (Scan::new(1, [0, 1, 0], true), Scan::new(2, [0, 2, 1], false)),
    ] {
        blocks.push(designed(VideoTiming { columns, rows }));
    }
    for (width, places, kept, ties) in [(5, 2, 1, Ties::Up), (8, 3, 6, Ties::Even), (9, 1, 3, Ties::Even)] {
        blocks.push(designed(CountOnes { width: width - 4 }));
        blocks.push(designed(Quantizer { width, places, kept, ties }));
    }
    for (width, registers, status) in [(32, 1, 0), (64, 2, 1)] {
        blocks.push(designed(AxiLiteRegisters { address: 5, width, registers, status }));
        blocks.push(designed(ToAxiStream { lanes: 2 * registers - 1 }));
        blocks.push(designed(FromAxiStream { lanes: 2 * registers - 1 }));
    }
    blocks.push(designed(PowerOnReset::new(3)));
    for reset in [Reset::Asynchronous, Reset::AsynchronousLow] {
        blocks.push(designed(ResetSynchronizer::new(Clock::new("board", Period::ns(20)).reset(reset))));
    }
    blocks.push(designed(Ticks::new(5)));
    blocks
}

#[test]
fn no_linter_complains_of_any_block() {
    let blocks: Vec<_> = blocks().into_iter().chain(chips::designs()).collect();
    let printed: Vec<Vec<VerilogFile>> = blocks.iter().map(|(_, design)| verilog(design)).collect();
    let files: Vec<&[VerilogFile]> = printed.iter().map(Vec::as_slice).collect();
    let wrong = tools::lint_all(&files).err().unwrap_or_default();
    let wrong: Vec<String> =
        wrong.iter().map(|(&place, problems)| format!("{}: {problems}", blocks[place].0)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A valid number for an input: a code of its enum, a one-hot code, a receiver's number, or an address of the memory.
fn allowed(module: &ir::Module, input: &Input, number: u64) -> u64 {
    let node = module.node(input.node);
    let number = number & (u64::MAX >> (64 - (node.width * node.shape.lanes()).min(56)));
    match (node.kind, module.memories.first()) {
        _ if input.name == "one_hot" => 1 << (number % u64::from(node.width)),
        _ if input.name == "into_to" => {
            let receivers = module.outputs.iter().filter(|output| output.name.ends_with("_valid")).count();
            number % receivers as u64
        }
        (Kind::Code(names), _) => names.values[(number % names.values.len() as u64) as usize],
        (_, Some(memory)) if below(memory.depth).bits() == node.width => number % u64::from(memory.depth),
        _ => number,
    }
}

/// Random inputs; both simulators start every memory with zeros.
#[test]
fn icarus_repeats_every_block() {
    let mut chance = 1u64;
    // What is at the inputs of the other chips is no random input.
    let alone = chips::designs().filter(|(_, design)| design.top().inputs.is_empty());
    for (name, design) in blocks().into_iter().chain(alone) {
        let mut sim = Simulation::from_design(&design).unwrap();
        let recording = sim.recording();
        sim.reset();
        let inputs: Vec<_> = design.top().inputs.iter().collect();
        for _ in 0..100 {
            for input in &inputs {
                chance ^= chance << 13;
                chance ^= chance >> 7;
                chance ^= chance << 17;
                let port = sim.port(&input.name).unwrap();
                sim.set(port, allowed(design.top(), input, chance >> 8));
            }
            // A read of a word that another clock writes may return anything.
            if let (Ok(to), Ok(from)) = (sim.peek("to"), sim.port("from")) {
                let depth = u64::from(design.top().memories[0].depth);
                sim.set(from, (to.to_u64().unwrap() + 1) % depth);
            }
            sim.step();
        }
        let bench = testbench(&design, &recording.take());
        if let Err(problems) = tools::replay_in_icarus(&verilog(&design), &bench) {
            panic!("{name}: {problems}");
        }
    }
}

/// With what a memory shows on the pads.
#[test]
fn others_repeat_a_memory_at_pads() {
    let (files, bench) = random_requests();
    let _ = tools::replay_in_icarus(&files, &bench).unwrap();
    let _ = tools::replay_in_verilator(&files, &bench).unwrap();
}

/// Passes digits on, and counts them up to 9.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Taken {
    is_assumed: bool,
}

impl Block for Taken {
    type In = StreamIn;
    type Out = StreamOut;

    fn inputs(&self) -> StreamIn<Width> {
        StreamIn { into: stream(4) }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let is_one = i.into.valid.implies(i.into.payload.le(9));
        if self.is_assumed {
            m.assume(is_one, "a digit is below 10");
        } else {
            m.assert(is_one, "a digit is below 10");
        }

        let taken = m.reg("taken", 4).reset(0);
        taken.when(i.into.valid & i.into.ready & taken.ne(9), taken + 1);
        m.assert(taken.le(9), "the count stays at 9");
        StreamOut { out: i.into }
    }
}

#[test]
fn no_input_that_is_assumed_breaks_an_assertion() {
    if formal::is_there() {
        let broken = |is_assumed| formal::broken(&elaborate(&Taken { is_assumed }).unwrap(), 6);
        assert!(broken(false).is_some() && broken(true).is_none(), "{:?}", broken(true));
    }
    for entry in ENTRIES {
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        assert_eq!(formal::broken(&design, 6), None, "{}", entry.name);
    }
    for (name, design) in blocks() {
        assert_eq!(formal::broken(&design, 6), None, "{name}");
    }
}
