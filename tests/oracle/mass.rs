//! Mass properties against exact rational arithmetic, independent formulas, and parry.

use bryla::mass::MassProperties;
use bryla::math::{Matrix3, Quaternion, Vector3, quaternion};
use bryla::shape::{Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, Piece, Polyhedron, Shape, Sphere};
use dashu::rational::RBig;

use crate::parry;

const E: f64 = f64::EPSILON;

// ---------------------------------------------------------------- solids to measure

/// Repeatable random numbers (Steele, Lea and Flood 2014: `SplitMix64`).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn vector(&mut self) -> Vector3 {
        Vector3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0))
    }

    fn rotation(&mut self) -> Quaternion {
        quaternion::exp(&(self.vector() * 3.0))
    }
}

/// A ball-like solid: rings of latitude between two poles, its surface at `surface(direction)`.
fn globe(rings: usize, sectors: usize, mut surface: impl FnMut(Vector3) -> Vector3) -> Polyhedron {
    use std::f64::consts::PI;
    let mut vertices = vec![surface(Vector3::z())];
    for i in 1..rings {
        let (s, c) = libm::sincos(PI * i as f64 / rings as f64);
        for j in 0..sectors {
            let (sj, cj) = libm::sincos(2.0 * PI * j as f64 / sectors as f64);
            vertices.push(surface(Vector3::new(s * cj, s * sj, c)));
        }
    }
    vertices.push(surface(-Vector3::z()));

    let at = |i: usize, j: usize| 1 + (i - 1) * sectors + j % sectors;
    let last = vertices.len() - 1;
    let mut faces = Vec::new();
    for j in 0..sectors {
        faces.push(vec![0, at(1, j), at(1, j + 1)]);
        for i in 1..rings - 1 {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push(vec![at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        faces.push(vec![at(rings - 1, j), last, at(rings - 1, j + 1)]);
    }
    Polyhedron::new(vertices.into_iter().map(Into::into).collect::<Vec<_>>(), faces)
}

/// A polygon of the xy plane, counterclockwise, made solid from `low` to `high` along z.
fn prism(outline: &[[f64; 2]], low: f64, high: f64) -> Polyhedron {
    let n = outline.len();
    let vertices: Vec<_> = [low, high].iter().flat_map(|&z| outline.iter().map(move |p| [p[0], p[1], z])).collect();
    let sides = (0..n).map(|k| vec![k, (k + 1) % n, n + (k + 1) % n, n + k]);
    let faces: Vec<_> = [(0..n).rev().collect(), (n..2 * n).collect()].into_iter().chain(sides).collect();
    Polyhedron::new(vertices, faces)
}

/// An L and a U, whose caps are not convex.
const L: [[f64; 2]; 6] = [[0.0, 0.0], [3.0, 0.0], [3.0, 0.7], [1.1, 0.7], [1.1, 2.3], [0.0, 2.3]];
const U: [[f64; 2]; 8] =
    [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.2, 2.0], [2.2, 0.6], [0.9, 0.6], [0.9, 1.7], [0.0, 1.7]];

fn box_of(half_extents: [f64; 3]) -> Polyhedron {
    let [a, b, c] = half_extents;
    prism(&[[-a, -b], [a, -b], [a, b], [-a, b]], -c, c)
}

fn changed(solid: &Polyhedron, map: impl Fn(Vector3) -> Vector3) -> Polyhedron {
    let vertices: Vec<[f64; 3]> = solid.vertices.iter().map(|&v| map(v.into()).into()).collect();
    Polyhedron::new(vertices, solid.faces.clone())
}

/// The same surface with each face cut into the triangles from its first vertex.
fn triangulated(solid: &Polyhedron) -> Polyhedron {
    let cut = |face: &Vec<usize>| -> Vec<Vec<usize>> {
        face[1..].windows(2).map(|edge| vec![face[0], edge[0], edge[1]]).collect()
    };
    Polyhedron::new(solid.vertices.clone(), solid.faces.iter().flat_map(cut).collect::<Vec<_>>())
}

/// Random solids: tetrahedra, star-shaped globes of up to 224 faces, prisms of concave outlines, plates
/// and needles; all slanted.
fn random_solids() -> Vec<(String, Polyhedron)> {
    let mut random = Random(1);
    let mut all = Vec::new();
    for k in 0..12 {
        let corners = [random.vector(), random.vector(), random.vector(), random.vector()].map(<[f64; 3]>::from);
        let [a, b, c, d] = corners.map(Vector3::from);
        let faces = if (b - a).dot(&(c - a).cross(&(d - a))) > 0.0 {
            [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
        } else {
            [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]
        };
        all.push((format!("tetrahedron {k}"), Polyhedron::new(corners, faces.map(Vec::from))));

        let (rings, sectors) = (3 + k % 6, 4 + k);
        let spiky = globe(rings, sectors, |n| n * random.within(0.3, 1.0));
        all.push((format!("globe {k}"), spiky));
    }
    for k in 0..6 {
        let turn = random.rotation();
        let (low, high) = (random.within(-2.0, 0.0), random.within(0.1, 2.0));
        for (name, solid) in [("L", prism(&L, low, high)), ("U", prism(&U, low, high))] {
            let slanted = changed(&triangulated(&solid), |v| quaternion::rotate(&turn, &v));
            all.push((format!("{name} {k}"), slanted));
        }
        for (name, extents) in
            [("plate 1e-6", [1.0, 0.7, 1e-6]), ("plate 1e-12", [1.0, 0.7, 1e-12]), ("needle 1e-6", [1e-6, 1.3e-6, 1.0])]
        {
            let slanted = changed(&triangulated(&box_of(extents)), |v| quaternion::rotate(&turn, &v));
            all.push((format!("{name} {k}"), slanted));
        }
    }
    all
}

// ---------------------------------------------------------------- the exact truth

/// Exact integrals over a polyhedron of triangles at density 1, and what follows from them.
struct Exact {
    mass: RBig,
    center: [RBig; 3],
    inertia: [[RBig; 3]; 3],
}

/// By another route than bryla's: each volume integral is a surface integral of one power more,
/// `∫ xᵢ f dV = ∮ F nᵢ dA` with `∂F/∂xᵢ = xᵢ f`, and over a triangle the mean of a product of three linear
/// functions is a sum over its corners.
fn exact(solid: &Polyhedron) -> Exact {
    let r = |x: f64| RBig::try_from(x).expect("a finite number");
    let vertices: Vec<[RBig; 3]> = solid.vertices.iter().map(|v| v.map(r)).collect();
    let ones = [RBig::ONE, RBig::ONE, RBig::ONE];
    let n = |k: u32| RBig::from(k);

    let mut volume = RBig::ZERO;
    let mut first = [RBig::ZERO, RBig::ZERO, RBig::ZERO];
    let mut second = [first.clone(), first.clone(), first.clone()];
    for face in &solid.faces {
        assert_eq!(face.len(), 3);
        let p = [0, 1, 2].map(|k| &vertices[face[k]]);
        let along = |i: usize| [0, 1, 2].map(|k| p[k][i].clone());
        for i in 0..3 {
            // component i of twice the area vector, and the coordinates of the corners, cyclic
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let side = |a: usize, c: usize| &p[a][c] - &p[0][c];
            let area = side(1, j) * side(2, k) - side(1, k) * side(2, j);
            let (x, y) = (along(i), along(j));
            if i == 0 {
                volume += &area * mean(&x, &ones, &ones) / n(2);
            }
            first[i] += &area * mean(&x, &x, &ones) / n(4);
            second[i][i] += &area * mean(&x, &x, &x) / n(6);
            second[i][j] += &area * mean(&x, &x, &y) / n(4);
        }
    }

    let center = first.map(|x| x / &volume);
    for i in 0..3 {
        for j in [i, (i + 1) % 3] {
            second[i][j] -= &volume * &center[i] * &center[j];
        }
    }
    let entry = |i: usize, j: usize| match (3 + j - i) % 3 {
        0 => &second[(i + 1) % 3][(i + 1) % 3] + &second[(i + 2) % 3][(i + 2) % 3],
        1 => -second[i][j].clone(),
        _ => -second[j][i].clone(),
    };
    let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
    Exact { mass: volume, center, inertia }
}

/// Mean over a triangle of the product of three linear functions, from their values in its corners.
fn mean(u: &[RBig; 3], v: &[RBig; 3], w: &[RBig; 3]) -> RBig {
    let sum = |x: &[RBig; 3]| &x[0] + &x[1] + &x[2];
    let dot = |x: &[RBig; 3], y: &[RBig; 3]| &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2];
    let triple: RBig = (0..3).map(|k| &u[k] * &v[k] * &w[k]).fold(RBig::ZERO, |a, b| a + b);
    let (su, sv, sw) = (sum(u), sum(v), sum(w));
    (&su * &sv * &sw + &su * dot(v, w) + &sv * dot(u, w) + &sw * dot(u, v) + triple * RBig::from(2)) / RBig::from(60)
}

/// `|x − truth|`, the difference taken exactly.
fn error(x: f64, truth: &RBig) -> f64 {
    (RBig::try_from(x).expect("a finite number") - truth).to_f64().value().abs()
}

fn value(x: &RBig) -> f64 {
    x.to_f64().value()
}

/// Largest errors of mass (relative), centre of mass (of the coordinates' magnitude) and inertia (of its
/// largest entry).
fn errors(found: &MassProperties, truth: &Exact, solid: &Polyhedron) -> [f64; 3] {
    let magnitude = solid.vertices.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let largest = truth.inertia.iter().flatten().fold(0.0, |most: f64, x| most.max(value(x).abs()));
    let center = (0..3).map(|i| error(found.center_of_mass[i], &truth.center[i])).fold(0.0, f64::max);
    let inertia = (0..3)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .map(|(i, j)| error(found.inertia[(i, j)], &truth.inertia[i][j]))
        .fold(0.0, f64::max);
    [error(found.mass, &truth.mass) / value(&truth.mass), center / magnitude, inertia / largest]
}

// ---------------------------------------------------------------- polyhedra

#[test]
fn polyhedra_match_exact_rationals_at_any_offset() {
    let mut random = Random(2);
    let mut worst = [0.0f64; 3];
    for (name, solid) in random_solids() {
        for offset in [0.0, 1.0, 1e3, 1e6] {
            // thin solids keep no thickness in coordinates of another magnitude
            if offset > 0.0 && (name.starts_with("plate 1e-12") || offset == 1e6 && !name.starts_with("globe")) {
                continue;
            }
            let away = random.vector().normalize() * offset;
            let placed = changed(&solid, |v| v + away);
            let found = bryla::mass::polyhedron::mass_properties(&name, &placed.vertices, &placed.faces, 1.0).unwrap();
            let found_errors = errors(&found, &exact(&placed), &placed);
            // the last roundings: one of the centre, two of the mass, three of an entry
            for ((worst, found), allowed) in worst.iter_mut().zip(found_errors).zip([E, E, 2.0 * E]) {
                assert!(found <= allowed, "{name} at {offset:e}: {found:e}");
                *worst = worst.max(found);
            }
        }
    }
    println!("largest errors: mass {:.1e}, centre {:.1e}, inertia {:.1e}", worst[0], worst[1], worst[2]);
}

#[test]
fn every_entry_of_a_thin_solid_keeps_its_own_digits() {
    // along the axes, so that small moments stand in entries of their own
    for extents in [[1e-12, 1.0, 0.3], [1e-6, 2e-6, 1.0], [1e-12, 1e-12, 1.0]] {
        let solid = triangulated(&box_of(extents));
        let (found, truth) = (solid.mass_properties(1.0).unwrap(), exact(&solid));
        for i in 0..3 {
            assert!(error(found.inertia[(i, i)], &truth.inertia[i][i]) <= 4.0 * E * value(&truth.inertia[i][i]));
        }
    }
}

#[test]
fn the_size_of_a_polyhedron_does_not_matter() {
    let (_, solid) = &random_solids()[5];
    let one = solid.mass_properties(1.0).unwrap();
    for power in [-180, -60, 60, 180] {
        let k = libm::ldexp(1.0, power);
        let found = changed(solid, |v| v * k).mass_properties(1.0).unwrap();
        // powers of two change no digit
        assert_eq!(found.mass, one.mass * k * k * k);
        assert_eq!(found.center_of_mass, one.center_of_mass * k);
        assert_eq!(found.inertia, one.inertia * k * k * k * k * k);
    }
}

#[test]
fn faces_of_many_vertices_with_reflex_corners_are_their_triangles() {
    let mut random = Random(3);
    for _ in 0..20 {
        for outline in [&L[..], &U[..]] {
            let solid = prism(outline, random.within(-2.0, 0.0), random.within(0.1, 2.0));
            let whole = solid.mass_properties(2.0).unwrap();
            // a fan from the first vertex leaves an L or a U in places: cut caps into rectangles instead
            let cells: &[[f64; 4]] = if outline.len() == 6 {
                &[[0.0, 3.0, 0.0, 0.7], [0.0, 1.1, 0.7, 2.3]]
            } else {
                &[[0.0, 3.0, 0.0, 0.6], [2.2, 3.0, 0.6, 2.0], [0.0, 0.9, 0.6, 1.7]]
            };
            let (low, high) = (solid.vertices[0][2], solid.vertices[outline.len()][2]);
            let parts: Vec<_> = cells
                .iter()
                .map(|&[x0, x1, y0, y1]| {
                    let half = [0.5 * (x1 - x0), 0.5 * (y1 - y0), 0.5 * (high - low)];
                    let part = Cuboid::new(half).mass_properties(2.0).unwrap();
                    part.moved([0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.5 * (low + high)])
                })
                .collect();
            assert_close(&whole, &MassProperties::combined(&parts), 16.0 * E);

            // any first vertex
            let turned: Vec<Vec<usize>> = solid.faces.iter().map(|f| [&f[2..], &f[..2]].concat()).collect();
            let again = Polyhedron::new(solid.vertices.clone(), turned).mass_properties(2.0).unwrap();
            assert_close(&again, &whole, 2.0 * E);
        }
    }
}

/// Compares relative to mass, reach of the centre, and largest moment.
fn assert_close(a: &MassProperties, b: &MassProperties, tolerance: f64) {
    let reach = b.center_of_mass.norm() + (b.inertia.amax() / b.mass).sqrt();
    assert!((a.mass - b.mass).abs() <= tolerance * b.mass, "mass {} {}", a.mass, b.mass);
    let off = (a.center_of_mass - b.center_of_mass).amax() / reach;
    assert!(off <= tolerance, "centre {} {}", a.center_of_mass, b.center_of_mass);
    let off = (a.inertia - b.inertia).amax() / b.inertia.amax();
    assert!(off <= tolerance, "inertia off by {off:e}: {} {}", a.inertia, b.inertia);
}

// ---------------------------------------------------------------- closed forms

#[test]
fn a_cuboid_is_its_polyhedron() {
    let mut random = Random(4);
    for _ in 0..50 {
        let half = [random.within(0.01, 1.0), random.within(0.01, 1.0), random.within(0.01, 1.0)];
        let form = Cuboid::new(half).mass_properties(3.0).unwrap();
        assert_close(&form, &box_of(half).mass_properties(3.0).unwrap(), 4.0 * E);
    }
}

/// Slices across z, each an ellipse with the semi-axes `radii(z)`, summed by Gauss's rule of three points,
/// which is exact for the polynomials of degree 4 that these solids have.
fn from_slices(low: f64, high: f64, density: f64, radii: impl Fn(f64) -> (f64, f64)) -> MassProperties {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let (mut mass, mut first, mut about) = (0.0, 0.0, Vector3::zeros());
    for (node, weight) in [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)] {
        let z = middle + half * node;
        let (a, b) = radii(z);
        let slice = density * std::f64::consts::PI * a * b * half * weight;
        mass += slice;
        first += slice * z;
        about += slice * Vector3::new(b * b / 4.0 + z * z, a * a / 4.0 + z * z, (a * a + b * b) / 4.0);
    }
    let c = first / mass;
    let central = about - mass * c * c * Vector3::new(1.0, 1.0, 0.0);
    MassProperties { mass, center_of_mass: Vector3::new(0.0, 0.0, c), inertia: Matrix3::from_diagonal(&central) }
}

#[test]
fn round_solids_are_their_slices() {
    let mut random = Random(5);
    for _ in 0..50 {
        let (r, h, rho) = (random.within(0.1, 1.0), random.within(0.1, 1.0), random.within(0.5, 5.0));
        let ball = |z: f64| ((r - z) * (r + z)).sqrt();
        let found = Sphere::new(r).mass_properties(rho).unwrap();
        assert_close(&found, &from_slices(-r, r, rho, |z| (ball(z), ball(z))), 16.0 * E);

        let found = Cylinder::new(r, h).mass_properties(rho).unwrap();
        assert_close(&found, &from_slices(-h, h, rho, |_| (r, r)), 16.0 * E);

        let wide = |z: f64| r * (h - z) / (2.0 * h);
        let found = Cone::new(r, h).mass_properties(rho).unwrap();
        assert_close(&found, &from_slices(-h, h, rho, |z| (wide(z), wide(z))), 64.0 * E);

        let (a, b) = (random.within(0.1, 1.0), random.within(0.1, 1.0));
        let found = Ellipsoid::new([a, b, h]).mass_properties(rho).unwrap();
        let part = |z: f64| ((h - z) * (h + z)).sqrt() / h;
        assert_close(&found, &from_slices(-h, h, rho, |z| (a * part(z), b * part(z))), 16.0 * E);
    }
}

#[test]
fn a_capsule_has_half_spheres_whose_centers_lie_outside_the_cylinder_ends() {
    let mut random = Random(6);
    for _ in 0..50 {
        let (r, h, rho) = (random.within(0.1, 1.0), random.within(0.0, 1.0), random.within(0.5, 5.0));
        let cap = |from: f64| move |z: f64| ((r - (z - from)) * (r + (z - from))).sqrt();
        let top = from_slices(h, h + r, rho, |z| (cap(h)(z), cap(h)(z)));
        let bottom = from_slices(-h - r, -h, rho, |z| (cap(-h)(z), cap(-h)(z)));
        let middle = from_slices(-h, h, rho, |_| (r, r));
        assert!((top.center_of_mass.z - h - 0.375 * r).abs() < 8.0 * E);
        let found = Capsule::new(r, h).mass_properties(rho).unwrap();
        assert_close(&found, &MassProperties::combined(&[top, middle, bottom]), 32.0 * E);
    }
    // without a cylinder it is a ball
    let (capsule, ball) = (Capsule::new(0.7, 0.0).mass_properties(2.0), Sphere::new(0.7).mass_properties(2.0));
    assert_eq!(capsule.unwrap(), ball.unwrap());
}

#[test]
fn round_solids_are_the_limit_of_their_facets() {
    type Surface = fn(Vector3) -> Vector3;
    let cases: [(Shape, Surface); 2] = [
        (Ellipsoid::new([0.5, 0.8, 1.1]).into(), |n| n.component_mul(&Vector3::new(0.5, 0.8, 1.1))),
        (Sphere::new(0.6).into(), |n| 0.6 * n),
    ];
    for (shape, surface) in cases {
        let truth = shape.mass_properties(1.5).unwrap();
        let of = |n: usize| globe(n, 2 * n, surface).mass_properties(1.5).unwrap();
        let (coarse, fine) = (of(32), of(64));

        // facets err by h²; two grids cancel that, and h⁴ is left: (π/32)⁴ = 9e-5, of which 1/16 remains
        let ratio = (truth.mass - coarse.mass) / (truth.mass - fine.mass);
        assert!((ratio - 4.0).abs() < 0.02, "{}: ratio of errors {ratio}", shape.name());
        assert!(((4.0 * fine.mass - coarse.mass) / 3.0 / truth.mass - 1.0).abs() < 6e-6, "{}", shape.name());
        let inertia = (4.0 * fine.inertia - coarse.inertia) / 3.0;
        assert!((inertia - truth.inertia).amax() < 1.2e-5 * truth.inertia.amax(), "{} {inertia}", shape.name());
    }
}

// ---------------------------------------------------------------- mistakes that engines have shipped

/// An L made of two boxes, whose centre of mass and products of inertia are easy by hand.
fn angle_iron() -> Polyhedron {
    prism(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]], 0.0, 2.0)
}

