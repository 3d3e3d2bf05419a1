//! Pages of memory from the system, between protected pages.

use std::alloc::{Layout, handle_alloc_error};

use region::{Allocation, Protection};

/// Numbers, zeros at first, that end at a protected page; another protected page is before them.
pub(super) struct Guarded {
    pages: Allocation,
    /// Bytes before the first.
    skipped: usize,
}

// SAFETY: it is the only owner of its pages, and the system lets any thread free them.
#[allow(unsafe_code, reason = "an address is not sent to other threads by itself")]
unsafe impl Send for Guarded {}

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
        Guarded { skipped: pages.len() - page - count * 8, pages }
    }

    /// The first number.
    pub fn start(&self) -> *const u64 {
        self.pages.as_ptr::<u8>().wrapping_add(self.skipped).cast()
    }
}
