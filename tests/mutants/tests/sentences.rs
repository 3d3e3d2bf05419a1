//! What mutants a small block has, and what becomes of its circuit.

use tilewright_hdl::ir::{Contents, Init, Module as Circuit, Op};
use tilewright_hdl::{Bits, Module, ReadUnderWrite, bit, bits, block, def, elaborate, lit, mux};
use tilewright_mutants::{Mutant, mutants, mutated};

block! {
    /// Counts, and remembers the least of what it was given at each count.
    struct Least;
    latency = "1 clock";
    source = "a test of mutants";
    in LeastIn { restart: bit(), take: bit(), word: bits(8) }
    out LeastOut { least: bits(8), count: bits(2) }
}

impl Least {
    fn build(&self, m: Module, i: LeastIn) -> LeastOut {
        def!(count = m.reg(2).reset(1));
        count.when(i.restart, 0).when(i.take, count + 1);
        let memory = m.memory("words", 4, 8, ReadUnderWrite::Old).fill(Bits::ones(8));
        def!(old = memory.read_when(i.take, *count));
        let word = m.pipe("word_before", i.word);
        def!(less = word.lt(old));
        memory.write(less, *count, word);
        m.assume(i.restart.implies(!i.take), "it is restarted while nothing is taken");
        m.assert(m.past(i.restart).implies(count.eq(0)), "no edit: it holds whatever the inputs are");
        LeastOut { least: mux(less, word, lit(8, 7)), count: *count }
    }
}

fn circuit() -> Circuit {
    elaborate(&Least).unwrap().top().clone()
}

/// Sentences without their block and place.
fn edits(mutants: &[Mutant]) -> Vec<String> {
    mutants.iter().map(|Mutant { what, change, .. }| format!("{what}: {change}")).collect()
}

/// The circuit after an edit.
fn after(edit: &str) -> Circuit {
    let all = mutants(&circuit());
    let at = edits(&all).iter().position(|other| other == edit);
    all[at.unwrap_or_else(|| panic!("no mutant is `{edit}`"))].module.clone()
}

#[test]
fn every_part_of_a_block_has_its_edits() {
    let expected = [
        "a constant: one more",
        "a constant: one less",
        "a choice by conditions: arm 0 dropped",
        "a choice by conditions: the condition of arm 0 inverted",
        "a choice by conditions: arm 1 dropped",
        "a choice by conditions: the condition of arm 1 inverted",
        "a choice by conditions: arms 0 and 1 exchanged",
        "a constant: one more",
        "a constant: one less",
        "+: Add becomes Sub",
        "+: the left operand alone",
        "+: the right operand alone",
        "less: Lt becomes Le",
        "less: Lt becomes Ge",
        "less: sign taken otherwise",
        "less: always false",
        "less: always true",
        "!: inversion dropped",
        "!: inversion dropped",
        "|: Or becomes And",
        "|: Or becomes Xor",
        "|: the left operand alone",
        "|: the right operand alone",
        "a constant: one more",
        "a constant: one less",
        "a constant: highest bit inverted",
        "mux: arms exchanged",
        "mux: always the first arm",
        "mux: always the second arm",
        "count: reset dropped",
        "count: reset to one more",
        "count: reset to one less",
        "count: register bypassed",
        "word_before: register bypassed",
        "words: write port 0 enabled always: false",
        "words: write port 0 enabled always: true",
        "words: read port 0 enabled always",
        "words: the enable of read port 0 inverted",
        "words: the other policy of reading under a write",
        "words: contents unknown",
        "words: filled with one more",
        "words: filled with one less",
        "words: filled with highest bit inverted",
        "an assumption: dropped",
    ];
    assert_eq!(edits(&mutants(&circuit())), expected);
}

block! {
    /// Covers what looks back.
    struct Covered;
    latency = "0 clocks";
    in CoveredIn { x: bit() }
    out CoveredOut { y: bit() }
}

impl Covered {
    fn build(&self, m: Module, i: CoveredIn) -> CoveredOut {
        m.cover("it rises", m.rose(i.x));
        CoveredOut { y: !i.x }
    }
}