#[test]
fn off_diagonal_entries_carry_the_minus_of_lecture_21() {
    // boxes 4×1×2 and 1×2×2 of density 1: masses 8 and 4, centres (2, ½, 1) and (½, 2, 1)
    let found = angle_iron().mass_properties(1.0).unwrap();
    assert!((found.mass - 12.0).abs() < 1e-14);
    assert!((found.center_of_mass - Vector3::new(1.5, 1.0, 1.0)).amax() < 1e-15);
    // ∫xy dm = 8 (½)(−½) + 4 (−1)(1) = −6, so I₁₂ = +6: the legs lie in the quadrants of unlike signs
    assert!((found.inertia[(0, 1)] - 6.0).abs() < 1e-14);
    // the axis of least moment runs from leg to leg, also through those quadrants
    let axis = found.principal_axes().column(0).into_owned();
    assert!(axis.x * axis.y < -0.1, "{axis}");
}

#[test]
fn products_of_inertia_stand_in_their_own_places() {
    // three cuts of a cube's edges, each of another depth, make all three products differ
    let found = Compound::new([
        Piece::new(Sphere::new(0.1)).position([1.0, 2.0, 0.0]),
        Piece::new(Sphere::new(0.1)).position([-1.0, -2.0, 0.0]),
        Piece::new(Sphere::new(0.1)).position([3.0, 0.0, 5.0]),
        Piece::new(Sphere::new(0.1)).position([-3.0, 0.0, -5.0]),
        Piece::new(Sphere::new(0.1)).position([0.0, 7.0, 11.0]),
        Piece::new(Sphere::new(0.1)).position([0.0, -7.0, -11.0]),
    ]);
    let (found, m) = (found.mass_properties(1.0).unwrap(), Sphere::new(0.1).mass_properties(1.0).unwrap().mass);
    for ((i, j), product) in [((0, 1), 2.0), ((0, 2), 15.0), ((1, 2), 77.0)] {
        assert!((found.inertia[(i, j)] + 2.0 * m * product).abs() < 1e-13 * m * 77.0);
        assert_eq!(found.inertia[(i, j)], found.inertia[(j, i)]);
    }

    // and of a polyhedron: the corner tetrahedron of edges a, b, c has ∫xy dV = a²b²c/120
    let [a, b, c] = [1.0, 2.0, 3.0];
    let corner = Polyhedron::new(
        [[0.0; 3], [a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]],
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(Vec::from),
    );
    let about_origin = corner.mass_properties(1.0).unwrap().about([0.0; 3]);
    for ((i, j), product) in [((0, 1), a * a * b * b * c), ((0, 2), a * a * b * c * c), ((1, 2), a * b * b * c * c)] {
        assert!((about_origin[(i, j)] + product / 120.0).abs() < 1e-15);
    }
}

