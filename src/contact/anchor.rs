//! Where a contact that lasts goes when its bodies move, and where it ends.
//!
//! ```text
//! on a face     what one body turns along n, on a face of the other: n turns with the face, and with d = ∓n
//!               seen from the body  c = p + R d of a round,  c = p + Q d/h, h = √(d·Q d)  of an ellipsoid,
//!               gap = ∓d·(p − face) − R or − h
//! on a line     a ball about p on a round about a line: n from the line to p, across it,
//!               gap = |p − line| − r_p − r_line
//! on a rim      the same where the line is a circle:   gap = |p − circle| − r_p
//! two balls     n along the line of centres,   gap = |p_b − p_a| − r_a − r_b
//! two lines     n across both,   gap = n·(p_b − p_a) − r_a − r_b
//! ```
//!
//! A corner is a ball and an edge a line, each of radius 0. A corner on a face is a round of radius 0, as is every
//! point of two faces that lie on each other: their common plane is what matters, and it turns with one of them. The
//! side of a cylinder or a capsule is a line; on a face, or along another line, it touches as two balls, about two
//! points of its axis. An ellipsoid's Q has the squares of its semi-axes; a rim of radius r about the axis e is the
//! ellipsoid without height, Q = r² (1 − e eᵀ). A cone on its side rests on its apex and its rim. Rims and
//! ellipsoids that meet anything but a face, and what meets the side of a cone or an ellipsoid, have no anchor here.
//!
//! A ball on a polyhedron touches the feature in whose Voronoi region its centre is (Lin–Canny 1991). The regions'
//! walls are planes, and where the centre passes one the contact ends and another begins: at an edge, at a corner, back
//! on a face.

use super::cluster::Contact;
use super::manifold::{Manifold, ManifoldPoint, Surface};
use super::region::Region;
use super::rest::Support;
use crate::closest::Feature;
use crate::math::{Matrix3, Pose, Vector3, quaternion};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::state::BodyMotion;

/// What of the two bodies makes a contact, each in its own axes, from its centre of mass [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Anchor {
    /// A surface of body b (or of a, where `of_b` is false) about a point of it, on a face of the other body
    /// through `foot`, with its normal from a to b in that body's axes.
    OnFace {
        /// Whether the surface is b's.
        of_b: bool,
        /// The point that it is about.
        point: Vector3,
        /// The surface.
        rolls: Rolls,
        /// A point of the face.
        foot: Vector3,
        /// The normal.
        normal: Vector3,
    },
    /// Two balls.
    Balls {
        /// Their centres, of a and b.
        centers: [Vector3; 2],
        /// Their radii [m].
        radii: [f64; 2],
    },
    /// A ball of body b (or of a, where `of_b` is false) on a round about a line of the other body.
    OnLine {
        /// Whether the ball is b's.
        of_b: bool,
        /// The ball's centre.
        center: Vector3,
        /// A point of the line.
        foot: Vector3,
        /// Its unit direction.
        along: Vector3,
        /// Radius of the ball, and of the round about the line [m].
        radii: [f64; 2],
    },
    /// A ball of body b (or of a, where `of_b` is false) on a circle of the other body.
    OnRim {
        /// Whether the ball is b's.
        of_b: bool,
        /// The ball's centre.
        center: Vector3,
        /// Its radius [m].
        radius: f64,
        /// The circle's centre.
        middle: Vector3,
        /// Its unit axis.
        axis: Vector3,
        /// Its radius [m].
        rim: f64,
    },
    /// Rounds about two lines that cross.
    Lines {
        /// A point of each, of a and b.
        points: [Vector3; 2],
        /// Their unit directions.
        along: [Vector3; 2],
        /// Their radii [m].
        radii: [f64; 2],
        /// The sign that makes their product point from a to b.
        side: f64,
    },
}

/// Where a contact ends: it goes on where the place that it is told by ([`Anchor::place_for`]) is on the positive side of
/// a plane, or within a round about an axis, or beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Whether it is b's, else a's.
    pub of_b: bool,
    /// The plane's unit normal, or the axis, in the axes of its body.
    pub normal: Vector3,
    /// Where the plane is along the normal, from the body's centre of mass; or the radius of the round, negative where
    /// the contact is beyond it [m].
    pub offset: f64,
    /// A point of the axis of a round, from the body's centre of mass [m].
    pub about: Option<Vector3>,
}