/// The register that says that there is a past is none of the description.
#[test]
fn what_a_cover_waits_by_has_no_edits() {
    let expected = [
        "!: inversion dropped",
        "!: inversion dropped",
        "&: And becomes Or",
        "&: And becomes Xor",
        "&: the left operand alone",
        "&: the right operand alone",
        "output y: inverted",
        "x_past: register bypassed",
    ];
    let mut edits = edits(&mutants(elaborate(&Covered).unwrap().top()));
    edits.sort_unstable();
    assert_eq!(edits, expected);
}

#[test]
fn an_edit_is_of_one_thing() {
    assert_eq!(after("count: reset to one more").registers[0].reset, Some(Init::Same(Bits::new(2, 2))));
    assert_eq!(after("count: reset dropped").registers[0].reset, None);
    assert_eq!(after("words: filled with one more").memories[0].contents, Contents::Fill(Bits::zero(8)));
    assert_eq!(
        after("words: filled with highest bit inverted").memories[0].contents,
        Contents::Fill(Bits::new(8, 127))
    );
    assert_eq!(after("words: read port 0 enabled always").memories[0].reads[0].enable, None);
    let never = after("words: write port 0 enabled always: false");
    assert_eq!(never.node(never.memories[0].writes[0].enable).op, Op::Const(Bits::zero(1)));
    // The value keeps its name, and the register has another.
    let bypassed = after("word_before: register bypassed");
    let register = &bypassed.registers[1];
    assert_eq!(bypassed.register_name(register), "word_before_held");
    let value = bypassed.nodes.iter().find(|node| node.name.as_deref() == Some("word_before")).unwrap();
    assert_eq!(value.op, Op::Wire(register.next));
}

block! {
    /// Two conditions that need other states, and two that do not.
    struct States;
    latency = "1 clock";
    source = "a test of mutants";
    in StatesIn { go: bit() }
    out StatesOut { either: bit(), any: bit(), same: bit(), held: bits(4) }
}

impl States {
    fn build(&self, m: Module, i: StatesIn) -> StatesOut {
        def!(state = m.reg(2).reset(0));
        state.next(state + 1);
        def!(first = state.eq(0) & i.go);
        def!(last = state.eq(2) | state.eq(3));
        def!(held = m.reg(4).reset(0));
        held.when(first, 1).when(last, 2).when(i.go, 3);
        StatesOut { either: first | last, any: last | i.go, same: i.go & !lit(1, 0), held: *held }
    }
}

#[test]
fn conditions_that_exclude_each_other_are_not_exchanged() {
    let all = edits(&mutants(elaborate(&States).unwrap().top()));
    let of = |edit: &str| all.iter().filter(|other| other.ends_with(edit)).count();
    assert_eq!(of("Or becomes And"), 3, "`last`, and two outputs");
    assert_eq!(of("Or becomes Xor"), 1, "the output whose conditions may hold together");
    assert_eq!(
        (of("&: the left operand alone"), of("&: the right operand alone")),
        (0, 1),
        "the right one is constant"
    );
    assert_eq!(of("arms 0 and 1 exchanged"), 0);
    assert_eq!(of("arms 1 and 2 exchanged"), 1);
}

#[test]
fn a_sentence_says_the_block_the_place_the_thing_and_the_edit() {
    let all = mutants(&circuit());
    let constants: Vec<String> =
        all.iter().filter(|mutant| mutant.what == "a constant").map(Mutant::to_string).collect();
    assert!(constants[0].starts_with("Least, tests/mutants/tests/sentences.rs:19:"), "{}", constants[0]);
    assert!(constants[0].ends_with(", a constant: one more"), "{}", constants[0]);
}

#[test]
fn a_mutant_takes_the_place_of_its_module_unless_it_breaks_a_rule() {
    let design = elaborate(&Least).unwrap();
    let all = mutants(design.top());
    let sentence = |edit: &str| {
        let of = |mutant: &&Mutant| format!("{}: {}", mutant.what, mutant.change) == edit;
        all.iter().find(of).unwrap().to_string()
    };
    let less = mutated(&design, &sentence("less: Lt becomes Ge")).unwrap();
    assert_ne!(format!("{:?}", less.top().nodes), format!("{:?}", design.top().nodes));
    // A counter without its register is a loop.
    assert!(mutated(&design, &sentence("count: register bypassed")).is_none());
    assert!(mutated(&design, "More, nowhere: another").is_none());
}
