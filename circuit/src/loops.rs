//! Combinational loops: through values, through instances, and lane by lane for values with lanes.

use crate::graph::Graph;
use crate::ir::{NodeId, Shape};
use crate::lane_loops;
use crate::limits::MOST_LOOPED_LANES;
use crate::mistake::Mistake;
use crate::netlist::Netlist;
use crate::problem::Problem;
use crate::summary::{self, Summary};

/// Reports every loop. If there is none, returns the combinational graph.
pub fn check(circuit: &impl Netlist, summaries: &[Summary], problems: &mut Vec<Problem>) -> Option<Graph> {
    let graph = summary::combinational(circuit, summaries);
    let before = problems.len();
    for component in &graph.cyclic_components() {
        let shape = |node: &u32| circuit.node(NodeId(*node)).shape;
        if component.iter().all(|node| shape(node).is_plain()) {
            problems.push(node_loop(circuit, &graph, component));
            continue;
        }
        let lanes = component.iter().map(|node| u64::from(shape(node).lanes())).sum();
        if lanes > MOST_LOOPED_LANES {
            problems.push(too_many(circuit, component, lanes));
            continue;
        }
        let found = lane_loops::find(circuit, summaries, component);
        problems.extend(found.map(|hops| report(circuit, hops)));
    }
    (problems.len() == before).then_some(graph)
}

fn node_loop(circuit: &impl Netlist, graph: &Graph, component: &[u32]) -> Problem {
    // Operands point backwards: the reverse of the cycle is the direction in which values flow.
    let mut hops: Vec<_> = graph.cycle_through(component, first_named(circuit, component));
    hops[1..].reverse();
    report(circuit, hops.into_iter().map(|node| (NodeId(node), 0)).collect())
}

fn too_many(circuit: &impl Netlist, component: &[u32], lanes: u64) -> Problem {
    let node = NodeId(first_named(circuit, component));
    let (title, text) = (circuit.title(), circuit.describe(node));
    let message = format!(
        "`{text}` of `{title}` is on a path that comes back to it, of {lanes} lanes: more than {MOST_LOOPED_LANES} are not \
         looked through for a combinational loop"
    );
    Problem::new(Mistake::UncheckedLoop, circuit.node(node).loc, message)
        .help("put a register into the path, or make the array smaller")
}

/// The node that begins the message: one that the user named, if possible.
fn first_named(circuit: &impl Netlist, component: &[u32]) -> u32 {
    *component.iter().find(|node| circuit.node(NodeId(**node)).name.is_some()).unwrap_or(&component[0])
}

/// Reports a loop. `hops` are nodes in the direction in which values flow, each with one of its lanes.
fn report(circuit: &impl Netlist, hops: Vec<(NodeId, u32)>) -> Problem {
    let text = |(node, lane): &(NodeId, u32)| {
        let lane = match circuit.node(*node).shape {
            Shape::Plain => String::new(),
            Shape::Row(_) => format!("[{lane}]"),
            Shape::Grid(_, columns) => format!("[{}][{}]", lane / columns, lane % columns),
        };
        format!("`{}{lane}`", circuit.describe(*node))
    };
    let mut path: Vec<_> = hops.iter().map(text).collect();
    path.push(path[0].clone());
    let message = format!("a combinational loop in `{}`: {}", circuit.title(), path.join(" -> "));
    let mut problem = Problem::new(Mistake::CombinationalLoop, circuit.node(hops[0].0).loc, message);
    for hop in &hops {
        problem = problem.note(format!("{} is computed", text(hop)), circuit.node(hop.0).loc);
    }
    problem.help("put a register into the loop, or break it where a value does not depend on the others")
}
