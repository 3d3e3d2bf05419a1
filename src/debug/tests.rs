//! The page by its keys, without a terminal.

use super::draw::draw;
use super::layout::Layout;
use super::state::{Ended, Mode, State};
use crate::block::{design, entries, simulation};
use crate::moment::play_remembered;
use crate::shell::crash;
use crate::wcp::Event;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tilewright_sim::EngineKind;

/// The queue of eight words, at the end of its scenario.
fn state(block: &str) -> State {
    let entry = entries().find(|entry| entry.name == block).unwrap();
    let values = entry.values([]).unwrap();
    let design = design(entry, &values).unwrap();
    let mut sim = simulation(&design, EngineKind::Interpreter).unwrap();
    assert!(play_remembered(&mut sim, &entry.scenario(&values).unwrap()).unwrap().is_none());
    let now = sim.time();
    State::new(entry.name, super::parameters(&values), &design, sim, now, None)
}

fn press(state: &mut State, code: KeyCode, modifiers: KeyModifiers) {
    state.key(KeyEvent::new(code, modifiers), &mut || false).unwrap();
}

/// Presses keys: letters, and others by name.
fn keys(state: &mut State, keys: &str) {
    for key in keys.split(' ') {
        let code = match key {
            "right" => KeyCode::Right,
            "left" => KeyCode::Left,
            "down" => KeyCode::Down,
            "up" => KeyCode::Up,
            "home" => KeyCode::Home,
            "end" => KeyCode::End,
            "enter" => KeyCode::Enter,
            "escape" => KeyCode::Esc,
            _ => {
                key.chars().for_each(|letter| press(state, KeyCode::Char(letter), KeyModifiers::NONE));
                continue;
            }
        };
        press(state, code, KeyModifiers::NONE);
    }
}

/// Types a condition behind `r` or `R`.
fn run(state: &mut State, key: &str, condition: &str) {
    keys(state, key);
    condition.chars().for_each(|letter| press(state, KeyCode::Char(letter), KeyModifiers::NONE));
    keys(state, "enter");
}

/// The page as text.
fn page(state: &mut State, columns: u16, lines: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(columns, lines)).unwrap();
    let layout = Layout::of(terminal.get_frame().area(), state);
    if let Some(layout) = &layout {
        state.prepare(layout.wave.into(), layout.nets.into()).unwrap();
    }
    terminal.draw(|frame| draw(frame, state, layout.as_ref())).unwrap();
    let buffer = terminal.backend().buffer();
    let line = |y| (0..columns).map(|x| buffer[(x, y)].symbol()).collect::<String>().trim_end().to_owned() + "\n";
    (0..lines).map(line).collect()
}

/// The present value of a net, as the page has it.
fn value(state: &mut State, net: &str) -> String {
    page(state, 100, 60);
    let (column, row) =
        (state.shown.column_of(state.now).unwrap(), state.shown.nets.iter().find(|row| row.name == net));
    row.unwrap_or_else(|| panic!("{net} is not on the page")).values[column].clone()
}

/// The cycle of the first clock, and the selected net.
fn place(state: &State) -> (u64, &str) {
    (state.instants.cycle_at(state.now).unwrap(), state.net().unwrap().name.as_str())
}

#[test]
fn a_page_shows_waves_values_and_source_lines_around_a_clock() {
    let mut it = state("fifo");
    it.nets.iter_mut().for_each(|net| net.source = Some("src/debug/golden/source.txt:3".to_owned()));
    keys(&mut it, "home right right right /use enter escape");
    assert_eq!(page(&mut it, 80, 24), include_str!("golden/page.txt"));
    let (waves, _) = include_str!("golden/page.txt").split_once("──").unwrap();
    assert!(include_str!("../../docs/cli.md").contains(waves), "docs/cli.md shows another page");
}

