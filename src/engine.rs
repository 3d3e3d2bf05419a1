//! The engine that a command is given, and the warning where it cannot run.

use crate::names;
use crate::shell::terminal;
use clap::{Args, ValueEnum};
use tilewright_hdl::Bundle;
use tilewright_sim::{EngineKind, Simulation};

/// What runs the hardware.
#[derive(Args, Clone, Copy, Default)]
pub struct EngineArguments {
    /// What runs the hardware; all engines give the same results
    #[arg(long, value_enum, value_name = "ENGINE", value_parser = names::of::<Engine>("engine"), default_value_t = Engine::Compiled)]
    engine: Engine,
}

/// An engine by its name on the command line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Engine {
    /// The plainest engine: very slow; the others are compared with it
    Reference,
    /// An interpreter: slow
    Interpreter,
    /// Machine code compiled from the circuit, for runs that are long enough; the interpreter where none can be generated
    #[default]
    Compiled,
    /// Machine code and the reference engine, compared signal by signal; thousands of times slower. Exit code 1 at the first signal that differs
    Both,
}

impl EngineArguments {
    /// The engine that was asked for.
    pub fn kind(self) -> EngineKind {
        match self.engine {
            Engine::Reference => EngineKind::Reference,
            Engine::Interpreter => EngineKind::Interpreter,
            Engine::Compiled => EngineKind::Tiered,
            Engine::Both => EngineKind::Both,
        }
    }
}

/// Tells the user if the simulation runs on another engine than the one that was asked for.
pub fn tell_fallback<I: Bundle, O: Bundle>(sim: &Simulation<I, O>) {
    if let Some(reason) = sim.fallback() {
        tell_refused(reason);
    }
}

/// Tells the user why no generated code runs.
pub fn tell_refused(reason: &str) {
    terminal::warn(&warning(reason));
}

fn warning(reason: &str) -> String {
    format!("the interpreter runs instead of machine code, slowly but with the same results: {reason}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_rtl::catalog;

    #[test]
    fn a_computer_without_generated_code_is_told_of_once_and_runs() {
        let entry = catalog::find("merging-unit").unwrap();
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        let sim = || Simulation::from_design(&design).unwrap();
        for asked in [EngineKind::Compiled, EngineKind::Both] {
            assert_eq!(sim().on(asked).fallback(), None);
            let mut without = sim().without_code("no code can be generated for this machine (a typewriter)").on(asked);
            let sentence = "the interpreter runs instead of machine code, slowly but with the same results: \
                            no code can be generated for this machine (a typewriter)";
            assert_eq!(without.fallback().map(warning).as_deref(), Some(sentence));
            without.step();
        }
        for asked in [EngineKind::Reference, EngineKind::Interpreter] {
            let chosen = sim().without_code("a typewriter").on(asked);
            assert_eq!(chosen.fallback(), None, "who asks for an engine without code has it");
        }
    }
}
