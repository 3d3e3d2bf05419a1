//! The files of a report: those of a small page as they were last accepted (`UPDATE_GOLDEN=1` accepts new ones), the same bytes each
//! time, and no text that is taken for markup.

use crate::sample;
use serde_json::Value;
use std::path::Path;
use tilewright_report::{
    Axis, Chart, File, HeatMap, Lane, Origin, Page, Picture, Provenance, Rule, Section, Series, Statement, Table,
    Timeline, Verdicts,
};

/// A page with one of each part; `text` makes all words of it, from a name.
fn small(mut text: impl FnMut(&str) -> String) -> Page {
    let provenance = Provenance::new(text("program"), text("1.2.3"), text("program report -o out"))
        .seeds([7])
        .parameter(text("size"), text("8x8"), text("small"));
    let rule = Rule::NeverDecreases { with: text("k") };
    let verdicts = Verdicts::new("verdicts", text("Statements"))
        .note(text("All three."))
        .state(
            Statement::new(text("F1"), text("Two is two."), Rule::Equals)
                .unit(text("clocks"))
                .paper([2.0])
                .found(Origin::rtl([7]), [2.0]),
        )
        .state(
            Statement::new(text("F2"), text("It grows."), rule)
                .found(Origin::model([7, 8]), [(text("k = 1"), 4.0), (text("k = 2"), 3.0)])
                .because([text("It is full."), text("It would have to be larger.")]),
        )
        .state(Statement::new(text("F3"), text("It is fast."), Rule::AtLeast).cannot_be_compared(text("nobody knows")));
    let curve = text("curve");
    let chart = Chart::new("chart", text("A curve"), Axis::log(text("x")), Axis::linear(text("y")))
        .note(text("With points."))
        .series(Series::new(&curve, Origin::Formula, [(1.0, 0.0), (10.0, 4.0), (100.0, 8.0)]))
        .series(Series::new(&curve, Origin::rtl([7]), [(0.0, 0.0), (10.0, 4.0)]))
        .series(Series::new(&curve, Origin::rtl([8]), [(10.0, 5.0)]))
        .series(Series::new(text("other"), Origin::Paper, [(100.0, 6.0)]));
    let dots = Picture::new("dots", text("Dots"), text("two dots"), include_bytes!("../examples/dots.png").to_vec())
        .note(text("Enlarged."));
    let map =
        HeatMap::new("map", text("Busy"), text("clocks"), Origin::model([]), [vec![1.0, 2.0], vec![3.0, f64::NAN]])
            .note(text("Of each."));
    let table = Table::new("table", text("Forms"), [text("form"), text("units")])
        .note(text("Three."))
        .row([text("stack").into(), 0.1.into()]);
    let (lane, span) = (text("sender"), text("sending"));
    let times = Timeline::new("times", text("A transfer"), text("time"), Origin::rtl([7]))
        .note(text("Of a word."))
        .lane(Lane::new(lane).span(&span, 0.0, 2.5).span(text("waiting"), 2.5, 4.0).event(
            text("1"),
            text("the end"),
            2.5,
        ))
        .lane(Lane::new(text("bus")).span(&span, 1.0, 3.0));
    Page::new(text("A small page"), provenance)
        .paragraph(text("It is small."))
        .section(
            Section::new(text("First"))
                .part(verdicts)
                .paragraph(text("And then?"))
                .figure(text("It bends."), chart)
                .part(times),
        )
        .section(Section::new(text("Second")).part(dots).part(map))
        .section(Section::new(text("Third")).part(table))
}

fn file<'a>(files: &'a [File], name: &str) -> &'a str {
    let file = files.iter().find(|file| file.name == name).unwrap_or_else(|| panic!("no {name}"));
    std::str::from_utf8(&file.bytes).unwrap()
}

#[test]
fn a_small_page_is_as_it_was() {
    let files = small(str::to_owned).files().unwrap();
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "index.html",
            "report.json",
            "verdicts.csv",
            "chart.csv",
            "chart.svg",
            "times.csv",
            "times.svg",
            "dots.png",
            "map.csv",
            "table.csv"
        ]
    );
    // An element a line, and the style sheet where it is.
    let html = file(&files, "index.html")
        .replace(
            concat!(
                include_str!("../src/colours.css"),
                include_str!("../src/style.css"),
                include_str!("../src/charts.css")
            ),
            "…",
        )
        .replace("><", ">\n<");
    golden("index.html", &html);
    for name in
        ["report.json", "verdicts.csv", "chart.csv", "chart.svg", "times.csv", "times.svg", "map.csv", "table.csv"]
    {
        golden(name, file(&files, name));
    }
    assert_eq!(files[7].bytes, include_bytes!("../examples/dots.png"));
}

