//! Textures and highlights of OBJ and scene files: good ones, and every bad one with its whole sentence.

use crate::load::{TRIANGLE, folder, load, toml_error};
use glam::dvec2;
use std::fs;
use std::path::Path;
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::{Frame, Material, Scene, Size, Texture, frame, golden};

/// A square with texture coordinates; one face has none.
const SQUARE: &str = "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 3 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                      usemtl tiles\nf 1/1 2/2 3/3 4/4\nf 4 3 5\nusemtl wax\nf 1/1 2/2 3/3\n";
const MATERIALS: &str =
    "newmtl tiles\nKd 1 1 1\nKs 0.1 0.5 0.2\nNs 60\nmap_Kd my tiles.png\nnewmtl wax\nKd 1 0 0\nNs 3\nmap_Ks x\n";

/// The warnings about them.
fn said(folder: &Path) -> [String; 2] {
    let at = |name: &str| folder.join(name).display().to_string();
    [
        format!(
            "{}:3: `map_Ks` and the hue of `Ks` of this material and 1 more are not drawn: a surface has a colour (Kd), a texture \
             (map_Kd) and white highlights (Ks, Ns)",
            at("square.mtl")
        ),
        format!(
            "{}:13: this face has no texture coordinates, so the texture of its material is not drawn on it: export the mesh with \
             them (`vt`)",
            at("square.obj")
        ),
    ]
}

/// Writes a picture of two rows: red, green; blue, white.
fn write_tiles(path: &Path) {
    let mut picture = Frame::blank(Size::new(2, 2).unwrap(), [255; 3]);
    for (word, rgb) in picture.words.iter_mut().zip([[255, 0, 0], [0, 255, 0], [0, 0, 255]]) {
        *word = frame::blank(rgb);
    }
    picture.write_png(path).unwrap();
}

fn small(scene: &Scene) -> Result<Frame, String> {
    let deferred = project_deferred(scene, Size::new(32, 24).unwrap(), Samples::One);
    deferred.map(|deferred| golden::render_deferred(&deferred)).map_err(|error| error.to_string())
}

#[test]
fn materials_have_textures_and_highlights() {
    let folder = folder("textures", &[("square.obj", SQUARE), ("square.mtl", MATERIALS)]);
    write_tiles(&folder.join("my tiles.png"));
    let scene = load(&folder.join("square.obj")).unwrap();
    assert_eq!(scene.warnings, said(&folder));
    assert_eq!(scene.files, ["square.obj", "square.mtl", "my tiles.png"].map(|name| folder.join(name)));
    let materials = scene.mesh.materials().unwrap();
    let of = |triangle: usize| materials.materials[materials.mappings[triangle].material as usize];
    let tiles = Material { texture: Some(0), specular: 0.5, shininess: 64 };
    assert_eq!([of(0), of(1)], [tiles; 2]);
    // Without texture coordinates there is no texture.
    assert_eq!(of(2), Material { texture: None, ..tiles });
    assert_eq!(of(3), Material { texture: None, specular: 0.25, shininess: 4 });
    let corners = materials.mappings[1].coordinates.map(|i| materials.coordinates[i as usize]);
    assert_eq!(corners, [dvec2(0.0, 0.0), dvec2(1.0, 1.0), dvec2(0.0, 1.0)]);
    // The lower row of the picture is where v is least.
    let texture = materials.textures[0].as_ref().unwrap();
    let texel = |i, j| texture.texel(1, i, j);
    let colours = [[0, 0, 255], [255, 255, 255], [255, 0, 0], [0, 255, 0]];
    assert_eq!([texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)], colours);
    assert!(small(&scene).is_ok());
}