#[test]
fn parallel_axes_there_and_back_return_the_original() {
    let mut random = Random(7);
    for (name, solid) in random_solids().iter().filter(|(name, _)| name.starts_with("globe")) {
        let body = solid.mass_properties(1.0).unwrap();
        let point = random.vector() * 3.0;
        let there = body.about(point);
        assert!(there.trace() > body.inertia.trace(), "{name}: moving away from the centre must add");
        let back = MassProperties::from_inertia_about(name, point, body.mass, body.center_of_mass, there).unwrap();
        let lost = 4.0 * E * there.amax();
        assert!((back.inertia - body.inertia).amax() <= lost, "{name}");
        assert_eq!(body.about(body.center_of_mass), body.inertia);
    }
}

#[test]
fn the_tensor_is_about_the_center_of_mass_not_the_origin() {
    let away = changed(&box_of([1.0, 2.0, 3.0]), |v| v + Vector3::new(10.0, 20.0, 30.0));
    let found = away.mass_properties(1.0).unwrap();
    let centred = Cuboid::new([1.0, 2.0, 3.0]).mass_properties(1.0).unwrap();
    assert!((found.inertia - centred.inertia).amax() <= 4.0 * E * centred.inertia.amax());
    assert!((found.center_of_mass - Vector3::new(10.0, 20.0, 30.0)).amax() <= 30.0 * E);
    // a tensor about the origin taken for one about the centre is too large, and the converse is refused
    let wrong = MassProperties::from_inertia_about("box", [0.0; 3], found.mass, found.center_of_mass, found.inertia);
    assert!(wrong.unwrap_err().to_string().starts_with("box: inertia must be positive definite"));
}

