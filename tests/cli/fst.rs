//! A waveform whose name ends in `.fst`.

use crate::cli::harness::Folder;
use std::path::Path;

/// The names of the variables of a waveform, each with its changes, as Surfer reads it.
fn read(path: &Path) -> Vec<(String, Vec<(u64, String)>)> {
    let mut file = wellen::simple::read(path).unwrap();
    let signals: Vec<_> = file.hierarchy().all_vars().map(|name| file.hierarchy()[name].signal_ref()).collect();
    file.load_signals(&signals);
    let variable = |name| {
        let variable: &wellen::Var = &file.hierarchy()[name];
        let changes = file.get_signal(variable.signal_ref()).unwrap().iter_changes();
        let changes = changes.map(|(at, value)| (file.time_table()[at as usize], value.to_string()));
        (variable.full_name(file.hierarchy()), changes.collect())
    };
    file.hierarchy().all_vars().map(variable).collect()
}

#[test]
fn a_waveform_as_fst_has_what_it_has_as_vcd() {
    let folder = Folder::with_pyramid();
    for (line, scope) in [
        ("wave image-merger --set units=4 -o", "--scope u_merging_unit[1].** --from 0.4us --to 800ns"),
        ("wave gfb-unit --set width=64 --set height=64 -o", ""),
        ("render pyramid.obj --size 16x12 --processors 1 --vcd", "--scope u_gfb.*"),
    ] {
        for name in ["a.vcd", "a.fst", "b.FST"] {
            folder.stdout(&format!("{line} {name} {scope}"));
        }
        let shown = read(&folder.path("a.fst"));
        assert!(shown.len() > 5 && shown == read(&folder.path("a.vcd")), "{line}");
        assert!(std::fs::read(folder.path("a.fst")).unwrap() == std::fs::read(folder.path("b.FST")).unwrap(), "{line}");
    }
    let lines = "gtkwave mu.fst mu.gtkw\nsurfer -c mu.sucl mu.fst\n";
    assert_eq!(folder.stdout("wave merging-unit -o mu.fst"), lines);
    let save = folder.read("mu.gtkw");
    folder.stdout("wave merging-unit -o mu.vcd");
    assert_eq!(save.replace("\"mu.fst\"", "\"mu.vcd\""), folder.read("mu.gtkw"));
}

/// Surfer finds a variable by the names that its reader has. Of a code it is to show the name.
#[test]
fn a_command_file_adds_variables_by_the_names_that_surfer_reads() {
    let folder = Folder::new();
    for (line, suffix) in [
        ("wave lifo --memory words", ".words.[1]"),
        ("wave vector-registers --memory registers", ".registers.[1].[2]"),
        ("wave patch-table --scope **", ""),
        ("wave image-merger --set units=2 --scope u_merging_unit[1].**", ".lane."),
    ] {
        let added = |name: &str| {
            folder.stdout(&format!("{line} -o {name}"));
            let (text, shown) = (folder.read("x.sucl"), read(&folder.path(name)));
            let names: Vec<String> = shown.into_iter().map(|(name, _)| name).collect();
            let lines: Vec<&str> = text.lines().collect();
            let ["# Tilewright", variables @ .., "zoom_fit"] = &lines[..] else { panic!("{text}") };
            let added: Vec<_> =
                variables.iter().map(|line| line.strip_prefix("variable_add ").unwrap().to_owned()).collect();
            assert!(added.len() > 5 && added.iter().all(|name| names.contains(name)), "{line}: {text}\n{names:?}");
            assert!(added.iter().any(|name| name.contains(suffix)), "{line}: {text}");
            added
        };
        let names = added("x.vcd");
        assert_eq!(names, added("x.fst"), "{line}");
        let states = names.iter().filter_map(|name| name.strip_suffix("_state"));
        assert!(states.clone().all(|number| !names.iter().any(|name| name == number)), "{line}");
        assert!(!line.contains("patch-table") || states.count() > 0, "{line}");
    }
}

