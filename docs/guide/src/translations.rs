//! Appendix B: what other languages say, said here.

#[cfg(test)]
mod tests {
    use tilewright_hdl::*;

    const OTHER: Clock = Clock::new("other", Period::ns(7));
    const VIDEO: Clock = Clock::new("video", Period::ns(7));

    codes! { enum Operation { Load, Store } }

    block! {
        /// Adds one.
        struct Sub;
        in SubIn { given: bits(8) }
        out SubOut { more: bits(8) }
    }

    impl Sub {
        fn build(&self, _: Module, i: SubIn) -> SubOut {
            SubOut { more: i.given + 1 }
        }
    }

    block! {
        /// Says what the appendix says.
        struct Translations { n: u32 }
        in(self) TranslationsIn {
            a: bits(8),
            b: bits(8),
            s: bits(2),
            c: bit(),
            lanes: bits(8).of(row(self.n)),
            bytes: stream(bits(8)),
            operation: one_of::<Operation>(),
        }
        out TranslationsOut { all: bits(8), seen: bit(), late: bit() }
    }

    impl Translations {
        fn build(&self, m: Module, i: TranslationsIn) -> TranslationsOut {
            let TranslationsIn { a, b, s, c, lanes, bytes, operation } = i;
            def!(x = m.reg(8).reset(0));
            x.next(a);
            def!(y = m.reg(8));
            y.when(c, a);
            def!(z = a & b);
            let chosen = mux(c, a, b);
            let both = cat![a, b];
            let upper = a.slice(4..8);
            let one = a.bit(3);
            let wide = a.zext(12);
            let sum = a.add_carry(b);
            let same = a.eq(b);
            let less = a.signed().lt(b.signed());
            let bits = cat![a.all_ones(), a.any_one(), a.parity()];
            let by_number = case(s, [(0, a), (1, b)], 0);
            let by_code = choose!(operation, Operation {
                Load => a,
                Store => b,
            });
            def!(words = m.memory(256, 8, ReadUnderWrite::Any));
            words.write(c, a, b);
            let word = words.read(a);
            def!(sub = m.instance(&Sub, SubIn { given: a }));
            let total = lanes.sum();
            def!(flag = m.pipe(c));
            let seen = m.on(OTHER).synchronize("seen", flag);
            let describe = || m.instance("u_again", &Sub, SubIn { given: *x }).more;
            let again = m.enabled(c, describe);
            let describe = || m.on(VIDEO).toggle("late", lit(1, 1));
            let late = m.on(OTHER).in_place_of(VIDEO, describe);
            let byte = bytes.take_when(1);
            m.assert(x.le(255), "why");
            m.display(c, "x is {}", &[*x]);
            let checks = cat![both, upper, one, wide, sum, same, less, bits].parity().zext(8);
            let all = x ^ *y ^ z ^ chosen ^ by_number ^ by_code ^ word ^ sub.more ^ total ^ *byte ^ checks ^ again;
            TranslationsOut { all, seen, late }
        }
    }

    #[test]
    fn the_lines_make_a_circuit() {
        elaborate(&Translations { n: 4 }).unwrap();
    }
}
