//! `debug` in a terminal. What its keys do is tested beside it, without one.
#![cfg(unix)]

use crate::cli::harness::{Folder, Run};
use crate::cli::terminal::has_terminals;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpListener;
use std::thread;

/// Runs a page in a terminal of 80 x 24 characters with these keys, as `printf` has them; `None` where no terminal can be made.
pub fn on_the_page(folder: &Folder, arguments: &str, keys: &str) -> Option<Run> {
    in_a_terminal(folder, &format!("tilewright debug {arguments}"), keys)
}

/// The same with any command. The exit code is that of the command, which has to leave the terminal's settings as they were.
fn in_a_terminal(folder: &Folder, command: &str, keys: &str) -> Option<Run> {
    if !has_terminals(folder) {
        return None;
    }
    let inside = format!("stty rows 24 columns 80; stty -g > before; {command}; code=$?; stty -g > after; exit $code");
    let run = folder.shell(&format!("(sleep 0.3; printf '{keys}') | TERM=xterm script -qec '{inside}' typescript"));
    assert_eq!(folder.read("before"), folder.read("after"), "{command}: {run:?}");
    Some(run)
}

/// The page is on a screen of its own, which it leaves. Nothing but progress is before it, and nothing but the last words after it.
fn assert_restored(run: &Run, last_words: &str) {
    let [before, rest] = run.stdout.split("\u{1b}[?1049h").collect::<Vec<_>>()[..] else { panic!("{run:?}") };
    let (page, after) = rest.split_once("\u{1b}[?1049l\u{1b}[?25h").unwrap();
    assert!(!before.contains("used") && page.contains("used") && after.trim_end() == last_words, "{run:?}");
}

#[test]
fn a_page_comes_and_goes_and_the_terminal_is_as_before() {
    let folder = Folder::new();
    let Some(run) = on_the_page(&folder, "fifo --at 3 --signal used", "lq") else { return };
    assert_eq!(run.code, Some(0), "{run:?}");
    assert_restored(&run, "");
    assert!(run.stdout.contains("cycle 3 of 13, 30000 ps"), "{run:?}");
    let run = on_the_page(&folder, "fifo", "\\003").unwrap();
    assert_eq!(run.code, Some(130), "{run:?}");
    assert_restored(&run, "");
    // Another program ends it.
    let run = in_a_terminal(&folder, "timeout --foreground --preserve-status 1 tilewright debug fifo", "").unwrap();
    assert_eq!(run.code, Some(143), "{run:?}");
    assert_restored(&run, "error: the page was closed by a signal");
}

#[test]
fn what_there_is_not_is_said_with_a_remedy() {
    let folder = Folder::new();
    let run = folder.run("debug fifo");
    let sentence = "error: debug needs a terminal for its page, and there is none: \
                    run it in one, or use `tilewright why` and `tilewright wave`\n";
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(2), "", sentence));
    for (arguments, sentence) in [
        ("fifo --signal usde", "error: there is no signal `usde`: did you mean `used`?"),
        ("fifo --at 1000", "error: the scenario ends in cycle 13 of `clk`: give --at a number up to 13"),
    ] {
        let Some(run) = on_the_page(&folder, arguments, "q") else { return };
        assert!(run.code == Some(2) && run.stdout.trim_end().ends_with(sentence), "{arguments}: {run:?}");
    }
}

#[test]
fn a_viewer_s_cursor_follows_the_clock() {
    let folder = Folder::new();
    if !has_terminals(&folder) {
        return;
    }
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    // Surfer, by the messages that it sends.
    let surfer = thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let messages = BufReader::new(stream.try_clone().unwrap()).split(0);
        let mut messages = messages.map(|message| String::from_utf8(message.unwrap()).unwrap());
        let greeting = messages.next().unwrap();
        assert!(greeting.starts_with(r#"{"type":"greeting","version":"0","commands":["#), "{greeting}");
        stream.write_all(b"{\"type\":\"greeting\",\"version\":\"0\",\"commands\":[\"cursor_set\"]}\0").unwrap();
        messages.collect::<Vec<String>>()
    });
    let run = on_the_page(&folder, &format!("fifo --at 3 --signal used --wcp {port}"), "lq").unwrap();
    assert_eq!(run.code, Some(0), "{run:?}");
    let command = |name: &str, time: u64| format!(r#"{{"type":"command","command":"{name}","timestamp":{time}}}"#);
    let both = |time| [command("set_cursor", time), command("set_viewport_to", time)];
    assert_eq!(surfer.join().unwrap(), [both(30_000), both(40_000)].concat());
    // Nobody listens there.
    let free = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let run = on_the_page(&folder, &format!("fifo --wcp {free}"), "q").unwrap();
    let words = format!("error: no viewer listens on {free} (");
    let remedy = "): start the viewer's WCP server, in Surfer by the command `wcp_server_start`";
    assert!(run.code == Some(4) && run.stdout.contains(&words) && run.stdout.trim_end().ends_with(remedy), "{run:?}");
    let run = on_the_page(&folder, "fifo --wcp there", "q").unwrap();
    assert!(
        run.code == Some(2) && run.stdout.contains("give a port, or an address such as 127.0.0.1:54321"),
        "{run:?}"
    );
}
