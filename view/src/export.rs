//! A page as files that open without a server.

use crate::{Page, page};

/// A file of a folder: its name, which may have folders in it, and its content.
///
/// ```
/// use tilewright_view::export::File;
///
/// let file = File { name: "data/frame/vc1.js".to_owned(), bytes: Vec::new() };
/// assert!(file.name.ends_with(".js"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// The name below the folder, with `/` between its parts.
    pub name: String,
    /// The content.
    pub bytes: Vec<u8>,
}

/// The files of a page with all its data: `about` is a JSON object, and each of the data has a name and its JSON. A browser reads no JSON
/// beside a page that it opens from a disk, but scripts, so the data are scripts.
///
/// ```
/// use tilewright_view::{Page, export};
///
/// let files = export::files(Page::Frame, "{}", [("frame/vc1".to_owned(), b"{}".to_vec())]);
/// let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
/// assert!(names.contains(&"index.html") && names.contains(&"data/frame/vc1.js"));
/// ```
pub fn files(page: Page, about: &str, data: impl IntoIterator<Item = (String, Vec<u8>)>) -> Vec<File> {
    let plain = |name: &str, text: &str| File { name: name.to_owned(), bytes: text.as_bytes().to_vec() };
    let own = page::files(page).map(|(name, _, text)| plain(name, text));
    let about = plain(page::ABOUT, &page::about(about, true));
    let data = data.into_iter().map(|(name, json)| {
        let head = format!("EXPORTED[{}] = ", serde_json::Value::from(name.as_str()));
        File { name: format!("{}{name}.js", page::DATA), bytes: [head.as_bytes(), &json, b";\n"].concat() }
    });
    own.chain([about]).chain(data).collect()
}
