//! The block diagrams of all blocks: complete, and readable.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use tilewright_gen::{ArrowKind, BoxKind, Diagram, DiagramOptions, diagram};
use tilewright_hdl::Design;
use tilewright_hdl::catalog::Entry;
use tilewright_rtl::catalog::{ENTRIES, find};

#[path = "diagrams/picture.rs"]
mod picture;

use picture::{Picture, Rect, Shape};

/// A block with its diagram, as the command draws it by default.
struct Drawn {
    name: &'static str,
    design: Design,
    diagram: Diagram,
    /// In columns, and narrow.
    pictures: [Picture; 2],
}

/// Every block.
static DRAWN: LazyLock<Vec<Drawn>> = LazyLock::new(|| {
    let drawn = |entry: &Entry| {
        let design = design(entry);
        let diagram = diagram(&design, &DiagramOptions::default()).unwrap();
        let pictures = [diagram.svg(), diagram.narrow_svg()].map(|svg| Picture::read(&svg));
        Drawn { name: entry.name, design, diagram, pictures }
    };
    ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES).map(drawn).collect()
});

/// Each diagram with each of its pictures.
fn pictures() -> impl Iterator<Item = (&'static str, &'static Diagram, &'static Picture)> {
    DRAWN.iter().flat_map(|it| it.pictures.iter().map(|picture| (it.name, &it.diagram, picture)))
}

fn design(entry: &Entry) -> Design {
    entry.design(&entry.values([]).unwrap()).unwrap()
}

fn drawn(entry: &Entry, options: &DiagramOptions) -> Diagram {
    diagram(&design(entry), options).unwrap()
}

/// `tilewright diagram BLOCK --ascii` prints these files.
#[test]
fn small_blocks_are_drawn_as_a_paper_would() {
    let golden = [
        ("merging-unit", include_str!("diagrams/merging-unit.txt")),
        ("page-id-generator", include_str!("diagrams/page-id-generator.txt")),
        ("patch-table", include_str!("diagrams/patch-table.txt")),
        ("video-processor", include_str!("diagrams/video-processor.txt")),
    ];
    for (name, expected) in golden {
        let text = drawn(find(name).unwrap(), &DiagramOptions::default()).ascii();
        assert!(text == expected, "{name} is drawn otherwise than in rtl/tests/diagrams:\n{text}");
    }
}

/// The paths of streams, given those of the ports that can be their `valid` and `ready`.
fn streams(valid: &[&str], ready: &[&str]) -> BTreeSet<String> {
    let names = valid.iter().filter_map(|path| path.strip_suffix(".valid"));
    let names = names.filter(|name| ready.contains(&format!("{name}.ready").as_str()));
    let star = |part: &str| if part.parse::<u32>().is_ok() { "[*]".to_owned() } else { format!(".{part}") };
    names.map(|name| name.split('.').map(star).collect::<String>()[1..].to_owned()).collect()
}

#[test]
fn every_instance_and_every_stream_is_in_the_diagram() {
    let mut count = 0;
    for Drawn { name: block, design, diagram, .. } in DRAWN.iter() {
        let named = |kind: BoxKind, name: &str| {
            let it = diagram.boxes.iter().position(|it| it.kind == kind && it.names == [name]);
            it.unwrap_or_else(|| panic!("{block}: {kind:?} {name} is not drawn"))
        };
        let is_stream = |arrow: &&tilewright_gen::Arrow| arrow.kind == ArrowKind::Stream;
        let arrows = || diagram.arrows.iter().filter(is_stream);
        for (comes_in, kind) in [(true, BoxKind::Input), (false, BoxKind::Output)] {
            for stream in streams_of(design.top(), comes_in) {
                let index = named(kind, &stream);
                assert!(diagram.boxes[index].is_stream, "{block}: {stream}");
                assert!(arrows().any(|it| it.from == index || it.to == index), "{block}: {stream}");
                count += 1;
            }
        }
        for instance in &design.top().instances {
            let index = named(BoxKind::Instance, &instance.name);
            if !streams_of(design.module(instance.module), true).is_empty() {
                assert!(arrows().any(|it| it.to == index), "{block}: a stream to {}", instance.name);
                count += 1;
            }
        }
    }
    assert!(count > 100, "only {count} streams were found");
}

fn streams_of(module: &tilewright_hdl::ir::Module, comes_in: bool) -> BTreeSet<String> {
    let inputs: Vec<&str> = module.inputs.iter().map(|port| port.path.as_str()).collect();
    let outputs: Vec<&str> = module.outputs.iter().map(|port| port.path.as_str()).collect();
    if comes_in { streams(&inputs, &outputs) } else { streams(&outputs, &inputs) }
}

#[test]
fn no_box_and_no_arrow_is_drawn_twice() {
    for Drawn { name, diagram, .. } in DRAWN.iter() {
        let members: Vec<(BoxKind, &str)> =
            diagram.boxes.iter().flat_map(|it| it.members.iter().map(|name| (it.kind, name.as_str()))).collect();
        assert_eq!(members.iter().collect::<BTreeSet<_>>().len(), members.len(), "{name}");
        let arrows: BTreeSet<_> = diagram.arrows.iter().map(|it| (it.from, it.to, it.kind)).collect();
        assert_eq!(arrows.len(), diagram.arrows.len(), "{name}");
    }
}

