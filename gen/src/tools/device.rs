//! The FPGAs that the tools know: one table for synthesis, placement, boards and the command line.

use super::Target;

/// An FPGA in its package.
///
/// ```
/// use tilewright_gen::tools::{Device, Target};
///
/// assert_eq!((Device::UP5K.part(), Device::UP5K.target()), ("iCE40UP5K, SG48", Target::Ice40));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Device {
    part: &'static str,
    target: Target,
    pass: &'static str,
    placer: &'static str,
    options: &'static [&'static str],
}

/// The table. A row has the name here and a sentence, and then the maker's part, the family, the pass of Yosys, the
/// placer, and its options.
macro_rules! devices {
    ($($name:ident, $doc:literal: $part:literal, $target:ident, $pass:literal, $placer:literal, [$($option:literal),*];)*) => {
        impl Device {
            $(
                #[doc = $doc]
                ///
                /// ```
                /// use tilewright_gen::tools::Device;
                ///
                #[doc = concat!("assert_eq!(Device::", stringify!($name), ".part(), \"", $part, "\");")]
                /// ```
                pub const $name: Device = Device {
                    part: $part,
                    target: Target::$target,
                    pass: $pass,
                    placer: $placer,
                    options: &[$($option),*],
                };
            )*
        }
    };
}

devices! {
    LFE5U_85F, "A Lattice ECP5 of the larger kind, as on a ULX3S.":
        "LFE5U-85F, CABGA381, speed grade 6", Ecp5, "synth_ecp5 -abc9",
        "nextpnr-ecp5", ["--85k", "--package", "CABGA381", "--speed", "6"];
    LFE5U_25F, "A Lattice ECP5 of the smaller kind, as on a ULX3S.":
        "LFE5U-25F, CABGA381, speed grade 6", Ecp5, "synth_ecp5 -abc9",
        "nextpnr-ecp5", ["--25k", "--package", "CABGA381", "--speed", "6"];
    UP5K, "A Lattice iCE40 with large memories and DSPs, as on an iCEBreaker.":
        "iCE40UP5K, SG48", Ice40, "synth_ice40 -abc9 -device u -dsp -spram",
        "nextpnr-ice40", ["--up5k", "--package", "sg48"];
    HX8K, "A Lattice iCE40 of 7,680 logic cells.":
        "iCE40HX8K, CT256", Ice40, "synth_ice40 -abc9 -device hx",
        "nextpnr-ice40", ["--hx8k", "--package", "ct256"];
    HX1K, "A Lattice iCE40 of 1,280 logic cells, as on an iCEstick.":
        "iCE40HX1K, TQ144", Ice40, "synth_ice40 -abc9 -device hx",
        "nextpnr-ice40", ["--hx1k", "--package", "tq144"];
    GW2AR_18, "A Gowin, as on a Tang Nano 20K.":
        "GW2AR-LV18QN88C8/I7", Gowin, "synth_gowin -noiopads",
        "nextpnr-himbaechel-gowin", ["--device", "GW2AR-LV18QN88C8/I7", "--vopt", "family=GW2A-18C"];
}

impl Device {
    /// The maker's name, with package and speed grade where nextpnr is given them.
    ///
    /// ```
    /// use tilewright_gen::tools::Device;
    ///
    /// assert!(Device::LFE5U_85F.part().starts_with("LFE5U-85F"));
    /// ```
    pub const fn part(&self) -> &'static str {
        self.part
    }

    /// Its family.
    ///
    /// ```
    /// use tilewright_gen::tools::{Device, Target};
    ///
    /// assert_eq!(Device::LFE5U_25F.target(), Target::Ecp5);
    /// ```
    pub const fn target(&self) -> Target {
        self.target
    }

    /// The pass of Yosys for a block, whose ports do not reach pins.
    ///
    /// ```
    /// use tilewright_gen::tools::Device;
    ///
    /// assert_eq!(Device::GW2AR_18.pass(), "synth_gowin -noiopads");
    /// ```
    pub const fn pass(&self) -> &'static str {
        self.pass
    }

    /// The placer. Its Python package calls it so, with `yowasp-` before.
    ///
    /// ```
    /// use tilewright_gen::tools::Device;
    ///
    /// assert_eq!(Device::HX1K.placer(), "nextpnr-ice40");
    /// ```
    pub const fn placer(&self) -> &'static str {
        self.placer
    }

    /// What tells nextpnr the device.
    ///
    /// ```
    /// use tilewright_gen::tools::Device;
    ///
    /// assert_eq!(Device::HX8K.options(), ["--hx8k", "--package", "ct256"]);
    /// ```
    pub const fn options(&self) -> &'static [&'static str] {
        self.options
    }
}