impl Wall {
    /// How far a place, world axes, is on the positive side where the body is there [m].
    fn height(&self, body: &BodyMotion, place: &Vector3) -> f64 {
        let place = body.rotation.tr_mul(&(place - body.position));
        match self.about {
            None => self.normal.dot(&place) - self.offset,
            Some(about) => self.offset - self.offset.signum() * (place - about).cross(&self.normal).norm(),
        }
    }

    /// The same with its sides swapped.
    pub(super) fn turned_over(self) -> Self {
        Self { normal: -self.normal, offset: -self.offset, ..self }
    }
}

/// A surface that rolls on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rolls {
    /// A round of this radius [m]; 0 of a corner.
    Round(f64),
    /// An ellipsoid, or a rim, by its Q, body axes [m²].
    Ellipsoid(Matrix3),
}

impl Rolls {
    /// How far it reaches along a unit direction of the body's axes [m], and its foremost point there, from
    /// what it is about.
    fn foremost(&self, d: &Vector3) -> (f64, Vector3) {
        match self {
            Self::Round(radius) => (*radius, *radius * d),
            Self::Ellipsoid(q) => {
                let height = d.dot(&(q * d)).sqrt();
                (height, q * d / height)
            }
        }
    }

    /// Velocity of the foremost point [m/s] where the direction changes at this rate [1/s], body axes.
    fn run(&self, d: &Vector3, rate: &Vector3) -> Vector3 {
        match self {
            Self::Round(radius) => *radius * rate,
            Self::Ellipsoid(q) => {
                let (height, point) = self.foremost(d);
                (q * rate - point.dot(rate) * point) / height
            }
        }
    }
}

/// Two touching surfaces, with their poses and the motions of their bodies.
#[derive(Debug, Clone, Copy)]
pub struct Faced<'a> {
    /// The surface.
    pub surface: Surface<'a>,
    /// Where its axes stand.
    pub pose: Pose,
    /// The motion of the body that it belongs to.
    pub motion: &'a BodyMotion,
}

impl Anchor {
    /// The anchor of a manifold's point, and the walls at which it ends, as motions leave them by `slack` [m]; none
    /// where the contact has no single normal, or rolls where no formula is known.
    pub fn new(
        a: &Faced<'_>,
        b: &Faced<'_>,
        manifold: &Manifold,
        point: &ManifoldPoint,
        slack: f64,
    ) -> Option<(Self, Vec<Wall>)> {
        let sum: Vector3 = manifold.normals.iter().sum();
        let n = if manifold.normals.len() == 1 { sum } else { sum.try_normalize(0.0)? };
        let count = manifold.points.len();

        // a ball of either on what the other shows it
        if let Some(ball) = b.ball(count, &point.point_b, &-n)
            && let Some(found) = a.met_by(&ball, &n, slack)
        {
            return Some(found.of_bodies(true, a, b, &ball));
        }
        if let Some(ball) = a.ball(count, &point.point_a, &n)
            && let Some(found) = b.met_by(&ball, &-n, slack)
        {
            return Some(found.of_bodies(false, b, a, &ball));
        }
        if manifold.normals.len() > 1 {
            return None;
        }

        // another surface on a face of a, on a face of b; of two faces, what is on an edge of a goes with a
        let on_a = a.has_face(&n).then(|| b.rolls(count, &point.point_b, &-n)).flatten();
        let on_b = b.has_face(&-n).then(|| a.rolls(count, &point.point_a, &n)).flatten();
        let walls_of_a = a.face_walls(false, &n);
        let is_edge = matches!(point.feature_a, Some(Feature::Edge(_) | Feature::Vertex(_)));
        let on_edge = is_edge || walls_of_a.iter().any(|wall| wall.height(a.motion, &point.point_a) < -0.5 * slack);
        if let Some((point_b, rolls)) = on_a
            && (on_b.is_none() || !on_edge)
        {
            let normal = a.motion.rotation.tr_mul(&n);
            let (point_b, foot) = (b.own(&point_b), a.own(&point.point_a));
            return Some((Self::OnFace { of_b: true, point: point_b, rolls, foot, normal }, walls_of_a));
        }
        if let Some((point_a, rolls)) = on_b {
            let normal = b.motion.rotation.tr_mul(&n);
            let (point_a, foot) = (a.own(&point_a), b.own(&point.point_b));
            let mut walls = b.face_walls(true, &-n);
            walls.retain(|wall| wall.height(b.motion, &point.point_b) > ON_EDGE * slack);
            return Some((Self::OnFace { of_b: false, point: point_a, rolls, foot, normal }, walls));
        }

        // two lines that cross
        let (e, f) = (a.line(point.feature_a, &point.point_a)?, b.line(point.feature_b, &point.point_b)?);
        let across = e.along.cross(&f.along).dot(&n);
        let lines = Self::Lines {
            points: [a.own(&e.from), b.own(&f.from)],
            along: [a.motion.rotation.tr_mul(&e.along), b.motion.rotation.tr_mul(&f.along)],
            radii: [e.radius, f.radius],
            side: across.signum(),
        };
        (across != 0.0).then(|| (lines, [a.ends(false, &e), b.ends(true, &f)].concat()))
    }