#[test]
fn a_texture_is_seen_where_its_coordinates_say() {
    let mesh = SQUARE.replace("f 4 3 5\nusemtl wax\nf 1/1 2/2 3/3\n", "");
    let scene = "mesh = 'square.obj'\nsize = [32, 32]\nambient = 1\nlight = []\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov = 24\n\
                 [surface]\nspecular = 0\n";
    let folder = folder("seen", &[("square.obj", &mesh), ("square.mtl", MATERIALS), ("scene.toml", scene)]);
    write_tiles(&folder.join("my tiles.png"));
    let scene = load(&folder.join("scene.toml")).unwrap();
    let frame = golden::render_deferred(&project_deferred(&scene, scene.size, Samples::One).unwrap());
    // In the middle of each quarter, to the rounding of the texture coordinates.
    let seen = [(9, 9), (22, 9), (9, 22), (22, 22)].map(|(x, y)| frame.rgb(x, y).map(|channel| (channel / 128) * 255));
    assert_eq!(seen, [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]]);
}

#[test]
fn a_mesh_whose_materials_say_nothing_of_it_has_none() {
    let folder =
        folder("plain", &[("m.obj", &format!("mtllib m.mtl\nusemtl a\n{TRIANGLE}")), ("m.mtl", "newmtl a\nKd 1\n")]);
    let scene = load(&folder.join("m.obj")).unwrap();
    assert!(scene.mesh.materials().is_none());
    assert!(small(&scene).is_ok());
}

/// A texture's error does not affect anything that needs no texture.
#[test]
fn a_bad_texture_is_an_error_of_deferred_shading_alone() {
    let folder = folder("bad_texture", &[("square.obj", SQUARE), ("text.png", "no picture"), ("large.png", "")]);
    let picture = |name: &str, width, height| {
        let blank = Frame::blank(Size::new(width, height).unwrap(), [9; 3]);
        blank.write_png(folder.join(name)).unwrap();
    };
    picture("whole.png", 16, 16);
    fs::write(folder.join("half.png"), &fs::read(folder.join("whole.png")).unwrap()[..40]).unwrap();
    fs::File::options().write(true).open(folder.join("large.png")).unwrap().set_len((64 << 20) + 1).unwrap();
    let cases = [
        (
            "lost.png",
            "there is no texture @lost.png: correct the path, which is relative to this file's folder".to_owned(),
        ),
        ("text.png", "the texture @text.png is neither a PNG nor a JPEG file: convert it to one of them".to_owned()),
        ("half.png", "the texture @half.png is a damaged PNG file: make it again".to_owned()),
        ("large.png", "@large.png: is larger than 64 MiB, the most that is read: name a smaller picture".to_owned()),
        (
            "-s 2 2 lost.png",
            "there is no texture @lost.png: correct the path, which is relative to this file's folder".to_owned(),
        ),
        ("-foo 2 lost.png", "`map_Kd` with the option `-foo`: remove it, or correct the name of the file".to_owned()),
        ("-s x lost.png", "`map_Kd` with `-s` `x`: give one to three finite numbers after the option".to_owned()),
        ("-clamp on", "`map_Kd` without a file: give its name after the options".to_owned()),
    ];
    let at = format!("{}/", folder.display());
    for (name, sentence) in cases {
        fs::write(folder.join("square.mtl"), MATERIALS.replace("my tiles.png", name)).unwrap();
        let scene = load(&folder.join("square.obj")).unwrap();
        assert!(scene.project().is_ok());
        assert_eq!(scene.warnings, said(&folder));
        assert_eq!(small(&scene).unwrap_err(), format!("{at}square.mtl:5: {}", sentence.replace('@', &at)));
    }
}

#[test]
fn malformed_materials_are_refused_with_their_line() {
    let cases = [
        ("Ks 1 2", "`Ks` with 2 numbers: give 1 or 3"),
        ("Ns x", "`x` after `Ns` is not a number: write it as in 1.5 or -2e-3"),
        ("Ns", "`Ns` with 0 numbers: give 1"),
    ];
    for (statement, sentence) in cases {
        let mesh = format!("mtllib m.mtl\n{TRIANGLE}");
        let folder = folder("bad_material", &[("m.obj", &mesh), ("m.mtl", &format!("newmtl a\n{statement}\n"))]);
        let error = load(&folder.join("m.obj")).unwrap_err();
        assert_eq!(error, format!("{}:2: {sentence}", folder.join("m.mtl").display()));
        fs::write(folder.join("m.mtl"), statement).unwrap();
        let error = load(&folder.join("m.obj")).unwrap_err();
        let keyword = statement.split(' ').next().unwrap();
        assert!(
            error.ends_with(&format!("m.mtl:1: `{keyword}` before any `newmtl`: name the material first")),
            "{error}"
        );
    }
}

