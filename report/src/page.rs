//! A report: its sections, their parts, and its files.

use crate::chart::Chart;
use crate::heat_map::HeatMap;
use crate::html;
use crate::picture::Picture;
use crate::problem::{Problems, problems};
use crate::provenance::Provenance;
use crate::table::Table;
use crate::timeline::Timeline;
use crate::verdicts::Verdicts;
use serde::Serialize;

/// A report: a title, an introduction, sections, and its provenance.
///
/// ```
/// use tilewright_report::{Origin, Page, Provenance, Rule, Section, Statement, Verdicts};
///
/// let provenance = Provenance::new("tilewright", "0.1.0", "tilewright reproduce vc1 -o report/");
/// let statement = Statement::new("VC1-TM", "T_m in merge clocks", Rule::Equals).paper([316_864.0]).found(Origin::rtl([]), [316_864.0]);
/// let page = Page::new("The VC-1", provenance)
///     .paragraph("What the paper says, and what its hardware does here.")
///     .section(Section::new("Statements").part(Verdicts::new("statements", "Statements of the paper").state(statement)));
///
/// let names: Vec<String> = page.files().unwrap().into_iter().map(|file| file.name).collect();
/// assert_eq!(names, ["index.html", "report.json", "statements.csv"]);
/// assert_eq!(page.count(), [1, 0, 0]); // statements that hold, differ, cannot be compared
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Page {
    pub(crate) title: String,
    pub(crate) introduction: Vec<String>,
    pub(crate) sections: Vec<Section>,
    pub(crate) provenance: Provenance,
}

/// A report as JSON: the numbers of statements by verdict, then the page.
#[derive(Serialize)]
struct Report<'a> {
    holds: usize,
    differs: usize,
    cannot_be_compared: usize,
    #[serde(flatten)]
    page: &'a Page,
}

/// A part of a page with a title of its own.
///
/// ```
/// use tilewright_report::{Section, Table};
///
/// let forms = Table::new("forms", "The three forms", ["form"]).row(["stack".into()]);
/// assert_eq!(Section::new("Forms").paragraph("There are three.").part(forms).title, "Forms");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Section {
    /// Its title.
    pub title: String,
    pub(crate) parts: Vec<Placed>,
}

/// A part in its section, with its claim in one sentence if it is a figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Placed {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub claim: Option<String>,
    #[serde(flatten)]
    pub part: Part,
}

/// A part of a section. Each kind of part is converted with `into()`.
///
/// ```
/// use tilewright_report::{Part, Table};
///
/// let part: Part = Table::new("forms", "The three forms", ["form"]).into();
/// assert!(matches!(part, Part::Table(_)));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", content = "part", rename_all = "kebab-case")]
pub enum Part {
    /// A paragraph.
    Paragraph(String),
    /// Links to other pages.
    Links(Vec<Link>),
    /// Statements of a paper with their verdicts.
    Verdicts(Verdicts),
    /// Curves and points.
    Chart(Chart),
    /// Lanes over time.
    Timeline(Timeline),
    /// A picture.
    Picture(Picture),
    /// Numbers of a grid.
    HeatMap(HeatMap),
    /// A table.
    Table(Table),
}

/// Another page, beside this one or in a folder beside it.
///
/// ```
/// use tilewright_report::{Link, Section};
///
/// let link = Link::new("quadtree/index.html", "The quadtree generator", "34 statements hold.");
/// assert_eq!(Section::new("Machines").links([link]).title, "Machines");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Link {
    pub(crate) address: String,
    pub(crate) title: String,
    pub(crate) note: String,
}

/// A file of a report.
///
/// ```
/// use tilewright_report::{Page, Provenance};
///
/// let page = Page::new("Nothing yet", Provenance::new("tilewright", "0.1.0", "tilewright list"));
/// let file = page.files().unwrap().remove(0);
/// assert_eq!(file.name, "index.html");
/// assert!(file.bytes.starts_with(b"<!DOCTYPE html>"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

impl Page {
    /// A page without sections.
    ///
    /// ```
    /// use tilewright_report::{Page, Provenance};
    ///
    /// let page = Page::new("The VC-1", Provenance::new("tilewright", "0.1.0", "tilewright list"));
    /// assert_eq!(page.files().unwrap().len(), 2); // the page, and all of it as JSON
    /// ```
    pub fn new(title: impl Into<String>, provenance: Provenance) -> Page {
        Page { title: title.into(), introduction: Vec::new(), sections: Vec::new(), provenance }
    }

