//! The scene file: every table and key, with its unit, what it means, and what holds if it is left out.
//!
//! A scene is plain data. It is written in **TOML** (`.toml`), for people, or in **JSON** (`.json`), for
//! programs; both hold the same model, and [`Scene`](crate::scene::Scene) reads and writes both.
//! Units are SI, angles radians, quaternions `(w, x, y, z)`; a key that ends in `_body` is in body axes, every
//! other vector in world axes. Unknown names are refused, with the line, a caret and the names that are allowed.
//!
//! ```
//! use bryla::Scene;
//! use bryla::scene::file::Format;
//!
//! let text = r#"
//!     [run]
//!     t_span = [0.0, 1.0]
//!
//!     [[bodies]]
//!     name = "ball"
//!     shape.sphere.radius = 0.1
//!     mass = 0.5
//!
//!     [[effects]]
//!     uniform_gravity.acceleration = [0.0, 0.0, -9.81]
//! "#;
//! let scene = Scene::from_text(text, Format::Toml)?;
//! assert_eq!(scene.bodies[0].mass, Some(0.5));
//! let json = scene.to_text(Format::Json)?;
//! assert_eq!(Scene::from_text(&json, Format::Json)?, scene);
//!
//! let mistyped = text.replace("radius", "raduis");
//! let refusal = Scene::from_text(&mistyped, Format::Toml).unwrap_err().to_string();
//! assert!(refusal.contains("unknown field `raduis`, expected `radius`"), "{refusal}");
//! # Ok::<(), bryla::Error>(())
//! ```
//!
//! The same scene in JSON:
//!
//! ```json
//! {
//!   "run": { "t_span": [0.0, 1.0] },
//!   "bodies": [{ "name": "ball", "shape": { "sphere": { "radius": 0.1 } }, "mass": 0.5 }],
//!   "effects": [{ "uniform_gravity": { "acceleration": [0.0, 0.0, -9.81] } }]
//! }
//! ```
//!
//! | table | holds |
//! |---|---|
//! | [`bodies`](#bodies) | a list: what is there |
//! | [`effects`](#effects) | a list: what acts on it |
//! | [`run`](#run) | how to run it, where a call does not say otherwise |
//!
//! Nothing runs unasked: no gravity, no drag, no floor unless one is written down. `bryla check` reads a
//! file and says what is wrong with it; `bryla schema` prints the JSON Schema, with which editors
//! complete and check as one types.
//!
//! # bodies
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `name` | | must be given | a name that no other body has |
//! | `shape` | | none | the solid; see [Shapes](#shapes) |
//! | `density` | kg/m³ | | uniform density |
//! | `mass` | kg | | mass, instead of the density or beside `inertia` |
//! | `inertia` | kg·m² | that of the uniform solid | 3 rows of 3, about the centre of mass, body axes |
//! | `position` | m | `[0, 0, 0]` | where the centre of mass starts; of a fixed body, the origin of its shape |
//! | `origin` | m | | where the origin of the shape's axes starts, instead of `position` |
//! | `orientation` | – | `[1, 0, 0, 0]` | rotation from body to world axes; of length 1 to within 1e-3, then divided by it |
//! | `velocity` | m/s | 0, or what the freedom asks for | velocity of the centre of mass |
//! | `angular_velocity` | rad/s | 0 | angular velocity |
//! | `angular_velocity_body` | rad/s | | the same in body axes, instead of `angular_velocity` |
//! | `friction` | – | 0 | coefficient of friction μ, ≥ 0; a pair has the geometric mean of both |
//! | `restitution` | – | 0 | coefficient of restitution, 0 to 1; a pair has the larger of both |
//! | `response` | | `"bounce"` | `"bounce"` or `"stick"`; a pair sticks if either body says so |
//! | `breaking_load` | N, N·m | never | `force` and `torque` under which what has stuck comes off; of a pair the weaker counts |
//! | `fixed` | | `false` | whether the body stays where it is |
//! | `motion` | | absent | the motion that the body is moved along; see [Prescribed motion](#prescribed-motion) |
//! | `freedom` | | `"free"` | how it may move; see [Freedom](#freedom) |
//! | `collides` | | `true` | whether its shape meets other bodies; if not, it serves for the mass alone |
//!
//! A body that moves needs a density, or a mass, or a mass and an inertia; without a shape, the last. A
//! fixed body needs a shape, and no velocity. Body axes are the axes of the shape.
//!
//! Every two bodies with shapes, of which one can move, may meet, until one of them says
//! `collides = false`. Free bodies bounce off each other and off fixed ones, with friction; they rest, slide,
//! roll and tip on each other. What sticks to a fixed body stops; two that stick to each other are one body from
//! there on, which flies, bounces and sticks as one, while each keeps its name in events and samples. What the point
//! of contact must carry for them to stay together follows from their motion and from what acts on them; where this
//! exceeds the `force`, or the `torque` about that point, both sides go on as they move, and stick again where they
//! meet again at a speed. A blow lasts no time and breaks nothing. What may come off cannot stay in contact with
//! others, nor carry what sticks to it while it hangs on something fixed: such a run ends by name. Bodies of
//! fewer freedoms bounce, rest and slide like others, but stick to nothing, which is refused by name. Balls and the sides
//! of cylinders and capsules roll over edges and corners, and on each other. A run ends, with all that was computed, where
//! an egg, a cone or the rim of a cylinder comes to an edge, or anything to a curve other than those, as an egg to an egg,
//! and where a body sticks that an effect joins to others in flight.
//!
//! ```toml
//! [[bodies]]
//! name = "table"
//! shape.half_space = { normal = [0.0, 0.0, 1.0], offset = 0.0 }
//! fixed = true
//! restitution = 0.6
//!
//! [[bodies]]
//! name = "die"
//! shape.cuboid.half_extents = [0.008, 0.008, 0.008]
//! density = 1200.0
//! position = [0.0, 0.0, 0.5]
//! orientation = [0.8, 0.6, 0.0, 0.0]
//! velocity = [0.6, 0.0, 0.0]
//! angular_velocity_body = [20.0, 30.0, 10.0]
//! friction = 0.3
//! restitution = 0.5
//! response = "bounce"
//!
//! # known by its numbers alone
//! [[bodies]]
//! name = "satellite"
//! mass = 120.0
//! inertia = [[20.0, 0.5, 0.0], [0.5, 25.0, 0.0], [0.0, 0.0, 30.0]]
//! position = [0.0, 0.0, 7.0e6]
//! ```
//!
//! # Shapes
//!
//! A shape is a table under its name, such as `shape.sphere.radius = 0.1`. All lengths are in m and must be
//! given, unless a default is named.
//!
//! | shape | keys | origin and axes |
//! |---|---|---|
//! | `cuboid` | `half_extents`: half of each edge | in its centre, edges along the axes |
//! | `sphere` | `radius` | in its centre |
//! | `cylinder` | `radius`, `half_height` | in its centre, axis along z |
//! | `capsule` | `radius`, `half_height` of the cylinder (0 makes a ball) | in its centre, axis along z |
//! | `cone` | `radius` of the base, `half_height` | half way up, apex at `z = half_height`; the centre of mass lies at `z = −half_height/2` |
//! | `ellipsoid` | `semi_axes` along x, y, z | in its centre |
//! | `half_space` | `normal` (–, any length but 0, out of the solid), `offset` (m for a normal of length 1) | all points with `normal · x ≤ offset`; only for fixed bodies |
//! | `polyhedron` | `vertices`; `faces`, lists of numbers of vertices from 0, counterclockwise seen from outside | that of the vertices |
//! | `mesh` | `path` of an `.stl` or `.obj` file, relative to the scene file; `scale`, metres per unit of the file (default 1) | that of the file |
//! | `compound` | `pieces`, a list of tables: `shape`, `position` (m, default 0), `orientation` (default `[1, 0, 0, 0]`), both in the compound's axes | that of the compound |
//!
//! A polyhedron may be concave or hollow; its surface must be closed. Where pieces of a compound overlap,
//! their matter counts twice. Reading a mesh needs the feature `mesh`, which the command line has.
//!
//! ```toml
//! [[bodies]]
//! name = "pin"
//! shape.cone = { radius = 0.02, half_height = 0.05 }
//! density = 700.0
//! origin = [0.0, 0.0, 0.05]   # the base on the ground
//! collides = false
//!
//! [[bodies]]
//! name = "tetrahedron"
//! density = 1000.0
//! collides = false
//!
//! [bodies.shape.polyhedron]
//! vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
//! faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
//!
//! [[bodies]]
//! name = "hammer"
//! density = 1000.0
//! collides = false
//!
//! [[bodies.shape.compound.pieces]]
//! shape.cylinder = { radius = 0.015, half_height = 0.15 }
//!
//! [[bodies.shape.compound.pieces]]
//! shape.cuboid.half_extents = [0.05, 0.02, 0.02]
//! position = [0.0, 0.0, 0.17]
//! orientation = [0.0, 0.0, 0.0, 1.0]
//! ```
//!
//! ```toml
//! [[bodies]]
//! name = "wrench"
//! shape.mesh = { path = "wrench.stl", scale = 0.001 }   # drawn in millimetres
//! density = 7800.0
//! ```
//!
//! # Freedom
//!
//! | freedom | keys | numbers integrated |
//! |---|---|---|
//! | `"free"` | | 13 (18 with orientations as matrices) |
//! | `planar` | `normal` of the plane, world axes, any length but 0 | 6: motion in the plane through its start, rotation about the normal |
//! | `pivot` | `point_body` that rests, from the centre of mass (m) | 7 (12): rotation about the point |
//! | `axle` | `point_body` of the axis, from the centre of mass (m, default 0); `axis_body`, any length but 0 | 2: rotation about the axis |
//!
//! The start must fit: no velocity out of the plane, no rotation about another axis. With a pivot or an axle
//! leave `velocity` out, it follows from the rotation. Such a body takes an impulse as its freedom lets it: what a plane, a
//! pivot or an axle adds to it is in no event, but in what the velocities of both bodies have changed by.
//!
//! ```toml
//! [[bodies]]
//! name = "puck"
//! mass = 0.16
//! shape.cylinder = { radius = 0.04, half_height = 0.0125 }
//! velocity = [2.0, 0.0, 0.0]
//! angular_velocity = [0.0, 0.0, 15.0]
//! freedom.planar.normal = [0.0, 0.0, 1.0]
//! collides = false
//!
//! [[bodies]]
//! name = "top"
//! density = 800.0
//! shape.cone = { radius = 0.03, half_height = 0.03 }
//! angular_velocity_body = [0.0, 0.0, 180.0]
//! freedom.pivot.point_body = [0.0, 0.0, 0.045]   # its apex
//! collides = false
//!
//! [[bodies]]
//! name = "pendulum"
//! mass = 1.0
//! shape.cuboid.half_extents = [0.01, 0.01, 0.25]
//! freedom.axle = { point_body = [0.0, 0.0, 0.25], axis_body = [0.0, 1.0, 0.0] }
//! collides = false
//! ```
//!
//! # Prescribed motion
//!
//! | key of `motion` | unit | default | meaning |
//! |---|---|---|---|
//! | `velocity` | m/s | 0 | velocity of the point `center` of the body, world axes |
//! | `angular_velocity` | rad/s | 0 | angular velocity, world axes |
//! | `center` | m | the shape's origin | the point that the body turns about, shape axes |
//! | `schedule` | s, – | always 1 | pairs of time and factor of both velocities: 0 before the first, held after the last |
//!
//! Such a body is where its motion says, whatever it meets: a turntable, a conveyor, a lift, a bat. `position` and
//! `orientation` are those at time 0. It needs a shape and no mass; what it does to others is the `work` in the
//! energies of the run. Others bounce off it, rest on it, slide and are carried along. No effect and no event
//! names it. What sticks to it rides on it, until it runs into what no force moves, or something stays in contact with
//! what rides: there a run ends by name.
//!
//! ```toml
//! [[bodies]]
//! name = "turntable"
//! shape.cylinder = { radius = 0.15, half_height = 0.01 }
//! friction = 0.6
//! motion = { angular_velocity = [0.0, 0.0, 3.5], schedule = [[0.5, 1.0], [4.0, 0.0]] }   # from 0.5 s to 4 s
//! ```
//!
//! # effects
//!
//! An effect is a table under its name. `bodies`, where an effect has it, is a list of names: it acts on these
//! alone, and on every body that moves if left out. Numbers of which no default is named must be given.
//!
//! `uniform_gravity`: the same acceleration everywhere.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `acceleration` | m/s² | must be given | `F = m g` |
//! | `bodies` | | all | |
//!
//! `point_gravity`: attraction by a distant point.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `mu` | m³/s² | must be given | gravitational parameter G M |
//! | `center` | m | `[0, 0, 0]` | the attracting point |
//! | `gradient_torque` | | `true` | whether the gradient over the body acts too: its torque, and the small force that belongs to it |
//! | `bodies` | | all | |
//!
//! `drag`: resistance of a medium, `F = −(linear + quadratic |u|) u` with `u = v − wind`,
//! `M = −(angular_linear + angular_quadratic |ω|) ω`.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `linear` | N·s/m | 0 | force per speed |
//! | `quadratic` | N·s²/m² | 0 | force per speed squared |
//! | `angular_linear` | N·m·s | 0 | torque per angular speed |
//! | `angular_quadratic` | N·m·s² | 0 | torque per angular speed squared |
//! | `wind` | m/s | `[0, 0, 0]` | velocity of the medium |
//! | `bodies` | | all | |
//!
//! `thruster`: an engine fixed to a body.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `body` | | must be given | the body that carries it |
//! | `point_body` | m | must be given | where it pushes, from the centre of mass |
//! | `force_body` | N | must be given | the force at factor 1 |
//! | `schedule` | s, – | always 1 | pairs of a time and the factor from then on; 0 before the first, held after the last |
//! | `switch` | | always on | turns it on and off by the state, see below |
//!
//! A `switch` has a `measure` of the body, as [events](#events) have, and two values: with `on` below `off` the engine
//! turns on once the measure has fallen to `on`, and off once it has risen to `off`; with `on` above `off` the other way
//! round. Between the two it stays as it is; at the start it is off there, unless `starts_on` is true.
//!
//! `wrench`: a given force and torque.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `body` | | must be given | the body it acts on |
//! | `force` | N | 0 | force |
//! | `torque` | N·m | 0 | torque about the centre of mass |
//! | `frame` | | `"world"` | axes of force, torque and point: `"world"`, or `"body"`, from the centre of mass |
//! | `point` | m | the centre of mass | where the force acts |
//! | `schedule` | s, – | always 1 | as of a thruster |
//! | `angular_frequency` | rad/s | no oscillation | multiplies by `sin(angular_frequency · t + phase)` |
//! | `phase` | rad | 0 | phase at t = 0; only beside `angular_frequency` |
//!
//! `spring`: a damped spring between two bodies, or between a body and the world.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `a` | | must be given | the first body |
//! | `b` | | the world | the second body |
//! | `anchor_a` | m | `[0, 0, 0]` | where it holds on to `a`, body axes from the centre of mass |
//! | `anchor_b` | m | `[0, 0, 0]` | the same of `b`; without `b`, a point of the world |
//! | `stiffness` | N/m | must be given | force per length |
//! | `damping` | N·s/m | 0 | force per speed |
//! | `rest_length` | m | 0 | length without force |
//!
//! Factors switch exactly at their times; no step straddles one. Bodies that a spring joins share one integrator.
//! An effect that does nothing, such as drag with all coefficients 0, is left out of the plan, which says so.
//! Effects that a user wrote as a function cannot be kept in a file.
//!
//! ```toml
//! [[bodies]]
//! name = "probe"
//! mass = 10.0
//! inertia = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]]
//! position = [0.0, 0.0, 100.0]
//!
//! [[bodies]]
//! name = "buoy"
//! mass = 5.0
//! inertia = [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]]
//!
//! [[effects]]
//! uniform_gravity = { acceleration = [0.0, 0.0, -9.81], bodies = ["buoy"] }
//!
//! [[effects]]
//! point_gravity = { mu = 3.986004418e14, center = [0.0, 0.0, -6.371e6], gradient_torque = true, bodies = ["probe"] }
//!
//! [[effects]]
//! [effects.drag]
//! linear = 0.1
//! quadratic = 0.02
//! angular_linear = 0.01
//! angular_quadratic = 0.001
//! wind = [3.0, 0.0, 0.0]
//!
//! [[effects]]
//! [effects.thruster]
//! body = "probe"
//! point_body = [0.0, 0.0, -0.5]
//! force_body = [0.0, 0.0, 120.0]
//! schedule = [[0.0, 1.0], [4.0, 0.5], [6.0, 0.0]]   # full for 4 s, half for 2 s, off
//!
//! # holds the probe between 1 and 2 m/s downwards
//! [[effects]]
//! [effects.thruster]
//! body = "probe"
//! point_body = [0.0, 0.0, -0.5]
//! force_body = [0.0, 0.0, 150.0]
//! switch = { measure.velocity = [0.0, 0.0, 1.0], on = -2.0, off = -1.0, starts_on = false }
//!
//! [[effects]]
//! [effects.wrench]
//! body = "buoy"
//! force = [0.0, 0.0, 2.0]
//! torque = [0.1, 0.0, 0.0]
//! frame = "body"
//! point = [0.0, 0.0, 0.1]
//! schedule = [[1.0, 1.0]]
//! angular_frequency = 6.0
//! phase = 1.5
//!
//! [[effects]]
//! [effects.spring]
//! a = "probe"
//! b = "buoy"
//! anchor_a = [0.0, 0.0, -0.5]
//! anchor_b = [0.0, 0.0, 0.2]
//! stiffness = 50.0
//! damping = 1.0
//! rest_length = 99.0
//! ```
//!
//! # run
//!
//! Give a `tolerance`, or a `method` with a `step`; with neither, the tolerance is 1e-6. What the two mean
//! is told in [What accuracy costs](crate::guide::accuracy).
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `t_span` | s | the call says it | start and end |
//! | `tolerance` | – | 1e-6, or none beside a step | error that the result may have: positions over `length_scale`, orientations in rad |
//! | `method` | | `"auto"` | `"auto"`, or the name of a [`Method`](crate::integrator::Method), such as `"heun"` or `"rk4"` |
//! | `order` | | of `"taylor"` 8 beside a step, else that which the tolerance calls for; of `"dmv"` 10 | order of the methods `"taylor"` (3 to 40) and `"dmv"` (2, 4, 6, 8, 10) |
//! | `step` | s | found for the tolerance | length of a step; needs a `method`, excludes a `tolerance` |
//! | `t_eval` | s | 201 uniform times, the ends among them | times of the samples, rising, within the span |
//! | `estimate` | | `true` | whether the error of a run with a step is estimated, by a second run |
//! | `record` | | `"dense"` | `"dense"`: the motion of every step is kept; `"samples"`: samples only; `"end"`: start and end only |
//! | `length_scale` | m | the larger of body and path | what position errors are measured by |
//! | `orientation` | | `"quaternion"` | `"quaternion"` or `"matrix"`, in methods that integrate in world axes |
//! | `projection` | | `true` | whether orientations are put back on their sphere after each step |
//! | `finder` | | `"guaranteed"` | how the time of contact is found: `"guaranteed"` proves every piece of the way free; the lecture's `"secant"` and `"bisection"` look at the ends of steps |
//! | `eps` | m | 1e-12 of the pair's size | gap at which a contact is accepted; never below the rounding of the coordinates |
//! | `restitution_law` | | `"poisson"` | what comes back where friction couples normal and tangent: the impulse of compression (`"poisson"`), the normal velocity (`"newton"`), or the work of compression (`"stronge"`) |
//! | `max_impacts` | | 1000000 | impacts of one body after which the run ends as `AccumulatingImpacts`: bounces may follow each other without end, at ever shorter times |
//! | `events` | | none | a list: what is watched for; see [Events](#events) |
//!
//! ```toml
//! [run]
//! t_span = [0.0, 20.0]
//! tolerance = 1e-9
//! method = "auto"
//! t_eval = [0.0, 5.0, 10.0, 20.0]
//! record = "samples"
//! length_scale = 1.0
//! ```
//!
//! ```toml
//! [run]
//! t_span = [0.0, 1.0]
//! method = "heun"
//! step = 1e-3
//! estimate = false
//! record = "dense"
//! orientation = "matrix"
//! projection = false
//! finder = "secant"
//! eps = 1e-9
//! restitution_law = "poisson"
//! max_impacts = 1000000
//! ```
//!
//! # Events
//!
//! An event is a measure of the motion that meets a value. It is searched for along the motion of every step, by
//! bounds rather than by signs, so that touches and close pairs are seen, and located to a few ulp of the time. It
//! changes nothing, unless it ends the run.
//!
//! | key | unit | if left out | meaning |
//! |---|---|---|---|
//! | `name` | | must be given | a name that no other event has |
//! | `measure` | | must be given | what is watched, see below |
//! | `bodies` | | must be given | the bodies that it is measured of: one, or two for `distance` |
//! | `value` | that of the measure | 0 | the value that it shall meet |
//! | `direction` | | `"both"` | `"rising"`, `"falling"`, or `"both"`, with which touches count too |
//! | `terminal` | | `false` | whether the run ends there |
//!
//! | measure | unit | is |
//! |---|---|---|
//! | `position = n` | m | `n·x`, n a direction of 3 numbers in world axes |
//! | `velocity = n` | m/s | `n·v` |
//! | `"speed"` | m/s | `|v|` |
//! | `angular_velocity = n` | rad/s | `n·ω` |
//! | `angular_velocity_body = n` | rad/s | `n·Rᵀω`, n in body axes |
//! | `"angular_speed"` | rad/s | `|ω|` |
//! | `tilt` with `axis_body` a and `axis` n | – | `(R a)·n`, the cosine of their angle where both have length 1 |
//! | `"distance"` | m | between the centres of mass of two bodies |
//!
//! ```toml
//! [run]
//! t_span = [0.0, 4.0]
//!
//! [[run.events]]
//! name = "top"
//! measure.velocity = [0.0, 0.0, 1.0]
//! bodies = ["ball"]
//! direction = "falling"
//!
//! [[run.events]]
//! name = "landing"
//! measure.position = [0.0, 0.0, 1.0]
//! bodies = ["ball"]
//! value = 0.1
//! direction = "falling"
//! terminal = true
//!
//! [[run.events]]
//! name = "slow"
//! measure = "speed"
//! bodies = ["ball"]
//! value = 2.0
//!
//! [[run.events]]
//! name = "on its side"
//! measure.tilt = { axis_body = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0] }
//! bodies = ["ball"]
//!
//! [[bodies]]
//! name = "ball"
//! shape.sphere.radius = 0.1
//! mass = 0.5
//! velocity = [1.0, 0.0, 6.0]
//! angular_velocity = [1.0, 0.0, 2.0]
//!
//! [[effects]]
//! uniform_gravity.acceleration = [0.0, 0.0, -9.81]
//! ```

