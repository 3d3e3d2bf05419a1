//! Streams of signed and of wide words: the values sent and received, and the methods that messages suggest.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::circuits::engine::of;
use tilewright_hdl::*;
use tilewright_sim::{Error, Pauses, Simulation};

bundle! {
    /// A place with its number.
    struct Place<T> { number: T, height: T }
}

block! {
    /// Stores a place and returns it with the height negated.
    struct Mirror;
    in MirrorIn { places: stream(Place { number: bits(8), height: bits(12).signed() }), lift: bits(4).signed() }
    out MirrorOut { mirrored: stream(Place = _) }
}

impl Mirror {
    fn build(&self, m: Module, i: MirrorIn) -> MirrorOut {
        def!(full = m.reg(bit()).reset(0));
        def!(held = m.reg(Place { number: bits(8), height: bits(12).signed() }));
        let (mirrored, sent) = m.offer(full, Place { height: i.lift.sext(12) - held.height, ..*held });
        let places = i.places.take_when(!full | sent);
        held.when(places.taken, *places);
        full.when(places.taken, 1).when(sent, 0);
        MirrorOut { mirrored }
    }
}

block! {
    /// Passes on wide words.
    struct Wide;
    in WideIn { words: stream(bits(100)) }
    out WideOut { passed: stream(bits(100)) }
}

impl Wide {
    fn build(&self, _: Module, i: WideIn) -> WideOut {
        WideOut { passed: i.words }
    }
}

fn mirror() -> Simulation<MirrorIn, MirrorOut> {
    let mut sim = of(&Mirror);
    sim.reset();
    sim
}

#[test]
fn negative_numbers_are_sent_and_received() {
    let mut sim = mirror();
    let (places, mirrored, t) = (sim.i.places, sim.o.mirrored, sim.testbench());
    let sent = [-3, 2047, 0].map(|height| Place { number: 255, height });
    let seen = [3, -2047, 0].map(|height| Place { number: 255, height });
    t.run((t.send_all(places, sent, Pauses::NONE), t.expect_all(mirrored, seen, Pauses::NONE)));
    let (seen, ()) = t.run((t.receive_i64(mirrored), t.send(places, Place { number: 200, height: 7i64 })));
    assert_eq!(seen, Place { number: 200, height: -7 });
    // As an unsigned number it is the bits.
    let (seen, ()) = t.run((t.receive(mirrored), t.send(places, Place { number: 1, height: 1 })));
    assert_eq!(seen, Place { number: 1, height: 0xfff });
}

#[test]
fn a_record_is_set_to_negative_numbers() {
    let mut sim = mirror();
    sim.set(sim.i.lift, -8);
    sim.set_record(sim.i.places.payload, Place { number: 5, height: -2048i64 });
    sim.set(sim.i.places.valid, 1);
    sim.step();
    assert_eq!(sim.get(sim.o.mirrored.height), -8i64 + 2048);
}

#[test]
fn a_wrong_word_is_told_with_its_sign() {
    let mut sim = mirror();
    let (places, mirrored, t) = (sim.i.places, sim.o.mirrored, sim.testbench());
    let word = |height: i64| [Place { number: 9, height }];
    let text = panic_of(|| {
        let receives = t.expect_all(mirrored, word(-4), Pauses::NONE);
        t.run((t.send_all(places, word(3), Pauses::NONE), receives));
    });
    let words = "is Place { number: 9, height: -3 }, not Place { number: 9, height: -4 }";
    assert!(text.contains(words), "{text}");
}

#[test]
fn what_is_too_wide_for_a_call_names_one_that_takes_it() {
    let cases: [(&str, &dyn Fn()); 5] = [
        ("receive_bits", &|| {
            let (mut sim, word) = (of(&Wide), Bits::ones(100));
            let (words, passed, t) = (sim.i.words, sim.o.passed, sim.testbench());
            t.run((t.send_bits(words, word), t.receive(passed)));
        }),
        ("receive_bits", &|| {
            let (mut sim, word) = (of(&Wide), Bits::ones(100));
            let (words, passed, t) = (sim.i.words, sim.o.passed, sim.testbench());
            t.run((t.send_bits(words, word), t.receive_i64(passed)));
        }),
        ("holds_bits", &|| {
            let (mut sim, word) = (of(&Wide), Bits::ones(100));
            let (words, passed, t) = (sim.i.words, sim.o.passed, sim.testbench());
            t.run((t.send_bits(words, word), t.holds(passed)));
        }),
        ("get", &|| {
            let mut sim = of(&Wide);
            sim.set(sim.i.words.payload, Bits::ones(100));
            sim.set(sim.i.words.valid, 1);
            let (passed, t) = (sim.o.passed, sim.testbench());
            t.shown(&passed);
        }),
        ("read", &|| {
            let mut sim = of(&Wide);
            sim.set(sim.i.words.payload, Bits::ones(100));
            sim.read_u64();
        }),
    ];
    for (instead, run) in cases {
        let text = panic_of(run);
        assert!(text.starts_with("`passed.payload` does not fit in 64 bits"), "{text}");
        assert!(text.ends_with(&format!(": use `{instead}`")), "{text}");
    }
}

#[test]
fn time_ends_with_an_error() {
    let mut sim = Simulation::at(&Mirror, Period::ps(1 << 50)).unwrap();
    let all = (1 << 14) - 1;
    for ended in [sim.try_run(all), sim.try_run(1), sim.try_step(), sim.try_run(u64::MAX)].into_iter().enumerate() {
        match ended {
            (0, Ok(())) => {}
            (_, Err(Error::Late)) if ended.0 > 0 => {}
            (at, other) => panic!("{at}: {other:?}"),
        }
    }
    assert_eq!(sim.time(), all << 50);
}

/// The message of its panic.
fn panic_of(run: impl FnOnce()) -> String {
    let panic = catch_unwind(AssertUnwindSafe(run)).expect_err("it panics");
    *panic.downcast::<String>().expect("a panic with a text")
}
