//! Pages of memory from the system, for code.

use region::{Allocation, Protection};

use super::target::Unsupported;

/// Machine code, which is executable and not writable.
pub(super) struct CodePages(Allocation);

// SAFETY: it is the only owner of its pages, and the system lets any thread free them.
#[allow(unsafe_code, reason = "an address is not sent to other threads by itself")]
unsafe impl Send for CodePages {}

// SAFETY: nothing but its end, which one thread sees, changes the pages.
#[allow(unsafe_code, reason = "any thread may read and run code")]
unsafe impl Sync for CodePages {}

impl CodePages {
    /// Pages that begin with this code.
    #[allow(unsafe_code, reason = "writes code, and has it run")]
    pub fn new(code: &[u8], alignment: usize) -> Result<CodePages, Unsupported> {
        let refused =
            |error: region::Error| Unsupported(format!("its system gives no memory that code can run in: {error}"));
        assert!(alignment <= region::page::size(), "code is aligned to {alignment} bytes, which is more than a page");
        let mut pages = region::alloc(code.len(), Protection::READ_WRITE).map_err(refused)?;
        // SAFETY: the pages are at least as long, and nobody else knows them yet.
        unsafe { std::ptr::copy_nonoverlapping(code.as_ptr(), pages.as_mut_ptr(), code.len()) };
        // SAFETY: only the code is in these pages.
        unsafe { region::protect(pages.as_ptr::<u8>(), pages.len(), Protection::READ_EXECUTE) }.map_err(refused)?;
        #[cfg(target_arch = "aarch64")]
        {
            use wasmtime_internal_jit_icache_coherence::{clear_cache, pipeline_flush_mt};
            let refused = |error: std::io::Error| Unsupported(format!("its caches cannot be cleared: {error}"));
            // SAFETY: the pages exist.
            unsafe { clear_cache(pages.as_ptr(), pages.len()) }.map_err(refused)?;
            pipeline_flush_mt().map_err(refused)?;
        }
        Ok(CodePages(pages))
    }

    /// The first instruction.
    pub fn entry(&self) -> *const u8 {
        self.0.as_ptr()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_is_never_there_to_be_written() {
        let code = CodePages::new(&[0; 5000], 64).unwrap();
        for page in [0, region::page::size()] {
            let protection = region::query(code.entry().wrapping_add(page)).unwrap().protection();
            assert_eq!(protection, Protection::READ_EXECUTE);
        }
    }
}