    /// The contact where the bodies are now, with the rates of its point and normal; friction is that of
    /// `contact`.
    pub fn support(&self, contact: &Contact, motions: &[BodyMotion]) -> Support {
        let (a, b) = (&motions[contact.a], &motions[contact.b]);
        let at = |point: Vector3, normal: Vector3| {
            Contact::new(contact.a, contact.b, point, normal).friction(contact.friction)
        };
        match self {
            Self::OnFace { of_b, point, rolls, normal, .. } => {
                let (face, other) = if *of_b { (a, b) } else { (b, a) };
                let n = face.rotation * normal;
                let (d, rate) = towards_face(*of_b, normal, a, b);
                let touched = other.point(&(point + rolls.foremost(&d).1));
                Support {
                    point_velocity: other.velocity_at(&touched) + other.rotation * rolls.run(&d, &rate),
                    normal_rate: face.angular_velocity.cross(&n),
                    contact: at(touched, n),
                }
            }
            Self::Balls { centers, radii } => {
                let (center_a, center_b) = (a.point(&centers[0]), b.point(&centers[1]));
                let line = center_b - center_a;
                let length = line.norm();
                let n = line / length;
                let across = b.velocity_at(&center_b) - a.velocity_at(&center_a);
                let normal_rate = (across - n.dot(&across) * n) / length;
                Support {
                    point_velocity: a.velocity_at(&center_a) + radii[0] * normal_rate,
                    normal_rate,
                    contact: at(center_a + radii[0] * n, n),
                }
            }
            Self::OnLine { of_b, center, radii: [radius, _], .. } | Self::OnRim { of_b, center, radius, .. } => {
                let ball = if *of_b { b } else { a };
                let (m, turning) = self.off_line(a, b);
                let center = ball.point(center);
                let sign = if *of_b { 1.0 } else { -1.0 };
                Support {
                    point_velocity: ball.velocity_at(&center) - *radius * turning,
                    normal_rate: sign * turning,
                    contact: at(center - *radius * m, sign * m),
                }
            }
            Self::Lines { points, along, radii, side } => {
                let (e, f) = (a.rotation * along[0], b.rotation * along[1]);
                let (p, q) = (a.point(&points[0]), b.point(&points[1]));
                let across = e.cross(&f);
                let n = *side * across / across.norm();

                // the point of a's line nearest to b's
                let s = (q - p).cross(&f).dot(&across) / across.norm_squared();
                Support::between_lines(at(p + s * e + radii[0] * n, n), [a, b], [&e, &f], *radii)
            }
        }
    }

