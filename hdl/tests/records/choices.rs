//! Invalid codes, and actions at the transitions of a state machine.

use tilewright_hdl::ir::Directive;
use tilewright_hdl::*;
use tilewright_sim::Simulation;

codes! {
    enum Phase { Idle, Run, Drain }
    enum Side { Left, Right }
}

bundle! {
    struct ChosenIn<T> { raw: T, phase: T, go: T }
    struct ChosenOut<T> { out: T }
}

/// A block that chooses by the result of this function of its inputs.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct Chosen(Subject);

/// The subject of the choice.
type Subject = fn(Module, ChosenIn) -> Signal;

impl std::fmt::Debug for Chosen {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("Chosen")
    }
}

impl Block for Chosen {
    type In = ChosenIn;
    type Out = ChosenOut;

    fn inputs(&self) -> ChosenIn<Width> {
        ChosenIn { raw: bits(2), phase: one_of::<Phase>(), go: bit() }
    }

    fn build(&self, m: Module, i: ChosenIn) -> ChosenOut {
        m.ignore(&i);
        let subject = (self.0)(m, i);
        let out: Signal = subject.choose(|phase| lit(8, if let Phase::Run = phase { 1 } else { 7 }));
        let again: Signal = subject.choose(|phase| lit(8, Phase::code(phase)));
        ChosenOut { out: out + again }
    }
}

/// The automatic assertions about the subject.
fn asserted(subject: Subject) -> Vec<String> {
    let design = elaborate(&Chosen(subject)).unwrap_or_else(|problems| panic!("{problems}"));
    let asserted = design.top().properties.iter().filter(|property| property.directive == Directive::Assert);
    asserted.map(|property| property.message.clone()).collect()
}

#[test]
fn what_begins_with_a_reset_or_at_power_on_is_asserted_to_be_a_code() {
    let is_code = ["`r` is a code of `Phase`"];
    assert_eq!(
        asserted(|m, i| {
            let r = m.reg("r", one_of::<Phase>()).reset(Phase::Idle);
            r.when(i.go, Phase::Run);
            *r
        }),
        is_code
    );
    assert_eq!(
        asserted(|m, i| {
            let r = m.reg("r", one_of::<Phase>()).initial(Phase::Drain);
            let other = m.reg("other", one_of::<Phase>()).reset(Phase::Run);
            other.when(i.go, *r);
            r.next(mux(i.go, *other, Phase::Idle));
            *r
        }),
        is_code
    );
    assert_eq!(
        asserted(|m, i| {
            let words = m
                .memory("words", 4, one_of::<Phase>(), ReadUnderWrite::Old)
                .words([Phase::Run, Phase::Drain].map(|phase| Bits::new(2, phase.code())));
            let at = m.reg("at", 2).reset(0);
            at.when(i.go, at + 1);
            let r = m.reg("r", one_of::<Phase>()).reset(Phase::Idle);
            r.next(words.read_async(*at));
            *r
        }),
        is_code
    );
}

#[test]
fn what_holds_anything_at_first_or_comes_from_elsewhere_is_not() {
    let none: [&str; 0] = [];
    assert_eq!(asserted(|_, i| i.phase), none);
    assert_eq!(asserted(|_, i| i.raw.code::<Phase>()), none);
    assert_eq!(asserted(|m, i| m.pipe("r", mux(i.go, i.phase, Phase::Run))), none);
    assert_eq!(
        asserted(|m, _| {
            // The register has no reset, so a reset does not determine the next value of the other one.
            let early = m.reg("early", one_of::<Phase>());
            early.next(Phase::Run);
            let r = m.reg("r", one_of::<Phase>()).reset(Phase::Idle);
            r.next(*early);
            *r
        }),
        none
    );
    assert_eq!(
        asserted(|m, i| {
            let words = m.memory("words", 4, one_of::<Phase>(), ReadUnderWrite::Old);
            words.write(i.go, i.raw, Phase::Run);
            let r = m.reg("r", one_of::<Phase>()).reset(Phase::Idle);
            r.next(words.read_async(i.raw));
            *r
        }),
        none
    );
}

