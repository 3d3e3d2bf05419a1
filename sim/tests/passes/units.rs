//! Instances that run one by one.

use tilewright_hdl::{Block, Module, Width, bit, bits, bundle, def, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with};

bundle! {
    pub struct NodeIn<T> { pub go: T, pub x: T }
    pub struct NodeOut<T> { pub sum: T }
}

/// Adds while it is told to.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Node;

impl Block for Node {
    type In = NodeIn;
    type Out = NodeOut;

    fn inputs(&self) -> NodeIn<Width> {
        NodeIn { go: bit(), x: bits(8) }
    }

    fn build(&self, m: Module, i: NodeIn) -> NodeOut {
        let sum = m.reg("sum", 8).reset(0);
        sum.when(i.go, sum + i.x);
        NodeOut { sum: *sum }
    }
}

bundle! {
    pub struct NodesIn<T> { pub go: T }
    pub struct NodesOut<T> { pub all: T }
}

/// Each adds the previous one's value.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Nodes;

impl Block for Nodes {
    type In = NodesIn;
    type Out = NodesOut;

    fn inputs(&self) -> NodesIn<Width> {
        NodesIn { go: bits(2) }
    }

    fn build(&self, m: Module, i: NodesIn) -> NodesOut {
        def!(is_busy = i.go.unpack(row(2)));
        let nodes = m.array("u_node", 2, &Node, |nodes| NodeIn { go: is_busy, x: nodes.sum.previous(1) });
        NodesOut { all: nodes.sum.pack() }
    }
}

#[test]
fn units() {
    let passes = Passes { apart_from: 1, apart_single: 0, ..Passes::default() };
    let edge = after_with(&Nodes, Pass::Edge, &passes);
    for unit in ["unit 0", "unit 1"] {
        assert!(
            edge.contains(&format!("  {unit}, skipped unless something else crosses: 1 changes, crossing: ")),
            "{edge}"
        );
    }
    assert!(!after(&Nodes, Pass::Edge).contains("unit 0"), "an array of few lanes runs in lanes");
}