    /// The unit normal from a to b, world axes.
    pub fn normal(&self, a: &BodyMotion, b: &BodyMotion) -> Vector3 {
        match self {
            Self::OnFace { of_b, normal, .. } => (if *of_b { a } else { b }).rotation * normal,
            Self::Balls { centers, .. } => (b.point(&centers[1]) - a.point(&centers[0])).normalize(),
            Self::OnLine { of_b, .. } | Self::OnRim { of_b, .. } => {
                let (m, _) = self.off_line(a, b);
                if *of_b { m } else { -m }
            }
            Self::Lines { along, side, .. } => {
                *side * (a.rotation * along[0]).cross(&(b.rotation * along[1])).normalize()
            }
        }
    }

    /// Angular rate at which the point of contact runs about the surface that it is on [rad/s], beyond what the
    /// bodies turn: a rim that lies almost flat is run about fast.
    pub fn running(&self, a: &BodyMotion, b: &BodyMotion) -> f64 {
        match self {
            Self::OnFace { of_b, rolls: rolls @ Rolls::Ellipsoid(_), normal, .. } => {
                let (d, rate) = towards_face(*of_b, normal, a, b);
                rolls.run(&d, &rate).norm() / rolls.foremost(&d).1.norm()
            }
            Self::OnLine { .. } | Self::OnRim { .. } => self.off_line(a, b).1.norm(),
            Self::OnFace { .. } | Self::Balls { .. } | Self::Lines { .. } => 0.0,
        }
    }

    /// Where a contact is, as walls of a (of b, where `of_b`) bound it, world axes [m]: the centre of the ball that is
    /// on them, or the point that it touches.
    pub fn place_for(&self, of_b: bool, a: &BodyMotion, b: &BodyMotion) -> Vector3 {
        match self {
            Self::OnFace { of_b: mine, point, rolls, normal, .. } => {
                let other = if *mine { b } else { a };
                other.point(&(point + rolls.foremost(&towards_face(*mine, normal, a, b).0).1))
            }
            Self::Balls { centers, .. } => {
                if of_b {
                    a.point(&centers[0])
                } else {
                    b.point(&centers[1])
                }
            }
            Self::OnLine { of_b: ball_is_b, center, foot, along, .. } => {
                let (ball, line) = if *ball_is_b { (b, a) } else { (a, b) };
                let center = ball.point(center);
                if of_b != *ball_is_b {
                    return center;
                }
                let (foot, along) = (line.point(foot), line.rotation * along);
                foot + along.dot(&(center - foot)) * along
            }
            Self::OnRim { of_b, center, .. } => (if *of_b { b } else { a }).point(center),
            Self::Lines { points, along, .. } => {
                let (e, f) = (a.rotation * along[0], b.rotation * along[1]);
                let (p, q) = (a.point(&points[0]), b.point(&points[1]));
                let across = e.cross(&f);
                let other = if of_b { (p - q).cross(&e) } else { (q - p).cross(&f) };
                let s = other.dot(&across) / across.norm_squared();
                if of_b { q - s * f } else { p + s * e }
            }
        }
    }

    /// How far inside of a wall the contact is [m].
    pub fn inside(&self, wall: &Wall, a: &BodyMotion, b: &BodyMotion) -> f64 {
        wall.height(if wall.of_b { b } else { a }, &self.place_for(wall.of_b, a, b))
    }

    /// The unit vector from a line or a circle to the ball on it, across it, and its rate [1/s].
    fn off_line(&self, a: &BodyMotion, b: &BodyMotion) -> (Vector3, Vector3) {
        let of = |of_b: bool| if of_b { (b, a) } else { (a, b) };
        let turned = |v: Vector3, rate: Vector3, carrier: &BodyMotion| {
            let length = v.norm();
            let m = v / length;
            (m, (rate - m.dot(&rate) * m) / length + carrier.angular_velocity.cross(&m))
        };
        match self {
            Self::OnLine { of_b, center, foot, along, .. } => {
                let (ball, line) = of(*of_b);
                let (center, e) = (ball.point(center), line.rotation * along);
                let from = center - line.point(foot);

                // as the line's body sees it
                let passing = ball.velocity_at(&center) - line.velocity_at(&center);
                turned(from - e.dot(&from) * e, passing - e.dot(&passing) * e, line)
            }
            Self::OnRim { of_b, center, middle, axis, rim, .. } => {
                let (ball, carrier) = of(*of_b);
                let (center, e) = (ball.point(center), carrier.rotation * axis);
                let from = center - carrier.point(middle);
                let passing = ball.velocity_at(&center) - carrier.velocity_at(&center);
                let outward = from - e.dot(&from) * e;
                let distance = outward.norm();
                let u = outward / distance;
                let swinging = (passing - e.dot(&passing) * e - u.dot(&passing) * u) / distance;
                turned(from - *rim * u, passing - *rim * swinging, carrier)
            }
            Self::OnFace { .. } | Self::Balls { .. } | Self::Lines { .. } => (Vector3::zeros(), Vector3::zeros()),
        }
    }

