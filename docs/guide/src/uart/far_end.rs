//! Chapter 6: the other end of the line, for tests.

use tilewright_sim::{Port, Testbench};

/// Sends a byte on a line, with an own idea of how long a bit is.
pub async fn sends(t: &Testbench<'_>, line: Port, byte: u8, clocks_per_bit: u64) {
    let bits = (0..8).map(|place| byte >> place & 1);
    for bit in [0].into_iter().chain(bits).chain([1]) {
        t.set(line, u64::from(bit));
        t.wait(clocks_per_bit).await;
    }
}

/// Receives a byte from a line: looks at the middle of each bit.
pub async fn receives(t: &Testbench<'_>, line: Port, clocks_per_bit: u64) -> u8 {
    t.until(line.is(0)).await;
    t.wait(clocks_per_bit / 2).await;
    let mut byte = 0;
    for place in 0..8 {
        t.wait(clocks_per_bit).await;
        byte |= (t.get_u64(line) as u8) << place;
    }
    t.wait(clocks_per_bit).await;
    assert_eq!(t.get_u64(line), 1, "the stop bit");
    byte
}
