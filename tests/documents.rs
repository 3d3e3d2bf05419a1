//! What README and documents show is what the code has and the commands print, and their links lead somewhere.

use crate::first_block::Counter;
use crate::tree::files;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use tilewright_scenes::{Frame, compare_colours};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The README, and every other page of the repository.
fn pages() -> Vec<PathBuf> {
    files(Path::new(ROOT), &["md"])
}

fn named(page: &Path) -> &str {
    page.strip_prefix(ROOT).unwrap().to_str().unwrap()
}

/// The fenced blocks of that language.
fn blocks<'a>(text: &'a str, language: &str) -> impl Iterator<Item = &'a str> {
    let opening = format!("\n```{language}\n");
    text.split(&opening).skip(1).collect::<Vec<_>>().into_iter().map(|rest| rest.split("\n```").next().unwrap())
}

fn readme() -> String {
    fs::read_to_string(Path::new(ROOT).join("README.md")).unwrap()
}

fn tilewright(arguments: &str, folder: &Path) -> String {
    let program = env!("CARGO_BIN_EXE_tilewright");
    let run = Command::new(program).args(arguments.split(' ')).current_dir(folder).output().unwrap();
    assert!(run.status.success(), "{arguments}: {run:?}");
    String::from_utf8(run.stdout).unwrap()
}

/// A line that stands for any number of lines.
const LEFT_OUT: &str = "..";
/// A first line before lines that are chosen from all over, as rows of a long wave.
const CHOSEN: &str = "...";

/// All lines of `part` in `whole`, one after another but for those left out; ends of lines are trimmed.
#[track_caller]
fn assert_shows(part: &str, whole: &str, place: &str) {
    let mut rest = whole.lines().map(str::trim_end);
    let is_chosen = part.starts_with(CHOSEN);
    let mut skips = is_chosen;
    for (number, line) in part.lines().map(str::trim_end).enumerate().skip(usize::from(is_chosen)) {
        if line == LEFT_OUT {
            skips = true;
            continue;
        }
        let found = if skips { rest.any(|it| it == line) } else { rest.next().is_some_and(|it| it == line) };
        assert!(found, "{place}: line {} of the output shown is not printed there:\n{line}\nin\n{whole}", number + 1);
        skips = is_chosen;
    }
    assert!(skips || rest.next().is_none(), "{place}: the output continues after what is shown");
}

/// A block of text that begins with `$ tilewright` is what that command prints; `..` stands for lines that are left out, and `...`
/// comes before lines chosen from all over. A file that it writes is the one of that name beside the page, if there is one.
#[test]
fn commands_print_and_draw_what_is_shown() {
    let mut shown = BTreeSet::new();
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for block in blocks(&text, "text") {
            let Some((command, output)) = shown_command(block) else { continue };
            // Long campaigns and measurements are by hand.
            if command.starts_with("reproduce ") || command.starts_with("bench ") {
                continue;
            }
            shown.insert((command, output.to_owned(), page.clone()));
        }
    }
    assert!(shown.len() >= 8, "only {} are found", shown.len());
    let mut last: Option<(String, String, TempDir)> = None;
    for (command, output, page) in shown {
        if last.as_ref().is_none_or(|(before, ..)| *before != command) {
            let folder = tempfile::tempdir().unwrap();
            last = Some((command.clone(), tilewright(&command, folder.path()), folder));
        }
        let (_, printed, folder) = last.as_ref().unwrap();
        assert_shows(&output, printed, &format!("{}, {command}", named(&page)));
        assert_drawn(folder.path(), page.parent().unwrap());
    }
}

/// The command that a block begins with, after `$ tilewright`, and what it prints. A line that ends with `\` continues in the next one.
fn shown_command(block: &str) -> Option<(String, &str)> {
    let (mut command, mut rest) = (String::new(), block.strip_prefix("$ tilewright ")?);
    loop {
        let (line, after) = rest.split_once('\n')?;
        rest = after;
        let Some(part) = line.strip_suffix('\\') else { return Some((command + line.trim_start(), rest)) };
        command.push_str(part.trim_start());
    }
}

/// What is in the folder and beside the page, too, is the same.
#[track_caller]
fn assert_drawn(folder: &Path, beside: &Path) {
    for entry in fs::read_dir(folder).unwrap() {
        let drawn = entry.unwrap().path();
        let kept = beside.join(drawn.file_name().unwrap());
        if !kept.exists() {
            continue;
        }
        let is_equal = if drawn.extension().is_some_and(|it| it == "png") {
            is_same_picture(&drawn, &kept)
        } else {
            fs::read(&drawn).unwrap() == fs::read(&kept).unwrap()
        };
        assert!(is_equal, "{} is not what the command draws now", named(&kept));
    }
}

/// Releases of the encoder differ in the bytes. Of an animation this is the first picture.
fn is_same_picture(drawn: &Path, kept: &Path) -> bool {
    let [drawn, kept] = [drawn, kept].map(|path| Frame::read_png(path).unwrap());
    compare_colours(&drawn, &kept).is_equal()
}

