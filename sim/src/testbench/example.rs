//! The frame of a documentation example: a block without ports around a few lines that describe hardware.
#![expect(
    unpredictable_function_pointer_comparisons,
    reason = "a block can be compared, but an example is the only one"
)]

use std::array;

use tilewright_circuit::Design;
use tilewright_circuit::ir::Directive;
use tilewright_hdl::{Block, Module, elaborate};

use crate::engine::EngineKind;
use crate::testbench::simulation::Simulation;

/// The number of clocks for which an example's assertions are checked.
const CLOCKS: u64 = 64;

/// The circuit of an example. It has no ports, so it states its own assertions, or a test reads its registers and
/// nets by name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Example {
    build: fn(Module),
}

impl Block for Example {
    type In = ();
    type Out = ();

    fn inputs(&self) {}

    fn build(&self, m: Module, (): ()) {
        (self.build)(m);
    }

    // A function pointer would be a different number in each run.
    fn name(&self) -> String {
        "example".to_owned()
    }
}

impl Example {
    #[track_caller]
    fn design(self) -> Design {
        elaborate(&self).unwrap_or_else(|problems| panic!("{problems}"))
    }
}

/// Runs an example with assertions for 64 clocks.
///
/// # Panics
///
/// It has mistakes, states no assertion, or an assertion fails.
#[doc(hidden)]
#[track_caller]
pub fn example(build: fn(Module)) {
    let design = Example { build }.design();
    let is_asserted = design
        .top()
        .properties
        .iter()
        .any(|property| matches!(property.directive, Directive::Assert | Directive::Assume));
    assert!(is_asserted, "the example asserts nothing");
    simulation(&design).run(CLOCKS);
}

/// An example whose values over time are read.
///
/// # Panics
///
/// It has mistakes.
#[doc(hidden)]
#[must_use]
#[track_caller]
pub fn traced(build: fn(Module)) -> Traced {
    Traced { design: Example { build }.design() }
}

/// Made by [`traced`].
#[doc(hidden)]
#[derive(Debug)]
pub struct Traced {
    design: Design,
}

impl Traced {
    /// The values of the register or net with this name just before each of the first `N` edges.
    ///
    /// # Panics
    ///
    /// There is no such name, or an assertion fails.
    #[track_caller]
    pub fn values<const N: usize>(&self, name: &str) -> [u64; N] {
        let mut sim = simulation(&self.design);
        array::from_fn(|_| {
            let value = sim.peek(name).unwrap_or_else(|unknown| panic!("{unknown}"));
            sim.step();
            value.to_u64().unwrap_or_else(|| panic!("`{name}` has more than 64 bits"))
        })
    }
}

/// The design of a block for an example. `build` is given: `m` and `i` are its arguments, and it returns a
/// `ShownOut`.
#[doc(hidden)]
#[macro_export]
macro_rules! shown {
    (|$m:pat_param, $i:pat_param| in { $($in:tt)* } out { $($out:tt)* } $($build:tt)*) => {{
        tilewright_hdl::block! {
            struct Shown;
            in ShownIn { $($in)* }
            out ShownOut { $($out)* }
        }

        impl Shown {
            fn build(&self, $m: tilewright_hdl::Module, $i: ShownIn) -> ShownOut {
                $($build)*
            }
        }

        tilewright_hdl::elaborate(&Shown).unwrap()
    }};
}

/// On the reference engine.
#[track_caller]
fn simulation(design: &Design) -> Simulation {
    Simulation::from_design(design).unwrap_or_else(|error| panic!("{error}")).on(EngineKind::Reference)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_hdl::{def, lit};

    #[test]
    #[should_panic(expected = "the example asserts nothing")]
    fn an_example_states_something() {
        example(|m| {
            def!(count = m.reg(2).reset(0));
            count.next(count + 1);
        });
    }

    #[test]
    #[should_panic(expected = "the count stays below 3")]
    fn what_does_not_hold_is_found() {
        example(|m| {
            def!(count = m.reg(2).reset(0));
            count.next(count + 1);
            m.assert(count.lt(3), "the count stays below 3");
        });
    }

    #[test]
    #[should_panic(expected = "needs equal widths")]
    fn mistakes_are_told() {
        example(|m| m.assert((lit(8, 1) + lit(7, 1)).eq(2), "a sum"));
    }

    #[test]
    fn values_are_those_before_each_edge() {
        let example = traced(|m| {
            def!(count = m.reg(2).reset(1));
            count.next(count + 1);
        });
        assert_eq!(example.values("count"), [1, 2, 3, 0, 1]);
    }
}
