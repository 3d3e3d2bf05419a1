//! rustc's messages for descriptions that do not compile: each names the remedy.

use std::path::PathBuf;
use std::process::Command;
use std::time::SystemTime;

/// A description with mistakes that no library can report, because it does not compile.
const WRONG: &str = r"
use tilewright_hdl::*;
bundle! { pub struct Pair<T> { pub x: T, pub y: T } }
pub fn build(m: Module, a: Signal, pair: Pair) {
    let words = m.memory(TEXT, 4, 8, ReadUnderWrite::Old);
    words.write(1, a, a);
    let _ = a[3];
    let _ = a[0..4];
    let _ = a * 2.5;
    let _ = a + pair;
    let _: Signal = mux(true, a, a);
    m.reg(TEXT, a);
    let count = m.reg(TEXT, 8);
    let _ = a == pair.x;
    let _ = *count != 3;
    let _ = count == 3;
    let _ = a < count;
    assert!(pair.y >= 1);
    m.reg(TEXT, pair.clone());
    let _ = mux(lit(1, 1), pair.clone(), a);
    of_a_record(a);
    let _ = bits(8).of(2.5);
    let _ = lit(8, 2.5);
    let _ = a.bit(a);
    let _ = a / 3;
    let _ = count % 3;
    let _ = if a { 1 } else { 2 };
    let _ = a && a;
}
pub fn two(m: Module, c: Signal) {
    m.reg(TEXT, 8).when(c, mux(c, 0, 2));
}
pub fn selected(m: Module, c: Signal) {
    m.reg(TEXT, 8).next(select([(c, 1)], 2));
}
pub fn cases(m: Module, c: Signal) {
    m.reg(TEXT, 8).next(case(c, [(1, 3)], 2));
}
pub fn chosen(m: Module, c: Signal) {
    m.reg(TEXT, 8).next(choose!(c, Way { Left => 0, Right => 2 }));
}
codes! { pub enum Way { Left, Right } }
block! {
    pub struct Sum { pub width: u32 }
    input(self) SumIn { a: bits(self.width), b: bits(self.width) }
    speed = 1;
    outputs SumOut { sum: bits(8) }
}
impl Sum {
    fn build(&self, _: Module, i: SumIn) -> SumOut {
        SumOut { sum: i.a + i.b }
    }
}
fn of_a_record<B: Bundle>(_: B) {}
const TEXT: &str = stringify!(words);
";
const NOT_COMPARED: &str = "signals cannot be compared by `==`, `<` and their like, which return a `bool`";
/// rustc shows the line of the parameter that is given a number.
const NO_WIDTH: &str = "// Numbers alone have no width: write one as `lit(8, 0)`.";

#[test]
fn rustc_says_what_to_write() {
    let said = compile(WRONG);
    for (line, message, remedy) in [
        ("words.write(1, a, a);", "a `{integer}` is not a signal", "that is always true is `lit(1, 1)`"),
        ("let _ = a[3];", "a signal is not indexed by `[..]`", "one bit is `.bit(3)`"),
        ("let _ = a[0..4];", "a signal is not indexed by `[..]`", "bits 0 to 3 are `.slice(0..4)`"),
        ("let _ = a * 2.5;", "a `{float}` is neither a signal nor a number", "an integer"),
        ("let _ = a + pair;", "a `Pair` is neither a signal nor a number", "for a record, name a field"),
        ("mux(true, a, a);", "a `bool` is not a signal", "that is always true is `lit(1, 1)`"),
        ("let _ = a == pair.x;", NOT_COMPARED, "is `a.eq(b)`"),
        ("let _ = *count != 3;", NOT_COMPARED, "`a.ne(b)`"),
        ("let _ = count == 3;", NOT_COMPARED, "is `a.eq(b)`"),
        ("let _ = a < count;", NOT_COMPARED, "`a.lt(b)`"),
        ("assert!(pair.y >= 1);", NOT_COMPARED, "`a.ge(b)`"),
        ("m.reg(TEXT, a);", "`tilewright_hdl::Signal` is not a width", "a width is a number of bits"),
        (
            "m.reg(TEXT, pair.clone());",
            "nothing can be declared with a `Pair`",
            "as in `Entry { resident: bit(), page:",
        ),
        (
            "pair.clone(), a);",
            "`tilewright_hdl::Signal` cannot be given where a `Pair` is expected",
            "a record is given a",
        ),
        (
            "of_a_record(a);",
            "`tilewright_hdl::Signal` is not a record of signals",
            "is a struct that `record!` or `bundle!` makes",
        ),
        ("bits(8).of(2.5);", "`{float}` does not say how many lanes there are", "`row(n)`, or `grid(rows, columns)`"),
        ("lit(8, 2.5);", "a `{float}` is not an integer", "known while the block is built"),
        ("a.bit(a);", "a `tilewright_hdl::Signal` is not an integer", "known while the block is built"),
        ("let _ = a / 3;", "signals are not divided by `/` or `%`", "a quotient is `a >> n`"),
        ("let _ = count % 3;", "signals are not divided by `/` or `%`", "instantiate `Divider`"),
        ("let _ = if a { 1 } else { 2 };", "expected `bool`, found `Signal`", "E0308"),
        ("let _ = a && a;", "expected `bool`, found `Signal`", "E0308"),
        ("when(c, mux(c, 0, 2));", "type annotations needed", NO_WIDTH),
        ("next(select([(c, 1)], 2));", "type annotations needed", NO_WIDTH),
        ("next(case(c, [(1, 3)], 2));", "type annotations needed", NO_WIDTH),
        ("next(choose!(c, Way { Left => 0, Right => 2 }));", "type annotations needed", NO_WIDTH),
        ("input(self) SumIn", "`input` is no clause of a block", "`in Name { .. }`"),
        ("speed = 1;", "`speed` is no clause of a block", "`latency = ..;`"),
        ("outputs SumOut", "`outputs` is no clause of a block", "`out Name { .. }`"),
    ] {
        let found =
            said.split("\n\n").any(|error| error.contains(message) && error.contains(remedy) && error.contains(line));
        assert!(found, "nothing says `{message}` and `{remedy}` of `{line}`:\n{said}");
    }
}