#[test]
fn a_diagram_has_as_much_as_can_be_read() {
    for Drawn { name, diagram, .. } in DRAWN.iter() {
        let (boxes, arrows) = (diagram.boxes.len(), diagram.arrows.len());
        assert!(boxes <= 24 && arrows <= 42, "{name}: {boxes} boxes and {arrows} arrows");
    }
}

#[test]
fn pictures_have_room_for_everything() {
    for (name, diagram, picture) in pictures() {
        assert_eq!(picture.boxes.len(), diagram.boxes.len(), "{name}");
        assert_eq!(picture.lines.len(), diagram.arrows.len(), "{name}");
        for (i, Shape { rect, texts, .. }) in picture.boxes.iter().enumerate() {
            assert!(picture.page.holds(rect), "{name}: {rect:?} is not in the picture");
            let other = picture.boxes[..i].iter().find(|other| other.rect.overlaps(rect));
            assert_eq!(other, None, "{name}: two boxes overlap");
            assert!(!texts.is_empty(), "{name}: a box without a name");
            for text in texts {
                assert!(rect.holds(text), "{name}: {text:?} is not in {rect:?}");
            }
        }
        for line in &picture.lines {
            for piece in line {
                let through = picture.boxes.iter().find(|it| it.core.overlaps(piece));
                assert_eq!(through, None, "{name}: {piece:?} goes through a box");
                assert!(picture.page.holds(piece), "{name}: {piece:?} is not in the picture");
            }
        }
        for (i, label) in picture.labels.iter().enumerate() {
            let others = picture.labels[..i].iter().chain(picture.boxes.iter().map(|it| &it.rect));
            assert_eq!(
                others.into_iter().find(|other| other.overlaps(label)),
                None,
                "{name}: {label:?} is over another"
            );
            assert!(picture.page.holds(label), "{name}: {label:?}");
        }
    }
}

/// Two lines may cross, but neither hides the other.
#[test]
fn lines_of_different_boxes_do_not_lie_on_each_other() {
    for (name, diagram, picture) in pictures() {
        let lines: Vec<_> = diagram.arrows.iter().map(|arrow| arrow.from).zip(&picture.lines).collect();
        for (i, (from, line)) in lines.iter().enumerate() {
            for (_, other) in lines[..i].iter().filter(|(other, _)| other != from) {
                let hidden = line.iter().find(|piece| other.iter().any(|it| it.lies_on(piece)));
                assert_eq!(hidden, None, "{name}: a line of {:?}", diagram.boxes[*from].names);
            }
        }
    }
}

/// A telephone shows a picture 360 pixels wide; names are then at least 8 pixels high.
#[test]
fn narrow_pictures_are_legible_on_a_telephone() {
    for Drawn { name, pictures: [_, narrow], .. } in DRAWN.iter() {
        let width = narrow.page.0[2];
        assert!(width <= 12.0 / 8.0 * 360.0, "{name}: {width} pixels");
    }
}

#[test]
fn opened_instances_are_frames_around_what_is_inside() {
    let options = DiagramOptions { depth: 2, ..DiagramOptions::default() };
    for name in ["image-merger", "raster-processor", "network-port"] {
        let diagram = drawn(find(name).unwrap(), &options);
        for picture in [diagram.svg(), diagram.narrow_svg()].map(|svg| Picture::read(&svg)) {
            assert_eq!(picture.frames.len(), diagram.frames.len());
            assert!(!picture.frames.is_empty(), "{name}");
            for (it, Shape { rect, .. }) in diagram.boxes.iter().zip(&picture.boxes) {
                for (index, frame) in picture.frames.iter().enumerate() {
                    let is_inside = it.frame == Some(index);
                    assert!(
                        if is_inside { frame.holds(rect) } else { !frame.overlaps(rect) },
                        "{name}: {:?}",
                        it.names
                    );
                }
            }
        }
    }
}

#[test]
fn the_same_block_gives_the_same_bytes() {
    for name in ["vc1", "lfb-unit", "sine-cosine"] {
        let entry = ENTRIES.iter().chain(tilewright_blocks::catalog::ENTRIES).find(|it| it.name == name).unwrap();
        let [one, two] = [0, 1].map(|_| drawn(entry, &DiagramOptions::default()));
        assert!(
            one.svg() == two.svg()
                && one.narrow_svg() == two.narrow_svg()
                && one.dot() == two.dot()
                && one.ascii() == two.ascii(),
            "{name}"
        );
    }
}

impl Rect {
    fn holds(&self, other: &Rect) -> bool {
        let [left, top, right, bottom] = other.0;
        self.0[0] <= left && self.0[1] <= top && right <= self.0[2] && bottom <= self.0[3]
    }

    /// Whether two pieces of lines are parallel, less than a pixel apart, and overlap by more than that.
    fn lies_on(&self, other: &Rect) -> bool {
        let [left, top, right, bottom] = other.0;
        let width = self.0[2].min(right) - self.0[0].max(left);
        let height = self.0[3].min(bottom) - self.0[1].max(top);
        width > -1.0 && height > -1.0 && (width > 1.0 || height > 1.0)
    }

    fn overlaps(&self, other: &Rect) -> bool {
        let [left, top, right, bottom] = other.0;
        // Lengths are rounded to tenths of a pixel.
        left + 0.2 < self.0[2] && self.0[0] + 0.2 < right && top + 0.2 < self.0[3] && self.0[1] + 0.2 < bottom
    }
}
