//! Faces of more than three corners: cut into triangles that cover each point of the face once and nothing else.

use crate::load::{folder, load};
use glam::{DVec3, dvec3};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use tilewright_scenes::Scene;

/// A plane in space: its axes and its origin. The last one is tilted; its axes have length 15.
const PLANES: [[DVec3; 3]; 4] = [
    [DVec3::X, DVec3::Y, DVec3::ZERO],
    [DVec3::Y, DVec3::Z, DVec3::ONE],
    [DVec3::Z, DVec3::X, DVec3::NEG_ONE],
    [dvec3(10.0, -5.0, 10.0), dvec3(11.0, 2.0, -10.0), dvec3(1.0, 2.0, 3.0)],
];

type Outline = Vec<[f64; 2]>;

/// A mesh file with that outline as its one face.
fn one_face(file: &Path, outline: &[[f64; 2]], [u, v, origin]: [DVec3; 3]) -> Scene {
    let place = |&[x, y]: &[f64; 2]| origin + u * x + v * y;
    let lines: String = outline.iter().map(place).map(|p| format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z)).collect();
    let corners: String = (1..=outline.len()).map(|i| format!(" {i}")).collect();
    fs::write(file, format!("{lines}f{corners}\n")).unwrap();
    load(file).unwrap()
}

/// How many triangles of the mesh the point of the plane is in.
fn times_covered(scene: &Scene, point: [f64; 2], [u, v, origin]: [DVec3; 3]) -> usize {
    let point = origin + u * point[0] + v * point[1];
    let inside = |corners: [DVec3; 3]| {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        (0..3).all(|i| (corners[(i + 1) % 3] - corners[i]).cross(point - corners[i]).dot(normal) > 0.0)
    };
    let triangles = scene.mesh.triangles().iter();
    triangles.filter(|t| inside(t.positions.map(|i| scene.mesh.positions()[i as usize]))).count()
}

/// Whether a ray from the point to the right crosses the outline an odd number of times.
fn is_inside(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    edges.filter(|([px, py], [qx, qy])| (*py > y) != (*qy > y) && x < px + (y - py) / (qy - py) * (qx - px)).count() % 2
        == 1
}

/// Twice the area of the outline, positive if it runs counter-clockwise.
fn area2(outline: &[[f64; 2]]) -> f64 {
    outline.iter().zip(outline.iter().cycle().skip(1)).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum()
}

/// The sum of the triangles' doubled areas as a vector, and the sum of its lengths.
fn areas(scene: &Scene) -> (DVec3, f64) {
    let doubled = scene.mesh.triangles().iter().map(|t| {
        let [p, q, r] = t.positions.map(|i| scene.mesh.positions()[i as usize]);
        (q - p).cross(r - p)
    });
    doubled.fold((DVec3::ZERO, 0.0), |(sum, lengths), area| (sum + area, lengths + area.length()))
}

/// The outline rotated to begin at each of its corners, in both directions.
fn all_ways_round(outline: &[[f64; 2]]) -> Vec<Outline> {
    let starts = (0..outline.len()).map(|start| [&outline[start..], &outline[..start]].concat());
    starts.flat_map(|way| [way.clone(), way.into_iter().rev().collect()]).collect()
}

#[test]
fn the_notch_of_an_l_stays_empty() {
    let folder = folder("notch", &[]);
    let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    for plane in PLANES {
        for way in all_ways_round(&l) {
            let scene = one_face(&folder.join("l.obj"), &way, plane);
            assert_eq!(scene.warnings, [""; 0]);
            assert_eq!(scene.mesh.triangles().len(), 4);
            for (i, j) in (0..9).map(|cell| (cell % 3, cell / 3)) {
                // Not on a diagonal, where the triangles may meet.
                let point = [f64::from(i) + 0.45, f64::from(j) + 0.3];
                let expected = usize::from(i == 0 || j == 0);
                assert_eq!(times_covered(&scene, point, plane), expected, "{point:?} of {way:?} in {plane:?}");
            }
            let (sum, _) = areas(&scene);
            let turned = plane[0].cross(plane[1]) * area2(&way);
            assert!(sum.dot(turned) > 0.0, "the triangles run round as the face does");
        }
    }
}