#[test]
fn an_enum_that_uses_all_of_its_bits_needs_no_assertion() {
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Sides;
    impl Block for Sides {
        type In = ChosenIn;
        type Out = ChosenOut;
        fn inputs(&self) -> ChosenIn<Width> {
            ChosenIn { raw: bits(1), phase: bits(1), go: bit() }
        }
        fn build(&self, m: Module, i: ChosenIn) -> ChosenOut {
            m.ignore(&i);
            let side = m.reg("side", one_of::<Side>()).reset(Side::Left);
            side.next(i.raw.code::<Side>());
            m.cover("any code", side.is_code());
            ChosenOut { out: side.choose(|side| if let Side::Left = side { i.phase } else { !i.phase }) }
        }
    }
    let design = elaborate(&Sides).unwrap();
    assert_eq!(design.top().properties.len(), 1);
}

/// Bits that are read as a code need no name for it.
#[test]
fn bits_that_are_chosen_by_as_a_code_are_asserted_too() {
    fn register(m: Module) -> Reg {
        let r = m.reg("r", 4).reset(0);
        r.next(r + 1);
        r
    }
    let parts: [(Subject, &str); 2] = [
        (|m, _| register(m).bits().part(2, 2).code::<Phase>(), "`r.slice(2..4)` is a code of `Phase`"),
        (
            |m, _| {
                let same = m.reg("same", 2).reset(0);
                same.next(register(m).part(0, 2));
                (*same).code::<Phase>()
            },
            "`same` is a code of `Phase`",
        ),
    ];
    for (part, message) in parts {
        assert_eq!(asserted(part), [message]);
        let text = tilewright_gen::verilog(&elaborate(&Chosen(part)).unwrap())[0].text.clone();
        assert!(text.contains("PHASE_IDLE: ") && text.contains("PHASE_RUN: "), "{text}");
    }
}

/// The same bits may be a code of one enum and of another.
#[test]
fn bits_that_are_chosen_by_as_codes_of_two_enums_have_the_names_of_each() {
    codes! { enum Gait { Walk, Trot, Canter, Gallop } }

    let text = tilewright_gen::verilog(
        &elaborate(&Chosen(|m, i| {
            let speed: Signal = i.raw.code::<Gait>().choose(|gait: Gait| lit(2, 3 - gait.code()));
            m.cover("fast", speed.eq(0));
            i.raw.code::<Phase>()
        }))
        .unwrap(),
    )[0]
    .text
    .clone();
    assert!(
        ["GAIT_WALK: ", "GAIT_TROT: ", "PHASE_IDLE: ", "PHASE_RUN: "].iter().all(|label| text.contains(label)),
        "{text}"
    );
}

