//! What pins send where another simulator runs the Verilog, or the netlist that Yosys makes of it.

use std::path::Path;
use std::process::Command;
use tempfile::TempDir;
use tilewright_boards::receiver::{Lines, Seen};
use tilewright_gen::tools::{skipped, skipped_without, sources, verilated};
use tilewright_gen::verilog;
use tilewright_hdl::{Block, elaborate};

/// A family of FPGAs: what Yosys makes a netlist with, and what simulates it.
struct Chip {
    /// The pass of Yosys.
    pass: &'static str,
    /// Yosys's models of cells.
    models: &'static str,
    /// Modules of these models that are empty, or not for Verilator.
    unused: &'static [&'static str],
    /// Models in place of them.
    cells: &'static str,
    /// Prints what is at the pins.
    bench: &'static str,
}

const ECP5: Chip = Chip {
    pass: "synth_ecp5",
    models: "/usr/share/yosys/ecp5/cells_sim.v",
    unused: &["DP16KD"],
    cells: include_str!("ecp5_cells.v"),
    bench: include_str!("dvi_bench.v"),
};

const ICE40: Chip = Chip {
    pass: "synth_ice40 -device u -dsp -spram",
    models: "/usr/share/yosys/ice40/cells_sim.v",
    unused: &["SB_IO", "SB_PLL40_2_PAD"],
    cells: include_str!("ice40_cells.v"),
    bench: include_str!("pmod_bench.v"),
};

/// Builds a bench from files in a folder; `None` without the simulator.
type Build = fn(&Path, &Chip, &[&str]) -> Option<Command>;

/// What the Verilog for a ULX3S sends, as Icarus runs it; `None` without Icarus.
pub fn of_verilog<B: Block>(top: &B, bits: usize) -> Option<Lines> {
    let (folder, name, files) = printed(top);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    Some(lines(&said(icarus, folder.path(), &ECP5, &name, &files, bits)?))
}

/// What the netlist for an ECP5 sends, as Icarus runs it; `None` without Yosys with its models, or without Icarus.
pub fn of_netlist<B: Block>(top: &B, bits: usize) -> Option<Lines> {
    let (folder, name) = netlist(top, &ECP5)?;
    Some(lines(&said(icarus, folder.path(), &ECP5, &name, &NETLIST, bits)?))
}

/// What the PMOD of an iCEBreaker takes from the netlist, as Verilator runs it; `None` without Yosys with its models, or
/// without Verilator.
pub fn of_pmod<B: Block>(top: &B, pixels: usize) -> Option<Vec<Seen>> {
    let (folder, name) = netlist(top, &ICE40)?;
    let said = said(verilator, folder.path(), &ICE40, &name, &NETLIST, pixels)?;
    let levels = |word: u32| match word >> 14 & 1 {
        1 => Seen::Pixel([8, 4, 0].map(|place| (word >> place << 4) as u8)),
        _ => Seen::Blank { hsync: word >> 13 & 1 == 1, vsync: word >> 12 & 1 == 1 },
    };
    let words = said.split_whitespace().map(|word| u32::from_str_radix(word, 16).expect(word));
    // Until the PLL has locked, all pins are low.
    Some(words.skip_while(|word| *word == 0).map(levels).collect())
}

/// The four lines of the pins as a nibble for each bit, from where all are known: a memory without contents is shown at first.
fn lines(said: &str) -> Lines {
    let known = said.rsplit(['x', 'X']).next().unwrap_or_default();
    let nibbles: Vec<u32> = known.chars().map(|digit| digit.to_digit(16).expect(said)).collect();
    std::array::from_fn(|lane| nibbles.iter().map(|nibble| nibble >> lane & 1 == 1).collect())
}

/// The files of a netlist with the models of its cells.
const NETLIST: [&str; 2] = ["netlist.v", "models.v"];

