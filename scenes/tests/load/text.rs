//! Quotes from a file are short and harmless, and a file in another encoding is reported as such.

use crate::load::{TRIANGLE, folder, load, obj_error, toml_error};
use std::fs;

/// Takes the title of a terminal's window, in terminals that let it.
const TITLE: &str = "\u{1b}]0;owned\u{7}";

#[test]
fn no_control_character_of_a_file_reaches_a_message() {
    let mesh = [
        format!("{TITLE} 1 2 3\n"),
        format!("v 0 {TITLE} 0\n"),
        format!("v 0 0 0\nf 1 1 {TITLE}\n"),
        format!("{TRIANGLE}usemtl {TITLE}\nf 1 2 3\n"),
        format!("mtllib {TITLE}.mtl\n{TRIANGLE}"),
    ];
    for (i, text) in mesh.iter().enumerate() {
        let folder = folder(&format!("title_{i}"), &[("mesh.obj", text)]);
        let said = load(&folder.join("mesh.obj")).map_or_else(|error| error, |scene| scene.warnings.concat());
        assert!(said.contains("\\u{1b}]0;owned\\u{7}"), "{said}");
        assert!(!said.contains(char::is_control), "{said:?}");
    }
    let scenes = [
        "\"\\u001b]0;owned\\u0007\" = 1\nmesh = 'teapot'\n",
        "mesh = \"\\u001b]0;owned\\u0007\"\n",
        "mesh = \"\\u001b]0;owned\\u0007.obj\"\n",
        "mesh = 'teapot'\nsize = \"\\u001b]0;owned\\u0007\"\n",
    ];
    for (i, text) in scenes.iter().enumerate() {
        let said = toml_error(&format!("toml_title_{i}"), text);
        assert!(said.contains("\\u{1b}]0;owned\\u{7}"), "{said}");
        assert!(!said.contains(char::is_control), "{said:?}");
    }
}

#[test]
fn long_words_are_cut_short() {
    let long = "x".repeat(1 << 20);
    let texts = [format!("{long} 1\n"), format!("v 0 {long} 0\n"), format!("v 0 0 0\nf 1 1 {long}\n")];
    for (i, text) in texts.iter().enumerate() {
        let said = obj_error(&format!("long_{i}"), text);
        assert!(said.len() < 300 && said.contains(&format!("`{}…`", "x".repeat(60))), "{said}");
    }
    let named = [format!("mtllib {long}.mtl\n{TRIANGLE}"), format!("usemtl {long}\n{TRIANGLE}")];
    for (i, text) in named.iter().enumerate() {
        let folder = folder(&format!("long_name_{i}"), &[("mesh.obj", text)]);
        let said = load(&folder.join("mesh.obj")).map_or_else(|error| error, |scene| scene.warnings.concat());
        assert!(said.len() < 5000, "{} bytes", said.len());
    }
    let scenes = [
        format!("{long} = 1\nmesh = 'teapot'\n"),
        format!("mesh = '{long}'\n"),
        format!("mesh = '{long}.obj'\n"),
        format!("mesh = 'teapot'\nsize = ', expected {long}'\n"),
    ];
    for (i, text) in scenes.iter().enumerate() {
        let said = toml_error(&format!("long_toml_{i}"), text);
        assert!(said.len() < 5000, "{} bytes", said.len());
    }
    assert!(load(long.as_ref()).unwrap_err().len() < 300);
}

#[test]
fn text_in_another_encoding_is_named_as_such() {
    let folder = folder("encoding", &[("sound.obj", TRIANGLE)]);
    let sentence = |name: &str, bytes: &[u8]| {
        fs::write(folder.join(name), bytes).unwrap();
        load(&folder.join(name)).unwrap_err().replace(&format!("{}/", folder.display()), "")
    };
    let utf16 =
        |text: &str, mark: &[u8]| [mark, &text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>()].concat();
    let scene = "mesh = 'teapot'\nsize = [8, 8]\n";
    for (name, text) in [("mesh.obj", TRIANGLE), ("scene.toml", scene)] {
        assert_eq!(sentence(name, &utf16(text, &[0xff, 0xfe])), format!("{name}: is text in UTF-16: save it in UTF-8"));
        assert_eq!(
            sentence(name, &utf16(text, &[])),
            format!("{name}: holds a zero byte, as UTF-16 and files that are no text do: save it as text in UTF-8")
        );
    }
    assert_eq!(
        sentence("scene.toml", scene.replace('\n', "\r").as_bytes()),
        "scene.toml: ends its lines with CR alone: save it with LF or CR LF at the ends of lines"
    );
    fs::write(folder.join("mac.obj"), TRIANGLE.replace('\n', "\r")).unwrap();
    assert_eq!(load(&folder.join("mac.obj")).unwrap().mesh, load(&folder.join("sound.obj")).unwrap().mesh);
    let material = utf16("newmtl a\n", &[0xff, 0xfe]);
    fs::write(folder.join("colours.mtl"), material).unwrap();
    let mesh = format!("mtllib colours.mtl\n{TRIANGLE}");
    assert_eq!(sentence("mesh.obj", mesh.as_bytes()), "colours.mtl: is text in UTF-16: save it in UTF-8");
    // A stray CR inside a comment is harmless.
    fs::write(folder.join("mesh.obj"), format!("# a\rb\n{TRIANGLE}")).unwrap();
    assert!(load(&folder.join("mesh.obj")).is_ok());
}
