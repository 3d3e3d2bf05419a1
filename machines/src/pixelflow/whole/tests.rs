//! The model beside whole machines.

use proptest::prelude::*;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_scenes::deferred::{Samples, Shading, project_deferred};
use tilewright_scenes::frame::rgb_of;
use tilewright_scenes::{Scene, Size, golden, project_polygons, project_samples};

use super::super::config::Config;
use super::super::costs::Costs;
use super::super::model::Timing;
use super::super::works::Drawing;
use super::*;

/// What the model says of all that is seen.
fn modelled(built: &Built, works: &Works) -> Events {
    let timing = Timing::new(built, works);
    let rasterizers = works.shares();
    let nodes = 1 + rasterizers + built.shaders;
    let mut events = Events {
        given: vec![Default::default(); nodes],
        passed: vec![Default::default(); nodes],
        began: vec![Vec::new(); nodes],
        stored: (0..works.turns())
            .filter(|turn| works.ends(*turn))
            .map(|turn| timing.turns[turn].loaded.clone())
            .collect(),
    };
    events.given[0] = timing.first_stores.map(|given| vec![given]);
    for (number, given) in timing.first_words.iter().enumerate() {
        events.given[1 + rasterizers + number][0].push(*given);
    }
    let later = |at: &Range<Ticks>, nodes: usize| at.start + nodes as Ticks..at.end + nodes as Ticks;
    for (number, (turn, given)) in timing.turns.iter().zip(&timing.given).enumerate() {
        if works.comes_to_holder(number) {
            events.given[0][works.holders_bank(number)].push(given.stored);
        }
        for (share, given) in given.words.iter().enumerate() {
            events.given[1 + share][number % 2].push(*given);
        }
        let Some(shader) = works.shader_of(number, built.shaders) else {
            for node in 0..=rasterizers {
                events.passed[node][1].push(later(&turn.composed, rasterizers - node));
            }
            continue;
        };
        let shader = 1 + rasterizers + shader;
        events.given[shader][0].push(given.next_word);
        events.began[shader].push(turn.shaded.start);
        for node in 1..nodes {
            events.passed[node][0].push(later(&turn.composed, node - 1));
        }
        if works.comes_to_holder(number) {
            events.given[shader][1].push(turn.shaded.end);
            for node in 0..=shader {
                events.passed[node][1].push(later(&turn.sent, shader - node));
            }
        }
    }
    events
}

/// A machine: rasterizers, shaders, its array, the rest of what is chosen.
#[derive(Clone, Copy, Debug)]
struct Choice {
    rasterizers: u32,
    shaders: u32,
    array: [u32; 2],
    set_up: Ticks,
    side_by_side: bool,
}

/// Compares model, hardware and the golden image.
fn check(choice: Choice, size: Size, works: &Works, golden: &tilewright_scenes::Frame) -> Result<(), TestCaseError> {
    let [width, height] = choice.array;
    let array = PixelArray { width, height };
    let built = Built {
        array: &array,
        shaders: if works.is_shaded() { choice.shaders as usize } else { 0 },
        side_by_side: choice.side_by_side,
        set_up: choice.set_up,
        looks_up: TextureLookUp::clocks(&array),
        loads: works.frame_buffer().unwrap().clocks(),
    };
    let mut whole = Whole::new(built, works);
    whole.run();
    let golden: Vec<[u8; 3]> = golden.words.iter().map(|word| rgb_of(*word)).collect();
    prop_assert_eq!(whole.shown(), golden, "{}", size);
    let (mut seen, modelled) = (whole.seen, modelled(&built, works));
    // Of the others it is not told.
    (0..=works.shares()).for_each(|node| seen.began[node].clear());
    for node in 0..seen.given.len() {
        prop_assert_eq!(&modelled.given[node], &seen.given[node], "given by node {}", node);
        prop_assert_eq!(&modelled.passed[node], &seen.passed[node], "passed node {}", node);
        prop_assert_eq!(&modelled.began[node], &seen.began[node], "begun by node {}", node);
    }
    prop_assert_eq!(modelled.stored, seen.stored);
    Ok(())
}

/// A front end that takes no time: here all instructions are there from the beginning on.
fn at_once() -> Costs {
    Costs { overhead: 0.0, transform_plain: 0.0, ..Costs::default() }
}

