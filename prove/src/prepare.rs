//! The design that is printed for a proof: every register says where it starts, and every statement its number.

use crate::Error;
use tilewright_hdl::ir::{Directive, Init, Module};
use tilewright_hdl::{Design, Loc, Problems};

/// The most bits that the memories may have: each becomes a register.
pub const MOST_MEMORY: u64 = 1 << 16;

/// A statement of the description.
pub struct Stated {
    pub directive: Directive,
    pub message: String,
    pub module: String,
    pub loc: Loc,
}

/// A design for a proof, and its statements.
pub struct Prepared {
    pub design: Design,
    /// By number.
    pub stated: Vec<Stated>,
}

/// Prepares a design.
///
/// # Errors
///
/// It is not one that can be proved.
pub fn prepare(design: &Design) -> Result<Prepared, Error> {
    check(design)?;
    check_statements(design)?;
    prepared(design, |directive| directive != Directive::Display)
}

/// Prepares a design that is compared with another one: of its statements, the assumptions are left.
///
/// # Errors
///
/// It is not one that can be compared.
pub fn prepare_for_equality(design: &Design) -> Result<Prepared, Error> {
    check(design)?;
    let top = design.top();
    if top.outputs.is_empty() {
        return Err(Error::Refused(format!("`{}` has no outputs to compare", top.name)));
    }
    if top.clocks.len() > 1 {
        let clocks = top.clocks.iter().map(|clock| clock.port.as_str()).collect::<Vec<_>>().join(", ");
        let name = &top.name;
        return Err(Error::Refused(format!(
            "`{name}` has several clocks ({clocks}), and modules of one clock are compared: compare its blocks"
        )));
    }
    prepared(design, |directive| directive == Directive::Assume)
}

fn prepared(design: &Design, is_kept: fn(Directive) -> bool) -> Result<Prepared, Error> {
    let mut stated = Vec::new();
    let mut modules = design.clone().into_modules();
    for module in &mut modules {
        module.registers.iter_mut().for_each(|register| {
            if let (None, Some(Init::Same(value))) = (&register.initial, &register.reset) {
                register.initial = Some(value.clone());
            }
        });
        module.properties.retain(|property| is_kept(property.directive));
        number(module, &mut stated);
    }
    let wrong = |problems: Problems| Error::Refused(format!("the design cannot be prepared: {problems}"));
    Ok(Prepared { design: Design::new(modules).map_err(wrong)?, stated })
}

/// Gives each statement its number as a message.
fn number(module: &mut Module, stated: &mut Vec<Stated>) {
    for property in &mut module.properties {
        let message = std::mem::replace(&mut property.message, format!("#{}", stated.len()));
        stated.push(Stated { directive: property.directive, message, module: module.name.clone(), loc: property.loc });
    }
}

fn check(design: &Design) -> Result<(), Error> {
    let refused = |sentence: String| Err(Error::Refused(sentence));
    let top = design.top();
    if let Err(problems) = design.check_models() {
        return refused(problems.to_string());
    }
    let makes = |module: &Module| module.foreign.as_ref().is_some_and(|foreign| !foreign.makes.is_empty());
    if let Some(module) = design.modules().iter().find(|module| makes(module)) {
        let name = &module.name;
        return refused(format!(
            "`{name}` makes clocks, and a proof takes them from outside: prove the blocks that it serves"
        ));
    }
    let bits = memory_bits(design);
    if bits > MOST_MEMORY {
        return refused(format!(
            "the memories of `{}` have {bits} bits, and a proof takes {MOST_MEMORY}: choose smaller parameters",
            top.name
        ));
    }
    Ok(())
}

fn check_statements(design: &Design) -> Result<(), Error> {
    let states = |module: &Module| {
        module.properties.iter().any(|it| matches!(it.directive, Directive::Assert | Directive::Cover))
    };
    if design.modules().iter().any(states) {
        return Ok(());
    }
    Err(Error::Nothing(design.top().name.clone()))
}

/// The bits of all memories of all instances.
fn memory_bits(design: &Design) -> u64 {
    let mut sizes: Vec<u64> = Vec::with_capacity(design.modules().len());
    for module in design.modules() {
        let own = module.memories.iter().map(|it| [it.depth, it.width, it.shape.lanes()].map(u64::from));
        let own = own.map(|sizes| sizes.into_iter().fold(1, u64::saturating_mul));
        let inner = module.instances.iter();
        let inner = inner.map(|it| u64::from(it.shape.lanes()).saturating_mul(sizes[it.module.0 as usize]));
        sizes.push(own.chain(inner).fold(0, u64::saturating_add));
    }
    sizes.last().copied().unwrap_or(0)
}
