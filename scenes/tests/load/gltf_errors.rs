//! Every bad glTF file, with its whole sentence.

use crate::load::gltf::{Builder, F32, POSITIONS, SCENE, U8, bytes_of};
use crate::load::{bytes_error, folder, load};
use std::fs;

const MESH: &str = "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]";

/// Four vertices and six indices, as these bytes.
fn sound(indices: &[u8]) -> Builder {
    let mut builder = Builder::default();
    builder.floats("VEC3", 4, &POSITIONS);
    let view = builder.view(indices, "");
    builder.accessor(Some(view), U8, "SCALAR", 6, "");
    builder
}

#[test]
fn bad_json_is_refused_with_its_place() {
    let folder = folder("gltf_json", &[]);
    let cases: [(&str, &str); 8] = [
        ("{", "a.gltf:1:1: EOF while parsing an object: correct the JSON, or export the file again"),
        (
            "{\n\"asset\": 7}",
            "a.gltf:2:10: invalid type: integer `7`, expected struct Asset: correct the JSON, or export the file again",
        ),
        ("{}", "a.gltf:1:2: missing field `asset`: correct the JSON, or export the file again"),
        ("{\"asset\":{\"version\":\"1.0\"}}", "a.gltf: is of version `1.0` of glTF: export it as glTF 2.0"),
        (
            "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_mesh_quantization\",\"KHR_draco_mesh_compression\"]}",
            "a.gltf: needs the extensions `KHR_draco_mesh_compression`, which are not read: export it without them",
        ),
        (
            "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":3}]}",
            "a.gltf: nodes[0].mesh names something that is not there: export it again",
        ),
        (
            &format!("{{\"asset\":{{\"version\":\"2.0\"}},{MESH}}}"),
            "a.gltf: meshes[0].primitives[0].attributes[\"POSITION\"] names something that is not there: export it again",
        ),
        (
            "{\"asset\":{\"version\":\"2.0\"}}",
            "a.gltf: holds no face and no line in the scene that is drawn: export a mesh",
        ),
    ];
    for (text, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.gltf", text.as_bytes()), sentence);
    }
}

#[test]
fn bad_binary_files_are_refused() {
    let folder = folder("gltf_binary", &[]);
    let whole = sound(&[0, 1, 2, 0, 2, 3]).binary(&format!("{SCENE},{MESH}"));
    fs::write(folder.join("whole.glb"), &whole).unwrap();
    assert!(load(&folder.join("whole.glb")).is_ok());
    let with = |at: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        changed
    };
    let cases = [
        (whole[..10].to_vec(), "ends within its header"),
        (whole[..whole.len() - 1].to_vec(), "is shorter than its header says"),
        (with(4, &[1]), "is a binary file of another version of glTF than 2"),
        (with(8, &[5, 0, 0, 0]), "is shorter than its header says"),
        (with(16, b"BINX"), "does not begin with its JSON"),
        (with(12, &[255; 4]), "has a part that is longer than the file"),
        (with(8, &[14, 0, 0, 0]), "ends within the head of a part"),
    ];
    for (bytes, problem) in cases {
        assert_eq!(bytes_error(&folder, "a.glb", &bytes), format!("a.glb: {problem}: export it again"));
    }
    let json = "{\"asset\":{\"version\":\"2.0\"}}  ";
    let bare = [
        b"glTF\x02\0\0\0",
        &(20 + json.len() as u32).to_le_bytes()[..],
        &(json.len() as u32).to_le_bytes(),
        b"JSON",
        json.as_bytes(),
    ]
    .concat();
    assert_eq!(
        bytes_error(&folder, "a.glb", &bare),
        "a.glb: holds no face and no line in the scene that is drawn: export a mesh"
    );
}

