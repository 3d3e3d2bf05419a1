//! Handles used where they are invalid: in another module, in another elaboration, outside of any.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
fn signals_of_another_module() {
    use std::cell::Cell;
    thread_local!(static LEAKED: Cell<Option<Signal>> = const { Cell::new(None) });
    /// Uses a signal of the module that instantiates it.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Thief;
    impl Block for Thief {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, _: Module, _: ()) -> Out {
            Out { out: LEAKED.get().unwrap() + 1 }
        }
    }
    expect(
        |m, i| {
            LEAKED.set(Some(i.a));
            m.instance("u_thief", &Thief, ()).out
        },
        "`a` belongs to `Case` but is used inside of `Thief` [T505]
         --> [Out { out: LEAKED.get().unwrap() + 1 }]
         `a` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: give the block an input for it",
    );
}

/// A value read as a code has that one problem.
#[test]
fn a_code_of_another_module() {
    use std::cell::Cell;
    codes! { enum Side { Left, Right } }
    thread_local!(static LEAKED: Cell<Option<Signal>> = const { Cell::new(None) });
    /// Chooses by a signal of the module that instantiates it.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Thief;
    impl Block for Thief {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, _: Module, _: ()) -> Out {
            let side = LEAKED.get().unwrap().code::<Side>();
            Out { out: side.choose(|side| lit(8, Side::code(side))) }
        }
    }
    expect(
        |m, i| {
            LEAKED.set(Some(i.c));
            m.instance("u_thief", &Thief, ()).out
        },
        "`c` belongs to `Case` but is used inside of `Thief` [T505]
         --> [let side = LEAKED.get().unwrap().code::<Side>();]
         `c` is made at [In { a: bits(8), b: bits(7), c: bit() }]
         help: give the block an input for it",
    );
}

#[test]
#[should_panic(expected = "a signal of an earlier elaboration is used")]
fn signals_of_an_earlier_elaboration() {
    use std::cell::Cell;
    thread_local!(static LEAKED: Cell<Option<Signal>> = const { Cell::new(None) });
    let build = |_: Module, i: In| {
        let before = LEAKED.replace(Some(i.a));
        before.map_or(i.a, |leaked| leaked + i.a)
    };
    let _ = elaborate(&Case(build));
    let _ = elaborate(&Case(build));
}

#[test]
#[should_panic(expected = "signals exist only while a block is built")]
fn signals_outside_of_elaboration() {
    let _ = lit(8, 1);
}

#[test]
#[should_panic(expected = "a memory of another module is used")]
fn memories_of_another_module() {
    let _ = elaborate(&Case(|m, _| {
        KEPT.set(Some(Kept::Memory(m.memory("words", 4, 8, ReadUnderWrite::Old))));
        m.instance("u_keeper", &Keeper, ()).out
    }));
}

/// In the module that drives it, the stand-in for the register has the register's node number.
#[test]
fn registers_of_another_module() {
    /// Lends its register to an instance in it.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Lender;
    impl Block for Lender {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, m: Module, _: ()) -> Out {
            let _zero = lit(8, 0);
            let r = m.reg("r", 8);
            r.next(1);
            KEPT.set(Some(Kept::Register(r)));
            m.instance("u_keeper", &Keeper, ())
        }
    }
    let text = problems(&Lender);
    assert!(
        text.starts_with("`r` belongs to `Lender` but is used inside of `Keeper` [T505]\n  --> [register.next(0);]"),
        "{text}"
    );
}

#[test]
fn signals_of_a_finished_module() {
    /// Stores its output where others find it.
    #[derive(Debug, Clone, PartialEq, Eq, Hash)]
    struct Leaver;
    impl Block for Leaver {
        type In = ();
        type Out = Out;
        fn inputs(&self) {}
        fn build(&self, _: Module, _: ()) -> Out {
            let out = lit(8, 1);
            KEPT.set(Some(Kept::Result(out)));
            Out { out }
        }
    }
    let text = problems(&Case(|m, _| {
        let one = m.instance("u_leaver", &Leaver, ()).out;
        m.instance("u_keeper", &Keeper, ()).out & one
    }));
    assert!(text.starts_with("a signal of a module already finished is used inside of `Keeper` [T505]"), "{text}");
}
