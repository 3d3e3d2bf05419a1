//! Machine code in memory, through Cranelift: the one place that makes it and the one that calls it.

use std::sync::{Arc, OnceLock};

use cranelift_codegen::ir::{AbiParam, Function, InstBuilder, Signature, Type, UserFuncName, Value, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_codegen::{Context, isa};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{Module, default_libcall_names};

use super::scalar::{Call, take_calls};

/// The type of addresses.
pub(super) const POINTER: Type = types::I64;

/// Why this machine runs no generated code.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no code can be generated for this machine ({0})")]
pub struct Unsupported(pub(super) String);

/// A function of generated code: takes the address of the state and a number, gives a number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Code(unsafe extern "C" fn(*mut u8, u64) -> u64);

impl Code {
    /// Runs it.
    ///
    /// # Safety
    ///
    /// The [`Jit`] that made it lives, and `state` is laid out as the code was told, with nobody else using it.
    #[allow(unsafe_code, reason = "generated code is a foreign function")]
    pub unsafe fn call(self, state: *mut u8, argument: u64) -> u64 {
        // SAFETY: the caller's promise.
        unsafe { (self.0)(state, argument) }
    }

    /// Emits a call of it in another function.
    pub fn emit_call(self, b: &mut FunctionBuilder, state: Value, argument: Value) -> Value {
        let mut signature = Signature::new(b.func.signature.call_conv);
        signature.params.extend([AbiParam::new(POINTER), AbiParam::new(types::I64)]);
        signature.returns.push(AbiParam::new(types::I64));
        let signature = b.import_signature(signature);
        let address = b.ins().iconst(POINTER, self.0 as usize as i64);
        let call = b.ins().call_indirect(signature, address, &[state, argument]);
        b.inst_results(call)[0]
    }
}

/// Makes functions and owns their memory.
pub(super) struct Jit {
    /// `None` only while it is dropped.
    module: Option<JITModule>,
    context: Context,
    scratch: FunctionBuilderContext,
    /// What functions refer to by address.
    calls: Vec<Arc<Call>>,
}

impl Jit {
    /// Prepares for the machine that this runs on.
    pub fn new() -> Result<Jit, Unsupported> {
        let target = host()?;
        let module = JITModule::new(JITBuilder::with_isa(target, default_libcall_names()));
        let context = module.make_context();
        Ok(Jit { module: Some(module), context, scratch: FunctionBuilderContext::new(), calls: Vec::new() })
    }

    /// Makes a function; `body` gets the builder in the entry block, the address of the state and the argument, and
    /// must end with a return of one number.
    ///
    /// # Panics
    ///
    /// There is no memory for code.
    pub fn function(&mut self, body: impl FnOnce(&mut FunctionBuilder, Value, Value)) -> Code {
        self.try_function(body).unwrap_or_else(|refused| panic!("{refused}"))
    }

    fn try_function(&mut self, body: impl FnOnce(&mut FunctionBuilder, Value, Value)) -> Result<Code, Unsupported> {
        let module = self.module.as_mut().expect("it is not being dropped");
        let frontend = module.target_config();
        let mut signature = module.make_signature();
        signature.params.extend([AbiParam::new(POINTER), AbiParam::new(types::I64)]);
        signature.returns.push(AbiParam::new(types::I64));
        self.context.func = Function::with_name_signature(UserFuncName::user(0, 0), signature);
        let mut builder = FunctionBuilder::new(&mut self.context.func, &mut self.scratch);
        let entry = builder.create_block();
        builder.append_block_params_for_function_params(entry);
        builder.switch_to_block(entry);
        let (state, argument) = (builder.block_params(entry)[0], builder.block_params(entry)[1]);
        body(&mut builder, state, argument);
        self.calls.extend(take_calls());
        builder.seal_all_blocks();
        builder.finalize(frontend);
        let id = module.declare_anonymous_function(&self.context.func.signature).expect("a new function has no rival");
        if let Err(error) = module.define_function(id, &mut self.context) {
            panic!("generated code is not accepted: {error:?}\n{}", self.context.func.display());
        }
        module.clear_context(&mut self.context);
        module.finalize_definitions().map_err(|error| Unsupported(error.to_string()))?;
        let address = module.get_finalized_function(id);
        // SAFETY: the function was just made with this signature, in the C convention of this machine.
        #[allow(unsafe_code, reason = "a function pointer is made of an address")]
        Ok(Code(unsafe { std::mem::transmute::<*const u8, unsafe extern "C" fn(*mut u8, u64) -> u64>(address) }))
    }
}

impl Drop for Jit {
    fn drop(&mut self) {
        if let Some(module) = self.module.take() {
            // SAFETY: `Code` may only be called while its `Jit` lives.
            #[allow(unsafe_code, reason = "frees memory that function pointers point into")]
            unsafe {
                module.free_memory();
            }
        }
    }
}

impl std::fmt::Debug for Jit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Jit").finish_non_exhaustive()
    }
}

/// Why no code can be generated for this machine, if none can: a small function is made to find out, as a system may
/// forbid it.
pub(crate) fn unsupported() -> Option<Unsupported> {
    static REFUSED: OnceLock<Option<Unsupported>> = OnceLock::new();
    let try_one = || {
        let returning = |b: &mut FunctionBuilder, _, argument| {
            b.ins().return_(&[argument]);
        };
        Jit::new().and_then(|mut jit| jit.try_function(returning)).err()
    };
    REFUSED.get_or_init(try_one).clone()
}

/// The machine that this runs on, which is found out once.
fn host() -> Result<isa::OwnedTargetIsa, Unsupported> {
    static HOST: OnceLock<Result<isa::OwnedTargetIsa, Unsupported>> = OnceLock::new();
    HOST.get_or_init(target).clone()
}

/// The machine that this runs on. No optimisation by Cranelift: netlists come optimised, and its global value
/// numbering lengthens live ranges.
fn target() -> Result<isa::OwnedTargetIsa, Unsupported> {
    let unsupported = |error: &dyn std::fmt::Display| Unsupported(error.to_string());
    if cfg!(target_endian = "big") {
        return Err(Unsupported("it is big-endian".to_owned()));
    }
    let mut flags = settings::builder();
    let options = [
        ("opt_level", "none"),
        ("regalloc_algorithm", "backtracking"),
        ("unwind_info", "false"),
        ("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }),
    ];
    for (name, value) in options {
        flags.set(name, value).expect("Cranelift knows its settings");
    }
    let machine = cranelift_native::builder().map_err(|error| unsupported(&error))?;
    machine.finish(settings::Flags::new(flags)).map_err(|error| unsupported(&error))
}

#[cfg(test)]
mod tests {
    use cranelift_codegen::ir::MemFlagsData;

    use super::*;

    #[test]
    #[allow(unsafe_code, reason = "calls generated code")]
    fn a_function_reads_and_writes_the_state() {
        let mut jit = Jit::new().unwrap();
        let code = jit.function(|b, state, argument| {
            let old = b.ins().load(types::I64, MemFlagsData::trusted(), state, 8);
            let sum = b.ins().iadd(old, argument);
            b.ins().store(MemFlagsData::trusted(), sum, state, 8);
            b.ins().return_(&[old]);
        });
        let mut state = [1u64, 40];
        // SAFETY: the code touches the second number of the state alone.
        let old = unsafe { code.call(state.as_mut_ptr().cast(), 2) };
        assert_eq!((old, state), (40, [1, 42]));
    }
}
