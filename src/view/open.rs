//! Opens an address in the user's browser.

use crate::shell::terminal;
use std::process::{Command, Stdio};

/// The program that opens an address.
const OPENER: &str = if cfg!(target_os = "macos") {
    "open"
} else if cfg!(windows) {
    "explorer"
} else {
    "xdg-open"
};

/// Opens the address. If that fails, the user is told, and can open it by hand.
pub fn open(address: &str) {
    let mut command = Command::new(OPENER);
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Err(error) = command.spawn() {
        terminal::warn(&format!("{OPENER} cannot be run ({error}): open the address by hand"));
    }
}
