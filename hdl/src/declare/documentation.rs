//! The documentation of a block: what its declaration says in words.

use std::collections::BTreeMap;

use crate::bundle::Bundle;
use crate::fields::Fields;
use crate::signal::Signal;
use tilewright_circuit::ir::About;

/// The text of a documentation line; of any other attribute, nothing.
#[doc(hidden)]
#[macro_export]
macro_rules! doc_line {
    (doc = $text:expr) => {
        $text
    };
    ($($other:tt)*) => {
        ""
    };
}

/// The description in words of a block's declaration.
#[doc(hidden)]
pub fn about<I: Bundle, O: Bundle>(said: &[&str], latency: String, source: String) -> About {
    About { summary: sentence(said), latency, source, inputs: ports::<I>(), outputs: ports::<O>() }
}

/// The documentation of a bundle's ports and of the records in it.
fn ports<B: Bundle>() -> BTreeMap<String, String> {
    let mut ports = BTreeMap::new();
    <B as Fields<Signal>>::documentation("", "", &mut |path, said| {
        if !said.is_empty() {
            ports.insert(path.to_owned(), said.to_owned());
        }
    });
    ports
}

/// The first paragraph of a documentation text, on one line, without its link targets.
#[doc(hidden)]
pub fn sentence(lines: &[&str]) -> String {
    let lines = lines.iter().map(|line| line.trim()).skip_while(|line| line.is_empty());
    let text = lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    let mut plain = String::new();
    let mut rest = text.as_str();
    while let Some((before, link)) = rest.split_once("[`") {
        let Some((name, after)) = link.split_once("`]") else { break };
        plain += &format!("{before}`{name}`");
        rest = after.strip_prefix('(').and_then(|place| Some(place.split_once(')')?.1)).unwrap_or(after);
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_paragraph_without_its_links() {
        assert_eq!(sentence(&[" Leads the", " scan.", "", " And more."]), "Leads the scan.");
        assert_eq!(sentence(&[" [`A`] and [`b`](super::b), not [c]."]), "`A` and `b`, not [c].");
        assert_eq!(sentence(&[]), "");
    }
}
