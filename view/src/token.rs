//! The secret part of an address.

use std::fmt::Write as _;
use std::io;

/// Random bytes of a token.
const BYTES: usize = 16;

/// A new token: 32 hexadecimal digits from the system's random numbers.
///
/// # Errors
/// The system has no random numbers.
pub(crate) fn new() -> io::Result<String> {
    let mut bytes = [0; BYTES];
    getrandom::fill(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
    Ok(bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    }))
}

/// Whether two texts are equal, in a time that does not tell where they differ.
pub(crate) fn are_equal(one: &str, other: &str) -> bool {
    one.len() == other.len() && one.bytes().zip(other.bytes()).fold(0, |all, (one, other)| all | (one ^ other)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_tokens_are_equal() {
        let [one, other] = [new().unwrap(), new().unwrap()];
        assert_eq!((one.len(), one.chars().all(|it| it.is_ascii_hexdigit())), (32, true));
        assert!(!are_equal(&one, &other));
        assert!(are_equal(&one, &one.clone()) && !are_equal(&one, &one[1..]));
    }
}
