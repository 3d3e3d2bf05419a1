//! A viewer that is played here, with messages as Surfer sends them.

use super::*;
use crate::shell::Exit;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::thread::{self, JoinHandle};
use std::time::Duration;

const GREETING: &str =
    r#"{"type":"greeting","version":"0","commands":["add_variables","set_viewport_to","cursor_set","reload"]}"#;

/// Plays a viewer that answers the greeting with these messages, and gives what it is sent.
fn played(messages: &'static [&'static str]) -> (SocketAddr, JoinHandle<Vec<String>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    let play = move || {
        let (stream, _) = listener.accept().unwrap();
        let mut reader = BufReader::new(stream.try_clone().unwrap());
        let mut got = vec![next(&mut reader).unwrap()];
        for message in messages {
            (&stream).write_all(&[message.as_bytes(), b"\0"].concat()).unwrap();
        }
        got.extend(std::iter::from_fn(|| next(&mut reader)));
        got
    };
    (address, thread::spawn(play))
}

fn next(reader: &mut BufReader<TcpStream>) -> Option<String> {
    let mut message = Vec::new();
    let length = reader.read_until(0, &mut message).ok()?;
    (length > 0 && message.pop() == Some(0)).then(|| String::from_utf8(message).unwrap())
}

/// The next event, which comes soon.
fn event(viewer: &mut Viewer) -> Event {
    for _ in 0..500 {
        if let Some(event) = viewer.event().unwrap() {
            return event;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("no event comes");
}

#[test]
fn a_viewer_is_led_and_tells_what_its_user_does() {
    let (address, peer) = played(&[
        GREETING,
        r#"{"type":"response","command":"ack"}"#,
        r#"{"type":"event","event":"waveforms_loaded","source":"mu.vcd"}"#,
        r#"{"type":"event","event":"goto_declaration","variable":"fifo.used"}"#,
        r#"{"type":"error","error":"set_cursor","arguments":[],"message":"No waveform loaded"}"#,
        r#"{"type":"event","event":"cursor_moved","timestamp":43210}"#,
        r#"{"type":"event","event":"cursor_set","timestamp":5}"#,
        r#"{"type":"event","event":"add_drivers","variable":"fifo.u_cell[0].lane.sum"}"#,
    ]);
    let mut viewer = Viewer::at(address).unwrap();
    viewer.go_to(30_000).unwrap();
    viewer.go_to(30_000).unwrap();
    viewer.is_at(40_000);
    viewer.go_to(40_000).unwrap();
    let variable = |name: &str| name.to_owned();
    assert_eq!(event(&mut viewer), Event::Other);
    assert_eq!(event(&mut viewer), Event::GotoDeclaration { variable: variable("fifo.used"), timestamp: None });
    assert_eq!(event(&mut viewer), Event::CursorMoved { timestamp: 43_210 });
    assert_eq!(event(&mut viewer), Event::CursorMoved { timestamp: 5 });
    assert_eq!(event(&mut viewer), Event::AddDrivers { variable: variable("fifo.u_cell[0].lane.sum") });
    drop(viewer);
    let sent = [
        r#"{"type":"greeting","version":"0","commands":["goto_declaration","add_drivers","cursor_moved","cursor_set"]}"#,
        r#"{"type":"command","command":"set_cursor","timestamp":30000}"#,
        r#"{"type":"command","command":"set_viewport_to","timestamp":30000}"#,
    ];
    assert_eq!(peer.join().unwrap(), sent);
}

#[test]
fn who_is_no_viewer_is_told_from_one() {
    let refused = |messages| {
        let (address, peer) = played(messages);
        let failure = Viewer::at(address).unwrap_err();
        peer.join().unwrap();
        assert_eq!(failure.exit, Exit::NoTool);
        failure.sentence.split_once(" does not answer as a viewer ").unwrap().1.to_owned()
    };
    let remedy = ": give the address of a viewer with WCP";
    const VERSION: &[&str] = &[r#"{"type":"greeting","version":"7","commands":[]}"#];
    const ERROR: &[&str] = &[r#"{"type":"error","error":"greeting","arguments":[],"message":"no"}"#];
    assert_eq!(refused(VERSION), format!("(its protocol is of version 7){remedy}"));
    let other = format!("(it closed the connection, or sent something else){remedy}");
    assert_eq!(refused(&["HTTP/1.1 400 Bad Request"]), other);
    assert_eq!(refused(ERROR), format!("(greeting: no){remedy}"));
}

#[test]
fn a_viewer_that_goes_away_is_noticed() {
    let (address, peer) = played(&[GREETING, "{}"]);
    let mut viewer = Viewer::at(address).unwrap();
    // What is no message ends the conversation.
    let gone = (0..500).any(|_| {
        thread::sleep(Duration::from_millis(10));
        viewer.event().is_err()
    });
    assert!(gone);
    drop(viewer);
    peer.join().unwrap();
}

#[test]
fn an_address_is_a_port_here_or_a_whole_one() {
    assert_eq!(address("5000").unwrap().to_string(), "127.0.0.1:5000");
    assert_eq!(address("127.0.0.1:80").unwrap().to_string(), "127.0.0.1:80");
    for text in ["0", "70000", "there", ""] {
        assert!(address(text).is_err(), "{text}");
    }
}
