//! Numbers at an address that code knows.

use std::cell::Cell;
use std::ops::Deref;
use std::ptr::NonNull;

use super::guarded::Guarded;

/// Bytes of a cache line, to which they are aligned.
pub(super) const LINE: usize = 64;

/// Zeros at first; cells, because code changes them through their address.
pub(super) struct Words {
    first: NonNull<Cell<u64>>,
    count: usize,
    _owner: Owner,
}

/// The owner of the memory.
#[expect(dead_code, reason = "it is kept, and looked at through the address")]
enum Owner {
    Heap(Vec<u64>),
    Pages(Guarded),
}

// SAFETY: it owns the memory, and cells may be sent.
#[allow(unsafe_code, reason = "an address is not sent to other threads by itself")]
unsafe impl Send for Words {}

impl Words {
    /// Allocates numbers on the heap. The system provides pages that take no memory, and no time, before they are
    /// written.
    pub fn plain(count: usize) -> Words {
        let mut zeros = vec![0u64; count + LINE / 8];
        let first = zeros.as_mut_ptr();
        let first = first.wrapping_add(first.align_offset(LINE));
        Words { first: NonNull::new(first.cast()).expect("a vector is somewhere"), count, _owner: Owner::Heap(zeros) }
    }

    /// Allocates numbers between protected pages.
    pub fn guarded(count: usize) -> Words {
        let pages = Guarded::new(count);
        let first = pages.start().cast_mut();
        Words { first: NonNull::new(first.cast()).expect("pages are somewhere"), count, _owner: Owner::Pages(pages) }
    }
}

impl Deref for Words {
    type Target = [Cell<u64>];

    #[inline]
    fn deref(&self) -> &[Cell<u64>] {
        // SAFETY: this many numbers are stored there, initially zero, in memory that lives as long and that everybody
        // accesses as cells.
        #[allow(unsafe_code, reason = "the address is known to code")]
        unsafe {
            std::slice::from_raw_parts(self.first.as_ptr(), self.count)
        }
    }
}

#[cfg(test)]
mod tests {
    use region::Protection;

    use super::*;

    #[test]
    fn nobody_may_touch_what_is_around_guarded_numbers() {
        for count in [1, 512, 700] {
            let numbers = Words::guarded(count);
            numbers[0].set(1);
            numbers[count - 1].set(2);
            let protection = |at: *const u64| region::query(at).unwrap().protection();
            let (first, end) = (numbers.as_ptr().cast::<u64>(), numbers.as_ptr_range().end.cast::<u64>());
            let page_before = first.wrapping_byte_sub(region::page::size());
            assert_eq!(protection(first), Protection::READ_WRITE, "{count}");
            assert_eq!(protection(end), Protection::NONE, "{count}");
            assert_eq!(protection(page_before), Protection::NONE, "{count}");
        }
    }

    #[test]
    fn the_first_is_at_the_start_of_a_line() {
        for count in [0, 8, 1 << 20] {
            let words = Words::plain(count);
            assert!((words.as_ptr() as usize).is_multiple_of(LINE), "{count}");
            assert!(words.iter().all(|word| word.get() == 0), "{count}");
        }
    }
}
