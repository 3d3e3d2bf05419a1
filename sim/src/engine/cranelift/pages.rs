//! Pages of memory from the system: executable code, and blocks between protected pages.

use std::alloc::{Layout, handle_alloc_error};

use region::{Allocation, Protection};

use super::target::Unsupported;

/// Owned pages.
struct Pages(Allocation);

// SAFETY: it is the only owner of its pages, and the system lets any thread free them.
#[allow(unsafe_code, reason = "an address is not sent to other threads by itself")]
unsafe impl Send for Pages {}

/// Machine code, which is executable and not writable.
pub(in crate::engine) struct CodePages(Pages);

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
        Ok(CodePages(Pages(pages)))
    }

    /// The first instruction.
    pub fn entry(&self) -> *const u8 {
        self.0.0.as_ptr()
    }
}

/// Numbers, zeros at first, that end at a protected page; another protected page is before them.
pub(in crate::engine) struct Guarded {
    pages: Pages,
    /// Bytes before the first.
    skipped: usize,
}

impl Guarded {
    /// Allocates `count` numbers.
    pub fn new(count: usize) -> Guarded {
        let page = region::page::size();
        let inner = (count * 8).next_multiple_of(page);
        let pages = region::alloc(inner + 2 * page, Protection::READ_WRITE);
        // As without guards: a vector that cannot be allocated ends the process in this way.
        let layout = || Layout::array::<u64>(count).expect("so many numbers are less than the address space");
        let pages = pages.unwrap_or_else(|_| handle_alloc_error(layout()));
        for guard in [0, page + inner] {
            let guard = pages.as_ptr::<u8>().wrapping_add(guard);
            // SAFETY: these pages were just made, and nobody uses them.
            #[allow(unsafe_code, reason = "takes away the right to touch pages")]
            unsafe { region::protect(guard, page, Protection::NONE) }.expect("pages of one's own can be protected");
        }
        Guarded { skipped: pages.len() - page - count * 8, pages: Pages(pages) }
    }

    /// The first number.
    pub fn start(&self) -> *const u64 {
        self.pages.0.as_ptr::<u8>().wrapping_add(self.skipped).cast()
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
