//! The start of all state, set through hierarchical paths: Verilog has unknown values, but the recorded simulation
//! has none.

use crate::verilog::{ModuleState, Names, ScopeState, State, pattern, states};
use tilewright_hdl::Bits;
use tilewright_hdl::Recording;
use tilewright_hdl::ir::{Design, Module, ModuleId, Shape};

/// The start of all state in a design, by paths from the testbench.
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
        let states = states(design);
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
        for instance in self.design.module(id).instances.iter().filter(|instance| instance.shape.is_plain()) {
            let path = format!("{path}.{}", instance.name);
            out.extend(self.scope(instance.module, &path, depth, names));
        }
        for scope in &state.scopes {
            out.extend(self.lanes(id, scope, path, depth, names));
        }
        out
    }

    /// The loops over the scopes of lanes.
    fn lanes(&self, id: ModuleId, scope: &ScopeState, path: &str, depth: usize, names: &mut Names) -> Vec<String> {
        if scope.own.is_empty() && scope.instances.is_empty() {
            return Vec::new();
        }
        let axes = scope.shape.axes() as usize;
        let indices: Vec<&str> = self.genvars[depth..depth + axes].iter().map(String::as_str).collect();
        let lane = format!("{path}.{}", scope.path(&indices));
        let mut inner: Vec<String> = Vec::new();
        for state in &scope.own {
            match state {
                State::Register { name, start } if start.len() > 1 => {
                    inner.extend(start_each(&lane, name, start, scope, &indices, names))
                }
                state => inner.extend(start(&lane, state, names)),
            }
        }
        for (instance, name) in &scope.instances {
            let child = self.design.module(id).instances[instance.0 as usize].module;
            inner.extend(self.scope(child, &format!("{lane}.{name}"), depth + axes, names));
        }
        if inner.is_empty() {
            return inner;
        }
        let named = scope.instances.first().filter(|_| scope.own.is_empty()).map(|(_, name)| format!(".{name}"));
        let label = names.fresh(&format!("start_{}", label(&format!("{lane}{}", named.unwrap_or_default()))));
        for (axis, index) in (0..axes as u32).zip(&indices).rev() {
            let lanes = scope.shape.extent(axis);
            let label = if axis == 0 { label.clone() } else { names.fresh(&format!("{label}_col")) };
            let head = format!("for ({index} = 0; {index} < {lanes}; {index} = {index} + 1) begin : {label}");
            let body = inner.into_iter().map(|line| format!("    {line}"));
            inner = [head].into_iter().chain(body).chain(["end".to_string()]).collect();
        }
        inner
    }

    /// The assignments for the recording's initial values.
    pub fn special(&self, recording: &Recording) -> Vec<String> {
        let mut out = Vec::new();
        for initial in &recording.initial {
            let (module, path, name) = self.find(&initial.path);
            let (name, states) = self.named(module, name);
            let path = path + &states.0;
            let states = states.1;
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
                    Some(vec![format!("{path}.{name} = {};", pattern(value()))])
                }
                State::GatedRead { name: known, word, inside, .. } if known == name => {
                    Some(vec![format!("{path}.{word} = {};", pattern(value())), format!("{path}.{inside} = 1'b1;")])
                }
                State::Memory { name: known, .. } if known == name => {
                    let assign = |(address, word)| format!("{path}.{name}[{address}] = {};", pattern(word));
                    Some((initial.address..).zip(&initial.words).map(assign).collect())
                }
                _ => None,
            });
            out.extend(found.unwrap_or_else(|| no_state(&initial.path)));
        }
        out
    }

    /// The last name of a path without its lane, the name of its state, and the scope of that state.
    fn named<'p>(&self, module: ModuleId, name: &'p str) -> (&'p str, (String, &[State])) {
        let state = &self.states[module.0 as usize];
        let Some((base, _)) = name.split_once('[') else { return (name, (String::new(), &state.own)) };
        let holds = |state: &State| match state {
            State::Register { name, .. } | State::GatedRead { name, .. } | State::Memory { name, .. } => name == base,
        };
        match state.scopes.iter().find(|scope| scope.own.iter().any(holds)) {
            Some(scope) => (base, (format!(".{}", scope.path(&indices(name))), &scope.own)),
            None => (name, (String::new(), &state.own)),
        }
    }

    /// The module, the Verilog path of its instance, and the last name of a path such as `u_row.u_cell[3].q`.
    fn find<'p>(&self, path: &'p str) -> (ModuleId, String, &'p str) {
        let (scopes, name) = path.rsplit_once('.').unwrap_or(("", path));
        let (mut module, mut verilog) = (ModuleId(self.design.modules().len() as u32 - 1), self.dut.to_string());
        for scope in scopes.split('.').filter(|scope| !scope.is_empty()) {
            let instance_name = scope.split('[').next().unwrap_or(scope);
            let mut instances = self.design.module(module).instances.iter();
            let found = instances.position(|instance| instance.name == instance_name);
            let index = found.unwrap_or_else(|| no_state(path));
            let mut scopes = self.states[module.0 as usize].scopes.iter();
            let lane = scopes.find_map(|state| {
                let (_, name) = state.instances.iter().find(|(id, _)| id.0 as usize == index)?;
                Some(format!("{}.{name}", state.path(&indices(scope))))
            });
            verilog = format!("{verilog}.{}", lane.unwrap_or_else(|| scope.to_string()));
            module = self.design.module(module).instances[index].module;
        }
        (module, verilog, name)
    }
}

