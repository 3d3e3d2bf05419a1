//! Textures from PNG and JPEG files of any size and depth, and what each loses.

use crate::load::{folder, load, warned};
use image::{DynamicImage, ImageBuffer, Luma, LumaA, Rgba};
use std::fs;
use std::path::Path;
use tilewright_scenes::{Frame, Size, frame};

/// A square that names `texture` in its material.
fn square(folder: &Path, texture: &str) -> tilewright_scenes::Scene {
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n";
    fs::write(folder.join("square.obj"), obj).unwrap();
    fs::write(folder.join("m.mtl"), format!("newmtl a\nmap_Kd {texture}\n")).unwrap();
    load(&folder.join("square.obj")).unwrap()
}

/// The texels of a texture on its finest level, row by row from below, and the warnings.
fn texels(folder: &Path, texture: &str) -> (Vec<[u8; 3]>, Vec<String>) {
    let scene = square(folder, texture);
    let found = scene.mesh.materials().unwrap().textures[0].clone().unwrap();
    (found.texels(found.level()).to_vec(), warned(&scene, folder))
}

fn error(folder: &Path, texture: &str) -> String {
    let scene = square(folder, texture);
    let error = scene.mesh.materials().unwrap().textures[0].clone().unwrap_err().to_string();
    error.replace(&format!("{}/", folder.display()), "")
}

/// The folder of a test with the pictures of `tests/data/pictures`: quarters of red and green above blue and white, 16x16 pixels.
fn with_data(test: &str) -> std::path::PathBuf {
    let folder = folder(test, &[]);
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/pictures");
    for entry in fs::read_dir(data).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
    }
    folder
}

#[test]
fn a_jpeg_file_has_the_colours_that_it_was_made_of() {
    let folder = with_data("jpeg");
    let colours = [[30, 60, 210], [240, 240, 230], [220, 30, 40], [40, 200, 60]];
    let grey = [[68; 3], [239; 3], [88; 3], [136; 3]];
    for (name, expected) in
        [("baseline.jpg", colours), ("progressive.jpg", colours), ("cmyk.jpg", colours), ("grey.jpg", grey)]
    {
        let (texels, warnings) = texels(&folder, name);
        assert_eq!((texels.len(), warnings.len()), (256, 0), "{name}");
        let middles = [(4, 4), (12, 4), (4, 12), (12, 12)].map(|(i, j)| texels[16 * j + i]);
        for (found, expected) in middles.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(found.abs_diff(*expected) <= 2, "{name}: {middles:?}");
        }
    }
}

/// The content of a file decides its format.
#[test]
fn the_name_of_a_picture_says_nothing() {
    let folder = with_data("jpeg_named");
    fs::copy(folder.join("baseline.jpg"), folder.join("photo.png")).unwrap();
    assert_eq!(texels(&folder, "photo.png"), texels(&folder, "baseline.jpg"));
}

/// As [`Frame::checksum`] computes them; the encoding of a file does not affect its colours.
#[test]
fn the_bytes_of_a_jpeg_file_are_the_same_everywhere() {
    let folder = with_data("jpeg_pinned");
    let sums = ["baseline.jpg", "progressive.jpg", "cmyk.jpg", "grey.jpg"].map(|name| {
        let mut frame = Frame::blank(Size::new(16, 16).unwrap(), [0; 3]);
        for (word, rgb) in frame.words.iter_mut().zip(texels(&folder, name).0) {
            *word = frame::blank(rgb);
        }
        frame.checksum()
    });
    let pinned = [0x9cd9_5916_35da_15e5, 0x9cd9_5916_35da_15e5, 0xf2bb_1979_8bd9_f4e5, 0xc063_0aaf_280e_88e5];
    assert_eq!(sums, pinned, "{sums:#x?}");
}

#[test]
fn damaged_and_turned_jpeg_files_are_named() {
    let folder = with_data("jpeg_bad");
    let whole = fs::read(folder.join("baseline.jpg")).unwrap();
    fs::write(folder.join("half.jpg"), &whole[..whole.len() - 40]).unwrap();
    fs::write(folder.join("head.jpg"), &whole[..20]).unwrap();
    for name in ["half.jpg", "head.jpg"] {
        assert_eq!(error(&folder, name), format!("m.mtl:2: the texture {name} is a damaged JPEG file: make it again"));
    }
    let (turned, warnings) = texels(&folder, "turned.jpg");
    assert_eq!(turned, texels(&folder, "baseline.jpg").0);
    let sentence =
        "m.mtl:2: the texture turned.jpg asks to be shown turned (EXIF), and is drawn as it is stored: turn its pixels";
    assert_eq!(warnings, [sentence]);
}

