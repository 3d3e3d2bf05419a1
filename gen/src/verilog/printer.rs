//! A folded module during printing: what is known of it beforehand, and what its text has read so far.

use super::border::Border;
use super::fold::Folded;
use super::groups::Groups;
use super::lane_names::{GroupNames, port_values};
use super::names::name_nodes;
use super::part::Index;
use super::plan::Plan;
use super::reads::{ReadNames, name_reads};
use super::scope::Names;
use super::stated::stated;
use super::states::StateNames;
use super::usage::Usage;
use tilewright_circuit::ir::{Clock, ClockId, Design, Directive, Module, NodeId, Property};

/// A folded module during printing.
pub struct Printer<'a> {
    pub design: &'a Design,
    pub module: &'a Module,
    /// For each earlier module of the design, whether an `always @*` is in it or below.
    pub waits: &'a [bool],
    pub plan: Plan,
    pub taken: Names,
    /// The names of the nodes that have one.
    pub names: Vec<Option<String>>,
    /// The names of synchronous read ports, by memory and port.
    pub reads: Vec<Vec<Option<ReadNames>>>,
    pub states: StateNames,
    pub groups: Groups,
    /// The names of the groups.
    pub lanes: GroupNames,
    /// For each register its reset value, if that differs between its lanes.
    pub resets: &'a [Option<NodeId>],
    /// For each memory and read port whether the address can be beyond the last word.
    pub beyond: &'a [Vec<bool>],
    /// For each register, whether only properties use it.
    pub stated: Vec<bool>,
    /// The task that a failing assertion or assumption calls.
    pub stop: Option<String>,
    /// The group whose scope is being printed.
    pub here: Option<usize>,
    /// The lane at which the current text is printed, by axis.
    pub at: Vec<Index>,
    pub usage: Usage,
    pub border: Border,
}

impl<'a> Printer<'a> {
    /// `printed` has the names of the earlier modules of the design, and `waits` whether an `always @*` is in them.
    pub fn new(design: &'a Design, folded: &'a Folded, printed: &[Names], waits: &'a [bool]) -> Printer<'a> {
        let Folded { module, resets, beyond } = folded;
        let plan = Plan::new(folded);
        let groups = Groups::new(module, &plan, resets);
        let ports = port_values(design, module, &plan);
        let mut taken = Names::of(design, module, printed);
        let can_fail = |property: &Property| matches!(property.directive, Directive::Assert | Directive::Assume);
        let is_checked = module.properties.iter().any(can_fail);
        let stop = is_checked.then(|| taken.fresh("stop"));
        let reads = name_reads(module, beyond, &mut taken);
        let mut names = name_nodes(design, module, &plan, &reads, resets, &ports, &mut taken);
        let states = StateNames::new(module, &mut taken);
        let lanes = GroupNames::new(design, module, &groups, &ports, printed, &mut names, &mut taken);
        let usage = Usage::new(module.nodes.len());
        let stated = stated(module, &plan, resets);
        let (here, at) = (None, Vec::new());
        Printer {
            design,
            module,
            waits,
            plan,
            taken,
            names,
            reads,
            states,
            groups,
            lanes,
            resets,
            beyond,
            stated,
            stop,
            here,
            at,
            usage,
            border: Border::of(design, module),
        }
    }

    /// The name of a node that has one.
    pub fn name(&self, id: NodeId) -> &str {
        self.names[id.0 as usize].as_deref().expect("a declared node has a name")
    }

    /// Whether a node's name is the name of the output port that it drives.
    pub fn is_port(&self, id: NodeId) -> bool {
        let name = self.names[id.0 as usize].as_ref();
        self.module.outputs.iter().any(|output| output.node == id && Some(&output.name) == name)
    }

    /// The name of a clock's port, which counts as read from now on.
    pub fn clock_port(&mut self, clock: ClockId) -> String {
        let port = self.module.clocks[clock.0 as usize].port.clone();
        self.usage.clocks.insert(port.clone());
        port
    }

    /// The name of a clock's reset port, which counts as read from now on.
    pub fn reset_port(&mut self, clock: ClockId) -> String {
        let reset = self.module.clocks[clock.0 as usize].reset.clone();
        let reset = reset.expect("a clock with a reset register has a reset port");
        self.usage.clocks.insert(reset.clone());
        reset
    }

    /// The condition that a clock's reset is active.
    pub fn in_reset(&mut self, clock: ClockId) -> String {
        let not = if self.module.clocks[clock.0 as usize].kind.is_active_low() { "!" } else { "" };
        format!("{not}{}", self.reset_port(clock))
    }

    /// The condition that a clock's reset is not active; `None` if it has none.
    pub fn out_of_reset(&mut self, clock: ClockId) -> Option<String> {
        let Clock { reset, kind, .. } = &self.module.clocks[clock.0 as usize];
        let not = if kind.is_active_low() { "" } else { "!" };
        reset.is_some().then(|| format!("{not}{}", self.reset_port(clock)))
    }
}
