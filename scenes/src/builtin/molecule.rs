//! The molecule: caffeine, C8H10N4O2, as balls and sticks, for machines that draw spheres.
//!
//! ```text
//!            O6     C7
//!            |      |          a regular hexagon and a regular pentagon with one side in common, and what is bound to them
//!  C1        C6     N7         straight away from their middles; three hydrogens at each of C1, C3 and C7 in the angles of
//!    `. N1 '    ` C5   `       a tetrahedron. The unit is 1 Angstrom.
//!       |         |      C8 - H8
//!       C2 .   . C4   .
//!    .'     ` N3    N9
//!  O2         |
//!             C3
//! ```
//!
//! Bond lengths are rounded means of their kind; the real rings are irregular by up to 0.07 Angstrom. Balls have 0.3 of
//! Bondi's van der Waals radii (1964), and the colours of Corey, Pauling and Koltun.

use crate::angle::sin_cos;
use crate::light::{Light, Lighting};
use crate::mesh::{Mesh, MeshTriangle};
use crate::sphere::Sphere;
use glam::{DVec2, DVec3, dvec2, dvec3};

/// The sides of both rings.
const RING: f64 = 1.38;
/// The bond from nitrogen to the carbon of a methyl group.
const METHYL: f64 = 1.46;
/// The double bond of carbon and oxygen.
const CARBONYL: f64 = 1.22;
/// The bond of carbon and hydrogen.
const HYDROGEN: f64 = 1.09;
/// A ball's radius as a part of the van der Waals radius.
const BALL: f64 = 0.3;
/// The radius of a stick, and the number of faces round it.
const STICK: f64 = 0.13;
const FACES: u32 = 12;

#[derive(Clone, Copy)]
enum Element {
    H,
    C,
    N,
    O,
}

impl Element {
    fn radius(self) -> f64 {
        let van_der_waals = match self {
            Element::H => 1.20,
            Element::C => 1.70,
            Element::N => 1.55,
            Element::O => 1.52,
        };
        BALL * van_der_waals
    }

    fn colour(self) -> [u8; 3] {
        match self {
            Element::H => [255, 255, 255],
            Element::C => [120, 126, 138],
            Element::N => [64, 108, 255],
            Element::O => [255, 56, 44],
        }
    }
}

/// A molecule under construction.
#[derive(Default)]
struct Molecule {
    atoms: Vec<(Element, DVec3)>,
    bonds: Vec<[usize; 2]>,
}

impl Molecule {
    /// Adds an atom; returns its number.
    fn atom(&mut self, element: Element, at: DVec3) -> usize {
        self.atoms.push((element, at));
        self.atoms.len() - 1
    }

    /// Adds an atom at a distance from another, in a direction of length 1; returns its number.
    fn bound(&mut self, to: usize, element: Element, direction: DVec3, length: f64) -> usize {
        let atom = self.atom(element, self.atoms[to].1 + direction * length);
        self.bonds.push([to, atom]);
        atom
    }

    /// Adds a methyl group.
    fn methyl(&mut self, to: usize, direction: DVec3) {
        let carbon = self.bound(to, Element::C, direction, METHYL);
        let (beside, up) = (DVec3::Z.cross(direction), DVec3::Z);
        for azimuth in [0.0, 120.0, 240.0] {
            let (s, c) = sin_cos(azimuth);
            // The angles of a tetrahedron have the cosine -1/3.
            let away = direction / 3.0 + (beside * c + up * s) * (8f64.sqrt() / 3.0);
            self.bound(carbon, Element::H, away, HYDROGEN);
        }
    }

