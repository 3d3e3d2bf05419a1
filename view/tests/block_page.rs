//! The page of a block, played in a browser.

use crate::browser::tab;
use crate::sample::Served;
use serde_json::json;
use tilewright_view::{Answer, Page, Site};

/// A block of two nets in two boxes, and five clocks.
struct Pair;

impl Site for Pair {
    fn page(&self) -> Page {
        Page::Block
    }

    fn about(&self) -> String {
        json!({ "title": "pair", "summary": "Adds.", "scenario": "two sums", "left_out": false }).to_string()
    }

    fn data(&self, name: &str, _: &str) -> Answer {
        let square = |x: u32, net: &str| {
            format!(r#"<g><title>{net}</title><rect x="{x}" width="90" height="40" fill="gray" stroke="black"/></g>"#)
        };
        let svg =
            |inner: String| format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="50">{inner}</svg>"#);
        let data = json!({
            "diagram": svg(square(5, "sum") + &square(105, "carry")),
            "wave": svg(String::new()),
            "times": [0, 10_000, 20_000, 30_000, 40_000],
            "nets": [
                { "name": "sum", "width": 8, "source": "src/pair.rs:12", "changes": [[0, "0"], [2, "1f"], [3, "20"]] },
                { "name": "carry", "width": 1, "source": null, "changes": [[0, "0"], [3, "1"]] },
            ],
        });
        if name == "block" { Answer::Whole(data.to_string().into_bytes()) } else { Answer::Unknown }
    }
}

#[test]
fn the_page_steps_through_a_block() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Pair);
    tab.open(&served.address, 1280, "light");
    tab.until("block.data !== null && at('nets').rows.length === 3");
    assert_eq!((tab.text("h1"), tab.text("#scenario")), ("pair".to_owned(), "The run: two sums.".to_owned()));
    let now = "[...document.querySelectorAll('#nets td.now')].map(it => it.textContent)";
    let changed = "[...document.querySelectorAll('g.changed title')].map(it => it.textContent)";
    assert_eq!((tab.value(now), tab.value(changed)), (json!(["0", "0"]), json!([])));
    tab.press("ArrowRight");
    tab.click("#step");
    assert_eq!((tab.value(now), tab.value(changed)), (json!(["1f", "0"]), json!(["sum = 1f"])));
    assert_eq!(tab.text("#now"), "of 4, 20 ns");
    tab.press("ArrowRight");
    assert_eq!((tab.value(now), tab.value(changed)), (json!(["20", "1"]), json!(["sum = 20", "carry = 1"])));
    tab.press("ArrowLeft");
    assert_eq!(tab.value(now), json!(["1f", "0"]));
    tab.press("End");
    assert_eq!(tab.text("#now"), "of 4, 40 ns");
    assert!(tab.text("#nets tbody tr").contains("src/pair.rs:12"));

    tab.click("#diagram g:nth-of-type(2)");
    let names = "[...document.querySelectorAll('#nets tbody th')].map(it => it.textContent)";
    assert_eq!(tab.value(names), json!(["carry"]));
    tab.press("Escape");
    tab.value("at('filter').value = 'SU'; at('filter').dispatchEvent(new Event('input'))");
    assert_eq!(tab.value(names), json!(["sum"]));
    for (width, scheme) in [(1280, "light"), (1280, "dark"), (390, "dark"), (390, "light")] {
        tab.resize(width, scheme);
        assert_eq!(tab.faults(), [""; 0], "{width} {scheme}");
    }
}
