//! That each statement which differs on a full page says why. Full pages take minutes of processor time each, so what differs on them is
//! written down here, and the reasons are read in quick looks. This makes the full pages and compares:
//! `cargo test --release --test all what_differs_on_the_full_pages -- --ignored`

use super::made::{Made, made};
use super::parts;
use serde_json::Value;
use std::collections::BTreeSet;

/// A paper, the options of a quick look at it, and what differs on its full page: fact and text.
type Page = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const PAGES: [Page; 4] = [
    ("quadtree", "--polygons 20", &QUADTREE),
    ("pixel-planes-5", "--vectors 20", &PIXEL_PLANES),
    ("pixelflow", "--primitives 20000", &PIXELFLOW),
    ("vc1", "--views 2", &VC1),
];

const QUADTREE: [(&str, &str); 5] = [
    ("MPG-EQ1", "The mean number of windows on each level is at most the area of the filtered polygon."),
    ("MPG-F6A", "At S = 1000 performance still grows almost in proportion to the processors."),
    ("MPG-F6B", "Near S_k the load of the pipelines is greatest, and almost 100 %: at S_k."),
    ("MPG-F6B", "The load grows with the matrix: S = 1."),
    ("MPG-LIM", "FIFOs couple the processors so loosely that none waits: stacks, queues of one packet, k = 4."),
];

const PIXEL_PLANES: [(&str, &str); 8] = [
    (
        "PP5-ARCH",
        "Renderers have hardly more work than a processor for each pixel of the screen, which processes each polygon once.",
    ),
    (
        "PP5-ARCH",
        "Regions are assigned so that renderers process nearly equal numbers of primitives: 16 renderers that never wait.",
    ),
    (
        "PP5-ARCH",
        "Renderers process nearly equal numbers of primitives: frames of the circuit, with a ring of 5 Gbit/s.",
    ),
    ("PP5-PW", "P_w is at most P R/B also where B does not divide R: all primitives in all regions."),
    (
        "PP5-HVB",
        "H_v is 1.63 for vectors of 50 pixels at 45 degrees and regions of 128x128: by the formula that is printed.",
    ),
    ("PP5-UT", "The update time is N P_w T, if renderers never wait: random vectors, by the model."),
    ("PP5-UT", "The update time is N P_w T, if renderers never wait: random vectors, by the circuit."),
    ("PP5-UT", "Renderers never have to wait for primitives: with a ring of 5 Gbit/s."),
];

const PIXELFLOW: [(&str, &str); 11] = [
    ("PFL-COL", "Composing colour alone takes 360 µs: 3 bytes of 40 regions: formula."),
    (
        "PFL C1",
        "With eight samples the non-texturing system has a greater least latency than a base system with 4 shaders: model that shades a pixel once.",
    ),
    (
        "PFL C1",
        "With eight samples the non-texturing system has a greater least latency than a base system with 4 shaders: model that shades every sample.",
    ),
    (
        "PFL C2",
        "At 30 to 40 ms the non-texturing system draws fewer primitives than the base system with 1 shader: model that shades every sample.",
    ),
    ("PFL C4", "At 30 to 40 ms 1 shader draws more primitives than 4: model that shades every sample."),
    ("PFL C5", "At 30 to 40 ms pre-sorting gains at most 15 %: formula."),
    ("PFL C5", "At 30 to 40 ms pre-sorting gains at most 15 %: model that shades a pixel once."),
    ("PFL C5", "At 30 to 40 ms pre-sorting gains at most 15 %: model that shades every sample."),
    (
        "PFL C5",
        "At 30 to 40 ms pre-sorting with 4 shaders gains at most 15 % beside the base system with 1: model that shades every sample.",
    ),
    ("PFL D1", "Without antialiasing pre-sorting has no advantage at 30 to 40 ms: formula."),
    ("PFL D1", "Without antialiasing pre-sorting has no advantage at 30 to 40 ms: model."),
];

