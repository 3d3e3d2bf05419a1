//! Patterns for hierarchical names.

/// Whether `pattern` matches all of `path`: `*` stands for any characters but a dot, `**` for any.
pub(super) fn matches(pattern: &str, path: &str) -> bool {
    let Some(star) = pattern.find('*') else { return pattern == path };
    let Some(rest) = path.strip_prefix(&pattern[..star]) else { return false };
    let (after, dots) = match pattern[star..].strip_prefix("**") {
        Some(after) => (after, true),
        None => (&pattern[star + 1..], false),
    };
    let end = if dots { rest.len() } else { rest.find('.').unwrap_or(rest.len()) };
    (0..=end).filter(|&i| rest.is_char_boundary(i)).any(|i| matches(after, &rest[i..]))
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn one_star_stops_at_a_dot_and_two_do_not() {
        assert!(matches("u_cell[3].*", "u_cell[3].value"));
        assert!(!matches("u_cell[3].*", "u_cell[3].u_core.value"));
        assert!(matches("u_cell[*].**", "u_cell[3].u_core.value"));
        assert!(matches("**.value", "u_cell[3].u_core.value"));
        assert!(!matches("value", "values"));
    }
}
