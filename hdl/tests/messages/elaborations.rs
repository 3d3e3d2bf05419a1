//! Elaborations inside others, and elaborations that a panic ends.

use crate::messages::common::*;
use tilewright_hdl::*;

#[test]
#[should_panic(expected = "use `m.instance` there")]
fn elaboration_inside_a_description() {
    let _ = elaborate(&Case(|_, i| {
        let _ = elaborate(&Through);
        i.a
    }));
}

#[test]
fn a_panic_in_a_description_leaves_nothing_behind() {
    let panicking = Case(|_, _| panic!("the user's own"));
    let panic = std::panic::catch_unwind(|| elaborate(&panicking)).unwrap_err();
    assert_eq!(panic.downcast_ref::<&str>(), Some(&"the user's own"));
    elaborate(&Case(|_, i| i.a)).expect("the arena was cleared");
}

/// Contains itself endlessly.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Doll(u32);

impl Block for Doll {
    type In = ();
    type Out = Out;

    fn inputs(&self) {}

    fn build(&self, m: Module, _: ()) -> Out {
        m.instance("u_inner", &Doll(self.0 + 1), ())
    }
}

#[test]
fn blocks_that_instantiate_themselves() {
    expect(
        |m, _| m.instance("u_doll", &Doll(0), ()).out,
        "`Doll(99)` is nested more than 100 deep [T506]
         --> [m.instance(\"u_inner\", &Doll(self.0 + 1), ())]
         the outermost `Doll` is instantiated at [|m, _| m.instance(\"u_doll\", &Doll(0), ()).out,]
         help: if it instantiates itself, a parameter must become smaller each time, and end the recursion",
    );
}
