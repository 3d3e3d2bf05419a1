//! Which requests are answered.
//!
//! Any page that is open in the browser can send requests to the loopback. A page from elsewhere does not know the token. It is also known
//! by the `Origin` and `Sec-Fetch-Site` that the browser adds. A name that somebody points to the loopback is known by the `Host`.

use crate::token;

/// The parts of a request that decide on it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Request {
    pub method: String,
    /// The path with the query.
    pub url: String,
    pub host: Option<String>,
    pub origin: Option<String>,
    /// `Sec-Fetch-Site`.
    pub site: Option<String>,
}

/// What is asked for behind the token: the name and the query.
pub(crate) type Asked<'a> = (&'a str, &'a str);

/// What is asked for, or the status of a refusal.
pub(crate) fn check<'a>(request: &'a Request, port: u16, secret: &str) -> Result<Asked<'a>, u16> {
    let Request { method, url, host, origin, site } = request;
    let is_own = |host: &str| host == format!("127.0.0.1:{port}") || host == format!("localhost:{port}");
    let is_own_origin = |origin: &str| origin.strip_prefix("http://").is_some_and(is_own);
    if !host.as_deref().is_some_and(is_own) || !origin.as_deref().is_none_or(is_own_origin) {
        return Err(403);
    }
    if !site.as_deref().is_none_or(|site| ["same-origin", "none"].contains(&site)) {
        return Err(403);
    }
    if method != "GET" {
        return Err(405);
    }
    let (path, query) = url.split_once('?').unwrap_or((url, ""));
    let (given, name) = path.strip_prefix('/').and_then(|rest| rest.split_once('/')).ok_or(404_u16)?;
    if token::are_equal(given, secret) { Ok((name, query)) } else { Err(404) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own() -> Request {
        let text = |text: &str| text.to_owned();
        Request {
            method: text("GET"),
            url: text("/secret/a/b.js?c=1"),
            host: Some(text("127.0.0.1:80")),
            ..Request::default()
        }
    }

    #[test]
    fn only_the_own_page_is_answered() {
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(check(&own(), 80, "secret"), Ok(("a/b.js", "c=1")));
        let same = Request { origin: some("http://127.0.0.1:80"), site: some("same-origin"), ..own() };
        assert_eq!(check(&same, 80, "secret"), Ok(("a/b.js", "c=1")));
        let refused = [
            (Request { url: "/".to_owned(), ..own() }, 404),
            (Request { url: "/secret".to_owned(), ..own() }, 404),
            (Request { url: "/guess1/".to_owned(), ..own() }, 404),
            (Request { method: "POST".to_owned(), ..own() }, 405),
            (Request { host: None, ..own() }, 403),
            (Request { host: some("tilewright.invalid:80"), ..own() }, 403),
            (Request { host: some("127.0.0.1:81"), ..own() }, 403),
            (Request { origin: some("https://tilewright.invalid"), ..own() }, 403),
            (Request { origin: some("null"), ..own() }, 403),
            (Request { site: some("cross-site"), ..own() }, 403),
        ];
        for (request, status) in refused {
            assert_eq!(check(&request, 80, "secret"), Err(status), "{request:?}");
        }
    }
}
