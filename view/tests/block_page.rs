//! The page of a block, played in a browser.

use crate::browser::{Tab, tab};
use crate::sample::{Served, unit};
use serde_json::json;
use tilewright_view::{Answer, Page, Site, export};

/// A block of two nets in two boxes with five clocks, and an array of two units inside of it.
struct Pair;

impl Site for Pair {
    fn page(&self) -> Page {
        Page::Block
    }

    fn about(&self) -> String {
        json!({ "title": "pair", "summary": "Adds.", "scenario": "two sums", "left_out": false }).to_string()
    }

    fn data(&self, name: &str, _: &str) -> Answer {
        match name.strip_prefix("unit/").and_then(|number| number.parse().ok()) {
            Some(number @ 0..3) => Answer::Whole(unit(number).to_string().into_bytes()),
            Some(_) => Answer::Refused("the unit is not there".to_owned()),
            None => Answer::Unknown,
        }
    }
}

const NOW: &str = "[...document.querySelectorAll('.nets td.now')].map(it => it.textContent)";
const CHANGED: &str = "[...document.querySelectorAll('g.changed title')].map(it => it.textContent)";
const NAMES: &str = "[...document.querySelectorAll('.nets tbody th')].map(it => it.textContent)";
/// The clock under the cursor of the wave.
const UNDER_CURSOR: &str = "(() => { const box = it => it.getBoundingClientRect(), cursor = box(document.querySelector('.wave .cursor')); \
return [...document.querySelectorAll('.wave .clock')].find(it => box(it).left >= cursor.left && box(it).left < cursor.right).textContent })()";

const IS_LOADED: &str = "block.data !== null && document.querySelectorAll('.nets tr').length === 4";

/// The page of the pair, at that width and in that colour scheme; `None` without a browser.
fn pair_on_a_page(width: u32, scheme: &str) -> Option<(Served, Tab)> {
    let mut tab = tab()?;
    let served = Served::new(Pair);
    tab.open(&served.address, width, scheme);
    tab.until(IS_LOADED);
    Some((served, tab))
}

#[test]
fn the_page_steps_through_a_block() {
    let Some((_served, mut tab)) = pair_on_a_page(1280, "light") else { return };
    assert_eq!((tab.text("h1"), tab.text("#scenario")), ("pair".to_owned(), "The run: two sums.".to_owned()));
    // What the block does stands in the head alone.
    assert_eq!(
        (tab.text("#summary"), tab.text(".circuit > .hint")),
        ("Adds.".to_owned(), "The source is src/pair.rs:3.".to_owned())
    );
    assert_eq!((tab.value(NOW), tab.value(CHANGED)), (json!(["0", "0", "0"]), json!([])));
    tab.press("ArrowRight");
    tab.click("button.step");
    assert_eq!((tab.value(NOW), tab.value(CHANGED)), (json!(["1f", "0", "0"]), json!(["sum = 1f"])));
    assert_eq!(tab.text(".present"), "of 4, 20 ns");
    tab.press("ArrowRight");
    assert_eq!((tab.value(NOW), tab.value(CHANGED)), (json!(["20", "1", "0"]), json!(["sum = 20", "carry = 1"])));
    tab.press("ArrowLeft");
    assert_eq!(tab.value(NOW), json!(["1f", "0", "0"]));
    tab.press("End");
    assert_eq!(tab.text(".present"), "of 4, 40 ns");
    assert!(tab.text(".nets tbody tr").contains("src/pair.rs:12"));

    tab.click("#circuit g:nth-of-type(2)");
    assert_eq!(tab.value(NAMES), json!(["carry"]));
    tab.press("Escape");
    tab.value("block.filter.value = 'SU'; block.filter.dispatchEvent(new Event('input'))");
    assert_eq!(tab.value(NAMES), json!(["sum"]));
    no_faults(&mut tab);
}

fn no_faults(tab: &mut Tab) {
    for (width, scheme) in [(1280, "light"), (1280, "dark"), (390, "dark"), (390, "light")] {
        tab.resize(width, scheme);
        assert_eq!(tab.faults(), [""; 0], "{width} {scheme}");
    }
}

