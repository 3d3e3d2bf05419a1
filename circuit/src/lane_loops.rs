//! Combinational loops, lane by lane: a chain from lane to lane is a loop only if it returns to the same lane.

use crate::graph::Graph;
use crate::ir::{NodeId, Op};
use crate::netlist::Netlist;
use crate::summary::{self, Summary};
use std::collections::BTreeMap;

/// Finds a loop through the lanes of these mutually dependent nodes. The result lists each node with its lane, in the
/// direction in which values flow.
pub(crate) fn find(circuit: &impl Netlist, summaries: &[Summary], component: &[u32]) -> Option<Vec<(NodeId, u32)>> {
    let lanes = Lanes::new(circuit, summaries, component);
    let graph = lanes.graph();
    let loops = graph.cyclic_components();
    let found = loops.first()?;
    // A whole port has no name: the loop begins at a lane.
    let start = *found.iter().find(|vertex| lanes.node(**vertex).is_some())?;
    let mut hops = graph.cycle_through(found, start);
    // Operands point backwards.
    hops[1..].reverse();
    Some(hops.into_iter().filter_map(|vertex| lanes.node(vertex)).collect())
}

/// The lanes of some nodes as vertices of a graph.
struct Lanes<'a, C> {
    circuit: &'a C,
    summaries: &'a [Summary],
    /// The vertex of the first lane, then the node.
    firsts: Vec<(u32, NodeId)>,
    /// The vertex of each node's first lane.
    first: BTreeMap<NodeId, u32>,
    /// The vertices that stand for whole ports. The key is a node that feeds shaped ports, with the number of
    /// instances. A value that depends on a port depends on all its lanes.
    ports: BTreeMap<(NodeId, u32), u32>,
    count: u32,
}

impl<'a, C: Netlist> Lanes<'a, C> {
    fn new(circuit: &'a C, summaries: &'a [Summary], component: &[u32]) -> Lanes<'a, C> {
        let (firsts, first, ports) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
        let mut lanes = Lanes { circuit, summaries, firsts, first, ports, count: 0 };
        for &node in component {
            let node = NodeId(node);
            lanes.firsts.push((lanes.count, node));
            lanes.first.insert(node, lanes.count);
            lanes.count += circuit.node(node).shape.lanes();
        }
        for &node in component {
            lanes.add_ports(NodeId(node));
        }
        lanes
    }

    /// Adds the vertices of the whole ports that the output `node` depends on.
    fn add_ports(&mut self, node: NodeId) {
        let Op::Output(instance, _) = self.circuit.node(node).op else { return };
        let instances = self.circuit.instances()[instance.0 as usize].shape.lanes();
        let (circuit, summaries) = (self.circuit, self.summaries);
        summary::operands(circuit, summaries, node, &mut |driver| {
            let is_whole = circuit.node(driver).shape.lanes() > instances;
            if is_whole && self.first.contains_key(&driver) && !self.ports.contains_key(&(driver, instances)) {
                self.ports.insert((driver, instances), self.count);
                self.count += instances;
            }
        });
    }

    /// The node and the lane of a vertex; `None` for a whole port.
    fn node(&self, vertex: u32) -> Option<(NodeId, u32)> {
        let (first, node) = self.firsts[self.firsts.partition_point(|(first, _)| *first <= vertex) - 1];
        let lane = vertex - first;
        (lane < self.circuit.node(node).shape.lanes()).then_some((node, lane))
    }

    fn graph(&self) -> Graph {
        let mut ports: Vec<_> =
            self.ports.iter().map(|(&(node, instances), &first)| (first, node, instances)).collect();
        ports.sort_unstable();
        let mut vertices = self.firsts.iter().flat_map(|&(_, node)| {
            (0..self.circuit.node(node).shape.lanes()).map(move |lane| Vertex::Lane(node, lane))
        });
        let mut whole = ports.iter().flat_map(|&(_, node, instances)| {
            (0..instances).map(move |instance| Vertex::Port { driver: node, instances, instance })
        });
        Graph::new(self.count as usize, |_, push| match vertices.next().or_else(|| whole.next()) {
            Some(Vertex::Lane(node, lane)) => self.lane(node, lane, push),
            Some(Vertex::Port { driver, instances, instance }) => {
                let lanes = self.circuit.node(driver).shape.lanes() / instances;
                (0..lanes).for_each(|lane| self.push(driver, instance * lanes + lane, push));
            }
            None => unreachable!("as many vertices as were counted"),
        })
    }

    fn push(&self, node: NodeId, lane: u32, push: &mut dyn FnMut(u32)) {
        if let Some(first) = self.first.get(&node) {
            push(first + lane);
        }
    }

    /// Pushes the vertices that one lane of a node is computed from.
    fn lane(&self, id: NodeId, lane: u32, push: &mut dyn FnMut(u32)) {
        let node = self.circuit.node(id);
        let shape = node.shape;
        let shape_of = |of: &NodeId| self.circuit.node(*of).shape;
        match &node.op {
            Op::Broadcast { of, axis } | Op::Unpack { of, axis } => self.push(*of, shape.across(*axis, lane), push),
            Op::Stack { parts, axis } => {
                self.push(parts[shape.along(*axis, lane) as usize], shape.across(*axis, lane), push);
            }
            Op::Map { of, axis, index, edge } => {
                let (along, across, from) = (shape.along(*axis, lane), shape.across(*axis, lane), shape_of(of));
                match (index.source(along, from.extent(*axis)), edge) {
                    (Some(along), _) => self.push(*of, from.lane(*axis, along, across), push),
                    (None, Some(edge)) => self.push(*edge, across, push),
                    (None, None) => {}
                }
            }
            Op::Interleave { parts, axis } => {
                let (along, k) = (shape.along(*axis, lane), parts.len() as u32);
                let part = parts[(along % k) as usize];
                self.push(part, shape_of(&part).lane(*axis, along / k, shape.across(*axis, lane)), push);
            }
            Op::Lane { of, axis, index } => self.push(*of, shape_of(of).lane(*axis, *index, lane), push),
            Op::Reduce { of, axis, .. } | Op::Pack { of, axis } => self.all_along(*of, *axis, lane, push),
            Op::Pick { of, axis, index } => {
                self.all_along(*of, *axis, lane, push);
                self.push(*index, lane, push);
            }
            Op::Output(instance, _) => {
                let instances = self.circuit.instances()[instance.0 as usize].shape.lanes();
                self.output(id, instances, lane / (shape.lanes() / instances), push);
            }
            // Elementwise, except for a memory's plain address.
            _ => summary::operands(self.circuit, self.summaries, id, &mut |operand| {
                self.push(operand, if shape_of(&operand).is_plain() { 0 } else { lane }, push);
            }),
        }
    }

    fn all_along(&self, of: NodeId, axis: u32, across: u32, push: &mut dyn FnMut(u32)) {
        let shape = self.circuit.node(of).shape;
        (0..shape.extent(axis)).for_each(|along| self.push(of, shape.lane(axis, along, across), push));
    }

    /// Pushes the dependencies of an output of instance `instance` of `instances`: whole ports.
    fn output(&self, output: NodeId, instances: u32, instance: u32, push: &mut dyn FnMut(u32)) {
        summary::operands(
            self.circuit,
            self.summaries,
            output,
            &mut |driver| match self.ports.get(&(driver, instances)) {
                Some(first) => push(first + instance),
                None => self.push(driver, instance, push),
            },
        );
    }
}

enum Vertex {
    Lane(NodeId, u32),
    /// The lanes of `driver` that feed a port of one of several instances.
    Port {
        driver: NodeId,
        instances: u32,
        instance: u32,
    },
}
