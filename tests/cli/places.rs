//! What an output may be written over, and what not.
#![cfg(unix)]

use crate::cli::harness::{Folder, Waveform};
use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::process::Command;

const OBJ: &str = "mtllib m.mtl\nv -1 0 -1\nv 1 0 -1\nv 0 1.5 0\nusemtl red\nf 1 2 3\n";

const MTL: &str = "newmtl red\nKd 1 0 0\n";

const WAVE: &str = "wave merging-unit -o";

/// A scene file, its mesh and the mesh's materials, with more names of each.
fn scene() -> Folder {
    let folder = Folder::with(&[("s.toml", "mesh = \"m.obj\"\nsize = [16, 12]\n"), ("m.obj", OBJ), ("m.mtl", MTL)]);
    fs::hard_link(folder.path("s.toml"), folder.path("hard.toml")).unwrap();
    symlink("m.obj", folder.path("soft.obj")).unwrap();
    folder
}

#[test]
fn no_output_replaces_a_file_that_is_read() {
    let folder = scene();
    let names = ["s.toml", "hard.toml", "m.obj", "./m.obj", "soft.obj", "m.mtl"];
    for name in names {
        let mut lines = vec![format!("golden s.toml -o {name}"), format!("render s.toml --processors 1 --vcd {name}")];
        lines.push(format!("render s.toml --processors 1 -o {name}"));
        if name.contains("m.") {
            lines.push(format!("golden m.obj --size 16x12 -o {name}"));
        }
        for line in lines {
            let run = folder.run(&line);
            assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {run:?}");
            assert!(run.stderr.starts_with(&format!("error: {name}: would be written over ")), "{line}: {run:?}");
            assert!(run.stderr.contains(", which is read: name another output"), "{line}: {run:?}");
        }
    }
    assert_eq!((folder.read("m.obj"), folder.read("m.mtl")), (OBJ.to_owned(), MTL.to_owned()));
    assert!(folder.read("hard.toml").starts_with("mesh = "));
    assert_eq!(folder.names(), ["hard.toml", "m.mtl", "m.obj", "s.toml", "soft.obj"]);
}

