//! The document: what is around and between the parts.

use crate::page::{Page, Part, Section};
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Colours, what is around parts, and charts.
const STYLE: &str = concat!(include_str!("colours.css"), include_str!("style.css"), include_str!("charts.css"));

/// The whole page, in one file: it loads nothing and runs nothing, and a browser is told to let it do neither.
pub fn document(page: &Page) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:";
                title { (page.title) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (page.title) }
                    @for text in &page.introduction { p.introduction { (text) } }
                    (summary(page))
                    (contents(page))
                }
                main { @for (number, section) in page.sections.iter().enumerate() { (in_page(number, section)) } }
                footer { h2 { "Where this comes from" } (page.provenance.html()) }
            }
        }
    }
}

/// How many statements hold, in words.
fn summary(page: &Page) -> Markup {
    let [holds, differs, unknown] = page.count();
    let verb = |count, one, several| if count == 1 { one } else { several };
    html! {
        @if holds + differs + unknown > 0 {
            ul.summary aria-label="Verdicts" {
                li.holds { strong { (holds) } " " (verb(holds, "holds", "hold")) }
                li.differs { strong { (differs) } " " (verb(differs, "differs", "differ")) }
                li.unknown { strong { (unknown) } " cannot be compared" }
            }
        }
    }
}

/// The sections, where there are several.
fn contents(page: &Page) -> Markup {
    html! {
        @if page.sections.len() > 2 {
            nav aria-label="Contents" { ol {
                @for (number, section) in page.sections.iter().enumerate() { li { a href={ "#section-" (number + 1) } { (section.title) } } }
            } }
        }
    }
}

fn in_page(number: usize, section: &Section) -> Markup {
    html! {
        section id={ "section-" (number + 1) } {
            h2 { (section.title) }
            @for part in &section.parts { (in_section(part)) }
        }
    }
}

fn in_section(part: &Part) -> Markup {
    match part {
        Part::Paragraph(text) => html! { p { (text) } },
        Part::Links(links) => html! {
            ul { @for it in links { li { a href=(it.address) { (it.title) } " " (it.note) } } }
        },
        Part::Verdicts(it) => figure(part, &it.title, "", it.html()),
        Part::Chart(it) => figure(part, &it.title, &it.note, it.html()),
        Part::Timeline(it) => figure(part, &it.title, &it.note, it.html()),
        Part::Picture(it) => figure(part, &it.title, &it.note, it.html()),
        Part::HeatMap(it) => figure(part, &it.title, &it.note, it.html()),
        Part::Table(it) => figure(part, &it.title, &it.note, it.html()),
    }
}

/// A part with its caption, which leads to its data.
fn figure(part: &Part, title: &str, note: &str, inside: Markup) -> Markup {
    let (kind, id) = part.name().unwrap_or_default();
    let file = part.file().map_or(String::new(), |file| file.name);
    html! {
        figure.(kind.replace(' ', "-")) id=(id) {
            figcaption { h3 { (title) } " " @if !note.is_empty() { span.note { (note) } " " } a.data href=(file) { (file) } }
            (inside)
        }
    }
}
