//! Searches with Yosys for inputs that violate an assertion in the clocks after a reset, among inputs that satisfy the
//! assumptions.

use std::fs;
use std::process::Command;
use tilewright_gen::verilog;
use tilewright_hdl::Design;
use tilewright_hdl::ir::Directive;

/// Whether Yosys is installed.
pub fn is_there() -> bool {
    Command::new("yosys").arg("-V").output().is_ok()
}

/// Yosys's counterexample within `clocks` clocks; none if there is no Yosys, or nothing to violate.
pub fn broken(design: &Design, clocks: u32) -> Option<String> {
    let is_assertion = |directive| directive == Directive::Assert;
    let states = design.modules().iter().any(|module| module.properties.iter().any(|it| is_assertion(it.directive)));
    if !states || !is_there() {
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let files = verilog(design);
    files.iter().for_each(|file| fs::write(folder.path().join(&file.name), &file.text).unwrap());
    let top = design.top();
    let resets: String =
        top.clocks.iter().filter_map(|it| it.reset.as_deref()).map(|it| format!(" -set-at 1 {it} 1")).collect();
    let script = format!(
        "read_verilog -formal -sv *.v; prep -flatten -top {}; memory_map; opt; delete t:$cover; \
         sat -verify -seq 1 -tempinduct -tempinduct-baseonly -maxsteps {clocks} -set-assumes -prove-asserts{resets}",
        top.name
    );
    let run = Command::new("yosys").current_dir(&folder).args(["-q", "-p", &script]).output().unwrap();
    let text = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
    (!run.status.success() || text.contains("FAIL")).then_some(text)
}
