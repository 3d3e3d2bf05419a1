//! The picture and the warnings of each file in `tests/data/real`.

/// A mesh and its expected results.
pub struct Case {
    /// In `tests/data/real`.
    pub file: &'static str,
    /// The picture of machines without textures.
    pub plain: &'static str,
    /// The picture of deferred shading.
    pub deferred: &'static str,
    /// All warnings, without the folder.
    pub warnings: &'static [&'static str],
}

/// One whose picture is the same in both, without a warning.
const fn quiet(file: &'static str, picture: &'static str) -> Case {
    Case { file, plain: picture, deferred: picture, warnings: &[] }
}

/// One whose picture is the same in both.
const fn said(file: &'static str, picture: &'static str, warnings: &'static [&'static str]) -> Case {
    Case { file, plain: picture, deferred: picture, warnings }
}

/// One with a texture, of four quarters if nothing else is said.
const fn textured(file: &'static str, deferred: &'static str, warnings: &'static [&'static str]) -> Case {
    Case { file, plain: "W", deferred, warnings }
}

pub const CASES: &[Case] = &[
    // Names and lines.
    quiet("number_sign/m.obj", "RB/RB"),
    quiet("backslash/m.obj", "RB/RB"),
    quiet("blanks/peach castle.obj", "RB/RB"),
    quiet("blanks_around/m.obj", "RB/RB"),
    quiet("continued/m.obj", "RB/RB"),
    quiet("old_mac/m.obj", "RB/RB"),
    quiet("marks/m.obj", "RB/RB"),
    quiet("comments/m.obj", "RB/RB"),
    quiet("names_like_faces/m.obj", "RB/RB"),
    quiet("kept_material/m.obj", "RR/RR"),
    quiet("used_first/m.obj", "RB/RB"),
    said(
        "capitals/m.obj",
        "RW/RW",
        &["m.obj:8: no MTL file defines the material `RED`, so `red` is drawn: write both alike"],
    ),
    // Numbers and corners.
    quiet("numbers/m.obj", "RB/RB"),
    quiet("negative/m.obj", "RB/RB"),
    quiet("degenerate/m.obj", "RB/RB"),
    said(
        "zero_normals/m.obj",
        "RB/RB",
        &[
            "m.obj:11: the corner `3/0/1` names texture coordinate 0, and counting begins at 1, so it has no texture: export the mesh again",
            "m.obj:11: the corner `2/1/0` names normal 0, and counting begins at 1, so one is computed: export the mesh again",
            "m.obj:11: this face has no normals and others have, so its normals are computed: export all or none",
        ],
    ),
    said(
        "no_numbers/m.obj",
        "RB/RB",
        &[
            "m.obj:14: this face names a texture coordinate that is not a number, so it has no texture, and so on in 7 more lines: export the mesh again",
            "m.obj:14: this face names a normal without a direction, so one is computed, and so on in 7 more lines: export the mesh again",
        ],
    ),
    said(
        "nothing_behind/m.obj",
        "RB/RB",
        &[
            "m.obj:9: the corner `1/1/1` names texture coordinate 1, and none is defined above, so it has no texture, and so on in 7 more lines: export the mesh again",
            "m.obj:9: the corner `1/1/1` names normal 1, and none is defined above, so one is computed, and so on in 7 more lines: export the mesh again",
        ],
    ),
    said(
        "points/m.obj",
        "RB/RB",
        &[
            "m.obj:8: `p` is not drawn, and so on in 1 more line: export what it shows as polygons",
            "m.obj:11: a face with 1 corner is not drawn, and so on in 2 more lines: give at least three",
            "m.obj:16: a polyline with 1 corner is not drawn: give at least two",
        ],
    ),
    // Colours of vertices.
    quiet("vertex_colours/m.obj", "RB/RB"),
    said("vertex_colours_in_part/m.obj", "RB/RB", &[]),
    said(
        "vertex_colours_in_bytes/m.obj",
        "RB/RB",
        &[
            "m.obj:1: this vertex has a colour above 1, so all are taken for numbers from 0 to 255: give red, green and blue from 0 to 1",
        ],
    ),
    // Files.
    quiet("list/m.obj", "RB/RB"),
    textured(
        "quotes/m.obj",
        "RG/BW",
        &[
            "my model.mtl:7: `illum 0` of this material is not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
    textured("windows/m.obj", "RG/BW", &[]),
    textured(
        "other_machine/m.obj",
        "RG/BW",
        &[
            "m.mtl:3: there is no texture C://Users//Kay Doe//Desktop//3. Pack//texture//quarters.png, so quarters.png is drawn: correct the path",
        ],
    ),
    textured(
        "letter_case/m.obj",
        "RG/BW",
        &[
            "model.mtl:3: there is no texture Textures/QUARTERS.PNG, so textures/quarters.png is drawn: correct the path",
            "m.obj:1: there is no material file Model.MTL, so model.mtl is read: correct the name",
        ],
    ),
    textured("folders/m.obj", "RG/BW", &[]),
    textured(
        "folders/beside.obj",
        "RG/BW",
        &[
            "materials/beside.mtl:3: there is no texture materials/textures/quarters.png, so textures/quarters.png is drawn: correct the path",
        ],
    ),
    said(
        "renamed/new name.obj",
        "RB/RB",
        &["new name.obj:1: the material file old name.mtl is missing, so new name.mtl is read: put it beside the mesh"],
    ),
    said("unnamed/m.obj", "RB/RB", &["m.obj:7: no `mtllib` names a material file, so m.mtl is read: name it"]),
    said(
        "twice/m.obj",
        "RB/RB",
        &[
            "first.mtl:3: the material `red` is defined in line 1 as well, and otherwise; this one is drawn: give each a name of its own",
            "second.mtl:1: the material `red` is defined in first.mtl:3 before, and otherwise; that one is drawn: give each a name of its own",
        ],
    ),
    // Materials.
    textured(
        "no_usemtl/m.obj",
        "RG/BW",
        &[
            "m.obj:1: no `usemtl` names a material, so the only one, `material_0`, is everywhere: name one before the faces",
        ],
    ),
    said(
        "several_unused/m.obj",
        "gg/gg",
        &["m.obj:1: no `usemtl` names a material, so all is grey: name one before the faces"],
    ),
    said(
        "nothing_meant/m.obj",
        "gg/gg",
        &["m.obj:11: `usemtl` without a name, so what follows has no material: give the name after it"],
    ),
    said(
        "undefined/m.obj",
        "Rg/Rg",
        &[
            "m.obj:10: no MTL file defines the material `green`, so it is grey, and so on in 1 more line: define it, or name its file with mtllib",
        ],
    ),
    quiet("as_drawn/m.obj", "RB/RB"),
    said(
        "not_drawn/m.obj",
        "RB/RB",
        &[
            "m.mtl:7: `HAND_C.jpg`, `Ke`, `d`, `illum 7`, `map_Bump` and the hue of `Ka` of this material and 1 more are not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
    said(
        "spectral/m.obj",
        "Rg/Rg",
        &[
            "m.mtl:4: `Kd spectral` and `Ks xyz` of this material are not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
    said(
        "bright/m.obj",
        "RB/RB",
        &[
            "m.mtl:2: `Kd` outside 0 to 1 of this material and 1 more is not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
    // Textures.
    textured(
        "black/m.obj",
        "RG/BW",
        &[
            "m.mtl:2: `illum 4` of this material is not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
            "m.mtl:6: `Kd` is black under this texture, so the texture is drawn as under white: write `Kd 1 1 1`",
        ],
    ),
    textured("repeats/m.obj", "RG/BW", &[]),
    textured("scaled/m.obj", "RGRG/BWBW/RGRG/BWBW", &[]),
    textured("moved/m.obj", "GR/WB", &[]),
    textured("scaled_and_moved/m.obj", "GR/WB", &[]),
    textured("clamped/m.obj", "RRGG/RRGG/BBWW/BBWW", &[]),
    textured("not_clamped/m.obj", "WBWB/GRGR/WBWB/GRGR", &[]),
    textured(
        "options_behind/m.obj",
        "RGRG/BWBW/RGRG/BWBW",
        &[
            "m.mtl:4: `bump` of this material is not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
    textured(
        "options_not_drawn/m.obj",
        "RG/BW",
        &[
            "m.mtl:3: `map_Kd -mm` and `map_Kd -texres` of this material are not drawn: a surface has a colour (Kd), a texture (map_Kd) and white highlights (Ks, Ns)",
        ],
    ),
];
