//! Small pieces of layout for all parts of a module.

use tilewright_circuit::Loc;

/// The column of a declaration's source place, if the declaration is shorter.
const PLACE_COLUMN: usize = 60;
/// Longer lines are broken.
const LONGEST: usize = 120;
/// A shorter list is not the reason for a long line.
const SHORT_LIST: usize = 60;

/// `[7:0] `, or nothing for a single bit.
pub fn range(width: u32) -> String {
    if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) }
}

/// The line with its place in the description as a trailing comment.
pub fn with_place(line: String, loc: Loc) -> String {
    format!("{line:PLACE_COLUMN$} // {}:{}", loc.file(), loc.line())
}

/// Items joined by commas, broken into lines of at most about 90 columns that are indented by `indent` spaces.
pub fn wrapped(items: &[String], indent: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    for (index, item) in items.iter().enumerate() {
        let comma = if index + 1 < items.len() { "," } else { "" };
        if index > 0 && column + item.len() + 2 > 90 {
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            column = indent;
        } else if index > 0 {
            out.push(' ');
        }
        out.push_str(item);
        out.push_str(comma);
        column += item.len() + 2;
    }
    out
}

/// The words of a text in lines of at most `columns` columns, independent of its own line breaks; a longer word has a
/// line of its own.
pub fn prose(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= columns => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

/// The line; if it is too long, the items of its longest `{..}` are on lines of their own.
pub fn broken(line: String) -> Vec<String> {
    let (code, place) = match line.split_once(" // ") {
        Some((code, place)) => (code.trim_end(), Some(place)),
        None => (&line[..], None),
    };
    if code.len() <= LONGEST || code.contains(['"', '\n']) {
        return vec![line];
    }
    let Some((begin, items, end)) = longest_list(code) else { return vec![line] };
    let indent = code.len() - code.trim_start().len();
    let head = &code[..begin];
    let head = place.map_or(head.to_string(), |place| format!("{head:PLACE_COLUMN$} // {place}"));
    let items = format!("{:inner$}{}", "", wrapped(&items, indent + 4), inner = indent + 4);
    let mut out = vec![head];
    out.extend(items.lines().map(str::to_string));
    out.push(format!("{:indent$}{}", "", &code[end..]));
    out
}

/// The start of the longest `{..}`, its items, and its end.
fn longest_list(code: &str) -> Option<(usize, Vec<String>, usize)> {
    let (mut depth, mut begin, mut commas) = (0, 0, Vec::new());
    let mut longest: Option<(usize, Vec<usize>, usize)> = None;
    // Brackets of other kinds within a list are not deeper lists, but commas in them do not separate its items.
    let mut others = 0;
    for (at, c) in code.char_indices() {
        match c {
            '{' if depth == 0 => (depth, begin, commas, others) = (1, at + 1, Vec::new(), 0),
            '{' => depth += 1,
            '}' => {
                depth -= 1;
                let most = longest.as_ref().map_or(SHORT_LIST, |(begin, _, end)| end - begin);
                if depth == 0 && !commas.is_empty() && at - begin > most {
                    longest = Some((begin, commas.clone(), at));
                }
            }
            '(' | '[' if depth > 0 => others += 1,
            ')' | ']' if depth > 0 => others -= 1,
            ',' if depth == 1 && others == 0 => commas.push(at),
            _ => {}
        }
    }
    let (begin, commas, end) = longest?;
    let ends = commas.iter().copied().chain([end]);
    let begins = [begin].into_iter().chain(commas.iter().map(|comma| comma + 1));
    let items = begins.zip(ends).map(|(begin, end)| code[begin..end].trim().to_string()).collect();
    Some((begin, items, end))
}

/// An instance of `module` with its connections aligned.
pub fn connect(module: &str, name: &str, connections: &[(String, String)]) -> Vec<String> {
    if connections.is_empty() {
        return vec![format!("{module} {name} ();")];
    }
    let longest = connections.iter().map(|(port, _)| port.len()).max().unwrap_or(0);
    let mut out = vec![format!("{module} {name} (")];
    for (index, (port, value)) in connections.iter().enumerate() {
        let comma = if index + 1 < connections.len() { "," } else { "" };
        out.push(format!("    .{port:longest$} ({value}){comma}"));
    }
    out.push(");".to_string());
    out
}

/// A generate loop or choice around its body.
pub fn generate(head: String, body: Vec<String>) -> Vec<String> {
    let mut out = vec!["generate".to_string(), format!("    {head}")];
    let indent = |line: String| if line.is_empty() { line } else { format!("        {line}") };
    out.extend(body.into_iter().map(indent));
    out.extend(["    end".to_string(), "endgenerate".to_string()]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_broken_in_its_longest_list() {
        let short = "assign x = {a, b};".to_string();
        assert_eq!(broken(short.clone()), [short]);
        let [a, b, c] = ["a", "b", "c"].map(|name| name.repeat(50));
        let list = format!("    assign {{x, y}} = {{{a}, ({b}), {{2{{c}}}}, {c}[1]}};");
        let lines = ["    assign {x, y} = {", &format!("        {a},"), &format!("        ({b}), {{2{{c}}}},")];
        let end = [format!("        {c}[1]"), "    };".to_string()];
        assert_eq!(broken(list.clone()), [&lines.map(str::to_string)[..], &end].concat());
        let with_place = broken(format!("{list} // a.rs:1"));
        assert_eq!(with_place[0], format!("{:60} // a.rs:1", lines[0]));
        assert_eq!(with_place[4], "    };");
        // A string is unchanged, and so is an expression.
        for line in [format!("$display(\"{list}\");"), format!("{a} + {b} + {c}"), format!("{a} + {b} + {{c, {c}}}")] {
            assert_eq!(broken(line.clone()), [line]);
        }
    }

    #[test]
    fn words_fill_lines() {
        assert_eq!(prose("one two\n three", 9), ["one two", "three"]);
        assert_eq!(prose("one two three", 13), ["one two three"]);
        assert_eq!(prose("longer than that", 5), ["longer", "than", "that"]);
        assert_eq!(prose(" \n", 5), [""; 0]);
    }

    #[test]
    fn a_line_of_items_ends_at_column_90() {
        let items = |lengths: &[usize]| lengths.iter().map(|&length| "x".repeat(length)).collect::<Vec<_>>();
        let [a, b, c] = [28, 29, 24].map(|length| "x".repeat(length));
        assert_eq!(wrapped(&items(&[28]), 0), a);
        // Each with its comma and a space.
        assert_eq!(wrapped(&items(&[28, 28, 28]), 0), format!("{a}, {a}, {a}"));
        assert_eq!(wrapped(&items(&[28, 28, 29]), 0), format!("{a}, {a},\n{b}"));
        assert_eq!(wrapped(&items(&[28, 28, 24, 24]), 4), format!("{a}, {a}, {c},\n    {c}"));
        assert_eq!(wrapped(&items(&[28, 28, 28, 28, 24, 24]), 4), format!("{a}, {a},\n    {a}, {a}, {c},\n    {c}"));
    }
}