/// The names of words are those of `why`.
#[test]
fn words_of_memories_are_in_a_waveform_if_it_is_asked_for_them() {
    let folder = Folder::new();
    let named = |name: &str| {
        let shown = read(&folder.path(name));
        let words = shown.into_iter().filter(|(name, _)| name.contains("words."));
        words.map(|(name, changes)| (name, changes.len())).collect::<Vec<_>>()
    };
    folder.stdout("wave lifo -o without.fst");
    assert_eq!(named("without.fst"), []);
    folder.stdout("wave lifo -o with.fst --memory words[1..3]");
    folder.stdout("wave lifo -o with.vcd --memory *[1..3]");
    let names: Vec<String> = named("with.fst").into_iter().map(|(name, _)| name).collect();
    // Surfer's reader makes an array of them.
    let below: Vec<_> = names.iter().map(|name| name.split_once('.').unwrap().1.replace(".[", "[")).collect();
    assert_eq!(below, ["words[1]", "words[2]"]);
    assert!(named("with.fst") == named("with.vcd") && named("with.fst").iter().any(|(_, changes)| *changes > 1));
    for word in below {
        assert!(folder.stdout(&format!("why lifo --signal {word} --depth 0")).starts_with(&format!("{word} = ")));
    }
    for (arguments, sentence) in [
        ("lifo -o x.vcd --memory word", "error: there is no memory that matches `word`: did you mean `words`?\n"),
        ("lifo -o x.vcd --memory words[3..1]", "give the first address, and the one after the last"),
        ("lifo --memory words", "--memory, --from and --to are for a waveform file: name it with -o FILE"),
        ("lifo -o x.svg --memory words", "leave out --scope and --memory"),
        ("ram --set depth=8192 -o x.vcd --memory words[0]", "and the limit is 4096: name fewer memories or addresses"),
    ] {
        let run = folder.run(&format!("wave {arguments}"));
        assert!(run.code == Some(2) && run.stderr.contains(sentence), "{arguments}: {run:?}");
    }
    assert_eq!(
        folder.names(),
        ["with.fst", "with.gtkw", "with.sucl", "with.vcd", "without.fst", "without.gtkw", "without.sucl"]
    );
}

#[test]
#[cfg(target_os = "linux")]
fn a_pipe_gets_the_same_bytes_and_a_full_disk_is_no_success() {
    let folder = Folder::new();
    folder.stdout("wave gfb-unit -o plain.fst");
    let line = "mkfifo pipe.fst; cat pipe.fst > read & timeout 60 tilewright wave gfb-unit -o pipe.fst; wait";
    assert_eq!(folder.shell(line).stderr, "wrote pipe.fst\n");
    assert!(std::fs::read(folder.path("read")).unwrap() == std::fs::read(folder.path("plain.fst")).unwrap());

    std::os::unix::fs::symlink("/dev/full", folder.path("full.fst")).unwrap();
    let run = folder.run("wave gfb-unit -o full.fst");
    assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{run:?}");
    assert!(run.stderr.starts_with("error: full.fst: cannot be written (no space left on device)"), "{run:?}");

    // No file may grow beyond 8 KiB or so; the signal that would end the program is ignored.
    let line = "wave gfb-unit --set width=64 --set height=64 -o big.fst";
    let run = folder.shell(&format!("trap '' XFSZ; ulimit -f 16; tilewright {line}"));
    assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{run:?}");
    assert!(run.stderr.starts_with("error: big.fst: cannot be written (file too large)"), "{run:?}");
    // Its signals are there, and their first values.
    let shown = read(&folder.path("big.fst"));
    assert!(shown.len() > 5 && shown.iter().all(|(_, changes)| changes.len() == 1), "{shown:?}");
    // So they are, without a value, if the run ends before the waveform begins.
    folder.run("wave gfb-unit -o late.fst --from 5s");
    let shown = read(&folder.path("late.fst"));
    assert!(shown.len() > 5 && shown.iter().all(|(_, changes)| changes.is_empty()), "{shown:?}");
}