    fn caffeine() -> Molecule {
        use Element::{C, H, N, O};
        let mut molecule = Molecule::default();
        let at = |middle: DVec2, radius: f64, degrees: f64| (middle + towards(degrees) * radius).extend(0.0);
        // The middle of the pentagon is beyond the side from C4 to C5.
        let (sine, _) = sin_cos(36.0);
        let pentagon = RING / (2.0 * sine);
        let (height, _) = sin_cos(60.0);
        let middle = dvec2(RING * height + pentagon * sin_cos(54.0).0, 0.0);
        let hexagon = [(N, 150.0), (C, 210.0), (N, 270.0), (C, 330.0), (C, 30.0), (C, 90.0)];
        let [n1, c2, n3, c4, c5, c6] =
            hexagon.map(|(element, degrees)| molecule.atom(element, at(DVec2::ZERO, RING, degrees)));
        let rest = [(N, 288.0), (C, 0.0), (N, 72.0)];
        let [n9, c8, n7] = rest.map(|(element, degrees)| molecule.atom(element, at(middle, pentagon, degrees)));
        molecule.bonds =
            vec![[n1, c2], [c2, n3], [n3, c4], [c4, c5], [c5, c6], [c6, n1], [c4, n9], [n9, c8], [c8, n7], [n7, c5]];
        let outward = |degrees: f64| towards(degrees).extend(0.0);
        molecule.bound(c2, O, outward(210.0), CARBONYL);
        molecule.bound(c6, O, outward(90.0), CARBONYL);
        molecule.bound(c8, H, outward(0.0), HYDROGEN);
        molecule.methyl(n1, outward(150.0));
        molecule.methyl(n3, outward(270.0));
        molecule.methyl(n7, outward(72.0));
        molecule
    }

    /// The sticks: each half in the colour of its atom.
    fn sticks(&self) -> Mesh {
        let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for &[from, to] in &self.bonds {
            let [(_, p), (_, q)] = [from, to].map(|atom| self.atoms[atom]);
            let along = (q - p).normalize();
            // No bond is upright.
            let beside = along.cross(DVec3::Z).normalize();
            let up = along.cross(beside);
            let (ring, first) = (normals.len() as u32, positions.len() as u32);
            for face in 0..FACES {
                let (s, c) = sin_cos(360.0 * f64::from(face) / f64::from(FACES));
                let normal = beside * c + up * s;
                normals.push(normal);
                positions.extend([p, (p + q) / 2.0, q].map(|end| end + normal * STICK));
            }
            for (half, atom) in [(0, from), (1, to)] {
                let diffuse = self.atoms[atom].0.colour().map(|channel| f64::from(channel) / 255.0);
                for face in 0..FACES {
                    let next = (face + 1) % FACES;
                    let corner = |face: u32, end: u32| (first + 3 * face + half + end, ring + face);
                    let corners = [corner(face, 0), corner(next, 0), corner(next, 1), corner(face, 1)];
                    for [i, j, k] in [[0, 1, 2], [0, 2, 3]] {
                        let [i, j, k] = [corners[i], corners[j], corners[k]];
                        triangles.push(MeshTriangle { positions: [i.0, j.0, k.0], normals: [i.1, j.1, k.1], diffuse });
                    }
                }
            }
        }
        Mesh::new(positions, normals, triangles).expect("the built-in data is sound")
    }
}

fn towards(degrees: f64) -> DVec2 {
    let (s, c) = sin_cos(degrees);
    dvec2(c, s)
}

/// 24 atoms.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::molecule::spheres().len(), 8 + 10 + 4 + 2);
/// ```
pub fn spheres() -> Vec<Sphere> {
    let ball =
        |&(element, centre): &(Element, DVec3)| Sphere { centre, radius: element.radius(), colour: element.colour() };
    Molecule::caffeine().atoms.iter().map(ball).collect()
}

/// 25 bonds of 48 triangles each, whose ends are in the balls.
///
/// ```
/// assert_eq!(tilewright_scenes::builtin::molecule::mesh().triangles().len(), 25 * 48);
/// ```
pub fn mesh() -> Mesh {
    Molecule::caffeine().sticks()
}

/// A key light from above the eye's left shoulder, a fill from the right, and one from behind.
pub(super) fn lighting() -> Lighting {
    let light = |toward: DVec3, intensity: f64| Light { toward, intensity };
    Lighting { ambient: 0.13, lights: vec![light(dvec3(-1.2, 0.1, 1.3), 0.86), light(dvec3(0.9, -0.7, 0.5), 0.08)] }
}

/// The position of its middle.
pub(super) const MIDDLE: DVec3 = dvec3(0.7, -0.25, 0.0);