const VC1: [(&str, &str); 16] = [
    (
        "VC1-SW4",
        "A processor’s worst-case idle time upon an overflow is 33.3 ms: if all swapped together before, at any time.",
    ),
    ("VC1-SW4", "A processor’s worst-case idle time upon an overflow is 33.3 ms: in any case."),
    (
        "VC1-F7",
        "The rendering time decreases in inverse proportion to the number of processing elements: n T(n) / T(1), where T(n) is above 42.1 ms.",
    ),
    ("VC1-F7", "256 processing elements draw ter250 190 times as fast as one."),
    ("VC1-RATE", "16 processing elements draw 514,000 polygons a second at most."),
    ("VC1-RATE", "The times of ter250 with 1 and with 16 processing elements are those of the paper’s rates."),
    (
        "VC1-LOC",
        "The memory that processing elements need does not depend on the number of polygons: pages of ter250 beside ter1k.",
    ),
    (
        "VC1-F9",
        "A threshold of 500 pixels reduces the time to 75 % of that without: 1/4.7 of the screen, swaps in the blanking at its start.",
    ),
    (
        "VC1-F9",
        "A threshold of 500 pixels reduces the time to 75 % of that without: 1/4.7 of the screen, swaps in the blanking anywhere in it.",
    ),
    (
        "VC1-F9",
        "A threshold of 500 pixels reduces the time to 75 % of that without: 1/8 of the screen, swaps in the blanking at its start.",
    ),
    (
        "VC1-F9",
        "A threshold of 500 pixels reduces the time to 75 % of that without: 1/8 of the screen, swaps in the blanking anywhere in it.",
    ),
    ("VC1-F9", "As the threshold becomes larger, load balancing becomes worse."),
    ("VC1-T1", "With regions ter1k takes considerably longer."),
    ("VC1-T1", "With virtual local frame buffers and with regions, a processing element waits for the others: ter1k."),
    ("VC1-THRN", "The polygons that are sent become smaller: their mean area with the best threshold."),
    ("VC1-IMM", "In immediate mode the machine is no longer scalable: T(64) / T(256) of ter250."),
];

/// The statements of a page.
fn statements(report: &Value) -> impl Iterator<Item = &Value> {
    parts(report)
        .filter(|part| part["kind"] == "verdicts")
        .flat_map(|part| part["part"]["statements"].as_array().unwrap())
}

fn report(made: &Made) -> Value {
    serde_json::from_str(&made.read("report.json")).unwrap()
}

/// Why it differs and what would have to change, a sentence or more each.
#[test]
fn what_differs_on_a_full_page_says_why() {
    for (paper, quick, differing) in PAGES {
        let report = report(made(&format!("{paper} -o report/ {quick}")));
        for (fact, text) in differing {
            let is_it = |it: &&Value| it["fact"] == *fact && it["text"] == *text;
            let statement = statements(&report).find(is_it).unwrap_or_else(|| panic!("{paper} does not state {text}"));
            for part in ["why", "change"] {
                let sentences = statement["reason_if_it_differs"][part].as_str().unwrap_or_default();
                assert!(sentences.len() > 30 && sentences.ends_with('.'), "{paper}, {text}: {part} is “{sentences}”");
            }
        }
    }
}

#[test]
#[ignore = "takes 20 minutes of processor time"]
fn what_differs_on_the_full_pages_is_written_down_here() {
    for (paper, _, differing) in PAGES {
        let report = report(made(&format!("{paper} -o report/")));
        let name = |it: &Value| ["fact", "text"].map(|part| it[part].as_str().unwrap().to_owned());
        let found: BTreeSet<_> = statements(&report)
            .filter(|it| it["verdict_in_words"].as_str().unwrap().starts_with("differs"))
            .map(name)
            .collect();
        let expected: BTreeSet<_> = differing.iter().map(|(fact, text)| [*fact, *text].map(str::to_owned)).collect();
        assert_eq!(found, expected, "{paper}");
    }
}
