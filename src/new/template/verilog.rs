//! Prints the counter as Verilog, a module after the other.
//! `cargo run --example verilog`

use my_block::Counter;
use tilewright_hdl::{Problems, elaborate};

fn main() -> Result<(), Problems> {
    let design = elaborate(&Counter { limit: 3 })?;
    for file in tilewright_gen::verilog(&design) {
        print!("{}", file.text);
    }
    Ok(())
}