/// A raw identifier is a word of Rust: in waves and in Verilog it is an ordinary name.
#[test]
fn a_code_may_have_the_name_of_a_word_of_rust() {
    codes! {
        #[allow(non_camel_case_types)]
        enum Word { r#type, r#use, Begin }
    }

    assert_eq!(Word::NAMES.codes, ["type", "use", "Begin"]);
    let build = |m: Module, i: ChosenIn| {
        let word = m.fsm("word", Word::r#type);
        word.next(|word| match word {
            Word::r#type => when(i.go, Word::Begin),
            Word::Begin => goto(Word::r#use),
            Word::r#use => hold(),
        });
        (*word).bits().code::<Phase>()
    };
    let text = tilewright_gen::verilog(&elaborate(&Chosen(build)).unwrap())[0].text.clone();
    assert!(text.contains("WORD_TYPE"), "{text}");
}

#[test]
fn a_code_that_is_none_fails_where_it_is_computed() {
    let computed = |m: Module, i: ChosenIn| {
        let r = m.reg("r", one_of::<Phase>()).reset(Phase::Idle);
        r.when(i.go, (r.bits() + 1).code::<Phase>());
        *r
    };
    assert_eq!(asserted(computed), ["`r` is a code of `Phase`"]);
    for seed in [0, 5] {
        let mut sim = Simulation::of(&Chosen(computed)).unwrap().seeded(seed);
        sim.set(sim.i.go, 1);
        sim.run(3);
        assert_eq!(sim.get_u64(sim.o.out), 7 + 2, "what most codes give, and what the last does");
        let error = sim.try_step().unwrap_err().to_string();
        assert!(
            error.starts_with("assertion failed in `chosen` in cycle 3 of `clk`, at 40000 ps: `r` is a code"),
            "{error}"
        );
    }
}

#[test]
fn is_code_is_of_codes() {
    let text = elaborate(&Chosen(|_, i| mux(i.raw.is_code(), i.phase, Phase::Run))).unwrap_err().to_string();
    assert!(text.starts_with("`is_code` needs a code, but `raw` is a number [T206]\n"), "{text}");
}

bundle! {
    struct MovesIn<T> { go: T, stop: T }
    struct MovesOut<T> { state: T, leaves: Vec<T>, enters: Vec<T>, goes: Vec<T> }
}

/// For each state and each pair of states, tells when it moves.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Mover;

impl Block for Mover {
    type In = MovesIn;
    type Out = MovesOut;

    fn inputs(&self) -> MovesIn<Width> {
        MovesIn { go: bit(), stop: bit() }
    }

    fn build(&self, m: Module, i: MovesIn) -> MovesOut {
        let phase = m.fsm("phase", Phase::Idle);
        let moves = phase.next(|state| match state {
            Phase::Idle => when(i.go, Phase::Run),
            Phase::Run => when(i.stop, Phase::Idle).or_when(i.go, Phase::Run).or_else(Phase::Drain),
            Phase::Drain => goto(Phase::Idle),
        });
        let all = Phase::ALL;
        MovesOut {
            state: phase.bits(),
            leaves: all.iter().map(|state| moves.leaves(*state)).collect(),
            enters: all.iter().map(|state| moves.enters(*state)).collect(),
            goes: all.iter().flat_map(|from| all.iter().map(|to| moves.goes(*from, *to))).collect(),
        }
    }
}

#[test]
fn moves_say_what_the_next_edge_does() {
    let mut sim = Simulation::of(&Mover).unwrap();
    let mut seen = std::collections::BTreeSet::new();
    for number in 0..64u64 {
        let (go, stop) = (number * 7 / 3 % 2, number * 5 / 4 % 2);
        sim.drive(MovesIn { go, stop });
        let before = sim.read_u64();
        sim.step();
        let (from, to) = (before.state, sim.get_u64(sim.o.state));
        seen.insert((from, to, go, stop));
        for state in 0..3 {
            assert_eq!(before.leaves[state as usize] == 1, from == state && to != state, "{number}");
            assert_eq!(before.enters[state as usize] == 1, to == state && from != state, "{number}");
            for next in 0..3 {
                assert_eq!(before.goes[(3 * state + next) as usize] == 1, (from, to) == (state, next), "{number}");
            }
        }
    }
    assert!(seen.len() >= 9, "{seen:?}");
    let text = &tilewright_gen::verilog(&elaborate(&Mover).unwrap())[0].text;
    assert!(text.contains("assign leaves_0 = (phase == PHASE_IDLE) & go;"), "{text}");
}

block! {
    /// Chooses between equal values.
    struct Indifferent;
    in IndifferentIn { phase: one_of::<Phase>(), level: bits(8).signed() }
    out IndifferentOut { raised: bits(8) }
}

impl Indifferent {
    fn build(&self, m: Module, i: IndifferentIn) -> IndifferentOut {
        m.ignore(&i.phase);
        let level: Signal = i.phase.choose(|_: Phase| i.level.bits());
        IndifferentOut { raised: level + 1 }
    }
}

#[test]
fn a_choice_is_of_the_kind_of_its_values_though_they_are_all_one() {
    let mut sim = Simulation::of(&Indifferent).unwrap();
    sim.set(sim.i.level, -3);
    assert_eq!(sim.get_u64(sim.o.raised), 254);
}
