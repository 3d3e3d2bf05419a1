//! The query of a question.

use std::str::FromStr;

/// Names with values, such as `turn=0&x=3`.
pub struct Query<'a>(Vec<(&'a str, &'a str)>);

impl Query<'_> {
    /// A query as an address has it.
    pub fn of(text: &str) -> Query<'_> {
        Query(text.split('&').map(|part| part.split_once('=').unwrap_or((part, ""))).collect())
    }

    /// Whether it has that name.
    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|(of, _)| *of == name)
    }

    /// The number of that name, if it is one.
    pub fn number<T: FromStr>(&self, name: &str) -> Option<T> {
        self.0.iter().find(|(of, _)| *of == name).and_then(|(_, value)| value.parse().ok())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_names() {
        let query = Query::of("turn=-5&x=3&stop");
        assert_eq!((query.number::<i32>("turn"), query.number::<u32>("x")), (Some(-5), Some(3)));
        assert_eq!((query.number::<u32>("turn"), query.number::<u32>("y")), (None, None));
        assert!(query.has("stop") && !query.has("y"));
    }
}