fn golden(name: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, text).unwrap();
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    let first = text.lines().zip(golden.lines()).find(|(new, old)| new != old);
    assert!(
        text == golden,
        "{name} is not as in tests/golden; UPDATE_GOLDEN=1 accepts it. First difference: {first:#?}"
    );
}

#[test]
fn the_same_page_gives_the_same_bytes() {
    let [one, two] = [(), ()].map(|()| sample::page().files().unwrap());
    assert_eq!(one, two);
}

#[test]
fn no_text_is_taken_for_markup() {
    let mut count = 0;
    // Ends an element, an attribute, a CSV cell, a JSON text.
    let page = small(|_| {
        count += 1;
        format!("<b>&\"',\n{count};")
    });
    let files = page.files().unwrap();
    let html = file(&files, "index.html");
    assert!(!html.contains("<b>") && !html.contains("&\"") && !html.contains("\"',"));
    let json: Value = serde_json::from_str(file(&files, "report.json")).unwrap();
    let mut in_json = Vec::new();
    texts(&json, &mut in_json);
    assert!(count > 35);
    for number in 1..=count {
        assert!(html.contains(&format!("&lt;b&gt;&amp;&quot;',\n{number};")), "text {number} is not on the page");
        assert!(
            in_json.iter().any(|text| text.contains(&format!("<b>&\"',\n{number};"))),
            "text {number} is not in the JSON"
        );
    }
    assert!(file(&files, "table.csv").starts_with("\"<b>&\"\"',\n"), "{}", file(&files, "table.csv"));
}

fn texts<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
    match value {
        Value::String(text) => found.push(text),
        Value::Array(values) => values.iter().for_each(|value| texts(value, found)),
        Value::Object(values) => values.values().for_each(|value| texts(value, found)),
        _ => {}
    }
}

/// A cell of a table shows few of many numbers, but those that a verdict speaks of.
#[test]
fn the_number_that_differs_is_on_the_page() {
    let curve = |wrong: f64| (0..40).map(move |x| (format!("x = {x}"), if x == 30 { wrong } else { 500.0 }));
    let statement =
        Statement::new("F1", "All are equal.", Rule::Equals).formula(curve(612.5)).found(Origin::rtl([]), curve(643.5));
    let table = Verdicts::new("verdicts", "Statements").state(statement);
    let page =
        Page::new("Many", Provenance::new("program", "1.2.3", "program")).section(Section::new("One").part(table));
    let files = page.files().unwrap();
    let html = file(&files, "index.html");
    assert!(
        html.contains("and 33 more") && html.contains("612.5") && html.contains("643.5") && html.contains("at x = 30"),
        "{html}"
    );
    assert!(!html.contains("x = 31"));
}

/// Statements that differ for one reason stand together, above it; what holds is folded.
#[test]
fn what_differs_is_open_and_explained_once_for_each_reason() {
    let of = |text: &str, found: f64| {
        Statement::new("F1", text, Rule::Equals).paper([33.3]).found(Origin::model([]), [found])
    };
    let lacking = ["A page is lacking.", "There would have to be one more."];
    let table = Verdicts::new("verdicts", "Statements").states([
        of("One.", 50.0).because(lacking),
        of("Two.", 33.3).because(["It holds.", "Nothing."]),
        of("Three.", 1.0),
        of("Four.", 67.0).because(lacking),
    ]);
    let page =
        Page::new("Some", Provenance::new("program", "1.2.3", "program")).section(Section::new("One").part(table));
    let files = page.files().unwrap();
    let html = file(&files, "index.html");
    let place = |text: &str| html.find(text).unwrap_or_else(|| panic!("no {text}"));
    let order =
        ["3 differ", "One.", "Four.", lacking[0], lacking[1], "Three.", "<details", "1 holds", "Two."].map(place);
    assert!(order.is_sorted(), "{order:?}");
    assert!(!html.contains("It holds.") && html.matches(lacking[0]).count() == 1);
}

/// Names beside curves need no legend; those that are too long for a narrow chart have one there, and others everywhere.
#[test]
fn a_legend_is_for_names_that_have_no_room() {
    let html = |names: [&str; 2]| {
        let series = names.map(|name| Series::new(name, Origin::Formula, [(1.0, 1.0), (2.0, 3.0)]));
        let chart =
            series.into_iter().fold(Chart::new("chart", "A", Axis::linear("x"), Axis::linear("y")), Chart::series);
        let page =
            Page::new("A", Provenance::new("program", "1.2.3", "program")).section(Section::new("A").part(chart));
        String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap()
    };
    let legends = |names| ["legend names narrow\"", "legend names\""].map(|class| html(names).contains(class));
    assert_eq!(legends(["k = 1", "k = 2"]), [false, false]);
    assert_eq!(legends(["k = 1", "pre-sorting, one shader"]), [true, false]);
    assert_eq!(legends(["k = 1", "a-name-that-cannot-be-broken"]), [false, true]);
}

