//! Small pieces of layout that every part of a module shares.

use tilewright_hdl::Loc;

/// Where a declaration's place in the source begins, if the declaration is shorter.
const PLACE_COLUMN: usize = 60;

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