#[test]
fn density_scales_mass_and_inertia_and_nothing_else() {
    let solids: [Shape; 8] = [
        Cuboid::new([0.1, 0.2, 0.3]).into(),
        Sphere::new(0.3).into(),
        Cylinder::new(0.3, 0.2).into(),
        Capsule::new(0.3, 0.2).into(),
        Cone::new(0.3, 0.2).into(),
        Ellipsoid::new([0.1, 0.2, 0.3]).into(),
        angle_iron().into(),
        Compound::new([Piece::new(Cone::new(0.3, 0.2)).position([1.0, 0.0, 0.0]), Piece::new(Sphere::new(0.3))]).into(),
    ];
    for shape in solids {
        let (one, many) = (shape.mass_properties(1.0).unwrap(), shape.mass_properties(7800.0).unwrap());
        assert!((many.mass / 7800.0 - one.mass).abs() <= 4.0 * E * one.mass);
        assert!((many.center_of_mass - one.center_of_mass).amax() <= 4.0 * E * one.center_of_mass.amax());
        assert!((many.inertia / 7800.0 - one.inertia).amax() <= 8.0 * E * one.inertia.amax(), "{}", shape.name());
    }
}

#[test]
fn a_cone_balances_a_quarter_of_its_height_above_the_base() {
    let (r, h) = (0.5, 2.0);
    let cone = Cone::new(r, h).mass_properties(1.0).unwrap();
    assert_eq!(cone.center_of_mass, Vector3::new(0.0, 0.0, -h + 2.0 * h / 4.0));
    // about the apex, from any textbook: ⅗ m (r²/4 + H²), H the height
    let about_apex = cone.about([0.0, 0.0, h])[(0, 0)];
    assert!((about_apex - 0.6 * cone.mass * (r * r / 4.0 + 16.0)).abs() < 8.0 * E * about_apex);
}

