//! A diagram in Graphviz's language.

use super::layout::lines;
use super::model::{ArrowKind, BoxKind, Diagram, DiagramBox};
use std::fmt::Write;

pub(super) fn dot(diagram: &Diagram) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_graph(&mut text, diagram);
    text
}

fn write_graph(text: &mut String, diagram: &Diagram) -> std::fmt::Result {
    writeln!(text, "digraph {} {{", quoted(&diagram.title))?;
    writeln!(
        text,
        "    rankdir=LR;\n    node [shape=box, fontname=\"monospace\"];\n    edge [fontname=\"monospace\"];"
    )?;
    write_level(text, diagram, None, 1)?;
    for arrow in &diagram.arrows {
        let style = match arrow.kind {
            ArrowKind::Stream => Some("penwidth=3"),
            ArrowKind::Data => None,
            ArrowKind::Control => Some("style=dashed"),
        };
        let label = Some(arrow.label()).filter(|it| !it.is_empty()).map(|it| format!("label={}", quoted(&it)));
        let attributes: Vec<String> = label.into_iter().chain(style.map(str::to_owned)).collect();
        let attributes = if attributes.is_empty() { String::new() } else { format!(" [{}]", attributes.join(", ")) };
        writeln!(text, "    b{} -> b{}{attributes};", arrow.from, arrow.to)?;
    }
    writeln!(text, "}}")
}

/// The boxes of a frame, or those outside of all frames.
fn write_level(text: &mut String, diagram: &Diagram, frame: Option<usize>, depth: usize) -> std::fmt::Result {
    let indent = "    ".repeat(depth);
    for (index, it) in diagram.boxes.iter().enumerate().filter(|(_, it)| it.frame == frame) {
        writeln!(text, "{indent}b{index} [label={}{}];", quoted(&label(it)), shape(it))?;
    }
    for (index, inner) in diagram.frames.iter().enumerate().filter(|(_, inner)| inner.frame == frame) {
        let count = if inner.count.is_empty() { String::new() } else { format!(" ×{}", inner.count) };
        writeln!(text, "{indent}subgraph cluster_{index} {{")?;
        writeln!(text, "{indent}    label={};", quoted(&format!("{}{count}", inner.name)))?;
        write_level(text, diagram, Some(index), depth + 1)?;
        writeln!(text, "{indent}}}")?;
    }
    Ok(())
}

fn label(it: &DiagramBox) -> String {
    let note = Some(it.note.clone()).filter(|note| !note.is_empty());
    lines(it).into_iter().chain(note).collect::<Vec<_>>().join("\n")
}

fn shape(it: &DiagramBox) -> &'static str {
    match it.kind {
        BoxKind::Input | BoxKind::Output => ", shape=cds",
        BoxKind::Instance => ", style=\"rounded,bold\"",
        BoxKind::Memory => ", shape=cylinder",
        BoxKind::Register => "",
        BoxKind::Net => ", style=\"rounded,dashed\"",
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}