    /// Its title.
    ///
    /// ```
    /// use tilewright_report::{Page, Provenance};
    ///
    /// assert_eq!(Page::new("The VC-1", Provenance::new("tilewright", "0.1.0", "tilewright list")).title(), "The VC-1");
    /// ```
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Adds a paragraph to the introduction.
    ///
    /// ```
    /// use tilewright_report::{Page, Provenance};
    ///
    /// let page = Page::new("The VC-1", Provenance::new("tilewright", "0.1.0", "tilewright list")).paragraph("Six 1 & 1/2.");
    /// let html = String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap();
    /// assert!(html.contains("Six 1 &amp; 1/2."));
    /// ```
    pub fn paragraph(mut self, text: impl Into<String>) -> Page {
        self.introduction.push(text.into());
        self
    }

    /// Adds a section.
    ///
    /// ```
    /// use tilewright_report::{Page, Provenance, Section};
    ///
    /// let page = Page::new("The VC-1", Provenance::new("tilewright", "0.1.0", "tilewright list"));
    /// assert_eq!(page.section(Section::new("Statements")).count(), [0, 0, 0]);
    /// ```
    pub fn section(mut self, section: Section) -> Page {
        self.sections.push(section);
        self
    }

    /// The numbers of statements that hold, that differ, and that cannot be compared.
    ///
    /// ```
    /// use tilewright_report::{Page, Provenance};
    ///
    /// assert_eq!(Page::new("None", Provenance::new("tilewright", "0.1.0", "tilewright list")).count(), [0, 0, 0]);
    /// ```
    pub fn count(&self) -> [usize; 3] {
        let mut sum = [0; 3];
        for part in self.parts() {
            if let Part::Verdicts(verdicts) = part {
                sum.iter_mut().zip(verdicts.count()).for_each(|(sum, count)| *sum += count);
            }
        }
        sum
    }

    pub(crate) fn parts(&self) -> impl Iterator<Item = &Part> {
        self.sections.iter().flat_map(|section| &section.parts).map(|placed| &placed.part)
    }

    /// The report as files. `index.html` needs none of the others, and `report.json` has all numbers. Each part has its data as `ID.csv`, or
    /// its picture as `ID.png`. A chart is also a picture for other pages, `ID.svg`. The same report gives the same bytes.
    ///
    /// # Errors
    /// All problems of its parts: names that cannot name a file or are used twice, rows of different lengths, pictures that are not PNG.
    ///
    /// ```
    /// use tilewright_report::{Page, Picture, Provenance, Section};
    ///
    /// let page = Page::new("A picture", Provenance::new("tilewright", "0.1.0", "tilewright list"))
    ///     .section(Section::new("Frame").part(Picture::new("frame", "The frame", "a teapot", b"GIF89a".to_vec())));
    /// let wrong = page.files().unwrap_err().to_string();
    /// assert_eq!(wrong, "the picture `frame` is not a PNG file: give it the bytes of a PNG file");
    /// ```
    pub fn files(&self) -> Result<Vec<File>, Problems> {
        problems(self)?;
        let [holds, differs, cannot_be_compared] = self.count();
        let all = Report { holds, differs, cannot_be_compared, page: self };
        let json = serde_json::to_string_pretty(&all).expect("a page is numbers and texts");
        let file = |name: &str, bytes: Vec<u8>| File { name: name.to_owned(), bytes };
        let mut files = vec![
            file("index.html", html::document(self).into_string().into_bytes()),
            file("report.json", (json + "\n").into_bytes()),
        ];
        files.extend(self.parts().flat_map(|part| [part.file(), part.drawing()]).flatten());
        Ok(files)
    }
}

impl Section {
    /// A section without parts.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Section::new("Statements").title, "Statements");
    /// ```
    pub fn new(title: impl Into<String>) -> Section {
        Section { title: title.into(), parts: Vec::new() }
    }

    /// Adds a paragraph.
    ///
    /// ```
    /// assert_eq!(tilewright_report::Section::new("Forms").paragraph("There are three.").title, "Forms");
    /// ```
    pub fn paragraph(self, text: impl Into<String>) -> Section {
        self.part(Part::Paragraph(text.into()))
    }

    /// Adds a list of other pages.
    ///
    /// ```
    /// use tilewright_report::{Link, Section};
    ///
    /// let links = ["vc1", "quadtree"].map(|name| Link::new(format!("{name}/index.html"), name, ""));
    /// assert_eq!(Section::new("Machines").links(links).title, "Machines");
    /// ```
    pub fn links(self, links: impl IntoIterator<Item = Link>) -> Section {
        self.part(Part::Links(links.into_iter().collect()))
    }