#[test]
fn bad_buffers_and_accessors_are_refused() {
    let folder = folder("gltf_buffers", &[("short.bin", "abc")]);
    let again = "export it again";
    let positions = |count: usize, more: &str| {
        let mut builder = Builder::default();
        let view = builder.view(&bytes_of(&POSITIONS), more);
        builder.accessor(Some(view), F32, "VEC3", count, "");
        let view = builder.view(&[0, 1, 2, 0, 2, 3], "");
        builder.accessor(Some(view), U8, "SCALAR", 6, "");
        builder.embedded(&format!("{SCENE},{MESH}"))
    };
    let good = sound(&[0, 1, 2, 0, 2, 3]).embedded(&format!("{SCENE},{MESH}"));
    let uri = |uri: &str| {
        let (before, rest) = good.split_once("\"uri\":\"").unwrap();
        format!("{before}\"uri\":\"{uri}\"{}", rest.split_once('"').unwrap().1)
    };
    let zeros = |count: usize| {
        let mut builder = Builder::default();
        builder.accessor(None, F32, "VEC3", count, "");
        let view = builder.view(&[0, 1, 2, 0, 2, 3], "");
        builder.accessor(Some(view), U8, "SCALAR", 6, "");
        builder.embedded(&format!("{SCENE},{MESH}"))
    };
    let cases = [
        (uri("lost.bin"), "buffers[0] is the file lost.bin, which is not there: put it beside the mesh".to_owned()),
        (uri("short.bin"), format!("buffers[0] has 3 bytes, and is to have 54: {again}")),
        (
            uri("https://example.org/a.bin"),
            "buffers[0] is at an address on the net, and is not fetched: put it into a file beside this one".to_owned(),
        ),
        (
            uri("data:text/plain,abc"),
            "buffers[0] has a `data:` address that is not in base64: put it into a file beside this one".to_owned(),
        ),
        (
            uri("data:;base64,*"),
            "buffers[0] has a `data:` address of damaged base64: put it into a file beside this one".to_owned(),
        ),
        (good.replace("\"uri\"", "\"ura\""), format!("buffers[0] is nowhere: it has no `uri`: {again}")),
        (
            good.replace("\"byteOffset\":48,\"byteLength\":6", "\"byteOffset\":48,\"byteLength\":7"),
            format!("bufferViews[1] reaches beyond the end of its buffer: {again}"),
        ),
        (
            good.replace("\"byteOffset\":48", "\"byteOffset\":18446744073709551615"),
            format!("bufferViews[1] reaches beyond the end of its buffer: {again}"),
        ),
        (positions(5, ""), format!("accessors[0] reaches beyond the end of its buffer view: {again}")),
        (positions(1 << 62, ""), format!("accessors[0] reaches beyond the end of its buffer view: {again}")),
        (positions(4, ",\"byteStride\":8"), format!("accessors[0] reaches beyond the end of its buffer view: {again}")),
        (
            positions(4, ",\"byteStride\":3"),
            format!("bufferViews[0].byteStride has a value that glTF does not have: {again}"),
        ),
        (zeros(1 << 40), format!("accessors[0] has millions of elements and no bytes: {again}")),
        (
            good.replace("\"VEC3\"", "\"VEC2\""),
            format!("accessors[0] has 2 numbers for each element, and 3 are needed: {again}"),
        ),
        (
            good.replace("\"VEC3\"", "\"VEC9\""),
            format!("accessors[0].type has a value that glTF does not have: {again}"),
        ),
        (
            good.replace("\"POSITION\":0", "\"NORMAL\":0"),
            format!("meshes[0].primitives[0].attributes[\"POSITION\"] is missing: {again}"),
        ),
        (
            sound(&[0, 1, 2, 0, 2, 4]).embedded(&format!("{SCENE},{MESH}")),
            format!("meshes[0].primitives[0] names vertex 4, and has 4: {again}"),
        ),
    ];
    for (text, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.gltf", text.as_bytes()), format!("a.gltf: {sentence}"));
    }
}

