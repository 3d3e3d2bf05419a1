//! `choose!`: a choice by code that names each code once.

use crate::codes::Codes;
use crate::data::{Data, Fits, Given};
use crate::elaboration;
use crate::signal::Signal;
use tilewright_circuit::{Loc, Mistake, Problem};

/// A choice by code: [`Signal::choose`], without the name of the enum in each arm. The subject is a signal, a register
/// or a state machine. Each arm is a signal, a number or a record; codes that share an arm are joined by `|`, and `_`
/// stands for all codes that no arm names. rustc reports a code without an arm.
///
/// ```
/// # use tilewright_hdl::*;
/// codes! { enum Alu { Load, Add, Double, Clear } }
///
/// block! {
///     /// Computes with an accumulator.
///     pub struct Accumulator;
///     in AccumulatorIn { operation: one_of::<Alu>(), operand: bits(8) }
///     out AccumulatorOut { sum: bits(8) }
/// }
///
/// impl Accumulator {
///     fn build(&self, m: Module, i: AccumulatorIn) -> AccumulatorOut {
///         def!(sum = m.reg(8).reset(0));
///         def!(result = choose!(i.operation, Alu {
///             Load => i.operand,
///             Add | Double => sum + mux(i.operation.is(Alu::Double), sum, i.operand),
///             _ => 0,
///         }));
///         sum.next(result);
///         AccumulatorOut { sum: *sum }
///     }
/// }
/// # let mut sim = tilewright_sim::Simulation::of(&Accumulator).unwrap();
/// # for (operation, sum) in [(Alu::Load, 20), (Alu::Add, 40), (Alu::Double, 80), (Alu::Clear, 0)] {
/// #     sim.drive(AccumulatorIn { operation: operation.code(), operand: 20 });
/// #     sim.step();
/// #     assert_eq!(sim.get_u64(sim.o.sum), sum);
/// # }
/// ```
///
/// An arm is computed once, whichever codes share it. The bits of the subject may have spare values:
/// [`Signal::choose`] says what is chosen then, and when that is an error.
#[macro_export]
macro_rules! choose {
    (@pattern $codes:ty, _) => { _ };
    (@pattern $codes:ty, $code:ident) => { <$codes>::$code };
    (@code $codes:ty, _) => { None };
    (@code $codes:ty, $code:ident) => { Some(<$codes>::$code) };
    ($subject:expr, $codes:ty { $($($code:tt)|+ => $value:expr),+ $(,)? }) => {{
        // Here rustc reports codes without an arm.
        let _: fn($codes) = |code| match code {
            $($($crate::choose!(@pattern $codes, $code))|+ => {})+
        };
        $subject.choose_among([$($crate::ChosenArm::new([$($crate::choose!(@code $codes, $code)),+], $value)),+])
    }};
    ($($other:tt)*) => {
        compile_error!("a choice is written `choose!(subject, Enum { One => a, Another | Third => b, _ => c })`")
    };
}

/// An arm of [`choose!`](crate::choose!): the codes that it names, or `None` for all that have no arm of their own.
#[doc(hidden)]
pub struct ChosenArm<C, V: Data> {
    codes: Vec<Option<C>>,
    value: Given<V>,
}

impl<C: Codes, V: Data> ChosenArm<C, V> {
    #[track_caller]
    pub fn new<const N: usize>(
        codes: [Option<C>; N],
        value: impl Fits<V>, // Numbers alone have no width: write one as `lit(8, 0)`.
    ) -> ChosenArm<C, V> {
        ChosenArm { codes: codes.into(), value: value.given() }
    }

    fn takes(&self, code: Option<C>) -> bool {
        self.codes.iter().any(|own| own.map(C::code) == code.map(C::code))
    }
}

impl Signal {
    #[doc(hidden)]
    #[track_caller]
    pub fn choose_among<C: Codes, V: Data, const N: usize>(self, arms: [ChosenArm<C, V>; N]) -> V {
        self.report_unused_arms(&arms);
        self.choose(|code| {
            let arm = |code| arms.iter().find(|arm| arm.takes(code));
            arm(Some(code)).or_else(|| arm(None)).expect("rustc checks that each code has an arm").value.clone()
        })
    }

    /// Reports a code that two arms name, and a `_` that stands for no code.
    #[track_caller]
    fn report_unused_arms<C: Codes, V: Data>(self, arms: &[ChosenArm<C, V>]) {
        let count = |code| arms.iter().flat_map(|arm| &arm.codes).filter(|own| own.map(C::code) == code).count();
        let twice = C::ALL.iter().find(|code| count(Some(code.code())) > 1);
        let message = match (twice, count(None)) {
            (Some(code), _) => format!("`choose!` has two arms for `{}::{}`", C::NAMES.of, code.name()),
            (None, 2..) => "`choose!` has two arms `_`".to_owned(),
            (None, 1) if C::ALL.iter().all(|code| count(Some(code.code())) > 0) => {
                format!("the arm `_` of `choose!` is never chosen: each code of `{}` has an arm", C::NAMES.of)
            }
            _ => return,
        };
        let problem = Problem::new(Mistake::RepeatedKey, Loc::caller(), message);
        let id = self.id();
        elaboration::with(|e| e.report_instead_of(&[id], problem.help("each code is named once; `_` is for the rest")));
    }
}
