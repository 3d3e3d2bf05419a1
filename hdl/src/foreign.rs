//! The `build` of foreign modules without a model.

use crate::data::Layout;
use crate::elaboration;
use crate::fields::Fields;
use crate::module::Module;
use crate::signal::Signal;
use tilewright_circuit::Loc;

impl Module {
    /// The `build` of a foreign module that has no model. The module cannot be simulated. The checks of clocks and
    /// loops treat its outputs as constants. The call gives the widths of the outputs.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// block! {
    ///     /// The oscillator of an iCE40 UltraPlus, whose clock goes to a pin.
    ///     struct Oscillator;
    ///     foreign = Foreign::module("SB_LFOSC").capitals();
    ///     in OscillatorIn { clklfpu: bit(), clklfen: bit() }
    ///     out OscillatorOut { clklf: _ }
    /// }
    ///
    /// impl Oscillator {
    ///     fn build(&self, m: Module, i: OscillatorIn) -> OscillatorOut {
    ///         m.unmodelled(&i, OscillatorOut { clklf: bit() })
    ///     }
    /// }
    ///
    /// let design = elaborate(&Oscillator)?;
    /// assert_eq!(
    ///     design.check_models().unwrap_err().0[0].message,
    ///     "foreign module `SB_LFOSC` has no model, so the design cannot be simulated"
    /// );
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    pub fn unmodelled<L: Layout>(self, inputs: &impl Fields<Signal>, outputs: L) -> L::Value {
        let loc = Loc::caller();
        self.ignore(inputs);
        elaboration::draft(|draft| draft.unmodelled = draft.unmodelled.or(Some(loc)));
        outputs.layout().map_fields("", &mut |path, width| {
            elaboration::with(|e| {
                let shape = crate::shaping::sound_shape(e, format_args!("output `{path}`"), width.shape, width.loc);
                Signal::zero_in(e, width.bits, shape, width.kind, loc)
            })
        })
    }
}
