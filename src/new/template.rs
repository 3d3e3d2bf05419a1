//! The files of a new crate. Tests of the command line compile these sources and run the block's test.

use super::origin::Origin;
use crate::shell::Failure;

/// The crate's name in the templates, and in their code.
const NAME: &str = "my-block";
const IDENTIFIER: &str = "my_block";

/// Each file with its path in the crate.
const FILES: [(&str, &str); 6] = [
    (".gitignore", "/target\n*.vcd\n"),
    ("Cargo.toml", include_str!("template/manifest.toml")),
    ("README.md", include_str!("template/README.md")),
    ("examples/verilog.rs", include_str!("template/verilog.rs")),
    ("examples/wave.rs", include_str!("template/wave.rs")),
    ("src/lib.rs", include_str!("template/lib.rs")),
];

/// The crates that it needs: a placeholder and a folder for each.
const CRATES: [(&str, &str); 3] = [("{ HDL }", "hdl"), ("{ GEN }", "gen"), ("{ SIM }", "sim")];

/// The files of a crate of that name.
///
/// # Errors
/// A manifest cannot contain the path of Tilewright.
pub fn files(name: &str, origin: &Origin) -> Result<Vec<(&'static str, String)>, Failure> {
    let identifier = name.replace('-', "_");
    let mut files = FILES.map(|(place, text)| (place, text.replace(NAME, name).replace(IDENTIFIER, &identifier)));
    let (_, manifest) = files.iter_mut().find(|(place, _)| *place == "Cargo.toml").expect("a crate has a manifest");
    for (placeholder, folder) in CRATES {
        *manifest = manifest.replace(placeholder, &format!("{{ {} }}", origin.dependency(folder)?));
    }
    Ok(files.into())
}
