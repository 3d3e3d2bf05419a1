//! What machines leave of a frame: who wrote which pixel, and what units did in their clocks.

use tilewright_machines::{Area, History, Recorder, Span, Watch, pixel_planes, pixelflow, quadtree, vc1};
use tilewright_scenes::deferred::{Samples, project_deferred};
use tilewright_scenes::frame::blank;
use tilewright_scenes::{Frame, PixelBox, Polygons, Scene, Size, golden, project, project_polygons};

fn star() -> (Scene, Polygons) {
    let scene = Scene::builtin("star").expect("a built-in scene");
    let polygons = project_polygons(&scene, Size::new(64, 48).expect("in range")).expect("it can be set up");
    (scene, polygons)
}

/// The picture in the end is the frame, and those pixels have an owner that something covers.
fn check(history: &History, frame: &Frame, background: [u8; 3]) {
    assert_eq!(history.picture_at(u64::MAX).words, frame.words);
    assert_eq!(history.picture_at(0), Frame::blank(frame.size(), background));
    let is_owned: Vec<bool> = history.owners().iter().map(Option::is_some).collect();
    let is_covered: Vec<bool> = frame.words.iter().map(|word| *word != blank(background)).collect();
    assert_eq!(is_owned, is_covered);
    assert!(is_covered.contains(&true) && is_covered.contains(&false));
    assert!(history.writes.is_sorted_by_key(|write| write.time));
    for lane in &history.lanes {
        let fits = |span: &Span| span.amount as f64 <= (span.to - span.from) as f64 * lane.rate * 1.001;
        // The ring may bring what it saved up a little later.
        let is_ring = lane.of == "bits";
        assert!(lane.spans.iter().all(|span| span.from < span.to && (is_ring || fits(span))), "{lane:?}");
        assert!(lane.spans.is_sorted_by_key(|span| span.from), "{lane:?}");
    }
}

fn amount(history: &History, lane: &str, what: &str) -> u64 {
    history.lanes.iter().find(|it| it.name == lane).unwrap_or_else(|| panic!("no lane {lane}")).amount(what)
}

/// The patch of each pixel that is written has one page there at that time.
fn each_pixel_is_drawn_into_a_page(history: &History) {
    assert!(!history.areas.is_empty());
    for write in &history.writes {
        let [x, y] = [write.pixel % 64, write.pixel / 64];
        let holds = |it: &&Area| {
            let ([left, top], [width, height]) = (it.place, it.size);
            let is_inside = (left..left + width).contains(&x) && (top..top + height).contains(&y);
            it.painter == write.painter && (it.from..it.to).contains(&write.time) && is_inside
        };
        assert_eq!(history.areas.iter().filter(holds).count(), 1, "{write:?}");
    }
}

#[test]
fn processing_elements_of_a_vc1_have_the_clocks_of_the_report() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, polygons) = star();
    let projection = project(&scene, polygons.size)?;
    let config =
        vc1::Config { processors: 3, apr: Some(20), cluster: 1, refresh: 5000.0, ..vc1::Config::new(polygons.size) };
    let recorder = Recorder::with_areas();
    let machine = vc1::Machine::new(config)?.recorded(&recorder);
    let (frame, report) = machine.render(&projection, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    check(&history, &frame, scene.background);
    each_pixel_is_drawn_into_a_page(&history);
    for lane in history.lanes.iter().filter(|it| it.name != "display") {
        assert!(lane.spans.array_windows().all(|[one, next]| one.to == next.from), "{}", lane.name);
        // Each span is of clocks, and has as many as its time.
        let clocks = |span: &Span| (span.to - span.from) as f64 * lane.rate;
        assert!(lane.spans.iter().all(|span| (clocks(span) - span.amount as f64).abs() < 1.0), "{lane:?}");
    }
    let [frame] = &report.frames[..] else { panic!("one frame") };
    for (number, it) in frame.processors.iter().enumerate() {
        let lane = format!("PE {number}");
        for (name, clocks) in vc1::Clocks::NAMES.iter().zip(it.clocks.all()) {
            assert_eq!(amount(&history, &lane, name), clocks, "{lane}: {name}");
        }
        let end = history.lanes[number].spans.last().expect("it does something").to;
        // They swap within a clock or so, and the host sees it at the next edge.
        let swapped = frame.times.swapped.expect("it is shown");
        assert!((swapped.saturating_sub(200_000)..=swapped).contains(&end), "{lane}: {end} {swapped}");
    }
    // Each of them draws something, and large polygons row by row.
    let owners: Vec<u32> = history.owners().into_iter().flatten().collect();
    assert!((0..3).all(|number| owners.contains(&number)));
    Ok(())
}