    /// The gap between the bodies at the contact [m].
    pub fn gap(&self, a: &BodyMotion, b: &BodyMotion) -> f64 {
        match self {
            Self::OnFace { of_b, point, rolls, foot, normal } => {
                let (face, other, sign) = if *of_b { (a, b, 1.0) } else { (b, a, -1.0) };
                let n = face.rotation * normal;
                let (reach, _) = rolls.foremost(&towards_face(*of_b, normal, a, b).0);
                sign * n.dot(&(other.point(point) - face.point(foot))) - reach
            }
            Self::Balls { centers, radii } => {
                (b.point(&centers[1]) - a.point(&centers[0])).norm() - radii[0] - radii[1]
            }
            Self::OnLine { of_b, center, foot, along, radii } => {
                let (ball, line) = if *of_b { (b, a) } else { (a, b) };
                let from = ball.point(center) - line.point(foot);
                from.cross(&(line.rotation * along)).norm() - radii[0] - radii[1]
            }
            Self::OnRim { of_b, center, radius, middle, axis, rim } => {
                let (ball, carrier) = if *of_b { (b, a) } else { (a, b) };
                let from = ball.point(center) - carrier.point(middle);
                let e = carrier.rotation * axis;
                libm::hypot(from.cross(&e).norm() - rim, e.dot(&from)) - radius
            }
            Self::Lines { points, along, radii, side } => {
                let across = (a.rotation * along[0]).cross(&(b.rotation * along[1]));
                let apart = *side * across.dot(&(b.point(&points[1]) - a.point(&points[0]))) / across.norm();
                apart - radii[0] - radii[1]
            }
        }
    }
}

/// The direction of a face as the other body sees it, and its rate [1/s], for the face's normal from a to b in
/// its body's axes.
fn towards_face(of_b: bool, normal: &Vector3, a: &BodyMotion, b: &BodyMotion) -> (Vector3, Vector3) {
    let (face, other) = if of_b { (a, b) } else { (b, a) };
    let d = face.rotation * if of_b { -normal } else { *normal };
    let rate = (face.angular_velocity - other.angular_velocity).cross(&d);
    (other.rotation.tr_mul(&d), other.rotation.tr_mul(&rate))
}

/// A ball that touches, about a point [m], world axes; of the side of a cylinder or capsule that touches along it with
/// the direction of its axis.
struct Ball {
    center: Vector3,
    radius: f64,
    line: Option<Vector3>,
}

/// A straight line with a round about it, world axes [m].
struct Line {
    from: Vector3,
    along: Vector3,
    length: f64,
    radius: f64,
}

/// What a ball meets, world axes [m], and the walls of its region in the axes of its shape.
enum Met {
    Face { foot: Vector3, outward: Vector3 },
    Line(Line),
    Rim { middle: Vector3, axis: Vector3, radius: f64 },
    Point { center: Vector3, radius: f64 },
}

/// What a ball meets with the walls at which that ends.
struct Meeting {
    met: Met,
    walls: Vec<Wall>,
}

