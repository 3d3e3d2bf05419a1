//! A whole circuit.

use super::{Module, ModuleId, validate};
use crate::mistake::Mistake;
use crate::problem::{Problem, Problems};

/// A whole circuit. It satisfies every rule of this module, so its readers need no checks.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = tilewright_sim::shown! { |m, i| in { enable: bit() } out { count: bits(8) }
/// def!(count = m.reg(8).reset(0));
/// count.when(i.enable, count + 1);
/// #     ShownOut { count: *count }
/// # };
/// // The bits of state.
/// let bits = |module: &ir::Module| module.registers.iter().map(|register| module.width(register.node)).sum::<u32>();
/// assert_eq!(design.modules().iter().map(bits).sum::<u32>(), 8);
/// ```
#[derive(Debug, Clone)]
pub struct Design {
    modules: Vec<Module>,
}

impl Design {
    /// The design of these modules, each after the modules that it instantiates. The top module is the last.
    ///
    /// # Errors
    ///
    /// Every violated rule, each with the place in the description.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |_, i| in { word: bits(8) } out { sum: bits(8) }
    /// let sum = i.word + 1;
    /// #     ShownOut { sum }
    /// # };
    /// // One operand of the sum becomes a two.
    /// let mut modules = design.into_modules();
    /// for node in &mut modules[0].nodes {
    ///     if let ir::Op::Const(value) = &mut node.op {
    ///         *value = Bits::new(8, 2);
    ///     }
    /// }
    /// assert!(Design::new(modules.clone()).is_ok());
    /// // An output of a node that does not exist.
    /// modules[0].outputs[0].node = ir::NodeId(99);
    /// assert!(Design::new(modules).is_err());
    /// ```
    #[track_caller]
    pub fn new(modules: Vec<Module>) -> Result<Design, Problems> {
        let problems = validate::validate(&modules);
        if problems.is_empty() { Ok(Design { modules }) } else { Err(Problems(problems)) }
    }

    /// Whether each foreign module has a model, as a simulation needs it.
    ///
    /// # Errors
    ///
    /// Every foreign module without one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// def!(late = m.pipe(i.word));
    /// #     ShownOut { late }
    /// # };
    /// assert!(design.check_models().is_ok()); // there are no foreign modules
    /// ```
    pub fn check_models(&self) -> Result<(), Problems> {
        let missing = self.modules.iter().filter(|module| module.unmodelled);
        let problem = |module: &Module| {
            let name = module.foreign.as_ref().map_or(&module.name, |foreign| &foreign.module);
            let message = format!("foreign module `{name}` has no model, so the design cannot be simulated");
            let help = "describe a model in the block's `build`, in place of `m.unmodelled(..)`";
            Problem::new(Mistake::NoModel, module.loc, message).help(help)
        };
        let problems: Vec<Problem> = missing.map(problem).collect();
        if problems.is_empty() { Ok(()) } else { Err(Problems(problems)) }
    }

    /// The modules, each after the modules that it instantiates. The top module is the last.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Halver;
    /// #     in HalverIn { word: bits(8) }
    /// #     out HalverOut { half: bits(8) }
    /// # }
    /// # impl Halver {
    /// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
    /// #         HalverOut { half: i.word >> 1 }
    /// #     }
    /// # }
    /// # block! {
    /// #     struct Chain;
    /// #     in ChainIn { word: bits(8) }
    /// #     out ChainOut { quarter: bits(8) }
    /// # }
    /// # impl Chain {
    /// #     fn build(&self, m: Module, i: ChainIn) -> ChainOut {
    /// let half = m.instance("u_half", &Halver, HalverIn { word: i.word }).half;
    /// let quarter = m.instance("u_quarter", &Halver, HalverIn { word: half }).half;
    /// #         ChainOut { quarter }
    /// #     }
    /// # }
    /// # let design = elaborate(&Chain)?;
    /// // Two instances of one module.
    /// assert_eq!(design.modules().iter().map(|module| &*module.name).collect::<Vec<_>>(), ["halver", "chain"]);
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn modules(&self) -> &[Module] {
        &self.modules
    }

    /// The modules, for editing; [`Design::new`] makes a design of them again.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// def!(late = m.pipe(i.word));
    /// #     ShownOut { late }
    /// # };
    /// let mut modules = design.into_modules();
    /// modules[0].name = "delay".to_owned();
    /// assert_eq!(Design::new(modules).unwrap().top().name, "delay");
    /// ```
    pub fn into_modules(self) -> Vec<Module> {
        self.modules
    }

    /// The module that no other one instantiates.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let design = tilewright_sim::shown! { |m, i| in { word: bits(8) } out { late: bits(8) }
    /// def!(late = m.pipe(i.word));
    /// #     ShownOut { late }
    /// # };
    /// assert_eq!(design.top().inputs[0].name, "word"); // the inputs that a simulation sets
    /// ```
    pub fn top(&self) -> &Module {
        self.modules.last().expect("a design has a top module")
    }

    /// The module with this id.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     struct Halver;
    /// #     in HalverIn { word: bits(8) }
    /// #     out HalverOut { half: bits(8) }
    /// # }
    /// # impl Halver {
    /// #     fn build(&self, _: Module, i: HalverIn) -> HalverOut {
    /// #         HalverOut { half: i.word >> 1 }
    /// #     }
    /// # }
    /// # block! {
    /// #     struct Outer;
    /// #     in OuterIn { word: bits(8) }
    /// #     out OuterOut { half: bits(8) }
    /// # }
    /// # impl Outer {
    /// #     fn build(&self, m: Module, i: OuterIn) -> OuterOut {
    /// let HalverOut { half } = m.instance("u_half", &Halver, HalverIn { word: i.word });
    /// #         OuterOut { half }
    /// #     }
    /// # }
    /// # let design = elaborate(&Outer)?;
    /// let instance = &design.top().instances[0];
    /// assert_eq!(design.module(instance.module).name, "halver");
    /// # Ok::<(), Problems>(())
    /// ```
    pub fn module(&self, id: ModuleId) -> &Module {
        &self.modules[id.0 as usize]
    }
}
