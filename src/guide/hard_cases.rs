//! Motions on which methods break, what is true of them, and where that is tested.
//!
//! Every line below is a test of the suite; those with more steps than a suite has time for run by
//! `cargo test --release --all-features -- --ignored`. Truth is the formula beside it, or a motion recorded to 28
//! digits by a program of its own (`tests/data`).
//!
//! # Rotation without torque (`tests/hard_cases/free.rs`, `tests/free_rotation.rs`)
//!
//! | case | why it is hard | what is asked |
//! |---|---|---|
//! | spin about the middle axis, 1e-6 and 1e-12 off it | errors grow as `e^(λt)`, `λ² = ω² (I₂−I₁)(I₃−I₂)/(I₁I₃)`, between flips `2K(k)/Ω` apart | the tolerance up to the horizon, flips within 1e-9 s; the closed form through every flip |
//! | the separatrix, and just beside it | the period goes to infinity | the same; the closed form to 4 ε a radian |
//! | needle (10⁶ : 1), disc, thin plate | fast wobble of a slow body | steps that go with the angle turned, not with `1/I` |
//! | near-spheres, symmetric to 1e-16 … 1e-2 | differences of moments cancel, series change branch | the closed form to 4 ε a radian, without a step |
//! | 10⁴ rad/s | thousands of radians in the span | the tolerance; the closed form to 4 ε a radian |
//! | largest and least axis, 1e8 steps | a drift of energy tips the body over | L leans by `√((1/I_j − 1/I)/(1/I_k − 1/I))` of its start at most |
//! | a thin body, 1e7 steps of 1 ms | the gyroscopic term of explicit engines gains energy until they diverge | energy within a tenth, with every method of order 2 and more |
//!
//! ```
//! use bryla::math::{Matrix3, Vector3};
//! use bryla::{Body, Measure, RunOptions, Scene, UserEvent};
//!
//! // a body of moments 1, 2, 3 spun about its middle axis flips every 2 K(k)/Ω (Landau, Lifshitz, Mechanics, §37)
//! let (moments, l) = ([1.0, 2.0, 3.0], [1e-6, 2.0, 3e-6]);
//! let beyond = |i: f64| (0..3).map(|j| l[j] * l[j] * (1.0 - i / moments[j])).sum::<f64>(); // L² − 2 E I
//! let rate = (beyond(moments[0]) / 6.0).sqrt();
//! let (mut a, mut b) = (1.0, (2.0 * beyond(moments[1]) / beyond(moments[0])).sqrt());
//! for _ in 0..10 {
//!     (a, b) = (0.5 * (a + b), (a * b).sqrt()); // the mean that gives K
//! }
//! let apart = std::f64::consts::PI / (a * rate);
//!
//! let mut scene = Scene::new();
//! let inertia = Matrix3::from_diagonal(&Vector3::from(moments));
//! scene.add(Body::with_inertia("book", 1.0, inertia).angular_velocity([1e-6, 1.0, 1e-6]))?;
//! let flip = UserEvent::new("flip", Measure::AngularVelocityBody([0.0, 1.0, 0.0]), ["book"]);
//! let run = scene.run(0.0..200.0, &RunOptions::tolerance(1e-10).event(flip))?;
//! let flips: Vec<f64> = run.events().iter().map(|event| event.time).collect();
//! assert!(flips.len() > 2 && flips.windows(2).all(|pair| (pair[1] - pair[0] - apart).abs() < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Tops and driven bodies (`tests/hard_cases/tops.rs`, `driven.rs`)
//!
//! | case | why it is hard | what is asked |
//! |---|---|---|
//! | a general heavy top, one that tumbles over, fast and slow ones | no closed form | the tolerance; `E` and `L_z` within it |
//! | Kovalevskaya's top, `I₁ = I₂ = 2I₃` | two equal moments, whose principal axes rounding chooses | `\|(ω₁+iω₂)² − c(γ₁+iγ₂)/I₃\|²` kept |
//! | Goryachev's and Chaplygin's, `I₁ = I₂ = 4I₃`, `L_z = 0` | the same | `ω₃(ω₁²+ω₂²) − cω₁γ₃/I₃` kept |
//! | a sleeping top 1 % above its limit `L₃² = 4I₁mgr` | sleeps, but trembles | leans by `θ₀L₃/√(L₃² − 4I₁mgr)` at most |
//! | the same 1 % below | wakes as `e^(λt)` | falls to the root of `β(1−u²) = a²(cos θ₀ − u)` |
//! | spun up from rest, shaken by a sine, damped, all at once | `L = 0` at the start, torques of their own period | the tolerance |
//! | drag that would dictate the step | stiff | the implicit method, by the plan's choice |
//!
//! # Flights (`tests/hard_cases/flights.rs`, `tests/behaviour/events.rs`)
//!
//! | case | what is asked |
//! |---|---|
//! | a throw through air | its top at `v∞/g atan(v/v∞)` to the tolerance; without air to 64 ulp |
//! | an orbit of eccentricity 0.6 | Kepler's equation to 1e-9, while the body turns on its closed form |
//! | a satellite that gravity's gradient throws about | a horizon, and two methods that agree up to it |
//! | an engine over six switches on a turning hull | 1e-10 m; as a free body in the plane to 1e-13 m |
//!
//! # Impacts (`tests/behaviour/impacts.rs`, `tests/contact`, `tests/impact_oracle`)
//!
//! | case | formula |
//! |---|---|
//! | a corner on a plane, off centre | `j = −(1+e) v_n/(1/m + n·(I⁻¹(r×n))×r)` |
//! | a thin rod on one end | the same with `I = ml²/12` |
//! | cubes head on, a flat elastic cube on its face | velocities swap, no spin, ever |
//! | a hovercraft on a wall, in its plane | `j = −(1+e) u_n/(1/m + (r × n)²_z/I_zz)`, its normal no principal axis |
//! | a swinging rod on a ball | no shock to the axle at the depth `I/(mc)` |
//! | a ball on a door | `j = (1+e) v/(1/m + d²/I)` |
//! | an elastic pendulum at a wall where it hangs | the mirror image of its swing, and an estimate that holds |
//! | twenty bounces, and the end of the series | `v₀ eⁿ`; at `t = (1+e)/(1−e) v₀/g` after the drop from rest |
//! | an oblique ball | grip: `j_t = v_t/(1/m + r²/I)`; slip: `j_t = μ j_n` of the whole impulse |
//! | a cradle, an unequal chain, three that meet symmetrically | momentum and energy, and the mirror |
//! | an elastic cube into a corner | comes straight back |
//! | a bullet at a thin plate, a rod of 1000 rad/s at a wall | no pass through; the instant of the tip |
//! | a block over its edge | `ω² = 2mg(h₀ − h)/I` about that edge |
//!
//! # Contacts that last (`tests/behaviour/rest.rs`, `rolling.rs`, `edges.rs`)
//!
//! | case | formula |
//! |---|---|
//! | a ball or a cylinder rolls over the edge of a table | leaves it at `cos φ = (2 + j v²/(g R))/(2 + j)`, j = 7/5 or 3/2; j = 1 without friction |
//! | the same with friction, which it overcomes before | an ordinary equation from `(1 − 1/j) g sin φ = μ n` to `n = 0` |
//! | a ball over a ridge and down the other side | `(5/7) g sin α` on both, the edge's energy between |
//! | a ball past the end of an edge | a point on a sphere about the corner |
//! | a box slides off a table | tips about the edge from `s = −μ b` on, by an ordinary equation |
//! | a log across a log | a straight line rocking on a circle |
//! | an egg, a coin in a circle, a cone about its apex | rolling in the plane, steady precession |
