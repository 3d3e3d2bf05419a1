//! Regular structures take few nodes.

use super::build::Build;
use crate::shapes::machines::{processors, systolic};
use tilewright_hdl::Design;
use tilewright_hdl::ir::{Op, Shape};

#[test]
fn sixteen_thousand_processors_and_their_trees_are_few_nodes() {
    let module = processors(128);
    assert!(module.nodes.len() < 500, "{} nodes", module.nodes.len());
    let design = Design::new(vec![module]).unwrap();
    assert_eq!(design.top().shape(design.top().registers.last().unwrap().node).lanes(), 16_384);
}

#[test]
fn a_systolic_array_takes_as_many_nodes_however_large() {
    let nodes = [2, 8, 64, 256].map(|side| Design::new(vec![systolic(side)]).unwrap().top().nodes.len());
    assert_eq!(nodes, [14; 4]);
}

/// Each lane of a large grid depends on its neighbours through some gates: only linear time is feasible.
#[test]
fn a_combinational_path_through_a_large_grid_is_no_loop() {
    let b = &mut Build::new("paths");
    let grid = Shape::Grid(128, 128);
    let x = b.input("x", 8, grid);
    let (left, above) = (b.input("left", 8, Shape::Row(128)), b.input("above", 8, Shape::Row(128)));
    let value = b.xor(x, x);
    let (from_left, from_above) = (b.previous(value, 1, left), b.previous(value, 0, above));
    let sums = (0..20).fold(b.add(from_left, from_above), |sum, _| b.add(sum, x));
    b.module.nodes[value.0 as usize].op = Op::Wire(sums);
    b.output("value", value);
    Design::new(vec![b.module.clone()]).unwrap();
}