/// A box of several nets has the word of a stream while it is valid, or no value. A value stands where no arrow ends.
#[test]
fn a_value_stands_beside_its_own_name_and_on_no_arrow() {
    let Some((_served, mut tab)) = pair_on_a_page(1280, "light") else { return };
    let place = r#"(() => {
        const box = (y, title, name) => `<g><title>${title}</title><rect class="box" x="10" y="${y}" width="60" height="40"/>
            <text class="name" x="15" y="${y + 16}">${name}</text></g>`;
        const arrow = y => `<g><path class="line" d="M150 ${y} H75"/><path class="head" d="M70 ${y} l7 -3.2 v6.3 Z"/>
            <text class="label" x="80" y="${y - 2}">label</text></g>`;
        const net = (name, ...changes) => ({ name, changes: changes.map((value, step) => [step, value]) });
        globalThis.placed = [net("word_ready", "1"), net("word_valid", "0", "1"), net("word_payload", "5", "abc"),
            net("both_valid", "0", "1"), net("both_x", "6"), net("both_y", "7"), net("of_0", "8"), net("of_1", "9"), net("late", "3", "4")];
        const svg = arrow(20) + box(10, "word_ready\nword_valid\nword_payload", "word") + arrow(70) + box(60, "both_valid\nboth_x\nboth_y", "both")
            + box(110, "of_0\nof_1", "of[*] ×2") + arrow(170) + box(160, "late", "late");
        block.diagram.place(`<svg xmlns="http://www.w3.org/2000/svg" width="200" height="220">${svg}</svg>`, placed, []);
    })()"#;
    tab.value(place);
    let drawn = |step: u32| {
        format!(
            "(block.diagram.draw(placed, {step}, null), [...document.querySelectorAll('.of-net')].map(it => it.textContent))"
        )
    };
    assert_eq!(tab.value(&drawn(0)), json!(["3"]));
    assert_eq!(tab.value(&drawn(1)), json!(["abc", "valid", "4"]));
    let covered = "[...document.querySelectorAll('.of-net')].filter(value => {
        const one = value.getBoundingClientRect();
        return [...document.querySelectorAll('.head, .label')].map(it => it.getBoundingClientRect()).some(other =>
            one.left < other.right && other.left < one.right && one.top + 3 < other.bottom && other.top < one.bottom - 3);
    }).map(it => it.textContent)";
    assert_eq!(tab.value(covered), json!([]));
}

/// Fields of a record have long names that differ at their ends.
#[test]
fn a_long_name_keeps_its_end() {
    let Some((_served, mut tab)) = pair_on_a_page(390, "light") else { return };
    tab.value(
        "block.data.nets.forEach((net, number) => { net.name = `works_polygon_plane_x[${number}]`; }); block.draw()",
    );
    assert_eq!(tab.value(&format!("{NAMES}[2]")), json!("works…_plane_x[2]"));
    assert_eq!(tab.value("document.querySelector('.nets tbody th').title"), json!("works_polygon_plane_x[0]"));
    let shown = tab.value("document.querySelector('.wave .name').firstChild.textContent");
    assert!(shown.as_str().is_some_and(|name| name.starts_with("work") && name.ends_with("…plane_x[0]")), "{shown}");
    no_faults(&mut tab);
}

