//! Memories of records.

use tilewright_gen::{tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    struct Entry<T> { resident: T, page: [T; 2] }
    struct TableIn<T> { write: T, address: T, entry: Entry<T> }
    struct TableOut<T> { read: Entry<T>, seen: Entry<T>, word: T }
}

/// A table with both kinds of reads, on another clock than its writes if it is `crossing`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Table {
    crossing: bool,
}

const FAST: Clock = Clock::new("fast", Period::ns(4));

fn entry() -> Entry<Width> {
    Entry { resident: bit(), page: [bits(4), bits(7)] }
}

impl Block for Table {
    type In = TableIn;
    type Out = TableOut;

    fn inputs(&self) -> TableIn<Width> {
        TableIn { write: bit(), address: below(6), entry: entry() }
    }

    fn build(&self, m: Module, i: TableIn) -> TableOut {
        let first = Entry { resident: 1, page: [2, 3] };
        let entries =
            m.memory("entries", 6, entry(), ReadUnderWrite::Old).words([first, Entry { page: [9, 100], ..first }]);
        assert_eq!((entries.width(), entries.address_width()), (12, 3));
        entries.write(i.write, i.address, i.entry);
        def!(read = entries.read_when(!i.write, i.address));
        let seen = match self.crossing {
            true => entries
                .on(FAST)
                .read(i.address.quasi_static("it is held"))
                .map(|field| field.quasi_static("it is held")),
            false => entries.read_async(i.address),
        };
        TableOut { read, seen, word: i.entry.pack() }
    }
}

#[test]
fn words_are_packed_with_the_first_field_on_top() {
    let mut sim = Simulation::of(&Table { crossing: false }).unwrap();
    sim.reset();
    assert_eq!(sim.peek_memory("entries", 0).unwrap().to_u64(), Some(1 << 11 | 2 << 7 | 3));
    assert_eq!(sim.peek_memory("entries", 1).unwrap().to_u64(), Some(1 << 11 | 9 << 7 | 100));
    assert_eq!(sim.peek_memory("entries", 2).unwrap().to_u64(), Some(0));
    let new = Entry { resident: 0, page: [15, 64] };
    sim.drive(TableIn { write: 1, address: 5, entry: new });
    sim.step();
    assert_eq!(sim.read_u64().seen, new);
    let word = sim.get_u64(sim.o.word);
    assert_eq!(sim.peek_memory("entries", 5).unwrap().to_u64(), Some(word));
    sim.drive(TableIn { write: 0, address: 1, entry: new });
    sim.step();
    let first = Entry { resident: 1, page: [9, 100] };
    assert_eq!((sim.read_u64().read, sim.read_u64().seen), (first, first));
    assert_eq!(sim.peek("read_page_1").unwrap().to_u64(), Some(100));
}

#[test]
fn a_table_is_one_memory_and_what_is_read_has_names() {
    let design = elaborate(&Table { crossing: false }).unwrap();
    assert_eq!(design.top().memories.len(), 1);
    let text = &verilog(&design)[0].text;
    assert!(text.contains("reg [11:0] entries [0:5];"), "{text}");
    assert!(text.contains("read_page_1 = read[6:0];"), "{text}");
    elaborate(&Table { crossing: true }).unwrap();
}

block! {
    /// Reads some fields only.
    struct Flags;
    in FlagIn { address: below(6) }
    out FlagOut { found: _ }
}

impl Flags {
    fn build(&self, m: Module, i: FlagIn) -> FlagOut {
        let entries = m.memory("entries", 6, entry(), ReadUnderWrite::Old).fill(Entry { resident: 1, page: [7, 9] });
        def!(named = entries.read(i.address));
        let nameless = entries.read(i.address);
        let held = m.reg("held", entry()).reset(0);
        held.next(entries.read_async(i.address));
        FlagOut { found: named.resident & nameless.page[1].bit(3) & held.page[0].bit(2) }
    }
}

#[test]
fn fields_that_nobody_looks_at_are_no_matter_for_linters() {
    let files = verilog(&elaborate(&Flags).unwrap());
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[0].text));
}

codes! { enum Alu { Load, Add, Hold } }

bundle! {
    struct Step<T> { alu: T, operand: T, ends: T }
}

block! {
    /// Runs a program of records.
    struct Run;
    out RunOut { sum: _, done: _ }
}

impl Run {
    fn build(&self, m: Module, _: ()) -> RunOut {
        let step = |alu: Alu, operand| Step { alu: alu.code(), operand, ends: 0 };
        let end = Step { ends: 1, ..step(Alu::Hold, 0) };
        let program = m
            .memory("program", 8, Step { alu: one_of::<Alu>(), operand: bits(8), ends: bit() }, ReadUnderWrite::Any)
            .words([step(Alu::Load, 40), step(Alu::Add, 2), step(Alu::Add, 100), end]);
        let at = m.reg("at", 3).reset(0);
        def!(step = program.read_async(at));
        at.when(!step.ends, at + 1);
        let sum = m.reg("sum", 8).reset(0);
        sum.next(step.alu.choose(|alu| match alu {
            Alu::Load => step.operand,
            Alu::Add => sum + step.operand,
            Alu::Hold => *sum,
        }));
        RunOut { sum: *sum, done: step.ends }
    }
}

#[test]
fn a_program_is_assembler_decoder_and_wave() {
    let mut sim = Simulation::of(&Run).unwrap();
    sim.reset();
    let wave = sim.record(["at", "step_alu", "step_operand", "sum", "done"]);
    sim.run(5);
    wave.expect(
        r"
        clk          |~~~\__/~~~\__/~~~\__/~~~\__/~~~\__/
        at           | 0    | 1    | 2    | 3           |
        step_alu     | Load | Add         | Hold        |
        step_operand | 28   | 2    | 64   | 0           |
        sum          | 0    | 28   | 2a   | 8e          |
        done         |____________________/~~~~~~~~~~~~~~
        ",
    );
}
