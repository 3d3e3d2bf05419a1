//! glTF files: the pictures of good ones, and features that are drawn differently.

use crate::load::{folder, load, same_pictures, warned};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::dvec2;
use std::fs;
use std::path::Path;
use tilewright_scenes::{Frame, Material, Size, frame};

/// Components of accessors.
pub(crate) const U8: u32 = 5121;
pub(crate) const I16: u32 = 5122;
pub(crate) const U16: u32 = 5123;
pub(crate) const F32: u32 = 5126;

/// A file under construction: bytes, and the views and accessors of them.
#[derive(Default)]
pub(crate) struct Builder {
    bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Builder {
    /// A view of these bytes; its index.
    pub(crate) fn view(&mut self, bytes: &[u8], more: &str) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (at, length) = (self.bytes.len(), bytes.len());
        self.views.push(format!("{{\"buffer\":0,\"byteOffset\":{at},\"byteLength\":{length}{more}}}"));
        self.bytes.extend(bytes);
        self.views.len() - 1
    }

    /// An accessor of a view, or of none; its index.
    pub(crate) fn accessor(&mut self, view: Option<usize>, kind: u32, shape: &str, count: usize, more: &str) -> usize {
        let view = view.map_or_else(String::new, |view| format!("\"bufferView\":{view},"));
        let accessor = format!("{{{view}\"componentType\":{kind},\"type\":\"{shape}\",\"count\":{count}{more}}}");
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    pub(crate) fn floats(&mut self, shape: &str, count: usize, numbers: &[f32]) -> usize {
        let view = self.view(&bytes_of(numbers), "");
        self.accessor(Some(view), F32, shape, count, "")
    }

    fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, "");
        self.accessor(Some(view), U16, "SCALAR", indices.len(), "")
    }

    fn json(&self, uri: &str, rest: &str) -> String {
        let (length, views, accessors) = (self.bytes.len(), self.views.join(","), self.accessors.join(","));
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{{uri}\"byteLength\":{length}}}],\"bufferViews\":[{views}],\"accessors\":[{accessors}],{rest}}}"
        )
    }

    /// The text of a file that has its bytes in itself.
    pub(crate) fn embedded(&self, rest: &str) -> String {
        let code = STANDARD.encode(&self.bytes);
        self.json(&format!("\"uri\":\"data:application/octet-stream;base64,{code}\","), rest)
    }

    /// A binary file.
    pub(crate) fn binary(&self, rest: &str) -> Vec<u8> {
        let mut json = self.json("", rest).into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let parts = [(json, *b"JSON"), (self.bytes.clone(), *b"BIN\0")];
        let body: Vec<u8> = parts
            .into_iter()
            .flat_map(|(bytes, kind)| [(bytes.len() as u32).to_le_bytes().to_vec(), kind.to_vec(), bytes].concat())
            .collect();
        [b"glTF".to_vec(), 2_u32.to_le_bytes().to_vec(), (12 + body.len() as u32).to_le_bytes().to_vec(), body].concat()
    }
}

pub(crate) fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

pub(crate) const SCENE: &str = "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]";

/// A bent square, and its corners in triangles.
pub(crate) const POSITIONS: [f32; 12] = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.5, -1.0, 1.0, -1.0];
const NORMALS: [f32; 12] = [0.0, 0.0, 2.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0];
const CORNERS: [u16; 6] = [0, 1, 2, 0, 2, 3];
const OBJ: &str = "mtllib plain.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 1 1 0.5\nv -1 1 -1\nvn 0 0 2\nvn 1 0 1\nvn 0 1 1\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const FACES: &str = "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n";
/// The highlights of a surface that is as rough as can be.
const ROUGH: &str = "newmtl a\nKd 1 0.5 0\nKs 0.045\nNs 1\n";
/// `Kd 1 0.5 0`, linear, and no metal.
const MATERIAL: &str =
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.21404114,0,1],\"metallicFactor\":0}}]";

fn square(builder: &mut Builder) -> String {
    let positions = builder.floats("VEC3", 4, &POSITIONS);
    let normals = builder.floats("VEC3", 4, &NORMALS);
    let indices = builder.indices(&CORNERS);
    format!("{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals}}},\"indices\":{indices},\"material\":0}}")
}