// ---------------------------------------------------------------- invariances

#[test]
fn turning_and_moving_a_solid_turns_and_moves_its_numbers() {
    let mut random = Random(8);
    for (name, solid) in random_solids().iter().filter(|(name, _)| !name.contains("1e-")) {
        let (turn, step) = (random.rotation(), random.vector());
        let found = changed(solid, |v| quaternion::rotate(&turn, &v) + step).mass_properties(2.0).unwrap();
        let expected = solid.mass_properties(2.0).unwrap().turned(&turn).moved(step);
        // vertices are rounded to ε/2 of 1, and tetrahedra may be some 30 times thinner than long
        assert_close(&found, &expected, if name.starts_with("tetra") { 500.0 * E } else { 64.0 * E });
        // and the principal moments stay
        let off = found.principal_moments() - solid.mass_properties(2.0).unwrap().principal_moments();
        assert!(off.amax() <= 500.0 * E * found.inertia.amax(), "{name}");
    }
}

#[test]
fn a_solid_cut_in_two_and_joined_is_the_whole() {
    let mut random = Random(9);
    for _ in 0..50 {
        let [a, b, c] = [random.within(0.1, 1.0), random.within(0.1, 1.0), random.within(0.1, 1.0)];
        let cut = random.within(-0.9, 0.9) * a;
        let (turn, step) = (random.rotation(), random.vector() * 1e3);
        let place = |p: MassProperties| p.turned(&turn).moved(step);
        let part = |x0: f64, x1: f64| {
            let own = Cuboid::new([0.5 * (x1 - x0), b, c]).mass_properties(2.0).unwrap();
            place(own.moved([0.5 * (x0 + x1), 0.0, 0.0]))
        };
        let whole = place(Cuboid::new([a, b, c]).mass_properties(2.0).unwrap());
        let joined = MassProperties::combined(&[part(-a, cut), part(cut, a)]);
        // centres 1e3 away are rounded to 1e-13, which enters m d² by 2 d 1e-13
        assert!((joined.mass - whole.mass).abs() <= 4.0 * E * whole.mass);
        assert!((joined.center_of_mass - whole.center_of_mass).amax() <= E * 2e3);
        assert!(
            (joined.inertia - whole.inertia).amax() <= 4.0 * E * 2e3 * whole.mass * a + 8.0 * E * whole.inertia.amax()
        );
    }
    let nothing = MassProperties::combined(&[]);
    assert_eq!(nothing, MassProperties { mass: 0.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::zeros() });
}

