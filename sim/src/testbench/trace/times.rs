//! The lines `#TIME` of a waveform file.

use super::changes::LINE;

/// Writes times; most of them have the same higher digits as the previous one.
#[derive(Debug)]
pub(super) struct Times {
    /// The number formed by the last higher digits, and the number sign with those digits, if the number is not 0.
    high: u64,
    text: [u8; 16],
    length: usize,
}

/// The number of times with the same higher digits: eight digits follow these.
const LOW: u64 = 100_000_000;

/// Eight zeros.
const ZEROS: u64 = u64::from_le_bytes([b'0'; 8]);

/// The numbers below 100, as two digits each.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[0; 2]; 100];
    let mut number = 0;
    while number < 100 {
        pairs[number] = [b'0' + number as u8 / 10, b'0' + number as u8 % 10];
        number += 1;
    }
    pairs
};

impl Default for Times {
    fn default() -> Times {
        let mut times = Times { high: 0, text: [0; 16], length: 0 };
        times.renew(0);
        times
    }
}

impl Times {
    /// Writes the line of a time there; returns its length.
    #[inline]
    pub fn put(&mut self, line: &mut [u8; LINE], time: u64) -> usize {
        let (high, low) = (time / LOW, (time % LOW) as usize);
        if high != self.high {
            self.renew(high);
        }
        line[..16].copy_from_slice(&self.text);
        // No division depends on another.
        let pairs = [low / 1_000_000, low / 10_000 % 100, low / 100 % 100, low % 100];
        let digits = pairs.iter().rev().fold(0, |all, &pair| all << 16 | u64::from(u16::from_le_bytes(PAIRS[pair])));
        // Leading zeros are omitted, except for the last digit.
        let zeros = if high == 0 { ((digits ^ ZEROS) | 1 << 56).trailing_zeros() & !7 } else { 0 };
        let start = self.length & 15;
        line[start..start + 8].copy_from_slice(&(digits >> zeros).to_le_bytes());
        let end = start + 8 - zeros as usize / 8;
        line[end] = b'\n';
        end + 1
    }

    #[cold]
    fn renew(&mut self, high: u64) {
        let text = if high == 0 { "#".to_owned() } else { format!("#{high}") };
        (self.high, self.length) = (high, text.len());
        self.text[..text.len()].copy_from_slice(text.as_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_its_decimal_number() {
        let mut times = Times::default();
        let large = [99_999_999, LOW, LOW + 1, 10 * LOW - 1, 10 * LOW, 123_456_789_000_000_001, u64::MAX, LOW];
        for time in
            [0, 9, 10, 99, 100, 101, 999, 1000, 10_009, 1_000_000, 12_345_678].into_iter().chain(large).chain([7])
        {
            let mut line = [b'x'; LINE];
            let length = times.put(&mut line, time);
            assert_eq!(String::from_utf8_lossy(&line[..length]), format!("#{time}\n"));
        }
    }
}