#[cfg(test)]
mod tests {
    use crate::effect::AnyEffect;
    use crate::scene::Scene;
    use crate::scene::file::Format;
    use crate::shape::Shape;

    const PAGE: &str = include_str!("scenes.rs");

    /// The examples of this page in one language.
    fn examples(language: &str) -> Vec<String> {
        let (mut all, mut inside) = (Vec::<String>::new(), false);
        for line in PAGE.lines().filter_map(|line| line.strip_prefix("//!")) {
            match line.trim() {
                fence if fence == format!("```{language}") => {
                    inside = true;
                    all.push(String::new());
                }
                "```" => inside = false,
                _ => {
                    if let Some(text) = all.last_mut().filter(|_| inside) {
                        text.push_str(line);
                        text.push('\n');
                    }
                }
            }
        }
        all
    }

    #[test]
    fn every_example_is_read_written_and_compiled() {
        let all = [("toml", Format::Toml), ("json", Format::Json)];
        for (language, format) in all {
            let examples = examples(language);
            assert!(!examples.is_empty(), "no example in {language}");
            for text in examples {
                let scene = Scene::from_text(&text, format).unwrap_or_else(|error| panic!("{error}\n{text}"));
                for (_, other) in all {
                    assert_eq!(Scene::from_text(&scene.to_text(other).unwrap(), other).unwrap(), scene);
                }
                scene.run.validate().unwrap();
                // a mesh needs its file
                if !scene.bodies.is_empty() && !text.contains("shape.mesh") {
                    scene.compile(&scene.run).unwrap_or_else(|error| panic!("{error}\n{text}"));
                }
            }
        }
    }

    #[test]
    fn every_shape_and_effect_has_its_place() {
        for name in Shape::NAMES.iter().chain(AnyEffect::NAMES) {
            assert!(PAGE.contains(&format!("`{name}`")), "{name} is missing");
        }
    }

    /// The names of all keys below a schema.
    #[cfg(feature = "schema")]
    fn keys(schema: &serde_json::Value, found: &mut Vec<String>) {
        if let Some(properties) = schema["properties"].as_object() {
            found.extend(properties.keys().cloned());
        }
        match schema {
            serde_json::Value::Object(inner) => inner.values().for_each(|value| keys(value, found)),
            serde_json::Value::Array(inner) => inner.iter().for_each(|value| keys(value, found)),
            _ => {}
        }
    }

    #[cfg(feature = "schema")]
    #[test]
    fn every_key_of_the_schema_has_its_place() {
        let mut found = Vec::new();
        keys(&Scene::schema(), &mut found);
        assert!(found.len() > 60, "{}", found.len());
        for key in found {
            assert!(PAGE.contains(&format!("`{key}`")), "{key} is missing");
        }
    }
}
