//! The geometry of a diagram's SVG, read from its text.

/// Left, top, right and bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect(pub [f64; 4]);

/// A box.
#[derive(Debug, PartialEq)]
pub struct Shape {
    pub rect: Rect,
    /// Without the point of a port.
    pub core: Rect,
    /// The extents of its texts.
    pub texts: Vec<Rect>,
}

/// A picture in the coordinates of its main group.
pub struct Picture {
    pub page: Rect,
    pub boxes: Vec<Shape>,
    pub frames: Vec<Rect>,
    /// The pieces of each line.
    pub lines: Vec<Vec<Rect>>,
    pub labels: Vec<Rect>,
}

/// The ascent and descent of fonts of 12 and 10 pixels.
const HEIGHTS: [[f64; 2]; 2] = [[9.0, 2.5], [7.5, 2.0]];

impl Picture {
    pub fn read(svg: &str) -> Picture {
        let at = numbers(svg.lines().find(|line| line.starts_with("<g transform=")).unwrap());
        let size = numbers(attribute(svg.lines().next().unwrap(), "viewBox"));
        let page = Rect([-at[0], -at[1], size[2] - at[0], size[3] - at[1]]);
        let mut picture = Picture { page, boxes: vec![], frames: vec![], lines: vec![], labels: vec![] };
        for line in svg.lines() {
            // The path of a line follows its title.
            let element = line.rfind("<path class=\"line").map_or(line, |at| &line[at..]);
            picture.add(element);
        }
        picture
    }

    fn add(&mut self, element: &str) {
        if !element.contains(" class=\"") {
            return;
        }
        let classes: Vec<&str> = attribute(element, "class").split(' ').collect();
        let number = |name: &str| attribute(element, name).parse::<f64>().unwrap();
        let rect = || {
            let [x, y, width, height] = ["x", "y", "width", "height"].map(number);
            Rect([x, y, x + width, y + height])
        };
        match classes[..] {
            [.., "inner"] | ["box", "inner", ..] => {}
            ["box", "port", ..] => {
                let ns = numbers(attribute(element, "d"));
                // Outputs of narrow pictures point to the left.
                let [rect, core] = [ns[3], ns[2]].map(|end| Rect([ns[0].min(end), ns[1], ns[0].max(end), ns[6]]));
                self.boxes.push(Shape { rect, core, texts: vec![] });
            }
            ["box", ..] => self.boxes.push(Shape { rect: rect(), core: rect(), texts: vec![] }),
            ["frame"] => self.frames.push(rect()),
            // The samples of the key are drawn with relative commands.
            ["line", ..] => self.lines.extend(pieces(attribute(element, "d"))),
            ["label", "middle"] => self.labels.push(text(element, 6.02, HEIGHTS[1])),
            [kind @ ("name" | "note"), "middle"] => {
                // The widths of DejaVu Sans Mono, and of DejaVu Sans where it is wide.
                let (width, heights) = if kind == "name" { (7.23, HEIGHTS[0]) } else { (6.0, HEIGHTS[1]) };
                self.boxes.last_mut().unwrap().texts.push(text(element, width, heights));
            }
            _ => {}
        }
    }
}

/// The extent of a centred text.
fn text(element: &str, width: f64, [above, below]: [f64; 2]) -> Rect {
    let [x, y] = ["x", "y"].map(|name| attribute(element, name).parse::<f64>().unwrap());
    let words = element.split(['>', '<']).nth(2).unwrap();
    let half = words.chars().count() as f64 * width / 2.0;
    Rect([x - half, y - above, x + half, y + below])
}

fn attribute<'a>(element: &'a str, name: &str) -> &'a str {
    let (_, rest) = element.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("{element} has no {name}"));
    rest.split('"').next().unwrap()
}

fn numbers(text: &str) -> Vec<f64> {
    text.split(|c: char| !c.is_ascii_digit() && c != '.' && c != '-').filter_map(|it| it.parse().ok()).collect()
}

/// The pieces of a path such as `M1 2 H3 V4`; none if it has other commands.
fn pieces(path: &str) -> Option<Vec<Rect>> {
    let mut words = path.strip_prefix('M')?.split(' ');
    let [mut x, mut y] = [words.next()?.parse::<f64>().ok()?, words.next()?.parse().ok()?];
    let mut pieces = Vec::new();
    for word in words {
        let before = [x, y];
        match word.split_at(1) {
            ("H", to) => x = to.parse().ok()?,
            ("V", to) => y = to.parse().ok()?,
            _ => return None,
        }
        pieces.push(Rect([x.min(before[0]), y.min(before[1]), x.max(before[0]), y.max(before[1])]));
    }
    Some(pieces)
}