#[test]
fn a_picture_of_any_size_is_scaled_with_a_sentence() {
    let folder = folder("any_size", &[]);
    let mut picture = Frame::blank(Size::new(3, 2).unwrap(), [0; 3]);
    let colours = [[90, 0, 0], [0, 90, 0], [0, 0, 90], [30, 60, 120], [10, 20, 30], [250, 255, 0]];
    for (word, rgb) in picture.words.iter_mut().zip(colours) {
        *word = frame::blank(rgb);
    }
    picture.write_png(folder.join("small.png")).unwrap();
    let (texels, warnings) = texels(&folder, "small.png");
    let sentence = "m.mtl:2: the texture small.png has 3x2 pixels, so it is scaled to 4x4: a texture is a square of a power of two, up to 1024";
    assert_eq!(warnings, [sentence]);
    // A texel is 3/4 of a column wide and half a row high: from the left one pixel, 1:2 of two, 2:1 of two, and one.
    let below = [[30, 60, 120], [17, 33, 60], [90, 98, 20], [250, 255, 0]];
    let above = [[90, 0, 0], [30, 60, 0], [0, 60, 30], [0, 0, 90]];
    assert_eq!(texels, [below, below, above, above].concat());
    Frame::blank(Size::new(2048, 640).unwrap(), [9, 8, 7]).write_png(folder.join("large.png")).unwrap();
    let (texels, warnings) = self::texels(&folder, "large.png");
    assert!(texels.len() == 1 << 20 && texels.iter().all(|texel| *texel == [9, 8, 7]));
    assert!(warnings[0].contains("has 2048x640 pixels, so it is scaled to 1024x1024"), "{warnings:?}");
}

#[test]
fn grey_palettes_and_sixteen_bits_are_colours_too() {
    let folder = folder("kinds_of_png", &[]);
    let save = |name: &str, image: DynamicImage| image.save(folder.join(name)).unwrap();
    save("grey.png", ImageBuffer::from_pixel(2, 2, Luma([77_u8])).into());
    save("deep.png", ImageBuffer::from_pixel(2, 2, Luma([0x80ff_u16])).into());
    save("clear.png", ImageBuffer::from_pixel(2, 2, LumaA([50_u8, 254])).into());
    save("opaque.png", ImageBuffer::from_pixel(2, 2, Rgba([1_u8, 2, 3, 255])).into());
    save("deep_clear.png", ImageBuffer::from_pixel(2, 2, Rgba([257_u16, 0, 0, 0])).into());
    let clear = |name: &str| {
        format!("m.mtl:2: the texture {name} is transparent in places, and drawn as opaque: make it opaque")
    };
    let cases = [
        ("grey.png", [77; 3], vec![]),
        ("deep.png", [128; 3], vec![]),
        ("clear.png", [50; 3], vec![clear("clear.png")]),
        ("opaque.png", [1, 2, 3], vec![]),
        ("deep_clear.png", [1, 0, 0], vec![clear("deep_clear.png")]),
    ];
    for (name, colour, warnings) in cases {
        assert_eq!(texels(&folder, name), (vec![colour; 4], warnings), "{name}");
    }
}

/// The head alone of a picture that would take gigabytes.
#[test]
fn a_picture_that_would_fill_the_memory_is_refused() {
    let folder = with_data("picture_bomb");
    ImageBuffer::from_pixel(2, 2, Luma([0_u8])).save(folder.join("bomb.png")).unwrap();
    let mut bytes = fs::read(folder.join("bomb.png")).unwrap();
    bytes[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    let check = crc(&bytes[12..29]).to_be_bytes();
    bytes[29..33].copy_from_slice(&check);
    fs::write(folder.join("bomb.png"), bytes).unwrap();
    let sentence = |name| {
        format!(
            "m.mtl:2: the texture {name} has 65535x65535 pixels, which take more than 256 MiB: scale it to 1024x1024, the most that is drawn"
        )
    };
    assert_eq!(error(&folder, "bomb.png"), sentence("bomb.png"));
    let mut bytes = fs::read(folder.join("baseline.jpg")).unwrap();
    let frame = bytes.windows(2).position(|pair| pair == [0xff, 0xc0]).unwrap();
    bytes[frame + 5..frame + 9].fill(0xff);
    fs::write(folder.join("bomb.jpg"), bytes).unwrap();
    assert_eq!(error(&folder, "bomb.jpg"), sentence("bomb.jpg"));
}

/// The check sum of a part of a PNG file.
fn crc(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| bit(crc)))
}

#[test]
fn a_scene_file_takes_any_picture_and_says_what_it_loses() {
    let folder = with_data("picture_of_scene");
    Frame::blank(Size::new(3, 3).unwrap(), [9; 3]).write_png(folder.join("odd.png")).unwrap();
    square(&folder, "baseline.jpg");
    let scene = |texture: &str| {
        let text = format!("mesh = 'square.obj'\n[surface]\ntexture = '{texture}'\n");
        fs::write(folder.join("scene.toml"), text).unwrap();
        load(&folder.join("scene.toml")).unwrap()
    };
    assert_eq!(scene("grey.jpg").mesh.materials().unwrap().textures[0].as_ref().unwrap().level(), 4);
    let sentence = "scene.toml:3:11: the texture odd.png has 3x3 pixels, so it is scaled to 4x4: a texture is a square of a power of two, up to 1024";
    assert_eq!(warned(&scene("odd.png"), &folder), [sentence]);
}
