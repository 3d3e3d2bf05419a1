//! Pads: instances whose line comes from outside of the design.

use super::{Instance, Module, NodeId, Op, Property};
use crate::names::port_name;

impl Instance {
    /// What the outside of a pad does: the value, and whether it drives. An enable may follow these inputs.
    #[doc(hidden)]
    pub fn outside(&self) -> Option<[NodeId; 2]> {
        match self.inputs[..] {
            [_, _, value, drives, ..] => Some([value, drives]),
            _ => None,
        }
    }
}

impl Module {
    /// The name of the `inout` port of a pad: that of the two inputs for its outside, which only the pad reads.
    #[doc(hidden)]
    pub fn pad_port(&self, pad: &Instance) -> Option<String> {
        let [value, drives] = pad.outside()?;
        let path = |node: NodeId| match self.node(node).op {
            Op::Input(index) if self.uses(node) == 1 => Some(self.inputs[index as usize].path.as_str()),
            _ => None,
        };
        let name = path(value)?.strip_suffix(".value")?;
        (path(drives)?.strip_suffix(".drives")? == name).then(|| port_name("", name))
    }

    /// How often a node is read.
    fn uses(&self, node: NodeId) -> usize {
        let mut count = 0;
        let mut read = |of: NodeId| count += usize::from(of == node);
        self.nodes.iter().for_each(|it| it.op.for_each_operand(&mut read));
        self.outputs.iter().for_each(|output| read(output.node));
        self.properties.iter().flat_map(Property::nodes).for_each(&mut read);
        self.registers
            .iter()
            .for_each(|register| register.enable.into_iter().chain([register.next]).for_each(&mut read));
        for memory in &self.memories {
            memory.reads.iter().for_each(|port| port.enable.into_iter().chain([port.address]).for_each(&mut read));
            memory
                .writes
                .iter()
                .for_each(|port| [port.enable, port.address, port.data].into_iter().for_each(&mut read));
        }
        self.instances.iter().for_each(|instance| instance.inputs.iter().copied().for_each(&mut read));
        count
    }
}