fn meshes(primitive: &str) -> String {
    format!("\"meshes\":[{{\"primitives\":[{primitive}]}}]")
}

#[test]
fn text_and_binary_files_make_the_picture_of_an_obj_file() {
    let folder = folder("gltf", &[("plain.mtl", ROUGH)]);
    let mut builder = Builder::default();
    let primitive = square(&mut builder);
    let rest = format!("{SCENE},{},{MATERIAL}", meshes(&primitive));
    fs::write(folder.join("embedded.gltf"), builder.embedded(&rest)).unwrap();
    fs::write(folder.join("binary.glb"), builder.binary(&rest)).unwrap();
    fs::write(folder.join("two words é.bin"), &builder.bytes).unwrap();
    let uri = "\"uri\":\"two%20words%20%C3%A9.bin\",";
    fs::write(folder.join("beside.GLTF"), format!("\u{feff}{}", builder.json(uri, &rest))).unwrap();
    for name in ["embedded.gltf", "binary.glb", "beside.GLTF"] {
        same_pictures(&folder.join(name), &format!("{OBJ}{FACES}"), &[]);
    }
    assert_eq!(
        load(&folder.join("beside.GLTF")).unwrap().files,
        ["beside.GLTF", "two words é.bin"].map(|name| folder.join(name))
    );
    // As a wireframe of a scene file.
    fs::write(folder.join("scene.toml"), "mesh = 'binary.glb'\nwireframe = true\n").unwrap();
    let lines = load(&folder.join("scene.toml")).unwrap();
    assert_eq!((lines.mesh.lines().len(), lines.warnings.len()), (5, 0));
    let [r, g, b] = lines.mesh.lines()[0].colour;
    assert!(r == 1.0 && (g - 0.5).abs() < 1e-6 && b == 0.0);
}

/// Interleaved, normalised and quantised numbers are the same numbers.
#[test]
fn accessors_of_all_kinds_make_one_picture() {
    let folder = folder("gltf_accessors", &[("plain.mtl", ROUGH)]);
    let check = |name: &str, builder: &Builder, primitive: &str, more: &str| {
        let rest = format!("{SCENE},{},{MATERIAL}{more}", meshes(primitive));
        fs::write(folder.join(name), builder.embedded(&rest)).unwrap();
        same_pictures(&folder.join(name), &format!("{OBJ}{FACES}"), &[]);
    };
    let mut builder = Builder::default();
    let mixed: Vec<f32> = (0..4).flat_map(|i| [&POSITIONS[3 * i..][..3], &NORMALS[3 * i..][..3]].concat()).collect();
    let view = builder.view(&bytes_of(&mixed), ",\"byteStride\":24");
    let positions = builder.accessor(Some(view), F32, "VEC3", 4, "");
    let normals = builder.accessor(Some(view), F32, "VEC3", 4, ",\"byteOffset\":12");
    let view = builder.view(&[9, 0, 1, 2, 0, 2, 3], "");
    let indices = builder.accessor(Some(view), U8, "SCALAR", 6, ",\"byteOffset\":1");
    let primitive = format!(
        "{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals},\"_MINE\":0}},\"indices\":{indices},\"material\":0}}"
    );
    check("mixed.gltf", &builder, &primitive, "");
    // Without indices, and with positions of half a unit.
    let mut builder = Builder::default();
    let halves: Vec<u8> = CORNERS
        .iter()
        .flat_map(|&i| POSITIONS[3 * usize::from(i)..][..3].iter().map(|x| (2.0 * x) as i16).chain([0]))
        .flat_map(i16::to_le_bytes)
        .collect();
    let view = builder.view(&halves, ",\"byteStride\":8");
    let positions = builder.accessor(Some(view), I16, "VEC3", 6, "");
    let normals: Vec<f32> = CORNERS.iter().flat_map(|&i| NORMALS[3 * usize::from(i)..][..3].to_vec()).collect();
    let normals = builder.floats("VEC3", 6, &normals);
    let primitive = format!("{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals}}},\"material\":0}}");
    let rest = format!(
        "\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0,\"scale\":[0.5,0.5,0.5]}}],{},{MATERIAL},\"extensionsUsed\":[\"KHR_mesh_quantization\"],\"extensionsRequired\":[\"KHR_mesh_quantization\"]",
        meshes(&primitive)
    );
    fs::write(folder.join("halves.gltf"), builder.embedded(&rest)).unwrap();
    same_pictures(&folder.join("halves.gltf"), &format!("{OBJ}{FACES}"), &[]);
    // A sparse accessor replaces all zeros that should be nonzero.
    let mut builder = Builder::default();
    let places = builder.view(&[0, 1, 2, 3], "");
    let values = builder.view(&bytes_of(&POSITIONS), "");
    let sparse = format!(
        ",\"sparse\":{{\"count\":4,\"indices\":{{\"bufferView\":{places},\"componentType\":{U8}}},\"values\":{{\"bufferView\":{values}}}}}"
    );
    let positions = builder.accessor(None, F32, "VEC3", 4, &sparse);
    let normals = builder.floats("VEC3", 4, &NORMALS);
    let indices = builder.indices(&CORNERS);
    let primitive = format!(
        "{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals}}},\"indices\":{indices},\"material\":0}}"
    );
    check("sparse.gltf", &builder, &primitive, "");
}