/// The depth of nested arrays.
fn array_depth(design: &Design) -> usize {
    let mut depths = Vec::with_capacity(design.modules().len());
    for module in design.modules() {
        depths.push(deepest(module, &depths));
    }
    depths.last().copied().unwrap_or(0)
}

fn deepest(module: &Module, depths: &[usize]) -> usize {
    let below = |i: &tilewright_hdl::ir::Instance| depths[i.module.0 as usize] + i.shape.axes() as usize;
    let own = module.registers.iter().map(|register| module.shape(register.node));
    let own = own.chain(module.memories.iter().map(|memory| memory.shape)).map(|shape| shape.axes() as usize);
    module.instances.iter().map(below).chain(own).max().unwrap_or(0)
}

/// The indices of `cell[1][2]`.
fn indices(name: &str) -> Vec<&str> {
    let Some((_, lane)) = name.split_once('[') else { return Vec::new() };
    lane.trim_end_matches(']').split("][").collect()
}

/// A register whose lanes start at different values.
fn start_each(
    lane: &str,
    name: &str,
    start: &[Bits],
    scope: &ScopeState,
    indices: &[&str],
    names: &mut Names,
) -> Vec<String> {
    let number = match (indices, scope.shape) {
        ([row, column], Shape::Grid(_, columns)) => format!("{row} * {columns} + {column}"),
        _ => indices[0].to_string(),
    };
    let mut out = vec![format!("case ({number})")];
    for (at, value) in start.iter().enumerate() {
        let number = if at + 1 < start.len() { at.to_string() } else { "default".to_string() };
        let block = names.fresh(&format!("start_{}_{at}", label(&format!("{lane}.{name}"))));
        out.push(format!("    {number}: begin : {block} initial {lane}.{name} = {}; end", pattern(value)));
    }
    out.push("endcase".to_string());
    out
}

/// A path as a label: `dut.u_row.u_cell[lane0].lane` is `u_row_u_cell`.
fn label(path: &str) -> String {
    let named = path.split('.').skip(1).filter(|part| *part != "lane");
    let words: Vec<&str> = named.map(|part| part.split('[').next().unwrap_or(part)).collect();
    words.join("_")
}

fn start(path: &str, state: &State, names: &mut Names) -> Vec<String> {
    match state {
        State::Register { name, start } => vec![format!("initial {path}.{name} = {};", pattern(&start[0]))],
        State::GatedRead { word, inside, width, .. } => {
            let zero = pattern(&Bits::zero(*width));
            vec![format!("initial {path}.{word} = {zero};"), format!("initial {path}.{inside} = 1'b0;")]
        }
        State::Memory { is_unknown: false, .. } => vec![],
        State::Memory { name, depth, width, .. } => {
            let zero = pattern(&Bits::zero(*width));
            let block = names.fresh(&format!("fill_{}", label(&format!("{path}.{name}"))));
            let [address] = names.local_in(None, "word", ["address"]);
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