#[test]
fn inertia_grows_with_the_fifth_power_of_size() {
    for k in [0.1, 3.0, 1e3] {
        let (one, large) = (angle_iron(), changed(&angle_iron(), |v| v * k));
        let (one, large) = (one.mass_properties(1.0).unwrap(), large.mass_properties(1.0).unwrap());
        assert!((large.mass / (k * k * k) - one.mass).abs() < 16.0 * E * one.mass);
        assert!((large.inertia / (k * k * k * k * k) - one.inertia).amax() < 16.0 * E * one.inertia.amax());
    }
}

#[test]
fn a_compound_is_its_pieces_placed() {
    // two boxes turned and moved, against the polyhedron of both
    let mut random = Random(10);
    for _ in 0..20 {
        let mut all = Polyhedron::new([], []);
        let mut pieces = Vec::new();
        for k in 0..3 {
            let half = [random.within(0.1, 1.0), random.within(0.1, 1.0), random.within(0.1, 1.0)];
            let (turn, position) = (random.rotation(), random.vector() + Vector3::x() * 5.0 * f64::from(k));
            let q = quaternion::to_scalar_first(&turn);
            pieces.push(Piece::new(Cuboid::new(half)).position(position).orientation(q));
            let solid = changed(&box_of(half), |v| quaternion::rotate(&turn, &v) + position);
            let first = all.vertices.len();
            all.vertices.extend(solid.vertices);
            all.faces.extend(solid.faces.iter().map(|f| f.iter().map(|v| v + first).collect::<Vec<_>>()));
        }
        let found = Compound::new(pieces).mass_properties(2.0).unwrap();
        assert_close(&found, &all.mass_properties(2.0).unwrap(), 32.0 * E);
    }
}

