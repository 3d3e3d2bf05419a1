//! Texels clock by clock, and around random points of random textures.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::*;

type Memory = Simulation<TextureMemoryIn, TextureMemoryOut>;

const NONE: TextureMemoryIn<u64> = TextureMemoryIn {
    write: TexelWrite { valid: 0, bank: 0, address: 0, texel: 0 },
    describe: Describe { valid: 0, texture: 0, base: 0, finest: 0 },
    request: TexturePlace { valid: 0, u: 0, v: 0, level: 0, texture: 0 },
};

/// A texel that differs from its neighbours.
pub fn texel(texture: u64, level: u32, i: u64, j: u64) -> u64 {
    (texture * 0x35_0113 + u64::from(level) * 0x9_0461 + i * 0x1_0301 + j * 0x2_1007) & 0xff_ffff
}

/// The write of a texel of a texture with this base.
fn written(texture: u64, base: u64, (level, i, j): (u32, u64, u64)) -> TextureMemoryIn<u64> {
    let TexelAddress { bank, address } = TextureMemory::place(base, level, i, j);
    let write = TexelWrite { valid: 1, bank, address, texel: texel(texture, level, i, j) };
    TextureMemoryIn { write, ..NONE }
}

/// The writes of textures with these finest levels, and the addresses that they take.
pub fn contents(finest: &[u32]) -> (Vec<TextureMemoryIn<u64>>, u64) {
    let (mut writes, mut base) = (Vec::new(), 0);
    for (texture, &finest) in (0..).zip(finest) {
        let describe = Describe { valid: 1, texture, base, finest: finest.into() };
        writes.push(TextureMemoryIn { describe, ..NONE });
        for (level, (i, j)) in (0..=finest)
            .flat_map(|level| (0..1 << level).flat_map(move |j| (0..1 << level).map(move |i| (level, (i, j)))))
        {
            writes.push(written(texture, base, (level, i, j)));
        }
        base += TextureMemory::size(finest);
    }
    (writes, base)
}

/// The texels around a point, by definition: the coordinate on a level is u times its side minus half a texel, and
/// textures repeat. Returns levels, columns and rows.
fn places_around(finest: u32, [u, v]: [u64; 2], level: u64) -> impl Iterator<Item = (u32, u64, u64)> {
    (0..8u64).map(move |number| {
        let level = (level + (number >> 2)).min(finest.into()) as u32;
        let side = 1i64 << level;
        let near = |part: u64, next: u64| {
            let left = (((part as i64) << level) - (1 << 15)).div_euclid(1 << 16);
            (left + next as i64).rem_euclid(side) as u64
        };
        (level, near(u, number & 1), near(v, number >> 1 & 1))
    })
}

/// The texels around a point.
pub fn around(texture: u64, finest: u32, place: [u64; 2], level: u64) -> Vec<u64> {
    places_around(finest, place, level).map(|(level, i, j)| texel(texture, level, i, j)).collect()
}

fn started(texels: u32, textures: u32, writes: &[TextureMemoryIn<u64>]) -> Memory {
    let mut sim = Simulation::of(&TextureMemory { texels, textures }).unwrap();
    sim.reset();
    for write in writes {
        sim.drive(*write);
        sim.step();
    }
    sim
}

#[test]
fn eight_texels_come_three_clocks_later() {
    let (writes, texels) = contents(&[2]);
    let mut sim = started(texels as u32, 1, &writes);
    let wave =
        sim.record(["request_valid", "request_level", "valid", "texels[0]", "texels[3]", "texels[4]", "texels[7]"]);
    for (valid, level) in [(1, 0), (1, 1), (0, 0), (0, 0), (0, 0), (0, 0)] {
        let request = TexturePlace { valid, u: 0x8000, v: 0x8000, level, texture: 0 };
        sim.drive(TextureMemoryIn { request, ..NONE });
        sim.step();
    }
    wave.expect(
        r"
        clk           |~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/
        request_valid |~~~~~~~~~~~~~~~~~\____________________________________
        request_level | 0      | 1      | 0                                 |
        valid         |__________________________/~~~~~~~~~~~~~~~~~\_________
        texels[0]     | 0                                 | 90461  | 0      |
        texels[3]     | 0                                 | c1769  | 0      |
        texels[4]     | c1769                    | 90461  | 151bca | 90461  |
        texels[7]     | 90461                    | c1769  | 182ed2 | c1769  |
        ",
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_has_the_texels_around_any_place(
        (finest, places) in prop::collection::vec(0..5u32, 1..4).prop_flat_map(|finest| {
            let edge = prop_oneof![0..0x1_0000u64, Just(0), Just(0xffff), (0..32u64).prop_map(|n| n << 11)];
            let place = (0..finest.len() as u64, prop::array::uniform2(edge), 0..8u64);
            (Just(finest), prop::collection::vec(place, 1..40))
        }),
    ) {
        let (writes, texels) = contents(&finest);
        let mut sim = started(texels as u32, finest.len() as u32, &writes);
        for clock in 0..places.len() + 3 {
            let request = places.get(clock).map(|&(texture, [u, v], level)| TexturePlace { valid: 1, u, v, level, texture });
            sim.drive(TextureMemoryIn { request: request.unwrap_or(NONE.request), ..NONE });
            let sought = clock.checked_sub(3).map(|clock| places[clock]);
            prop_assert_eq!(sim.get_u64(sim.o.valid), u64::from(sought.is_some()));
            if let Some((texture, place, level)) = sought {
                prop_assert_eq!(sim.lanes(sim.o.texels), around(texture, finest[texture as usize], place, level));
            }
            sim.step();
        }
    }
}

/// Only the texels around a few points of a texture of 1024 x 1024 are written.
#[test]
fn it_has_the_texels_of_the_finest_levels() {
    const FINEST: u32 = TextureMemory::FINEST;
    let describe = Describe { valid: 1, texture: 0, base: 5, finest: FINEST.into() };
    let describe = TextureMemoryIn { describe, ..NONE };
    let mut sim = started(5 + TextureMemory::size(FINEST) as u32, 1, &[describe]);
    for level in 0..=u64::from(FINEST) {
        for place in [[0, 0xffff], [0xffff, 0], [0x5555, 0xaaaa]] {
            let [u, v] = place;
            let writes = places_around(FINEST, place, level).map(|texel| written(0, 5, texel));
            let request = TexturePlace { valid: 1, u, v, level, texture: 0 };
            for inputs in writes.chain([TextureMemoryIn { request, ..NONE }, NONE, NONE]) {
                sim.drive(inputs);
                sim.step();
            }
            assert_eq!(sim.lanes(sim.o.texels), around(0, FINEST, place, level), "level {level}, {place:x?}");
        }
    }
}

/// No two texels share an address, neither of one texture nor of two that are stored one after the other.
#[test]
fn every_texel_has_a_place_of_its_own() {
    for finest in 0..6 {
        let (writes, texels) = contents(&[finest, 3]);
        let mut places: Vec<(u64, u64)> =
            writes.iter().filter(|it| it.write.valid == 1).map(|it| (it.write.bank, it.write.address)).collect();
        let count = places.len();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), count);
        assert!(places.iter().all(|&(_, address)| address < texels));
    }
}
