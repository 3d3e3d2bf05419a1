//! The machine that code is made for: this one, if it has the required features.

use std::sync::OnceLock;

use cranelift_codegen::isa::{self, OwnedTargetIsa};
use cranelift_codegen::settings::{self, Configurable};
use target_lexicon::Triple;

/// Why this machine cannot run generated code.
///
/// ```
/// use tilewright_sim::{EngineKind, Unsupported};
///
/// // A simulation does not fail for it, but reports it: `Simulation::fallback`.
/// if let Some(reason) = EngineKind::Compiled.refused() {
///     assert!(reason.starts_with("no code can be generated for this machine ("));
/// }
/// # fn is_an_error(reason: Unsupported) -> Box<dyn std::error::Error> { reason.into() }
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no code can be generated for this machine ({0})")]
pub struct Unsupported(pub(in crate::engine) String);

/// The machine that it runs on, which is determined once.
pub(in crate::engine) fn host() -> Result<OwnedTargetIsa, Unsupported> {
    static HOST: OnceLock<Result<OwnedTargetIsa, Unsupported>> = OnceLock::new();
    HOST.get_or_init(|| target(&features())).clone()
}

/// The features that vector instructions need on x86-64, by Cranelift's names and by their usual ones; no others are
/// required.
const NEEDED: [(&str, &str); 3] = [("has_sse3", "SSE3"), ("has_ssse3", "SSSE3"), ("has_sse41", "SSE4.1")];

/// A machine like this one, with these processor features. Cranelift's optimisation is off: netlists come optimised,
/// and its global value numbering lengthens live ranges.
pub(in crate::engine) fn target(features: &[&str]) -> Result<OwnedTargetIsa, Unsupported> {
    let unsupported = |error: &dyn std::fmt::Display| Unsupported(error.to_string());
    if cfg!(target_endian = "big") {
        return Err(Unsupported("it is big-endian".to_owned()));
    }
    if cfg!(target_arch = "x86_64") {
        if let Some((_, name)) = NEEDED.iter().find(|(flag, _)| !features.contains(flag)) {
            return Err(Unsupported(format!("its processor lacks {name}")));
        }
    } else if !cfg!(target_arch = "aarch64") {
        // Other processors may need more than `Pages` does before they run written code.
        return Err(Unsupported("its processor is neither x86-64 nor aarch64".to_owned()));
    }
    let mut flags = settings::builder();
    let options = [
        ("opt_level", "none"),
        ("regalloc_algorithm", "backtracking"),
        ("unwind_info", "false"),
        // A frame larger than the guard page of the stack touches each page, so that it cannot step over the guard.
        ("enable_probestack", "true"),
        ("probestack_strategy", "inline"),
        ("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }),
    ];
    for (name, value) in options {
        flags.set(name, value).expect("Cranelift knows its settings");
    }
    let mut machine = isa::lookup(Triple::host()).map_err(|error| unsupported(&error))?;
    for feature in features {
        machine.enable(feature).expect("Cranelift knows its features");
    }
    machine.finish(settings::Flags::new(flags)).map_err(|error| unsupported(&error))
}

/// The features of this processor, by Cranelift's names.
fn features() -> Vec<&'static str> {
    #[cfg(target_arch = "x86_64")]
    macro_rules! detected {
        ($($feature:tt $flag:literal,)*) => {{
            let all = [$((std::is_x86_feature_detected!($feature), $flag)),*];
            all.into_iter().filter(|(is_there, _)| *is_there).map(|(_, flag)| flag).collect()
        }};
    }
    #[cfg(target_arch = "x86_64")]
    return detected! {
        "sse3" "has_sse3",
        "ssse3" "has_ssse3",
        "sse4.1" "has_sse41",
        "sse4.2" "has_sse42",
        "popcnt" "has_popcnt",
        "lzcnt" "has_lzcnt",
        "bmi1" "has_bmi1",
        "bmi2" "has_bmi2",
        "fma" "has_fma",
        "avx" "has_avx",
        "avx2" "has_avx2",
        "avx512f" "has_avx512f",
        "avx512vl" "has_avx512vl",
        "avx512dq" "has_avx512dq",
        "avx512bitalg" "has_avx512bitalg",
        "avx512vbmi" "has_avx512vbmi",
    };
    // Beyond the common features of these processors, Cranelift can use atomics, half floats and products of bytes,
    // none of which the code needs.
    #[cfg(not(target_arch = "x86_64"))]
    return Vec::new();
}

#[cfg(test)]
pub(in crate::engine) mod tests {
    use super::*;

    /// A machine with the required features only.
    pub fn least() -> OwnedTargetIsa {
        target(&NEEDED.map(|(flag, _)| flag)).expect("it has all that is needed")
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn a_processor_without_vector_instructions_that_are_needed_is_refused() {
        let refused = |features: &[&str]| target(features).err().map(|reason| reason.to_string());
        let sentence = |name| Some(format!("no code can be generated for this machine (its processor lacks {name})"));
        assert_eq!(refused(&[]), sentence("SSE3"));
        assert_eq!(refused(&["has_sse3", "has_ssse3"]), sentence("SSE4.1"));
        assert_eq!(refused(&["has_sse3", "has_ssse3", "has_sse41"]), None);
    }
}
