//! Chromium without a window, driven by its remote debugging protocol through a pair of pipes.

use serde_json::{Value, json};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Names of the browser; that of its Debian package comes first.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The most time for an answer.
const PATIENCE: Duration = Duration::from_secs(60);

/// A page in a browser, which is ended when dropped.
pub struct Tab {
    process: Child,
    to: File,
    from: Receiver<Value>,
    session: Option<String>,
    number: u64,
    /// What the page's console and the browser complained of.
    pub complaints: Vec<String>,
    _folder: TempDir,
}

/// A browser's page; `None` if there is no browser, which is then said.
pub fn tab() -> Option<Tab> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let is_there = |name: &&str| std::env::split_paths(&path).any(|folder| folder.join(name).is_file());
    let Some(browser) = BROWSERS.into_iter().find(is_there) else {
        let name = BROWSERS[0];
        assert!(std::env::var_os("CI").is_none(), "{name} is not installed, and CI is set: install it, or unset CI");
        // Not with `eprintln!`, whose output a passing test hides.
        let _ = writeln!(std::io::stderr(), "skipped: {name} is not installed");
        return None;
    };
    Some(Tab::of(browser))
}

impl Tab {
    fn of(browser: &str) -> Tab {
        let folder = tempfile::Builder::new().prefix("tilewright-").tempdir().unwrap();
        let [input, output] = ["in", "out"].map(|name| folder.path().join(name));
        assert!(Command::new("mkfifo").args([&input, &output]).status().unwrap().success());
        // The protocol is spoken through the descriptors 3 and 4, which a shell opens.
        let mut command = Command::new("sh");
        command.args(["-c", r#"in=$1 out=$2; shift 2; exec "$@" 3<"$in" 4>"$out""#, "sh"]).args([&input, &output]);
        // As root the browser has no sandbox. It opens only our own pages, without a network beyond the loopback.
        command.args([browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]);
        command.args(["--disable-sync", "--disable-background-networking", "--disable-component-update"]);
        command.args(["--disable-dev-shm-usage", "--remote-debugging-pipe"]);
        command.arg("--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1");
        command.arg(format!("--user-data-dir={}", folder.path().join("profile").display()));
        let process = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let to = OpenOptions::new().write(true).open(input).unwrap();
        let mut from = BufReader::new(File::open(output).unwrap());
        let (send, receive) = channel();
        thread::spawn(move || {
            let mut message = Vec::new();
            while from.read_until(0, &mut message).is_ok_and(|length| length > 0) {
                message.pop();
                if send.send(serde_json::from_slice(&message).unwrap()).is_err() {
                    break;
                }
                message.clear();
            }
        });
        let mut tab =
            Tab { process, to, from: receive, session: None, number: 0, complaints: Vec::new(), _folder: folder };
        let target = tab.call("Target.createTarget", json!({ "url": "about:blank" }))["targetId"].clone();
        let attached = tab.call("Target.attachToTarget", json!({ "targetId": target, "flatten": true }));
        tab.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log"] {
            tab.call(&format!("{domain}.enable"), json!({}));
        }
        tab
    }

    /// Calls a method of the protocol, and returns its result.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.number += 1;
        let mut message = json!({ "id": self.number, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.to.write_all(format!("{message}\0").as_bytes()).unwrap();
        loop {
            let answer = self.from.recv_timeout(PATIENCE).unwrap_or_else(|_| panic!("{method} has no answer"));
            if answer["id"] == self.number {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.note(&answer);
        }
    }

    fn note(&mut self, event: &Value) {
        let of = &event["params"];
        match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => self.complaints.push(of["exceptionDetails"].to_string()),
            Some("Log.entryAdded") => self.complaints.push(of["entry"]["text"].to_string()),
            Some("Runtime.consoleAPICalled") => self.complaints.push(of["args"].to_string()),
            _ => {}
        }
    }

    /// Opens an address in a window of that width, in a `light` or `dark` scheme.
    pub fn open(&mut self, address: &str, width: u32, scheme: &str) {
        self.resize(width, scheme);
        self.call("Page.navigate", json!({ "url": address }));
        self.until("document.readyState === 'complete'");
    }

    /// Another width and scheme.
    pub fn resize(&mut self, width: u32, scheme: &str) {
        let metrics = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        self.call("Emulation.setEmulatedMedia", json!({ "features": features }));
        // The page lays itself out anew before its next frame: a click meanwhile may be on what it takes away.
        self.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    }

    /// The value of an expression in the page.
    #[track_caller]
    pub fn value(&mut self, expression: &str) -> Value {
        let asked = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let result = self.call("Runtime.evaluate", asked);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].clone()
    }

    /// The text of an element.
    #[track_caller]
    pub fn text(&mut self, selector: &str) -> String {
        let text = self.value(&format!("document.querySelector({}).innerText", json!(selector)));
        text.as_str().unwrap_or_default().to_owned()
    }

    /// Waits until an expression is true.
    #[track_caller]
    pub fn until(&mut self, expression: &str) {
        let begin = Instant::now();
        while self.value(expression) != json!(true) {
            assert!(begin.elapsed() < PATIENCE, "{expression} does not become true; {:?}", self.complaints);
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Presses a key, such as `ArrowRight` or `g`.
    pub fn press(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            let text = if key.chars().count() == 1 && kind == "keyDown" { key } else { "" };
            self.call("Input.dispatchKeyEvent", json!({ "type": kind, "key": key, "text": text }));
        }
    }

    /// Presses the mouse at a place of an element, from 0 to 1 of its width and height, and lets it go at another.
    pub fn drag(&mut self, selector: &str, from: [f64; 2], to: [f64; 2]) {
        let element = format!("document.querySelector({})", json!(selector));
        self.value(&format!("{element}.scrollIntoView({{ block: 'center' }})"));
        let box_of = self.value(&format!(
            "(({{ x, y, width, height }}) => [x, y, width, height])({element}.getBoundingClientRect())"
        ));
        let [x, y, width, height] = [0, 1, 2, 3].map(|part| box_of[part].as_f64().unwrap());
        let place = |[across, down]: [f64; 2]| (x + across * width, y + down * height);
        for (kind, at) in [("mousePressed", from), ("mouseMoved", to), ("mouseReleased", to)] {
            let (x, y) = place(at);
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// Clicks an element in its middle.
    pub fn click(&mut self, selector: &str) {
        self.drag(selector, [0.5; 2], [0.5; 2]);
    }

    /// What is wrong with the page whatever it shows: its width, its controls, and its colours.
    pub fn faults(&mut self) -> Vec<String> {
        let found = self.value(include_str!("faults.js"));
        let mut faults: Vec<String> = serde_json::from_value(found).unwrap();
        faults.append(&mut self.complaints);
        faults
    }

    /// Writes a picture of the whole page to a folder that the environment variable `TILEWRIGHT_SHOTS` names, if it does, for somebody to look at.
    pub fn shoot(&mut self, name: &str) {
        use base64::Engine as _;
        let Some(folder) = std::env::var_os("TILEWRIGHT_SHOTS").map(PathBuf::from) else { return };
        let shot = self.call("Page.captureScreenshot", json!({ "captureBeyondViewport": true }));
        let bytes = base64::prelude::BASE64_STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
        std::fs::write(folder.join(format!("{name}.png")), bytes).unwrap();
    }
}

impl Drop for Tab {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