/// Points without a formula are joined for the eye, but not those of the hardware across those of its model.
#[test]
fn hardware_is_not_joined_beside_its_model() {
    let threads = |others: &[Origin]| {
        let points = |origin: &Origin| Series::new("curve", origin.clone(), [(1.0, 1.0), (2.0, 3.0)]);
        let chart = others.iter().map(points).fold(
            Chart::new("chart", "A", Axis::linear("x"), Axis::linear("y")).series(points(&Origin::rtl([]))),
            Chart::series,
        );
        let page =
            Page::new("A", Provenance::new("program", "1.2.3", "program")).section(Section::new("A").part(chart));
        let html = String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap();
        // It is drawn for wide and for narrow screens.
        html.matches("<polyline class=\"thread").count() / 2
    };
    assert_eq!([threads(&[]), threads(&[Origin::model([])]), threads(&[Origin::Formula])], [1, 1, 0]);
}

/// A printed page is black on white whatever the screen is, with all statements.
#[test]
fn a_page_is_printed_in_the_light_and_unfolded() {
    let sheet = concat!(
        include_str!("../src/colours.css"),
        include_str!("../src/charts.css"),
        include_str!("../src/style.css")
    );
    let dark: Vec<&str> = sheet.split("prefers-color-scheme: dark").collect();
    assert!(dark.len() == 2 && dark[0].ends_with("@media screen and ("), "dark colours are for screens alone");
    let print = sheet.split("@media print").nth(1).unwrap();
    assert!(print.contains("details::details-content { content-visibility: visible;"));
}

#[test]
fn the_page_loads_nothing() {
    let files = sample::page().files().unwrap();
    let html = file(&files, "index.html");
    for word in ["<script", "http://", "https://", "url(", "@import"] {
        assert!(!html.contains(word), "{word}");
    }
    for address in html.split("src=\"").skip(1) {
        assert!(address.starts_with("data:image/png;base64,"));
    }
}

#[test]
fn all_that_is_wrong_is_said_at_once() {
    let table = |id: &str| Table::new(id, "Forms", ["form", "units"]);
    let map = |rows: Vec<Vec<f64>>| HeatMap::new("map", "Busy", "clocks", Origin::Formula, rows);
    let section = Section::new("Wrong")
        .part(table("Forms"))
        .part(table("index"))
        .part(table("forms").row(["stack".into()]))
        .part(Verdicts::new("forms", "Statements"))
        .part(Picture::new("dots", "Dots", "dots", b"GIF89a".to_vec()))
        .part(map(vec![]))
        .part(Timeline::new("times", "A transfer", "time", Origin::Formula))
        .part(
            Timeline::new("late", "A transfer", "time", Origin::Formula)
                .lane(Lane::new("bus").span("sending", 2.0, 1.0)),
        )
        .part(HeatMap::new("ragged", "Busy", "clocks", Origin::Formula, [vec![1.0], vec![1.0, 2.0]]));
    let page = Page::new("Wrong", Provenance::new("program", "1.2.3", "program")).section(section);
    let expected = "\
the table `Forms` has a name that is not a plain file name: use lower-case letters, digits and hyphens
the table `index` has a name that is taken: give each part another name, but not `index` or `report`
the table `forms` has 1 cells in row 1 and 2 columns: give each row a cell for each column
the table of verdicts `forms` has a name that is taken: give each part another name, but not `index` or `report`
the picture `dots` is not a PNG file: give it the bytes of a PNG file
the heat map `map` has no cells: give it at least one row of numbers
the chart of times `times` has no lanes: give it one or more
the chart of times `late` has `sending` from 2 to 1 in the lane bus: give it numbers that do not decrease
the heat map `ragged` has 2 cells in row 2 and 1 in row 1: give all rows one length";
    assert_eq!(page.files().unwrap_err().to_string(), expected);
}

/// Numbers that leave no room for a curve, or no number.
#[test]
fn any_numbers_can_be_drawn() {
    let numbers = [f64::NAN, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE, -1.0, 0.0, 1.0];
    for (x, y) in numbers.iter().flat_map(|x| numbers.iter().map(move |y| (*x, *y))) {
        for axis in [Axis::log, Axis::linear] {
            let mut chart = Chart::new("chart", "A curve", axis("x".to_owned()), axis("y".to_owned()));
            for origin in [Origin::Formula, Origin::rtl([]), Origin::Paper] {
                chart = chart.series(Series::new("curve", origin, [(x, y), (1.0, 1.0), (2.0, 3.0)]));
            }
            let page = Page::new("Curves", Provenance::new("program", "1.2.3", "program"))
                .section(Section::new("One").part(chart));
            let files = page.files().unwrap();
            let html = file(&files, "index.html");
            assert!(!html.contains("NaN") && !html.contains("inf,"), "{x} {y}");
        }
    }
}
