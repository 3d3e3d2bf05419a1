//! A random design: one that is described in the language, a circuit with shapes, or a network of streams.

use crate::features::Feature;
use crate::spec::{Spec, Stimulus};
use crate::{build, shaped, strategy, streams};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use tilewright_hdl::{DEFAULT_PERIOD, DefaultClock, Design, Edge, Problems, Reset, elaborate_at};

/// A random design, as plain data that shrinks.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Drawn {
    /// Described in the language.
    Described(Spec),
    /// A circuit whose values have shapes.
    Shaped(shaped::Spec),
    /// A network of streams.
    Streams(streams::Spec),
}

/// Which designs are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Each fifth is a circuit with shapes, and each tenth a network of streams.
    Mixed,
    /// All are circuits with shapes.
    Shaped,
    /// All are networks of streams.
    Streams,
    /// All are circuits with shapes that no other simulator is asked about.
    Odd,
}

impl Kind {
    /// Whether the design of that number is a circuit with shapes.
    fn is_shaped(self, number: u64) -> bool {
        match self {
            Kind::Mixed => number % 5 == 4,
            Kind::Shaped | Kind::Odd => true,
            Kind::Streams => false,
        }
    }

    /// Whether the design of that number is a network of streams.
    fn is_of_streams(self, number: u64) -> bool {
        self == Kind::Streams || self == Kind::Mixed && number % 10 == 7
    }

    /// The random design of that number, with the way to smaller ones.
    pub fn draw(self, seed: u64, number: u64) -> Box<dyn ValueTree<Value = Drawn>> {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..16].copy_from_slice(&number.to_le_bytes());
        let config = Config { failure_persistence: None, ..Config::default() };
        let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes));
        let designs = match self.is_shaped(number) {
            true if self == Kind::Odd => shaped::strategy::odd_designs().prop_map(Drawn::Shaped).boxed(),
            true => shaped::strategy::designs().prop_map(Drawn::Shaped).boxed(),
            false if self.is_of_streams(number) => streams::designs().prop_map(Drawn::Streams).boxed(),
            false => strategy::designs().prop_map(Drawn::Described).boxed(),
        };
        designs.new_tree(&mut runner).expect("the strategy rejects nothing")
    }
}

/// The design with the kind of reset and the edge in the names of the library's modules. Those of a top's own clock are
/// in no name, and several designs go to one run of another simulator.
fn with_own_library(design: Design, name: &str, clock: DefaultClock) -> Result<Design, Problems> {
    let DefaultClock { reset, edge, .. } = clock;
    if (reset, edge) == (Reset::Synchronous, Edge::Rising) {
        return Ok(design);
    }
    let mut modules = design.into_modules();
    for module in modules.iter_mut().filter(|module| !module.name.starts_with(&format!("{name}_"))) {
        module.name += &format!("_under_{reset:?}_{edge:?}").to_lowercase();
    }
    Design::new(modules)
}

impl Drawn {
    /// The design, as the one of that number.
    ///
    /// # Errors
    ///
    /// The rules that it breaks, which is a mistake of this crate or of the language.
    pub fn design(&self, number: u64) -> Result<Design, Problems> {
        let name = format!("d{number}");
        let ([own, _], [edge, _]) = (self.stimulus().resets(), self.stimulus().edges());
        Feature::from(own).used();
        if edge == Edge::Falling {
            Feature::Falling.used();
        }
        match self {
            Drawn::Described(spec) => {
                let clock = DefaultClock { edge, ..DefaultClock::new(DEFAULT_PERIOD).reset(own) };
                with_own_library(elaborate_at(&build::top(spec, &name), clock)?, &name, clock)
            }
            Drawn::Shaped(spec) => shaped::design(spec, &name),
            Drawn::Streams(spec) => streams::design(spec, &name),
        }
    }

    /// What is done to it.
    pub fn stimulus(&self) -> &Stimulus {
        match self {
            Drawn::Described(spec) => &spec.stimulus,
            Drawn::Shaped(spec) => &spec.stimulus,
            Drawn::Streams(spec) => &spec.stimulus,
        }
    }

    /// How many steps it is made of.
    pub fn steps(&self) -> usize {
        match self {
            Drawn::Described(spec) => spec.parts.iter().map(|part| part.steps.len()).sum(),
            Drawn::Shaped(spec) => spec.parts.iter().map(|part| part.steps.len()).sum(),
            Drawn::Streams(spec) => spec.steps.len(),
        }
    }

    /// Whether it is printed, for other simulators and linters.
    pub fn is_printed(&self) -> bool {
        match self {
            Drawn::Described(_) | Drawn::Streams(_) => true,
            Drawn::Shaped(spec) => spec.odd == shaped::spec::Odd::default(),
        }
    }
}