// ---------------------------------------------------------------- parry

#[test]
fn parry_agrees() {
    use parry3d_f64::mass_properties::MassProperties as Peer;
    use parry3d_f64::shape::SharedShape;

    let compare = |name: &str, found: &MassProperties, peer: &Peer, tolerance: f64| {
        let (mass, center_of_mass, inertia) = parry::mass_properties(peer);
        let peer = MassProperties { mass, center_of_mass, inertia };
        println!("{name}: parry {:.1e} off", (peer.inertia - found.inertia).amax() / found.inertia.amax());
        assert_close(&peer, found, tolerance);
    };
    // parry's axes run along y: its (x, y, z) are our (y, z, x)
    let upright = Quaternion::new(0.5, 0.5, 0.5, 0.5);
    let (r, h) = (0.3, 0.8);
    let form = |shape: Shape| shape.mass_properties(2.0).unwrap();
    let half = [0.2, 0.5, 0.9];
    compare("cuboid", &form(Cuboid::new(half).into()), &Peer::from_cuboid(2.0, parry::vector(half)), 32.0 * E);
    compare("sphere", &form(Sphere::new(r).into()), &Peer::from_ball(2.0, r), 32.0 * E);
    let along = form(Cylinder::new(r, h).into()).turned(&upright.conjugate());
    compare("cylinder", &along, &Peer::from_cylinder(2.0, h, r), 32.0 * E);
    let along = form(Cone::new(r, h).into()).turned(&upright.conjugate());
    compare("cone", &along, &Peer::from_cone(2.0, h, r), 32.0 * E);
    let (a, b) = (parry::vector([0.0, 0.0, -h]), parry::vector([0.0, 0.0, h]));
    compare("capsule", &form(Capsule::new(r, h).into()), &Peer::from_capsule(2.0, a, b, r), 32.0 * E);

    // closed meshes, away from the origin, slanted and not convex: parry sums in plain f64
    for (name, solid) in random_solids().iter().filter(|(name, _)| name.starts_with("globe") || name.starts_with('L')) {
        let vertices: Vec<_> = solid.vertices.iter().map(|&v| parry::vector(v)).collect();
        let faces: Vec<[u32; 3]> =
            solid.faces.iter().map(|f| [0, 1, 2].map(|k| u32::try_from(f[k]).unwrap())).collect();
        let peer = SharedShape::trimesh(vertices, faces).unwrap().mass_properties(2.0);
        compare(name, &solid.mass_properties(2.0).unwrap(), &peer, 256.0 * E);
    }
}

// ---------------------------------------------------------------- files

#[cfg(feature = "mesh")]
mod files {
    use std::path::Path;

    use super::*;
    use bryla::shape::Mesh;