/// A node below a node: by three parts, and by a matrix that mirrors.
#[test]
fn nodes_move_turn_and_mirror_their_meshes() {
    let mtl = "newmtl a\nKd 1 0.5 0\nKs 0.045\nNs 1\n";
    let folder = folder("gltf_nodes", &[("plain.mtl", mtl)]);
    let mut builder = Builder::default();
    let primitive = square(&mut builder);
    // A quarter turn round z, half as large along x, and moved; then mirrored at x = 0.
    let nodes = "\"scene\":0,\"scenes\":[{\"nodes\":[2,1]}],\"nodes\":[{\"mesh\":0,\"rotation\":[0,0,0.70710678,0.70710678],\"scale\":[0.5,1,1],\"translation\":[0.25,0,0]},\
                 {\"children\":[0],\"matrix\":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{\"mesh\":0,\"translation\":[0,0,-2]}]";
    let rest = format!("{nodes},{},{MATERIAL}", meshes(&primitive));
    fs::write(folder.join("a.gltf"), builder.embedded(&rest)).unwrap();
    // First x' = x/2; then (x, y) becomes (-y + 1/4, x); then x' = -x. Normals: x by 2, turned, mirrored.
    let place = |x: f64, y: f64, z: f64| format!("v {} {} {z}\n", y - 0.25, 0.5 * x);
    let normal = |x: f64, y: f64, z: f64| format!("vn {} {} {z}\n", y, 2.0 * x);
    let [p, n] = [POSITIONS, NORMALS].map(|all| all.map(f64::from));
    let far: String = (0..4).map(|i| format!("v {} {} {}\n", p[3 * i], p[3 * i + 1], p[3 * i + 2] - 2.0)).collect();
    let near: String = (0..4).map(|i| place(p[3 * i], p[3 * i + 1], p[3 * i + 2])).collect();
    let far_normals: String = (0..4).map(|i| format!("vn {} {} {}\n", n[3 * i], n[3 * i + 1], n[3 * i + 2])).collect();
    let near_normals: String = (0..4).map(|i| normal(n[3 * i], n[3 * i + 1], n[3 * i + 2])).collect();
    let faces = "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\nf 5//5 6//6 7//7\nf 5//5 7//7 8//8\n";
    let obj = format!("mtllib plain.mtl\nusemtl a\n{far}{near}{far_normals}{near_normals}{faces}");
    same_pictures(&folder.join("a.gltf"), &obj, &[]);
}

