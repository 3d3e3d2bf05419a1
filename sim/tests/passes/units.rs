//! Instances that run one by one.

use tilewright_hdl::{Module, bit, bits, block, def, row};
use tilewright_sim::{Pass, Passes};

use crate::passes::{after, after_with};

block! {
    /// Adds while it is told to.
    struct Node;
    in NodeIn { go: bit(), x: bits(8) }
    out NodeOut { sum: _ }
}

impl Node {
    fn build(&self, m: Module, i: NodeIn) -> NodeOut {
        let sum = m.reg("sum", 8).reset(0);
        sum.when(i.go, sum + i.x);
        NodeOut { sum: *sum }
    }
}

block! {
    /// Each adds the previous one's value.
    struct Nodes;
    in NodesIn { go: bits(2) }
    out NodesOut { all: _ }
}

impl Nodes {
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
