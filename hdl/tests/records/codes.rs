//! Codes with numbers of their own, codes as signals, and `choose!`.

use tilewright_hdl::*;
use tilewright_sim::Simulation;

codes! {
    /// The answers of AXI4.
    enum Response { Okay = 0, Slverr = 2, Decerr }
    enum Opcode { Load = 0x03, Store = 0x23, Branch = 0x63 }
}

block! {
    /// What a slave answers, and how a master reads it.
    struct Answers;
    in AnswersIn { read: one_of::<Response>(), opcode: one_of::<Opcode>(), word: bits(4) }
    out AnswersOut { faults: bits(4), is_code: bit(), is_opcode: bit(), answer: one_of::<Response>(), kind: bits(4), joined: bits(3) }
}

impl Answers {
    fn build(&self, m: Module, i: AnswersIn) -> AnswersOut {
        def!(faults = m.reg(4).reset(0));
        def!(answer = m.fsm(Response::Decerr));
        let moves = answer.next(|answer| match answer {
            Response::Okay => when(i.opcode.is(Opcode::Store), Response::Slverr),
            Response::Slverr => goto(Response::Decerr),
            Response::Decerr => goto(Response::Okay),
        });
        faults.when(moves.enters(Response::Slverr) | moves.leaves(Response::Decerr), faults + 1);
        AnswersOut {
            faults: *faults,
            is_code: i.read.is_code(),
            is_opcode: i.opcode.is_code(),
            answer: *answer,
            kind: choose!(i.opcode, Opcode { Load | Store => i.word + 1, Branch => 9 }),
            joined: cat![i.read.is(Response::Slverr), Response::Decerr],
        }
    }
}

#[test]
fn numbers_of_codes() {
    let mut sim = Simulation::of(&Answers).unwrap();
    let wave = sim.record([sim.o.answer, sim.o.faults]);
    for number in 0..128 {
        sim.drive(AnswersIn { read: number % 4, opcode: number, word: 4 });
        assert_eq!(sim.get(sim.o.is_code), u64::from([0, 2, 3].contains(&(number % 4))));
        assert_eq!(sim.get(sim.o.is_opcode), u64::from([0x03, 0x23, 0x63].contains(&number)));
        // A spare value chooses what most codes choose.
        assert_eq!(sim.get(sim.o.kind), if number == 0x63 { 9 } else { 5 });
        assert_eq!(sim.get(sim.o.joined), if number % 4 == 2 { 7 } else { 3 });
    }
    sim.drive(AnswersIn { read: 0, opcode: Opcode::Store.code(), word: 0 });
    sim.run(6);
    wave.expect(
        r"
        clk    |________/~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/
        answer | Decerr | Okay   | Slverr | Decerr | Okay   | Slverr |
        faults | 0      | 1      | 2               | 3      | 4      |
        ",
    );
}

#[test]
fn a_state_with_a_number_of_its_own_is_left() {
    let mut sim = Simulation::of(&Answers).unwrap();
    sim.drive(AnswersIn { opcode: Opcode::Load.code(), ..AnswersIn::default() });
    // `Decerr` is left, and `Okay` is not.
    sim.run(3);
    assert_eq!((sim.get_u64(sim.o.answer), sim.get_u64(sim.o.faults)), (Response::Okay.code(), 1));
}

#[test]
fn verilog_has_their_numbers_and_names() {
    let text = &tilewright_gen::verilog(&elaborate(&Answers).unwrap())[0].text;
    for line in [
        "localparam [1:0] RESPONSE_SLVERR = 2'd2;",
        "localparam [6:0] OPCODE_BRANCH = 7'd99;",
        "assign is_code = (read == RESPONSE_OKAY) | (read >= RESPONSE_SLVERR);",
        "            answer <= RESPONSE_DECERR;",
        "default: answer <= RESPONSE_OKAY; // RESPONSE_DECERR",
    ] {
        assert!(text.contains(line), "`{line}` is missing in\n{text}");
    }
    // An arm is computed once, though two codes share it.
    assert_eq!(text.matches("word + ").count(), 1, "{text}");
}

/// Both write the same circuit.
#[test]
fn the_macro_and_the_method_choose_alike() {
    block! {
        /// Chooses between records, with the macro or with the method.
        struct Chooser { short: bool }
        in ChooserIn { go: bit(), a: bits(8), b: bits(8) }
        out ChooserOut { low: bits(8), high: bits(8), number: bits(8) }
    }
    impl Chooser {
        fn build(&self, m: Module, i: ChooserIn) -> ChooserOut {
            def!(register = m.reg(one_of::<Response>()).reset(Response::Okay));
            register.when(i.go, (register.bits() + 1).code::<Response>());
            if self.short {
                let number = lit(8, 0);
                choose!(register, Response {
                    Okay => ChooserOut { low: i.a, high: i.b, number },
                    Slverr => ChooserOut { low: i.b, high: i.a, number },
                    _ => ChooserOut { low: i.a, high: i.a, number },
                })
            } else {
                let number = lit(8, 0);
                register.choose(|response| match response {
                    Response::Okay => ChooserOut { low: i.a, high: i.b, number },
                    Response::Slverr => ChooserOut { low: i.b, high: i.a, number },
                    Response::Decerr => ChooserOut { low: i.a, high: i.a, number },
                })
            }
        }
    }
    let text = |short| {
        let text = tilewright_gen::verilog(&elaborate(&Chooser { short }).unwrap())[0].text.clone();
        let lines = text[text.find("localparam").unwrap()..].lines();
        // Without the places in the source.
        lines.map(|line| line.split(" // ").next().unwrap().trim_end().to_owned() + "\n").collect::<String>()
    };
    assert_eq!(text(true), text(false));
    assert!(text(true).contains("RESPONSE_SLVERR: low = b;"), "{}", text(true));
    let design = elaborate(&Chooser { short: true }).unwrap();
    assert_eq!(design.top().properties[0].message, "`register` is a code of `Response`");
}

#[test]
fn a_code_is_a_signal() {
    bundle! { struct Answer<T> { response: T, word: T } }
    block! {
        /// Refuses all that comes.
        struct Refuses;
        in RefusesIn { go: bit() }
        out RefusesOut { answer: Answer { response: one_of::<Response>(), word: bits(4) } }
    }
    impl Refuses {
        fn build(&self, _: Module, i: RefusesIn) -> RefusesOut {
            let answer = Answer { response: Response::Slverr.into(), word: lit(4, 0) };
            RefusesOut { answer: mux(i.go, answer, Answer { response: Response::Okay.into(), word: lit(4, 1) }) }
        }
    }
    let text = &tilewright_gen::verilog(&elaborate(&Refuses).unwrap())[0].text;
    assert!(text.contains("go ? RESPONSE_SLVERR : RESPONSE_OKAY"), "{text}");
    assert!(text.contains("// Not used here: RESPONSE_DECERR = 3."), "{text}");
}
