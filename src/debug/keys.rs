//! The keys. Those of the page of `view` are here with the same meaning: `view/page/block.js` has its list.

use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// What a key does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    Step(i64),
    First,
    Last,
    Select(i64),
    Page(i64),
    Find,
    Run,
    RunBack,
    Why,
    Enter,
    Help,
    Leave,
    Quit,
    Interrupt,
}

/// Keys with one meaning.
pub struct Key {
    codes: &'static [(KeyModifiers, KeyCode)],
    /// Their names, as the help shows them.
    pub names: &'static str,
    /// What they do, in words.
    pub what: &'static str,
    action: Action,
}

const PLAIN: KeyModifiers = KeyModifiers::NONE;
const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
const CONTROL: KeyModifiers = KeyModifiers::CONTROL;

/// All keys, as the help lists them. Ctrl-C reaches the program as a key, because it reads each key at once.
pub const KEYS: [Key; 19] = [
    key("→ l", "a clock forward", Action::Step(1), &[(PLAIN, KeyCode::Right), (PLAIN, KeyCode::Char('l'))]),
    key("← h", "a clock back", Action::Step(-1), &[(PLAIN, KeyCode::Left), (PLAIN, KeyCode::Char('h'))]),
    key("Shift →", "ten clocks forward", Action::Step(10), &[(SHIFT, KeyCode::Right)]),
    key("Shift ←", "ten clocks back", Action::Step(-10), &[(SHIFT, KeyCode::Left)]),
    key("Home", "to the beginning", Action::First, &[(PLAIN, KeyCode::Home)]),
    key("End", "to the end", Action::Last, &[(PLAIN, KeyCode::End)]),
    key("↓ j", "next net, or next cause", Action::Select(1), &[(PLAIN, KeyCode::Down), (PLAIN, KeyCode::Char('j'))]),
    key(
        "↑ k",
        "previous net, or previous cause",
        Action::Select(-1),
        &[(PLAIN, KeyCode::Up), (PLAIN, KeyCode::Char('k'))],
    ),
    key("PgDn PgUp", "a page of nets down or up", Action::Page(1), &[(PLAIN, KeyCode::PageDown)]),
    key("", "", Action::Page(-1), &[(PLAIN, KeyCode::PageUp)]),
    key("/", "search a net: list those with a part of a name", Action::Find, &[(PLAIN, KeyCode::Char('/'))]),
    key("Esc", "leave the causes or the help, or list all nets", Action::Leave, &[(PLAIN, KeyCode::Esc)]),
    key("r", "run to a condition, such as used == 3", Action::Run, &[(PLAIN, KeyCode::Char('r'))]),
    key("R", "run back to a condition", Action::RunBack, &[(PLAIN, KeyCode::Char('R'))]),
    key("w", "why the net has its value: its causes", Action::Why, &[(PLAIN, KeyCode::Char('w'))]),
    key("Enter", "go to the net and the cycle of a cause", Action::Enter, &[(PLAIN, KeyCode::Enter)]),
    key("?", "these keys", Action::Help, &[(PLAIN, KeyCode::Char('?'))]),
    key("q", "quit", Action::Quit, &[(PLAIN, KeyCode::Char('q'))]),
    key("Ctrl-C", "quit at once, with exit code 130", Action::Interrupt, &[(CONTROL, KeyCode::Char('c'))]),
];

const fn key(
    names: &'static str,
    what: &'static str,
    action: Action,
    codes: &'static [(KeyModifiers, KeyCode)],
) -> Key {
    Key { codes, names, what, action }
}

/// What a key does, if anything.
pub fn action(event: KeyEvent) -> Option<Action> {
    // A terminal may or may not tell that Shift made a letter large.
    let modifiers = if let KeyCode::Char(_) = event.code { event.modifiers - SHIFT } else { event.modifiers };
    let is_it = |key: &&Key| key.codes.contains(&(modifiers, event.code));
    KEYS.iter().find(is_it).map(|key| key.action)
}