/// Without the mistakes it compiles, so nothing else is wrong with it.
#[test]
fn what_it_names_compiles() {
    let right = WRONG
        .replace("words.write(1, a, a)", "words.write(lit(1, 1), a, a)")
        .replace("a[3]", "a.bit(3)")
        .replace("a[0..4]", "a.slice(0..4)")
        .replace("a * 2.5", "a * 2")
        .replace("a + pair", "a + pair.x")
        .replace("mux(true,", "mux(lit(1, 1),")
        .replace("m.reg(TEXT, a);", "let _ = m.reg(TEXT, a.width());")
        .replace("a == pair.x", "a.eq(pair.x)")
        .replace("*count != 3", "count.ne(3)")
        .replace("count == 3", "count.eq(3)")
        .replace("a < count", "a.lt(count)")
        .replace("assert!(pair.y >= 1);", "let _ = pair.y.ge(1);")
        .replace("m.reg(TEXT, pair.clone())", "let _ = m.reg(TEXT, Pair { x: bit(), y: bit() })")
        .replace("pair.clone(), a)", "pair.x, a)")
        .replace("of_a_record(a)", "of_a_record(pair)")
        .replace("of(2.5)", "of(2)")
        .replace("lit(8, 2.5)", "lit(8, 2)")
        .replace("a.bit(a)", "a.bit(1)")
        .replace("a / 3", "a >> 2")
        .replace("count % 3", "count.trunc(2)")
        .replace("if a { 1 } else { 2 }", "mux(a.bit(0), a, a)")
        .replace("a && a", "a & a")
        .replace("mux(c, 0, 2)", "mux(c, lit(8, 0), 2)")
        .replace("(c, 1)], 2)", "(c, lit(8, 1))], 2)")
        .replace("(1, 3)], 2)", "(1, lit(8, 3))], 2)")
        .replace("Left => 0,", "Left => lit(8, 0),")
        .replace("input(self)", "in(self)")
        .replace("speed = 1;", "")
        .replace("outputs", "out");
    assert_eq!(compile(&right), "");
}

/// Codes and choices by code that do not compile.
const WRONG_CODES: &str = r"
use tilewright_hdl::*;
codes! {
    pub enum Way { Left, Right, Both }
    pub enum Twice { One = 1, Other = 1 }
    pub enum Below { Zero = -1 }
}
pub fn build(way: Signal, a: Signal, b: Signal) {
    let _: Signal = choose!(way, Way { Left => a, Wright | _ => b });
    let _: Signal = choose!(way, Way { Left => a, _ if true => b });
    let _: Signal = choose!(way, Way { Left => a, _ => 2.5 });
}
";