#[test]
fn two_outputs_are_not_one_file_under_two_names() {
    let folder = scene();
    fs::write(folder.path("a"), "old").unwrap();
    fs::hard_link(folder.path("a"), folder.path("hard")).unwrap();
    symlink("a", folder.path("soft")).unwrap();
    symlink("nothing", folder.path("dangling")).unwrap();
    for (one, other) in [("a", "hard"), ("soft", "a"), ("dangling", "./nothing"), ("-", "-"), ("-", "/dev/stdout")] {
        let line = format!("render s.toml --processors 1 -o {one} --vcd {other}");
        let run = folder.run(&line);
        assert_eq!(run.code, Some(2), "{line}: {run:?}");
        assert!(run.stderr.contains(", another output: name another file"), "{line}: {run:?}");
    }
    assert_eq!(folder.read("a"), "old");
    assert!(!folder.path("nothing").exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_plain_file_below_dev_is_a_plain_file() {
    let Ok(shared) = tempfile::TempDir::new_in("/dev/shm") else {
        println!("skipped: /dev/shm is not there");
        return;
    };
    let at = |name: &str| shared.path().join(name).display().to_string();
    let folder = Folder::new();
    let small = "golden teapot --size 16x12 -o";
    folder.stdout(&format!("{small} small.png"));
    fs::write(at("a.png"), vec![b'x'; 100_000]).unwrap();
    folder.stdout(&format!("{small} {}", at("a.png")));
    assert_eq!(fs::read(at("a.png")).unwrap(), fs::read(folder.path("small.png")).unwrap());

    fs::write(at("s.obj"), OBJ).unwrap();
    let run = folder.run(&format!("golden {} -o {}", at("s.obj"), at("s.obj")));
    assert!(run.code == Some(2) && run.stderr.contains("which is read"), "{run:?}");
    assert_eq!(fs::read_to_string(at("s.obj")).unwrap(), OBJ);
    let run = folder.run(&format!("render teapot --size 16x12 -o {} --vcd {}", at("x"), at("x")));
    assert!(run.code == Some(2) && run.stderr.contains("another output"), "{run:?}");

    folder.stdout(&format!("{WAVE} {}", at("w.vcd")));
    assert!(shared.path().join("w.gtkw").exists(), "no save file");
}

#[test]
fn a_save_file_of_somebody_else_stays() {
    let folder = Folder::new();
    let theirs = "[*] GTKWave Analyzer v3.3.104 (w)1999-2020 BSI\n";
    fs::write(folder.path("x.gtkw"), theirs).unwrap();
    let run = folder.run(&format!("{WAVE} x.vcd"));
    assert_eq!((run.code, folder.read("x.gtkw").as_str()), (Some(0), theirs), "{run:?}");
    assert!(run.stderr.contains("warning: x.gtkw was not written by tilewright and is kept"), "{run:?}");
    assert_eq!(run.stdout, "gtkwave x.vcd x.gtkw\nsurfer -c x.sucl x.vcd\n");
    // Our own is written again.
    fs::remove_file(folder.path("x.gtkw")).unwrap();
    folder.stdout(&format!("{WAVE} x.vcd"));
    let ours = folder.read("x.gtkw");
    fs::write(folder.path("x.gtkw"), "[*] Tilewright\nold\n").unwrap();
    folder.stdout(&format!("{WAVE} x.vcd"));
    assert_eq!(folder.read("x.gtkw"), ours);
    // Surfer's is kept, too.
    assert!(folder.read("x.sucl").starts_with("# Tilewright\nvariable_add "));
    fs::write(folder.path("x.sucl"), "zoom_fit\n").unwrap();
    let run = folder.run(&format!("{WAVE} x.vcd"));
    assert!(run.code == Some(0) && run.stderr.contains("warning: x.sucl was not written by tilewright"), "{run:?}");
    assert_eq!(folder.read("x.sucl"), "zoom_fit\n");
}

#[test]
fn a_link_that_points_nowhere_is_followed() {
    let folder = Folder::new();
    fs::create_dir(folder.path("there")).unwrap();
    symlink("there/frame.png", folder.path("link.png")).unwrap();
    symlink("there/run.vcd", folder.path("link.vcd")).unwrap();
    folder.stdout("golden teapot --size 16x12 -o link.png");
    folder.stdout(&format!("{WAVE} link.vcd"));
    assert!(folder.path("link.png").is_symlink() && folder.path("link.vcd").is_symlink());
    assert!(folder.path("there/frame.png").is_file(), "the link was replaced");
    Waveform::read(&folder.path("there/run.vcd"));
    symlink("none/frame.png", folder.path("lost.png")).unwrap();
    assert_eq!(folder.run("golden teapot --size 16x12 -o lost.png").code, Some(3));
}

#[test]
fn permissions_and_owner_of_a_replaced_file_stay() {
    let folder = Folder::new();
    for (name, line) in [("x.png", "golden teapot --size 16x12 -o x.png"), ("x.vcd", "wave merging-unit -o x.vcd")] {
        let path = folder.path(name);
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        let is_root = Command::new("chown").arg("1234:4321").arg(&path).status().unwrap().success();
        let before = fs::metadata(&path).unwrap();
        folder.stdout(line);
        let after = fs::metadata(&path).unwrap();
        assert_eq!((after.mode(), after.uid(), after.gid()), (before.mode(), before.uid(), before.gid()), "{name}");
        assert!(after.len() > 100, "{name}");
        if !is_root {
            println!("skipped: only root can give {name} another owner");
        }
    }
    // A new file gets what the user's mask leaves.
    let run = folder.shell("umask 027; tilewright golden teapot --size 16x12 -o new.png");
    assert_eq!((run.code, fs::metadata(folder.path("new.png")).unwrap().mode() & 0o777), (Some(0), 0o640), "{run:?}");
}

#[test]
fn a_name_may_be_as_long_as_the_system_allows() {
    let folder = Folder::new();
    let name = format!("{}.png", "n".repeat(251));
    folder.stdout(&format!("golden teapot --size 16x12 -o {name}"));
    assert_eq!(folder.names(), [name]);
}

#[test]
fn a_place_is_tried_before_the_work_is_done() {
    let folder = Folder::with(&[("file.png", "old"), ("read_only.png", "old")]);
    fs::set_permissions(folder.path("read_only.png"), fs::Permissions::from_mode(0o444)).unwrap();
    fs::create_dir(folder.path("locked")).unwrap();
    fs::set_permissions(folder.path("locked"), fs::Permissions::from_mode(0o555)).unwrap();
    let mut places = vec!["x.png/", "file.png/", "read_only.png"];
    if fs::write(folder.path("locked/try"), "").is_err() {
        places.push("locked/x.png");
    } else {
        println!("skipped: root may write everywhere");
    }
    if cfg!(target_os = "linux") {
        places.push("/proc/x.png");
    }
    for place in places {
        for option in ["-o", "--vcd"] {
            // The run itself would fail otherwise, for want of pages.
            let run = folder.run(&format!("render teapot --size 64x48 --pages 3 {option} {place}"));
            assert_eq!((run.code, run.stdout.as_str()), (Some(3), ""), "{place}: {run:?}");
            assert!(run.stderr.starts_with(&format!("error: {place}: cannot be written (")), "{place}: {run:?}");
        }
    }
    fs::set_permissions(folder.path("locked"), fs::Permissions::from_mode(0o755)).unwrap();
    assert_eq!((folder.read("file.png"), folder.read("read_only.png")), ("old".to_owned(), "old".to_owned()));
}

#[test]
fn a_command_that_fails_leaves_an_old_waveform_and_makes_none() {
    let folder = Folder::with(&[("old.vcd", "old")]);
    for name in ["old.vcd", "new.vcd"] {
        for line in
            [format!("{WAVE} {name} --scope nothing.*"), format!("render teapot --vcd {name} --scope nothing.*")]
        {
            assert_eq!(folder.run(&line).code, Some(2), "{line}");
        }
    }
    assert_eq!((folder.names(), folder.read("old.vcd")), (vec!["old.vcd".to_owned()], "old".to_owned()));
}
