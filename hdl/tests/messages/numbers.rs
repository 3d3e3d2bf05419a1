//! Names that one place in the source asks for several times.

use crate::messages::common::*;
use tilewright_hdl::*;

/// The names inside of the block, in the sequence of declaration.
fn names(build: Build) -> Vec<String> {
    let design = elaborate(&Case(build)).unwrap();
    let top = design.top();
    let nets =
        top.nodes.iter().filter(|node| !matches!(node.op, ir::Op::Input(_))).filter_map(|node| node.name.clone());
    let memories = top.memories.iter().map(|memory| memory.name.clone());
    let instances = top.instances.iter().map(|instance| instance.name.clone());
    nets.chain(memories).chain(instances).collect()
}

fn edge(m: Module, x: Signal) -> Signal {
    def!(was = m.pipe(x));
    x & !was
}

#[test]
fn a_helper_that_is_called_twice_gets_numbers() {
    assert_eq!(names(|m, i| edge(m, i.a) & edge(m, !i.a) & edge(m, i.a + 1)), ["was", "was_1", "was_2"]);
    let again = |m: Module, i: In| edge(m, i.a) & edge(m, !i.a);
    assert_eq!(names(again), names(again));
}

#[test]
fn a_number_is_skipped_if_another_line_asks_for_it() {
    assert_eq!(
        names(|m, i| {
            def!(was_1 = m.pipe(i.b));
            edge(m, i.a) & edge(m, !i.a) & was_1.zext(8)
        }),
        ["was_1", "was", "was_2"]
    );
}

#[test]
fn a_number_is_skipped_if_a_pad_has_the_name() {
    block! {
        /// Has a pad, which becomes the port `was_1`.
        struct Pin;
        in PinIn { was_1: Outside::widths(1), low: bit() }
        out PinOut { line: bit() }
    }
    impl Pin {
        fn build(&self, m: Module, i: PinIn) -> PinOut {
            let low = edge(m, i.low) & edge(m, !i.low);
            PinOut { line: m.instance("u_pin", &Pad::new(1).pull_up(), PadIn::open_drain(low, i.was_1)).line }
        }
    }
    let design = elaborate(&Pin).unwrap();
    let named = |name: &str| design.top().nodes.iter().any(|node| node.name.as_deref() == Some(name));
    assert_eq!(["was", "was_1", "was_2"].map(named), [true, false, true]);
}

#[test]
fn memories_their_reads_and_instances_take_the_same_numbers() {
    fn held(m: Module, x: Signal) -> Signal {
        def!(words = m.memory(128, 8, ReadUnderWrite::Any));
        words.write(lit(1, 1), x.trunc(7), x);
        let inverted = m.instance("u_inverter", &Inverter { registered: true }, Link { x }).out;
        words.read(x.trunc(7)) & inverted
    }
    assert_eq!(
        names(|m, i| held(m, i.a) & held(m, !i.a)),
        ["words_read", "words_1_read", "words", "words_1", "u_inverter", "u_inverter_1"]
    );
}

#[test]
fn an_instance_has_the_name_of_its_variable() {
    assert_eq!(
        names(|m, i| {
            def!(r#final = m.instance(&Inverter { registered: true }, Link { x: i.a }));
            def!(rest = m.array(2, &Inverter { registered: true }, |_| Link { x: i.a }));
            r#final.out & rest.out.last()
        }),
        ["u_final", "u_rest"]
    );
}

#[test]
fn an_output_keeps_the_name_of_the_net_that_drives_it() {
    fn next(m: Module, x: Signal) -> Signal {
        def!(out = m.pipe(x));
        out
    }
    assert_eq!(names(|m, i| next(m, next(m, i.a))), ["out_1", "out"]);
}

#[test]
fn a_net_that_carries_an_input_stands_beside_it() {
    assert_eq!(
        names(|m, i| {
            def!(a = m.pipe(i.a));
            def!(b = i.b);
            def!(c = m.synchronize(i.c));
            a & b.zext(8) & c.zext(8)
        }),
        ["a_1", "b_1", "c_meta", "c_1"]
    );
    let text = problems(&Case(|m, i| {
        def!(a = m.pipe(!i.a));
        a
    }));
    assert!(text.starts_with("net `a` has the name of an input [T401]"), "{text}");
}

#[test]
fn names_that_two_lines_ask_for_are_said_once_with_a_remedy() {
    expect(
        |m, i| {
            def!(was = m.pipe(i.a));
            was & edge(m, i.a) & edge(m, !i.a)
        },
        "net `was` has the name of another net [T401]
         --> [def!(was = m.pipe(x));]
         the other net `was` is declared at [def!(was = m.pipe(i.a));]
         help: rename one of them, or put a prefix before it: `m.within(\"first\", || ..)`",
    );
    assert_eq!(
        names(|m, i| {
            def!(was = m.pipe(i.a));
            was & m.within("first", || edge(m, i.a) & edge(m, !i.a))
        }),
        ["was", "first_was", "first_was_1"]
    );
}

#[test]
fn a_prefix_stands_before_all_names_but_those_inside_of_an_instance() {
    bundle! { struct Pair<T> { left: T, right: T } }
    fn all(m: Module, i: In) -> Signal {
        def!(words = m.memory(128, 8, ReadUnderWrite::Any));
        words.write(lit(1, 1), i.b, i.a);
        def!(pair = m.wire(Pair { left: bits(8), right: bits(7) }));
        pair.drive(Pair { left: words.read_async(i.b), right: i.b });
        let late = m.stages(1, None, *pair, |_, pair| pair);
        def!(sum = late.left + late.right.zext(8));
        m.instance("u_inverter", &Inverter { registered: true }, Link { x: sum }).out
    }
    let build = |m: Module, i: In| {
        let inside = m.within("outer", || m.within("inner", || all(m, i)));
        def!(after = !inside);
        after
    };
    let mut expected =
        ["pair_left", "pair_right", "left1", "right1", "sum"].map(|name| format!("outer_inner_{name}")).to_vec();
    expected.extend(["after", "outer_inner_words", "u_outer_inner_inverter"].map(str::to_owned));
    assert_eq!(names(build), expected);
    let design = elaborate(&Case(build)).unwrap();
    assert!(design.modules()[0].nodes.iter().any(|node| node.name.as_deref() == Some("y")));
}
