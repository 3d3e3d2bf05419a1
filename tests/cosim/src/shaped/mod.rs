//! Random circuits with shapes, built node by node: what the circuit can be, whatever the language makes of it.

mod build;
pub mod spec;
pub mod strategy;

pub use spec::Spec;
use tilewright_hdl::ir::Module;
use tilewright_hdl::{Design, Problems, Reset};

/// The design of a description, whose top has this name.
///
/// # Errors
///
/// The rules that it breaks, which is a mistake of this crate.
pub fn design(spec: &Spec, name: &str) -> Result<Design, Problems> {
    let mut modules = build::modules(spec, name);
    // An instance's own clock may be either of its parent's, so both are of one kind.
    let ([kind, _], [edge, _]) = (spec.stimulus.resets(), spec.stimulus.edges());
    modules.iter_mut().for_each(|module| set_resets(module, kind));
    modules.iter_mut().flat_map(|module| &mut module.clocks).for_each(|clock| clock.edge = edge);
    Design::new(modules)
}

/// Lets the clocks of a module, which have synchronous resets, reset in this way.
fn set_resets(module: &mut Module, kind: Reset) {
    for clock in module.clocks.iter_mut().filter(|clock| clock.reset.is_some()) {
        clock.kind = kind;
        clock.reset = clock.reset.take().filter(|_| kind.has_port());
        let low = if kind.is_active_low() { "_n" } else { "" };
        clock.reset.iter_mut().for_each(|port| *port += low);
    }
}
