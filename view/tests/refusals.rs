//! What the server answers, and what it refuses, seen by a plain connection.

use crate::sample::{Columns, Served};
use std::io::{ErrorKind, Read, Write};
use std::net::TcpStream;
use tilewright_view::Server;

/// The answer to a request: its status, and all of its text.
fn ask(host: &str, request: &str) -> (u16, String) {
    let mut stream = TcpStream::connect(host).unwrap();
    stream.write_all(request.replace('\n', "\r\n").as_bytes()).unwrap();
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).unwrap();
    let text = String::from_utf8_lossy(&bytes).into_owned();
    (text.split(' ').nth(1).and_then(|it| it.parse().ok()).unwrap_or_else(|| panic!("{text}")), text)
}

#[test]
fn the_own_page_is_answered_and_nobody_else() {
    let served = Served::new(Columns::default());
    let (host, path) = served.parts();
    let port = host.split(':').nth(1).unwrap();
    let of = |method: &str, path: &str, host_name: &str, more: &str| {
        ask(host, &format!("{method} {path} HTTP/1.1\nHost: {host_name}\nConnection: close\n{more}\n")).0
    };
    let data = format!("{path}data/frame/one");
    for (name, status) in
        [("", 200), ("index.html", 200), ("style.css", 200), ("about.js", 200), ("../about.js", 404), ("block.js", 404)]
    {
        assert_eq!(of("GET", &format!("{path}{name}"), host, ""), status, "{name}");
    }
    assert_eq!(of("GET", &data, host, "Sec-Fetch-Site: same-origin\n"), 200);
    assert_eq!(of("GET", &format!("{path}data/frame/broken"), host, ""), 422);
    assert_eq!(of("GET", &format!("{path}data/frame/none"), host, ""), 404);
    assert_eq!(of("GET", &data, &format!("localhost:{port}"), ""), 200);
    for (path, status) in [("/", 404), ("/index.html", 404), ("/0123456789abcdef0123456789abcdef/", 404)] {
        assert_eq!(of("GET", path, host, ""), status, "{path}");
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "HEAD"] {
        assert_eq!(of(method, &data, host, ""), 405, "{method}");
    }
    assert_eq!(of("GET", &data, &format!("tilewright.invalid:{port}"), ""), 403);
    assert_eq!(of("GET", &data, host, "Origin: http://tilewright.invalid\n"), 403);
    assert_eq!(of("GET", &data, host, "Sec-Fetch-Site: cross-site\n"), 403);
}

#[test]
fn an_answer_is_for_its_page_alone() {
    let served = Served::new(Columns::default());
    let (host, path) = served.parts();
    let (_, text) = ask(host, &format!("GET {path} HTTP/1.1\nHost: {host}\nConnection: close\n\n"));
    for header in [
        "Content-Security-Policy: default-src 'none'; script-src 'self';",
        "frame-ancestors 'none'",
        "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer",
        "Cross-Origin-Resource-Policy: same-origin",
        "Cache-Control: no-store",
        "Content-Type: text/html; charset=utf-8",
    ] {
        assert!(text.contains(header), "{header} is missing in\n{text}");
    }
    assert!(!text.contains("Access-Control"), "{text}");
}

#[test]
fn two_servers_have_ports_and_tokens_of_their_own() {
    let [one, other] = [Served::new(Columns::default()), Served::new(Columns::default())];
    assert_ne!(one.parts().0, other.parts().0);
    assert_ne!(one.parts().1, other.parts().1);
    let port = one.parts().0.split(':').nth(1).unwrap().parse().unwrap();
    let refused = Server::bind(Some(port)).err().expect("the port is in use");
    assert_eq!(refused.kind(), ErrorKind::AddrInUse);
}

#[test]
fn a_server_that_ended_answers_nobody() {
    let served = Served::new(Columns::default());
    let host = served.parts().0.to_owned();
    assert!(TcpStream::connect(&host).is_ok());
    drop(served);
    assert!(TcpStream::connect(&host).is_err(), "{host} still answers");
}
