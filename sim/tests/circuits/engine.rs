//! The engine for the tests of [`every_engine`](crate::circuits::every_engine): machine code after an edge on the
//! interpreter, or the one that the environment names.

use std::env;
use std::process::Command;

use tilewright_hdl::Block;
use tilewright_sim::{EngineKind, Simulation};

/// The environment variable.
const ENGINE: &str = "TILEWRIGHT_TEST_ENGINE";

pub fn engine() -> EngineKind {
    match env::var(ENGINE).as_deref() {
        Err(env::VarError::NotPresent) => EngineKind::Tiered,
        Ok("reference") => EngineKind::Reference,
        Ok("interpreter") => EngineKind::Interpreter,
        Ok("both") => EngineKind::Both,
        other => {
            panic!("{ENGINE} is {other:?}: it names the engine `reference`, `interpreter` or `both`, or is not set")
        }
    }
}

/// A block on that engine.
#[track_caller]
pub fn of<B: Block>(block: &B) -> Simulation<B::In, B::Out> {
    let sim = Simulation::of(block).unwrap();
    match engine() {
        EngineKind::Tiered => sim.code_after(1),
        other => sim.on(other),
    }
}

/// Runs the tests of `every_engine` in a process of their own, on that engine.
fn again_on(engine: &str) {
    let mut tests = Command::new(env::current_exe().unwrap());
    let output = tests.env(ENGINE, engine).arg("every_engine::").output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}{}", String::from_utf8_lossy(&output.stderr));
    assert!(!text.contains("ok. 0 passed"), "there are no such tests:\n{text}");
}

#[test]
fn every_test_passes_on_the_reference_engine() {
    again_on("reference");
}

#[test]
fn every_test_passes_on_the_interpreter() {
    again_on("interpreter");
}

#[test]
fn every_test_passes_on_both_engines_side_by_side() {
    again_on("both");
}
