//! The files of a new crate. The tests of the command line compile the sources as they are, and run the block's test.

use super::origin::Origin;
use crate::shell::Failure;

/// What the crate is called in the templates, and in their code.
const NAME: &str = "my-block";
const IDENTIFIER: &str = "my_block";

/// Each file with its place in the crate.
const FILES: [(&str, &str); 6] = [
    (".gitignore", "/target\n*.vcd\n"),
    ("Cargo.toml", include_str!("template/manifest.toml")),
    ("README.md", include_str!("template/README.md")),
    ("examples/verilog.rs", include_str!("template/verilog.rs")),
    ("examples/wave.rs", include_str!("template/wave.rs")),
    ("src/lib.rs", include_str!("template/lib.rs")),
];

/// The crates that it needs: the placeholder of each, and its folder.
const CRATES: [(&str, &str); 3] = [("{ HDL }", "hdl"), ("{ GEN }", "gen"), ("{ SIM }", "sim")];

/// The files of a crate of that name.
///
/// # Errors
/// Where Tilewright is cannot be said in a manifest.
pub fn files(name: &str, origin: &Origin) -> Result<Vec<(&'static str, String)>, Failure> {
    let identifier = name.replace('-', "_");
    let mut files = FILES.map(|(place, text)| (place, text.replace(NAME, name).replace(IDENTIFIER, &identifier)));
    let (_, manifest) = files.iter_mut().find(|(place, _)| *place == "Cargo.toml").expect("a crate has a manifest");
    for (placeholder, folder) in CRATES {
        *manifest = manifest.replace(placeholder, &format!("{{ {} }}", origin.dependency(folder)?));
    }
    Ok(files.into())
}
