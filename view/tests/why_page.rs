//! The way of a pixel on the page of a frame, played in a browser.

use crate::browser::{Tab, tab};
use crate::sample::{Columns, Served};
use serde_json::json;

const IS_LOADED: &str = "view.panels.length > 0 && view.panels.every(({ film }) => film)";
const STEPS: &str = "document.querySelectorAll('.steps tbody tr').length";

/// Clicks a pixel of the first picture.
fn click_pixel(tab: &mut Tab, x: u32, y: u32) {
    let at = [(f64::from(x) + 0.5) / 32.0, (f64::from(y) + 0.5) / 24.0];
    tab.drag(".stage", at, at);
}

fn no_faults(tab: &mut Tab, name: &str) {
    for (width, scheme) in [(1280, "light"), (1280, "dark"), (390, "dark"), (390, "light")] {
        tab.resize(width, scheme);
        assert_eq!(tab.faults(), [""; 0], "{width} {scheme}");
        tab.shoot(&format!("{name}-{width}-{scheme}"));
    }
    tab.resize(1280, "light");
}

#[test]
fn a_click_tells_why_a_pixel_has_its_colour() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "light");
    tab.until(IS_LOADED);
    click_pixel(&mut tab, 3, 0);
    // The server is at work, which the page says.
    tab.until("document.querySelector('.why [role=status]')?.innerText.includes('Following the pixel: building')");
    tab.until(&format!("{STEPS} === 3"));
    let text = tab.text(".why");
    for words in [
        "The pixel is as in the golden image.",
        "triangle 4: 000005185afa, visible",
        "triangle 7: nothing (golden: 000009000000)",
        "The first difference is in pair (rtl/src/pair.rs): merging unit 0 passes the nearer pixel.",
    ] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    // The hardware's values stand beside the model's, and the first difference is marked, once.
    let cells = "[...document.querySelectorAll('.steps tbody tr')].map(row => [...row.cells].slice(2).map(it => it.innerText.split('\\n')))";
    let rows = json!([
        [["word"], ["000005185afa"], ["000005185afa"]],
        [["left", "nearer"], ["5", "9"], ["–", "5"]],
        [["word"], ["9"], ["5"]],
    ]);
    assert_eq!(tab.value(cells), rows);
    let marks = "[...document.querySelectorAll('.steps .mark')].map(it => it.closest('tr').dataset.step)";
    assert_eq!(tab.value(marks), json!(["1"]));
    assert_eq!(tab.value("document.querySelectorAll('.steps tr.differs').length"), 2);
    // A step's clock leads to that time of the frame, and the button keeps the focus.
    tab.click(".steps tr:nth-child(2) .jump");
    assert_eq!(tab.text("#now"), "clock 1,003 of 1,200, 25.075 µs");
    assert_eq!(tab.value("document.activeElement.className"), "jump");
    no_faults(&mut tab, "why");
}

#[test]
fn a_pixel_is_chosen_and_asked_about_by_keys() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "dark");
    tab.until(IS_LOADED);
    tab.value("document.querySelector('.stage').focus()");
    // It begins in the middle.
    for key in ["ArrowRight", "ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown", "ArrowDown"] {
        tab.press(key);
    }
    assert_eq!(tab.text("#pixel-title"), "The pixel in column 16, row 13");
    assert_eq!(tab.value(STEPS), 0);
    tab.press("Enter");
    tab.until(&format!("{STEPS} === 3"));
    // With the focus elsewhere the arrows move the time.
    tab.press("Escape");
    assert_eq!(tab.text("#pixel-title"), "A pixel");
    tab.press("ArrowLeft");
    assert_eq!(tab.text("#now"), "clock 1,007 of 1,200, 25.175 µs");
}

#[test]
fn a_second_click_stops_and_another_pixel_supersedes() {
    let Some(mut tab) = tab() else { return };
    let columns = Columns::default();
    let asked = columns.asked.clone();
    let served = Served::new(columns);
    let times = |question: &str| asked.lock().unwrap().iter().filter(|it| *it == question).count();
    tab.open(&served.address, 1280, "light");
    tab.until(IS_LOADED);
    click_pixel(&mut tab, 30, 2);
    tab.until("document.querySelector('.why progress')?.value === 0.5");
    click_pixel(&mut tab, 30, 2);
    tab.until("document.querySelector('.why .ask') !== null");
    // The server is told, and asked no more.
    tab.value("new Promise(done => setTimeout(done, 400))");
    let (before, stopped) = (times("way/one?turn=0&x=30&y=2"), times("way/one?turn=0&x=30&y=2&stop"));
    assert_eq!(stopped, 1);
    tab.value("new Promise(done => setTimeout(done, 400))");
    assert_eq!(times("way/one?turn=0&x=30&y=2"), before);

    tab.click(".why .ask");
    tab.until("document.querySelector('.why progress')?.value === 0.5");
    click_pixel(&mut tab, 3, 0);
    tab.until(&format!("{STEPS} === 3"));
    assert_eq!(times("way/one?turn=0&x=30&y=2&stop"), 2);
    // A failure is a sentence, and can be tried again.
    click_pixel(&mut tab, 29, 0);
    tab.until("document.querySelector('.why [role=alert]') !== null");
    assert_eq!(tab.text(".why [role=alert]"), "the run was interrupted");
    assert_eq!(tab.value("document.querySelector('.why .ask') !== null"), true);
}

