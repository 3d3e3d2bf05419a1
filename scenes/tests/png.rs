//! PNG files: written whole or not at all, and read back.

use std::fs;
use std::path::PathBuf;
use tilewright_scenes::{Frame, SceneError, Size, compare_colours, write_whole};

/// A new, empty folder for one test.
fn folder(test: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("png_{test}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn picture() -> Frame {
    let size = Size::new(31, 17).unwrap();
    let words = (0..size.pixels() as u64).map(|i| (i * 0x1_0203_0507) & 0xffff_ffff_ffff).collect();
    Frame::from_words(size, words).unwrap()
}

fn names(path: &PathBuf) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_frame_comes_back_with_its_colours() {
    let path = folder("round_trip").join("frame.png");
    picture().write_png(&path).unwrap();
    let back = Frame::read_png(&path).unwrap();
    assert!(compare_colours(&picture(), &back).is_equal());
    assert_eq!(back.depth(3, 3), 0xff_ffff);
}

#[test]
fn an_old_file_is_replaced_and_nothing_is_left_beside_it() {
    let folder = folder("replace");
    let path = folder.join("frame.png");
    fs::write(&path, "old").unwrap();
    picture().write_png(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), picture().to_png());
    assert_eq!(names(&folder), ["frame.png"]);
}

#[test]
fn a_failed_write_leaves_nothing_behind() {
    let folder = folder("failed");
    let path = folder.join("a_folder");
    fs::create_dir(&path).unwrap();
    let error = picture().write_png(&path).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}: cannot be written (is a directory): name a file in that folder", path.display())
    );
    let missing = folder.join("nowhere/frame.png");
    let error = picture().write_png(&missing).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "{}: cannot be written (no such file or directory): make the folder `{}` first",
            missing.display(),
            folder.join("nowhere").display()
        )
    );
    // Here the bytes are written aside, and only taking the name fails.
    assert!(picture().write_png(folder.join("frame.png/")).is_err());
    assert_eq!(names(&folder), ["a_folder"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_device_is_reported() {
    let error = picture().write_png("/dev/full").unwrap_err();
    assert_eq!(
        error.to_string(),
        "/dev/full: cannot be written (no space left on device): make room, or choose another disk"
    );
    write_whole("/dev/null".as_ref(), b"swallowed").unwrap();
}

#[test]
#[cfg(unix)]
fn a_link_stays_a_link() {
    let folder = folder("link");
    fs::write(folder.join("real.png"), "old").unwrap();
    std::os::unix::fs::symlink("real.png", folder.join("link.png")).unwrap();
    picture().write_png(folder.join("link.png")).unwrap();
    assert!(folder.join("link.png").is_symlink());
    assert_eq!(fs::read(folder.join("real.png")).unwrap(), picture().to_png());
}

#[test]
fn a_file_that_is_no_sound_png_is_refused_in_plain_words() {
    let folder = folder("not_a_png");
    let path = folder.join("frame.png");
    let sentence = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let error = Frame::read_png(&path).unwrap_err();
        assert!(matches!(error, SceneError::File { .. }), "{error:?}");
        error.to_string().replace(&format!("{}/", folder.display()), "")
    };
    let sound = picture().to_png();
    for no_png in [b"GIF89a".as_slice(), b"", &sound[..7], &sound[1..]] {
        assert_eq!(sentence(no_png), "frame.png: is not a PNG file: name a PNG file");
    }
    let damaged = "frame.png: is a damaged PNG file: make it again, or name another";
    for length in [8, 30, sound.len() / 2, sound.len() - 20] {
        assert_eq!(sentence(&sound[..length]), damaged, "cut to {length} bytes");
    }
    // The type of the first chunk, then its checksum, then the compressed colours.
    for place in [13, 30, 60] {
        let mut bytes = sound.clone();
        bytes[place] ^= 0x10;
        assert_eq!(sentence(&bytes), damaged, "byte {place} changed");
    }
}

/// The size is in the head, so the rest is not decoded.
#[test]
fn a_picture_that_is_larger_than_a_frame_is_refused() {
    let path = folder("large").join("frame.png");
    let sentence = |width: u32, height: u32| {
        fs::write(&path, head(width, height)).unwrap();
        Frame::read_png(&path).unwrap_err().to_string()
    };
    for (width, height) in [(2049, 1), (1, 2049), (60_000, 60_000)] {
        let expected =
            format!("holds {width}x{height} pixels, and a frame has at most 2048x2048: name a smaller picture");
        let got = sentence(width, height);
        assert!(got.ends_with(&expected), "{got}");
    }
    assert!(sentence(2048, 2048).contains("is a damaged PNG file"));
}

/// A PNG file that ends where its colours would begin.
fn head(width: u32, height: u32) -> Vec<u8> {
    let mut chunk = b"IHDR".to_vec();
    chunk.extend(width.to_be_bytes());
    chunk.extend(height.to_be_bytes());
    chunk.extend([8, 2, 0, 0, 0]);
    let checksum = crc(&chunk);
    [b"\x89PNG\r\n\x1a\n\0\0\0\x0d", &*chunk, &checksum.to_be_bytes(), b"\0\0\0\0IDAT\x35\xaf\x06\x1e"].concat()
}

/// The checksum of a chunk, as the PNG specification has it.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}
