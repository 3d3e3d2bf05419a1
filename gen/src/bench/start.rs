//! What everything that holds state starts from, set through hierarchical paths: Verilog has unknowns, the recorded
//! simulation has not.

use crate::verilog::{State, state};
use std::collections::BTreeMap;
use tilewright_hdl::Bits;
use tilewright_hdl::Recording;
use tilewright_hdl::ir::{Design, Module, ModuleId};

/// The name of the loop variable that steps through a memory.
pub const ADDRESS: &str = "address";

/// The statements and generate loops that set all state to its usual start.
pub fn usual(design: &Design) -> Vec<String> {
    let states: Vec<Vec<State>> = design.modules().iter().map(|module| state(design, module)).collect();
    scope(design, &states, ModuleId(design.modules().len() as u32 - 1), "dut", 0)
}

fn scope(design: &Design, states: &[Vec<State>], id: ModuleId, path: &str, depth: usize) -> Vec<String> {
    let mut out: Vec<String> = states[id.0 as usize].iter().flat_map(|state| start(path, state)).collect();
    for instance in &design.module(id).instances {
        let Some(lanes) = instance.lanes else {
            let path = format!("{path}.{}", instance.name);
            out.extend(scope(design, states, instance.module, &path, depth));
            continue;
        };
        let index = format!("lane{depth}");
        let path = format!("{path}.{}[{index}].lane", instance.name);
        let inner = scope(design, states, instance.module, &path, depth + 1);
        if !inner.is_empty() {
            out.push(format!(
                "for ({index} = 0; {index} < {lanes}; {index} = {index} + 1) begin : start_{}",
                label(&path)
            ));
            out.extend(inner.into_iter().map(|line| format!("    {line}")));
            out.push("end".to_string());
        }
    }
    out
}

/// How deep arrays nest, which is how many loop variables there are.
pub fn array_depth(design: &Design) -> usize {
    let mut depths = Vec::with_capacity(design.modules().len());
    for module in design.modules() {
        depths.push(deepest(module, &depths));
    }
    depths.last().copied().unwrap_or(0)
}

fn deepest(module: &Module, depths: &[usize]) -> usize {
    let below = |i: &tilewright_hdl::ir::Instance| depths[i.module.0 as usize] + usize::from(i.lanes.is_some());
    module.instances.iter().map(below).max().unwrap_or(0)
}

/// A path as a label: `dut.u_row.u_cell[lane0].lane` is `u_row_u_cell`.
fn label(path: &str) -> String {
    let named = path.split('.').skip(1).filter(|part| *part != "lane");
    let words: Vec<&str> = named.map(|part| part.split('[').next().unwrap_or(part)).collect();
    words.join("_")
}

fn start(path: &str, state: &State) -> Vec<String> {
    match state {
        State::Register { name, start } => vec![format!("initial {path}.{name} = {start};")],
        State::GatedRead { word, inside, width, .. } => {
            vec![format!("initial {path}.{word} = {};", Bits::zero(*width)), format!("initial {path}.{inside} = 1'b0;")]
        }
        State::Memory { name, depth, width } => {
            let zero = Bits::zero(*width);
            let block = format!("fill_{}", label(&format!("{path}.{name}")));
            vec![
                format!("initial begin : {block}"),
                format!("    integer {ADDRESS};"),
                format!("    for ({ADDRESS} = 0; {ADDRESS} < {depth}; {ADDRESS} = {ADDRESS} + 1)"),
                format!("        {path}.{name}[{ADDRESS}] = {zero};"),
                "end".to_string(),
            ]
        }
    }
}

/// The assignments that the recording asks for.
pub fn special(design: &Design, recording: &Recording) -> Vec<String> {
    let mut states: BTreeMap<u32, Vec<State>> = BTreeMap::new();
    let mut out = Vec::new();
    for initial in &recording.initial {
        let (module, path, name) = find(design, &initial.path);
        let states = states.entry(module.0).or_insert_with(|| state(design, design.module(module)));
        let value = || {
            assert!(
                initial.words.len() == 1,
                "`{}` is one value, the recording gives {}",
                initial.path,
                initial.words.len()
            );
            &initial.words[0]
        };
        let found = states.iter().find_map(|state| match state {
            State::Register { name: known, .. } if known == name => Some(vec![format!("{path}.{name} = {};", value())]),
            State::GatedRead { name: known, word, inside, .. } if known == name => {
                Some(vec![format!("{path}.{word} = {};", value()), format!("{path}.{inside} = 1'b1;")])
            }
            State::Memory { name: known, .. } if known == name => {
                let assign = |(address, word)| format!("{path}.{name}[{address}] = {word};");
                Some(initial.words.iter().enumerate().map(assign).collect())
            }
            _ => None,
        });
        out.extend(found.unwrap_or_else(|| no_state(&initial.path)));
    }
    out
}

fn no_state(path: &str) -> ! {
    panic!("the recording gives `{path}` an initial value, but the design has no such register or unknown memory")
}

/// The module, the Verilog path of its instance, and the last name of a path such as `u_row.u_cell[3].q`.
fn find<'a>(design: &Design, path: &'a str) -> (ModuleId, String, &'a str) {
    let (scopes, name) = path.rsplit_once('.').unwrap_or(("", path));
    let (mut module, mut verilog) = (ModuleId(design.modules().len() as u32 - 1), "dut".to_string());
    for scope in scopes.split('.').filter(|scope| !scope.is_empty()) {
        let instance_name = scope.split('[').next().unwrap_or(scope);
        let instance = design.module(module).instances.iter().find(|instance| instance.name == instance_name);
        let instance = instance.unwrap_or_else(|| no_state(path));
        let lane = if instance.lanes.is_some() { ".lane" } else { "" };
        verilog = format!("{verilog}.{scope}{lane}");
        module = instance.module;
    }
    (module, verilog, name)
}
