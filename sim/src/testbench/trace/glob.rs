//! Patterns for hierarchical names.

/// Whether `pattern` matches all of `path`: `*` stands for any characters but a dot, `**` for any characters. The
/// time is proportional to the product of both lengths.
pub(crate) fn matches(pattern: &str, path: &str) -> bool {
    // Most names have no star, or begin otherwise: those take no table.
    let plain = pattern.find('*').unwrap_or(pattern.len());
    let (start, pattern) = pattern.split_at(plain);
    let Some(path) = path.strip_prefix(start) else { return false };
    if pattern.is_empty() {
        return path.is_empty();
    }
    let parts = parts(pattern);
    // For each `i`, whether the first `i` parts match the path so far.
    let mut reached = vec![false; parts.len() + 1];
    reached[0] = true;
    pass_stars(&parts, &mut reached);
    for c in path.chars() {
        for i in (0..=parts.len()).rev() {
            let comes = i > 0 && reached[i - 1] && matches!(parts[i - 1], Part::One(one) if one == c);
            let stays = reached[i] && parts.get(i).is_some_and(|part| part.repeats(c));
            reached[i] = comes || stays;
        }
        pass_stars(&parts, &mut reached);
    }
    reached[parts.len()]
}

/// A part of a pattern.
enum Part {
    One(char),
    Star,
    TwoStars,
}

impl Part {
    fn is_star(&self) -> bool {
        !matches!(self, Part::One(_))
    }

    /// Whether it matches this character and may match more.
    fn repeats(&self, c: char) -> bool {
        match self {
            Part::One(_) => false,
            Part::Star => c != '.',
            Part::TwoStars => true,
        }
    }
}

fn parts(pattern: &str) -> Vec<Part> {
    let (mut parts, mut rest) = (Vec::new(), pattern);
    while let Some(c) = rest.chars().next() {
        let (part, length) = match c {
            '*' if rest.starts_with("**") => (Part::TwoStars, 2),
            '*' => (Part::Star, 1),
            _ => (Part::One(c), c.len_utf8()),
        };
        parts.push(part);
        rest = &rest[length..];
    }
    parts
}

/// A star also matches nothing.
fn pass_stars(parts: &[Part], reached: &mut [bool]) {
    for (i, part) in parts.iter().enumerate() {
        reached[i + 1] |= reached[i] && part.is_star();
    }
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

    #[test]
    fn a_star_stands_for_nothing_too_and_three_for_two() {
        for (pattern, path) in [("*", ""), ("**", ""), ("a*b*", "ab"), ("***", "a.b"), ("*.**.*", "a..b")] {
            assert!(matches(pattern, path), "{pattern} {path}");
        }
        for (pattern, path) in [("", "a"), ("a", ""), ("*a", "ab"), ("*.*", "ab"), ("*a*", "b.a")] {
            assert!(!matches(pattern, path), "{pattern} {path}");
        }
    }

    #[test]
    fn many_stars_take_no_longer_than_many_letters() {
        let path = "u_cell[3].".repeat(20);
        assert!(!matches(&("**".repeat(30) + "z"), &path));
        assert!(matches(&("**.".repeat(19) + "**"), &path));
    }
}