#[test]
fn all_modes_of_triangles_and_lines_are_drawn() {
    let folder = folder("gltf_modes", &[("plain.mtl", ROUGH)]);
    let check = |mode: u32, corners: &[u16], faces: &str, warnings: &[&str]| {
        let mut builder = Builder::default();
        let positions = builder.floats("VEC3", 4, &POSITIONS);
        let normals = builder.floats("VEC3", 4, &NORMALS);
        let indices = builder.indices(corners);
        let primitive = format!(
            "{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals}}},\"indices\":{indices},\"material\":0,\"mode\":{mode}}}"
        );
        let rest = format!("{SCENE},{},{MATERIAL}", meshes(&primitive));
        fs::write(folder.join("a.gltf"), builder.embedded(&rest)).unwrap();
        same_pictures(&folder.join("a.gltf"), &format!("{OBJ}{faces}"), warnings);
    };
    check(1, &[0, 1, 2, 3], "l 1 2\nl 3 4\n", &[]);
    check(2, &[0, 1, 2, 3], "l 1 2 3 4 1\n", &[]);
    check(3, &[0, 1, 2, 3], "l 1 2 3 4\n", &[]);
    check(
        4,
        &[0, 1, 2, 0, 2],
        "f 1//1 2//2 3//3\n",
        &["a.gltf: its indices that make no whole triangle or line are left out"],
    );
    check(5, &[0, 1, 3, 2], "f 1//1 2//2 4//4\nf 2//2 3//3 4//4\n", &[]);
    check(6, &[0, 1, 2, 3], FACES, &[]);
}

#[test]
fn a_face_without_normals_is_flat() {
    let folder = folder("gltf_flat", &[("plain.mtl", ROUGH)]);
    let mut builder = Builder::default();
    let positions = builder.floats("VEC3", 4, &POSITIONS);
    let indices = builder.indices(&CORNERS);
    let primitive = format!("{{\"attributes\":{{\"POSITION\":{positions}}},\"indices\":{indices},\"material\":0}}");
    fs::write(folder.join("a.gltf"), builder.embedded(&format!("{SCENE},{},{MATERIAL}", meshes(&primitive)))).unwrap();
    // Cross products of two sides of each.
    let obj = OBJ.replace("vn 0 0 2\nvn 1 0 1\n", "vn 0 -1 4\nvn -3 2 4\n");
    same_pictures(&folder.join("a.gltf"), &format!("{obj}f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"), &[]);
}

#[test]
fn colours_of_vertices_are_linear() {
    let folder = folder("gltf_colours", &[]);
    let mut builder = Builder::default();
    let positions = builder.floats("VEC3", 4, &POSITIONS);
    let bytes: Vec<u8> = [[65535, 0, 14027, 9], [0, 65535, 0, 9], [0; 4], [65535; 4]]
        .as_flattened()
        .iter()
        .flat_map(|part: &u16| part.to_le_bytes())
        .collect();
    let view = builder.view(&bytes, "");
    let colours = builder.accessor(Some(view), U16, "VEC4", 4, ",\"normalized\":true");
    let indices = builder.indices(&CORNERS);
    let primitive =
        format!("{{\"attributes\":{{\"POSITION\":{positions},\"COLOR_0\":{colours}}},\"indices\":{indices}}}");
    fs::write(folder.join("a.gltf"), builder.embedded(&format!("{SCENE},{}", meshes(&primitive)))).unwrap();
    let mesh = load(&folder.join("a.gltf")).unwrap().mesh;
    let [first, second, third] = mesh.corner_colours(0);
    assert_eq!([second, third], [[0.0, 1.0, 0.0], [0.0; 3]]);
    // 14027 of 65535 is a half as a screen shows it.
    assert!(first[0] == 1.0 && first[1] == 0.0 && (first[2] - 0.5).abs() < 1e-4, "{first:?}");
    assert_eq!(mesh.corner_colours(1)[2], [1.0; 3]);
}

fn write_tiles(path: &Path) {
    let mut picture = Frame::blank(Size::new(2, 2).unwrap(), [255; 3]);
    for (word, rgb) in picture.words.iter_mut().zip([[250, 20, 10], [20, 250, 10], [10, 20, 250]]) {
        *word = frame::blank(rgb);
    }
    picture.write_png(path).unwrap();
}

