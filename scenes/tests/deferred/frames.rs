//! Frames of deferred shading: their agreement with the other golden frames, and their checksums.

use proptest::prelude::*;
use std::ops::ControlFlow;
use tilewright_scenes::deferred::{
    Appearance, AppearancePacket, Deferred, SECOND_SHIFT, Samples, Shading, project_deferred,
};
use tilewright_scenes::packet::EMPTY_DEPTH;
use tilewright_scenes::{Camera, Mesh, MeshTriangle, Plane, Scene, Size, builtin, golden, project, project_sample};

fn small() -> Size {
    Size::new(64, 48).unwrap()
}

fn deferred(name: &str, size: Size, samples: Samples) -> Deferred {
    project_deferred(&Scene::builtin(name).unwrap(), size, samples).unwrap()
}

/// Set-up is the same, so at each pixel the least word has the depth that every other frame has.
#[test]
fn depths_are_those_of_the_gouraud_frame() {
    for name in builtin::NAMES {
        let scene = Scene::builtin(name).unwrap();
        if !scene.spheres.is_empty() {
            continue;
        }
        let (projection, deferred) = (project(&scene, small()).unwrap(), deferred(name, small(), Samples::One));
        assert_eq!(projection.counts, deferred.counts, "{name}");
        let frame = golden::render(small(), &projection.triangles, scene.background);
        let words = golden::visible(small(), &deferred.passes[0].packets);
        for (pixel, (word, seen)) in frame.words.iter().zip(&words).enumerate() {
            let depth = if seen.is_empty() { EMPTY_DEPTH } else { seen.parameters().z };
            assert_eq!((word >> 24) as u32, depth, "{name}, pixel {pixel}");
        }
    }
}

/// Lines are not lit, so their colours are those of the Gouraud frame, except where depths tie.
#[test]
fn lines_are_drawn_as_they_are() {
    let scene = Scene::builtin("star").unwrap();
    let frame = golden::render_deferred(&deferred("star", small(), Samples::One));
    let plain = golden::render(small(), &project(&scene, small()).unwrap().triangles, scene.background);
    assert_eq!(frame.rgb_bytes(), plain.rgb_bytes());
}

#[test]
fn eight_samples_are_two_ordinary_passes() {
    let scene = Scene::builtin("textured").unwrap();
    let deferred = deferred("textured", small(), Samples::Eight(Shading::EachSample));
    let doubled = Size::new(128, 96).unwrap();
    for (pass, shift) in deferred.passes.iter().zip([[0, 0], SECOND_SHIFT]) {
        let plain = project_sample(&scene, doubled, shift).unwrap().triangles;
        assert_eq!((pass.size, pass.packets.len()), (doubled, plain.len()));
        for (packet, plain) in pass.packets.iter().zip(plain) {
            assert_eq!((packet.triangle.edges, packet.triangle.z), (plain.edges, plain.z));
        }
    }
    // By the definition: the mean of eight colours.
    let words = [0, 1].map(|i| golden::visible(doubled, &deferred.passes[i].packets));
    let frame = golden::render_deferred(&deferred);
    for (x, y) in (0..48).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let mut sums = [0_u32; 3];
        for (words, dx, dy) in
            words.iter().flat_map(|words| [(words, 0, 0), (words, 1, 0), (words, 0, 1), (words, 1, 1)])
        {
            let colour = deferred.shader.shade(words[(2 * y + dy) * 128 + 2 * x + dx]);
            sums.iter_mut().zip(colour).for_each(|(sum, channel)| *sum += u32::from(channel));
        }
        assert_eq!(frame.rgb(x as u32, y as u32), sums.map(|sum| ((sum + 4) / 8) as u8), "({x}, {y})");
    }
}

