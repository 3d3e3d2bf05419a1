//! The blocks that the tests describe wrongly, and the comparison of a description's problems with a text.

use tilewright_hdl::*;

bundle! {
    pub struct In<T> { pub a: T, pub b: T, pub c: T }
    pub struct Out<T> { pub out: T }
}

/// Describes the one output of a [`Case`].
pub type Build = fn(Module, In) -> Signal;

/// A block of three inputs (8, 7 and 1 bits), described by a function.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
pub struct Case(pub Build);

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Case {{ at: {} }}", self.0 as usize)
    }
}

impl Block for Case {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        In { a: bits(8), b: bits(7), c: bit() }
    }

    fn build(&self, m: Module, i: In) -> Out {
        m.ignore(&i);
        Out { out: (self.0)(m, i) }
    }

    fn name(&self) -> String {
        "case_block".to_owned()
    }
}

bundle! {
    pub struct Link<T> { pub x: T }
}

/// Passes its input on, inverted, in the same cycle or the next.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Inverter {
    pub registered: bool,
}

impl Block for Inverter {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Out {
        Out { out: if self.registered { m.pipe("y", !i.x) } else { !i.x } }
    }
}

codes! { pub enum Lamp { Off, On } }

bundle! {
    pub struct Reserved<T> { pub table: T }
}

/// Drives its one output by its one input.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Through;

impl Block for Through {
    type In = Reserved;
    type Out = Out;

    fn inputs(&self) -> Reserved<Width> {
        Reserved { table: bits(4) }
    }

    fn build(&self, _: Module, i: Reserved) -> Out {
        Out { out: i.table + 1 }
    }
}

pub const FAST: Clock = Clock::new("fast", Period::ns(4));

/// A handle that a block may wrongly keep from the module that instantiates it.
#[derive(Clone, Copy)]
pub enum Kept {
    Memory(Mem),
    Result(Signal),
    Register(Reg),
}

thread_local!(pub static KEPT: std::cell::Cell<Option<Kept>> = const { std::cell::Cell::new(None) });

/// Uses a handle of another module.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Keeper;

impl Block for Keeper {
    type In = ();
    type Out = Out;

    fn inputs(&self) {}

    fn build(&self, _: Module, _: ()) -> Out {
        let out = match KEPT.get().unwrap() {
            Kept::Memory(memory) => memory.read_async(0),
            Kept::Result(signal) => !signal,
            Kept::Register(register) => {
                register.next(0);
                *register
            }
        };
        Out { out }
    }
}

/// The problems as text, each place replaced by the line it points to.
pub fn problems<B: Block>(block: &B) -> String {
    let text = elaborate(block).expect_err("the description is wrong").to_string();
    let place = |line: &str| {
        let (before, after) = line.split_once("hdl/tests/messages/")?;
        let mut after = after.split(':');
        let (file, number) = (after.next()?, after.next()?.parse::<usize>().ok()?);
        let path = format!("{}/messages/{file}", env!("CARGO_MANIFEST_DIR"));
        let source = std::fs::read_to_string(path).expect("the place is in a file of these tests");
        Some(format!("{before}[{}]", source.lines().nth(number - 1)?.trim()))
    };
    text.lines().map(|line| place(line).unwrap_or(line.to_owned())).collect::<Vec<_>>().join("\n")
}

#[track_caller]
pub fn expect(build: Build, expected: &str) {
    let lines: Vec<_> = expected.lines().map(str::trim_start).collect();
    let found = problems(&Case(build));
    let found: Vec<_> = found.lines().map(str::trim_start).collect();
    assert_eq!(found.join("\n"), lines.join("\n").trim());
}
