//! Writes a small page with every kind of part: `cargo run -p tilewright-report --example page -- DIR`.

#[path = "../tests/sample/mod.rs"]
mod sample;

use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args_os().nth(1).ok_or("name a folder: `--example page -- DIR`")?);
    std::fs::create_dir_all(&folder)?;
    for file in sample::page().files()? {
        std::fs::write(folder.join(&file.name), file.bytes)?;
        println!("wrote {}", folder.join(file.name).display());
    }
    Ok(())
}
