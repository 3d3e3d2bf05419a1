//! The start of all state, set through hierarchical paths: Verilog has unknown values, but the recorded simulation
//! has none.

use crate::verilog::{ModuleState, Names, ScopeState, State, pattern, states};
use std::collections::BTreeMap;
use tilewright_circuit::Bits;
use tilewright_circuit::Recording;
use tilewright_circuit::ir::{Design, Module, ModuleId, Shape};
use tilewright_circuit::recording::Initial;

/// The start of all state in a design, by paths from the testbench.
pub struct Start<'a> {
    design: &'a Design,
    /// By module.
    states: Vec<ModuleState>,
    /// The instance of the top.
    dut: &'a str,
    /// The loop variables of nested arrays, from the outside to the inside.
    pub genvars: Vec<String>,
    /// The assignments of the words that a recording gives memories which are filled.
    words: Words,
    /// The assignments of all other initial values of the recording.
    pub special: Vec<String>,
}

/// Assignments by the path and name of a memory, and by the lanes on the path.
type Words = BTreeMap<String, BTreeMap<Vec<u32>, Vec<String>>>;

impl<'a> Start<'a> {
    /// Takes the names of loop variables from `names`.
    pub fn new(design: &'a Design, dut: &'a str, recording: &Recording, names: &mut Names) -> Start<'a> {
        let states = states(design);
        let genvars = (0..array_depth(design)).map(|depth| names.fresh(&format!("lane{depth}"))).collect();
        let mut start = Start { design, states, dut, genvars, words: BTreeMap::new(), special: Vec::new() };
        let (mut words, mut special) = (Words::new(), Vec::new());
        for found in recording.initial.iter().filter_map(|initial| start.found(initial)) {
            match found.state {
                State::Memory { name, is_unknown: true, .. } => {
                    let (path, lanes) = start.in_loops(&found.path);
                    let lines = found.assigned(&path);
                    words.entry(format!("{path}.{name}")).or_default().entry(lanes).or_default().extend(lines);
                }
                _ => special.extend(found.assigned(&found.path)),
            }
        }
        (start.words, start.special) = (words, special);
        start
    }

    /// A path with the loop variables in place of lanes, and the lanes.
    fn in_loops(&self, path: &str) -> (String, Vec<u32>) {
        let mut pieces = path.split('[');
        let mut text = pieces.next().unwrap_or_default().to_owned();
        let mut lanes = Vec::new();
        for (piece, genvar) in pieces.zip(&self.genvars) {
            let (lane, rest) = piece.split_once(']').expect("a bracket closes");
            lanes.push(lane.parse().unwrap_or_else(|_| no_state(path)));
            text += &format!("[{genvar}]{rest}");
        }
        (text, lanes)
    }

    /// The statements and generate loops that set all state to its usual start, and memories of unknown contents to
    /// what the recording gives them. Takes labels from `names`.
    pub fn usual(&self, names: &mut Names) -> Vec<String> {
        self.scope(ModuleId(self.design.modules().len() as u32 - 1), self.dut, 0, names)
    }

    fn scope(&self, id: ModuleId, path: &str, depth: usize, names: &mut Names) -> Vec<String> {
        let state = &self.states[id.0 as usize];
        let mut out: Vec<String> = state.own.iter().flat_map(|state| self.start(path, state, names)).collect();
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
                State::Register { name, start, .. } if start.len() > 1 => {
                    inner.extend(start_each(&lane, name, start, scope, &indices, names))
                }
                state => inner.extend(self.start(&lane, state, names)),
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

    fn start(&self, path: &str, state: &State, names: &mut Names) -> Vec<String> {
        match state {
            State::Register { name, start, .. } => vec![format!("initial {path}.{name} = {};", pattern(&start[0]))],
            State::GatedRead { word, inside, width, .. } => {
                let zero = pattern(&Bits::zero(*width));
                vec![format!("initial {path}.{word} = {zero};"), format!("initial {path}.{inside} = 1'b0;")]
            }
            State::Memory { is_unknown: false, .. } => vec![],
            State::Memory { name, depth, width, .. } => self.memory(path, name, [*depth, *width], names),
        }
    }

    /// Fills a memory in each lane on its path. Verilator 5.006 does not see that a word changes later if it is read
    /// at once, so the words of the recording are a part of the same block.
    fn memory(&self, path: &str, name: &str, size: [u32; 2], names: &mut Names) -> Vec<String> {
        let named = format!("{path}.{name}");
        let Some(given) = self.words.get(&named) else { return fill(path, name, size, &[], names) };
        if let Some(words) = given.get(&[][..]) {
            return fill(path, name, size, words, names);
        }
        let lane = |(genvar, lane): (&String, &u32)| format!("{genvar} == {lane}");
        let condition = |lanes: &Vec<u32>| self.genvars.iter().zip(lanes).map(lane).collect::<Vec<_>>().join(" && ");
        let branches = given.iter().map(|(lanes, words)| (format!("if ({}) ", condition(lanes)), &words[..]));
        let (mut out, mut before) = (Vec::new(), "");
        for (head, words) in branches.chain([(String::new(), &[][..])]) {
            out.push(format!("{before}{head}begin : {}", names.fresh(&format!("words_{}", label(&named)))));
            out.extend(fill(path, name, size, words, names).into_iter().map(|line| format!("    {line}")));
            before = "end else ";
        }
        out.push("end".to_string());
        out
    }

    /// The element of state of an initial value; `None` if nothing reads it, so that it is not printed.
    fn found<'r>(&self, initial: &'r Initial) -> Option<Found<'_, 'r>> {
        let (module, path, name) = self.find(&initial.path);
        let (base, lane) = name.split_at(name.find('[').unwrap_or(name.len()));
        let state = &self.states[module.0 as usize];
        let scopes = state.scopes.iter().filter(|_| !lane.is_empty());
        let mut in_lanes = scopes.flat_map(|scope| scope.own.iter().map(move |state| (scope, state)));
        if let Some((scope, state)) = in_lanes.find(|(_, state)| state.is(base)) {
            let path = format!("{path}.{}", scope.path(&indices(name)));
            return Some(Found { state, path, low: None, initial });
        }
        if let Some(state) = state.own.iter().find(|state| state.is(base)) {
            return Some(Found { state, path, low: self.low(module, base, lane, initial), initial });
        }
        match self.shape(module, base) {
            Some(_) => None,
            None => no_state(&initial.path),
        }
    }

    /// The lowest bit of a lane, if several lanes stand side by side in one word. A word of one bit has no parts.
    fn low(&self, module: ModuleId, base: &str, lane: &str, initial: &Initial) -> Option<u32> {
        let shape = self.shape(module, base).filter(|shape| !lane.is_empty() && shape.lanes() > 1)?;
        let mut number = 0;
        for (axis, index) in (0..).zip(indices(lane)) {
            number = number * shape.extent(axis) + index.parse::<u32>().unwrap_or_else(|_| no_state(&initial.path));
        }
        Some(number * initial.words[0].width())
    }

    /// The shape of a register, of read data, or of a memory of the design.
    fn shape(&self, module: ModuleId, name: &str) -> Option<Shape> {
        let module = self.design.module(module);
        let is_read = |memory: &str| name.strip_prefix(memory).is_some_and(|rest| rest.starts_with("_read"));
        let memories = || module.memories.iter();
        let memory = memories().find(|memory| memory.name == name).or_else(|| memories().find(|it| is_read(&it.name)));
        let reads = memories().flat_map(|memory| memory.reads.iter().map(|read| read.node));
        let nodes = module.registers.iter().map(|register| register.node).chain(reads);
        let node = { nodes }.find(|&node| module.node(node).name.as_deref() == Some(name));
        node.map(|node| module.shape(node)).or_else(|| memory.map(|memory| memory.shape))
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
    let below = |i: &tilewright_circuit::ir::Instance| depths[i.module.0 as usize] + i.shape.axes() as usize;
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

/// A block that fills a memory with zeros, and then gives it these words.
fn fill(path: &str, name: &str, [depth, width]: [u32; 2], words: &[String], names: &mut Names) -> Vec<String> {
    let block = names.fresh(&format!("fill_{}", label(&format!("{path}.{name}"))));
    let [address] = names.local_in(None, "word", ["address"]);
    let mut out = vec![
        format!("initial begin : {block}"),
        format!("    integer {address};"),
        format!("    for ({address} = 0; {address} < {depth}; {address} = {address} + 1)"),
        format!("        {path}.{name}[{address}] = {};", pattern(&Bits::zero(width))),
    ];
    out.extend(words.iter().map(|line| format!("    {line}")));
    out.push("end".to_string());
    out
}

/// An element of state with an initial value.
struct Found<'s, 'r> {
    state: &'s State,
    /// The path of its scope.
    path: String,
    /// The lowest bit of the part of it that has the value; `None` for all of it.
    low: Option<u32>,
    initial: &'r Initial,
}

impl Found<'_, '_> {
    /// The nets with the words.
    fn nets(&self) -> Vec<Net> {
        let Found { path, low, initial, .. } = self;
        let path = path.trim_start_matches('.');
        let dot = if path.is_empty() { "" } else { "." };
        let net = |name: String| Net { name: format!("{path}{dot}{name}"), low: low.unwrap_or(0) };
        match self.state {
            State::Register { name, .. } | State::GatedRead { name, .. } => vec![net(name.clone())],
            State::Memory { name, .. } => {
                (initial.address..).zip(&initial.words).map(|(address, _)| net(format!("{name}[{address}]"))).collect()
            }
        }
    }

    /// The assignments, where its scope has this path.
    fn assigned(&self, path: &str) -> Vec<String> {
        let Found { initial, .. } = self;
        let part = self.low.map(|low| format!("[{low} +: {}]", initial.words[0].width())).unwrap_or_default();
        let value = || {
            let count = initial.words.len();
            assert!(count == 1, "`{}` is one value, the recording gives {count}", initial.path);
            pattern(&initial.words[0])
        };
        match self.state {
            State::Register { name, .. } => vec![format!("{path}.{name}{part} = {};", value())],
            State::GatedRead { word, inside, .. } => {
                vec![format!("{path}.{word}{part} = {};", value()), format!("{path}.{inside} = 1'b1;")]
            }
            State::Memory { name, .. } => {
                let assign = |(address, word)| format!("{path}.{name}[{address}]{part} = {};", pattern(word));
                (initial.address..).zip(&initial.words).map(assign).collect()
            }
        }
    }
}

/// A net of the printed Verilog that has a value of a recording's start.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let start = recording::Initial { path: "held".to_owned(), address: 0, words: vec![Bits::new(8, 7)] };
/// let nets = tilewright_gen::nets(&design, &[start]);
/// assert_eq!(nets[0], [tilewright_gen::Net { name: "held".to_owned(), low: 0 }]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Net {
    /// Its path below the top module, such as `u_row.u_cell[3].lane.q`; a word of a memory has its address in brackets.
    pub name: String,
    /// The lowest bit of the value in the net.
    pub low: u32,
}

/// For each value of a recording's start, the nets with its words. There are none if nothing reads it, so that it is
/// not printed.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// assert!(tilewright_gen::nets(&design, &[]).is_empty());
/// ```
///
/// # Panics
///
/// A value belongs to nothing in the design.
pub fn nets(design: &Design, initial: &[Initial]) -> Vec<Vec<Net>> {
    let start = Start::new(design, "", &Recording::default(), &mut Names::default());
    let nets = |initial: &Initial| match start.found(initial) {
        None => Vec::new(),
        Some(found) => found.nets(),
    };
    initial.iter().map(nets).collect()
}

fn no_state(path: &str) -> ! {
    panic!("the recording gives `{path}` an initial value, but the design has no such register or memory")
}
