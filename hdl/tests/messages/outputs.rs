//! Outputs that differ from their block's declaration.

use crate::messages::common::*;
use tilewright_hdl::*;

bundle! {
    struct Pair<T> { left: T, right: T }
}

codes! { enum Side { Left, Right } }

block! {
    /// Declares one output and builds another.
    struct Liar {
        outputs: u32,
    }
    in LiarIn { a: bits(8) }
    out(self) LiarOut {
        narrow: bits(7),
        pair: Pair { left: bits(8), right: bits(9) },
        lanes: bits(8).of(row(4)),
        side: one_of::<Side>(),
        clocked: bits(8).on(FAST),
        list: [bits(8); self.outputs],
        free: _,
    }
}

impl Liar {
    fn build(&self, _: Module, LiarIn { a }: LiarIn) -> LiarOut {
        let pair = Pair { left: a, right: !a };
        LiarOut { narrow: a, pair, lanes: a + 1, side: a.bit(0), clocked: a, list: vec![a; 2], free: a }
    }
}

#[test]
fn outputs_of_another_width_shape_or_kind_than_declared() {
    let expected = "output `narrow` is declared with 7 bits, but `a` has 8 bits [T502]
         --> [in LiarIn { a: bits(8) }]
         `narrow` is declared at [narrow: bits(7),]
         help: change its driver, or its declaration, on which the block's instances rely

         output `pair_right` is declared with 9 bits, but `!a` has 8 bits [T502]
         --> [let pair = Pair { left: a, right: !a };]
         `pair_right` is declared at [pair: Pair { left: bits(8), right: bits(9) },]
         help: change its driver, or its declaration, on which the block's instances rely

         output `lanes` is declared with 4 lanes, but `a + 1` has no lanes [T502]
         --> [LiarOut { narrow: a, pair, lanes: a + 1, side: a.bit(0), clocked: a, list: vec![a; 2], free: a }]
         `lanes` is declared at [lanes: bits(8).of(row(4)),]
         help: change its driver, or its declaration, on which the block's instances rely

         output `side` is declared as a code of `Side`, but `a.bit(0)` is a number [T502]
         --> [LiarOut { narrow: a, pair, lanes: a + 1, side: a.bit(0), clocked: a, list: vec![a; 2], free: a }]
         `side` is declared at [side: one_of::<Side>(),]
         help: change its driver, or its declaration, on which the block's instances rely

         output `clocked` is declared on clock `fast`, but an output is on the clock of its driver [T807]
         --> [clocked: bits(8).on(FAST),]
         help: leave `.on(..)` out

         5 problems in this description";
    let plain = |text: &str| text.lines().map(str::trim_start).collect::<Vec<_>>().join("\n");
    assert_eq!(plain(&problems(&Liar { outputs: 2 })), plain(expected));
}

#[test]
fn a_list_of_outputs_of_another_length_than_declared() {
    let text = problems(&Liar { outputs: 3 });
    assert_eq!(
        text,
        "output `list` is declared as a list of 3, but `build` returns 2 [T504]\n  --> [list: [bits(8); self.outputs],]\n  \
         help: return as many from `build` as are declared"
    );
}

/// A reader of the module sees the port: its own name identifies it.
#[test]
fn an_output_that_is_a_register_of_its_name() {
    block! {
        /// Counts.
        struct Wide;
        out WideOut { count: up_to(4) }
    }
    impl Wide {
        fn build(&self, m: Module, (): ()) -> WideOut {
            let count = m.reg("count", below(4)).reset(0);
            count.next(count + 1);
            WideOut { count: *count }
        }
    }
    assert!(
        problems(&Wide).starts_with("output `count` is declared with 3 bits, but what drives it has 2 bits [T502]\n")
    );
}
