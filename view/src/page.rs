//! The files of a page.

/// A page.
///
/// ```
/// use tilewright_view::Page;
///
/// assert_ne!(Page::Frame, Page::Block);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// A frame coming into being.
    Frame,
    /// A block, clock by clock.
    Block,
}

/// The name of the page itself.
pub(crate) const INDEX: &str = "index.html";
/// The name of the script that says what the page is about.
pub(crate) const ABOUT: &str = "about.js";
/// What the names of data begin with.
pub(crate) const DATA: &str = "data/";

pub(crate) const SCRIPT: &str = "text/javascript; charset=utf-8";
const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";

/// Name, type and text.
type Asset = (&'static str, &'static str, &'static str);

/// A file of the folder `page/`.
macro_rules! asset {
    ($name:literal, $kind:expr) => {
        ($name, $kind, include_str!(concat!("../page/", $name)))
    };
}

const SHARED: &[Asset] = &[
    asset!("style.css", CSS),
    asset!("circuit.css", CSS),
    asset!("data.js", SCRIPT),
    asset!("dom.js", SCRIPT),
    asset!("keys.js", SCRIPT),
    asset!("values.js", SCRIPT),
    asset!("wave.js", SCRIPT),
    asset!("diagram.js", SCRIPT),
    asset!("circuit.js", SCRIPT),
];

const FRAME: &[Asset] = &[
    ("index.html", HTML, include_str!("../page/frame.html")),
    asset!("frame.css", CSS),
    asset!("clock.js", SCRIPT),
    asset!("film.js", SCRIPT),
    asset!("paint.js", SCRIPT),
    asset!("areas.js", SCRIPT),
    asset!("panel.js", SCRIPT),
    asset!("lanes.js", SCRIPT),
    asset!("way.js", SCRIPT),
    asset!("moment.js", SCRIPT),
    asset!("why.js", SCRIPT),
    asset!("pixel.js", SCRIPT),
    asset!("frame.js", SCRIPT),
];

const BLOCK: &[Asset] = &[("index.html", HTML, include_str!("../page/block.html")), asset!("block.js", SCRIPT)];

/// The files of a page, but for what it is about.
pub(crate) fn files(page: Page) -> impl Iterator<Item = Asset> {
    let own = if page == Page::Frame { FRAME } else { BLOCK };
    own.iter().chain(SHARED).copied()
}

/// The script that says what a page is about, and whether it is a folder without a server.
pub(crate) fn about(json: &str, is_exported: bool) -> String {
    format!("const ABOUT = {json};\nconst IS_EXPORTED = {is_exported};\nconst EXPORTED = {{}};\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_each_of_its_files_once_and_calls_all_of_them() {
        for page in [Page::Frame, Page::Block] {
            let names: Vec<&str> = files(page).map(|(name, ..)| name).collect();
            let (_, _, html) = files(page).find(|(name, ..)| *name == "index.html").expect("a page has one");
            for name in &names {
                assert_eq!(names.iter().filter(|other| other == &name).count(), 1, "{name}");
                assert!(*name == "index.html" || html.contains(&format!("\"{name}\"")), "{name} is not called");
            }
        }
    }
}
