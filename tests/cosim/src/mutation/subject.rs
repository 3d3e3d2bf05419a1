//! The blocks that mutants are made of.

use super::suite::{BLOCKS, Crate, RTL};
use tilewright_blocks::{
    Arbiter, AxiLiteRegisters, BitOrder, Counter, Crc, Debouncer, Divider, DualClockFifo, DualClockRam, Fifo, Fork,
    FromAxiStream, I2cMaster, Lfsr, Multiplier, Narrow, PowerOnReset, Quadrature, Quantizer, Ram, RegisterSlice,
    ResetSynchronizer, Scan, SdramController, ShiftRegister, Shifter, SineCosine, Slice, SpiFlashReader, SpiMaster,
    SquareRoot, Storage, Ticks, Ties, TmdsEncoder, ToAxiStream, Turns, VectorRegisters, VideoTiming, Widen,
};
use tilewright_hdl::{Block, Clock, Design, Period, Reset, elaborate};
use tilewright_mutants::{Mutant, mutants};
use tilewright_rtl::catalog::{ENTRIES, Entry};

/// A block in one size, with the mutants of its own module that keep the rules of circuits.
pub struct Subject {
    /// The block's name in the catalogue, or that of its module.
    pub name: String,
    /// The crate whose tests have to find the mutants.
    pub of: Crate,
    /// The path of the tests of the block, such as `lfb::unit::`; nothing if all of the crate are.
    pub tests: String,
    /// The block itself.
    pub design: Design,
    /// Its mutants.
    pub mutants: Vec<Mutant>,
}

impl Subject {
    fn new(name: &str, of: Crate, tests: String, design: Design) -> Subject {
        let all = mutants(design.top());
        let mut subject = Subject { name: name.to_owned(), of, tests, design, mutants: Vec::new() };
        subject.mutants = all.into_iter().filter(|mutant| subject.with(mutant).is_some()).collect();
        subject
    }

    /// The design with a mutant in the place of its top, unless that breaks a rule.
    pub fn with(&self, mutant: &Mutant) -> Option<Design> {
        let mut modules = self.design.modules().to_vec();
        *modules.last_mut()? = mutant.module.clone();
        Design::new(modules).ok()
    }
}

/// Every block of the catalogue in its default size, then each of `blocks`: those that are asked for, by crate and name.
pub fn subjects(asked: impl Fn(Crate, &str) -> bool) -> Vec<Subject> {
    let entry = |entry: &Entry| {
        let values = entry.values([]).expect("nothing is set");
        let design = entry.design(&values).expect("every default goes together");
        let tests = tests_in(design.top().loc.file());
        Subject::new(entry.name, RTL, tests, design)
    };
    let entries = ENTRIES.iter().filter(|entry| asked(RTL, entry.name)).map(entry);
    let blocks = blocks().into_iter().filter(|design| asked(BLOCKS, &design.top().name));
    let block = |design: Design| Subject::new(&design.top().name.clone(), BLOCKS, String::new(), design);
    entries.chain(blocks.map(block)).collect()
}

/// Files without tests, each with that whose tests are meant: of a block that this one is a part of, or of the block that begins there.
const PARTS: [(&str, &str); 5] = [
    ("pixelflow/controller/slot", "pixelflow/controller"),
    ("quadtree/stack", "quadtree/raster"),
    ("quadtree/pipe", "quadtree/raster"),
    ("quadtree/tree", "quadtree/raster"),
    ("quadtree/processor", "quadtree/generator"),
];

/// The path of the tests in a file of `rtl`, or in files below it.
fn tests_in(file: &str) -> String {
    let file = file.strip_prefix("rtl/src/").expect("the catalogue's blocks are in `rtl`");
    let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
    let path = PARTS.iter().find(|(part, _)| *part == path).map_or(path, |(_, whole)| whole);
    format!("{}::", path.replace('/', "::"))
}