    fn scenes() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes"))
    }

    #[test]
    fn the_wrench_in_the_file_is_the_wrench_of_the_drawing() {
        // the boxes that make_wrench.py lists [mm], the hole taken away by its negative
        let boxes: [([f64; 6], f64); 5] = [
            ([0.0, 120.0, -6.0, 6.0, -3.0, 3.0], 7800.0),
            ([120.0, 140.0, -16.0, 20.0, -5.0, 5.0], 7800.0),
            ([140.0, 160.0, -16.0, -8.0, -5.0, 5.0], 7800.0),
            ([140.0, 166.0, 8.0, 20.0, -5.0, 5.0], 7800.0),
            ([6.0, 12.0, -3.0, 3.0, -3.0, 3.0], -7800.0),
        ];
        let parts = boxes.map(|([x0, x1, y0, y1, z0, z1], density)| {
            let half = [x1 - x0, y1 - y0, z1 - z0].map(|d| 0.5e-3 * d);
            let part = bryla::mass::cuboid::mass_properties(half, density);
            part.moved([x0 + x1, y0 + y1, z0 + z1].map(|s| 0.5e-3 * s))
        });
        let drawn = MassProperties::combined(&parts);

        let mesh = Mesh::new("wrench.stl", 1e-3);
        let solid = mesh.read(scenes()).unwrap();
        // Euler's V − E + F = 0 of a solid with one hole, 2 E = 3 F
        assert_eq!(2 * solid.vertices.len(), solid.faces.len());
        let found = solid.mass_properties(7800.0).unwrap();
        // coordinates are rounded once by the scale
        assert_close(&found, &drawn, 8.0 * E);
        assert!((drawn.mass - 0.143).abs() < 0.02, "{}", drawn.mass);
        let [a, b, c]: [f64; 3] = found.principal_moments().into();
        assert!(b > 5.0 * a && c > b, "three moments of their own: {a} {b} {c}");

        // the same through the shape, also as a compound's piece
        let loaded = Shape::from(mesh.clone()).loaded(scenes()).unwrap();
        assert_eq!(loaded.mass_properties(7800.0).unwrap(), found);
        let pair = Shape::from(Compound::new([Piece::new(mesh)])).loaded(scenes()).unwrap();
        assert_close(&pair.mass_properties(7800.0).unwrap(), &found, 2.0 * E);
    }

    /// A folder of its own for each test, removed at the end.
    struct Folder(std::path::PathBuf);

    impl Folder {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("bryla-{name}-{}", std::process::id()));
            std::fs::create_dir_all(&path).expect("a folder for the test");
            Self(path)
        }

        fn read(&self, name: &str, text: impl AsRef<[u8]>) -> Result<Polyhedron, String> {
            std::fs::write(self.0.join(name), text).expect("a file for the test");
            let shown = format!("{}{}", self.0.display(), std::path::MAIN_SEPARATOR);
            Mesh::new(name, 1.0).read(&self.0).map_err(|e| e.to_string().replace(&shown, ""))
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn an_obj_of_polygons_in_several_objects_is_one_surface() {
        // a cube in two halves of its faces, each with corners of its own, as exporters write them: with
        // zeros of either sign, and digits that single precision does not hold
        let corners = |zero: &str| {
            ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"]
                .map(|v| format!("v {}\n", v.replace('0', zero).replace('1', "0.1")))
                .concat()
        };
        let low = format!("o low\n{}f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\n", corners("0.0"));
        let high = format!("o high\n{}f 11 12 16 15\nf 12 9 13 16\nf 13 14 15 16\n", corners("-0.0"));
        let obj = low + &high;
        let folder = Folder::new("obj");
        let solid = folder.read("cube.obj", &obj).unwrap();
        assert_eq!((solid.vertices.len(), solid.faces.len()), (8, 6));
        let cube = Cuboid::new([0.05; 3]).mass_properties(1.0).unwrap().moved([0.05; 3]);
        assert_close(&solid.mass_properties(1.0).unwrap(), &cube, 8.0 * E);
        // triangles and polygons mixed
        let mixed = folder.read("mixed.obj", obj.replace("f 13 14 15 16", "f 13 14 15\nf 13 15 16")).unwrap();
        assert_eq!(mixed.faces.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4, 4, 4, 4, 3, 3]);
        assert_close(&mixed.mass_properties(1.0).unwrap(), &cube, 8.0 * E);
    }

    #[test]
    fn files_that_hold_no_mesh_are_refused_by_name() {
        let folder = Folder::new("refused");
        let missing = Mesh::new("missing.stl", 1.0).read(&folder.0).unwrap_err().to_string();
        assert!(missing.contains("missing.stl: ") && missing.contains("No such file"), "{missing}");
        assert_eq!(folder.read("a.step", "").unwrap_err(), "a.step: a mesh file must end in .stl or .obj");
        assert_eq!(folder.read("empty.obj", "").unwrap_err(), "empty.obj: holds no faces");
        assert_eq!(
            folder.read("bad.obj", "v 0 0 0\nf 1 2 3\n").unwrap_err(),
            "bad.obj: face vertex index out of bounds"
        );
        assert!(folder.read("short.stl", [0u8; 50]).unwrap_err().starts_with("short.stl: "));
        let cut = &std::fs::read(scenes().join("wrench.stl")).unwrap()[..1000];
        assert!(folder.read("cut.stl", cut).unwrap_err().starts_with("cut.stl: "));
        let scale = Mesh::new("wrench.stl", 0.0).read(scenes()).unwrap_err().to_string();
        assert!(scale.ends_with("wrench.stl: scale must be positive and finite, got 0.0"), "{scale}");
    }

    #[test]
    fn a_surface_with_a_missing_triangle_is_refused_by_its_edges() {
        let bytes = std::fs::read(scenes().join("wrench.stl")).unwrap();
        let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) - 1;
        let mut fewer = bytes[..bytes.len() - 50].to_vec();
        fewer[80..84].copy_from_slice(&count.to_le_bytes());
        let folder = Folder::new("open");
        let refusal = folder.read("open.stl", fewer).unwrap().mass_properties(1.0).unwrap_err().to_string();
        assert!(refusal.starts_with("polyhedron: is not closed: only one face has edge "), "{refusal}");
    }
}