impl Meeting {
    /// The anchor of a ball of b (of a, where `of_b` is false) on what the other body, which is given first, shows it.
    fn of_bodies(self, of_b: bool, other: &Faced<'_>, own: &Faced<'_>, ball: &Ball) -> (Anchor, Vec<Wall>) {
        let center = own.own(&ball.center);
        let anchor = match self.met {
            Met::Face { foot, outward } => Anchor::OnFace {
                of_b,
                point: center,
                rolls: Rolls::Round(ball.radius),
                foot: other.own(&foot),
                normal: other.motion.rotation.tr_mul(&if of_b { outward } else { -outward }),
            },
            Met::Line(line) => Anchor::OnLine {
                of_b,
                center,
                foot: other.own(&line.from),
                along: other.motion.rotation.tr_mul(&line.along),
                radii: [ball.radius, line.radius],
            },
            Met::Rim { middle, axis, radius } => Anchor::OnRim {
                of_b,
                center,
                radius: ball.radius,
                middle: other.own(&middle),
                axis: other.motion.rotation.tr_mul(&axis),
                rim: radius,
            },
            Met::Point { center: point, radius } => {
                let point = other.own(&point);
                let (centers, radii) = if of_b {
                    ([point, center], [radius, ball.radius])
                } else {
                    ([center, point], [ball.radius, radius])
                };
                Anchor::Balls { centers, radii }
            }
        };
        (anchor, self.walls.into_iter().map(|wall| Wall { of_b: !of_b, ..wall }).collect())
    }
}