/// The values stand on the diagram, and the cursor of the wave follows the clock, by keys and by clicks.
#[test]
fn the_diagram_and_the_wave_show_the_clock() {
    let Some((_served, mut tab)) = pair_on_a_page(1280, "dark") else { return };
    let written = "[...document.querySelectorAll('.of-net')].map(it => it.textContent)";
    assert_eq!((tab.value(written), tab.value(UNDER_CURSOR)), (json!(["0", "0"]), json!("0")));
    tab.press("ArrowRight");
    tab.press("ArrowRight");
    tab.press("ArrowRight");
    assert_eq!((tab.value(written), tab.value(UNDER_CURSOR)), (json!(["20", "1"]), json!("3")));
    // The wave has the ports; a box of the diagram chooses other nets.
    let waved = "[...document.querySelectorAll('.wave .name')].map(it => it.firstChild.textContent)";
    assert_eq!(tab.value(waved), json!(["sum"]));
    assert_eq!(
        tab.value("[...document.querySelectorAll('.wave .value')].map(it => it.textContent)"),
        json!(["0", "1f", "20"])
    );
    tab.click("#circuit g:nth-of-type(2)");
    assert_eq!(tab.value(waved), json!(["carry"]));

    let left = "(document.querySelector('.wave').getBoundingClientRect().width)";
    let width = tab.value(left).as_f64().unwrap();
    let first = tab.value("block.wave.left").as_f64().unwrap();
    let at = |clock: f64| [(first + 46.0 * (clock + 0.5)) / width, 0.7];
    tab.drag(".wave", at(1.0), at(1.0));
    assert_eq!((tab.value("block.step"), tab.value(UNDER_CURSOR)), (json!(1), json!("1")));
    // The wave has the focus now, and is a slider for a screen reader.
    tab.press("ArrowRight");
    assert_eq!(tab.value("document.activeElement.getAttribute('aria-valuetext')"), "clock 2; carry 0");
    // A narrow window has fewer clocks, and the cursor stays in it.
    tab.resize(390, "dark");
    tab.press("End");
    tab.until("document.querySelector('.wave svg').getBoundingClientRect().right <= innerWidth");
    assert_eq!(tab.value(UNDER_CURSOR), json!("4"));
}

#[test]
fn units_inside_are_opened_and_left() {
    let Some((_served, mut tab)) = pair_on_a_page(1280, "light") else { return };
    assert_eq!(tab.value("document.querySelector('.trail').hidden"), true);
    tab.press("ArrowRight");
    tab.press("ArrowRight");
    tab.click("#circuit g:nth-of-type(3)");
    tab.until("block.data.name === 'u_half[0]'");
    assert_eq!((tab.value(NAMES), tab.value(NOW)), (json!(["word"]), json!(["2"])));
    // It is the same time, and this unit has half as many clocks.
    assert_eq!(tab.text(".present"), "of 2, 20 ns");
    assert_eq!(tab.value("block.step"), json!(1));
    // Another one of the array, by the list.
    tab.value("document.querySelector('.trail select').value = '2'; document.querySelector('.trail select').dispatchEvent(new Event('change'))");
    tab.until("block.data.name === 'u_half[1]'");
    no_faults(&mut tab);
    tab.click(".trail button");
    tab.until("block.data.name === 'pair'");
    assert_eq!(tab.value(NOW), json!(["1f", "0", "0"]));
    // By keys alone: the box is a button.
    tab.value("document.querySelector('#circuit g:nth-of-type(3)').focus()");
    tab.press("Enter");
    tab.until("block.data.name === 'u_half[0]'");
    tab.value("document.activeElement.blur()");
    tab.press("Backspace");
    tab.until("block.data.name === 'pair'");
    let label = "document.querySelector('#circuit g:nth-of-type(3)').getAttribute('aria-label')";
    assert_eq!(tab.value(label), "Open u_half");
}

/// A unit whose data are not beside the page is told in a sentence, and the page goes on.
#[test]
fn an_exported_block_opens_its_units() {
    let Some(mut tab) = tab() else { return };
    let data = [0, 1].map(|number| (format!("unit/{number}"), unit(number).to_string().into_bytes()));
    let folder = tempfile::tempdir().unwrap();
    for file in export::files(Page::Block, &Pair.about(), data) {
        let path = folder.path().join(file.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, file.bytes).unwrap();
    }
    tab.open(&format!("file://{}", folder.path().join("index.html").display()), 390, "light");
    tab.until(IS_LOADED);
    tab.click("#circuit g:nth-of-type(3)");
    tab.until("block.data.name === 'u_half[0]'");
    assert_eq!(tab.faults(), [""; 0]);
    tab.value("block.open(2)");
    tab.until("document.querySelector('.circuit [role=alert]')?.textContent.length > 0");
    assert_eq!(tab.text(".circuit [role=alert]"), "data/unit/2.js is missing beside this page");
    tab.complaints.clear();
    tab.press("Backspace");
    tab.until("block.data.name === 'pair'");
    assert_eq!(tab.value("document.querySelector('.circuit [role=alert]').textContent"), "");
    assert_eq!(tab.faults(), [""; 0]);
}