/// Inside a surface, shading once gives nearly the same result as shading each sample.
#[test]
fn shading_once_differs_little() {
    let frame = |shading| golden::render_deferred(&deferred("textured", small(), Samples::Eight(shading)));
    let (each, once) = (frame(Shading::EachSample).rgb_bytes(), frame(Shading::OncePerPixel).rgb_bytes());
    assert_ne!(each, once);
    let differences: u64 = each.iter().zip(&once).map(|(p, q)| u64::from(p.abs_diff(*q))).sum();
    let mean = differences as f64 / each.len() as f64;
    assert!(mean < 6.0, "{mean}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    /// DES-MIN: neither sequence nor distribution of the packets changes a word.
    #[test]
    fn order_and_partition_do_not_matter(keys in proptest::collection::vec((0..4_usize, any::<u32>()), 512)) {
        let packets = &deferred("textured", small(), Samples::One).passes[0].packets;
        // Each packet again at the same depths: at every pixel a parameter other than depth decides.
        let turned = |packet: &AppearancePacket| AppearancePacket { normal: packet.normal.map(negated), ..packet.clone() };
        let packets: Vec<_> = packets.iter().cloned().chain(packets.iter().map(turned)).collect();
        let whole = golden::visible(small(), &packets);
        let mut merged = vec![Appearance::EMPTY; small().pixels()];
        for buffer in [2, 0, 3, 1] {
            let mut mine: Vec<_> = packets.iter().zip(keys.iter().cycle()).filter(|(_, key)| key.0 == buffer).collect();
            mine.sort_by_key(|(_, key)| key.1);
            let mine: Vec<_> = mine.into_iter().map(|(packet, _)| packet.clone()).collect();
            for (kept, word) in merged.iter_mut().zip(golden::visible(small(), &mine)) {
                *kept = word.min(*kept);
            }
        }
        prop_assert_eq!(merged, whole);
    }
}

/// The plane of the opposite numbers, up to rounding.
fn negated(plane: Plane) -> Plane {
    let negated = |number: u64| u64::from((number as u32).wrapping_neg());
    Plane { x: negated(plane.x), y: negated(plane.y), origin: negated(plane.origin) }
}

/// A word of the teapot agrees with the mesh.
#[test]
fn colours_are_diffuse_and_plain_surfaces_have_no_texture() {
    let words = golden::visible(small(), &deferred("teapot", small(), Samples::One).passes[0].packets);
    let covered: Vec<_> = words.iter().filter(|word| !word.is_empty()).map(Appearance::parameters).collect();
    assert!(covered.len() > 500);
    for seen in covered {
        assert_eq!((seen.rgb, seen.material), ([209, 163, 107], 0));
        assert_eq!((seen.uv, seen.scale, seen.level), ([0; 2], 0, 0));
        let length = seen.normal.iter().map(|&n| f64::from(n).powi(2)).sum::<f64>().sqrt();
        assert!((25_000.0..32_769.0).contains(&length), "{length}");
    }
}

/// The normals of a triangle seen from behind, or with reversed normals, are flipped: both sides look the same.
#[test]
fn normals_are_turned_to_the_eye() {
    let scene = Scene::builtin("teapot").unwrap();
    let camera =
        Camera { eye: [0.0, 0.0, 5.0].into(), target: [0.0, 0.0, 0.0].into(), up: [0.0, 1.0, 0.0].into(), fov: 40.0 };
    for (corners, up) in [([0, 1, 2], 1.0), ([0, 1, 2], -1.0), ([0, 2, 1], 1.0), ([0, 2, 1], -1.0)] {
        let positions = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]].map(Into::into).to_vec();
        let triangle = MeshTriangle { positions: corners, normals: [0; 3], diffuse: [1.0; 3] };
        let mesh = Mesh::new(positions, vec![[0.0, 0.6 * up, 0.8 * up].into()], vec![triangle]).unwrap();
        let scene = Scene { mesh, camera, ..scene.clone() };
        let packets = &project_deferred(&scene, small(), Samples::One).unwrap().passes[0].packets;
        // Up is not down, and towards the eye not forward.
        assert_eq!(packets[0].parameters(32, 24).normal, [0, -19660, -26214], "{corners:?} {up}");
    }
}

/// A texel should be as large as a shaded sample: one level less where that is twice as wide.
#[test]
fn shading_once_takes_coarser_textures() {
    let levels = |shading| {
        let deferred = deferred("textured", small(), Samples::Eight(shading));
        deferred.passes[1].packets.iter().map(|packet| packet.level).collect::<Vec<_>>()
    };
    let (each, once) = (levels(Shading::EachSample), levels(Shading::OncePerPixel));
    assert!(each.iter().any(|&level| level > 50));
    assert_eq!(each.iter().map(|level| level.saturating_sub(8)).collect::<Vec<_>>(), once);
}

#[test]
fn rendering_can_be_watched_and_stopped() {
    for samples in [Samples::One, Samples::Eight(Shading::EachSample), Samples::Eight(Shading::OncePerPixel)] {
        let deferred = deferred("star", small(), samples);
        let mut heard = Vec::new();
        let whole = golden::render_deferred_watched(&deferred, |done| {
            heard.push(done);
            ControlFlow::Continue(())
        });
        assert_eq!(whole, Some(golden::render_deferred(&deferred)));
        let last = heard[heard.len() - 1];
        assert!(heard.is_sorted() && heard[0] == 0.0 && (0.9..1.0).contains(&last), "{samples:?}: {last}");
        let stop_after = |most: f64| {
            let watch = |done| if done < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
            golden::render_deferred_watched(&deferred, watch)
        };
        assert_eq!([stop_after(0.2), stop_after(0.8)], [None, None]);
    }
}

#[test]
fn a_frame_of_eight_samples_is_at_most_1024_pixels_wide_and_high() {
    let scene = Scene::builtin("star").unwrap();
    let size = Size::new(1025, 8).unwrap();
    let error = project_deferred(&scene, size, Samples::Eight(Shading::EachSample)).unwrap_err();
    let sentence = "a frame of 1025x8 pixels with 8 samples each is too large: give a width and a height up to 1024, or one sample";
    assert_eq!(error.to_string(), sentence);
    assert!(project_deferred(&scene, Size::new(1024, 1024).unwrap(), Samples::Eight(Shading::EachSample)).is_ok());
}

#[test]
fn a_shader_has_at_most_256_lights() {
    let mut scene = Scene::builtin("teapot").unwrap();
    let light = scene.lighting.lights[0];
    scene.lighting.lights = vec![light; 257];
    let error = project_deferred(&scene, small(), Samples::One).unwrap_err();
    assert_eq!(error.to_string(), "the scene has 257 lights: give at most 256 for deferred shading");
}

/// To the last bit; new values are printed by `cargo run --release -p tilewright-scenes --example measure`, which leaves the pictures in
/// the folder for temporary files: look at them before you pin them.
#[test]
fn built_in_scenes_are_pinned() {
    let frame = |name: &str, samples| {
        let size = Scene::builtin(name).unwrap().size;
        golden::render_deferred(&deferred(name, size, samples)).checksum()
    };
    let eight = |shading| frame("textured", Samples::Eight(shading));
    let found = [
        frame("teapot", Samples::One),
        frame("textured", Samples::One),
        eight(Shading::EachSample),
        eight(Shading::OncePerPixel),
    ];
    assert_eq!(
        found.map(|sum| format!("{sum:016x}")),
        ["1aad50b680f4023f", "676def41a4565ed6", "c7c667eaba3bf804", "68e980e0c06ed698"]
    );
}