/// A square with these texture coordinates, v downward, and a texture that lies as `info` says.
fn textured(folder: &Path, coordinates: &[f32], info: &str, image: &str, more: &str) {
    let mut builder = Builder::default();
    let positions = builder.floats("VEC3", 4, &POSITIONS);
    let normals = builder.floats("VEC3", 4, &NORMALS);
    let coordinates = builder.floats("VEC2", 4, coordinates);
    let indices = builder.indices(&CORNERS);
    let picture = builder.view(&fs::read(folder.join("tiles.png")).unwrap(), "");
    let primitive = format!(
        "{{\"attributes\":{{\"POSITION\":{positions},\"NORMAL\":{normals},\"TEXCOORD_1\":{coordinates}}},\"indices\":{indices},\"material\":0}}"
    );
    let materials = format!(
        "\"materials\":[{{\"pbrMetallicRoughness\":{{\"baseColorTexture\":{{\"index\":0,\"texCoord\":1{info}}},\"metallicFactor\":0,\"roughnessFactor\":0.5}}}}]"
    );
    let image = image.replace("VIEW", &picture.to_string());
    let rest = format!("{SCENE},{},{materials},\"images\":[{image}]{more}", meshes(&primitive));
    fs::write(folder.join("a.gltf"), builder.embedded(&rest)).unwrap();
}

const TEXTURES: &str = ",\"textures\":[{\"source\":0}]";

#[test]
fn a_texture_lies_with_its_first_row_above() {
    // The power of roughness a half is 30, nearly 32; its brightness 0.04 times 40/8.
    let mtl = "newmtl a\nKd 1\nKs 0.2\nNs 32\nmap_Kd tiles.png\n";
    let folder = folder("gltf_texture", &[("plain.mtl", mtl)]);
    write_tiles(&folder.join("tiles.png"));
    fs::copy(folder.join("tiles.png"), folder.join("my tiles.png")).unwrap();
    let obj = format!("{OBJ}f 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/3/3 4/4/4\n");
    let upright = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let code = STANDARD.encode(fs::read(folder.join("tiles.png")).unwrap());
    let images = [
        "{\"uri\":\"my%20tiles.png\"}".to_owned(),
        "{\"bufferView\":VIEW,\"mimeType\":\"image/png\"}".to_owned(),
        format!("{{\"uri\":\"data:image/png;base64,{code}\"}}"),
    ];
    for image in images {
        textured(&folder, &upright, "", &image, TEXTURES);
        same_pictures(&folder.join("a.gltf"), &obj, &[]);
    }
    // Coordinates that a transform brings to the same places: a quarter turn, half as large, moved.
    let transform = ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0,1],\"rotation\":1.5707963267948966,\"scale\":[2,2]}}";
    let turned = [0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5, 0.0];
    textured(&folder, &turned, transform, "{\"uri\":\"tiles.png\"}", TEXTURES);
    let scene = load(&folder.join("a.gltf")).unwrap();
    let materials = scene.mesh.materials().unwrap();
    for (i, expected) in [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(1.0, 1.0)].into_iter().enumerate() {
        let found = materials.coordinates[materials.mappings[0].coordinates[i] as usize];
        assert!((found - expected).length() < 1e-6, "{found} for {expected}");
    }
}

#[test]
fn what_a_sampler_asks_for_and_is_not_drawn_is_a_warning() {
    let folder = folder("gltf_samplers", &[]);
    write_tiles(&folder.join("tiles.png"));
    let sampler = |wrap: u32, filter: u32| {
        format!(
            ",\"textures\":[{{\"source\":0,\"sampler\":0}}],\"samplers\":[{{\"wrapS\":{wrap},\"magFilter\":{filter}}}]"
        )
    };
    let (repeat, clamp, mirror, linear, nearest) = (10497, 33071, 33648, 9729, 9728);
    let within = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let beyond = within.map(|part| 2.0 * part);
    let edge = "a.gltf: its textures that end at their edges, or are mirrored there, go on repeating";
    let filter = "a.gltf: its textures with the filter NEAREST are drawn with linear filters";
    let cases = [
        (repeat, linear, beyond, vec![]),
        (clamp, linear, within, vec![]),
        (clamp, linear, beyond, vec![edge]),
        (mirror, nearest, beyond, vec![filter, edge]),
    ];
    for (wrap, mag, coordinates, warnings) in cases {
        textured(&folder, &coordinates, "", "{\"uri\":\"tiles.png\"}", &sampler(wrap, mag));
        assert_eq!(warned(&load(&folder.join("a.gltf")).unwrap(), &folder), warnings);
    }
}

