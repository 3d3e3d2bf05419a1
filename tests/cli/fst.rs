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
    assert_eq!(folder.stdout("wave merging-unit -o mu.fst"), "gtkwave mu.fst mu.gtkw\nsurfer mu.fst\n");
    let save = folder.read("mu.gtkw");
    folder.stdout("wave merging-unit -o mu.vcd");
    assert_eq!(save.replace("\"mu.fst\"", "\"mu.vcd\""), folder.read("mu.gtkw"));
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
