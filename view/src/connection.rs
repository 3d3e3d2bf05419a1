//! A connection: one request and its answer.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::Duration;

use crate::guard::Request;

/// The most bytes and fields of a request's head.
const MOST_BYTES: usize = 16 << 10;
const MOST_FIELDS: usize = 64;

/// The time that a browser may take to send a request, and to read an answer.
const PATIENCE: Duration = Duration::from_secs(10);
/// The time and the bytes that are read after an answer, so that the system does not reset the connection before it is read.
const REST: (Duration, u64) = (Duration::from_millis(500), 1 << 16);

/// What every answer tells the browser: nothing from elsewhere is loaded, and nobody else shows or keeps it.
const HEAD: &str = "\
Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
X-Content-Type-Options: nosniff\r\n\
Referrer-Policy: no-referrer\r\n\
Cross-Origin-Resource-Policy: same-origin\r\n\
Cross-Origin-Opener-Policy: same-origin\r\n\
Cache-Control: no-store\r\n\
Connection: close\r\n";

/// An answer.
pub(crate) struct Response {
    pub status: u16,
    /// The type of the content.
    pub kind: &'static str,
    pub bytes: Vec<u8>,
}

/// Reads a request, and sends the answer to it.
///
/// # Errors
/// The browser went away, or takes too long.
pub(crate) fn serve(mut stream: TcpStream, answer: impl FnOnce(Result<Request, u16>) -> Response) -> io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let Response { status, kind, bytes } = answer(request(&mut stream)?);
    let allow = if status == 405 { "Allow: GET\r\n" } else { "" };
    let (words, length) = (words(status), bytes.len());
    let head =
        format!("HTTP/1.1 {status} {words}\r\n{HEAD}{allow}Content-Type: {kind}\r\nContent-Length: {length}\r\n\r\n");
    stream.write_all(head.as_bytes())?;
    stream.write_all(&bytes)?;
    stream.shutdown(Shutdown::Write)?;
    stream.set_read_timeout(Some(REST.0))?;
    io::copy(&mut stream.take(REST.1), &mut io::sink()).map(|_| ())
}

fn words(status: u16) -> &'static str {
    match status {
        200 => "OK",
        202 => "Accepted",
        400 => "Bad Request",
        403 => "Forbidden",
        405 => "Method Not Allowed",
        422 => "Unprocessable Content",
        431 => "Request Header Fields Too Large",
        _ => "Not Found",
    }
}

/// The request of a connection, or the status of its refusal.
fn request(stream: &mut TcpStream) -> io::Result<Result<Request, u16>> {
    let mut head = Vec::new();
    let mut part = [0; 2048];
    loop {
        match stream.read(&mut part)? {
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            length => head.extend(&part[..length]),
        }
        match parsed(&head) {
            Some(result) => return Ok(result),
            None if head.len() > MOST_BYTES => return Ok(Err(431)),
            None => {}
        }
    }
}

/// The request, if all of its head is there.
fn parsed(head: &[u8]) -> Option<Result<Request, u16>> {
    let mut fields = [httparse::EMPTY_HEADER; MOST_FIELDS];
    let mut request = httparse::Request::new(&mut fields);
    match request.parse(head) {
        Ok(httparse::Status::Partial) => return None,
        Ok(httparse::Status::Complete(_)) => {}
        Err(httparse::Error::TooManyHeaders) => return Some(Err(431)),
        Err(_) => return Some(Err(400)),
    }
    let all = |name: &str| {
        let of_name = request.headers.iter().filter(|field| field.name.eq_ignore_ascii_case(name));
        of_name.map(|field| String::from_utf8_lossy(field.value).into_owned()).collect::<Vec<_>>()
    };
    // Of two values it is not known which one counts.
    let one = |name: &str| match &mut all(name)[..] {
        [] => Ok(None),
        [one] => Ok(Some(std::mem::take(one))),
        _ => Err(400_u16),
    };
    let request = || {
        Ok(Request {
            method: request.method.unwrap_or_default().to_owned(),
            url: request.path.unwrap_or_default().to_owned(),
            host: one("Host")?,
            origin: one("Origin")?,
            site: one("Sec-Fetch-Site")?,
        })
    };
    Some(request())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_read_whole() {
        let head = "GET /a?b HTTP/1.1\r\nHost: here\r\nSEC-FETCH-SITE: none\r\n\r\n";
        for length in 0..head.len() {
            assert!(parsed(&head.as_bytes()[..length]).is_none(), "{length}");
        }
        let request = parsed(head.as_bytes()).expect("it is whole").expect("it is a request");
        assert_eq!((request.method.as_str(), request.url.as_str()), ("GET", "/a?b"));
        assert_eq!(
            (request.host.as_deref(), request.origin, request.site.as_deref()),
            (Some("here"), None, Some("none"))
        );
    }

    #[test]
    fn what_is_no_request_is_refused() {
        let fields: String = (0..=MOST_FIELDS).map(|number| format!("X-{number}: 1\r\n")).collect();
        for (head, status) in [
            ("hello\r\n\r\n".to_owned(), 400),
            ("GET / HTTP/1.1\r\nHost: one\r\nHost: two\r\n\r\n".to_owned(), 400),
            (format!("GET / HTTP/1.1\r\n{fields}\r\n"), 431),
        ] {
            assert_eq!(parsed(head.as_bytes()).expect("it is whole").err(), Some(status), "{head}");
        }
    }
}