#[test]
fn video_processors_have_the_pixels_of_their_rasters() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, polygons) = star();
    let config =
        quadtree::Config { matrix: (4, 2), ..quadtree::Config::for_packets(polygons.size, &polygons.polygons) };
    let recorder = Recorder::default();
    let mut machine = quadtree::Machine::new(config)?.recorded(&recorder);
    let (frame, report) = machine.render(&polygons.polygons, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    check(&history, &frame, scene.background);
    for (pixel, owner) in (0..).zip(history.owners()) {
        let raster = pixel / 64 % 2 * 4 + pixel % 64 % 4;
        assert!(owner.is_none_or(|owner| owner == raster), "{pixel}: {owner:?}");
    }
    for stage in &report.stages {
        let lane = if stage.level == 0 { "set-up".to_owned() } else { format!("{} pipe", stage.level) };
        let found = ["busy", "stalled"].map(|what| amount(&history, &lane, what));
        assert_eq!(found, [stage.busy.all, stage.stalled.all], "{lane}");
    }
    assert_eq!(amount(&history, "broadcast", "stalled"), report.broadcast_stalls);
    let [drawing, reading] = &report.phases[..] else { panic!("two phases") };
    assert_eq!(amount(&history, "controller", "reading out"), reading.clocks);
    // What is looked at comes to the same as what is not.
    let unseen =
        quadtree::Config { matrix: (4, 2), ..quadtree::Config::for_packets(polygons.size, &polygons.polygons) };
    let (_, unseen) =
        quadtree::Machine::new(unseen)?.render(&polygons.polygons, scene.background, &mut Watch::default())?;
    assert_eq!((&unseen, unseen.drawing_clocks()), (&report, drawing.clocks));
    Ok(())
}

#[test]
fn renderers_of_pixel_planes_have_the_pixels_of_their_regions() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, polygons) = star();
    // A ring that is slow lets renderers wait for instructions and for the store.
    let config = pixel_planes::Config { renderers: 2, side: 16, ring: 320, ..pixel_planes::Config::new(polygons.size) };
    let (recorder, regions) = (Recorder::default(), config.regions()?);
    let machine = pixel_planes::Machine::new(config)?.recorded(&recorder);
    let (frame, report) = machine.render(&polygons, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    check(&history, &frame, scene.background);
    let owners = history.owners();
    for it in &report.regions {
        let PixelBox { left, top, right, bottom } = regions.pixels(it.region);
        let pixels = (top..=bottom).flat_map(|y| (left..=right).map(move |x| (y * 64 + x) as usize));
        assert!(pixels.filter_map(|pixel| owners[pixel]).all(|owner| owner as usize == it.renderer), "{it:?}");
        let is_here = |pixel: u32| regions.of_pixel(pixel % 64, pixel / 64) == it.region;
        let clocks = it.begun..it.begun + it.clocks + 32;
        let times = history.writes.iter().filter(|write| is_here(write.pixel)).map(|write| write.time / 25_000);
        assert!(times.clone().all(|clock| clocks.contains(&clock)), "{it:?}: {:?}", times.max());
    }
    for (number, it) in report.renderers.iter().enumerate() {
        let found = ["drawing", "waiting for instructions", "waiting for the store"]
            .map(|what| amount(&history, &format!("renderer {number}"), what));
        assert_eq!(found, [it.working(), it.starved, it.waited_for_store]);
        assert!(found.iter().all(|clocks| *clocks > 0), "{found:?}");
    }
    let ring = ["instructions", "planes"].map(|what| amount(&history, "ring", what));
    assert_eq!(ring.iter().sum::<u64>(), report.ring.bits);
    assert_eq!(amount(&history, "frame buffer", "planes"), report.ring.planes);
    assert_eq!(amount(&history, "geometry", "geometry of the next frame"), report.geometry.clocks);
    Ok(())
}