#[test]
fn a_convex_face_is_a_fan_from_its_first_corner() {
    let folder = folder("fan", &[]);
    let hexagon = [[2.0, 0.0], [4.0, 1.0], [4.0, 3.0], [2.0, 4.0], [0.0, 3.0], [0.0, 1.0]];
    let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
    let repeated = [[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
    for outline in [hexagon, straight, repeated] {
        for plane in PLANES {
            for way in all_ways_round(&outline) {
                let scene = one_face(&folder.join("convex.obj"), &way, plane);
                assert_eq!(scene.warnings, [""; 0]);
                let place = |[x, y]: [f64; 2]| plane[2] + plane[0] * x + plane[1] * y;
                let expected: Vec<_> = (2..6).map(|i| [way[0], way[i - 1], way[i]].map(place)).collect();
                let corners = scene.mesh.triangles().iter().map(|t| t.positions);
                let found: Vec<_> = corners.map(|c| c.map(|i| scene.mesh.positions()[i as usize])).collect();
                assert_eq!(found, expected);
            }
        }
    }
}

#[test]
fn corners_in_a_line_and_repeated_ones_do_not_spoil_a_concave_face() {
    let folder = folder("collinear", &[]);
    let l = [
        [0.0, 0.0],
        [1.5, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [3.0, 1.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 3.0],
        [0.0, 1.5],
    ];
    for plane in PLANES {
        for way in all_ways_round(&l) {
            let scene = one_face(&folder.join("l.obj"), &way, plane);
            assert_eq!(scene.warnings, [""; 0]);
            for (i, j) in (0..9).map(|cell| (cell % 3, cell / 3)) {
                let point = [f64::from(i) + 0.45, f64::from(j) + 0.31];
                let expected = usize::from(i == 0 || j == 0);
                assert_eq!(times_covered(&scene, point, plane), expected, "{point:?} of {way:?}");
            }
        }
    }
}

#[test]
fn normals_stay_with_their_corners() {
    let folder = folder("corner_normals", &[]);
    let path = folder.join("mesh.obj");
    let corners = ["0 0", "3 0", "3 1", "1 1", "1 3", "0 3"];
    let lines: String = corners.iter().map(|xy| format!("v {xy} 0\nvn {xy} 9\n")).collect();
    fs::write(&path, format!("{lines}f 2//2 3//3 4//4 5//5 6//6 1//1\n")).unwrap();
    let scene = load(&path).unwrap();
    assert_eq!(scene.mesh.triangles().len(), 4);
    for t in scene.mesh.triangles() {
        for (position, normal) in t.positions.iter().zip(t.normals) {
            let (p, n) = (scene.mesh.positions()[*position as usize], scene.mesh.normals()[normal as usize]);
            assert_eq!(n, dvec3(p.x, p.y, 9.0));
        }
    }
}

#[test]
fn a_face_that_crosses_itself_is_a_warning() {
    let bow_tie = "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\n";
    let uneven = "v 0 0 0\nv 4 4 0\nv 4 1 0\nv 0 4 0\n";
    let tiny = "v 0 0 0\nv 4e-4 4e-4 0\nv 4e-4 1e-4 0\nv 0 4e-4 0\n";
    let folder = folder("crossing", &[]);
    let path = folder.join("mesh.obj");
    for (vertices, faces, sentence) in [
        (bow_tie, "f 1 2 3 4\n", "5: this face crosses itself, so it is drawn roughly"),
        (uneven, "f 1 2 3 4\n", "5: this face crosses itself, so it is drawn roughly"),
        (tiny, "f 1 2 3 4\n", "5: this face crosses itself, so it is drawn roughly"),
        (
            uneven,
            "f 1 2 3\nf 1 2 3 4\nf 2 3 4 1\n",
            "6: this face and 1 more cross themselves, so they are drawn roughly",
        ),
    ] {
        fs::write(&path, format!("{vertices}{faces}")).unwrap();
        let expected = format!("{}:{sentence}: cut it where its edges meet", path.display());
        assert_eq!(load(&path).unwrap().warnings, [expected]);
    }
}

#[test]
fn a_face_of_one_point_does_not_cross_itself() {
    let folder = folder("point", &[("mesh.obj", "v 0 0 0\nv 4 4 0\nv 4 0 0\nf 1 2 3\nf 1 1 1 1\n")]);
    assert_eq!(load(&folder.join("mesh.obj")).unwrap().warnings, [""; 0]);
}

/// An outline round (0, 0) without crossings: corners at growing angles, as far out as they like.
fn star() -> impl Strategy<Value = Outline> {
    proptest::collection::vec((0.3..1.0f64, 0.1..1.0f64), 3..40).prop_map(|steps| {
        let whole: f64 = steps.iter().map(|step| step.0).sum();
        let mut angle = 0.0;
        let mut corner = |(step, radius): (f64, f64)| {
            angle += step / whole * TAU;
            [radius * angle.cos(), radius * angle.sin()]
        };
        steps.into_iter().map(&mut corner).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    #[test]
    fn any_face_is_covered_once(
        outline in star(), plane in proptest::sample::select(PLANES.to_vec()), turned in any::<bool>(),
        points in proptest::collection::vec([-1.0..1.0f64, -1.0..1.0f64], 40),
    ) {
        let folder = folder("any_face", &[]);
        let way: Outline = if turned { outline.iter().rev().copied().collect() } else { outline.clone() };
        let scene = one_face(&folder.join("mesh.obj"), &way, plane);
        prop_assert_eq!(&scene.warnings, &[""; 0]);
        for point in points {
            prop_assert_eq!(times_covered(&scene, point, plane), usize::from(is_inside(&outline, point)), "{:?}", point);
        }
        let (sum, lengths) = areas(&scene);
        prop_assert!((lengths - sum.length()).abs() < 1e-9 * lengths, "no triangle is turned over");
        let expected = area2(&way) * plane[0].cross(plane[1]);
        prop_assert!((sum - expected).length() < 1e-9 * lengths);
    }
}
