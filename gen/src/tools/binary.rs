//! Programs that Verilator builds, to be run once: without optimisation, and with a runtime that is compiled once.
//!
//! Verilator's runtime takes longer to compile than a small design, and so do its headers. Its objects and a precompiled header are kept
//! in the user's cache folder, by the versions of Verilator and of the compiler. A build that fails with them is repeated without them.

use super::Problems;
use super::run::{Verilator, line_of, problem, run_in, skipped_without};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The compiler that Verilator's own makefile calls.
const COMPILER: &str = "g++";
/// The C++ runs briefly and takes long to compile.
const MAKE_FLAGS: &str = "VM_PARALLEL_BUILDS=0 OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0";
/// The program in the folder of a build.
const PROGRAM: &str = "build/program";

/// What each program's C++ includes; the compiler takes `HEADER.gch` in its place where it can.
const HEADER: &str = "runtime.h";
const INCLUDED: &str = "#include \"verilated.h\"\n#include \"verilated_timing.h\"\n";

/// Builds a program from the Verilog files of a folder, and returns its path; `None` if something is not installed.
///
/// ```no_run
/// # use tilewright_hdl::*;
/// # let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// use tilewright_gen::tools::verilated;
///
/// if let Some(program) = verilated("build".as_ref(), &["delay_tb.v", "delay.v"], "delay_tb", &[]).unwrap() {
///     assert!(std::process::Command::new(program).status().unwrap().success());
/// }
/// ```
///
/// # Errors
///
/// The output of Verilator or the compiler.
pub fn verilated(folder: &Path, sources: &[&str], top: &str, flags: &[&str]) -> Result<Option<PathBuf>, Problems> {
    verilated_by(installed()[0], folder, sources, top, flags)
}

/// The installed Verilators, or the one to look for if there is none.
pub fn installed() -> Vec<Verilator> {
    let mut found: Vec<Verilator> =
        [Verilator::System, Verilator::Python].into_iter().filter(|it| it.command().is_some()).collect();
    if found.is_empty() {
        found.push(Verilator::System);
    }
    found
}

/// Like [`verilated`], with this Verilator.
pub fn verilated_by(
    verilator: Verilator,
    folder: &Path,
    sources: &[&str],
    top: &str,
    flags: &[&str],
) -> Result<Option<PathBuf>, Problems> {
    if skipped_without(&[verilator.programs(), vec!["make", COMPILER]].concat()).is_some() {
        return Ok(None);
    }
    let cache = cache(verilator);
    let build = |runtime: Option<&Vec<PathBuf>>| {
        let mut command = verilator.command().expect("it is installed");
        let overridden = runtime.map(|_| " VM_GLOBAL_FAST= VM_GLOBAL_SLOW=").unwrap_or_default();
        command.args(["--binary", "-j", "2", "--Mdir", "build", "-o", "program", "--top-module", top]);
        let header = runtime.and(cache.as_ref()).map(|cache| cache.join(HEADER)).filter(|header| header.exists());
        let header = header.map(|header| format!(" -include {}", header.display()));
        command.args(flags).args(["-CFLAGS", &format!("-O0{}", header.unwrap_or_default())]);
        command.args(["-MAKEFLAGS", &format!("{MAKE_FLAGS}{overridden}")]);
        run_in(folder, command.args(sources).args(runtime.into_iter().flatten()))
    };
    let runtime = cache.as_deref().and_then(objects).filter(|objects| !objects.is_empty());
    if runtime.is_some() && build(runtime.as_ref()).0 {
        return Ok(Some(folder.join(PROGRAM)));
    }
    let (succeeded, output) = build(None);
    if !succeeded {
        return Err(problem(verilator.name(), output));
    }
    if let Some(cache) = cache {
        // Another build may do the same; without a cache, the next build takes longer.
        let _ = keep_runtime(&folder.join("build"), top, &cache);
    }
    Ok(Some(folder.join(PROGRAM)))
}

/// The folder for the objects of this Verilator and this compiler.
fn cache(verilator: Verilator) -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value: &OsString| !value.is_empty()).map(PathBuf::from);
    let folder = set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache")))?;
    let versions = format!("{} {}", verilator.version()?, line_of(Command::new(COMPILER).arg("--version"))?);
    let name: String = versions.chars().map(|c| if c.is_ascii_alphanumeric() || c == '.' { c } else { '-' }).collect();
    Some(folder.join("tilewright").join(name))
}

/// The objects in a folder, in sequence.
fn objects(folder: &Path) -> Option<Vec<PathBuf>> {
    let files = folder.read_dir().ok()?.flatten().map(|file| file.path());
    let mut objects: Vec<PathBuf> = files.filter(|file| file.extension().is_some_and(|it| it == "o")).collect();
    objects.sort();
    Some(objects)
}

/// Copies the runtime's objects of a build to the cache, and compiles the header there, all or none.
fn keep_runtime(build: &Path, top: &str, cache: &Path) -> std::io::Result<()> {
    let parent = cache.parent().unwrap_or(cache);
    std::fs::create_dir_all(parent)?;
    let aside = tempfile::TempDir::with_prefix_in("runtime-", parent)?;
    for object in objects(build).unwrap_or_default() {
        let name = object.file_name().unwrap_or_default();
        if name.to_string_lossy().starts_with("verilated") {
            std::fs::copy(&object, aside.path().join(name))?;
        }
    }
    compile_header(build, top, &aside.path().join(HEADER))?;
    // If another build was faster, this folder is deleted.
    std::fs::rename(aside.path(), cache)?;
    let _ = aside.keep();
    Ok(())
}

/// Compiles the header as a build's own makefile compiles its C++: the compiler takes it with the same options alone.
fn compile_header(build: &Path, top: &str, header: &Path) -> std::io::Result<()> {
    std::fs::write(header, INCLUDED)?;
    let path = header.display();
    let rule = "$(CXX) $(CXXFLAGS) $(CPPFLAGS) $(OPT_FAST) -x c++-header -c";
    std::fs::write(build.join("header.mk"), format!("include V{top}.mk\nheader:\n\t{rule} -o {path}.gch {path}\n"))?;
    // What is not compiled is included as it is.
    let _ = Command::new("make").args(["-f", "header.mk", "header", "OPT_FAST=-O0"]).current_dir(build).output()?;
    Ok(())
}
