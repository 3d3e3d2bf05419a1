//! What the pins of a ULX3S send where Icarus simulates the Verilog, or the netlist that Yosys makes of it.

use std::path::Path;
use std::process::Command;
use tilewright_boards::receiver::Lines;
use tilewright_gen::tools::{skipped, skipped_without, sources};
use tilewright_gen::verilog;
use tilewright_hdl::{Block, elaborate};

/// The cells of which Yosys has no models, and a bench that prints what is at the pins in the middle of each bit.
const CELLS: &str = include_str!("ecp5_cells.v");
const BENCH: &str = include_str!("dvi_bench.v");
/// Yosys's own models of the others.
const MODELS: &str = "/usr/share/yosys/ecp5";

/// What the printed Verilog sends; `None` without Icarus.
pub fn of_verilog<B: Block>(top: &B, bits: usize) -> Option<Lines> {
    if skipped_without(&["iverilog", "vvp"]).is_some() {
        return None;
    }
    let (folder, name, files) = printed(top);
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    Some(simulated(folder.path(), &name, &files, bits))
}

/// What the netlist for an ECP5 sends; `None` without Yosys with its models, or without Icarus.
pub fn of_netlist<B: Block>(top: &B, bits: usize) -> Option<Lines> {
    if skipped_without(&["yosys", "iverilog", "vvp"]).is_some() {
        return None;
    }
    if !Path::new(MODELS).exists() {
        let _ = skipped(&format!("{MODELS} has no models of cells"));
        return None;
    }
    let (folder, name, files) = printed(top);
    let script = format!("read_verilog {}; synth_ecp5 -top {name}; write_verilog -noattr netlist.v", files.join(" "));
    assert_eq!(run(folder.path(), "yosys", &["-q", "-p", &script]).trim(), "");
    let include = format!("-I{MODELS}");
    std::fs::write(folder.path().join("models.v"), models()).unwrap();
    Some(simulated(folder.path(), &name, &[&include, "netlist.v", "models.v"], bits))
}

/// The models of Yosys, without the module for a block RAM, which is empty there.
fn models() -> String {
    let models = std::fs::read_to_string(format!("{MODELS}/cells_sim.v")).unwrap();
    let (before, rest) = models.split_once("module DP16KD(").expect("Yosys declares a block RAM");
    format!("{before}module no_block_ram; {}", &rest[rest.find("endmodule").unwrap()..])
}

/// The printed files in a folder, the name of the top, and the names of the Verilog files.
fn printed<B: Block>(top: &B) -> (tempfile::TempDir, String, Vec<String>) {
    let (folder, design) = (tempfile::tempdir().unwrap(), elaborate(top).unwrap());
    let files = verilog(&design);
    for file in &files {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    let names = sources(&files).into_iter().map(str::to_owned).collect();
    (folder, design.top().name.clone(), names)
}

fn simulated(folder: &Path, top: &str, files: &[&str], bits: usize) -> Lines {
    let bench = BENCH.replace("TOP", top).replace("BITS", &bits.to_string());
    std::fs::write(folder.join("bench.v"), CELLS.to_owned() + &bench).unwrap();
    let own = ["-g2005", "-s", "bench", "-o", "bench.vvp", "bench.v"];
    let said = run(folder, "iverilog", &[&own, files].concat());
    assert!(!said.contains("error"), "{said}");
    let printed = run(folder, "vvp", &["-n", "bench.vvp"]);
    let printed = printed.lines().last().unwrap_or_default();
    let nibbles: Vec<u32> =
        printed.trim_start_matches(['x', 'X']).chars().map(|digit| digit.to_digit(16).expect(printed)).collect();
    std::array::from_fn(|lane| nibbles.iter().map(|nibble| nibble >> lane & 1 == 1).collect())
}

fn run(folder: &Path, program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).current_dir(folder).output().unwrap();
    String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
}
