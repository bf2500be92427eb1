//! The lecture: the physics that bryla implements, with its equation numbers.
//!
//! bryla grew out of a short lecture on the computer simulation of rigid bodies (*Bryła sztywna*). This
//! page tells its content in our own words and keeps its numbers, so that a citation such as
//! `lecture (27)` has a place to point at. Where the lecture is loose or its print is damaged, the
//! correct form stands here and a **Note** says so. What goes beyond the lecture says **beyond**.
//!
//! | section | equations | in code |
//! |---|---|---|
//! | [Conventions](#conventions) | | [`math`](crate::math), [`state`](crate::state) |
//! | [1. Position and orientation](#1-position-and-orientation) | (1)–(5) | [`math::rotation`](crate::math::rotation), [`math::pose`](crate::math::pose) |
//! | [2. Velocity](#2-velocity) | (6)–(8) | [`state`](crate::state), [`math::rotation`](crate::math::rotation) |
//! | [3. Force, torque, momentum](#3-force-torque-momentum) | (9)–(23) | [`state`](crate::state), [`effect`](crate::effect), [`mass`](crate::mass) |
//! | [4. State and steps in time](#4-state-and-steps-in-time) | (24) | [`freedom`](crate::freedom), [`integrator`](crate::integrator) |
//! | [5. Quaternions](#5-quaternions) | (25)–(29) | [`math::quaternion`](crate::math::quaternion) |
//! | [6. The hovercraft](#6-the-hovercraft) | (30)–(37) | [`Thruster`](crate::effect::Thruster), [`Drag`](crate::effect::Drag), [`Planar`](crate::freedom::Planar) |
//! | [7. Collision](#7-collision) | | [`impact`](crate::impact), [`closest::vertex_plane`](crate::closest::vertex_plane) |
//! | [8. Closest features](#8-closest-features-lincanny) | | [`closest`](crate::closest) |
//! | [9. Contact](#9-contact-beyond) | | [`contact`](crate::contact) |
//!
//! # Conventions
//!
//! - SI units, angles in radians, right-handed axes, `f64`. The lecture's `x₁, x₂, x₃` are `x, y, z`.
//! - The **world** frame is fixed. The **body** frame has its origin in the centre of mass and is fixed
//!   to the body; its axes are the axes of the body's shape, never silently the principal ones.
//! - The matrix `R` and the unit quaternion `q = [s, v]` turn **body into world** components.
//!   Quaternions are written scalar first, `(w, x, y, z)`.
//! - Angular velocity, angular momentum, force and torque are in world axes, unless a name ends in
//!   `_body`.
//! - A body is rigid and, unless its mass properties are given, of uniform density.
//!
//! | symbol | name in code | unit | meaning |
//! |---|---|---|---|
//! | `t`, `h` | `time`, `step` | s | time, length of a step |
//! | `x` | `position` | m | centre of mass |
//! | `R`, `q` | `rotation`, `orientation` | – | rotation from body to world axes |
//! | `v` | `velocity` | m/s | velocity of the centre of mass |
//! | `ω`, `Ω` | `angular_velocity` | rad/s | angular velocity, and its matrix (8) |
//! | `m` | `mass` | kg | mass |
//! | `I` | `inertia` | kg·m² | inertia tensor about the centre of mass |
//! | `P` | `linear_momentum` | kg·m/s | momentum |
//! | `L` | `angular_momentum` | kg·m²/s | angular momentum about the centre of mass |
//! | `F` | `force` | N | force |
//! | `M` | `torque` | N·m | torque about the centre of mass |
//! | `ε` | – | rad/s² | angular acceleration (§6); in §7 the gap in m at which a contact is accepted |
//!
//! # 1. Position and orientation
//!
//! A body point `p₀`, in body axes from the centre of mass, is found in the world at
//!
//! ```text
//! p(t) = R(t) p₀ + x(t)
//! ```
//!
//! The columns of `R` are the body axes seen from the world. A vector turns by (1); every rotation is made
//! of the elementary ones about the three axes, with `c = cos θ`, `s = sin θ`:
//!
//! ```text
//! v′ = R v                                                                   (1)
//!
//!         ⎡ 1  0  0 ⎤            ⎡  c  0  s ⎤            ⎡ c −s  0 ⎤
//! R₁(θ) = ⎢ 0  c −s ⎥    R₂(θ) = ⎢  0  1  0 ⎥    R₃(θ) = ⎢ s  c  0 ⎥          (2), (3), (4)
//!         ⎣ 0  s  c ⎦            ⎣ −s  0  c ⎦            ⎣ 0  0  1 ⎦
//!
//! R₁ R₂ ≠ R₂ R₁                                                               (5)
//! ```
//!
//! | equation | in code |
//! |---|---|
//! | `R p₀ + x` | [`Pose::point`](crate::math::Pose::point), [`BodyMotion::point`](crate::state::BodyMotion::point) |
//! | (1) | [`Pose::vector`](crate::math::Pose::vector), [`quaternion::rotate`](crate::math::quaternion::rotate) |
//! | (2) | [`rotation::elementary_x`](crate::math::rotation::elementary_x) |
//! | (3) | [`rotation::elementary_y`](crate::math::rotation::elementary_y) |
//! | (4) | [`rotation::elementary_z`](crate::math::rotation::elementary_z) |
//! | (5) | the example below |
//!
//! Rotations do not commute, which the lecture sets as an exercise. For small angles the difference is
//! of **second** order, which is why angular velocities add although rotations do not:
//!
//! ```text
//! R₁(α) R₂(β) − R₂(β) R₁(α) = α β Ω(e₃) + terms of third order
//! ```
//!
//! ```
//! use std::f64::consts::FRAC_PI_2;
//! use bryla::math::Vector3;
//! use bryla::math::rotation::{cross_matrix, elementary_x, elementary_y};
//!
//! // quarter turns take the z axis to different places: to x, or to −y
//! let (r1, r2) = (elementary_x(FRAC_PI_2), elementary_y(FRAC_PI_2));
//! assert!((r1 * r2 * Vector3::z() - Vector3::x()).norm() < 1e-15);
//! assert!((r2 * r1 * Vector3::z() + Vector3::y()).norm() < 1e-15);
//!
//! // small turns: half the angles, a quarter of the difference
//! let commutator = |a: f64, b: f64| elementary_x(a) * elementary_y(b) - elementary_y(b) * elementary_x(a);
//! let (a, b) = (0.02, 0.01);
//! let ratio = commutator(a, b).norm() / commutator(a / 2.0, b / 2.0).norm();
//! assert!((ratio - 4.0).abs() < 1e-3);
//! // what is left is of third order
//! let rest = commutator(a, b) - a * b * cross_matrix(&Vector3::z());
//! assert!(rest.norm() < a * b * (a + b));
//! ```
//!
//! # 2. Velocity
//!
//! ```text
//! v = dx/dt                                                                  (6)
//! ```
//!
//! **Note**: the lecture calls this the velocity of every point. That holds only without rotation; the
//! point `p` of the body moves with `v + ω × (p − x)`.
//!
//! The direction of `ω` is the axis of rotation, its length the rate. A vector `r` changes by what it
//! does in the body and by being carried along, `dr/dt = ∂r/∂t + ω × r`; one that is fixed in the body as
//! `dr/dt = ω × r`. The columns of `R` are such vectors:
//!
//! ```text
//! dR/dt = Ω R                                                                (7)
//!
//!     ⎡  0  −ωz  ωy ⎤
//! Ω = ⎢  ωz  0  −ωx ⎥        Ω r = ω × r                                      (8)
//!     ⎣ −ωy  ωx  0  ⎦
//! ```
//!
//! | equation | in code |
//! |---|---|
//! | (6) | [`BodyMotion::velocity`](crate::state::BodyMotion::velocity) |
//! | `v + ω × (p − x)` | [`BodyMotion::velocity_at`](crate::state::BodyMotion::velocity_at) |
//! | (7) | [`Form::WorldMatrix`](crate::freedom::Form::WorldMatrix) |
//! | (8) | [`rotation::cross_matrix`](crate::math::rotation::cross_matrix) |
//!
//! # 3. Force, torque, momentum
//!
//! ```text
//! M = r × F                                                                  (9)
//! Mᵢ = (rᵢ − x) × Fᵢ         of a force Fᵢ at the world point rᵢ              (10)
//! F = Σ Fᵢ,   M = Σ Mᵢ                                                        (11)
//! ```
//!
//! A force through the centre of mass has no arm and turns nothing.
//!
//! The angular momentum begins as a sum over particles `mᵢ` at `rᵢ` and ends, about a fixed axis, in a
//! scalar:
//!
//! ```text
//! L = Σ mᵢ rᵢ vᵢ  →  L = ω ∫ r² dm                                            (12)–(17)
//! P = m v                                                                    (18)
//! dP/dt = F                                                                  (19)
//! L = I ω                                                                    (20)
//!
//!     ⎡  ∫(x₂²+x₃²)dm   −∫ x₁ x₂ dm     −∫ x₁ x₃ dm   ⎤
//! I = ⎢ −∫ x₁ x₂ dm      ∫(x₁²+x₃²)dm   −∫ x₂ x₃ dm   ⎥                       (21)
//!     ⎣ −∫ x₁ x₃ dm     −∫ x₂ x₃ dm      ∫(x₁²+x₂²)dm ⎦
//!
//! L = ∫ r × (ω × r) dm                                                       (22)
//!   = ∫ (|r|² ω − r (r·ω)) dm                                                (23)
//! ```
//!
//! **Note**: the scalar form `L = ω ∫ r² dm` holds only for rotation about a **fixed axis**, with `r` the
//! distance from that axis. It gives the part of `L` along the axis. A tumbling body needs the tensor
//! (20), and its `L` is parallel to `ω` only while it turns about a principal axis.
//!
//! The tensor is worked out once, in body axes. In the world it turns with the body:
//!
//! ```text
//! I(t) = R I_body Rᵀ        I⁻¹(t) = R I_body⁻¹ Rᵀ
//! ```
//!
//! Box, ball and cylinder have closed forms (**beyond**: capsule, cone, ellipsoid); any other solid
//! needs volume integrals. Of a closed polyhedron they are exact sums over its faces, and its principal
//! axes follow by diagonalising `I`.
//!
//! | equation | in code |
//! |---|---|
//! | (9), (10) | [`Load::add_force_at`](crate::state::Load::add_force_at) |
//! | (11) | [`Load`](crate::state::Load), filled by [`Effect::add_to`](crate::effect::Effect::add_to) |
//! | (12)–(17) | about a fixed axis: [`Freedom::Axle`](crate::freedom::Freedom::Axle) |
//! | (18) | [`BodyState::linear_momentum`](crate::state::BodyState::linear_momentum), [`BodyMotion::state`](crate::state::BodyMotion::state) |
//! | (19) | [`Chart::rate`](crate::freedom::Chart::rate) |
//! | (20) | [`BodyMotion::angular_momentum`](crate::state::BodyMotion::angular_momentum); the other way round [`BodyMotion::set_state`](crate::state::BodyMotion::set_state) |
//! | (21) | [`MassProperties::inertia`](crate::mass::MassProperties::inertia), worked out in [`mass`](crate::mass), [`mass::polyhedron`](crate::mass::polyhedron) |
//! | (22), (23) | derived in [`mass`](crate::mass) |
//! | principal axes | [`MassProperties::principal`](crate::mass::MassProperties::principal) |
//!
//! # 4. State and steps in time
//!
//! ```text
//! Y = (x, R or q, P, L)                                                      (24)
//! dY/dt = (v, dR/dt or dq/dt, F, M)         v = P/m,   ω = I⁻¹(t) L
//! ```
//!
//! Two ways to go from `Yₙ` to `Yₙ₊₁`, a step `h` later:
//!
//! ```text
//! Euler    Yₙ₊₁ = Yₙ + h Y′(Yₙ)
//! Heun     Yₙ₊₁ = Yₙ + ½ h [ Y′(Yₙ) + Y′(Yₙ + h Y′(Yₙ)) ]        the improved Euler
//! ```
//!
//! Euler's is the lecture's first step and its warning: the error is too large for a stable simulation.
//! **Note**: at fixed span the energy of a free body has with Heun's method a trend that falls about 8 times
//! per halving of the step, and a swing of the method's order riding on it; with Euler's the climb falls
//! 2 times. Neither is bounded. [What accuracy costs](crate::guide::accuracy) shows both.
//!
//! With `R` the state has 18 numbers, with `q` 13; both forms can be run. **Rule for states off the
//! sphere**, on which the sign of the energy's drift depends: the right-hand side always uses the rotation
//! of `q/|q|` (of `R`, its polar factor); stages within a step stay as they are; after the step `q` is
//! divided by its length, `R` replaced by its polar factor. How far the worst had strayed before that,
//! `||q| − 1|` or the Frobenius norm `‖RᵀR − I‖`, is reported.
//!
//! | equation | in code |
//! |---|---|
//! | (24), `Y` | [`BodyState`](crate::state::BodyState); as numbers [`Chart`](crate::freedom::Chart) |
//! | (24), `dY/dt` | [`Chart::rate`](crate::freedom::Chart::rate), over a group of bodies [`plan::Group`](crate::plan::Group) |
//! | `R` or `q` | [`Orientation`](crate::scene::Orientation), [`Form`](crate::freedom::Form) |
//! | Euler, Heun | [`Method::Euler`](crate::integrator::Method::Euler), [`Method::Heun`](crate::integrator::Method::Heun) |
//! | the rule off the sphere | [`Chart::project`](crate::freedom::Chart::project), [`quaternion::normalized`](crate::math::quaternion::normalized), [`rotation::polar_factor`](crate::math::rotation::polar_factor) |
//! | what is reported | [`Counts::orientation_drift`](crate::integrator::Counts::orientation_drift), [`rotation::orthogonality_error`](crate::math::rotation::orthogonality_error) |
//! | leaving the rule out | [`RunOptions::projection`](crate::scene::RunOptions::projection) |
//!
//! **Beyond**: coordinates of bodies that move in a plane, about a point or about an axis
//! ([`freedom`](crate::freedom)); angular momentum in body axes, where Euler's equations hold,
//! `dL/dt = L × ω + M` ([`Form::Body`](crate::freedom::Form::Body)); and further
//! [methods](crate::integrator::Method).
//!
//! # 5. Quaternions
//!
//! ```text
//! q = [s, v] = s + i v₁ + j v₂ + k v₃                                         (25)
//! i² = j² = k² = −1,   ij = k = −ji,   jk = i = −kj,   ki = j = −ik
//! [s₁, v₁] [s₂, v₂] = [s₁ s₂ − v₁·v₂,  s₁ v₂ + s₂ v₁ + v₁ × v₂]               (26)
//! dq/dt = ½ [0, ω] q           ω in world axes
//!       = ½ q [0, ω_body]      ω in body axes                                (27)
//! v′ = q v q*                                                                (28)
//! q* = [s, −v]                                                               (29)
//! ```
//!
//! Only quaternions of unit length are rotations: by the angle `θ` about the unit axis `u` it is
//! `[cos(θ/2), sin(θ/2) u]`. The matrix of `q = (w, x, y, z)`:
//!
//! ```text
//! ⎡ 1−2(y²+z²)   2(xy−wz)     2(xz+wy)   ⎤
//! ⎢ 2(xy+wz)     1−2(x²+z²)   2(yz−wx)   ⎥
//! ⎣ 2(xz−wy)     2(yz+wx)     1−2(x²+y²) ⎦
//! ```
//!
//! **Note**: the sign in the entry (1,3), `2(xz+wy)`, is misprinted in the lecture.
//!
//! **Note**: `q` and `−q` are the same rotation; whoever compares two of them must know it.
//!
//! | equation | in code |
//! |---|---|
//! | (25) | [`math::Quaternion`](crate::math::Quaternion), [`quaternion::from_scalar_first`](crate::math::quaternion::from_scalar_first), [`quaternion::from_axis_angle`](crate::math::quaternion::from_axis_angle) |
//! | (26) | the operator `*` of [`math::Quaternion`](crate::math::Quaternion) |
//! | (27), world axes | [`quaternion::rate_world`](crate::math::quaternion::rate_world) |
//! | (27), body axes | [`quaternion::rate_body`](crate::math::quaternion::rate_body) |
//! | (28) | [`quaternion::rotate`](crate::math::quaternion::rotate) |
//! | (29) | `conjugate` of [`math::Quaternion`](crate::math::Quaternion) |
//! | the matrix of `q`, and back | [`quaternion::to_matrix`](crate::math::quaternion::to_matrix), [`quaternion::from_matrix`](crate::math::quaternion::from_matrix) |
//! | comparing | [`quaternion::angle_between`](crate::math::quaternion::angle_between) |
//!
//! ```
//! use bryla::math::quaternion::{angle_between, from_scalar_first, rate_world, to_matrix};
//! use bryla::math::rotation::cross_matrix;
//! use bryla::math::{Matrix3, Quaternion, Vector3};
//!
//! // the units
//! let one = from_scalar_first([1.0, 0.0, 0.0, 0.0]);
//! let i = from_scalar_first([0.0, 1.0, 0.0, 0.0]);
//! let j = from_scalar_first([0.0, 0.0, 1.0, 0.0]);
//! let k = from_scalar_first([0.0, 0.0, 0.0, 1.0]);
//! assert_eq!([i * i, j * j, k * k, i * j * k], [-one; 4]);
//! assert_eq!([i * j, j * k, k * i], [k, i, j]);
//! assert_eq!([j * i, k * j, i * k], [-k, -i, -j]);
//!
//! // q and −q: one matrix, no angle between them
//! let q = from_scalar_first([0.5, 0.1, -0.7, 0.5]);
//! assert_eq!(to_matrix(&q), to_matrix(&-q));
//! assert!(angle_between(&q, &-q) < 1e-15);
//!
//! // R of the q that follows (27), and the R that follows (7): both by Heun's method, in a world in which
//! // the axis turns. They differ by the method's error, order 2: a quarter for half the step.
//! let w = |t: f64| Vector3::new(1.0 - t, 2.0 * t, 0.5);
//! let difference = |steps: u32| {
//!     let h = 1.0 / f64::from(steps);
//!     let (mut q, mut r) = (Quaternion::identity(), Matrix3::identity());
//!     for n in 0..steps {
//!         let (w0, w1) = (w(f64::from(n) * h), w(f64::from(n + 1) * h));
//!         let slope = rate_world(&w0, &q);
//!         q += (slope + rate_world(&w1, &(q + slope * h))) * (0.5 * h);
//!         let slope = cross_matrix(&w0) * r;
//!         r += (slope + cross_matrix(&w1) * (r + slope * h)) * (0.5 * h);
//!     }
//!     (to_matrix(&q) - r).norm()
//! };
//! let (coarse, fine) = (difference(100), difference(200));
//! assert!(coarse < 1e-3 && (coarse / fine - 4.0).abs() < 0.1);
//! ```
//!
//! # 6. The hovercraft
//!
//! ```text
//! F = m a                                                                    (30)
//! dL/dt = M                                                                  (31)
//! M = I ε        about a fixed axis, with a scalar I = n·I n                 (32)
//! ```
//!
//! Three engines are fixed to the hull: the main engine `c` at the rear, on the longitudinal axis, and
//! the left `l` and right `p` steering engines at the front. In body axes
//!
//! ```text
//! F_w = F_c + F_l + F_p                                                      (33)
//! M_c = r_c × F_c,   M_l = r_l × F_l,   M_p = r_p × F_p                       (34), (35), (36)
//! M_w = M_c + M_l + M_p                                                      (37)
//! ```
//!
//! and the air resists translation and rotation. The force is turned into the world before it is used.
//! One step of the lecture:
//!
//! ```text
//! a = F/m,   vₙ₊₁ = vₙ + a h,   sₙ₊₁ = sₙ + vₙ₊₁ h
//! ε = M/I,   ωₙ₊₁ = ωₙ + ε h,   θₙ₊₁ = θₙ + ωₙ₊₁ h
//! ```
//!
//! The new velocity moves the body: semi-implicit Euler. **Note**: the lecture says so expressly for `θ`
//! only; here it holds for `s` as well.
//!
//! The motion is planar. Three degrees of freedom are enough; with six one would simulate what the scene
//! does not call for.
//!
//! | equation | in code |
//! |---|---|
//! | (30) | as (19): [`Chart::rate`](crate::freedom::Chart::rate) |
//! | (31) | [`Chart::rate`](crate::freedom::Chart::rate) |
//! | (32) | [`Chart::Planar`](crate::freedom::Chart::Planar), [`Chart::Axle`](crate::freedom::Chart::Axle) |
//! | (33)–(37) | [`Thruster`](crate::effect::Thruster), one for each engine |
//! | drag | [`Drag`](crate::effect::Drag) |
//! | the step | [`Method::SemiImplicitEuler`](crate::integrator::Method::SemiImplicitEuler) |
//! | three degrees of freedom | [`Freedom::Planar`](crate::freedom::Freedom::Planar) |
//!
//! Net force and torque of three engines at once, on a hull that has turned by a quarter to the left; the
//! whole scene is `examples/scenes/hovercraft.toml`:
//!
//! ```
//! use std::f64::consts::FRAC_PI_2;
//! use bryla::effect::{BodyMotion, Effect, Load, Moment, Thruster};
//! use bryla::math::{Matrix3, Vector3, quaternion};
//!
//! let mut hull = BodyMotion::at_rest(400.0, Matrix3::identity());
//! hull.orientation = quaternion::from_axis_angle(&Vector3::z(), FRAC_PI_2);
//! hull.rotation = quaternion::to_matrix(&hull.orientation);
//!
//! let engines = [
//!     Thruster::new("hull", [-2.0, 0.0, 0.0], [900.0, 0.0, 0.0]),  // c: ahead
//!     Thruster::new("hull", [1.6, 0.8, 0.0], [0.0, -150.0, 0.0]),  // l: pushes the bow to the right
//!     Thruster::new("hull", [1.6, -0.8, 0.0], [0.0, 100.0, 0.0]),  // p: to the left
//! ];
//! let now = Moment { time: 0.0, since: 0.0 };
//! let mut net = [Load::zero()];
//! for engine in &engines {
//!     engine.add_to(now, &[hull], &mut net);
//! }
//!
//! // (33): (900, 0 − 150 + 100, 0) N in body axes, which in the world is (50, 900, 0) N
//! assert!((net[0].force - Vector3::new(50.0, 900.0, 0.0)).norm() < 1e-12);
//! // (37): 0 − 1.6 m · 150 N + 1.6 m · 100 N about the vertical axis
//! assert!((net[0].torque - Vector3::new(0.0, 0.0, -80.0)).norm() < 1e-12);
//! ```
//!
//! # 7. Collision
//!
//! Bodies may not interpenetrate. Where they touch they either **bounce** or **stick**. The lecture
//! considers convex polyhedra.
//!
//! A vertex against a plane: free at `t₀`, below the plane at `t₀ + Δt`. The time of contact `t_c` lies
//! between them and has no closed form.
//!
//! - **Bisection** halves the interval, keeps the half with the change of sign, and stops when the point
//!   is within the tolerance `ε` of the plane.
//! - **Faster**: the straight line through the heights at both ends; where it crosses the plane is the
//!   next guess (secant, *regula falsi*).
//!
//! ```text
//! t = a + h_a (b − a) / (h_a − h_b)        heights h_a > 0 at a, h_b < 0 at b
//! ```
//!
//! Two things belong to the problem. A pass-through leaves no change of sign at the ends, and these
//! finders do not see it. And a body that has just bounced starts within `ε`: the search then begins
//! where it has left. Usually polyhedra meet polyhedra, and the same search runs on the distance of the
//! pair.
//!
//! The default goes beyond: the **guaranteed** finder proves every piece of the way free, from bounds of the
//! motions over it, and takes the secant as a proposal only. It misses nothing, however fast a body spins.
//!
//! | | in code |
//! |---|---|
//! | height over the plane | [`Collider::gap`](crate::closest::vertex_plane::Collider::gap) |
//! | time of contact | [`time_of_impact`](crate::impact::time_of_impact) of two bodies; [`find_impact`](crate::impact::find_impact) of a gap; every way to end: [`Outcome`](crate::impact::Outcome) |
//! | bisection, secant, guaranteed | [`Finder::Bisection`](crate::impact::Finder::Bisection), [`Finder::Secant`](crate::impact::Finder::Secant), [`Finder::Guaranteed`](crate::impact::Finder::Guaranteed) |
//! | `ε` | [`RunOptions::eps`](crate::scene::RunOptions::eps), [`tolerance::IMPACT_GAP`](crate::tolerance::IMPACT_GAP) |
//! | bounce, stick | [`Response`](crate::contact::Response) |
//!
//! # 8. Closest features: Lin–Canny
//!
//! The **features** of a polytope are its vertices, its edges and, in space, its faces. The **Voronoi
//! region** `V(F)` of a feature is the set of outside points that are closer to `F` than to any other
//! feature. In the plane, rays from each vertex at right angles to its two edges bound the regions: a
//! vertex has a cone, an edge a strip that is infinite on one side. In space the regions are bounded by
//! planes, each through a feature and one of its neighbours.
//!
//! - **Theorem 1.** If `a ∈ F_a` and `b ∈ F_b` are the closest points of two disjoint convex polytopes,
//!   then `a ∈ V(F_b)` and `b ∈ V(F_a)`.
//! - **Theorem 2**, which makes it an algorithm. If `a` and `b` are the closest points of two features
//!   and `a ∈ V(F_b)`, `b ∈ V(F_a)`, they are the closest points of the polytopes.
//!
//! So: start with any pair of features, find their closest points, test each against the other's
//! region; where a bounding plane is violated, step to the neighbour across it. The distance never
//! rises. Each step lowers it or, at equal distance, lowers the dimension of a feature, so the walk
//! ends. The regions are closed. One case needs more than a step: a vertex over the back of a face can
//! sit in a local minimum; one scan of all faces resolves it, by proving overlap or by a jump. A query
//! that starts with the pair of the step before takes nearly constant time when bodies move slowly.
//!
//! Overlap, where the plain algorithm cycles, parallel and coplanar features, and points on the bounds
//! of regions are where implementations fail. Here a step is taken only if it lowers the distance, so
//! no pair returns; overlap is measured by a polytope grown inside the difference of the bodies; and
//! every answer is checked: an interval that contains the true signed distance comes with it.
//!
//! | | in code |
//! |---|---|
//! | features and regions of a polygon | [`ConvexPolygon::voronoi_regions`](crate::shape::convex_polygon::ConvexPolygon::voronoi_regions) |
//! | the walk in the plane | [`closest_features_planar`](crate::closest::planar::closest_features_planar), with its [`path`](crate::closest::planar::PlanarClosest::path) |
//! | features of a polyhedron | [`ConvexPolyhedron`](crate::shape::convex_polyhedron::ConvexPolyhedron) |
//! | closest features in space, of any shapes | [`closest_features`](crate::closest::closest_features) |
//! | the pair to start from | [`PairCache`](crate::closest::PairCache) |
//!
//! # 9. Contact (beyond)
//!
//! The lecture announces contact forces and ends before them. Let bodies a and b touch at `p`, with the unit
//! normal `n` from a to b:
//!
//! ```text
//! r_a = p − x_a,   r_b = p − x_b
//! u = v_b(p) − v_a(p),   u_n = n·u                       u_n < 0: they approach
//! ```
//!
//! **Bounce** without friction, with restitution `e`: the impulse is `+j n` on b and `−j n` on a, and the
//! normal velocity becomes `−e u_n`:
//!
//! ```text
//! j = −(1 + e) u_n / (1/m_a + 1/m_b + n·[(I_a⁻¹ (r_a × n)) × r_a + (I_b⁻¹ (r_b × n)) × r_b])
//! ```
//!
//! A body that is held to a plane, a pivot or an axle answers an impulse along its freedoms B only, with the mobility
//! `Y = B (Bᵀ M B)⁻¹ Bᵀ` in the place of `1/m` and `I⁻¹`. For the hovercraft, whose plane has the normal `z`, that is
//!
//! ```text
//! j = −(1 + e) u_n / (1/m + (r × n)²_z/I_zz)
//! ```
//!
//! and a rod on an axle that is hit at the depth `I/(m c)`, c being that of its centre of mass, shakes its axle not at all:
//! the centre of percussion.
//!
//! **Stick**: the merged body has the sum of the momenta `P`, the sum of the angular momenta about the common
//! centre of mass, and the sum of the tensors moved there by the parallel-axis rule. The kinetic energy
//! lost is reported.
//!
//! **Break** (beyond): a joint carries the force `f = Σ (m a − F)` and the torque about it, summed over the bodies on one
//! of its sides; where either exceeds the pair's breaking load they part, with the motions that they have.
//!
//! **Rest** (Signorini): `gap ≥ 0`, `f_n ≥ 0`, `gap · f_n = 0`, and the same for `u_n` where the gap is closed.
//!
//! **Friction** (Coulomb): `|f_t| ≤ μ f_n`, a sliding force against the sliding velocity; in an impact
//! the cone holds for the whole impulse.
//!
//! In a run all bodies that touch at an instant are answered at once. Bounces that come ever faster end when
//! their geometric series does; what has no speed left along the normal then rests, slides, rolls or tips by
//! the forces of contact. A body that sticks to a fixed one stops there, to a moved one rides on it; two that
//! stick to each other go on as one, in closed form where gravity alone acts. Where this version cannot follow
//! a contact, the run ends in [`LastingContact`](crate::simulation::Failure::LastingContact) with all that was
//! computed.
//!
//! | | in code |
//! |---|---|
//! | mobility of a body of fewer freedoms | [`Mobility::within`](crate::contact::cluster::Mobility::within) |
//! | bounce | [`contact::bounce::bounce`](crate::contact::bounce::bounce), of several bodies [`contact::collision::collide`](crate::contact::collision::collide) |
//! | rest, sliding | [`contact::rest::rest`](crate::contact::rest::rest) |
//! | accumulation | [`contact::accumulation`](crate::contact::accumulation) |
//! | stick | [`contact::stick::stick`](crate::contact::stick::stick), of two that move [`contact::stick::merge`](crate::contact::stick::merge) |
//! | load of a joint | [`contact::joint::carried`](crate::contact::joint::carried) |
//! | sum of tensors | [`MassProperties::combined`](crate::mass::MassProperties::combined) |
//! | restitution of a pair | [`Material::of_pair`](crate::contact::Material::of_pair) |
//! | what happened | [`Event`](crate::trajectory::Event) |