/// The printed files in a folder, the name of the top, and the names of the Verilog files.
fn printed<B: Block>(top: &B) -> (TempDir, String, Vec<String>) {
    let (folder, design) = (tempfile::tempdir().unwrap(), elaborate(top).unwrap());
    let files = verilog(&design);
    for file in &files {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    let names = sources(&files).into_iter().map(str::to_owned).collect();
    (folder, design.top().name.clone(), names)
}

/// The netlist of a top in a folder, and the name of the top; `None` without Yosys with its models.
fn netlist<B: Block>(top: &B, chip: &Chip) -> Option<(TempDir, String)> {
    if skipped_without(&["yosys"]).is_some() {
        return None;
    }
    if !Path::new(chip.models).exists() {
        let _ = skipped(&format!("there are no models of cells in {}", chip.models));
        return None;
    }
    let (folder, name, files) = printed(top);
    // Where each bit of a wire has its own driver, a simulator makes all bits anew whenever one changes.
    let write = "splitnets; write_verilog -noattr netlist.v";
    let script = format!("read_verilog {}; {} -top {name}; {write}", files.join(" "), chip.pass);
    assert_eq!(run(folder.path(), Command::new("yosys").args(["-q", "-p", &script])).trim(), "");
    let models = std::fs::read_to_string(chip.models).unwrap();
    let models = chip.unused.iter().fold(models, |models, name| without(&models, name));
    std::fs::write(folder.path().join("models.v"), models).unwrap();
    Some((folder, name))
}

/// The models without a module.
fn without(models: &str, module: &str) -> String {
    let begin = models.find(&format!("module {module}")).expect("Yosys declares it");
    let end = models[begin..].find("endmodule").expect("it ends");
    format!("{}module no_{module};\n{}", &models[..begin], &models[begin + end..])
}

/// The line that the bench prints; `None` without the simulator.
fn said(build: Build, folder: &Path, chip: &Chip, top: &str, files: &[&str], times: usize) -> Option<String> {
    let bench = chip.bench.replace("TOP", top).replace("TIMES", &times.to_string());
    std::fs::write(folder.join("bench.v"), chip.cells.to_owned() + &bench).unwrap();
    let mut program = build(folder, chip, &[&["bench.v"], files].concat())?;
    let said = run(folder, &mut program);
    // Verilator adds where the simulation ends.
    let line = said.lines().rev().find(|line| !line.is_empty()).unwrap_or_default();
    Some(line.split("- ").next().unwrap_or_default().trim().to_owned())
}

fn icarus(folder: &Path, chip: &Chip, files: &[&str]) -> Option<Command> {
    if skipped_without(&["iverilog", "vvp"]).is_some() {
        return None;
    }
    let own = ["-g2005", "-s", "bench", "-o", "bench.vvp", &include(chip)];
    let said = run(folder, Command::new("iverilog").args(own).args(files));
    assert!(!said.contains("error"), "{said}");
    let mut program = Command::new("vvp");
    program.args(["-n", "bench.vvp"]);
    Some(program)
}

fn verilator(folder: &Path, chip: &Chip, files: &[&str]) -> Option<Command> {
    let language = ["--timing", "--default-language", "1364-2005", "--timescale-override", "1ps/1ps"];
    // The models leave it to a define whether a port has a value of its own, which that Verilog does not know. Verilator
    // warns of what is usual in models.
    let models = ["-DNO_ICE40_DEFAULT_ASSIGNMENTS", "-Wno-lint", "-Wno-fatal", &include(chip)];
    let program = verilated(folder, files, "bench", &[&language[..], &models].concat());
    Some(Command::new(program.unwrap_or_else(|problems| panic!("{problems}"))?))
}

/// Where models have files that they include.
fn include(chip: &Chip) -> String {
    format!("-I{}", Path::new(chip.models).parent().expect("a file is in a folder").display())
}

/// What a program prints.
fn run(folder: &Path, command: &mut Command) -> String {
    let output = command.current_dir(folder).output().unwrap();
    String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
}
