//! The messages of the protocol, as far as they are used.

use serde::{Deserialize, Serialize};

/// The version of the protocol.
pub const VERSION: &str = "0";

/// The events that are understood. `cursor_moved` is not in every Surfer, and some call it `cursor_set`.
pub const EVENTS: [&str; 4] = ["goto_declaration", "add_drivers", "cursor_moved", "cursor_set"];

/// What a viewer is told.
#[derive(Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Told<'a> {
    Greeting { version: &'a str, commands: &'a [&'a str] },
    Command(Command),
}

/// What a viewer is to do.
#[derive(Serialize)]
#[serde(tag = "command", rename_all = "snake_case")]
pub enum Command {
    /// Puts the cursor at a time.
    SetCursor { timestamp: u64 },
    /// Puts a time into the middle of what is shown, with the same zoom.
    SetViewportTo { timestamp: u64 },
}

/// What a viewer says.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Said {
    Greeting {
        version: String,
    },
    Event(Event),
    Error {
        #[serde(default)]
        error: String,
        #[serde(default)]
        message: String,
    },
    /// An answer, or what is not known.
    #[serde(other)]
    Other,
}

/// What the user of a viewer does.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// Moves the cursor.
    #[serde(alias = "cursor_set")]
    CursorMoved { timestamp: u64 },
    /// Asks where a variable is described.
    GotoDeclaration { variable: String, timestamp: Option<u64> },
    /// Asks what drives a variable.
    AddDrivers { variable: String },
    /// Anything else.
    #[serde(other)]
    Other,
}