    /// Adds a part.
    ///
    /// ```
    /// use tilewright_report::{Section, Verdicts};
    ///
    /// assert_eq!(Section::new("Statements").part(Verdicts::new("statements", "Statements of the paper")).title, "Statements");
    /// ```
    pub fn part(mut self, part: impl Into<Part>) -> Section {
        self.parts.push(Placed { claim: None, part: part.into() });
        self
    }

    /// Adds a figure below its claim, a short sentence. The figure’s title then tells what is drawn.
    ///
    /// ```
    /// use tilewright_report::{Axis, Chart, Page, Provenance, Section};
    ///
    /// let chart = Chart::new("load", "Load by area", Axis::log("area S, pixels"), Axis::linear("load"));
    /// let page = Page::new("Pipelines", Provenance::new("tilewright", "0.1.0", "tilewright list"))
    ///     .section(Section::new("Load").figure("The load is greatest near 100 pixels.", chart));
    /// let html = String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap();
    /// assert!(html.contains("<h3>The load is greatest near 100 pixels.</h3>"));
    /// ```
    pub fn figure(mut self, claim: impl Into<String>, part: impl Into<Part>) -> Section {
        self.parts.push(Placed { claim: Some(claim.into()), part: part.into() });
        self
    }
}

impl Link {
    /// A page at an address relative to this one: its title, and a sentence about it.
    ///
    /// ```
    /// use tilewright_report::{Link, Page, Provenance, Section};
    ///
    /// let page = Page::new("All", Provenance::new("tilewright", "0.1.0", "tilewright list"))
    ///     .section(Section::new("Machines").links([Link::new("quadtree/index.html", "Trees & stacks", "34 hold.")]));
    /// let html = String::from_utf8(page.files().unwrap().remove(0).bytes).unwrap();
    /// assert!(html.contains(r#"<li><a href="quadtree/index.html">Trees &amp; stacks</a> 34 hold.</li>"#));
    /// ```
    pub fn new(address: impl Into<String>, title: impl Into<String>, note: impl Into<String>) -> Link {
        Link { address: address.into(), title: title.into(), note: note.into() }
    }
}

macro_rules! parts {
    ($($kind:ident),*) => {
        $(impl From<$kind> for Part {
            fn from(part: $kind) -> Part {
                Part::$kind(part)
            }
        })*
    };
}
parts!(Verdicts, Chart, Timeline, Picture, HeatMap, Table);

impl Part {
    /// Its kind in the words of a problem, and its name in addresses and files.
    pub(crate) fn name(&self) -> Option<(&'static str, &str)> {
        match self {
            Part::Paragraph(_) | Part::Links(_) => None,
            Part::Verdicts(verdicts) => Some(("table of verdicts", &verdicts.id)),
            Part::Chart(chart) => Some(("chart", &chart.id)),
            Part::Timeline(chart) => Some(("chart of times", &chart.id)),
            Part::Picture(picture) => Some(("picture", &picture.id)),
            Part::HeatMap(map) => Some(("heat map", &map.id)),
            Part::Table(table) => Some(("table", &table.id)),
        }
    }

    /// Its data as a file.
    pub(crate) fn file(&self) -> Option<File> {
        let (_, id) = self.name()?;
        let (kind, bytes) = match self {
            Part::Paragraph(_) | Part::Links(_) => return None,
            Part::Verdicts(verdicts) => ("csv", verdicts.csv()),
            Part::Chart(chart) => ("csv", chart.csv_text().into_bytes()),
            Part::Timeline(chart) => ("csv", chart.csv_text().into_bytes()),
            Part::Picture(picture) => ("png", picture.png.clone()),
            Part::HeatMap(map) => ("csv", map.csv_text().into_bytes()),
            Part::Table(table) => ("csv", table.csv_text().into_bytes()),
        };
        Some(File { name: format!("{id}.{kind}"), bytes })
    }

    /// A chart as a picture in a file.
    fn drawing(&self) -> Option<File> {
        let (id, svg) = match self {
            Part::Chart(chart) => (&chart.id, chart.svg_text()),
            Part::Timeline(chart) => (&chart.id, chart.svg_text()),
            _ => return None,
        };
        Some(File { name: format!("{id}.svg"), bytes: svg.into_bytes() })
    }
}