/// The blocks of the library, each in the variants that are circuits of their own.
fn blocks() -> Vec<Design> {
    let clocks = [Clock::new("write", Period::ns(4)), Clock::new("read", Period::ns(6))];
    let slices = [Slice::Forward, Slice::Backward, Slice::Both].map(|cuts| design(&RegisterSlice { width: 8, cuts }));
    let others = [
        design(&Fifo::new(5, 8, Storage::Registers)),
        design(&Fifo::new(5, 8, Storage::BlockRam)),
        design(&DualClockFifo::new(4, 8, clocks[0], clocks[1])),
        design(&Fork::new(3, 8)),
        design(&Arbiter::new(3, 8, Turns::RoundRobin)),
        design(&Arbiter::new(3, 8, Turns::Priority)),
        design(&Narrow::new(3, 8)),
        design(&Widen::new(3, 8)),
        design(&Counter::new(10)),
        design(&ShiftRegister::new(6)),
        design(&Lfsr::new(8)),
        design(&Quadrature::new(4)),
        design(&Debouncer { clocks: 3, idle: false }),
        design(&SpiMaster { width: 3, half_period: 2, mode: 1 }),
        design(&SdramController { power_up: 5, ..SdramController::of_32_megabytes(Period::ns(10)) }),
        design(&SpiFlashReader { half_period: 1, fast: false, length: 4 }),
        design(&I2cMaster { low: 6, high: 4, filter: 1 }),
        design(&VideoTiming { columns: Scan::new(3, [1, 2, 1], false), rows: Scan::new(2, [1, 1, 1], true) }),
        design(&TmdsEncoder),
        design(&AxiLiteRegisters { address: 4, width: 32, registers: 2, status: 1 }),
        design(&ToAxiStream { lanes: 3 }),
        design(&FromAxiStream { lanes: 3 }),
        design(&Quantizer { width: 8, places: 3, kept: 4, ties: Ties::Even }),
        design(&PowerOnReset::new(3)),
        design(&ResetSynchronizer::new(Clock::new("board", Period::ns(4)).reset(Reset::Asynchronous))),
        design(&Ticks::new(5)),
        design(&Ram::new(5, 2)),
        design(&DualClockRam::new(5, 2, clocks[0], clocks[1])),
        design(&VectorRegisters::new(5, 2, 4)),
        design(&Multiplier::new(6, 3)),
        design(&Shifter::new(8)),
        design(&Divider::new(4)),
        design(&SquareRoot::new(3)),
        design(&SineCosine::new(6)),
        design(&Crc::new(16, 0x1021, 0xffff, BitOrder::MostFirst)),
    ];
    slices.into_iter().chain(others).collect()
}

fn design<B: Block>(block: &B) -> Design {
    elaborate(block).expect("the library's blocks can be built")
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_mutants::mutated;

    #[test]
    fn every_block_has_mutants_that_are_found_again_by_their_sentences() {
        for subject in subjects(|_, _| true) {
            let mut sentences: Vec<String> = subject.mutants.iter().map(Mutant::to_string).collect();
            assert!(sentences.len() >= 4, "{} has {} mutants", subject.name, sentences.len());
            let middle = sentences.len() / 2;
            let again =
                mutated(&subject.design, &sentences[middle]).expect("the sentence names a mutant of the design");
            assert_eq!(format!("{:?}", again.top()), format!("{:?}", subject.mutants[middle].module));
            sentences.sort_unstable();
            sentences.dedup();
            assert_eq!(sentences.len(), subject.mutants.len(), "two mutants of {} have one sentence", subject.name);
        }
    }

    #[test]
    fn the_tests_of_a_block_are_in_its_file() {
        assert_eq!(tests_in("rtl/src/lfb/unit.rs"), "lfb::unit::");
        assert_eq!(tests_in("rtl/src/vc1/mod.rs"), "vc1::");
        assert_eq!(tests_in("rtl/src/quadtree/pipe.rs"), "quadtree::raster::");
    }

    /// Without tests every mutant would survive.
    #[test]
    fn every_block_of_the_machines_has_tests() {
        for entry in ENTRIES {
            let design = entry.design(&entry.values([]).unwrap()).unwrap();
            let tests = tests_in(design.top().loc.file());
            let path = format!("../../rtl/src/{}", tests.trim_end_matches("::").replace("::", "/"));
            let sources = [format!("{path}.rs"), format!("{path}/mod.rs")].map(std::fs::read_to_string);
            let source = sources.into_iter().find_map(Result::ok).expect("the module has a file");
            assert!(source.contains("mod tests"), "{} has no tests in {path}", entry.name);
        }
    }
}
