//! A prefix before the names of a part of a module.

use crate::elaboration::draft;
use crate::module::Module;

impl Module {
    /// Puts a prefix and a `_` before every name that `describe` declares: of registers, nets, memories, pipelines and
    /// instances. The `u_` of an instance stays first. Prefixes nest, and the names inside of an instance have none.
    ///
    /// A helper that is called twice needs no prefix, because its names get numbers by themselves: `was`, `was_1`. A
    /// prefix says which is which.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # let example = tilewright_sim::traced(|m| {
    /// /// High in the first clock of each pulse.
    /// fn edge(m: Module, bit: Signal) -> Signal {
    ///     def!(was = m.pipe(bit));
    ///     bit & !was
    /// }
    ///
    /// def!(count = m.reg(2).reset(0));
    /// count.next(count + 1);
    /// def!(ones = m.within("ones", || edge(m, count.bit(0))));
    /// def!(twos = m.within("twos", || edge(m, count.bit(1))));
    /// # });
    /// assert_eq!(example.values("ones_was"), [0, 0, 1, 0, 1]);
    /// assert_eq!(example.values("twos_was"), [0, 0, 0, 1, 1]);
    /// assert_eq!(example.values("twos"), [0, 0, 1, 0, 0]);
    /// ```
    pub fn within<R>(self, prefix: &str, describe: impl FnOnce() -> R) -> R {
        let outer = draft(|draft| {
            let inner = draft.prefixed(prefix);
            std::mem::replace(&mut draft.prefix, inner)
        });
        let result = describe();
        draft(|draft| draft.prefix = outer);
        result
    }
}
