//! Every bad input ends in exit code 2 and a sentence that names the place and the remedy; nothing is written.

use crate::cli::harness::Folder;

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Command lines, each with what the message has to say.
const CASES: &[(&str, &[&str])] = &[
    ("render missing.obj", &["missing.obj: cannot be read", "name a .toml, .obj"]),
    ("render missing.toml", &["missing.toml: cannot be read"]),
    ("render malformed.obj", &["malformed.obj:2: "]),
    ("render no_vertex.obj", &["no_vertex.obj:4: "]),
    ("render nan.obj", &["nan.obj:3: ", "NaN"]),
    ("render malformed.toml", &["malformed.toml:2:"]),
    ("render nan.toml", &["nan.toml:3:"]),
    ("render behind.toml", &["behind"]),
    ("render teepot", &["there is no scene `teepot`: did you mean `teapot`?"]),
    ("render teapot --size 0x48", &["0x48", "between 1 and 2048"]),
    ("render teapot --size 64", &["'64'", "such as 640x480"]),
    ("render teapot --processors 257", &["'257' for '--processors <N>': give a whole number from 1 to 256"]),
    ("render teapot --frames 0", &["'0' for '--frames <N>': give a whole number from 1 to 1000"]),
    ("render teapot --turn 5", &["--frames <N>"]),
    ("render teapot --frames 2 --turn nan", &["--turn NaN: give a finite number of degrees, such as 7.5"]),
    ("render teapot --frames 2 -o -", &["standard output takes one picture", "name a file with -o, such as turn.png"]),
    (
        "render teapot --size 32x24 --frames 2 --golden small.png",
        &["--golden names one picture", "leave one of them out"],
    ),
    ("render teapot --frames 2 -o turn.png --vcd turn-002.png", &["turn-002.png", "another output"]),
    ("render teapot --apr none", &["'none' for '--apr <PIXELS>': give a whole number of pixels, such as 500, or off"]),
    ("render teapot --queue 9", &["'9' for '--queue <WORDS>': give a whole number from 10 to 4096"]),
    ("render teapot --processors abc", &["'abc' for '--processors <N>': give a whole number from 1 to 256"]),
    ("render teapot --pages 1", &["give a whole number from 2 to 262144"]),
    ("prove fifo --depth 0", &["give a whole number from 1 to 10000"]),
    ("prove fifo --seconds soon", &["give a whole number from 1 to 1000000"]),
    ("verilog counter -o out --reset asynk-low", &["there is no kind of reset `asynk-low`: did you mean `async-low`?"]),
    ("render teapot --refresh 0", &["0 refreshes a second", "VGA has 60"]),
    ("render teapot --refresh many", &["invalid value 'many' for '--refresh <HZ>'"]),
    ("render teapot --swap never", &["error: there is no time to swap `never`: give one of at-start, in-blanking\n"]),
    ("diagram vc1", &["there is no output", "-o FILE.svg", "--ascii"]),
    (
        "diagram vc1 -o vc1.png",
        &["'vc1.png' for '--output <FILE>': name a picture, as block.svg, or a graph, as block.dot"],
    ),
    ("diagram vc1 --depth 0 -o x.svg", &["'0' for '--depth <N>': give a whole number from 1 to 100"]),
    ("diagram vc2 -o x.svg", &["there is no block `vc2`: did you mean `vc1`?"]),
    ("diagram vc1 --around u_gbf -o x.svg", &["error: there is no net `u_gbf`: did you mean `u_gfb`?\n"]),
    ("diagram vc1 --around u_gfb.banks -o x.svg", &["there is no net `u_gfb.banks`", "or show more levels"]),
    ("diagram vc1 --around u_gfb --steps 0 -o x.svg", &["'0' for '--steps <N>': give a whole number from 1 to 100"]),
    ("diagram vc1 --set processors=0 -o x.svg", &["processors = 0 is out of range"]),
    ("synth", &["<BLOCK>"]),
    ("synth counter --all", &["'<BLOCK>' cannot be used with '--all'"]),
    (
        "synth counter --device ecp5",
        &["error: there is no device `ecp5`: did you mean `ecp5-85k`? There are ecp5-85k, ecp5-25k, ice40-up5k, "],
    ),
    ("synth countr", &["error: there is no block `countr`: did you mean `counter`?"]),
    ("synth counter --set limit=0", &["limit = 0 is out of range"]),
    ("synth counter --freq 0", &["'0' for '--freq <MHZ>': give a whole number from 1 to 1000"]),
    ("synth counter --seed 0", &["'0' for '--seed <N>': give a whole number from 1 to 1000000"]),
    ("synth counter -o -", &["standard output takes one file", "name a folder"]),
    ("bench --rounds 0", &["'0' for '--rounds <N>': give a whole number from 1 to 1000"]),
    ("render teapot --patch 5", &["'5'", "4, 8, 16"]),
    ("render teapot --size 64x48 --pages 193", &["`pages`", "is 193:", "from 2 to 192"]),
    (
        "render teapot --assign twice",
        &["error: there is no way to assign polygons `twice`: give one of once, each, count\n"],
    ),
    (
        "render teapot --cost geometry=631",
        &[
            "'geometry=631' for '--cost <NAME=CLOCKS>': there is no step `geometry`: give one of vertex, polygon, area, clip, set-up, row, pixel, clear, send, receive\n",
        ],
    ),
    ("render teapot --cost setup=5", &["there is no step `setup`: did you mean `set-up`? There are vertex, "]),
    ("render teapot --cost set_up=5 --cost set-up=5", &["error: --cost set-up is given twice: leave one out\n"]),
    ("render teapot --cost row", &["give a step and its clocks, such as row=60; the steps are vertex, polygon, area"]),
    ("render teapot --cost row=-1", &["row has to be from 0 to 1000000 clocks\n"]),
    (
        "render teapot --cost pixel=0",
        &[
            "pixel has to be from 1 to 1000000 clocks; steps that can take 0 clocks are vertex, polygon, area, clip, set-up, row\n",
        ],
    ),
    ("render teapot --cost row=1 --cost row=1", &["error: --cost row is given twice: leave one out\n"]),
    (
        "render teapot --machine quadtree --cost row=1",
        &["error: --cost is an option of vc1, and the machine is quadtree: leave it out, or pass --machine vc1\n"],
    ),
    (
        "render teapot --machine vc2",
        &["error: there is no machine `vc2`: did you mean `vc1`? There are vc1, quadtree, pixel"],
    ),
    ("compare star --machine pixel_flows", &["error: there is no machine `pixel_flows`: did you mean `pixelflow`?"]),
    ("reproduce quadtrees -o report", &["error: there is no paper `quadtrees`: did you mean `quadtree`?"]),
    ("completions bsh", &["error: there is no shell `bsh`: did you mean `bash`?"]),
    ("explain scan-counter --pass foldd", &["error: there is no pass `foldd`: did you mean `fold`?"]),
    (
        "render teapot --machine quadtree --processors 4",
        &[
            "error: --processors is an option of vc1, and the machine is quadtree: leave it out, or pass --machine vc1\n",
        ],
    ),
    (
        "render teapot --strict",
        &[
            "error: --strict is an option of quadtree and pixel-planes-5, and the machine is vc1: leave it out, or pass --machine quadtree\n",
        ],
    ),
    (
        "render teapot --machine quadtree --matrix 3x3",
        &["'3x3' for '--matrix <PxQ>': a matrix of 3x3 video processors: each side has to be 1, 2, 4, 8 or 16"],
    ),
    (
        "render teapot --machine quadtree --matrix 4",
        &["'4' for '--matrix <PxQ>': give the columns and rows of video processors", "such as 4x4"],
    ),
    (
        "render teapot --machine quadtree --form pipe:3",
        &["error: the form `pipe:3`: it divides 3 levels; 640x480 pixels on a matrix of 4x4 have 8\n"],
    ),
    (
        "render teapot --machine quadtree --form heap",
        &["'heap' for '--form <FORM>': there is no part `heap`: give one of stack, pipe, tree\n"],
    ),
    ("render teapot --machine quadtree --form tree", &["the form `tree:8`: a tree divides at most 4 levels"]),
    ("render teapot --machine quadtree --form stak:2+pipe", &["there is no part `stak`: did you mean `stack`?"]),
    (
        "render teapot --machine quadtree --test fast",
        &["error: there is no test `fast`: give one of serial, parallel\n"],
    ),
    (
        "render teapot --machine quadtree --aperture 3",
        &["error: an aperture of 3 pixels: it has to be even, and from 0 to 8\n"],
    ),
    (
        "render teapot --machine quadtree --window-queue 0",
        &["'0' for '--window-queue <N>': give a whole number from 1 to 4096"],
    ),
    (
        "render teapot --engine fast",
        &["error: there is no engine `fast`: give one of reference, interpreter, compiled, both\n"],
    ),
    ("wave merging-unit --ascii --engine compile", &["there is no engine `compile`: did you mean `compiled`?"]),
    ("render teapot --from 1us", &["name it with --vcd FILE"]),
    ("render teapot --vcd run.vcd --from 2us --to 1500ns", &["no time is left between --from and --to"]),
    ("render teapot --golden malformed.obj", &["malformed.obj", "PNG"]),
    ("render teapot --size 64x48 --vcd run.vcd --scope nothing.*", &["no signal that matches `nothing.*`"]),
    ("golden teapot", &["--output <FILE>"]),
    ("golden teapot -o g.png --samples 4", &["'4' for '--samples <N>'", "1, 8"]),
    ("golden teapot -o g.png --samples 8 --shade-once", &["--deferred"]),
    (
        "golden teapot -o g.png --deferred --shade-once",
        &["--shade-once needs several samples per pixel: add --samples 8"],
    ),
    ("golden teapot -o g.png --size 1025x64 --samples 8", &["1025x64 pixels with 8 samples", "up to 1024"]),
    ("golden no_texture.toml -o g.png", &["no_texture.toml:3:11: there is no texture lost.png: correct the path"]),
    (
        "golden no_texture.obj -o g.png --deferred",
        &["no_texture.mtl:2: there is no texture lost.png: correct the path"],
    ),
    (
        "wave mergin-unit --ascii",
        &[
            "error: there is no block `mergin-unit`: did you mean `merging-unit`? `tilewright list blocks` shows all names\n",
        ],
    ),
    (
        "wave merging-unit --ascii --radix octal",
        &["error: there is no radix `octal`: give one of decimal, hex, binary\n"],
    ),
    (
        "wave merging-unit -o mu.vcd --radix hex",
        &[
            "error: --radix is for text and pictures, and -o names a waveform file: leave out -o, or name a picture with -o, such as wave.svg\n",
        ],
    ),
    ("wave merging-unit --json", &["error: --json needs a waveform file: name it with -o FILE\n"]),
    ("wave image-merger --ascii --set units=2 --set units=3", &["units is set twice"]),
    (
        HUGE,
        &["the block's memories take ", " MiB in a simulation, and the limit is 2048 MiB", "--set smaller parameters"],
    ),
    ("render teapot --vcd same -o same", &["same: would be written over same, another output"]),
    ("render teapot --vcd ./same -o same", &["./same: would be written over same, another output"]),
    ("render teapot -o f.png --vcd f.difference.png", &["would be written over f.difference.png, another output"]),
    ("render mesh.obj -o mesh.obj", &["mesh.obj: would be written over mesh.obj, which is read"]),
    ("render mesh.obj --vcd ./mesh.obj", &["./mesh.obj: would be written over mesh.obj, which is read"]),
    ("golden mesh.obj -o mesh.obj", &["mesh.obj: would be written over mesh.obj, which is read: name another output"]),
    ("render teapot --size 64x48 --golden malformed.obj -o malformed.obj", &["which is read"]),
    (
        "render teapot --size 64x48 --golden small.png",
        &["small.png: has 32x24 pixels, and the frame has 64x48", "--size 32x24"],
    ),
    ("render flat.obj", &["flat.obj: holds no face with an area and no line with a length, so nothing would be drawn"]),
    ("render polyline.obj", &["polyline.obj:2: a polyline with 1 corner is not drawn: give at least two"]),
    ("render wireframe.toml", &["wireframe.toml:2:13: invalid type: string \"yes\": write true or false"]),
    ("render one_light.toml", &["one_light.toml:2:1: `light` is one table: write `[[light]]`"]),
    ("render long.toml", &["long.toml:2:8: invalid length 3"]),
    ("render misspelt.toml", &["did you mean `teapot`?"]),
    ("wave image-merger --ascii --set units=257", &["units = 257", "from 1 to 256"]),
    (
        "wave image-merger --ascii --set unit=2",
        &["error: image-merger has no parameter `unit`: did you mean `units`? There are units\n"],
    ),
    ("wave merging-unit --ascii --set unit=2", &["merging-unit has no parameters, so `unit` cannot be set"]),
    ("wave image_merger --ascii --set units=257", &["units = 257", "from 1 to 256"]),
    ("wave image-merger --ascii --set units", &["'units'", "NAME=VALUE"]),
    ("wave image-merger --ascii --scope **", &["name it with -o FILE"]),
    ("wave image-merger -o some.gtkw", &["name the waveform itself, such as wave.vcd"]),
    ("wave image-merger -o some.vcd --to 5", &["'5'", "such as 250ns"]),
    ("verilog gfb-unit -o out --set width=1", &["width = 1", "from 2 to 2048"]),
    (
        "verilog gfb-unit -o out --set width=2048 --set height=2048 --testbench",
        &["a testbench can have 200000 at most"],
    ),
    (
        "wave gfb-unit --ascii --set width=2048 --set height=2048",
        &["a wave in text can have 200000 at most: --set smaller"],
    ),
    (
        "verilog merging-unit -o out --constraints lfp",
        &["there is no dialect of constraints `lfp`: give one of sdc, xdc, lpf, pcf"],
    ),
    ("verilog merging-unit -o out --pins board.pins", &["--constraints"]),
    (
        "verilog merging-unit -o out --constraints lpf --pins gone.pins",
        &["gone.pins: No such file or directory: name a text file with a row for each port"],
    ),
    ("verilog nothing -o out", &["error: there is no block `nothing`: ", "`tilewright list blocks` shows all names\n"]),
    (
        "bench pin16",
        &[
            "'pin16'",
            "did you mean `pim16`? Otherwise name a design as ",
            "pimN, qtN, flatN, coreN, simdN, pxplN, systolicN, vc1xN",
            "such as pim16",
        ],
    ),
    ("bench simd257", &["'simd257'", "from 1 to 256"]),
    ("bench --seconds 0", &["'0'", "from 0.001 to 1000 seconds"]),
    ("bench --against modelsim", &["error: there is no simulator `modelsim`: give one of verilator\n"]),
    (
        "list merging_unti",
        &["error: there is no block, machine, scene or part of the list `merging_unti`: did you mean `merging-unit`?"],
    ),
    ("rendr teapot", &["'rendr'", "'render'"]),
];