#[test]
fn too_many_materials_are_a_warning() {
    let material = |i: i32| format!("newmtl m{i}\nKs {}\n", f64::from(i) / 1000.0);
    let face = |i: i32| format!("usemtl m{i}\nf 1 2 3\n");
    let files = |count: i32| {
        let faces: String = (0..count).map(face).collect();
        (format!("mtllib m.mtl\n{TRIANGLE}{faces}"), (0..count).map(material).collect::<String>())
    };
    // The default is one as well, and one of these is as it.
    for (count, warnings) in [(255, 0), (256, 1)] {
        let (mesh, materials) = files(count);
        let folder = folder("many", &[("m.obj", &mesh), ("m.mtl", &materials)]);
        let scene = load(&folder.join("m.obj")).unwrap();
        assert_eq!((scene.mesh.materials().is_none(), scene.warnings.len()), (warnings == 1, warnings), "{count}");
        if let Some(warning) = scene.warnings.first() {
            let sentence = "m.obj: more than 255 materials differ in texture or highlights, so deferred shading shows neither: use fewer";
            assert!(warning.ends_with(sentence), "{warning}");
        }
    }
}

#[test]
fn a_scene_file_says_what_surfaces_look_like() {
    let folder = folder(
        "surface",
        &[
            ("marble.toml", "mesh = 'teapot'\n[surface]\ntexture = 'marble'\nspecular = 0.75\nshininess = 128\n"),
            ("tiles.toml", "mesh = 'square.obj'\n[surface]\ntexture = 'my tiles.png'\n"),
            ("square.obj", SQUARE),
            ("square.mtl", &MATERIALS.replace("my tiles", "lost")),
        ],
    );
    write_tiles(&folder.join("my tiles.png"));
    let marble = load(&folder.join("marble.toml")).unwrap();
    let materials = marble.mesh.materials().unwrap();
    assert_eq!(materials.materials, [Material { texture: Some(0), specular: 0.75, shininess: 128 }]);
    assert_eq!(**materials.textures[0].as_ref().unwrap(), Texture::generated("marble").unwrap());
    assert_eq!(marble.mesh.checksum(), Scene::builtin("teapot").unwrap().mesh.checksum());
    // In place of all textures of its own, a lost one among them.
    let tiles = load(&folder.join("tiles.toml")).unwrap();
    let materials = tiles.mesh.materials().unwrap();
    assert!(materials.materials.iter().all(|material| material.texture == Some(0)));
    assert_eq!(materials.materials[1].specular, 0.5);
    assert_eq!(tiles.files, ["tiles.toml", "square.obj", "square.mtl", "my tiles.png"].map(|name| folder.join(name)));
    assert!(small(&tiles).is_ok());
}

/// The texture of a scene file is placed by the mesh's coordinates, wherever the replaced texture was placed.
#[test]
fn a_scene_files_texture_is_not_moved_by_the_options_of_the_meshs_own() {
    let scene = "mesh = 'square.obj'\n[surface]\ntexture = 'my tiles.png'\n";
    let with = |test: &str, name: &str| {
        let materials = MATERIALS.replace("my tiles.png", name);
        let files = [("square.obj", SQUARE), ("square.mtl", &materials), ("scene.toml", scene)];
        let folder = folder(test, &files);
        write_tiles(&folder.join("my tiles.png"));
        small(&load(&folder.join("scene.toml")).unwrap()).unwrap()
    };
    let plain = with("surface_plain", "my tiles.png");
    assert_eq!(with("surface_placed", "-s 3 3 -o -1 -1 -clamp on my tiles.png"), plain);
}