#[test]
fn highlights_follow_from_roughness() {
    let folder = folder("gltf_roughness", &[]);
    let mut builder = Builder::default();
    let primitives: Vec<String> =
        (0..4).map(|i| square(&mut builder).replace("\"material\":0", &format!("\"material\":{i}"))).collect();
    let materials = [0.0, 0.25, 0.5, 1.0]
        .map(|r| format!("{{\"pbrMetallicRoughness\":{{\"metallicFactor\":0,\"roughnessFactor\":{r}}}}}"));
    let rest = format!("{SCENE},{},\"materials\":[{}]", meshes(&primitives.join(",")), materials.join(","));
    fs::write(folder.join("a.gltf"), builder.embedded(&rest)).unwrap();
    let scene = load(&folder.join("a.gltf")).unwrap();
    let materials = scene.mesh.materials().unwrap();
    let found: Vec<Material> =
        (0..4).map(|i| materials.materials[materials.mappings[2 * i].material as usize]).collect();
    let highlights: Vec<(f64, u32)> = found.iter().map(|material| (material.specular, material.shininess)).collect();
    assert_eq!(highlights, [(0.68, 128), (0.68, 128), (0.2, 32), (0.045, 1)]);
}

#[test]
fn whatever_else_changes_the_picture_is_a_warning() {
    let folder = folder("gltf_odd", &[]);
    let mut builder = Builder::default();
    let primitive = square(&mut builder);
    let points = primitive.replace("\"material\":0", "\"mode\":0");
    let identity =
        builder.floats("MAT4", 1, &[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let time = builder.floats("SCALAR", 1, &[0.0]);
    let place = builder.floats("VEC3", 1, &[0.0; 3]);
    let rest = format!(
        "\"scene\":1,\"scenes\":[{{\"nodes\":[]}},{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0,\"skin\":0,\"weights\":[0.5]}}],\
         \"skins\":[{{\"joints\":[0],\"inverseBindMatrices\":{identity}}}],\"cameras\":[{{\"type\":\"perspective\",\"perspective\":{{\"yfov\":1,\"znear\":1}}}}],\
         \"animations\":[{{\"channels\":[{{\"sampler\":0,\"target\":{{\"node\":0,\"path\":\"translation\"}}}}],\"samplers\":[{{\"input\":{time},\"output\":{place}}}]}}],\
         \"materials\":[{{\"alphaMode\":\"MASK\",\"emissiveFactor\":[0,1,0]}},{{\"extensions\":{{\"KHR_materials_unlit\":{{}}}}}}],\
         \"extensionsUsed\":[\"KHR_materials_unlit\",\"KHR_lights_punctual\"],{}",
        meshes(&format!("{primitive},{points}"))
    );
    fs::write(folder.join("a.gltf"), builder.embedded(&rest)).unwrap();
    let warnings = [
        "the extensions `KHR_lights_punctual` are not drawn: export it without them",
        "its animations are not played: it is drawn as it rests",
        "its cameras are not used, as the mesh is framed: put one into a scene file",
        "of its materials base colours, their textures and roughness are drawn, but not metalness, emission",
        "its materials with an alpha mode are drawn as opaque ones: cut or remove what is to be seen through",
        "its materials without light are lit as others are",
        "it holds 2 scenes, of which scene 1 is drawn",
        "its skins are not bent: each mesh is drawn as its file has it, where its node is",
        "its morph targets are not mixed in: each mesh is drawn without them",
        "its points are not drawn",
    ];
    let scene = load(&folder.join("a.gltf")).unwrap();
    assert_eq!(warned(&scene, &folder), warnings.map(|warning| format!("a.gltf: {warning}")));
    assert_eq!(scene.mesh.triangles().len(), 2);
}