/// A triangle whose texture is not there.
const NO_TEXTURE: &str = "mtllib no_texture.mtl\nusemtl wood\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";

/// A VC-1 whose image memories would take a terabyte.
const HUGE: &str = "wave vc1 -o some.vcd --set processors=256 --set width=2048 --set height=2048 --set pages=262144";

#[test]
fn bad_input_is_named_with_a_remedy() {
    let files = [
        ("malformed.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n"),
        ("no_vertex.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
        ("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 NaN 0\nf 1 2 3\n"),
        ("mesh.obj", OBJ),
        ("malformed.toml", "mesh = \"mesh.obj\"\nsize = [640\n"),
        ("nan.toml", "mesh = \"mesh.obj\"\n[camera]\neye = [nan, 0, 5]\n"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        ("polyline.obj", "v 0 0 0\nl 1\n"),
        ("wireframe.toml", "mesh = \"teapot\"\nwireframe = \"yes\"\n"),
        ("one_light.toml", "mesh = \"teapot\"\n[light]\ntoward = [0, 0, 1]\nintensity = 1\n"),
        ("no_texture.toml", "mesh = \"teapot\"\n[surface]\ntexture = \"lost.png\"\n"),
        ("no_texture.obj", NO_TEXTURE),
        ("no_texture.mtl", "newmtl wood\nmap_Kd lost.png\n"),
        ("long.toml", "mesh = \"teapot\"\nsize = [10, 10, 10]\n"),
        ("misspelt.toml", "mesh = \"teapto\"\n"),
        ("behind.toml", "mesh = \"mesh.obj\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\n"),
    ];
    let folder = Folder::with(&files);
    folder.stdout("golden teapot --size 32x24 -o small.png");
    let names = folder.names();
    for (line, parts) in CASES {
        let run = folder.run(line);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{line}: {run:?}");
        assert!(run.stderr.starts_with("error: "), "{line}: {run:?}");
        for part in *parts {
            assert!(run.stderr.contains(part), "{line}: no `{part}` in {}", run.stderr);
        }
        assert!(!run.stderr.contains("panicked") && !run.stderr.contains("mistake in tilewright"), "{line}: {run:?}");
    }
    assert_eq!(folder.names(), names, "a failed command leaves files");
}
