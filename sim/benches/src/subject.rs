//! The subjects of measurements: designs of some size, by name, with their known results.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;
use tilewright_hdl::{Design, Problems, elaborate};
use tilewright_rtl::parameter::Screen;

use crate::designs::{Core, Nodes, Pim, Pxpl, Qt, Regions, Simd, Systolic, Vc1Frames};

/// A kind of design; a size makes it a [`Subject`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// [`Pim`]; its size is the number of stages.
    Pim,
    /// [`Qt`]; its size is the number of units.
    Qt,
    /// [`Qt`] with units that are modules of their own; its size is the number of units.
    Flat,
    /// [`Core`]; its size is the number of processors.
    Core,
    /// [`Simd`]; its size is the number of processors in a row.
    Simd,
    /// [`Pxpl`]; its size is the number of processors in a row, a power of two.
    Pxpl,
    /// [`Systolic`]; its size is the side of its grid.
    Systolic,
    /// [`Vc1Frames`]; its size is the number of processors.
    Vc1,
    /// [`Regions`]; its size is the number of pixels in a line of a region, a power of two.
    Renderer,
    /// [`Nodes`]; its size is the number of renderers.
    Nodes,
}

impl Family {
    /// Every family.
    pub const ALL: [Family; 10] = [
        Family::Pim,
        Family::Qt,
        Family::Flat,
        Family::Core,
        Family::Simd,
        Family::Pxpl,
        Family::Systolic,
        Family::Vc1,
        Family::Renderer,
        Family::Nodes,
    ];

    /// Its name, which precedes the size.
    pub fn name(self) -> &'static str {
        match self {
            Family::Pim => "pim",
            Family::Qt => "qt",
            Family::Flat => "flat",
            Family::Core => "core",
            Family::Simd => "simd",
            Family::Pxpl => "pxpl",
            Family::Systolic => "systolic",
            Family::Vc1 => "vc1x",
            Family::Renderer => "renderer",
            Family::Nodes => "nodes",
        }
    }

    /// What it is, with N for its size.
    pub fn about(self) -> &'static str {
        match self {
            Family::Pim => "a chain of N merging units, each with a local frame buffer",
            Family::Qt => "N units that walk down quadtrees",
            Family::Flat => "the units of qtN, each a module of its own, so that nothing is replicated",
            Family::Core => "N processors of RV32I, each with a program that sorts words",
            Family::Simd => "N x N processors under one instruction",
            Family::Pxpl => {
                "N x N processors of one bit under one instruction, fed by a serial tree; N is a power of two"
            }
            Family::Systolic => "N x N cells that multiply matrices",
            Family::Vc1 => "a VC-1 with N processors that draw at random, frame after frame",
            Family::Renderer => "a renderer of Pixel-planes 5 that draws regions of N x N pixels; N is a power of two",
            Family::Nodes => "N renderers of 32 x 32 pixels, one of them busy at a time",
        }
    }

    /// The possible sizes.
    pub fn sizes(self) -> RangeInclusive<u32> {
        match self {
            Family::Pim | Family::Qt => 1..=4096,
            Family::Flat | Family::Core | Family::Simd | Family::Systolic | Family::Vc1 => 1..=256,
            Family::Pxpl | Family::Renderer => 8..=256,
            Family::Nodes => 1..=64,
        }
    }

    /// Whether it has an input `rst`, by which several stimuli differ.
    fn has_rst(self) -> bool {
        !matches!(self, Family::Vc1 | Family::Renderer | Family::Nodes)
    }

    const fn of_size(self, size: u32) -> Subject {
        Subject { family: self, size, screen: Screen::VC1, stimuli: 1 }
    }
}

/// A design of some size, such as `pim16`, or `vc1x16@160x120` with a screen of that size. `qt1*16` is `qt1` with 16
/// stimuli at once; stimulus `i` stays in reset `i` cycles longer than the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Subject {
    family: Family,
    size: u32,
    /// The screen of a VC-1.
    screen: Screen,
    stimuli: u32,
}

/// The possible numbers of stimuli.
const STIMULI: RangeInclusive<u32> = 1..=64;

/// The default subjects: small enough that a build with Verilator takes seconds.
pub const USUAL: [Subject; 6] = [
    Family::Pim.of_size(16),
    Family::Qt.of_size(1),
    Family::Qt.of_size(16),
    Family::Core.of_size(1),
    Family::Simd.of_size(16),
    Subject { screen: Screen { width: 160, height: 120 }, ..Family::Vc1.of_size(16) },
];

