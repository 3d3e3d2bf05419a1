//! Instances of earlier parts: plain, in rows and in grids, and chained lane by lane or copy by copy.

use super::chain::Direction;
use super::*;

impl Builder<'_> {
    pub fn instances(
        &mut self,
        number: usize,
        clock: ClockId,
        part: Pick,
        shape: ShapePick,
        copies: u8,
        inputs: &[(Feed, Pick)],
    ) {
        let Some(back) = usize::from(part.0).checked_rem(self.done.len()) else { return };
        let index = self.done.len() - 1 - back;
        let child = &self.done[index];
        let shape = self.array_shape(self.shape(shape), index);
        let room = MOST_LANES_IN_ALL / (all_lanes(self.done, index) * shape.lanes()).max(1);
        let mut before: Vec<NodeId> = Vec::new();
        for copy in 0..u32::from(copies).clamp(1, room.max(1)) {
            // A name that nothing inside of the instance has: the part's number is above those of the parts below it.
            let name = format!("u{}_{number}_{copy}", self.done.len());
            self.namer.remember(&name);
            let outputs = self.build.instance(&name, index as u32, child, shape, &[]);
            let place = self.build.module.instances.len() - 1;
            let clocks = child.clocks.iter().map(|child| if child.name.is_some() { ClockId(1) } else { clock });
            self.build.module.instances[place].clocks = clocks.collect();
            let feeds = child.inputs.iter().enumerate().map(|(port, input)| {
                let default = (Feed::Value, Pick(port as u16));
                let (feed, pick) = inputs.get(port % inputs.len().max(1)).copied().unwrap_or(default);
                let (width, of) = (child.width(input.node), child.shape(input.node));
                let needs = shape.beside(of).expect("the array has room for its ports");
                match feed {
                    Feed::Index => self.table(width, None, needs),
                    Feed::Previous { .. } if shape.is_plain() && !before.is_empty() => {
                        let output = before[usize::from(pick.0) % before.len()];
                        let output = self.in_width(output, width, false);
                        self.in_shape(output, needs, 1)
                    }
                    Feed::Previous { axis, edge } if !shape.is_plain() => {
                        let output = outputs[usize::from(pick.0) % outputs.len()];
                        let axis = u32::from(axis) % shape.axes();
                        let previous = self.previous(output, axis, edge, inputs[0].1);
                        let previous = self.in_width(previous, width, false);
                        self.for_port(previous, shape, of)
                    }
                    _ => self.fit(pick, width, needs),
                }
            });
            let feeds: Vec<NodeId> = feeds.collect();
            self.build.module.instances[place].inputs = feeds;
            before.clone_from(&outputs);
            // What is wide or long outside is an output as it is.
            let small = outputs.into_iter().filter(|id| self.build.shape(*id).lanes() <= MOST_LANES);
            let small: Vec<NodeId> = small.collect();
            for output in small {
                self.push(number, output);
            }
        }
    }

    /// An output of an array in the lane before; one direction along each axis for the whole array.
    fn previous(&mut self, output: NodeId, axis: u32, edge: Pick, first: Pick) -> NodeId {
        let direction = if (first.0 >> axis).is_multiple_of(2) { Direction::Before } else { Direction::Behind };
        self.map(output, axis, self.build.shape(output).extent(axis), direction.neighbour(), edge)
    }

    /// A value of an array's shape beside that of some port, for a port of that shape.
    fn for_port(&mut self, of: NodeId, array: Shape, port: Shape) -> NodeId {
        let axis = array.axes();
        match (self.build.shape(of).axes() > axis, port) {
            (false, Shape::Plain) => of,
            (true, Shape::Plain) => self.drop(of, axis, 1),
            (false, port) => self.build.broadcast(of, axis, port.lanes()),
            (true, port) => self.spread(of, axis, port.lanes()),
        }
    }

    /// A shape that leaves room for the ports of a module, and that is not too large.
    fn array_shape(&self, wanted: Shape, index: usize) -> Shape {
        let child = &self.done[index];
        let ports = child.inputs.iter().map(|input| input.node).chain(child.outputs.iter().map(|output| output.node));
        let axes = ports.map(|node| child.shape(node).axes()).max().unwrap_or(0);
        let mut shape = wanted;
        while shape.axes() + axes > 2 {
            shape = shape.without(0);
        }
        let most = (MOST_LANES_IN_ALL / all_lanes(self.done, index)).max(1);
        match shape {
            Shape::Row(count) => Shape::Row(count.min(most)),
            shape if shape.lanes() > most => Shape::Plain,
            shape => shape,
        }
    }
}

/// The lanes of the value with most of them in a module, with all that is in it.
fn all_lanes(modules: &[Module], index: usize) -> u32 {
    let module = &modules[index];
    let own = module.nodes.iter().map(|node| node.shape.lanes());
    let inside = module.instances.iter().map(|it| it.shape.lanes() * all_lanes(modules, it.module.0 as usize));
    own.chain(inside).max().unwrap_or(1)
}
