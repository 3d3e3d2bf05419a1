//! Outputs: the kinds of paths, and files that appear completely or not at all.
#![cfg(unix)]

use std::fs::{self, Permissions};
use std::io::ErrorKind;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use tempfile::TempDir;
use tilewright_scenes::{Place, Scene, SceneError, WholeFile};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// The problem with an output at that path.
#[track_caller]
fn problem(path: &Path) -> String {
    let text = Place::of(path).unwrap_err().to_string();
    text.strip_prefix(&format!("{}: cannot be written ", path.display())).unwrap().to_owned()
}

#[test]
fn a_file_appears_with_the_last_step_and_replaces_another_then() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a");
    for before in [None, Some("old, and longer than what comes")] {
        if let Some(old) = before {
            fs::write(&path, old).unwrap();
        }
        let mut file = WholeFile::at(&path).unwrap();
        file.fill(b"new").unwrap();
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), before);
        if cfg!(target_os = "linux") {
            // So a run that is killed here leaves nothing behind.
            assert_eq!(names(folder.path()).len(), usize::from(before.is_some()));
        }
        drop(file);
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), before);
        let mut file = WholeFile::at(&path).unwrap();
        file.fill(b"new").unwrap();
        file.commit().unwrap();
        assert_eq!((names(folder.path()), fs::read(&path).unwrap()), (vec!["a".to_owned()], b"new".to_vec()));
        fs::remove_file(&path).unwrap();
    }
}

#[test]
fn permissions_are_those_of_the_file_that_was_there() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a");
    fs::write(&path, "old").unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o604)).unwrap();
    tilewright_scenes::write_whole(&path, b"new").unwrap();
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o604);
    // A new one is like those that others make here.
    for name in ["new", "others"] {
        match name {
            "new" => tilewright_scenes::write_whole(&folder.path().join(name), b"new").unwrap(),
            _ => fs::write(folder.path().join(name), "new").unwrap(),
        }
    }
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
    assert_eq!(mode("new"), mode("others"));
}

#[test]
fn a_place_is_a_stream_or_the_file_behind_all_links() {
    let folder = TempDir::new().unwrap();
    let real = folder.path().canonicalize().unwrap();
    fs::create_dir(real.join("there")).unwrap();
    fs::write(real.join("there/file"), "").unwrap();
    symlink("there/file", real.join("link")).unwrap();
    symlink("there/new", real.join("dangling")).unwrap();
    symlink("dangling", real.join("twice")).unwrap();
    let file = |name: &str| Place::File(real.join(name));
    let cases = [("there/file", "there/file"), ("there/../a", "a"), ("./a", "a")];
    let links = [("link", "there/file"), ("dangling", "there/new"), ("twice", "there/new")];
    for (name, behind) in cases.into_iter().chain(links) {
        assert_eq!(Place::of(&real.join(name)).unwrap(), file(behind), "{name}");
    }
    assert_eq!(Place::of(Path::new("/dev/null")).unwrap(), Place::Stream);
}

#[test]
fn a_place_that_cannot_be_written_is_named_with_a_remedy() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("file"), "").unwrap();
    fs::write(at("locked"), "").unwrap();
    fs::set_permissions(at("locked"), Permissions::from_mode(0o444)).unwrap();
    symlink("round", at("round")).unwrap();
    let is_folder = "(is a directory): name a file in that folder";
    for name in ["", "new/", "file/", "new/.", "new/.."] {
        assert_eq!(problem(&at(name)), is_folder, "{name}");
    }
    assert_eq!(problem(&at("locked")), "(permission denied): choose a place that you may write to");
    let missing = format!("(no such file or directory): make the folder `{}` first", at("none").display());
    assert_eq!(problem(&at("none/a")), missing);
    let no_folder = format!("(not a directory): `{}` is no folder: name a file in one", at("file").display());
    assert_eq!(problem(&at("file/a")), no_folder);
    assert!(problem(&at("round")).ends_with(": choose another place"));
    assert_eq!(Place::of(Path::new("")).unwrap_err().to_string(), format!(": cannot be written {is_folder}"));
}

#[test]
fn a_disk_that_takes_no_more_has_a_remedy() {
    let problem = |kind: ErrorKind| SceneError::unwritable(Path::new("a"), &kind.into()).to_string();
    assert_eq!(
        problem(ErrorKind::StorageFull),
        "a: cannot be written (no storage space): make room, or choose another disk"
    );
    assert_eq!(
        problem(ErrorKind::FileTooLarge),
        "a: cannot be written (file too large): allow larger files (`ulimit -f`), or choose another disk"
    );
}

#[test]
fn a_scene_knows_its_files() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("s.toml"), "mesh = \"m.obj\"\n").unwrap();
    fs::write(at("m.obj"), "mtllib m.mtl\nmtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    fs::write(at("m.mtl"), "newmtl a\n").unwrap();
    assert_eq!(Scene::load(at("s.toml")).unwrap().files, [at("s.toml"), at("m.obj"), at("m.mtl")]);
    assert_eq!(Scene::load(at("m.obj")).unwrap().files, [at("m.obj"), at("m.mtl")]);
    fs::write(at("b.toml"), "mesh = \"teapot\"\n").unwrap();
    assert_eq!(Scene::load(at("b.toml")).unwrap().files, [at("b.toml")]);
    assert!(Scene::load("teapot").unwrap().files.is_empty());
}