#[test]
fn rustc_says_what_is_wrong_with_codes() {
    let said = compile(WRONG_CODES);
    for (line, message) in [
        ("pub enum Twice { One = 1, Other = 1 }", "discriminant value `1` assigned more than once"),
        ("pub enum Below { Zero = -1 }", "cannot apply unary operator `-` to type `u64`"),
        (
            "choose!(way, Way { Left => a, Wright | _ => b });",
            "no variant or associated item named `Wright` found for enum `Way`",
        ),
        ("choose!(way, Way { Left => a, _ if true => b });", "a choice is written `choose!(subject, Enum { One => a,"),
        (
            "choose!(way, Way { Left => a, _ => 2.5 });",
            "a `{float}` cannot be given where a `tilewright_hdl::Signal` is expected",
        ),
    ] {
        let found = said.split("\n\n").any(|error| error.contains(message) && error.contains(line));
        assert!(found, "nothing says `{message}` of `{line}`:\n{said}");
    }
    let right = WRONG_CODES
        .replace("Other = 1", "Other = 2")
        .replace("= -1", "= 0")
        .replace("Wright", "Right")
        .replace("Right | _ => b", "Right | Both => b")
        .replace("_ if true => b", "_ => b")
        .replace("2.5", "2");
    assert_eq!(compile(&right), "");
    // rustc looks for a missing code where all else is right.
    let missing = compile(&right.replace("Right | Both => b", "Right => b"));
    let line = "choose!(way, Way { Left => a, Right => b });";
    assert!(
        missing.contains("non-exhaustive patterns: `Way::Both` not covered") && missing.contains(line),
        "{missing}"
    );
}

/// Records that are declared wrongly, each field in a line of its own.
const WRONG_RECORDS: &str = r"
use tilewright_hdl::*;
bundle! { pub struct Pair<T> { pub x: T } }
record! { pub struct Sized(side: u32) { place: below(side) } }
record! {
    pub struct Entry {
        pub(crate) page: bits(4),
        /// It is the last.
        last: _,
        pair: Pair,
        sized: Sized,
        number: 8,
        open = bits(4)
    }
}
record! { pub struct Typed<T> { pub x: T } }
record! { pub struct Nothing; }
record! { pub enum Kind { One, Two } }
record! { pub struct Listed { bytes: [bits(8); 4] } }
pub const ZEROS: Listed<u64> = Listed::ZERO;
";

#[test]
fn rustc_says_how_a_record_is_declared() {
    let said = compile(WRONG_RECORDS);
    for (line, message, remedy) in [
        ("pub(crate) page: bits(4),", "a field of a record and a port have no `pub`", "as visible as the struct"),
        ("last: _,", "a field of a record has a width", "`_` is as wide as its driver"),
        ("pair: Pair,", "the name `Pair` does not say how wide the fields are", "as in `entry: Entry::widths(12)`"),
        ("sized: Sized,", "the name `Sized` does not say how wide the fields are", "as in `entry: Entry::widths(12)`"),
        ("number: 8,", "mismatched types", "expected `Width`, found integer"),
        ("open = bits(4)", "a field of a record and a port are declared as `name: width,`", "a width is `bit()`"),
        ("struct Typed<T>", "a record that is declared with its widths has no type parameter", "write `bundle!`"),
        ("struct Nothing;", "a record is a struct with fields in braces", "with parameters `struct Entry(pages"),
        ("enum Kind {", "a record is a struct with fields in braces", "with parameters `struct Entry(pages"),
        ("Listed::ZERO;", "`ZERO` exists for struct `Listed<_>`, but its trait bounds were not", "Vec<"),
    ] {
        let at = WRONG_RECORDS.lines().position(|text| text.contains(line)).unwrap() + 1;
        let found = said.split("\n\n").any(|error| {
            error.contains(message) && error.contains(remedy) && error.contains(&format!("wrong.rs:{at}:"))
        });
        assert!(found, "nothing says `{message}` and `{remedy}` of line {at}, `{line}`:\n{said}");
    }
    assert!(said.contains("due to 10 previous errors"), "nothing follows from another:\n{said}");
}

/// Without the mistakes they compile.
#[test]
fn records_that_are_declared_as_it_says_compile() {
    let right = WRONG_RECORDS
        .replace("pub(crate) page", "page")
        .replace("last: _", "last: bit()")
        .replace("pair: Pair", "pair: Pair { x: bit() }")
        .replace("sized: Sized", "sized: Sized::widths(3)")
        .replace("number: 8", "number: bits(8)")
        .replace("open = bits(4)", "open: bits(4)")
        .replace("Typed<T> { pub x: T }", "Typed { x: bit() }")
        .replace("struct Nothing;", "struct Nothing { x: bit() }")
        .replace("enum Kind { One, Two }", "struct Kind { one: bit() }")
        .replace("Listed<u64> = Listed::ZERO", "Kind<u64> = Kind::ZERO");
    assert_eq!(compile(&right), "");
}

/// What is not written as a clause is, and a clause that needs `self`.
const NO_CLAUSES: &str = r"
use tilewright_hdl::*;
block! {
    struct Sum { width: u32 }
    in SumIn { a: bits(self.width) }
    in More { b: bit() }
    latency = 1
}
";