#[test]
fn a_step_opens_its_block_at_that_clock() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "light");
    tab.until(IS_LOADED);
    click_pixel(&mut tab, 3, 0);
    tab.until(&format!("{STEPS} === 3"));
    tab.click(".steps tr:nth-child(2) .look");
    tab.until("moment.circuit?.data?.name === 'pair'");
    assert_eq!(tab.text("#moment-title"), "merging unit 0, pe 1,003");
    assert_eq!(tab.value("document.activeElement.id"), "moment-title");
    assert_eq!(tab.text("#moment-step"), "The merging unit 0 passes the nearer pixel: left 5, nearer 9 (model: 5).");
    // The clock, the value on the diagram, the net in the wave, and its source line.
    assert_eq!(tab.value("[moment.circuit.step, moment.circuit.clock.value]"), json!([3, "1003"]));
    assert_eq!(tab.value("document.querySelector('#moment .of-net').textContent"), "20");
    assert_eq!(tab.value("document.querySelector('#moment g.asked title').textContent"), "sum = 20");
    assert_eq!(tab.value("document.querySelector('#moment .wave .name.asked').firstChild.textContent"), "sum");
    assert!(tab.text("#moment .nets tr.asked").contains("src/pair.rs:12"));
    // Its keys are its own: the frame's time stays.
    let frame = tab.text("#now");
    tab.value("document.querySelector('#moment .wave').focus()");
    tab.press("ArrowLeft");
    assert_eq!((tab.value("moment.circuit.clock.value"), tab.text("#now")), (json!("1002"), frame));
    no_faults(&mut tab, "moment");

    // A unit inside, and back.
    tab.click("#moment g:nth-of-type(3)");
    tab.until("moment.circuit.data.name === 'u_half[0]'");
    tab.click("#moment .trail button");
    tab.until("moment.circuit.data.name === 'pair'");
    // One without a wave says why.
    tab.click(".steps tr:nth-child(1) .look");
    tab.until("moment.circuit?.data?.times.length === 1");
    assert_eq!(tab.text("#moment-note"), "No unit is simulated for this step, so there is no wave of it.");
    assert_eq!(tab.value("[moment.circuit.waves.hidden, moment.circuit.deck.hidden]"), json!([true, true]));
    assert_eq!(tab.value("document.querySelector('#moment .of-net').textContent"), "5");
    no_faults(&mut tab, "moment-alone");
    // A failure is a sentence.
    tab.click(".steps tr:nth-child(3) .look");
    tab.until("document.querySelector('#moment [role=alert]') !== null");
    assert_eq!(tab.text("#moment [role=alert]"), "there is no such unit");
    tab.value("document.activeElement.blur()");
    tab.press("Escape");
    assert_eq!(tab.value("[at('moment').hidden, view.pixel !== null]"), json!([true, true]));
}

#[test]
fn areas_are_laid_over_the_picture() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "dark");
    tab.until(IS_LOADED);
    let choices = "[...at('grid').options].map(it => it.textContent)";
    assert_eq!(tab.value(choices), json!(["none", "regions of 8x8", "pages"]));
    tab.press("g");
    tab.press("g");
    tab.until("document.querySelector('.laid').innerText === '2 pages.'");
    // The middle of a patch is coloured where it has a page at this time.
    let is_coloured = |x: u32, y: u32| {
        format!(
            "(canvas => canvas.getContext('2d').getImageData({x}.0 * canvas.width / 32, {y}.0 * canvas.height / 24, 1, 1).data[3] > 0)(document.querySelector('.boxes'))"
        )
    };
    let coloured =
        |tab: &mut Tab| [(4, 4), (12, 4), (28, 20), (20, 12)].map(|(x, y)| tab.value(&is_coloured(x, y)) == true);
    assert_eq!(coloured(&mut tab), [true, false, true, false]);
    tab.value("playing.go(400 / 1200)");
    assert_eq!((tab.text(".laid"), coloured(&mut tab)), ("2 pages.".to_owned(), [true, true, false, false]));
    tab.press("Home");
    assert_eq!(tab.text(".laid"), "0 pages.");
    no_faults(&mut tab, "areas");
    tab.press("g");
    assert_eq!(
        tab.value("[document.querySelector('.boxes').hidden, document.querySelector('.laid').hidden]"),
        json!([true, true])
    );
}
