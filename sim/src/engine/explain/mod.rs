//! The effect of each pass on a circuit, in words, for users and for tests.

mod functions;
mod loops;
mod operation;
mod pass;
mod text;

use tilewright_circuit::ir::Design;

use super::program::{Program, compile, flat, tidy};
use super::{Passes, fields, pack};
pub(crate) use operation::operation;
pub use pass::Pass;
pub(super) use text::{Names, Text};

/// The circuit after a pass.
///
/// ```
/// use tilewright_sim::{Pass, Passes, explain, for_examples::Counter};
///
/// let design = tilewright_hdl::elaborate(&Counter).unwrap();
/// let flat = &explain(&design, &Passes::default())[0];
/// assert_eq!(flat.pass, Pass::Flatten);
/// assert!(flat.text.contains("count"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Explained {
    /// The pass.
    pub pass: Pass,
    /// The circuit: a line for each value, with its name or number, its lanes and width, its operation, and its place
    /// in the description.
    pub text: String,
}

/// A design after each pass, with the passes that are switched on.
///
/// ```
/// use tilewright_sim::{Pass, Passes, explain, for_examples::Counter};
///
/// let design = tilewright_hdl::elaborate(&Counter).unwrap();
/// let all = explain(&design, &Passes::default());
/// assert!(all.is_sorted_by_key(|explained| explained.pass));
/// // Without passes, the first two are equal.
/// let none = explain(&design, &Passes::none());
/// assert_eq!(none[0].text, none[1].text);
/// ```
pub fn explain(design: &Design, passes: &Passes) -> Vec<Explained> {
    let mut all = Vec::new();
    let mut add = |pass, text| all.push(Explained { pass, text });
    let none = Passes { guarded: passes.guarded, ..Passes::none() };
    add(Pass::Flatten, Text::of(&flat(design, &none)).program());
    let mut some = Passes { siblings: passes.siblings, ..none };
    add(Pass::Siblings, Text::of(&flat(design, &some)).program());
    let mut front = |pass, switch: fn(&mut Passes, &Passes)| {
        switch(&mut some, passes);
        add(pass, Text::of(&compile(design, &some)).program());
    };
    front(Pass::Share, |some, all| some.share = all.share);
    front(Pass::Fold, |some, all| some.fold = all.fold);
    front(Pass::Uniform, |some, all| some.uniform = all.uniform);
    front(Pass::Lift, |some, all| some.lift = all.lift);
    let whole = compile(design, passes);
    let program = fields::split(&whole).program;
    let mut changed = |pass, before: Program, after: &Program| {
        let is_other = after.circuit.len() > before.circuit.len();
        add(pass, Text::of(&if is_other { tidy(after.clone()) } else { before }).program());
    };
    changed(Pass::Fields, whole, &program);
    let split = program.clone();
    let program = pack::pack(program).program;
    changed(Pass::Pack, split, &program);
    for (pass, text) in functions::explain(&program) {
        add(pass, text);
    }
    all
}
