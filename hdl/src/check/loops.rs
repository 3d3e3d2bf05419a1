//! Combinational loops: on values, through instances, and lane by lane through arrays.

use crate::circuit::Circuit;
use crate::graph::{Edges, cycle_through, cyclic_components};
use crate::ir::{NodeId, Op};
use crate::problem::Problem;
use crate::summary::{self, Summary};
use std::collections::BTreeMap;

/// Reports every loop; whether there is none.
pub(crate) fn check(circuit: &impl Circuit, summaries: &[Summary], problems: &mut Vec<Problem>) -> bool {
    let edges = summary::combinational_edges(circuit, summaries);
    let before = problems.len();
    let components = cyclic_components(&edges);
    for component in &components {
        let has_lanes = component.iter().any(|node| !circuit.node(NodeId(*node)).shape.is_plain());
        if has_lanes {
            problems.extend(lane_loop(circuit, summaries, component));
        } else {
            problems.push(node_loop(circuit, &edges, component));
        }
    }
    if problems.len() == before && !components.is_empty() {
        problems.extend(wiring_loops(circuit, summaries));
    }
    problems.len() == before
}

fn node_loop(circuit: &impl Circuit, edges: &Edges, component: &[u32]) -> Problem {
    // Operands point backwards: the reverse of the cycle is the direction in which values flow.
    let mut hops: Vec<_> = cycle_through(edges, component, first_named(circuit, component));
    hops[1..].reverse();
    report(circuit, hops.into_iter().map(|node| (NodeId(node), None)).collect())
}

/// Loops past all instances, of lanes that do not depend on themselves: instances can be taken one by one, in the order
/// in which they depend on each other, and other nodes cannot.
fn wiring_loops(circuit: &impl Circuit, summaries: &[Summary]) -> Vec<Problem> {
    let edges = Edges::new(circuit.nodes().len(), |node, push| {
        if !matches!(circuit.node(NodeId(node)).op, Op::Output(..)) {
            summary::operands(circuit, summaries, NodeId(node), &mut |operand| push(operand.0));
        }
    });
    cyclic_components(&edges).iter().map(|component| node_loop(circuit, &edges, component)).collect()
}

/// The node to begin the message with: one that the user named, if there is one.
fn first_named(circuit: &impl Circuit, component: &[u32]) -> u32 {
    *component.iter().find(|node| circuit.node(NodeId(**node)).name.is_some()).unwrap_or(&component[0])
}

/// A chain from lane to lane is no loop unless it comes back to the same lane.
fn lane_loop(circuit: &impl Circuit, summaries: &[Summary], component: &[u32]) -> Option<Problem> {
    let mut vertices = Vec::new();
    let mut place = BTreeMap::new();
    for &node in component {
        for lane in 0..circuit.node(NodeId(node)).shape.lanes() {
            place.insert((node, lane), vertices.len() as u32);
            vertices.push((node, lane));
        }
    }
    let edges = Edges::new(vertices.len(), |vertex, push| {
        let (node, lane) = vertices[vertex as usize];
        lane_operands(circuit, summaries, NodeId(node), lane, &mut |node, lane| {
            place.get(&(node.0, lane)).into_iter().for_each(|&vertex| push(vertex));
        });
    });
    let loops = cyclic_components(&edges);
    let found = loops.first()?;
    let mut hops = cycle_through(&edges, found, found[0]);
    hops[1..].reverse();
    let hop = |vertex: u32| {
        let (node, lane) = vertices[vertex as usize];
        (NodeId(node), (!circuit.node(NodeId(node)).shape.is_plain()).then_some(lane))
    };
    Some(report(circuit, hops.into_iter().map(hop).collect()))
}

/// What one lane of a node is computed from.
fn lane_operands(
    circuit: &impl Circuit,
    summaries: &[Summary],
    id: NodeId,
    lane: u32,
    visit: &mut dyn FnMut(NodeId, u32),
) {
    let node = circuit.node(id);
    match &node.op {
        Op::Shifted { of, by, edge } => match lane.checked_add_signed(-by) {
            Some(from) if from < node.shape.lanes() => visit(*of, from),
            _ => visit(*edge, 0),
        },
        Op::Broadcast(a) => visit(*a, 0),
        Op::PerLane(each) => visit(each[lane as usize], 0),
        Op::Lane(of, index) => visit(*of, *index),
        Op::Reduce(_, of) => (0..circuit.node(*of).shape.lanes()).for_each(|lane| visit(*of, lane)),
        _ => summary::operands(circuit, summaries, id, &mut |operand| visit(operand, lane)),
    }
}

fn report(circuit: &impl Circuit, hops: Vec<(NodeId, Option<u32>)>) -> Problem {
    let text = |(node, lane): &(NodeId, Option<u32>)| {
        let lane = lane.map_or(String::new(), |lane| format!("[{lane}]"));
        format!("`{}{lane}`", circuit.describe(*node))
    };
    let mut path: Vec<_> = hops.iter().map(text).collect();
    path.push(path[0].clone());
    let message = format!("a combinational loop in `{}`: {}", circuit.title(), path.join(" -> "));
    let mut problem = Problem::new(circuit.node(hops[0].0).loc, message);
    for hop in &hops {
        problem = problem.note(format!("{} is computed", text(hop)), circuit.node(hop.0).loc);
    }
    problem.help("put a register into the loop, or break it where a value does not depend on the others")
}
