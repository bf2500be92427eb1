//! What accuracy costs: what a method keeps and loses, how its error is known, what a digit takes.
//!
//! A run asks for accuracy in one of two ways:
//!
//! ```text
//! tolerance                 the step is found; the report says whether the result kept the tolerance
//! method and step           that method with that step, the lecture's included; the error is estimated
//! ```
//!
//! With neither, the tolerance is 1e-6. See [`RunOptions`](crate::scene::RunOptions).
//!
//! # Methods
//!
//! | method | order | evaluations a step | angular momentum in | made for |
//! |---|---|---|---|---|
//! | [`Euler`](crate::integrator::Method::Euler) | 1 | 1 | world axes | the lecture's first step, and its warning |
//! | [`SemiImplicitEuler`](crate::integrator::Method::SemiImplicitEuler) | 1 | 1 | world axes | the step of the lecture's hovercraft |
//! | [`Heun`](crate::integrator::Method::Heun) | 2 | 2 | world axes | the lecture's second |
//! | [`Rk4`](crate::integrator::Method::Rk4) | 4 | 4 | body axes | short runs with a given step |
//! | [`Tsit5`](crate::integrator::Method::Tsit5) | 5 | 6 | body axes | steps that follow an error, 1e-3 to 1e-7 |
//! | [`Dop853`](crate::integrator::Method::Dop853) | 8 | 12 | body axes | the same, below; what a plan takes where there is no closed form, nothing is stiff, and the motion not that long |
//! | [`Split2`](crate::integrator::Method::Split2) | 2 | 2 | body axes | long runs: keeps `L`'s length of a free body, and the energy within bounds |
//! | [`Split4`](crate::integrator::Method::Split4) | 4 | 6 | body axes | the same |
//! | [`Split6`](crate::integrator::Method::Split6) | 6 | 10 | body axes | the same, loads without velocities; what a plan takes where a conservative motion goes over 3,000 turns and more at 2e-9 or less |
//! | [`Split8`](crate::integrator::Method::Split8) | 8 | 18 | body axes | the same, loads without velocities |
//! | [`Axes2`](crate::integrator::Method::Axes2) | 2 | 2 | body axes | the simplest splitting, rotations about three axes |
//! | [`Cf4`](crate::integrator::Method::Cf4) | 4 | 4 | world axes | stays on the rotations without projection |
//! | [`Buss2`](crate::integrator::Method::Buss2) | 2 | 2 | world axes | what games use |
//! | [`Radau5`](crate::integrator::Method::Radau5) | 5 | 3 an iteration | body axes | stiff loads: strong drag does not dictate the step; what a plan takes where it would |
//! | [`Taylor`](crate::integrator::Method::Taylor) | 3 to 40 | 1 series | body axes | 1e-8 and below, loads that are power series: gravity, engines, wrenches, drag in proportion to the speed; what a plan takes at 1e-9 and below where none of them swings or attracts to a point, and no error is estimated |
//! | [`Dmv`](crate::integrator::Method::Dmv) | 2 to 10 | 1 equation | body axes | long runs without torque: keeps `L`'s length and the energy |
//! | [`Exact`](crate::integrator::Method::Exact) | – | 0 | – | free bodies, uniform gravity, linear drag: what a plan takes where it can |
//!
//! Order p: half the step, 2ᵖ times less error. An evaluation is one of `Y′` with all loads; the slope at
//! the end of a step serves the next.
//!
//! What that means for a block that tumbles freely for one second, 6, 5 and 4 rad/s about its three axes.
//! The error is that of the end state, in radians:
//!
//! | method | 257 evaluations | 1025 evaluations | 4097 evaluations |
//! |---|---|---|---|
//! | Euler, semi-implicit Euler | 0.17 | 0.043 | 0.011 |
//! | Heun | 7.1e-3 | 4.4e-4 | 2.7e-5 |
//! | Runge–Kutta | 2.2e-6 | 8.8e-9 | 3.4e-11 |
//!
//! ```
//! use bryla::{Body, CompareOptions, Cuboid, Method, Scene};
//!
//! let mut scene = Scene::new();
//! let block = Body::new("block", Cuboid::new([0.15, 0.10, 0.05])).density(1000.0);
//! scene.add(block.angular_velocity([6.0, 5.0, 4.0]))?;
//!
//! let steps = vec![1.0 / 256.0, 1.0 / 512.0, 1.0 / 1024.0];
//! let table = scene.compare(0.0..1.0, &CompareOptions { steps, repeats: 1, ..Default::default() })?;
//! for row in table.rows.iter().filter(|row| row.evaluations == 1025) {
//!     let expected = match row.method {
//!         Method::Euler | Method::SemiImplicitEuler => 0.04252,
//!         Method::Heun => 4.358e-4,
//!         Method::Rk4 => 8.784e-9,
//!         _ => continue,
//!     };
//!     let error = row.error.unwrap_or(f64::NAN);
//!     assert!((error / expected - 1.0).abs() < 1e-3, "{}: {error:e}", row.method); // four digits are printed
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What they keep and lose
//!
//! - **Momentum**. `P` changes by the sum of the forces, in every method. `L` of a free body stays to the
//!   last bit in methods in world axes, for it is a part of their `Y` that nothing changes (what is read
//!   back from ω differs by rounding). In body axes `L` must turn against the body, and its error
//!   is of the method's order.
//! - **Energy** of a tumbling body is kept by none. With Euler's method it climbs; since `L` stays, it
//!   climbs until the body turns about its axis of least inertia, where that `L` has the most energy. With
//!   Heun's and Runge and Kutta's method it swings by an amount of the method's order, and has a trend
//!   besides, from which halving the step takes 8 and 32 times. No trend is bounded.
//! - **Semi-implicit Euler** differs from Euler's method only where loads act: of a free body it gives
//!   the same motion. Where forces come from a potential, the energy of the translation swings and does
//!   not climb.
//! - **A parabola** is exact with Heun's and Runge and Kutta's method. Euler's method ends `½ g h t` too
//!   high, the semi-implicit one as much too low.
//! - **A spin about a fixed axis** is no test: there normalised Euler turns by `2 atan(½ ω h)` a step, which
//!   has order 2.
//!
//! ```
//! use bryla::math::{Vector3, quaternion};
//! use bryla::{Body, Cuboid, Method, Record, RunOptions, Scene, Sphere, UniformGravity};
//!
//! // the block again, for 40 s: mean energy of the last quarter less that of the first, over the energy
//! let mut scene = Scene::new();
//! let block = Body::new("block", Cuboid::new([0.15, 0.10, 0.05])).density(1000.0);
//! scene.add(block.angular_velocity([6.0, 5.0, 4.0]))?;
//! let trend = |method: Method, steps: f64| -> Result<f64, Box<dyn std::error::Error>> {
//!     let times: Vec<f64> = (0..=4000).map(|i| f64::from(i) * 0.01).collect();
//!     let options = RunOptions::method(method).step(1.0 / steps).estimate(false);
//!     let run = scene.run(0.0..40.0, &options.t_eval(times).record(Record::Samples))?;
//!     let energy = run.energy()?.kinetic;
//!     let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
//!     Ok((mean(&energy[3000..4000]) - mean(&energy[..1000])) / energy[0])
//! };
//! for (method, divisor) in [(Method::Heun, 8.0), (Method::Rk4, 32.0)] {
//!     let ratio = trend(method, 128.0)? / trend(method, 256.0)?;
//!     assert!((ratio / divisor - 1.0).abs() < 0.02, "{method}: {ratio}");
//! }
//! assert!(trend(Method::Euler, 256.0)? > 0.5); // past all use
//!
//! // a throw of 1 s: Euler's method off by ½ g h t
//! let (h, g) = (1.0 / 64.0, 10.0);
//! let mut throw = Scene::new();
//! throw.add(Body::new("ball", Sphere::new(0.1)).mass(1.0).velocity([1.0, 0.0, 3.0]))?;
//! throw.add_effect(UniformGravity::new([0.0, 0.0, -g]));
//! for (method, off) in [
//!     (Method::Euler, 0.5 * g * h),
//!     (Method::SemiImplicitEuler, -0.5 * g * h),
//!     (Method::Heun, 0.0),
//!     (Method::Rk4, 0.0),
//! ] {
//!     let run = throw.run(0.0..1.0, &RunOptions::method(method).step(h))?;
//!     let height = run.named("ball")?.position(1.0)?.z;
//!     assert!((height - (3.0 - 0.5 * g) - off).abs() < 1e-13, "{method}: {height}");
//! }
//!
//! // a spin of 4 rad/s for 1 s, with Euler's method: angle 64 · 2 atan(½ ω h), and |q| as if unprojected
//! let mut spin = Scene::new();
//! spin.add(Body::new("ball", Sphere::new(0.1)).mass(1.0).angular_velocity([0.0, 0.0, 4.0]))?;
//! let options = RunOptions::method(Method::Euler).step(h);
//! let run = spin.run(0.0..1.0, &options)?;
//! let q = run.named("ball")?.at(1.0)?.orientation;
//! let turned = quaternion::from_axis_angle(&Vector3::z(), 128.0 * (0.5 * 4.0 * h).atan());
//! assert!(quaternion::angle_between(&q, &turned) < 1e-13);
//!
//! // |q| grows by √(1 + ¼ ω² h²) a step: with projection that is the drift, without it its 64th power
//! let growth = (1.0 + 4.0 * h * h).sqrt();
//! assert!((run.report().counts.orientation_drift - (growth - 1.0)).abs() < 1e-15);
//! let loose = spin.run(0.0..1.0, &options.projection(false))?;
//! assert!((loose.report().counts.orientation_drift - (growth.powi(64) - 1.0)).abs() < 1e-13);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # World axes or body axes
//!
//! The lecture's `Y` holds `L` in world axes, with `q` (13 numbers) or `R` (18 numbers, the option
//! [`orientation`](crate::scene::RunOptions::orientation)): `dL/dt = M`, and `L` stands still while the
//! inertia turns beneath it. In body axes ([`Form::Body`](crate::freedom::Form::Body)) the inertia stands still and
//! `dL/dt = L × ω + M`: a steady spin is an exact fixed point, and the error of a large component of `L`
//! does not leak into a small one. Results are in world axes either way.
//!
//! Bodies that move in a plane or about an axle have an angle as coordinate: nothing to project, and a
//! steady spin is exact in every method. See [`freedom`](crate::freedom).
//!
//! # Projection
//!
//! A step leaves `q` off the unit sphere (`R` off the rotations). The right-hand side always uses the
//! rotation of `q/|q|`, so that the stray length itself does no harm; the next step divides `q` by its
//! length, and `R` is replaced by its polar factor at once. The largest stray before that is
//! [`Counts::orientation_drift`](crate::integrator::Counts::orientation_drift), a free measure of how rough
//! the steps are. With [`projection`](crate::scene::RunOptions::projection) off, it adds up for all to see.
//!
//! # Between the steps
//!
//! The motion within a step is one polynomial ([`Segment`](crate::integrator::Segment)), with orientations
//! normalised where they are read: the cubic through both ends and their slopes (off by h⁴), in `Tsit5` and
//! `Dop853` their own of order 4 and 7, in `Taylor` the series of the step, in the closed form the motion itself. Samples, energies and contacts all
//! read that one, so they agree with each other. It is made only of steps that someone looks into.
//!
//! # What costs order
//!
//! A method has its order where the motion is smooth.
//!
//! - **Switches** cost nothing: the step before a [schedule](crate::effect::Schedule)'s time ends on it, and so does
//!   the step before the instant at which the state turns a load on or off ([`Switch`](crate::effect::Switch)). That
//!   instant is searched for along the motion of the step, and corrected with steps of the method itself, so that it is
//!   as good as the method and not only as the motion between the steps.
//! - **Events** ([`UserEvent`](crate::scene::UserEvent)) are searched for along the same motion and change nothing.
//! - **Corners of a load** cost: quadratic drag `|ω| ω` has one where ω passes 0. In
//!   `examples/scenes/hovercraft.toml` Runge and Kutta's method loses its order below 0.1 s for that
//!   reason (`bryla compare`: 9.4e-8 at 0.1 s, 3.8e-9 at 0.025 s); with `angular_quadratic = 0` it has order
//!   4.0 throughout.
//! - **Impacts** are found on the motion within the step, to a gap of `ε`, so they keep the order. But each
//!   bounce multiplies the error before it: in `examples/scenes/bouncing_die.toml`, four bounces in
//!   0.9 s, order 4 appears only from 0.4 ms on. The finders of the lecture may even miss a contact, by
//!   passing through and back within one step; the guaranteed one does not.
//! - **Contacts that last** are led in steps of order 4 under the contacts' own forces; a slip that ends and a
//!   point that touches anew are located within them. A slide that begins from rest takes steps of first order
//!   until it is fast, for the direction of friction is stiff there. Bodies rest exactly where they are.
//! - **Bounces that accumulate** are followed until they rise by less than 1e-10 of the bodies' size; when they
//!   would have ended is told by their series.
//!
//! Passes of a run with impacts differ in their steps and in ε. Their bounces are matched pair by pair, and
//! where the first has no partner in the other pass the **horizon** ends: from there on the run is one of
//! several that the error allows, as dice are. Up to there twice the difference of the passes is the estimate;
//! velocities do not count, for at an impact they jump.
//!
//! # The error of the result
//!
//! The error is that of the **result**, not of a step: the larger of
//!
//! ```text
//! |x − x_true| / length_scale        and        the angle from q_true to q [rad]
//! ```
//!
//! over all bodies and samples. [`length_scale`](crate::report::Report::length_scale) is the larger of
//! the largest body (the reach of its shape from its centre of mass) and the longest path (distance of a
//! sample from the start), unless the options name one; the report echoes it.
//!
//! It is estimated by comparing runs (Richardson): with r the ratio of the steps, p the order,
//!
//! ```text
//! error of the finer run ≈ |fine − coarse| / (rᵖ − 1) + rounding
//! ```
//!
//! That holds where both steps are short enough for the error to fall as its order says. A run with
//! method and step takes its second run with twice the step and believes the order;
//! [`estimate`](crate::scene::RunOptions::estimate) switches it off. A run to a tolerance looks at three runs,
//! sees how the differences fall, and trusts no more than that. In closed form nothing but rounding is left:
//! 4 ε for every radian turned.
//!
//! An unstable motion magnifies roundings, also those that all runs have in common, such as those of the moments of
//! inertia. So where bodies meet nothing, the coarser runs are nudged: their numbers are a few ε off at the start, and
//! their changes in every step (at random, from a fixed seed), by as much more as their errors are larger. What the finer
//! run's roundings do then shows in the differences.
//!
//! A second measure costs no run: the energy audit of
//! [`Trajectory::energy`](crate::trajectory::Trajectory::energy). Kinetic + potential + dissipated − work should stay;
//! [`Energy::drift`](crate::trajectory::Energy::drift) is how far it went. It knows nothing of errors that keep the
//! energy.
//!
//! # A tolerance
//!
//! Where the motion has a closed form, that is the result. Else a first run takes steps as long as their own
//! error allows (methods with error control; the others begin with steps in which the fastest body turns by
//! 0.25 rad at most), and two more runs cut each of its steps in two and in four. How the three differ gives the
//! estimate, as above. Where it misses the tolerance, the steps that the estimate and the order call for are
//! taken, until it keeps it. The finest run is the result. A load with a kink, such as quadratic drag where
//! the body turns round, is met by a step that ends on it. The [report](crate::report::Report) says
//!
//! - `error_estimate`, of the samples up to the horizon;
//! - `met`, whether the estimate keeps the tolerance over the whole span;
//! - `horizon`, the last sample up to which it does. Chaos raises no error: the digits of a tumbling
//!   book end somewhere, and the horizon says where;
//! - `seconds`, apart for the run whose result is kept and for those it was compared with.
//!
//! A tolerance below what rounding leaves is refused before the first step: `64 ε` for the positions and for
//! every radian that the fastest body would turn at its starting rate. The search gives up, with `met = false`, where
//! the next run would need more than 2e7 steps, and after 24 rounds of three; the last round that went to its end
//! is the result.
//!
//! # Comparing
//!
//! [`Scene::compare`](crate::scene::Scene::compare) (on the command line `bryla compare`) runs every method with
//! every step, those that control their error also with every tolerance (`tolerances`), and lists
//!
//! - the error of the **end state**, in the measure above, against the method of highest order with a
//!   step a quarter of the shortest compared, halved further as long as its own estimated error falls.
//!   That error is stated; errors below ten times it are printed as `<`;
//! - evaluations of `Y′`, which compare machines, and steps;
//! - processor time of the thread, least and median of the repeats, for that run alone: no estimate, no
//!   samples but the ends;
//! - the order that two steps after each other show. Near the order of the method the errors can be
//!   believed; elsewhere the step is too long, the motion not smooth, or rounding reached.
//!
//! # Bits
//!
//! The same scene gives the same bits on every run: transcendental functions are `libm`'s, sums have a fixed
//! order. Time is summed with its rounding error kept ([`Time`](crate::math::sum::Time)). A
//! [simulation](crate::simulation::Simulation) advanced in pieces, or saved and resumed, goes on with the
//! same bits as one advanced at once. Functions of the user are exempt.
