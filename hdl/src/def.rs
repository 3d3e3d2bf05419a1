//! `def!`: one name for a variable and its hardware.

use crate::names::unraw;

/// `let NAME = ..` that also names the hardware: `def!(count = m.reg(8).reset(0));` is
/// `let count = m.reg("count", 8).reset(0);`.
///
/// It supplies the name to every method of a module that declares something by name: [`reg`](crate::Module::reg),
/// [`fsm`](crate::Module::fsm), [`toggle`](crate::Module::toggle), [`wire`](crate::Module::wire),
/// [`stream_wire`](crate::Module::stream_wire), [`memory`](crate::Module::memory), [`rom`](crate::Module::rom),
/// [`pipe`](crate::Module::pipe), [`pipe_when`](crate::Module::pipe_when),
/// [`synchronize`](crate::Module::synchronize) and [`synchronize_from`](crate::Module::synchronize_from). The module
/// may be `m`, another variable, or `m.on(CLOCK)`. For any other expression it names the net, or for a record the net
/// of each field: `entry_page`. Where a name is computed, as in a loop, call these methods directly.
///
/// An [`instance`](crate::Module::instance) or [`array`](crate::Module::array) is named with `u_` before the variable.
/// The registers of [`stages`](crate::Module::stages) and [`stream_stages`](crate::Module::stream_stages) get the
/// variable as a prefix, as by [`within`](crate::Module::within):
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// # block! {
/// #     struct Double;
/// #     in DoubleIn { x: bits(8) }
/// #     out DoubleOut { twice: bits(8) }
/// # }
/// # impl Double {
/// #     fn build(&self, m: Module, i: DoubleIn) -> DoubleOut {
/// #         DoubleOut { twice: m.pipe("twice", i.x << 1) }
/// #     }
/// # }
/// bundle! { struct Sum<T> { value: T } }
///
/// def!(double = m.instance(&Double, DoubleIn { x: lit(8, 20) }));
/// def!(more = m.stages(2, None, Sum { value: double.twice }, |_, sum| Sum { value: sum.value + 1 }));
/// # m.ignore(&more);
/// # });
/// assert_eq!(example.values("u_double.twice"), [0, 40, 40]);
/// assert_eq!(example.values("more_value2"), [0, 1, 2, 42]);
/// ```
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// def!(count = m.reg(below(3)).reset(0));
/// def!(at_end = count.eq(2));
/// count.next(mux(at_end, 0, count + 1));
/// # });
/// assert_eq!(example.values("count"), [0, 1, 2, 0, 1, 2]);
/// assert_eq!(example.values("at_end"), [0, 0, 1, 0, 0, 1]);
/// ```
///
/// A choice by code takes several lines. In braces its name stays on the first of them, because rustfmt leaves what is
/// in braces as it is. Only [`choose!`](crate::choose!) is written so: rustfmt does not format its arms in any case.
///
/// ```
/// # use tilewright_hdl::*;
/// # let example = tilewright_sim::traced(|m| {
/// codes! { enum Step { Up, Down } }
///
/// def!(count = m.reg(4).reset(0));
/// def!(step = m.fsm(Step::Up));
/// step.next(|step| match step {
///     Step::Up => when(count.eq(2), Step::Down),
///     Step::Down => when(count.eq(1), Step::Up),
/// });
/// def! { following = choose!(step, Step {
///     Up => count + 1,
///     Down => count - 1,
/// }) }
/// count.next(following);
/// # });
/// assert_eq!(example.values("following"), [1, 2, 3, 2, 1, 0, 1]);
/// ```
#[macro_export]
macro_rules! def {
    ($name:ident = $m:ident $(.on($clock:expr))? .reg($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.reg(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .fsm($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.fsm(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .toggle($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.toggle(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .wire($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.wire(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .stream_wire($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.stream_wire(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .memory($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.memory(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .rom($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.rom(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .pipe($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.pipe(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .pipe_when($enable:expr, $($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.pipe_when($enable, stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .synchronize($($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.synchronize(stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .synchronize_from($reset:expr, $($given:tt)*) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.synchronize_from($reset, stringify!($name), $($given)*) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .instance($block:expr, $inputs:expr $(,)?) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.instance(&$crate::instance_name(stringify!($name)), $block, $inputs) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .array($shape:expr, $block:expr, $feed:expr $(,)?) $($then:tt)*) => {
        let $name = $m$(.on($clock))?.array(&$crate::instance_name(stringify!($name)), $shape, $block, $feed) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .stages($($given:tt)*) $($then:tt)*) => {
        let $name = $m.within(stringify!($name), || $m$(.on($clock))?.stages($($given)*)) $($then)*;
    };
    ($name:ident = $m:ident $(.on($clock:expr))? .stream_stages($($given:tt)*) $($then:tt)*) => {
        let $name = $m.within(stringify!($name), || $m$(.on($clock))?.stream_stages($($given)*)) $($then)*;
    };
    ($name:ident = $value:expr) => {
        let $name = $value.named(stringify!($name));
    };
}

/// The name of an instance that is called as the variable.
#[doc(hidden)]
pub fn instance_name(variable: &str) -> String {
    format!("u_{}", unraw(variable))
}
