use super::*;
use crate::vc1::Config;
use tilewright_scenes::{Projection, Scene, Size, project};

fn scene(name: &str, width: u32, height: u32) -> Arc<Projection> {
    let size = Size::new(width, height).expect("in range");
    Arc::new(project(&Scene::builtin(name).expect("a built-in scene"), size).expect("in sight"))
}

/// Without broadcast polygons nobody has to do with another one, so that each does alone what it does among all.
#[test]
fn alone_each_does_what_it_does_in_the_machine() {
    let view = scene("teapot", 80, 60);
    for pages in [300, 60] {
        let config = Config { processors: 4, pages: Some(pages), apr: None, refresh: 4000.0, ..Config::new(view.size) };
        let model = Model::new(config).unwrap();
        let dealt = model.deal(&view, None).unwrap();
        let (machine, estimate) = (model.render(std::iter::repeat_n(dealt.clone(), 6)), model.estimate(&dealt, 6));
        assert_eq!(estimate.own, estimate.with_broadcast);
        for (k, alone) in estimate.own.iter().enumerate() {
            for (alone, among) in alone.frames.iter().zip(&machine.frames) {
                let [alone, among] = [&alone.processors[0], &among.processors[k]];
                assert_eq!((alone.pixels, alone.overflows), (among.pixels, among.overflows));
                assert_eq!(alone.clocks.work(), among.clocks.work());
                // A crossing of clocks after a swap may be a clock longer.
                assert!(alone.clocks.stalled.abs_diff(among.clocks.stalled) <= 2 * (1 + alone.overflows));
            }
        }
        // The slowest has its frames shown when the machine has.
        let shown = |report: &Report| report.frames.iter().map(|it| it.times.shown).collect::<Vec<_>>();
        assert_eq!(shown(estimate.slowest()), shown(&machine), "{pages}");
    }
}

/// In the second pass each draws its own rows of all broadcast polygons, as among all.
#[test]
fn the_second_pass_has_all_broadcast_polygons() {
    let view = scene("table", 80, 60);
    let config = Config { processors: 4, apr: Some(20), refresh: 4000.0, ..Config::new(view.size) };
    let model = Model::new(config).unwrap();
    let dealt = model.deal(&view, None).unwrap();
    let (machine, estimate) = (model.render([dealt.clone()]), model.estimate(&dealt, 1));
    for (k, among) in machine.frames[0].processors.iter().enumerate() {
        let [own, all] = [&estimate.own[k], &estimate.with_broadcast[k]].map(|it| &it.frames[0].processors[0]);
        assert_eq!((all.pixels, all.broadcast), (among.pixels, among.broadcast));
        assert!(own.pixels < all.pixels && own.broadcast == 0);
        assert_eq!(all.clocks.receiving, among.clocks.receiving);
        assert_eq!(all.clocks.rasterization, among.clocks.rasterization);
        assert!(own.clocks.rasterization < all.clocks.rasterization && own.clocks.geometry == all.clocks.geometry);
    }
}
