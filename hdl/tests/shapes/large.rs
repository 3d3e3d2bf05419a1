//! What is regular takes few nodes.

use crate::machines::{processors, systolic};
use tilewright_hdl::Design;

#[test]
fn sixteen_thousand_processors_and_their_trees_are_few_nodes() {
    let module = processors(128);
    assert!(module.nodes.len() < 500, "{} nodes", module.nodes.len());
    let design = Design::new(vec![module]).unwrap();
    assert_eq!(design.top().shape(design.top().registers.last().unwrap().node).lanes(), 16_384);
}

#[test]
fn a_systolic_array_takes_as_many_nodes_however_large() {
    let nodes = [2, 8, 64, 512].map(|side| Design::new(vec![systolic(side)]).unwrap().top().nodes.len());
    assert_eq!(nodes, [14; 4]);
}
