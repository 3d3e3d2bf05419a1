//! The server on the loopback.

use std::io::{self, ErrorKind};
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::Duration;

use crate::connection::{self, Response};
use crate::guard::{self, Request};
use crate::{Answer, Site, page, token};

/// The time between two looks for a connection, and whether to stop.
const PAUSE: Duration = Duration::from_millis(5);

/// The most connections at a time. A browser has six, and some that it opens in advance.
const MOST_CONNECTIONS: usize = 64;

/// A server on 127.0.0.1, whose address has a random token. It refuses requests without the token, with another `Host` or `Origin`, and
/// with another method than GET.
///
/// ```
/// use tilewright_view::Server;
///
/// let server = Server::bind(None)?;
/// assert!(server.address().starts_with("http://127.0.0.1:"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub struct Server {
    listener: TcpListener,
    port: u16,
    secret: String,
}

impl Server {
    /// A server on that port, or on a free one.
    ///
    /// ```
    /// use tilewright_view::Server;
    ///
    /// let server = Server::bind(None)?;
    /// let port = server.address().split([':', '/']).nth(4).unwrap().parse().unwrap();
    /// assert!(Server::bind(Some(port)).is_err()); // it is in use
    /// # Ok::<(), std::io::Error>(())
    /// ```
    ///
    /// # Errors
    /// The port is in use ([`ErrorKind::AddrInUse`]) or not allowed; the system has no random numbers.
    pub fn bind(port: Option<u16>) -> io::Result<Server> {
        let secret = token::new()?;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port.unwrap_or(0)))?;
        listener.set_nonblocking(true)?;
        let port = listener.local_addr()?.port();
        Ok(Server { listener, port, secret })
    }

    /// The address of the page.
    ///
    /// ```
    /// # use tilewright_view::Server;
    /// // Each server has a secret of its own.
    /// assert_ne!(Server::bind(None)?.address(), Server::bind(None)?.address());
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.secret)
    }

    /// Answers until it is to stop, each request in a thread, so that a slow reader stops nobody.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use tilewright_view::{Server, Site, for_examples::Empty};
    ///
    /// let site: Arc<dyn Site> = Arc::new(Empty);
    /// let mut looks = 0;
    /// Server::bind(None)?.serve(&site, || {
    ///     looks += 1;
    ///     looks > 2
    /// });
    /// assert_eq!(looks, 3);
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn serve(&self, site: &Arc<dyn Site>, mut is_to_stop: impl FnMut() -> bool) {
        let count = Arc::new(AtomicUsize::new(0));
        while !is_to_stop() {
            let stream = match self.listener.accept() {
                Ok((stream, _)) if count.load(Relaxed) < MOST_CONNECTIONS => stream,
                // A connection too many is closed. One that failed is the browser's to repeat.
                Ok(_) => continue,
                Err(error) => {
                    if error.kind() != ErrorKind::Interrupted {
                        thread::sleep(PAUSE);
                    }
                    continue;
                }
            };
            let (site, port, secret, counted) = (site.clone(), self.port, self.secret.clone(), count.clone());
            count.fetch_add(1, Relaxed);
            let begun = thread::Builder::new().spawn(move || {
                // A browser that goes away misses nothing.
                let _ = connection::serve(stream, |request| answer(request, port, &secret, &*site));
                counted.fetch_sub(1, Relaxed);
            });
            if begun.is_err() {
                count.fetch_sub(1, Relaxed);
            }
        }
    }
}

fn answer(request: Result<Request, u16>, port: u16, secret: &str, site: &dyn Site) -> Response {
    let checked = request.as_ref().map_err(|status| *status).and_then(|request| guard::check(request, port, secret));
    match checked {
        Ok((name, query)) => content(name, query, site),
        Err(status) => refusal(status),
    }
}

fn refusal(status: u16) -> Response {
    let text = match status {
        400 => "This is no request.\n",
        403 => "This address is for its own page alone.\n",
        405 => "There is nothing to change here: ask with GET.\n",
        431 => "The request is too long.\n",
        _ => "There is nothing here: open the address that tilewright printed.\n",
    };
    Response { status, kind: "text/plain; charset=utf-8", bytes: text.into() }
}

fn content(name: &str, query: &str, site: &dyn Site) -> Response {
    let name = if name.is_empty() { page::INDEX } else { name };
    if name == page::ABOUT {
        return Response { status: 200, kind: page::SCRIPT, bytes: page::about(&site.about(), false).into() };
    }
    if let Some((_, kind, text)) = page::files(site.page()).find(|(file, ..)| *file == name) {
        return Response { status: 200, kind, bytes: text.into() };
    }
    let json = |status, bytes| Response { status, kind: "application/json", bytes };
    let said = |status, value: serde_json::Value| json(status, value.to_string().into_bytes());
    match name.strip_prefix(page::DATA).map(|name| site.data(name, query)) {
        Some(Answer::Whole(bytes)) => json(200, bytes),
        Some(Answer::Working { what, done }) => said(202, serde_json::json!({ "what": what, "done": done })),
        Some(Answer::Refused(sentence)) => said(422, serde_json::json!({ "sentence": sentence })),
        Some(Answer::Unknown) | None => refusal(404),
    }
}
