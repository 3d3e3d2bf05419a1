//! What everything that holds state starts from, set through hierarchical paths: Verilog has unknowns, the recorded
//! simulation has not.

use crate::verilog::{ModuleState, Names, Scope, State, state};
use tilewright_hdl::Bits;
use tilewright_hdl::Recording;
use tilewright_hdl::ir::{Design, Module, ModuleId};

/// The start of everything in a design, in the terms of the testbench around it.
pub struct Start<'a> {
    design: &'a Design,
    /// By module.
    states: Vec<ModuleState>,
    /// The instance of the top.
    dut: &'a str,
    /// The loop variables of nested arrays, from the outside to the inside.
    pub genvars: Vec<String>,
}

impl<'a> Start<'a> {
    /// Takes the names of loop variables from `names`.
    pub fn new(design: &'a Design, dut: &'a str, names: &mut Names) -> Start<'a> {
        let states = design.modules().iter().map(|module| state(design, module)).collect();
        let genvars = (0..array_depth(design)).map(|depth| names.fresh(&format!("lane{depth}"))).collect();
        Start { design, states, dut, genvars }
    }

    /// The statements and generate loops that set all state to its usual start; takes their labels from `names`.
    pub fn usual(&self, names: &mut Names) -> Vec<String> {
        self.scope(ModuleId(self.design.modules().len() as u32 - 1), self.dut, 0, names)
    }

    fn scope(&self, id: ModuleId, path: &str, depth: usize, names: &mut Names) -> Vec<String> {
        let state = &self.states[id.0 as usize];
        let mut out: Vec<String> = state.own.iter().flat_map(|state| start(path, state, names)).collect();
        for (instance, lane) in self.design.module(id).instances.iter().zip(&state.lanes) {
            let (false, Some(lane)) = (instance.shape.is_plain(), lane) else {
                let path = format!("{path}.{}", instance.name);
                out.extend(self.scope(instance.module, &path, depth, names));
                continue;
            };
            let (index, lanes) = (&self.genvars[depth], instance.shape.lanes());
            let path = format!("{path}.{}[{index}].{lane}", instance.name);
            let inner = self.scope(instance.module, &path, depth + 1, names);
            if !inner.is_empty() {
                let label = names.fresh(&format!("start_{}", label(&path)));
                out.push(format!("for ({index} = 0; {index} < {lanes}; {index} = {index} + 1) begin : {label}"));
                out.extend(inner.into_iter().map(|line| format!("    {line}")));
                out.push("end".to_string());
            }
        }
        out
    }

    /// The assignments that the recording asks for.
    pub fn special(&self, recording: &Recording) -> Vec<String> {
        let mut out = Vec::new();
        for initial in &recording.initial {
            let (module, path, name) = self.find(&initial.path);
            let states = &self.states[module.0 as usize].own;
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
                State::Register { name: known, .. } if known == name => {
                    Some(vec![format!("{path}.{name} = {};", value())])
                }
                State::GatedRead { name: known, word, inside, .. } if known == name => {
                    Some(vec![format!("{path}.{word} = {};", value()), format!("{path}.{inside} = 1'b1;")])
                }
                State::Memory { name: known, .. } if known == name => {
                    let assign = |(address, word)| format!("{path}.{name}[{address}] = {word};");
                    Some((initial.address..).zip(&initial.words).map(assign).collect())
                }
                _ => None,
            });
            out.extend(found.unwrap_or_else(|| no_state(&initial.path)));
        }
        out
    }

    /// The module, the Verilog path of its instance, and the last name of a path such as `u_row.u_cell[3].q`.
    fn find<'p>(&self, path: &'p str) -> (ModuleId, String, &'p str) {
        let (scopes, name) = path.rsplit_once('.').unwrap_or(("", path));
        let (mut module, mut verilog) = (ModuleId(self.design.modules().len() as u32 - 1), self.dut.to_string());
        for scope in scopes.split('.').filter(|scope| !scope.is_empty()) {
            let instance_name = scope.split('[').next().unwrap_or(scope);
            let instances = self.design.module(module).instances.iter().zip(&self.states[module.0 as usize].lanes);
            let found = { instances }.find(|(instance, _)| instance.name == instance_name);
            let (instance, lane) = found.unwrap_or_else(|| no_state(path));
            let lane = lane.as_ref().map(|lane| format!(".{lane}")).unwrap_or_default();
            verilog = format!("{verilog}.{scope}{lane}");
            module = instance.module;
        }
        (module, verilog, name)
    }
}

/// How deep arrays nest.
fn array_depth(design: &Design) -> usize {
    let mut depths = Vec::with_capacity(design.modules().len());
    for module in design.modules() {
        depths.push(deepest(module, &depths));
    }
    depths.last().copied().unwrap_or(0)
}

fn deepest(module: &Module, depths: &[usize]) -> usize {
    let below = |i: &tilewright_hdl::ir::Instance| depths[i.module.0 as usize] + usize::from(!i.shape.is_plain());
    module.instances.iter().map(below).max().unwrap_or(0)
}

/// A path as a label: `dut.u_row.u_cell[lane0].lane` is `u_row_u_cell`.
fn label(path: &str) -> String {
    let named = path.split('.').skip(1).filter(|part| *part != "lane");
    let words: Vec<&str> = named.map(|part| part.split('[').next().unwrap_or(part)).collect();
    words.join("_")
}

fn start(path: &str, state: &State, names: &mut Names) -> Vec<String> {
    match state {
        State::Register { name, start } => vec![format!("initial {path}.{name} = {start};")],
        State::GatedRead { word, inside, width, .. } => {
            vec![format!("initial {path}.{word} = {};", Bits::zero(*width)), format!("initial {path}.{inside} = 1'b0;")]
        }
        State::Memory { is_unknown: false, .. } => vec![],
        State::Memory { name, depth, width, .. } => {
            let zero = Bits::zero(*width);
            let block = names.fresh(&format!("fill_{}", label(&format!("{path}.{name}"))));
            let address = names.fresh_in(&mut Scope::default(), "word", "address");
            vec![
                format!("initial begin : {block}"),
                format!("    integer {address};"),
                format!("    for ({address} = 0; {address} < {depth}; {address} = {address} + 1)"),
                format!("        {path}.{name}[{address}] = {zero};"),
                "end".to_string(),
            ]
        }
    }
}

fn no_state(path: &str) -> ! {
    panic!("the recording gives `{path}` an initial value, but the design has no such register or memory")
}