#[test]
fn rustc_says_how_a_clause_is_written() {
    let said = compile(NO_CLAUSES);
    assert!(said.contains("a block has one clause `in`, as in `in AdderIn {"), "{said}");
    let said = compile(&NO_CLAUSES.replace("    in More { b: bit() }\n", ""));
    assert!(said.contains("a block has one clause `latency`, as in `latency = \"2 clocks\";`"), "{said}");
    let said = compile(&NO_CLAUSES.replace("    in More { b: bit() }\n    latency = 1\n", ""));
    assert!(said.contains("E0424") && said.contains("expected value, found module `self`"), "{said}");
}

/// Every clause twice, what is no clause at all, and no range.
const WRONG_CLAUSES: &str = r#"
use tilewright_hdl::*;
block! { struct Ranges { width: u32 } ranges { width: 1..=8 } ranges { width: 1..=8 } }
block! { struct Name; name = "name"; name = "name"; }
block! { struct From; foreign = Foreign::module("FROM"); foreign = Foreign::module("FROM"); }
block! { struct Ports; port_names { a: "b" } port_names { a: "b" } }
block! { struct Late; latency = "2 clocks"; latency = "2 clocks"; }
block! { struct Source; source = "section 3"; source = "section 3"; }
block! { struct Fed; in FedIn { a: bit() } in MoreIn { a: bit() } }
block! { struct Gives; out GivesOut { a: bit() } out MoreOut { a: bit() } }
block! { struct Other; 5 }
"#;

#[test]
fn rustc_says_which_clause_is_there_twice() {
    let said = compile(WRONG_CLAUSES);
    for message in [
        "a block has one clause `ranges`, as in `ranges { depth: 2..=8,",
        "a block has one clause `name`, as in `name = \"uart\";`",
        "a block has one clause `foreign`, as in `foreign = Foreign::module(\"EHXPLLL\").capitals();`",
        "a block has one clause `port_names`, as in `port_names { beats: \"s_axis_t\" }`",
        "a block has one clause `latency`, as in `latency = \"2 clocks\";`",
        "a block has one clause `source`, as in `source = \"section 3\";`",
        "a block has one clause `in`, as in `in AdderIn {",
        "a block has one clause `out`, as in `out AdderOut {",
        "the clauses of a block are `ranges { .. }`, `name = ..;`,",
    ] {
        assert!(said.contains(message), "nothing says `{message}`:\n{said}");
    }
    let said = compile(NO_RANGE);
    assert!(said.contains("a `{float}` does not say which values a parameter may have"), "{said}");
}

/// A parameter whose values are no range.
const NO_RANGE: &str = r"
use tilewright_hdl::*;
block! { struct Ranges { width: u32 } ranges { width: 2.5 } }
impl Ranges {
    fn build(&self, _: Module, (): ()) {}
}
";

/// A test with a process where a group is expected.
const NO_GROUP: &str = r"
use tilewright_sim::Testbench;
pub fn test(t: Testbench) {
    t.run(t.wait(3));
}
";

#[test]
fn rustc_says_how_processes_are_run() {
    let said = compile(NO_GROUP);
    assert!(said.contains("is not a group of processes") && said.contains("t.run(t.wait(3));"), "{said}");
    assert!(said.contains("and a single one is `(process,)`"), "{said}");
    assert_eq!(compile(&NO_GROUP.replace("(t.wait(3))", "((t.wait(3),))")), "");
}

/// rustc's output for a crate with this text.
fn compile(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("wrong.rs");
    std::fs::write(&source, text).unwrap();
    // The tests of this crate are in the directory of the library that they are linked with.
    let beside: PathBuf = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    let rustc = std::env::var_os("RUSTC").unwrap_or("rustc".into());
    let output = Command::new(rustc)
        .args(["--edition", "2024", "--crate-type", "lib", "--emit", "metadata", "--cap-lints", "allow"])
        .args(
            ["tilewright_hdl", "tilewright_sim"]
                .map(|name| format!("--extern={name}={}", library(name, &beside).display())),
        )
        .arg("-L")
        .arg(format!("dependency={}", beside.display()))
        .arg("--out-dir")
        .arg(folder.path())
        .arg(&source)
        // The places of the library are relative to the workspace.
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .output()
        .unwrap();
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The newest library of this name that was built for tests.
fn library(name: &str, beside: &std::path::Path) -> PathBuf {
    let files = std::fs::read_dir(beside).unwrap().map(|entry| entry.unwrap().path());
    let is_library = |path: &PathBuf| {
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        file.starts_with(&format!("lib{name}-")) && file.ends_with(".rlib")
    };
    let built = |path: &PathBuf| path.metadata().and_then(|file| file.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    files.filter(is_library).max_by_key(built).expect("the library is built before its tests")
}