/// Checksums that several simulators agree on: the subject, cycles, checksum.
const KNOWN: [(&str, u64, u32); 39] = [
    ("pim16", 1000, 0xcce1_f33c),
    ("pim16", 20_000, 0x0b77_df9a),
    ("pim16", 300_000, 0xd0c8_a649),
    ("pim16", 1_000_000, 0xe856_bd82),
    ("pim64", 300_000, 0x9ea4_6335),
    ("pim256", 300_000, 0xf6e6_ec4e),
    ("qt1", 300_000, 0x0129_16aa),
    ("qt1", 1_000_000, 0xca15_a821),
    ("qt16", 1000, 0xf0a0_6430),
    ("qt16", 20_000, 0x0b04_acda),
    ("qt16", 300_000, 0x4c4a_2054),
    ("qt64", 300_000, 0x220b_1d0c),
    ("core1", 500_000, 0x17a0_3692),
    ("simd16", 1000, 0x9b9d_071b),
    ("simd16", 10_000, 0xb893_d9d4),
    ("simd16", 20_000, 0x6936_1066),
    ("simd64", 200, 0xace7_069c),
    ("simd64", 1000, 0xf29f_ab04),
    ("simd64", 2000, 0xe66b_a066),
    ("simd64", 20_000, 0xed26_91dd),
    ("simd128", 1000, 0x2108_7b77),
    ("simd128", 5000, 0x01c6_1c8f),
    ("simd128", 20_000, 0xd3bb_bba6),
    ("pxpl16", 1000, 0x0110_0744),
    ("pxpl16", 5000, 0xcc48_36b7),
    ("pxpl16", 20_000, 0xf336_0f9f),
    ("pxpl32", 1000, 0x0092_ee68),
    ("pxpl32", 20_000, 0x662b_4b09),
    ("pxpl128", 1000, 0xfe42_ad78),
    ("pxpl128", 20_000, 0xb887_e3ed),
    ("vc1x3@32x16", 200_000, 0x3643_4fa0),
    ("vc1x16@160x120", 500_000, 0x37e3_3907),
    ("renderer8", 100, 0x01ff_ffe6),
    ("renderer8", 1000, 0x7508_b567),
    ("renderer8", 20_000, 0xff43_6de1),
    ("renderer32", 20_000, 0xe61a_7d8d),
    ("renderer64", 1000, 0x0250_5f1b),
    ("renderer128", 1000, 0xe513_299d),
    ("nodes20", 2000, 0x60f0_60d9),
];

/// A design written by hand in Verilog, with the same function as ours.
#[derive(Debug, Clone, Copy)]
pub struct HandWritten {
    /// Its module, in the file of that name.
    pub module: &'static str,
    /// The text.
    pub text: &'static str,
    /// The module's parameter, and its value.
    pub parameter: (&'static str, u32),
}

impl Subject {
    /// The circuit.
    ///
    /// # Errors
    ///
    /// None, unless a design has a mistake.
    pub fn design(&self) -> Result<Design, Problems> {
        let size = self.size;
        match self.family {
            Family::Pim => elaborate(&Pim::new(size)),
            Family::Qt | Family::Flat => elaborate(&Qt::new(size, self.family == Family::Flat)),
            Family::Core => elaborate(&Core { processors: size }),
            Family::Simd => elaborate(&Simd { edge: size }),
            Family::Pxpl => elaborate(&Pxpl { edge: size }),
            Family::Systolic => elaborate(&Systolic { size }),
            Family::Vc1 => elaborate(&self.vc1()),
            Family::Renderer => elaborate(&Regions::new(size).expect("it was tried when it was named")),
            Family::Nodes => elaborate(&Nodes::new(size).expect("its renderers are of a side that there is")),
        }
    }

    fn vc1(&self) -> Vc1Frames {
        Vc1Frames::new(self.screen, self.size).expect("it was tried when it was named")
    }

    /// The number of cycles of a frame, in a design that draws frames.
    pub fn frame_cycles(&self) -> Option<u64> {
        (self.family == Family::Vc1).then(|| self.vc1().frame_cycles())
    }

    /// The hand-written Verilog with the same function, if it exists.
    pub fn hand_written(&self) -> Vec<HandWritten> {
        let written = |module, text, parameter| HandWritten { module, text, parameter: (parameter, self.size) };
        match self.family {
            Family::Pim => vec![written("pim", include_str!("../verilog/pim.v"), "STAGES")],
            Family::Qt | Family::Flat => vec![written("qt", include_str!("../verilog/qt.v"), "UNITS")],
            Family::Simd => vec![
                written("simd", include_str!("../verilog/simd.v"), "EDGE"),
                written("simd_arr", include_str!("../verilog/simd_arr.v"), "EDGE"),
            ],
            Family::Pxpl => vec![
                written("pxpl", include_str!("../verilog/pxpl.v"), "EDGE"),
                written("pxpl_planes", include_str!("../verilog/pxpl_planes.v"), "EDGE"),
            ],
            Family::Core | Family::Systolic | Family::Vc1 | Family::Renderer | Family::Nodes => Vec::new(),
        }
    }

    /// The name, among those of [`Subject::verilog`], of the Verilog printed from a design.
    pub const OUR_VERILOG: &str = "ours";

    /// The names of the Verilog for models: [`Subject::OUR_VERILOG`], and the hand-written modules.
    ///
    /// ```
    /// use tilewright_benches::Subject;
    ///
    /// assert_eq!("pxpl64".parse::<Subject>()?.verilog(), ["ours", "pxpl", "pxpl_planes"]);
    /// # Ok::<(), String>(())
    /// ```
    pub fn verilog(&self) -> Vec<&'static str> {
        let by_hand = self.hand_written().into_iter().map(|it| it.module);
        std::iter::once(Subject::OUR_VERILOG).chain(by_hand).collect()
    }