fn choices() -> impl Strategy<Value = Choice> {
    let array = prop::sample::select(vec![[8, 8], [16, 8], [8, 16]]);
    let set_up = prop_oneof![Just(0), 1..4u64, 30..200u64];
    (1..4u32, 1..4u32, array, set_up, any::<bool>()).prop_map(|(rasterizers, shaders, array, set_up, side_by_side)| {
        Choice { rasterizers, shaders, array, set_up, side_by_side }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    /// With deferred shading.
    #[test]
    fn the_model_is_the_whole_machine_tick_for_tick(
        choice in choices(),
        [width, height] in [6..30u32, 6..20u32],
        scene in prop_oneof![Just("star"), Just("teapot"), Just("textured")],
        (turned, count) in (any::<prop::sample::Index>(), 0..14usize),
    ) {
        let size = Size::new(width, height).unwrap();
        let mut deferred = project_deferred(&Scene::builtin(scene).unwrap(), size, Samples::One).unwrap();
        let packets = &mut deferred.passes[0].packets;
        let length = packets.len();
        packets.rotate_left(turned.index(length));
        packets.truncate(count);
        let golden = golden::render_deferred(&deferred);
        let Choice { rasterizers, shaders, array, side_by_side, .. } = choice;
        let nodes = 1 + rasterizers + shaders;
        let config = Config { nodes, shaders, array, side_by_side, ..Config::new(size) };
        let works = Works::deferred(&config, &deferred.passes, &deferred.shader).unwrap();
        check(choice, size, &works, &golden)?;
    }

    /// With all regions in memory.
    #[test]
    fn the_model_is_a_resident_frame_tick_for_tick(
        choice in choices(),
        [width, height] in [6..40u32, 6..30u32],
        scene in prop_oneof![Just("star"), Just("teapot"), Just("textured")],
        (turned, count) in (any::<prop::sample::Index>(), 0..24usize),
    ) {
        let size = Size::new(width, height).unwrap();
        let scene = Scene::builtin(scene).unwrap();
        let mut polygons = project_polygons(&scene, size).unwrap();
        let length = polygons.polygons.len();
        polygons.polygons.rotate_left(turned.index(length));
        polygons.polygons.truncate(count);
        let golden = golden::render(size, &polygons.polygons, scene.background);
        let Choice { rasterizers, array, side_by_side, .. } = choice;
        let config = Config { nodes: 1 + rasterizers, shaders: 0, array, side_by_side, costs: at_once(), ..Config::new(size) };
        let works = Works::resident(&config, &[Drawing::of(&config, &polygons.polygons)], scene.background).unwrap();
        check(choice, size, &works, &golden)?;
    }

    /// With eight samples one after another, which the holder of the frame adds up.
    #[test]
    fn the_model_is_a_frame_of_eight_samples_tick_for_tick(
        choice in choices(),
        [width, height] in [6..30u32, 6..20u32],
        count in 0..9usize,
    ) {
        let size = Size::new(width, height).unwrap();
        let scene = Scene::builtin("star").unwrap();
        let mut passes = project_samples(&scene, size, Samples::Eight(Shading::EachSample)).unwrap();
        passes.iter_mut().for_each(|pass| pass.triangles.truncate(count));
        let golden = golden::render_samples(&passes, scene.background);
        let Choice { rasterizers, array, side_by_side, .. } = choice;
        let config = Config { nodes: 1 + rasterizers, shaders: 0, array, side_by_side, costs: at_once(), ..Config::new(size) };
        let works = Works::resident(&config, &Drawing::eight(&config, &passes), scene.background).unwrap();
        check(choice, size, &works, &golden)?;
    }

    /// With eight samples of which each is shaded, and the frame buffer averages them.
    #[test]
    fn the_model_is_a_frame_of_samples_side_by_side_tick_for_tick(
        choice in choices(),
        [width, height] in [6..15u32, 6..10u32],
        scene in prop_oneof![Just("star"), Just("textured")],
        count in 0..9usize,
    ) {
        let size = Size::new(width, height).unwrap();
        let scene = Scene::builtin(scene).unwrap();
        let mut deferred = project_deferred(&scene, size, Samples::Eight(Shading::EachSample)).unwrap();
        deferred.passes.iter_mut().for_each(|pass| pass.packets.truncate(count));
        let golden = golden::render_deferred(&deferred);
        let Choice { rasterizers, shaders, array, side_by_side, .. } = choice;
        let nodes = 1 + rasterizers + shaders;
        let config = Config { nodes, shaders, array, side_by_side, ..Config::new(size) };
        let works = Works::deferred(&config, &deferred.passes, &deferred.shader).unwrap();
        check(choice, size, &works, &golden)?;
    }

    /// With eight samples that are shaded once: all of a pixel come to one shader.
    #[test]
    fn the_model_is_a_frame_that_is_shaded_once_tick_for_tick(
        choice in choices(),
        [width, height] in [6..20u32, 6..12u32],
        count in 0..5usize,
    ) {
        let size = Size::new(width, height).unwrap();
        let scene = Scene::builtin("textured").unwrap();
        let mut deferred = project_deferred(&scene, size, Samples::Eight(Shading::OncePerPixel)).unwrap();
        deferred.passes.iter_mut().for_each(|pass| pass.packets.truncate(count));
        let golden = golden::render_deferred(&deferred);
        let Choice { rasterizers, shaders, array, side_by_side, .. } = choice;
        let nodes = 1 + rasterizers + shaders;
        let config = Config { nodes, shaders, array, side_by_side, ..Config::new(size) };
        let works = Works::deferred_once(&config, &deferred.passes, &deferred.shader).unwrap();
        check(choice, size, &works, &golden)?;
    }
}