#[test]
fn rasterizers_of_pixelflow_have_the_pixels_of_their_polygons() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, size) = (star().0, Size::new(32, 24)?);
    let polygons = project_polygons(&scene, size)?;
    let config = pixelflow::Config { nodes: 4, shaders: 0, array: [16, 8], ..pixelflow::Config::new(polygons.size) };
    let recorder = Recorder::default();
    let machine = pixelflow::Machine::new(config.clone())?.recorded(&recorder);
    let (frame, report) = machine.render_resident(&polygons, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    check(&history, &frame, scene.background);
    // Polygons are dealt to nodes in turn; a pixel is of one whose polygon has its word.
    let all = PixelBox { left: 0, top: 0, right: 31, bottom: 23 };
    let mut may = vec![[false; 3]; frame.words.len()];
    for number in 0..polygons.polygons.len() {
        golden::visit_fragments(&polygons, number, &all, |pixel, word| {
            may[pixel as usize][number % 3] |= frame.words[pixel as usize] == word;
        });
    }
    for (pixel, owner) in history.owners().into_iter().enumerate() {
        assert!(owner.is_none_or(|owner| may[pixel][owner as usize]), "{pixel}: {owner:?}");
    }
    for (number, node) in (1..).zip(&report.rasterizers) {
        assert_eq!(amount(&history, &format!("rasterizer {number}"), "rasterizing"), node.busy);
    }
    assert_eq!(amount(&history, "frame's holder", "storing"), report.holder);
    assert_eq!(amount(&history, "front end", "geometry"), report.front);
    for stage in report.stages() {
        let (lane, what) = match stage.name {
            "composing" => ("network", "composing"),
            "frame buffer" => ("frame buffer", "loading"),
            _ => continue,
        };
        assert_eq!(amount(&history, lane, what), stage.busy);
    }

    // Deferred shading: what shaders send back is nobody's, and the nearest triangle decides.
    let (recorder, deferred) = (Recorder::default(), project_deferred(&scene, polygons.size, Samples::One)?);
    let config = pixelflow::Config { nodes: 5, shaders: 1, ..config };
    let machine = pixelflow::Machine::new(config)?.recorded(&recorder);
    let (frame, report) = machine.render(&deferred, &mut Watch::default())?;
    let shaded = recorder.take().expect("a frame was rendered");
    assert_eq!(shaded.picture_at(u64::MAX).rgb_bytes(), frame.rgb_bytes());
    let packets = &deferred.passes[0].packets;
    for (pixel, owner) in (0..).zip(shaded.owners()) {
        let (x, y) = (pixel % 32, pixel / 32);
        let covering = || packets.iter().zip(0..).filter(|(it, _)| it.triangle.covers(x, y));
        let nearest = covering().map(|(it, _)| it.triangle.depth(x, y)).min();
        assert_eq!(owner.is_some(), nearest.is_some(), "({x}, {y})");
        let is_its =
            |owner| covering().any(|(it, number)| number % 3 == owner && Some(it.triangle.depth(x, y)) == nearest);
        assert!(owner.is_none_or(is_its), "({x}, {y}): {owner:?}");
    }
    assert_eq!(amount(&shaded, "shader 1", "shading"), report.shaders[0].busy);
    assert_eq!(amount(&shaded, "front end", "geometry"), report.front);
    Ok(())
}

#[test]
fn windows_of_a_generator_end_and_its_stages_have_the_rate_of_their_units() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, Polygons { polygons, size, .. }) = star();
    let config = quadtree::Config { matrix: (4, 2), ..quadtree::Config::for_packets(size, &polygons) };
    let recorder = Recorder::with_areas();
    let mut machine = quadtree::Machine::new(config)?.recorded(&recorder);
    let (_, report) = machine.render(&polygons, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    for stage in &report.stages {
        let name = if stage.level == 0 { "set-up".to_owned() } else { format!("{} pipe", stage.level) };
        let lane = history.lanes.iter().find(|it| it.name == name).unwrap_or_else(|| panic!("no lane {name}"));
        assert_eq!(lane.rate, f64::from(8 * stage.units) / 10_000.0, "8 video processors, and clocks of 10 ns");
    }
    // A unit that takes a window has ended the one before; after the last packet, all have ended.
    assert!(!history.areas.is_empty());
    assert!(history.areas.iter().all(|it| it.from < it.to && it.to < u64::MAX));
    Ok(())
}

#[test]
fn a_slow_ring_has_the_load_of_its_bits_and_makes_renderers_wait() -> Result<(), Box<dyn std::error::Error>> {
    let (scene, polygons) = star();
    let config = pixel_planes::Config { renderers: 2, side: 16, ring: 320, ..pixel_planes::Config::new(polygons.size) };
    let recorder = Recorder::default();
    let machine = pixel_planes::Machine::new(config)?.recorded(&recorder);
    let (_, report) = machine.render(&polygons, scene.background, &mut Watch::default())?;
    let history = recorder.take().expect("a frame was rendered");
    // It brings 8 bits a clock, until the last plane.
    assert_eq!(report.ring.load, report.ring.bits as f64 / (8 * report.sent) as f64);
    // The mean of two renderers is half of both.
    let [one, other] = [0, 1].map(|number| report.renderers[number].working());
    assert_eq!(report.balance(), (one + other) as f64 / (2 * one.max(other)) as f64);
    // Of renderers that begin to wait at the same time, the lower number is the first.
    let waits = |number: usize| {
        let mut spans = history.lanes[number].spans.iter();
        spans.find(|span| span.what == "waiting for instructions").map(|span| (span.from / 25_000, number))
    };
    let first = report.first_starved.expect("a slow ring").renderer;
    assert!(waits(first) <= waits(1 - first));
    Ok(())
}

#[test]
fn the_mean_of_one_primitive_is_its_own_clocks() {
    let clocks = pixel_planes::ProgramClocks { program: "flat_least", primitives: 1, clocks: 97, most: 97 };
    assert_eq!(clocks.mean(), 97.0);
}
