//! Opens a page in headless Chromium and lists its problems, for tests of this crate and of programs that make pages.

use serde::Deserialize;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The widths at which a page is checked, in CSS pixels: of a telephone, and of a desktop screen.
///
/// ```
/// use tilewright_report::browser::WIDTHS;
///
/// assert!(WIDTHS.iter().any(|width| *width < 500), "a page is also checked as on a telephone");
/// ```
pub const WIDTHS: [u32; 2] = [390, 1280];

/// Names of the browser; that of its Debian package comes first.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The most time that the browser may take.
const PATIENCE: Duration = Duration::from_secs(120);

/// All problems of a page, a sentence for each, at each of [`WIDTHS`], in a light and in a dark scheme. Problems are messages on the
/// browser's console, a page wider than the window, and pictures that are not loaded. So are resources from elsewhere, and a background
/// that does not follow the scheme.
///
/// Without Chromium it prints `skipped: chromium is not installed` and returns `None`.
///
/// # Panics
/// The environment variable `CI` is set and there is no Chromium, so that no pipeline skips the check; or Chromium cannot be run.
///
/// ```
/// use tilewright_report::{Page, Provenance, browser};
///
/// let page = Page::new("Nothing yet", Provenance::new("tilewright", "0.1.0", "tilewright list")).files().unwrap().remove(0);
/// if let Some(complaints) = browser::complaints(&page.bytes) {
///     assert_eq!(complaints, [""; 0]);
/// }
/// ```
pub fn complaints(html: &[u8]) -> Option<Vec<String>> {
    let Some(browser) = BROWSERS.iter().find_map(|name| on_search_path(name)) else {
        let name = BROWSERS[0];
        assert!(std::env::var_os("CI").is_none(), "{name} is not installed, and CI is set: install it, or unset CI");
        // Not with `eprintln!`, whose output a passing test hides.
        let _ = writeln!(std::io::stderr(), "skipped: {name} is not installed");
        return None;
    };
    let looked = SCHEMES.iter().flat_map(|scheme| look(&browser, html, *scheme));
    Some(looked.collect())
}

fn on_search_path(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
}

/// The name of a scheme, and Chromium's number for it.
type Scheme = (&'static str, u32);
const SCHEMES: [Scheme; 2] = [("dark", 0), ("light", 1)];

/// The measurements of `browser.js` in a window.
#[derive(Deserialize)]
struct Seen {
    width: u32,
    scroll_width: u32,
    /// Whether there is anything on the page.
    is_empty: bool,
    pictures_missing: u32,
    /// Addresses from which the page loads something.
    loads: Vec<String>,
    prefers_dark: bool,
    /// The background's brightness, 0 to 1.
    brightness: f64,
}

/// Opens the page in frames of each width, inside a page that measures them.
fn look(browser: &Path, html: &[u8], (scheme, number): Scheme) -> Vec<String> {
    let folder = tempfile::Builder::new().prefix("tilewright-").tempdir().expect("a temporary folder can be made");
    let place = |name: &str| folder.path().join(name);
    fs::write(place("probe.html"), probe(&String::from_utf8_lossy(html))).expect("a temporary file can be written");
    let [output, messages] = ["output", "messages"]
        .map(|name| (place(name), File::create(place(name)).expect("a temporary file can be made")));
    let mut command = Command::new(browser);
    // As root the browser has no sandbox. It opens only our own page, without a network.
    command.args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync"]);
    command.args(["--disable-background-networking", "--disable-component-update", "--disable-dev-shm-usage"]);
    command.arg("--host-resolver-rules=MAP * ~NOTFOUND");
    command.args(["--enable-logging=stderr", "--v=0", "--window-size=1400,900", "--dump-dom"]);
    command.arg(format!("--blink-settings=preferredColorScheme={number}"));
    command.arg(joined("--user-data-dir=", &place("profile"))).arg(joined("file://", &place("probe.html")));
    command.stdin(Stdio::null()).stdout(output.1).stderr(messages.1);
    run(command);
    let read = |path: &Path| String::from_utf8_lossy(&fs::read(path).unwrap_or_default()).into_owned();
    let (output, messages) = (read(&output.0), read(&messages.0));
    let Some(seen) = measured(&output) else {
        return vec![format!("in the {scheme} the browser did not open the page; it says:\n{messages}")];
    };
    // A line is `[process:thread:time:INFO:CONSOLE:line] "text", source: address (line)`.
    let console = messages
        .lines()
        .filter(|line| line.contains(":CONSOLE"))
        .map(|line| format!("in the {scheme} the console says: {line}"));
    console.chain(seen.iter().flat_map(|seen| wrong(seen, scheme))).collect()
}

fn joined(option: &str, path: &Path) -> std::ffi::OsString {
    [OsStr::new(option), path.as_os_str()].into_iter().collect()
}

/// A page that shows another in frames, and measures them.
fn probe(html: &str) -> String {
    let page = html.replace('&', "&amp;").replace('"', "&quot;");
    let frame =
        |width| format!("<iframe width=\"{width}\" height=\"844\" style=\"border:0\" srcdoc=\"{page}\"></iframe>\n");
    let frames: String = WIDTHS.map(frame).concat();
    format!(
        "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n{frames}<pre></pre>\n<script>{}</script>\n",
        include_str!("browser.js")
    )
}

/// The numbers that the probe left in its page.
fn measured(output: &str) -> Option<Vec<Seen>> {
    let text = output.rsplit_once("<pre>")?.1.split_once("</pre>")?.0;
    serde_json::from_str(text).ok()
}

fn wrong(seen: &Seen, scheme: &str) -> Vec<String> {
    let Seen { width, scroll_width, pictures_missing, .. } = seen;
    let is_dark = scheme == "dark";
    let found = [
        (seen.is_empty, "there is nothing on the page".to_owned()),
        (scroll_width > width, format!("the page is {scroll_width} pixels wide")),
        (*pictures_missing > 0, format!("{pictures_missing} pictures are not loaded")),
        (!seen.loads.is_empty(), format!("the page loads {}", seen.loads.join(", "))),
        (seen.prefers_dark != is_dark, format!("the browser does not prefer {scheme}")),
        (seen.brightness < 0.5 && !is_dark, "the page is dark".to_owned()),
        (seen.brightness > 0.5 && is_dark, "the page is light".to_owned()),
    ];
    found
        .into_iter()
        .filter(|(is_so, _)| *is_so)
        .map(|(_, text)| format!("at {width} pixels, {scheme}: {text}"))
        .collect()
}

/// Runs the browser to its end, or kills it after too much time.
fn run(mut command: Command) {
    let mut browser =
        command.spawn().unwrap_or_else(|error| panic!("{} cannot be run: {error}", command.get_program().display()));
    let start = Instant::now();
    while browser.try_wait().is_ok_and(|status| status.is_none()) {
        if start.elapsed() > PATIENCE {
            browser.kill().expect("a process of ours can be ended");
            browser.wait().expect("a process of ours has an end");
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}
