//! A model made by Verilator, as a contender.

use crate::RESET_CYCLES;
use crate::contender::{Contender, Run};
use crate::error::Error;
use crate::report::Made;
use crate::subject::{HandWritten, Subject};
use std::fmt::Write;
use std::time::Duration;
use tilewright_gen::tools::{Compiler, Model, Source};
use tilewright_gen::{VerilogFile, verilog};
use tilewright_hdl::Design;

/// A model of a design.
#[derive(Debug)]
pub struct Verilated {
    name: String,
    made: Made,
    model: Model,
}

/// The models of a subject that a Verilator makes: from the Verilog that we print and from the hand-written one; if
/// names are given, only those.
///
/// # Errors
///
/// Verilator or clang rejects one.
pub fn models(compiler: &Compiler, subject: Subject, named: &[String]) -> Result<Vec<Verilated>, Error> {
    let design = subject.design().map_err(tilewright_sim::Error::from)?;
    let ports = ports(&design);
    let build = |name: String, files: &[VerilogFile], top: &str, parameters: &[(&str, u32)]| {
        let driver = [("main.cpp", include_str!("../verilator/main.cpp")), ("ports.h", &ports)];
        let model = compiler.compile(&Source { verilog: files, top, parameters, driver: &driver })?;
        let made = Made { verilator: compiler.verilator_version(), verilog: name };
        let name = format!("Verilator {}, {}", made.verilator, made.verilog);
        Ok::<_, Error>(Verilated { name, made, model })
    };
    let is_wanted = |name: &str| named.is_empty() || named.iter().any(|it| it == name);
    let mut models = Vec::new();
    if is_wanted(Subject::OUR_VERILOG) {
        models.push(build("our Verilog".to_owned(), &verilog(&design), &design.top().name, &[])?);
    }
    for HandWritten { module, text, parameter } in subject.hand_written() {
        if !is_wanted(module) {
            continue;
        }
        let file = VerilogFile { name: format!("{module}.v"), text: text.to_owned() };
        models.push(build(file.name.clone(), &[file], module, &[parameter])?);
    }
    Ok(models)
}

/// The C++ header that describes the design's ports to the driver.
fn ports(design: &Design) -> String {
    let top = design.top();
    let (mut clocks, mut resets) = (String::new(), String::new());
    // Writing to a string does not fail.
    for clock in &top.clocks {
        let period = clock.period.expect("the clocks of a top have periods").picoseconds();
        let _ = write!(clocks, " CLOCK({}, {period})", clock.port);
    }
    let inputs = top.inputs.iter().map(|input| input.name.as_str()).filter(|name| *name == "rst");
    for reset in top.clocks.iter().filter_map(|clock| clock.reset.as_deref()).chain(inputs) {
        let _ = write!(resets, " RESET({reset})");
    }
    format!("#define CLOCKS{clocks}\n#define RESETS{resets}\n#define RESET_CYCLES {RESET_CYCLES}\n")
}

impl Contender for Verilated {
    fn name(&self) -> &str {
        &self.name
    }

    fn made(&self) -> Option<&Made> {
        Some(&self.made)
    }

    fn build_time(&self) -> Option<Duration> {
        Some(self.model.build_time)
    }

    fn run(&self, cycles: u64) -> Result<Run, Error> {
        let printed = self.model.run(&[cycles.to_string()])?;
        parse(&printed).ok_or_else(|| Error::Unreadable { name: self.name.clone(), printed })
    }
}

/// Reads the line that the driver prints.
fn parse(printed: &str) -> Option<Run> {
    let mut words = printed.split_whitespace();
    let checksum = u32::from_str_radix(words.next()?, 16).ok()?;
    let mut seconds = || Duration::try_from_secs_f64(words.next()?.parse().ok()?).ok();
    Some(Run { checksums: vec![checksum], first_cycle: seconds()?, others: seconds()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drivers_line_is_read() {
        let run = parse("0badcafe 0.000001000 2.5\n").unwrap();
        assert_eq!((run.checksums[0], run.first_cycle.as_nanos(), run.others.as_secs_f64()), (0x0bad_cafe, 1000, 2.5));
        assert!(parse("0badcafe 0.1").is_none() && parse("").is_none());
    }
}