#[test]
fn keys_step_and_select_within_the_run_and_the_nets() {
    let mut it = state("fifo");
    assert_eq!(place(&it), (13, "into_valid"));
    keys(&mut it, "right l up k");
    assert_eq!(place(&it), (13, "into_valid"));
    keys(&mut it, "left h down j");
    assert_eq!(place(&it), (11, "out_ready"));
    press(&mut it, KeyCode::Left, KeyModifiers::SHIFT);
    press(&mut it, KeyCode::PageDown, KeyModifiers::NONE);
    assert_eq!(place(&it), (1, "has_past"));
    press(&mut it, KeyCode::PageDown, KeyModifiers::NONE);
    press(&mut it, KeyCode::Right, KeyModifiers::SHIFT);
    assert_eq!(place(&it), (11, "has_past"));
    keys(&mut it, "home left end");
    assert_eq!((it.now, it.end), (130_000, None));
    keys(&mut it, "q");
    assert_eq!(it.end, Some(Ended::Quit));
    let mut it = state("fifo");
    press(&mut it, KeyCode::Char('c'), KeyModifiers::CONTROL);
    assert_eq!(it.end, Some(Ended::Interrupted));
}

#[test]
fn a_part_of_a_name_lists_the_nets_that_have_it() {
    let mut it = state("fifo");
    keys(&mut it, "/OUT");
    assert!(page(&mut it, 80, 24).ends_with("/OUT▏ 3 nets\n"));
    keys(&mut it, "enter down");
    assert_eq!(place(&it), (13, "out_valid"));
    assert!(page(&mut it, 80, 24).ends_with("3 of 13 nets, with out: Esc lists all\n"));
    keys(&mut it, "escape");
    assert_eq!((it.listed.len(), place(&it)), (13, (13, "out_valid")));
    keys(&mut it, "/xyz");
    assert!(page(&mut it, 80, 24).contains("no net"));
    keys(&mut it, "enter");
    assert_eq!((it.listed.len(), it.message.as_str()), (13, "there is no net with `xyz` in its name"));
}

#[test]
fn a_run_ends_at_a_condition_forward_and_back() {
    let mut it = state("fifo");
    keys(&mut it, "home");
    run(&mut it, "r", "used == 3");
    assert_eq!((it.now, value(&mut it, "used").as_str()), (40_000, "3"));
    run(&mut it, "r", "");
    assert_eq!(it.now, 50_000);
    run(&mut it, "r", "");
    assert_eq!((it.now, it.message.as_str()), (50_000, "used == 3 is true at no clock after this one"));
    run(&mut it, "R", "used < 2");
    assert_eq!((it.now, value(&mut it, "used").as_str()), (20_000, "1"));
    run(&mut it, "R", "used > 2");
    assert_eq!((it.now, it.message.as_str()), (20_000, "used > 2 is true at no clock before this one"));
    run(&mut it, "r", "usde");
    assert!(it.message.starts_with("there is no net `usde`"));
    // The way back is the same in a longer run, which is looked through part by part.
    let mut it = state("scan-counter");
    let end = it.now;
    run(&mut it, "R", "pixel_x == 5");
    let last = it.now;
    assert!(last < end && value(&mut it, "pixel_x") == "5");
    run(&mut it, "r", "pixel_x == 5");
    assert_eq!(it.now, last);
    keys(&mut it, "home");
    run(&mut it, "r", "pixel_x == 5");
    run(&mut it, "r", "pixel_x != 5");
    run(&mut it, "R", "pixel_x == 5");
    assert!(it.now > 0 && value(&mut it, "pixel_x") == "5");
}

#[test]
fn the_user_stops_a_run() {
    let mut it = state("scan-counter");
    let (key, mut asked) = (|code| KeyEvent::new(code, KeyModifiers::NONE), 0);
    keys(&mut it, "R");
    "pixel_x == 99999".chars().for_each(|letter| press(&mut it, KeyCode::Char(letter), KeyModifiers::NONE));
    let now = it.now;
    it.key(key(KeyCode::Enter), &mut || {
        asked += 1;
        true
    })
    .unwrap();
    assert_eq!((asked, it.now, it.message.as_str()), (1, now, "the run was stopped"));
}

#[test]
fn the_causes_of_a_value_are_walked_to_their_nets_and_cycles() {
    let mut it = state("scan-counter");
    run(&mut it, "R", "pixel_x == 5");
    let now = it.now;
    keys(&mut it, "/pixel_x enter w");
    let text = page(&mut it, 80, 24);
    assert!(text.contains("\n pixel_x = 5  cycle 124\n   from x = 4  cycle 123\n"), "{text}");
    // The register inside is not listed, and then is.
    assert_eq!((it.listed.len(), place(&it)), (1, (124, "pixel_x")));
    keys(&mut it, "down enter");
    assert_eq!((it.listed.len(), it.now, place(&it)), (13, now - 80_000, (123, "x")));
    assert_eq!(value(&mut it, "x"), "4");
    keys(&mut it, "up enter w");
    let Mode::Causes(causes) = &it.mode else { panic!("the causes are left") };
    assert_eq!((place(&it), causes.selected), ((124, "pixel_x"), 0));
    keys(&mut it, "escape");
    assert!(matches!(it.mode, Mode::Waves));
}

