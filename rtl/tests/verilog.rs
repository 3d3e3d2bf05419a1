//! The Verilog of every block at its default parameters, each a file of `golden`, to be read as one reads hand-written Verilog.

#[path = "../../gen/tests/golden/compare.rs"]
mod compare;

use tilewright_gen::verilog;
use tilewright_rtl::catalog::ENTRIES;

#[test]
fn every_block_is_printed_as_in_its_golden_file() {
    for entry in ENTRIES {
        let design = entry.design(&entry.values([]).unwrap()).unwrap();
        let files = verilog(&design);
        let name = format!("{}.v", design.top().name);
        compare::compare(files.iter().find(|file| file.name == name).expect("the top has a file"));
    }
}