/// Relative links lead to a file, and to an anchor of a page.
#[test]
fn links_lead_somewhere() {
    let (mut count, mut missing) = (0, vec![]);
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        let links = text.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
        let pictures = ["src=\"", "srcset=\""].into_iter().flat_map(|name| text.split(name).skip(1));
        for target in links.chain(pictures.filter_map(|rest| rest.split('"').next())) {
            // Elsewhere, a path of Rust in documentation that is part of a crate's, or no link at all.
            if target.contains("://") || target.contains("::") || target.contains(char::is_whitespace) {
                continue;
            }
            count += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            let has_anchor = || anchors(&fs::read_to_string(&path).unwrap_or_default()).contains(anchor);
            if !path.exists() || (!anchor.is_empty() && !has_anchor()) {
                missing.push(format!("{}: {target}", named(&page)));
            }
        }
    }
    assert!(count > 50, "only {count} are found");
    assert!(missing.is_empty(), "links that lead nowhere:\n{}", missing.join("\n"));
}

/// The anchors that a forge makes of a page's headings, and those that the page has itself.
fn anchors(text: &str) -> BTreeSet<String> {
    let own = text.split("<a id=\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned);
    let titles = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let made = titles.map(|title| title.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-"));
    own.chain(made).collect()
}

#[test]
fn the_first_block_is_the_readmes() {
    let shown = readme();
    let block = blocks(&shown, "rust").next().unwrap();
    assert_eq!(block.trim(), include_str!("first_block.rs").trim());
    let printed = &tilewright_gen::verilog(&tilewright_hdl::elaborate(&Counter { limit: 3 }).unwrap())[0].text;
    let verilog = blocks(&shown, "verilog").next().unwrap();
    assert_shows(&format!("..\n{verilog}\n.."), printed, "README.md");
}

#[test]
fn the_pictures_are_the_golden_images() {
    let folder = tempfile::tempdir().unwrap();
    let golden = folder.path().join("golden.png");
    for scene in ["teapot", "molecule"] {
        tilewright(&format!("golden {scene} -o {}", golden.display()), folder.path());
        let shown = format!("{ROOT}/docs/{scene}.png");
        assert!(is_same_picture(&golden, Path::new(&shown)), "{shown} is another picture");
    }
}

/// Half of it: the other two machines take six seconds.
#[test]
fn the_first_pages_picture_is_what_compare_draws() {
    let folder = tempfile::tempdir().unwrap();
    tilewright("compare teapot --size 240x180 --machine vc1 --machine quadtree --owners half.png", folder.path());
    let half = Frame::read_png(folder.path().join("half.png")).unwrap();
    let shown = Frame::read_png(Path::new(ROOT).join("docs/hero.png")).unwrap();
    assert_eq!(half.size().width(), shown.size().width());
    assert!(half.size().height() > shown.size().height() / 2);
    // The last lines are the space below the pictures.
    let drawn = half.words.len() - 8 * half.size().width() as usize;
    let is_equal = half.words[..drawn] == shown.words[..drawn];
    assert!(is_equal, "docs/hero.png is not what the command of docs/cli.md draws now");
}

/// The picture of GTKWave was taken with the save file beside it, which has rows of the one that the command writes.
#[test]
fn the_viewers_picture_has_what_its_signs_say() {
    let folder = tempfile::tempdir().unwrap();
    tilewright("wave vc1 -o vc1.vcd", folder.path());
    let [kept, written, wave] = [
        &Path::new(ROOT).join("docs/wave-viewer.gtkw"),
        &folder.path().join("vc1.gtkw"),
        &folder.path().join("vc1.vcd"),
    ]
    .map(|path| fs::read_to_string(path).unwrap());
    let rows = |text: &str| -> Vec<(String, String)> {
        let lines: Vec<&str> = text.lines().collect();
        lines
            .array_windows()
            .filter(|[flags, _]| flags.starts_with('@'))
            .map(|[flags, name]| (flags.to_string(), name.to_string()))
            .collect()
    };
    let written: BTreeSet<_> = rows(&written).into_iter().collect();
    for row in rows(&kept) {
        assert!(written.contains(&row), "docs/wave-viewer.gtkw: `tilewright wave vc1` has no row {row:?}");
    }
    let shown: Vec<String> =
        rows(&kept).into_iter().map(|(_, name)| name.split_once('.').unwrap().1.to_owned()).collect();
    let fields =
        ["valid", "x[3:0]", "y[2:0]", "word[47:0]", "ready"].map(|field| format!("processors_0_request_{field}"));
    assert_eq!(shown[1..6], fields, "a record, field by field");
    for instance in ["u_lfb[0]", "u_lfb[1]"] {
        assert!(wave.contains(&format!("$scope begin {instance} $end\n")), "{instance} of an array of instances");
    }
    assert_eq!(shown[6], "processors_0_state_state", "states by name");
    let code = wave.lines().find_map(|line| line.strip_suffix(" processors_0_state_state $end")).unwrap();
    let code = code.rsplit(' ').next().unwrap();
    for state in ["Clear", "Draw"] {
        assert!(wave.contains(&format!("\ns{state} {code}\n")), "{state}");
    }
}
