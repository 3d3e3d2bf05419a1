//! The global frame buffer of colours: two banks, of which one is filled while the other one is shown.
//!
//! ```text
//!           merge clock           |      pixel clock
//!                                 |
//! store, colour -->.-----------------------.
//!                  | even: one bank        |--> colour
//! swap --> bank -->| odd: the other bank   |
//!                  '-----------------------'<-- y * width + x, bank on display
//! blanking <---------- [ window ]<-- ends
//! ```
//!
//! Latency: a colour comes [`Store::LATENCY`] clocks after its place.
//!
//! The lowest bit of an address is the bank. A colour of 12 bits is in two memories of 9 and 3 bits: so many block RAMs
//! of an ECP5 are side by side without a bit that is not used. One memory of 12 bits takes 114 of them at 320 x 240, two take 105.

use super::processor::COLOUR_BITS;
use crate::picture::{Colour, PictureIn};
use tilewright_hdl::{Module, ReadUnderWrite, Signal, below, bit, bits, block, cat, def, lit, up_to};
use tilewright_rtl::clocks::MERGE;
use tilewright_rtl::parameter::Screen;

/// The bits of a colour that are in the memory of bits without a parity bit's place.
const LOW_BITS: u32 = 3;
/// The clocks of the pixels for which the banks may be swapped: a small part of the vertical blanking.
const WINDOW: u32 = 256;

block! {
    /// Stores the colours of two frames: swaps them in a vertical blanking, and shows one.
    pub struct Store {
        /// The screen.
        pub screen: Screen,
    }
    latency = "3 clocks of the pixels";
    source = "VC-1, section 3.3, global frame buffer (VC1-GFB), without depths";
    in(self) StoreIn {
        /// High for one clock to swap the banks.
        swap: bit().on(MERGE),
        /// There is a pixel to store.
        stores: bit().on(MERGE),
        /// Its number in raster order.
        store: below(self.screen.pixels()).on(MERGE),
        /// Its colour: red above green above blue.
        colour: bits(3 * COLOUR_BITS).on(MERGE),
        /// The pixel to show.
        picture: PictureIn,
    }
    out StoreOut {
        /// The colour to show.
        shown: Colour = _,
        /// The banks may be swapped.
        blanking: bit(),
    }
}

impl Store {
    /// The clocks from a place to its colour.
    pub const LATENCY: u32 = 3;

    fn build(&self, m: Module, i: StoreIn) -> StoreOut {
        let merge = m.on(MERGE);
        m.ignore(&i.picture.runs);
        let pixels = self.screen.pixels();
        def!(filled = merge.toggle(i.swap));
        let filling = cat![i.store, filled];
        let policy = ReadUnderWrite::Any;
        let high_bits = 3 * COLOUR_BITS - LOW_BITS;
        def!(high = m.memory(2 * pixels, high_bits, policy));
        def!(low = m.memory(2 * pixels, LOW_BITS, policy));
        high.on(MERGE).write(i.stores, filling, i.colour.part(LOW_BITS, high_bits));
        low.on(MERGE).write(i.stores, filling, i.colour.part(0, LOW_BITS));

        // The display.
        def!(shown = m.synchronize_from(true, !filled));
        let wide = |position: Signal| position.zext(below(2 * pixels));
        def!(
            number = wide(i.picture.y).times(lit(up_to(self.screen.width), self.screen.width)).trunc(below(pixels))
                + i.picture.x.zext(below(pixels))
        );
        def!(address = m.pipe(cat![number, shown]));
        def!(word = cat![high.read(address), low.read(address)]);
        let component = |place: u32| {
            let part = word.part(place * COLOUR_BITS, COLOUR_BITS);
            cat![part, part]
        };
        def!(answer = m.pipe(Colour { red: component(2), green: component(1), blue: component(0) }));

        // Long enough for the merger to see it.
        def!(left = m.reg(up_to(WINDOW)).reset(0));
        left.when(i.picture.ends, WINDOW).when(left.ne(0), left - 1);
        def!(window = m.reg(bit()).reset(0));
        window.next(left.ne(0));
        def!(blanking = merge.synchronize(*window));
        StoreOut { shown: answer, blanking }
    }
}
