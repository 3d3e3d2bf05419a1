//! A circuit as text, a line for each node.

use std::fmt::Write;
use tilewright_hdl::ir::Module;

/// The circuit as text.
pub fn text(modules: &[Module]) -> String {
    let mut text = String::new();
    for module in modules {
        module_text(&mut text, module).expect("a string takes text");
    }
    text
}

fn module_text(text: &mut String, module: &Module) -> std::fmt::Result {
    writeln!(text, "module {}", module.name)?;
    for (id, node) in module.nodes.iter().enumerate() {
        let name = node.name.as_deref().unwrap_or("");
        writeln!(text, "  {id:3} {:?} x {} {name} = {:?}", node.shape, node.width, node.op)?;
    }
    for register in &module.registers {
        let (node, next, enable) = (register.node.0, register.next.0, register.enable.map(|id| id.0));
        writeln!(
            text,
            "  register {node}: next {next} enable {enable:?} reset {:?} clock {}",
            register.reset, register.clock.0
        )?;
    }
    for memory in &module.memories {
        let (depth, width, shape) = (memory.depth, memory.width, memory.shape);
        writeln!(
            text,
            "  memory {}: {depth} words of {width}, {shape}, {:?}, {:?}",
            memory.name, memory.policy, memory.contents
        )?;
        memory.reads.iter().try_for_each(|read| writeln!(text, "    {read:?}"))?;
        memory.writes.iter().try_for_each(|write| writeln!(text, "    {write:?}"))?;
    }
    for instance in &module.instances {
        writeln!(
            text,
            "  instance {} of {}, {:?}: {:?} -> {:?}",
            instance.name, instance.module.0, instance.shape, instance.inputs, instance.outputs
        )?;
    }
    module.properties.iter().try_for_each(|it| writeln!(text, "  assert {}: {}", it.condition.0, it.message))?;
    module.outputs.iter().try_for_each(|output| writeln!(text, "  output {} = {}", output.name, output.node.0))
}
