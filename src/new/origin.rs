//! Where a new crate gets Tilewright from.

use crate::shell::{Exit, Failure};
use std::path::{Component, Path, PathBuf};

/// Where Tilewright's crates are.
#[derive(Debug, PartialEq)]
pub enum Origin {
    /// A folder with its sources, as seen from the new crate.
    Folder(PathBuf),
    /// A repository.
    Git(String),
}

impl Origin {
    /// The user's choice, or `repository`, which the program itself names; that is empty if it names none.
    ///
    /// # Errors
    /// Neither the user nor the program names a place; or the folder does not have Tilewright's sources.
    pub fn of(path: Option<PathBuf>, git: Option<String>, repository: &str) -> Result<Origin, Failure> {
        match (path, git) {
            (Some(path), _) => Origin::folder(&path),
            (None, Some(url)) => Ok(Origin::Git(url)),
            (None, None) if repository.is_empty() => {
                let sentence = "the crate needs Tilewright: name a folder with its sources with --path, or a repository with --git";
                Err(Failure::new(Exit::BadInput, sentence))
            }
            (None, None) => Ok(Origin::Git(repository.to_owned())),
        }
    }

    fn folder(path: &Path) -> Result<Origin, Failure> {
        let manifest = path.join("hdl/Cargo.toml");
        if !manifest.is_file() {
            let sentence = format!(
                "{}: does not have Tilewright's sources, as {} is missing: name their folder with --path",
                path.display(),
                manifest.display()
            );
            return Err(Failure::new(Exit::BadInput, sentence));
        }
        let seen = if path.is_absolute() { path.to_owned() } else { Path::new("..").join(path) };
        Ok(Origin::Folder(seen.components().filter(|part| *part != Component::CurDir).collect()))
    }

    /// The manifest's entry for the crate in that folder of Tilewright.
    ///
    /// # Errors
    /// The path is not UTF-8, as a manifest has to be.
    pub fn dependency(&self, folder: &str) -> Result<String, Failure> {
        match self {
            Origin::Git(url) => Ok(format!("git = {}", quoted(url))),
            Origin::Folder(path) => match path.join(folder).to_str() {
                Some(path) => Ok(format!("path = {}", quoted(path))),
                None => {
                    let sentence =
                        format!("{}: is not UTF-8, as a manifest has to be: rename the folder", path.display());
                    Err(Failure::new(Exit::BadInput, sentence))
                }
            },
        }
    }
}

/// A text as a string of TOML, which is that of JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repository_that_the_program_names_is_the_default() {
        let origin = |path: Option<&str>, git: Option<&str>, repository| {
            Origin::of(path.map(PathBuf::from), git.map(str::to_owned), repository).map_err(|failure| failure.sentence)
        };
        let named = "https://example.org/t.git";
        assert_eq!(origin(None, None, named), Ok(Origin::Git(named.to_owned())));
        assert_eq!(origin(None, Some("/srv/t.git"), named), Ok(Origin::Git("/srv/t.git".to_owned())));
        assert!(origin(None, None, "").unwrap_err().ends_with("with --path, or a repository with --git"));
        // This test runs in the folder of the sources.
        assert_eq!(origin(Some("."), None, named), Ok(Origin::Folder("..".into())));
        let sources = env!("CARGO_MANIFEST_DIR");
        assert_eq!(origin(Some(sources), None, ""), Ok(Origin::Folder(sources.into())));
        assert!(origin(Some("hdl"), None, "").unwrap_err().starts_with("hdl: does not have Tilewright's sources"));
    }

    #[test]
    fn a_dependency_is_a_string_of_toml() {
        let of = |origin: Origin| origin.dependency("hdl").unwrap();
        assert_eq!(of(Origin::Git("a\"b\\c\u{7f}".to_owned())), r#"git = "a\"b\\c\u007f""#);
        assert_eq!(of(Origin::Folder("../t".into())), r#"path = "../t/hdl""#);
    }
}
