//! Writes Verilog and constraints of a top: `cargo run -p tilewright-boards --example write -- TOP BOARD FOLDER`.

use std::error::Error;
use std::path::Path;
use tilewright_boards::Top;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, board, folder] = &arguments[..] else { return Err("name a top, a board and a folder".into()) };
    let top = Top::find(name, board).ok_or("there is no such top")?;
    std::fs::create_dir_all(folder)?;
    for file in top.files(&(top.design)()?)? {
        std::fs::write(Path::new(folder).join(&file.name), &file.text)?;
    }
    Ok(())
}
