//! The source lines around the description of a net.

use std::path::Path;

/// Lines of a file with their numbers, or nothing where the file is not there. `place` is `FILE:LINE`, from the present folder on.
/// The line is about in the middle.
pub fn lines(place: &str, count: usize) -> Vec<(usize, String)> {
    let Some((file, line)) = place.rsplit_once(':') else { return Vec::new() };
    let (Ok(text), Ok(line)) = (std::fs::read_to_string(Path::new(file)), line.parse::<usize>()) else {
        return Vec::new();
    };
    let all: Vec<&str> = text.lines().collect();
    let first = line.saturating_sub(1 + count / 2).min(all.len().saturating_sub(count));
    let shown = all.iter().enumerate().skip(first).take(count);
    // A tab and other control characters would move the cursor.
    let plain = |line: &str| line.replace('\t', "    ").chars().filter(|c| !c.is_control()).collect();
    shown.map(|(index, line)| (index + 1, plain(line))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_is_in_the_middle_if_the_file_has_lines_around_it() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let text: Vec<String> = (1..=9).map(|line| format!("\tline {line}\u{1b}")).collect();
        std::fs::write(file.path(), text.join("\n")).unwrap();
        let numbers = |line: usize| {
            let shown = lines(&format!("{}:{line}", file.path().display()), 5);
            assert!(shown.iter().all(|(number, text)| *text == format!("    line {number}")), "{shown:?}");
            shown.iter().map(|(number, _)| *number).collect::<Vec<_>>()
        };
        assert_eq!(numbers(5), [3, 4, 5, 6, 7]);
        assert_eq!(numbers(1), [1, 2, 3, 4, 5]);
        assert_eq!(numbers(9), [5, 6, 7, 8, 9]);
        assert_eq!(lines("no/such/file.rs:3", 5), []);
    }
}