/// A texture's edge colours continue beyond it, at the finest level possible.
#[test]
fn a_clamped_texture_that_is_reached_too_far_beyond_is_coarser_or_repeats() {
    let far = |test: &str, scale: &str| {
        let materials = MATERIALS.replace("my tiles.png", &format!("-s {scale} {scale} -clamp on large.png"));
        let folder = folder(test, &[("square.obj", SQUARE), ("square.mtl", &materials)]);
        Frame::blank(Size::new(512, 512).unwrap(), [9; 3]).write_png(folder.join("large.png")).unwrap();
        let scene = load(&folder.join("square.obj")).unwrap();
        let texture = scene.mesh.materials().unwrap().textures[0].as_ref().unwrap().level();
        let all = scene.warnings.iter().filter(|warning| warning.contains("`-clamp on`"));
        let sentence = all.map(|warning| warning.replace(&format!("{}/", folder.display()), "")).collect::<String>();
        (texture, sentence)
    };
    let remedy = "bring texture coordinates (vt) nearer to 0 to 1";
    assert_eq!(far("clamp_inside", "1"), (9, String::new()));
    assert_eq!(far("clamp_near", "1.5"), (10, String::new()));
    let coarser =
        "square.obj: a texture with `-clamp on` has 128 in place of 512 texels a side, as faces reach beyond its edges";
    assert_eq!(far("clamp_far", "7"), (10, format!("{coarser}: {remedy}")));
    let repeats = "square.obj: a texture with `-clamp on` is reached too far beyond its edges, so it repeats";
    assert_eq!(far("clamp_too_far", "5000"), (9, format!("{repeats}: {remedy}")));
}

#[test]
fn a_texture_that_repeats_too_often_is_a_warning() {
    let said = |test: &str, scale: &str| {
        let materials = MATERIALS.replace("my tiles.png", &format!("-s {scale} my tiles.png"));
        let folder = folder(test, &[("square.obj", SQUARE), ("square.mtl", &materials)]);
        write_tiles(&folder.join("my tiles.png"));
        let warnings = load(&folder.join("square.obj")).unwrap().warnings;
        warnings.concat().contains(
            "square.obj:12: the texture repeats more than 128 times over this face, so it is stretched: cut the face",
        )
    };
    assert_eq!([said("repeats_128", "128"), said("repeats_129", "-129")], [false, true]);
}

#[test]
fn bad_surfaces_are_refused_with_their_place() {
    let surface = |rest: &str| format!("mesh = 'teapot'\n[surface]\n{rest}");
    let cases = [
        (surface("specular = 2"), "scene.toml:3:12: the brightness of highlights is 2: give a number from 0 to 1"),
        (surface("shininess = 12"), "scene.toml:3:13: the shininess is 12: give 1, 2, 4, 8, 16, 32, 64 or 128"),
        (
            surface("texture = 'granite'"),
            "scene.toml:3:11: the texture `granite` is neither a .png or .jpg file nor a generated one: name such a file, or one of checker, planks, marble",
        ),
        (
            surface("texture = 'lost.png'"),
            "scene.toml:3:11: there is no texture lost.png: correct the path, which is relative to this file's folder",
        ),
        (
            "mesh = 'mesh.obj'\nsurface.texture = 'marble'".to_owned(),
            "scene.toml:2:19: the mesh has no texture coordinates: remove the key, or name a mesh that has them, as `vt` makes them in an .obj file",
        ),
        (surface("gloss = 1"), "scene.toml:3:1: unknown key `gloss`: write one of `texture`, `specular`, `shininess`"),
        (
            "mesh = 'teapot'\nsurface = 1".to_owned(),
            "scene.toml:2:11: invalid type: integer `1`: write `[surface]` above its keys",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(toml_error("bad_surface", &text), expected);
    }
}
