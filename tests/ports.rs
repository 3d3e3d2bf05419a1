//! In Verilog the comment of a port stands alone, so it says what the port is without those of its neighbours.

use tilewright_hdl::Design;
use tilewright_hdl::ir::Module;

/// What points to a neighbour, or to nothing, where a comment begins.
const POINTING: [&str; 22] = [
    "By what",
    "It ",
    "It.",
    "Its ",
    "Likewise",
    "Of each,",
    "Of how",
    "Of which.",
    "That ",
    "Their ",
    "There is one",
    "These",
    "They ",
    "This ",
    "Those",
    "To which",
    "Where.",
    "Where it",
    "Where they",
    "Which.",
    "The other",
    "The same",
];

#[test]
fn comments_of_ports_stand_alone() {
    let mut comments = 0;
    let mut wrong = Vec::new();
    for entry in [tilewright_blocks::catalog::ENTRIES, tilewright_rtl::catalog::ENTRIES].concat() {
        let design: Design = entry.design(&entry.values([]).unwrap()).unwrap();
        for module in design.modules() {
            for (port, comment) in ports(module) {
                comments += 1;
                if points(comment) {
                    wrong.push(format!("{}, `{port}`: {comment}", module.name));
                }
            }
        }
    }
    wrong.sort();
    wrong.dedup();
    assert!(comments > 1000, "only {comments} comments were found");
    assert!(wrong.is_empty(), "these point to a neighbour:\n{}", wrong.join("\n"));
}

fn ports(module: &Module) -> impl Iterator<Item = (&String, &String)> {
    module.about.inputs.iter().chain(&module.about.outputs).filter(|(_, comment)| !comment.is_empty())
}

/// Whether a comment makes no sense without the one before it.
fn points(comment: &str) -> bool {
    POINTING.iter().any(|beginning| comment.starts_with(beginning)) || comment.to_lowercase().contains("likewise")
}
