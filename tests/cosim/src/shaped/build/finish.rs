//! What is done when all steps are: what was put off, outputs for what nobody reads, clocks that something is on.

use super::*;
use crate::reduce::sweep::{for_each_mention, for_each_use};

impl Builder<'_> {
    pub fn finish(mut self) -> Module {
        for late in std::mem::take(&mut self.late) {
            match late {
                Late::Next(register, pick) => {
                    let next = self.fit(pick, self.build.width(register), self.build.shape(register));
                    let of = self.build.module.registers.iter_mut().find(|it| it.node == register);
                    of.expect("it is a register").next = next;
                }
                Late::Updates(register, updates) => {
                    let (width, shape) = (self.build.width(register), self.build.shape(register));
                    let arms = updates
                        .iter()
                        .map(|&(condition, value)| (self.fit(condition, 1, shape), self.fit(value, width, shape)));
                    let op = Op::Select { arms: arms.collect(), default: register };
                    let next = self.build.node(op, width, shape);
                    self.build.next(register, None, next);
                }
                Late::Data { memory, port, data } => {
                    let (width, shape) = {
                        let memory = &self.build.module.memories[memory];
                        (memory.width, memory.shape)
                    };
                    let data = self.fit(data, width, shape);
                    self.build.module.memories[memory].writes[port].data = data;
                }
            }
        }
        self.outputs();
        let Builder { spec, is_top, build, .. } = self;
        let mut module = build.module;
        clocks(&mut module);
        if spec.odd.order != 0 {
            reorder(&mut module, &mut Numbers(spec.odd.order));
        }
        debug_assert!(is_top || module.clocks.iter().all(|clock| clock.name.is_some() || clock.period.is_none()));
        module
    }

    /// A value of as many bits in all lanes as Verilator prints, of which there are 8192.
    fn printable(&mut self, mut node: NodeId) -> NodeId {
        while self.build.width(node) * self.build.shape(node).lanes() > 8192 && !self.build.shape(node).is_plain() {
            node = self.build.reduce(Reduction::Xor, node, 0);
        }
        node
    }

    /// What nothing reads is an output.
    fn outputs(&mut self) {
        let mut read = vec![false; self.build.module.nodes.len()];
        for_each_use(&mut self.build.module, |id| read[id.0 as usize] = true);
        let mut unread: Vec<NodeId> = (0..).zip(read).filter(|(_, read)| !read).map(|(id, _)| NodeId(id)).collect();
        if unread.is_empty() {
            unread.extend(self.values.last());
        }
        for (number, node) in unread.into_iter().enumerate() {
            let node = if self.is_top { self.printable(node) } else { node };
            let name = self.name(&format!("out_{number}"), Kind::Output);
            self.build.output(&name, node);
        }
    }
}

/// Leaves out clocks and resets that nothing needs.
fn clocks(module: &mut Module) {
    let count = module.clocks.len();
    let (mut used, mut resets) = (vec![false; count], vec![false; count]);
    let mut on = |clock: ClockId, reset: bool| {
        used[clock.0 as usize] = true;
        resets[clock.0 as usize] |= reset;
    };
    module.registers.iter().for_each(|register| on(register.clock, register.reset.is_some()));
    module.properties.iter().for_each(|property| on(property.clock, true));
    for memory in &module.memories {
        memory.reads.iter().filter_map(|read| read.clock).for_each(|clock| on(clock, false));
        memory.writes.iter().for_each(|write| on(write.clock, false));
    }
    // What an instance needs is kept: it was made of a module without what it does not need.
    module.instances.iter().flat_map(|instance| &instance.clocks).for_each(|clock| on(*clock, true));
    let new = |clock: ClockId| ClockId(used[..clock.0 as usize].iter().filter(|used| **used).count() as u32);
    module.registers.iter_mut().for_each(|register| register.clock = new(register.clock));
    module.properties.iter_mut().for_each(|property| property.clock = new(property.clock));
    for memory in &mut module.memories {
        memory.reads.iter_mut().flat_map(|read| &mut read.clock).for_each(|clock| *clock = new(*clock));
        memory.writes.iter_mut().for_each(|write| write.clock = new(write.clock));
    }
    module.instances.iter_mut().flat_map(|it| &mut it.clocks).for_each(|clock| *clock = new(*clock));
    let any = used.contains(&true);
    module.inputs.iter_mut().for_each(|input| input.clock = any.then_some(ClockId(0)));
    let kept =
        std::mem::take(&mut module.clocks).into_iter().zip(used.iter().zip(resets)).filter(|(_, (used, _))| **used);
    module.clocks = kept.map(|(clock, (_, reset))| Clock { reset: clock.reset.filter(|_| reset), ..clock }).collect();
}

/// Puts the nodes into another order.
fn reorder(module: &mut Module, numbers: &mut Numbers) {
    let mut order: Vec<u32> = (0..module.nodes.len() as u32).collect();
    for last in (1..order.len()).rev() {
        order.swap(last, numbers.draw() as usize % (last + 1));
    }
    // Node `i` becomes node `order[i]`.
    for_each_mention(module, |id| *id = NodeId(order[id.0 as usize]));
    let mut placed: Vec<(u32, Node)> = order.iter().copied().zip(std::mem::take(&mut module.nodes)).collect();
    placed.sort_by_key(|(place, _)| *place);
    module.nodes = placed.into_iter().map(|(_, node)| node).collect();
}
