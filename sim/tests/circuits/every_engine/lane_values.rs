//! Rows and grids in the language, compared with plain loops.

use crate::circuits::engine::of;
use proptest::prelude::*;
use tilewright_hdl::*;

const LANES: usize = 5;
const COLUMNS: usize = 3;

bundle! {
    struct In<T> { x: T, y: T, plain: T, word: T, at: T }
    struct Out<T> {
        elementwise: T, chosen: T, shifted: T, reversed: T, every_second: T, parents: T, interleaved: T, stacked: T,
        picked: T, least: T, most: T, all: T, any: T, total: T, nearest: T, staged: T, word_of_all: T, unpacked: T,
        rows: T, columns: T, above: T, left: T, column_sums: T, row_sums: T, grid_total: T, kept: T, words: T, own_words: T,
    }
}

/// One of each operation.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct LaneValues;

impl Block for LaneValues {
    type In = In;
    type Out = Out;

    fn inputs(&self) -> In<Width> {
        let lane = bits(8).of(LANES);
        In { x: lane, y: bits(8).of(COLUMNS), plain: bits(8), word: bits(24), at: bits(3) }
    }

    fn build(&self, m: Module, i: In) -> Out {
        let (x, y) = (i.x, i.y);
        let field = grid(LANES, COLUMNS);
        let product = x.to_columns(COLUMNS) ^ y.to_rows(LANES);
        let kept = m.reg("kept", bits(8).of(field)).reset_each((0..15u64).map(|lane| lane * 3));
        kept.when(i.plain.bit(0), product).when(i.plain.bit(1), *kept + 1);
        let words = m.memory("ram", 4, bits(8).of(LANES), ReadUnderWrite::Old).fill(Bits::zero(8));
        words.write(x.bit(0), i.at.trunc(2), x);
        let own = m.memory("ram_a_lane", 4, bits(8).of(LANES), ReadUnderWrite::Old).fill(Bits::new(8, 7));
        own.write(i.plain.bit(2), x.trunc(2), i.plain);
        Out {
            elementwise: (x + i.plain) ^ constants(bits(8).of(LANES), |lane| 10 * u64::from(lane)),
            chosen: select([(x.bit(7), x - 1), (i.plain.bit(0).of(LANES), x & 0x0f)], i.plain),
            shifted: x.shifted(2, i.plain) ^ x.following(0),
            reversed: x.reversed(),
            every_second: x.take(2, |i| 2 * i + 1),
            parents: x.take_or(9, |i| (i - 1) / 2, i.plain),
            interleaved: interleave([x, !x]),
            stacked: stack([y, !y]),
            picked: x.pick(i.at),
            least: x.minimum(),
            most: x.maximum(),
            all: x.and_all(),
            any: x.or_all(),
            total: x.sum(),
            nearest: tree(x, |a: Signal, b| mux(a.le(b), a, b)),
            staged: m.tree_of_stages("most", x, |a, b| mux(a.ge(b), a, b)),
            word_of_all: x.pack(),
            unpacked: i.word.unpack(grid(2, 3)),
            rows: product.rows().lane(1),
            columns: product.columns().last(),
            above: product.rows().previous(y),
            left: product.columns().previous(x),
            column_sums: product.rows().sum(),
            row_sums: product.columns().sum(),
            grid_total: product.sum(),
            kept: *kept,
            words: words.read_async(i.at.trunc(2)),
            own_words: own.read_async(x.trunc(2)),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lanes_are_what_loops_make_of_them(
        x: [u8; LANES], y: [u8; COLUMNS], plain: u8, word in 0u32..1 << 24, at in 0usize..8,
    ) {
        let mut sim = of(&LaneValues);
        let (i, o) = (sim.i, sim.o);
        sim.reset();
        sim.set_lanes(i.x, x);
        sim.set_lanes(i.y, y);
        sim.set(i.plain, plain);
        sim.set(i.word, word);
        sim.set(i.at, at as u64);
        let row = |of: &dyn Fn(usize) -> u8| (0..LANES).map(|lane| u64::from(of(lane))).collect::<Vec<_>>();
        let one = |value: u8| vec![u64::from(value)];
        let product = |row: usize, column: usize| x[row] ^ y[column];
        let field = |of: &dyn Fn(usize, usize) -> u8| {
            (0..LANES * COLUMNS).map(|lane| u64::from(of(lane / COLUMNS, lane % COLUMNS))).collect::<Vec<_>>()
        };
        let wrapping = |values: &mut dyn Iterator<Item = u8>| values.fold(0, u8::wrapping_add);
        let least = *x.iter().min().unwrap();
        let most = *x.iter().max().unwrap();
        let checks = [
            (o.elementwise, row(&|lane| x[lane].wrapping_add(plain) ^ (10 * lane) as u8)),
            (o.chosen, row(&|lane| match (x[lane] >> 7, plain & 1) {
                (1, _) => x[lane] - 1,
                (_, 1) => x[lane] & 15,
                _ => plain,
            })),
            (o.shifted, row(&|lane| {
                (if lane < 2 { plain } else { x[lane - 2] }) ^ x.get(lane + 1).copied().unwrap_or(0)
            })),
            (o.reversed, row(&|lane| x[LANES - 1 - lane])),
            (o.every_second, vec![x[1].into(), x[3].into()]),
            (o.parents, (0..9usize).map(|lane| if lane == 0 { plain } else { x[(lane - 1) / 2] }.into()).collect()),
            (o.interleaved, x.iter().flat_map(|x| [u64::from(*x), u64::from(!x)]).collect()),
            (o.stacked, y.iter().map(|y| u64::from(*y)).chain(y.iter().map(|y| u64::from(!y))).collect()),
            (o.picked, one(x.get(at).copied().unwrap_or(0))),
            (o.least, one(least)),
            (o.most, one(most)),
            (o.all, one(x.iter().fold(255, |all, x| all & x))),
            (o.any, one(x.iter().fold(0, |all, x| all | x))),
            (o.total, one(wrapping(&mut x.iter().copied()))),
            (o.nearest, one(least)),
            (o.word_of_all, vec![x.iter().rev().fold(0u64, |word, x| word << 8 | u64::from(*x))]),
            (o.unpacked, (0..6).map(|lane| u64::from(word >> (4 * lane) & 15)).collect()),
            (o.rows, y.iter().map(|y| u64::from(x[1] ^ y)).collect()),
            (o.columns, row(&|row| product(row, COLUMNS - 1))),
            (o.above, field(&|row, column| if row == 0 { y[column] } else { product(row - 1, column) })),
            (o.left, field(&|row, column| if column == 0 { x[row] } else { product(row, column - 1) })),
            (o.column_sums, (0..COLUMNS).map(|column| wrapping(&mut (0..LANES).map(|row| product(row, column))).into()).collect()),
            (o.row_sums, row(&|row| wrapping(&mut (0..COLUMNS).map(|column| product(row, column))))),
            (o.grid_total, one(wrapping(&mut (0..LANES * COLUMNS).map(|lane| product(lane / COLUMNS, lane % COLUMNS))))),
            (o.kept, (0..15).map(|lane| 3 * lane).collect()),
        ];
        for (number, (port, expected)) in checks.into_iter().enumerate() {
            prop_assert_eq!(sim.lanes(port), expected, "check {}", number);
        }
        sim.step();
        let kept = |row: usize, column: usize| {
            let before = 3 * (row * COLUMNS + column) as u8;
            if plain & 1 == 1 { product(row, column) } else { before + (plain >> 1 & 1) }
        };
        prop_assert_eq!(sim.lanes(o.kept), field(&kept));
        prop_assert_eq!(sim.lanes(o.words), row(&|lane| if x[lane] & 1 == 1 { x[lane] } else { 0 }));
        prop_assert_eq!(sim.lanes(o.own_words), row(&|_| if plain >> 2 & 1 == 1 { plain } else { 7 }));
        // Three levels for five lanes.
        sim.run(2);
        prop_assert_eq!(sim.lanes(o.staged), one(most));
    }
}
