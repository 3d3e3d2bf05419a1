//! The page of a frame, played in a browser.

use crate::browser::{Tab, tab};
use crate::sample::{Columns, SIZE, Served, picture};
use serde_json::json;
use tilewright_view::{Page, Site, export};

/// Red, green and blue of a pixel of the first picture.
fn colour(tab: &mut Tab, x: u32, y: u32) -> Vec<u64> {
    let pixel = format!(
        "[...document.querySelector('.picture').getContext('2d').getImageData({x}, {y}, 1, 1).data].slice(0, 3)"
    );
    serde_json::from_value(tab.value(&pixel)).unwrap()
}

const IS_LOADED: &str = "view.panels.length > 0 && view.panels.every(({ film }) => film)";

#[test]
fn the_page_plays_a_frame() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "light");
    tab.until(IS_LOADED);
    assert_eq!(tab.text("h1"), "columns, 32x24");
    assert_eq!(tab.text("figcaption"), "one\nidentical to the golden image");

    // The whole picture, the buttons and the time are in the window at once.
    let edges = "['.stage', '.deck', '#now'].map(it => document.querySelector(it).getBoundingClientRect())";
    let fit = "(([stage, deck, now]) => stage.bottom <= deck.top && now.bottom <= innerHeight)";
    assert_eq!(tab.value(&format!("{fit}({edges})")), true);

    // It begins with the finished picture.
    assert_eq!(tab.text("#now"), "clock 1,200 of 1,200, 30.000 µs");
    assert_eq!(colour(&mut tab, 3, 0), [24, 90, 250]);
    assert_eq!(colour(&mut tab, 31, 23), [248, 90, 60]);
    the_time_is_stepped(&mut tab);
    a_pixel_is_told(&mut tab);
    colours_and_overlays_change(&mut tab);
    assert_eq!(tab.faults(), [""; 0]);
}

fn the_time_is_stepped(tab: &mut Tab) {
    tab.press("Home");
    assert_eq!(tab.text("#now"), "clock 0 of 1,200, 0 ns");
    assert_eq!(colour(tab, 3, 0), [20, 24, 40]);
    tab.press("ArrowRight");
    assert_eq!(tab.text("#now"), "clock 10 of 1,200, 250 ns");
    assert_eq!((colour(tab, 0, 0), colour(tab, 1, 0)), (vec![0, 90, 60], vec![20, 24, 40]));
    tab.click("#step");
    assert_eq!(tab.text("#now"), "clock 11 of 1,200, 275 ns");
    tab.click("#back");
    assert_eq!(tab.text("#now"), "clock 10 of 1,200, 250 ns");
    tab.press("ArrowLeft");
    assert_eq!(tab.text("#now"), "clock 0 of 1,200, 0 ns");
    assert_eq!(colour(tab, 0, 0), [20, 24, 40]);
    // A pixel that changes twice has its first colour between both.
    tab.value("at('time').value = 900 / 1200; at('time').dispatchEvent(new Event('input'))");
    assert_eq!(colour(tab, 3, 0), [24, 90, 60]);
    tab.press("ArrowRight");
    tab.press("ArrowRight");
    assert_eq!((colour(tab, 0, 0), colour(tab, 3, 0)), (vec![0, 90, 250], vec![24, 90, 60]));
    assert_eq!(tab.text("#lanes .lane .does"), "nothing");

    tab.press("Home");
    assert_eq!(tab.text("#lanes .lane .does"), "clearing");
    // With the focus on a button, the key is the button's.
    tab.value("document.activeElement.blur(); playing.seconds = 40");
    tab.press(" ");
    assert_eq!(tab.text("#play"), "Pause");
    tab.until("playing.share > 0 && playing.share < 1");
    tab.value("playing.seconds = 0.1");
    tab.until("!playing.isPlaying");
    assert_eq!((tab.text("#play"), colour(tab, 3, 0)), ("Play".to_owned(), vec![24, 90, 250]));
    tab.value("playing.seconds = 10");
    tab.click("#play");
    tab.until("playing.share > 0 && playing.share < 1");
    tab.click("#play");
    let share = tab.value("playing.share");
    assert_eq!(tab.value("new Promise(done => setTimeout(() => done(playing.share), 60))"), share);
    tab.press("End");
}

fn a_pixel_is_told(tab: &mut Tab) {
    tab.drag(".stage", [3.5 / 32.0, 0.5 / 24.0], [3.5 / 32.0, 0.5 / 24.0]);
    assert_eq!(tab.text("#pixel-title"), "The pixel in column 3, row 0");
    let told = "[...document.querySelectorAll('#known .written tbody tr')].map(row => row.innerText.split('\\t').map(it => it.trim()))";
    let rows = json!([["13", "325 ns", "PE 1", "1,003", "#185a3c"], ["1,003", "25.075 µs", "PE 1", "5", "#185afa"],]);
    assert_eq!(tab.value(told), rows);
    assert_eq!(tab.value("document.querySelector('#known tr[aria-current]').rowIndex"), 2);
    tab.click("#known .written tbody button");
    assert_eq!(tab.text("#now"), "clock 13 of 1,200, 325 ns");
    assert_eq!(tab.value("document.querySelector('#known tr[aria-current]').rowIndex"), 1);
    // By its place, as somebody without a mouse does it.
    tab.value("at('x').value = 31; at('y').value = 23");
    tab.click("#place button");
    assert_eq!(tab.text("#pixel-title"), "The pixel in column 31, row 23");
    assert_eq!(tab.value("document.querySelectorAll('#known .written tbody tr').length"), 1);
    tab.value("document.activeElement.blur()");
    tab.press("Escape");
    assert_eq!(tab.text("#pixel-title"), "A pixel");
    tab.press("End");
}