#[test]
fn bad_nodes_are_refused() {
    let folder = folder("gltf_tree", &[]);
    let file = |nodes: &str| sound(&[0, 1, 2, 0, 2, 3]).embedded(&format!("{nodes},{MESH}"));
    let twice = "has two parents, or is below itself: give each node one parent";
    let cases = [
        ("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"children\":[1]},{\"children\":[0]}]", format!("nodes[0] {twice}")),
        ("\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"children\":[2]},{\"children\":[2]},{\"mesh\":0}]", format!("nodes[2] {twice}")),
        (
            "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"scale\":[1e38,1,1]}]",
            "nodes[0] puts a vertex at [-9.999999680285692e37, -1.0, 0.0]: give finite numbers below 1e30".to_owned(),
        ),
        (
            "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"scale\":[0,0,0]}]",
            "holds no face with an area and no line with a length, so nothing would be drawn: give a face three corners that are not in a line, or a polyline two that differ".to_owned(),
        ),
    ];
    for (nodes, sentence) in cases {
        assert_eq!(bytes_error(&folder, "a.gltf", file(nodes).as_bytes()), format!("a.gltf: {sentence}"));
    }
    // Without a scene, the root nodes are drawn.
    fs::write(folder.join("a.gltf"), file("\"nodes\":[{\"mesh\":0},{\"children\":[0]}]")).unwrap();
    assert_eq!(load(&folder.join("a.gltf")).unwrap().mesh.triangles().len(), 2);
}

/// A small file that would draw a mesh millions of times.
#[test]
fn repetitions_have_a_limit() {
    let folder = folder("gltf_many", &[]);
    let indices: Vec<u8> = (0..60_000_u32).map(|i| (i % 3) as u8).collect();
    let mut builder = Builder::default();
    builder.floats("VEC3", 4, &POSITIONS);
    let view = builder.view(&indices, "");
    builder.accessor(Some(view), U8, "SCALAR", 60_000, "");
    let nodes: Vec<String> = (0..600).map(|i| i.to_string()).collect();
    let nodes =
        format!("\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}]", nodes.join(","), vec!["{\"mesh\":0}"; 600].join(","));
    let text = builder.embedded(&format!("{nodes},{MESH}"));
    let sentence = "a.gltf: draws more than 4194304 faces and lines, or has as many vertices: simplify the meshes, or have fewer nodes";
    assert_eq!(bytes_error(&folder, "a.gltf", text.as_bytes()), sentence);
    // Few faces, and all vertices again and again.
    let mut builder = Builder::default();
    let view = builder.view(&vec![0; 12 << 14], "");
    builder.accessor(Some(view), F32, "VEC3", 1 << 14, "");
    let view = builder.view(&[0, 1, 2], "");
    builder.accessor(Some(view), U8, "SCALAR", 3, "");
    let text = builder.embedded(&format!("{nodes},{MESH}"));
    assert_eq!(bytes_error(&folder, "a.gltf", text.as_bytes()), sentence);
}

#[test]
fn a_picture_that_is_nowhere_is_an_error_of_deferred_shading_alone() {
    let folder = folder("gltf_pictures", &[]);
    let remedy = "correct the path, which is relative to this file's folder";
    let cases = [
        ("{\"uri\":\"lost%20one.png\"}", format!("there is no texture lost one.png: {remedy}")),
        ("{}", "images[0] has neither a file nor bytes: export it again".to_owned()),
        (
            "{\"bufferView\":0,\"mimeType\":\"image/png\"}",
            "the texture images[0] is neither a PNG nor a JPEG file: convert it to one of them".to_owned(),
        ),
        (
            "{\"uri\":\"data:,abc\"}",
            "images[0] has a `data:` address that is not in base64: put it into a file beside this one".to_owned(),
        ),
    ];
    for (image, sentence) in cases {
        let material = "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0}}],\"textures\":[{\"source\":0}]";
        let mesh = MESH.replace("\"indices\":1", "\"indices\":1,\"material\":0");
        let text = sound(&[0, 1, 2, 0, 2, 3]).embedded(&format!("{SCENE},{mesh},{material},\"images\":[{image}]"));
        fs::write(folder.join("a.gltf"), text).unwrap();
        let scene = load(&folder.join("a.gltf")).unwrap();
        let error = scene.mesh.materials().unwrap().textures[0].clone().unwrap_err().to_string();
        assert_eq!(error.replace(&format!("{}/", folder.display()), ""), format!("a.gltf: {sentence}"));
        let missing = "its primitives without the texture coordinates of their material have no texture";
        assert_eq!(crate::load::warned(&scene, &folder), [format!("a.gltf: {missing}")]);
    }
}