#[test]
fn every_page_fits_every_window() {
    for block in ["decoder", "fifo", "patch-table"] {
        let mut it = state(block);
        for modes in ["home", "end", "w", "down", "escape", "?", "escape", "/", "escape", "r"] {
            keys(&mut it, modes);
            for (columns, lines) in [(40, 12), (80, 24), (41, 13), (250, 70), (80, 24)] {
                let text = page(&mut it, columns, lines);
                assert!(text.starts_with(&format!("{block}: ")) && !text.ends_with("\n\n"), "{block} {modes}:\n{text}");
            }
        }
        assert!(page(&mut it, 39, 24).starts_with("the window needs 40 columns and 12 lines\n\n".get(..39).unwrap()));
        assert!(page(&mut it, 80, 5).starts_with("the window needs 40 columns and 12 lines\n"));
    }
}

#[test]
fn what_a_viewer_s_user_does_moves_the_page() {
    let mut it = state("fifo");
    it.follow(&Event::CursorMoved { timestamp: 43_210 }).unwrap();
    assert_eq!(it.now, 40_000);
    it.follow(&Event::CursorMoved { timestamp: 30_000 }).unwrap();
    assert_eq!(it.now, 30_000);
    it.follow(&Event::CursorMoved { timestamp: u64::MAX }).unwrap();
    assert_eq!(it.now, 130_000);
    keys(&mut it, "/out enter");
    let declared = |name: &str, timestamp| Event::GotoDeclaration { variable: name.to_owned(), timestamp };
    it.follow(&declared("fifo.used", Some(25_000))).unwrap();
    assert_eq!((place(&it), it.listed.len()), ((2, "used"), 13));
    it.follow(&declared("fifo.usde", None)).unwrap();
    assert_eq!((place(&it), it.message.as_str()), ((2, "used"), "the viewer's usde is no net of this block"));
    it.follow(&Event::AddDrivers { variable: "fifo.out_valid".to_owned() }).unwrap();
    let Mode::Causes(causes) = &it.mode else { panic!("no causes are told") };
    assert!(causes.lines[0].text.starts_with("out_valid = "), "{causes:?}");
    it.follow(&Event::Other).unwrap();
    assert_eq!(it.now, 20_000);
}

/// Shows a page that panics, as the program would. The test below runs this in a terminal.
#[test]
#[ignore = "it needs a terminal, which another test gives it"]
fn a_page_that_panics() {
    let mut it = state("fifo");
    it.listed = vec![1000];
    let ended = crash::guard(|| super::page::show(&mut it, None).map(|_| crate::shell::Exit::Done));
    std::process::exit(ended.map_or(1, |exit| exit as i32));
}

#[cfg(unix)]
#[test]
fn a_panic_leaves_the_terminal_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let shell = |line: &str| {
        let run =
            std::process::Command::new("sh").args(["-c", line]).env("TERM", "xterm").current_dir(&folder).output();
        let run = run.unwrap();
        (run.status.code(), String::from_utf8_lossy(&run.stdout).into_owned())
    };
    // Without `script` no terminal can be made.
    if shell("script -qec true typescript </dev/null").0 != Some(0) {
        return;
    }
    let program = std::env::current_exe().unwrap();
    let test = format!("{} --ignored --exact --nocapture debug::tests::a_page_that_panics", program.display());
    let inside = format!("stty rows 24 columns 80; stty -g > before; {test}; code=$?; stty -g > after; exit $code");
    let (code, text) = shell(&format!("sleep 1 | script -qec '{inside}' typescript"));
    assert_eq!(code, Some(70), "{text}");
    let settings = ["before", "after"].map(|name| std::fs::read_to_string(folder.path().join(name)).unwrap());
    assert_eq!(settings[0], settings[1]);
    // The sentence comes after the page is left, so that it can be read.
    let (_, after) = text.split_once("\u{1b}[?1049l").unwrap();
    assert!(
        text.contains("\u{1b}[?1049h") && after.contains("error: this is a mistake in tilewright at src/debug/"),
        "{text}"
    );
}