fn colours_and_overlays_change(tab: &mut Tab) {
    tab.press("c");
    assert_eq!(tab.value("at('paint').value"), "units");
    // As light as the frame, in the colour of its unit.
    let [red, _, blue] = colour(tab, 2, 0)[..] else { panic!("three parts") };
    assert!(red > blue, "PE 0 is red");
    let [red, _, blue] = colour(tab, 3, 0)[..] else { panic!("three parts") };
    assert!(red < blue, "PE 1 is blue");
    tab.press("g");
    assert_eq!(tab.value("[at('grid').value, document.querySelector('.grid').hidden]"), json!(["grid", false]));
    tab.press("n");
    tab.press("Home");
    tab.press("ArrowRight");
    let lit = "view.panels[0].painter.fresh";
    assert_eq!(tab.value(lit), json!([0]));
    tab.press("End");
    assert_eq!(tab.value(lit), json!([]));
}

#[test]
fn machines_stand_side_by_side() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "dark");
    tab.until(IS_LOADED);
    tab.press("2");
    tab.until(IS_LOADED);
    assert_eq!(tab.text("figcaption strong"), "two");
    tab.press("a");
    tab.until("view.panels.length === 3 && view.panels.filter(({ film }) => film).length === 2");
    // The third says why it has no picture. That answer is also in the log.
    tab.until("document.querySelectorAll('.stage .bad').length === 1");
    assert_eq!(tab.text(".stage .bad"), "there are spheres");
    let is_inside = "(it => it.getBoundingClientRect().bottom <= it.closest('.stage').getBoundingClientRect().bottom)";
    assert_eq!(tab.value(&format!("{is_inside}(document.querySelector('.stage .bad'))")), true);
    assert_eq!(tab.complaints.len(), 1, "{:?}", tab.complaints);
    tab.complaints.clear();

    // The same time for both: 12 µs are all of the second machine's, and 480 clocks of the first.
    tab.value("playing.go(12 / 30)");
    assert_eq!(tab.text("#now"), "one: clock 480 of 1,200, 12.000 µs · two: clock 1,200 of 1,200, 12.000 µs");
    tab.value("at('pace').value = 'own'; at('pace').dispatchEvent(new Event('change'))");
    assert_eq!(tab.text("#now"), "one: clock 480 of 1,200, 12.000 µs · two: clock 480 of 1,200, 4.800 µs");
    tab.drag(".stage", [0.5; 2], [0.5; 2]);
    assert_eq!(tab.value("document.querySelectorAll('#known .written table').length"), 2);
    for (width, scheme) in [(1280, "dark"), (390, "dark"), (390, "light")] {
        tab.resize(width, scheme);
        assert_eq!(tab.faults(), [""; 0], "{width} {scheme}");
        tab.shoot(&format!("several-{width}-{scheme}"));
    }
}

#[test]
fn the_camera_turns_with_the_mouse() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 1280, "light");
    tab.until(IS_LOADED);
    assert_eq!(colour(&mut tab, 31, 23), [248, 90, 60]);
    tab.drag(".stage", [0.75, 0.5], [0.25, 0.5]);
    tab.until("view.panels[0].painter.film.colour[0] >> 8 === 135");
    assert_eq!((tab.text("#turned"), tab.value("view.turn")), ("90°".to_owned(), json!(90)));
    assert_eq!(colour(&mut tab, 31, 23), [248, 135, 60]);
    // It was no click.
    assert_eq!(tab.text("#pixel-title"), "A pixel");
    tab.value("at('turn').value = -90; at('turn').dispatchEvent(new Event('change'))");
    tab.until("view.panels[0].painter.film.colour[0] >> 8 === 45");
    assert_eq!(tab.faults(), [""; 0]);
}

#[test]
fn a_page_says_that_its_server_has_gone() {
    let Some(mut tab) = tab() else { return };
    let served = Served::new(Columns::default());
    tab.open(&served.address, 390, "light");
    tab.until(IS_LOADED);
    drop(served);
    tab.press("2");
    tab.until("document.querySelector('.stage .bad') !== null");
    assert_eq!(tab.text(".stage .bad"), "the server does not answer: start tilewright view again");
}

/// The files are those of the page on the server, and need none.
#[test]
fn an_exported_page_opens_without_a_server() {
    let about = Columns::default().about().replace("\"orbits\": true", "\"orbits\": false");
    let made = || {
        let data = ["one", "two"].map(|name| (format!("frame/{name}"), picture(name, 0).json()));
        export::files(Page::Frame, &about, data)
    };
    let files = made();
    assert_eq!(files, made());
    let Some(mut tab) = tab() else { return };
    let folder = tempfile::tempdir().unwrap();
    for file in files {
        let path = folder.path().join(file.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, file.bytes).unwrap();
    }
    tab.open(&format!("file://{}", folder.path().join("index.html").display()), 390, "dark");
    tab.until(IS_LOADED);
    assert_eq!(colour(&mut tab, SIZE[0] - 1, SIZE[1] - 1), [248, 90, 60]);
    tab.press("2");
    tab.until(IS_LOADED);
    assert_eq!(tab.text("figcaption strong"), "two");
    assert_eq!(tab.value("at('turn-label').hidden"), true);
    assert_eq!(tab.faults(), [""; 0]);
    tab.press("3");
    tab.until("document.querySelector('.stage .bad') !== null");
    assert_eq!(tab.text(".stage .bad"), "data/frame/broken.js is missing beside this page");
}
