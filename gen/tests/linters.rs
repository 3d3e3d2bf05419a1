//! The installed linters run, and their complaints are reported.

use tilewright_gen::{VerilogFile, tools};

/// A design of one module that assigns `value` to its output.
fn design(name: &str, value: &str) -> [VerilogFile; 1] {
    let text = format!(
        "`default_nettype none\nmodule {name} (\n    input wire a,\n    output wire y\n);\n    assign y = {value};\n\
         endmodule\n`default_nettype wire\n"
    );
    [VerilogFile { name: format!("{name}.v"), text }]
}

fn is_on_the_path(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
}

#[test]
fn every_linter_that_is_installed_runs_and_is_heard() {
    let ran = tools::lint(&design("sound", "a")).unwrap().ran;
    for program in ["verilator", "iverilog", "yosys"] {
        assert_eq!(ran.contains(&program), is_on_the_path(program), "{program} of {ran:?}");
    }
    let problems = tools::lint(&design("broken", "a +")).err().map(|problems| problems.0).unwrap_or_default();
    assert_eq!(problems.iter().map(|problem| problem.tool.as_str()).collect::<Vec<_>>(), ran);
    assert!(problems.iter().all(|problem| problem.output.contains("broken.v")), "{problems:?}");
}

#[test]
fn of_several_designs_those_with_a_problem_are_named() {
    let designs = [("one", "a"), ("two", "!a"), ("three", "a &"), ("four", "~"), ("five", "a")];
    let designs = designs.map(|(name, value)| design(name, value));
    let files = designs.each_ref().map(|files| &files[..]);
    match tools::lint_quickly(&files) {
        Ok(linted) => assert!(linted.ran.is_empty(), "{linted:?}"),
        Err(problems) => assert_eq!(problems.into_keys().collect::<Vec<_>>(), [2, 3]),
    }
}