impl Faced<'_> {
    /// A place, world axes, in the body's axes from its centre of mass.
    fn own(&self, p: &Vector3) -> Vector3 {
        self.motion.rotation.tr_mul(&(p - self.motion.position))
    }

    /// A wall given in the shape's axes about a point of them, in the body's from its centre of mass.
    fn placed(&self, of_b: bool, wall: &Wall, about: &Vector3) -> Wall {
        let normal = self.turned(&wall.normal);
        let through = self.pose.point(&(about + wall.offset * wall.normal));
        let normal_own = self.motion.rotation.tr_mul(&normal);
        Wall { of_b, normal: normal_own, offset: normal_own.dot(&self.own(&through)), about: None }
    }

    /// The ball that touches in one of `count` points, world axes, whose outer normal is `d`.
    fn ball(&self, count: usize, touched: &Vector3, d: &Vector3) -> Option<Ball> {
        let axis = self.pose.vector(&Vector3::z());
        let about =
            |z: f64, radius: f64, line: Option<Vector3>| Ball { center: self.pose.position + z * axis, radius, line };
        let z = axis.dot(&(touched - self.pose.position));
        let along = count == 2 && axis.dot(d).abs() < 0.5;
        match &self.surface {
            Surface::Sphere(sphere) => Some(about(0.0, sphere.radius, None)),
            Surface::Capsule(capsule) if along => Some(about(z, capsule.radius, Some(axis))),
            Surface::Cylinder(cylinder) if along => Some(about(z, cylinder.radius, Some(axis))),
            Surface::Capsule(c) if z.abs() >= c.half_height * (1.0 - FLAT) => {
                Some(about(c.half_height.copysign(z), c.radius, None))
            }
            _ => None,
        }
    }

    /// What a ball meets of this surface, whose outer normal there is `n`.
    fn met_by(&self, ball: &Ball, n: &Vector3, slack: f64) -> Option<Meeting> {
        match &self.surface {
            Surface::HalfSpace(plane) => {
                let outward = self.turned(&plane.plane().0);
                let height = outward.dot(&(ball.center - self.pose.position)) - plane.plane().1;
                let foot = ball.center - height * outward;
                Some(Meeting { met: Met::Face { foot, outward }, walls: Vec::new() })
            }
            Surface::Polyhedron(shape) => self.region_of(shape, ball, slack),
            Surface::Sphere(sphere) => {
                let met = Met::Point { center: self.pose.position, radius: sphere.radius };
                Some(Meeting { met, walls: Vec::new() })
            }
            Surface::Capsule(capsule) => {
                let side = self.side(capsule.half_height, capsule.radius);
                let s = side.along.dot(&(ball.center - side.from));
                if ball.line.is_some() {
                    return Some(Meeting { met: Met::Line(side), walls: Vec::new() });
                }
                let walls = self.ends(false, &side);
                if s < -0.5 * slack || s > side.length + 0.5 * slack {
                    let (end, wall) = if s < 0.0 { (0.0, walls[0]) } else { (side.length, walls[1]) };
                    let center = side.from + end * side.along;
                    let met = Met::Point { center, radius: capsule.radius };
                    return Some(Meeting { met, walls: vec![wall.turned_over()] });
                }
                Some(Meeting { met: Met::Line(side), walls })
            }
            Surface::Cylinder(cylinder) => {
                let side = self.side(cylinder.half_height, cylinder.radius);
                let from = ball.center - self.pose.position;
                let (s, away) = (side.along.dot(&from), side.along.cross(&from).norm());
                let outward = if s > 0.0 { side.along } else { -side.along };
                let middle = self.pose.position + cylinder.half_height * outward;
                if ball.line.is_some() {
                    let met = if self.has_face(n) { Met::Face { foot: middle, outward } } else { Met::Line(side) };
                    return Some(Meeting { met, walls: Vec::new() });
                }

                // on the side, on a cap, or on the rim between them
                let around = Wall {
                    of_b: false,
                    normal: self.motion.rotation.tr_mul(&side.along),
                    offset: cylinder.radius,
                    about: Some(self.own(&self.pose.position)),
                };
                let ends = self.ends(false, &side);
                if s.abs() <= cylinder.half_height + 0.5 * slack {
                    return Some(Meeting { met: Met::Line(side), walls: ends });
                }
                if away <= cylinder.radius + 0.5 * slack {
                    return Some(Meeting { met: Met::Face { foot: middle, outward }, walls: vec![around] });
                }
                let walls = vec![around.turned_over(), ends[usize::from(s > 0.0)].turned_over()];
                Some(Meeting { met: Met::Rim { middle, axis: outward, radius: cylinder.radius }, walls })
            }
            Surface::Cone(cone) if self.has_face(n) => {
                let outward = -self.turned(&Vector3::z());
                let foot = self.pose.position + cone.half_height * outward;
                Some(Meeting { met: Met::Face { foot, outward }, walls: Vec::new() })
            }
            Surface::Cone(_) | Surface::Ellipsoid(_) => None,
        }
    }

    /// What a ball meets of a polyhedron.
    fn region_of(&self, shape: &ConvexPolyhedron, ball: &Ball, slack: f64) -> Option<Meeting> {
        let about = Vector3::from(shape.center());
        let line = ball.line.map(|line| self.pose.inverse_vector(&line));
        let center = self.pose.inverse_point(&ball.center) - about;
        let region = Region::of(shape, &center, line.as_ref(), slack)?;
        let place = |p: &Vector3| self.pose.point(&(about + p));
        let met = match region {
            Region::Face(f) => {
                let face = &shape.faces()[f];
                let outward = Vector3::from(face.normal);
                let foot = center - (outward.dot(&center) - face.offset) * outward;
                Met::Face { foot: place(&foot), outward: self.turned(&outward) }
            }
            Region::Edge(e) => Met::Line(self.edge(shape, e)),
            Region::Vertex(v) => {
                Met::Point { center: place(&Vector3::from(shape.vertices_about_center()[v])), radius: 0.0 }
            }
        };
        let walls = region.walls(shape, line.as_ref()).iter().map(|wall| self.placed(false, wall, &about)).collect();
        Some(Meeting { met, walls })
    }

    /// An edge of a polyhedron.
    fn edge(&self, shape: &ConvexPolyhedron, edge: usize) -> Line {
        let from = Vector3::from(shape.vertices_about_center()[shape.edge_vertices(edge)[0]]);
        let edge = &shape.edges()[edge];
        Line {
            from: self.pose.point(&(Vector3::from(shape.center()) + from)),
            along: self.turned(&edge.direction.into()),
            length: edge.length,
            radius: 0.0,
        }
    }

    /// The axis of a cylinder or capsule with the round about it.
    fn side(&self, half_height: f64, radius: f64) -> Line {
        let along = self.turned(&Vector3::z());
        Line { from: self.pose.position - half_height * along, along, length: 2.0 * half_height, radius }
    }

    /// The line that crosses another at a point of the surface: an edge, or the side of a cylinder or capsule.
    fn line(&self, feature: Option<Feature>, touched: &Vector3) -> Option<Line> {
        let beside = |half_height: f64| self.pose.inverse_point(touched).z.abs() < half_height * (1.0 - FLAT);
        match (&self.surface, feature) {
            (Surface::Polyhedron(shape), Some(Feature::Edge(edge))) => Some(self.edge(shape, edge as usize)),
            (Surface::Cylinder(c), _) => beside(c.half_height).then(|| self.side(c.half_height, c.radius)),
            (Surface::Capsule(c), _) => beside(c.half_height).then(|| self.side(c.half_height, c.radius)),
            _ => None,
        }
    }

    /// The walls at the ends of a line of the surface.
    fn ends(&self, of_b: bool, line: &Line) -> Vec<Wall> {
        let wall = |at: Vector3, along: Vector3| {
            let normal = self.motion.rotation.tr_mul(&along);
            Wall { of_b, normal, offset: normal.dot(&self.own(&at)), about: None }
        };
        vec![wall(line.from, line.along), wall(line.from + line.length * line.along, -line.along)]
    }

    /// The walls around the face of a polyhedron with this outer normal, world axes.
    fn face_walls(&self, of_b: bool, n: &Vector3) -> Vec<Wall> {
        let Surface::Polyhedron(shape) = &self.surface else { return Vec::new() };
        let own = self.pose.inverse_vector(n);
        let Some(face) = shape.faces().iter().position(|f| (Vector3::from(f.normal) - own).norm() <= FLAT) else {
            return Vec::new();
        };
        let about = Vector3::from(shape.center());
        Region::Face(face).walls(shape, None).iter().map(|wall| self.placed(of_b, wall, &about)).collect()
    }

    /// Whether the surface is flat along an outer normal, world axes.
    fn has_face(&self, n: &Vector3) -> bool {
        let own = self.pose.inverse_vector(n);
        match &self.surface {
            Surface::HalfSpace(_) => true,
            Surface::Polyhedron(shape) => {
                shape.faces().iter().any(|face| (Vector3::from(face.normal) - own).norm() <= FLAT)
            }
            Surface::Cylinder(_) => libm::hypot(own.x, own.y) <= FLAT,
            Surface::Cone(_) => libm::hypot(own.x, own.y) <= FLAT && own.z < 0.0,
            Surface::Sphere(_) | Surface::Capsule(_) | Surface::Ellipsoid(_) => false,
        }
    }

    /// What one of `count` points, world axes [m], is of, with the point that it is about, where the surface
    /// touches a face whose outer normal is −d.
    fn rolls(&self, count: usize, touched: &Vector3, d: &Vector3) -> Option<(Vector3, Rolls)> {
        let round = |radius: f64| Some((touched - radius * d, Rolls::Round(radius)));
        let ellipsoid = |center: Vector3, semi_axes: Vector3| {
            let turn = self.motion.rotation.transpose() * quaternion::to_matrix(&self.pose.orientation);
            let squares = Matrix3::from_diagonal(&semi_axes.component_mul(&semi_axes));
            Some((self.pose.point(&center), Rolls::Ellipsoid(turn * squares * turn.transpose())))
        };
        let rim = |radius: f64, z: f64| ellipsoid(Vector3::new(0.0, 0.0, z), Vector3::new(radius, radius, 0.0));
        let z = self.pose.inverse_point(touched).z;
        match &self.surface {
            Surface::Polyhedron(_) => round(0.0),
            Surface::Capsule(capsule) => round(capsule.radius),
            Surface::Cylinder(_) | Surface::Cone(_) if count > 2 => round(0.0),
            Surface::Cylinder(cylinder) => rim(cylinder.radius, cylinder.half_height.copysign(z)),
            Surface::Cone(_) if z > 0.0 => round(0.0),
            Surface::Cone(cone) => rim(cone.radius, -cone.half_height),
            Surface::Ellipsoid(shape) => ellipsoid(Vector3::zeros(), shape.semi_axes.into()),
            Surface::Sphere(_) | Surface::HalfSpace(_) => None,
        }
    }

    fn turned(&self, v: &Vector3) -> Vector3 {
        self.pose.vector(v)
    }
}

/// How far from the side of a face a point is to come to it in a motion, in the slack of its walls [-]: a point that slides
/// along a side does not end there.
const ON_EDGE: f64 = 1.0e4;
/// How far a face's normal may be from the contact's for the contact to lie on that face [rad].
const FLAT: f64 = 1.0e-9;