    /// The number of stimuli at once.
    pub fn stimuli(&self) -> u32 {
        self.stimuli
    }

    /// The cycles after which the checksum of the first stimulus is known, and the checksum.
    pub fn known(&self) -> impl Iterator<Item = (u64, u32)> + use<> {
        // The same function as `qt`, so the same checksums.
        let name = Subject { stimuli: 1, ..*self }.to_string().replace("flat", "qt");
        KNOWN.iter().filter(move |(subject, ..)| *subject == name).map(|&(_, cycles, checksum)| (cycles, checksum))
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}{}", self.family.name(), self.size)?;
        let Screen { width, height } = self.screen;
        if self.screen != Screen::VC1 {
            write!(f, "@{width}x{height}")?;
        }
        if self.stimuli == 1 { Ok(()) } else { write!(f, "*{}", self.stimuli) }
    }
}

impl FromStr for Subject {
    type Err = String;

    fn from_str(text: &str) -> Result<Subject, String> {
        let (text, stimuli) = text.split_once('*').map_or((text, None), |(text, stimuli)| (text, Some(stimuli)));
        let (design, screen) = text.split_once('@').map_or((text, None), |(design, screen)| (design, Some(screen)));
        let name = design.trim_end_matches(|c: char| c.is_ascii_digit());
        let Some(family) = Family::ALL.into_iter().find(|family| family.name() == name) else {
            let names: Vec<String> = Family::ALL.iter().map(|family| format!("{}N", family.name())).collect();
            return Err(format!("name a design as {}, with a size for N, such as {}", names.join(", "), USUAL[0]));
        };
        let size = design[name.len()..].parse().ok().filter(|size| family.sizes().contains(size));
        let (least, most) = family.sizes().into_inner();
        let mut subject = family.of_size(size.ok_or_else(|| format!("the size of {name} is from {least} to {most}"))?);
        if matches!(family, Family::Pxpl | Family::Renderer) && !subject.size.is_power_of_two() {
            return Err(format!("the size of {name} is a power of two, such as {name}16"));
        }
        if let Some(screen) = screen {
            subject.screen = parse_screen(screen).filter(|_| family == Family::Vc1).ok_or_else(no_screen)?;
        }
        if let Some(stimuli) = stimuli {
            let some = stimuli.parse().ok().filter(|some| STIMULI.contains(some));
            let (least, most) = STIMULI.into_inner();
            let sentence =
                || format!("behind a `*` stands how many stimuli run at once, from {least} to {most}, as in qt1*16");
            subject.stimuli = some.ok_or_else(sentence)?;
            if !family.has_rst() && subject.stimuli > 1 {
                return Err(format!("{name} has no input by which stimuli differ: several at once are of the others"));
            }
        }
        if family == Family::Vc1 {
            Vc1Frames::new(subject.screen, subject.size).map_err(|error| error.to_string())?;
        }
        Ok(subject)
    }
}

fn no_screen() -> String {
    let example = USUAL[USUAL.len() - 1];
    format!("behind an `@` stands the size of a VC-1's screen, as in {example}")
}

fn parse_screen(text: &str) -> Option<Screen> {
    let (width, height) = text.split_once('x')?;
    Screen::new(width.parse().ok()?, height.parse().ok()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_subjects_and_back() {
        for name in ["pim16", "qt1", "simd256", "vc1x16", "vc1x3@32x16", "qt1*16"] {
            assert_eq!(name.parse::<Subject>().unwrap().to_string(), name);
        }
        let wrong = [
            ("pin16", "pimN, qtN, flatN, coreN, simdN, pxplN, systolicN, vc1xN, rendererN, nodesN"),
            ("", "pimN"),
            ("qt", "from 1"),
            ("simd257", "to 256"),
            ("pxpl4", "from 8"),
            ("pxpl24", "a power of two, such as pxpl16"),
            ("renderer9", "a power of two, such as renderer16"),
            ("qt1*0", "from 1 to 64, as in qt1*16"),
            ("qt1*", "behind a `*`"),
            ("vc1x1*2", "vc1x has no input"),
            ("qt1@160x120", "as in vc1x16@160x120"),
            ("vc1x1@160", "as in vc1x16@160x120"),
            ("vc1x9@8x4", "fewer than 2 x 2 patches"),
            ("vc1x17@8x8", "from 1 to 15"),
            ("vc1x1@9x8", "multiples of 4"),
        ];
        for (name, part) in wrong {
            let error = name.parse::<Subject>().unwrap_err();
            assert!(error.contains(part), "{name}: {error}");
        }
        assert!(USUAL.iter().all(|it| it.to_string().parse() == Ok(*it)));
        assert!(KNOWN.iter().all(|(name, ..)| name.parse::<Subject>().is_ok()));
    }
}
