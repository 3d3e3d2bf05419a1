//! The tests of a crate as programs that simulate mutants.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::slice;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tilewright_mutants::{Mutant, VARIABLE};

/// How long a program of tests may take; without a mutant the longest takes a few seconds.
const PATIENCE: Duration = Duration::from_secs(30);

/// A crate of blocks, and those of its tests that simulate what the blocks are meant to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Crate {
    package: &'static str,
    targets: &'static [&'static str],
    /// What the paths of its tests contain, where a block names no tests of its own; nothing if all are meant.
    tests: &'static [&'static str],
}

impl Crate {
    /// Its folder in the workspace.
    pub fn name(self) -> &'static str {
        self.package.trim_start_matches("tilewright-")
    }
}

/// The machines' blocks.
pub const RTL: Crate = Crate { package: "tilewright-rtl", targets: &["--lib"], tests: &[] };
/// The library.
pub const BLOCKS: Crate =
    Crate { package: "tilewright-blocks", targets: &["--test=all"], tests: &["small::", "streams::", "pins::"] };

/// What the tests say of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// This test fails.
    Found(String),
    /// The tests do not come to an end.
    Endless,
    /// The program breaks.
    Broken,
    /// Every test passes.
    Survives,
}

/// The programs.
pub struct Suite {
    programs: Vec<PathBuf>,
    of: Crate,
    /// Of the inputs that tests draw.
    seed: u64,
}

impl Suite {
    /// Builds the tests.
    ///
    /// # Errors
    ///
    /// What Cargo says, if it fails.
    pub fn build(of: Crate, seed: u64) -> Result<Suite, String> {
        let mut cargo = Command::new("cargo");
        cargo.args(["test", "--no-run", "--color=never", "--features=tilewright-sim/mutation", "-p", of.package]);
        let output = cargo.args(of.targets).output().map_err(|error| format!("`cargo`: {error}"))?;
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let program = |line: &str| line.trim().strip_prefix("Executable")?.split(['(', ')']).nth(1).map(PathBuf::from);
        let programs: Vec<PathBuf> = text.lines().filter_map(program).collect();
        let built = output.status.success() && programs.len() == of.targets.len();
        if built { Ok(Suite { programs, of, seed }) } else { Err(text) }
    }

    /// Runs the tests whose path contains `tests`, or those of the crate if that is empty, with a mutant or without one.
    ///
    /// # Panics
    ///
    /// A program cannot be started.
    pub fn run(&self, tests: &str, mutant: Option<&Mutant>) -> Verdict {
        let run = |program: &PathBuf| {
            let mut command = Command::new(program);
            command.args(if tests.is_empty() { self.of.tests } else { slice::from_ref(&tests) });
            command.arg("--test-threads=1").env("PROPTEST_RNG_SEED", self.seed.to_string());
            command.env("PROPTEST_MAX_SHRINK_ITERS", "0").stdout(Stdio::piped()).stderr(Stdio::null());
            match mutant {
                Some(mutant) => command.env(VARIABLE, mutant.to_string()),
                None => command.env_remove(VARIABLE),
            };
            watch(command.spawn().expect("the tests can be started"))
        };
        let mut verdicts = self.programs.iter().map(run);
        verdicts.find(|verdict| *verdict != Verdict::Survives).unwrap_or(Verdict::Survives)
    }
}

/// Reads what tests print until one fails, all are through, or the time is over.
fn watch(mut child: Child) -> Verdict {
    let output = BufReader::new(child.stdout.take().expect("what it prints is caught"));
    let over = AtomicBool::new(false);
    let (failed, late) = std::thread::scope(|scope| {
        let clock = scope.spawn(|| {
            let start = Instant::now();
            while !over.load(Ordering::Relaxed) {
                if start.elapsed() > PATIENCE {
                    // It may have ended just now.
                    let _ = child.kill();
                    return true;
                }
                std::thread::sleep(Duration::from_millis(5));
            }
            false
        });
        let failed = output.lines().map_while(Result::ok).find_map(|line| failed(&line).map(str::to_owned));
        over.store(true, Ordering::Relaxed);
        (failed, clock.join().expect("the clock does not panic"))
    });
    if failed.is_some() {
        let _ = child.kill();
    }
    let status = child.wait().expect("a child can be waited for");
    match failed {
        Some(test) => Verdict::Found(test),
        None if late => Verdict::Endless,
        None if status.success() => Verdict::Survives,
        None => Verdict::Broken,
    }
}

/// The test that a line says has failed.
fn failed(line: &str) -> Option<&str> {
    let test = line.strip_prefix("test ")?.strip_suffix("... FAILED")?;
    Some(test.trim_end().trim_end_matches(" - should panic"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Verdict {
        watch(Command::new("sh").args(["-c", script]).stdout(Stdio::piped()).spawn().unwrap())
    }

    #[test]
    fn the_first_test_that_fails_is_named_and_the_rest_is_not_waited_for() {
        let printed = "echo 'test a::b ... ok'; echo 'test a::c - should panic ... FAILED'; exec sleep 1000";
        assert_eq!(shell(printed), Verdict::Found("a::c".to_owned()));
        assert_eq!(shell("echo 'test a::b ... ok'"), Verdict::Survives);
        assert_eq!(shell("echo 'test a::b ... '; exit 3"), Verdict::Broken);
    }
}
