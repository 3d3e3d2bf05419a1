//! The document around and between the parts.

use crate::page::{Page, Part, Placed, Section};
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Styles: colours, the document, charts.
const STYLE: &str = concat!(include_str!("colours.css"), include_str!("style.css"), include_str!("charts.css"));

/// The whole page in one file. It loads nothing and runs nothing, and its policy makes the browser forbid both.
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

/// The numbers of statements by verdict, each a link to the first table of statements.
fn summary(page: &Page) -> Markup {
    let [holds, differs, unknown] = page.count();
    let verb = |count, one, several| if count == 1 { one } else { several };
    let first = page.parts().find(|part| matches!(part, Part::Verdicts(_))).and_then(Part::name);
    let first = first.map_or(String::new(), |(_, id)| format!("#{id}"));
    html! {
        @if holds + differs + unknown > 0 {
            ul.summary aria-label="Verdicts" {
                li { a.holds href=(first) { strong { (holds) } " " (verb(holds, "holds", "hold")) } }
                li { a.differs href=(first) { strong { (differs) } " " (verb(differs, "differs", "differ")) } }
                li { a.unknown href=(first) { strong { (unknown) } " cannot be compared" } }
            }
        }
    }
}

/// Links to the sections, if there are several.
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
            @for placed in &section.parts { (in_section(placed)) }
        }
    }
}

fn in_section(placed: &Placed) -> Markup {
    let figure = |title: &str, note: &str, inside: Markup| figure(placed, title, note, inside);
    match &placed.part {
        Part::Paragraph(text) => html! { p { (text) } },
        Part::Links(links) => html! {
            ul.links { @for it in links { li { a href=(it.address) { (it.title) } " " (it.note) } } }
        },
        Part::Verdicts(it) => figure(&it.title, &it.note, it.html()),
        Part::Chart(it) => figure(&it.title, &it.note, it.html()),
        Part::Timeline(it) => figure(&it.title, &it.note, it.html()),
        Part::Picture(it) => figure(&it.title, &it.note, it.html()),
        Part::HeatMap(it) => figure(&it.title, &it.note, it.html()),
        Part::Table(it) => figure(&it.title, &it.note, it.html()),
    }
}

/// A part with its caption, which is its claim or its title, then the drawing, and its data.
fn figure(Placed { claim, part }: &Placed, title: &str, note: &str, inside: Markup) -> Markup {
    let (kind, id) = part.name().unwrap_or_default();
    let file = part.file().map_or(String::new(), |file| file.name);
    html! {
        figure.(kind.replace(' ', "-")) id=(id) {
            figcaption {
                @match claim {
                    Some(claim) => { h3 { (claim) } " " span.title { (title) "." } " " }
                    None => { h3.title { (title) } " " }
                }
                @if !note.is_empty() { span.note { (note) } " " }
                a.data href=(file) { (file) }
            }
            (inside)
        }
    }
}
