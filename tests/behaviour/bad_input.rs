//! Bad input is told what is wrong with it, where, and what is allowed. Nothing panics.

use bryla::scene::file::Format;
use bryla::{Cuboid, Error, Method, Polyhedron, RunOptions, Scene, UniformGravity};

/// What a scene file is told when it is read and compiled.
fn told(text: &str) -> String {
    match Scene::from_text(text, Format::Toml).and_then(|scene| scene.compile(&scene.run)) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error.to_string(),
    }
}

/// A die with these lines; a later line of the same key would be a syntax error, so the mass is left out.
fn body(lines: &str) -> String {
    format!("[[bodies]]\nname = \"die\"\nshape.cuboid.half_extents = [1, 1, 1]\n{lines}\n")
}

fn good(lines: &str) -> String {
    body(&format!("mass = 1.0\n{lines}"))
}

#[test]
fn every_mistake_in_a_body_has_its_message() {
    let cases = [
        ("mass = 0.0", "body die: mass must be a finite number > 0, got 0.0"),
        ("mass = -1.0", "body die: mass must be a finite number > 0, got -1.0"),
        ("mass = nan", "body die: mass must be a finite number > 0, got NaN"),
        ("density = inf", "body die: density must be a finite number > 0, got inf"),
        ("", "body die: density or mass must be given"),
        ("mass = 1.0\ndensity = 1.0", "body die: density and mass exclude each other"),
        ("inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "body die: inertia needs mass beside it"),
        (
            "density = 1.0\ninertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
            "body die: density and inertia exclude each other; give mass",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(told(&body(lines)), message);
    }
    let cases = [
        ("position = [0, nan, 0]", "body die: position must be three finite numbers, got [0.0, NaN, 0.0]"),
        ("velocity = [inf, 0, 0]", "body die: velocity must be three finite numbers, got [inf, 0.0, 0.0]"),
        (
            "angular_velocity = [0, 0, nan]",
            "body die: angular_velocity must be three finite numbers, got [0.0, 0.0, NaN]",
        ),
        ("position = [0, 0, 0]\norigin = [0, 0, 0]", "body die: position and origin exclude each other"),
        (
            "angular_velocity = [0, 0, 1]\nangular_velocity_body = [0, 0, 1]",
            "body die: angular_velocity and angular_velocity_body exclude each other",
        ),
        (
            "orientation = [0, 0, 0, 0]",
            "body die: orientation must be a unit quaternion (w, x, y, z), length 1 ± 0.001, got [0.0, 0.0, 0.0, 0.0]",
        ),
        (
            "orientation = [1, 1, 0, 0]",
            "body die: orientation must be a unit quaternion (w, x, y, z), length 1 ± 0.001, got [1.0, 1.0, 0.0, 0.0]",
        ),
        (
            "orientation = [nan, 0, 0, 0]",
            "body die: orientation must be a unit quaternion (w, x, y, z), length 1 ± 0.001, got [NaN, 0.0, 0.0, 0.0]",
        ),
        ("restitution = -0.1", "body die: restitution must be between 0 and 1, got -0.1"),
        ("restitution = 1.5", "body die: restitution must be between 0 and 1, got 1.5"),
        ("breaking_load.force = 0.0", "body die: breaking_load.force must be a number > 0, or left out, got 0.0"),
        (
            "breaking_load = { force = 1.0, torque = nan }",
            "body die: breaking_load.torque must be a number > 0, or left out, got NaN",
        ),
        ("friction = -1.0", "body die: friction must be a finite number ≥ 0, got -1.0"),
        (
            "fixed = true\nvelocity = [1, 0, 0]",
            "body die: velocity must be left out, since the body is fixed, got [1.0, 0.0, 0.0]",
        ),
        ("fixed = true\nfreedom.pivot.point_body = [0, 0, 1]", "body die: fixed and freedom exclude each other"),
        ("fixed = true\nmotion.velocity = [1, 0, 0]", "body die: fixed and motion exclude each other"),
        (
            "motion.velocity = [1, 0, 0]\nvelocity = [1, 0, 0]",
            "body die: velocity must be left out, since its motion says it, got [1.0, 0.0, 0.0]",
        ),
        ("motion = {}\nfreedom.pivot.point_body = [0, 0, 1]", "body die: motion and freedom exclude each other"),
        (
            "motion.angular_velocity = [1, nan, 0]",
            "body die: motion.angular_velocity must be three finite numbers, got [1.0, NaN, 0.0]",
        ),
        (
            "motion.schedule = [[1.0, 1.0], [0.5, 0.0]]",
            "body die: schedule must be sorted by rising time, got (1.0, 0.5)",
        ),
        (
            "freedom.planar.normal = [0, 0, 0]",
            "body die: freedom.planar.normal must be a finite vector that is not 0, got [0.0, 0.0, 0.0]",
        ),
        (
            "freedom.planar.normal = [0, 0, 1]\nvelocity = [0, 0, 1]",
            "body die: velocity must be in the plane of its freedom, got [0.0, 0.0, 1.0]",
        ),
        (
            "freedom.planar.normal = [0, 0, 1]\nangular_velocity = [1, 0, 0]",
            "body die: angular_velocity must be along the normal of its plane, got [1.0, 0.0, 0.0]",
        ),
        (
            "freedom.pivot.point_body = [0, 0, 1]\nvelocity = [0, 0, 1]",
            "body die: velocity must be that of a rotation about the pivot; leave it out and give angular_velocity, got [0.0, 0.0, 1.0]",
        ),
        (
            "freedom.axle.axis_body = [0, 1, 0]\nangular_velocity = [1, 0, 0]",
            "body die: angular_velocity must be along its axle, got [1.0, 0.0, 0.0]",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(told(&good(lines)), message);
    }
}

#[test]
fn inertia_that_no_body_can_have_is_refused() {
    let with = |rows: &str| told(&format!("[[bodies]]\nname = \"die\"\nmass = 1.0\ninertia = {rows}\n"));
    for (rows, message) in [
        ("[[1, 0, 0], [0, 1, 0], [0, 0, 3]]", "body die: inertia must be "),
        ("[[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]", "body die: inertia must be "),
        ("[[-1, 0, 0], [0, 1, 0], [0, 0, 1]]", "body die: inertia must be "),
        ("[[nan, 0, 0], [0, 1, 0], [0, 0, 1]]", "body die: inertia must be "),
    ] {
        assert!(with(rows).starts_with(message), "{}", with(rows));
    }
}

#[test]
fn every_mistake_in_a_shape_has_its_message() {
    let cases = [
        ("shape.sphere.radius = -1.0", "body die: radius must be positive and finite, got -1.0"),
        (
            "shape.cylinder = { radius = 1.0, half_height = 0.0 }",
            "body die: half_height must be positive and finite, got 0.0",
        ),
        (
            "shape.cuboid.half_extents = [1, 0, 1]",
            "body die: half_extents must be three positive finite lengths, got [1.0, 0.0, 1.0]",
        ),
        (
            "shape.half_space = { normal = [0, 0, 1], offset = 0.0 }",
            "body die: a half space has no finite mass; it must be fixed",
        ),
        (
            "shape.polyhedron = { vertices = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], faces = [[0,2,1],[0,1,3],[1,2,3]] }",
            "body die: ",
        ),
    ];
    for (shape, message) in cases {
        let text = told(&format!("[[bodies]]\nname = \"die\"\nmass = 1.0\n{shape}\n"));
        assert!(text.starts_with(message), "{text}");
    }
}

#[test]
fn an_open_mesh_names_its_edges() {
    let open = Polyhedron::new(
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [vec![0, 2, 1], vec![0, 1, 3], vec![1, 2, 3]],
    );
    let message = open.validate("body die").unwrap_err().to_string();
    assert!(message.starts_with("body die: ") && message.contains("0–2") || message.contains("2–0"), "{message}");
}

#[test]
fn every_mistake_in_an_effect_has_its_message() {
    let cases = [
        (
            "thruster = { body = \"dye\", point_body = [0,0,0], force_body = [1,0,0] }",
            "effect 1 (thruster): body names \"dye\", which is not in the scene; there is die",
        ),
        (
            "thruster = { body = \"die\", point_body = [0,0,0], force_body = [nan,0,0] }",
            "effect 1 (thruster): force_body must be three finite numbers, got [NaN, 0.0, 0.0]",
        ),
        (
            "thruster = { body = \"die\", point_body = [0,0,0], force_body = [1,0,0], schedule = [[1, 1], [0, 0]] }",
            "effect 1 (thruster): schedule must be sorted by rising time, got (1.0, 0.0)",
        ),
        (
            "thruster = { body = \"die\", point_body = [0,0,0], force_body = [1,0,0], schedule = [[nan, 1]] }",
            "effect 1 (thruster): schedule must be pairs of finite numbers (time, factor), got (NaN, 1.0)",
        ),
        (
            "thruster = { body = \"die\", point_body = [0,0,0], force_body = [1,0,0], schedule = [] }",
            "effect 1 (thruster): schedule must be at least one (time, factor); leave it out for always on, got []",
        ),
        ("drag.linear = -1.0", "effect 1 (drag): linear must be a finite number ≥ 0, got -1.0"),
        ("drag = { quadratic = nan }", "effect 1 (drag): quadratic must be a finite number ≥ 0, got NaN"),
        (
            "spring = { a = \"die\", b = \"die\", stiffness = 1.0 }",
            "effect 1 (spring): b must be another body than a, got \"die\"",
        ),
        (
            "spring = { a = \"die\", stiffness = -1.0 }",
            "effect 1 (spring): stiffness must be a finite number ≥ 0, got -1.0",
        ),
        (
            "wrench = { body = \"die\", force = [1,0,0], phase = 1.0 }",
            "effect 1 (wrench): phase must be left out where no angular_frequency is given, got 1.0",
        ),
        (
            "wrench = { body = \"die\", angular_frequency = inf }",
            "effect 1 (wrench): angular_frequency must be a finite number, got inf",
        ),
        ("point_gravity.mu = -1.0", "effect 1 (point_gravity): mu must be a finite number ≥ 0, got -1.0"),
        (
            "uniform_gravity.acceleration = [0, 0, inf]",
            "effect 1 (uniform_gravity): acceleration must be three finite numbers, got [0.0, 0.0, inf]",
        ),
        (
            "uniform_gravity = { acceleration = [0, 0, -9.8], bodies = [\"die\", \"die\"] }",
            "effect 1 (uniform_gravity): bodies must be different from each other, got \"die\"",
        ),
    ];
    for (effect, message) in cases {
        assert_eq!(told(&good(&format!("[[effects]]\n{effect}"))), message);
    }
}

#[test]
fn every_mistake_in_the_run_has_its_message() {
    let cases = [
        ("tolerance = -1e-6", "run: tolerance must be a finite number > 0, got -1e-6"),
        ("tolerance = 1e-6\nstep = 1e-3\nmethod = \"heun\"", "run: tolerance and step exclude each other"),
        ("step = 1e-3", "run: a step needs a method beside it"),
        ("step = 0.0\nmethod = \"heun\"", "run: step must be a finite number > 0, got 0.0"),
        ("t_span = [1.0, 1.0]", "run: t_span must be two finite times, the second later, got [1.0, 1.0]"),
        ("t_span = [0.0, nan]", "run: t_span must be two finite times, the second later, got [0.0, NaN]"),
        ("t_span = [0.0, 1.0]\nt_eval = [0.0, 2.0]", "run: t_eval must be within the span 0 to 1, got 2.0"),
        ("t_span = [0.0, 1.0]\nt_eval = [0.5, 0.2]", "run: t_eval must be sorted by rising time, got (0.5, 0.2)"),
        ("length_scale = 0.0", "run: length_scale must be a finite number > 0, got 0.0"),
        ("eps = nan", "run: eps must be a finite number > 0, got NaN"),
    ];
    for (lines, message) in cases {
        assert_eq!(told(&format!("[run]\n{lines}\n{}", good(""))), message);
    }
    assert_eq!(told("bodies = []"), "scene: there is no body in it");
    assert_eq!(told(&(good("") + &good(""))), "scene: body name must be one that no other body has, got \"die\"");
    assert_eq!(
        told("[[bodies]]\nname = \" \"\nmass = 1.0\n"),
        "body: name must be a name that is not blank, got \" \""
    );
    assert_eq!(
        told("[[bodies]]\nname = \"die\"\nmass = 1.0\n"),
        "body die: without a shape, mass and inertia must be given"
    );
}

#[test]
fn unknown_keys_are_shown_with_line_caret_and_the_allowed_names() {
    let text = told("[[bodies]]\nname = \"die\"\nmas = 1.0\n");
    assert_eq!(
        text,
        "scene: TOML parse error at line 3, column 1\n  |\n3 | mas = 1.0\n  | ^^^\nunknown field `mas`, expected one of `name`, `shape`, `density`, `mass`, `inertia`, `position`, `origin`, `orientation`, `velocity`, `angular_velocity`, `angular_velocity_body`, `friction`, `restitution`, `response`, `breaking_load`, `fixed`, `motion`, `freedom`, `collides`"
    );
    let text = told("[[effects]]\ndragg.linear = 1.0\n");
    assert!(
        text.contains("line 2, column 1")
            && text.contains("unknown variant `dragg`, expected one of `uniform_gravity`, `point_gravity`, `drag`"),
        "{text}"
    );
    let text = told("[run]\nmethod = \"rk5\"\n");
    assert!(
        text.contains("2 | method = \"rk5\"")
            && text.contains("unknown method `rk5`, expected one of `auto`, `euler`, `heun`"),
        "{text}"
    );
    let text = told("[[bodies]]\nname = \"die\"\nshape.cuboid.half_extent = [1, 1, 1]\n");
    assert!(text.contains("unknown field `half_extent`, expected `half_extents`"), "{text}");
    let text = told("[[bodies]]\nname = \"die\"\nposition = [1, 1]\n");
    assert!(text.contains("invalid length 2, expected an array of length 3"), "{text}");

    let json = "{\n  \"bodies\": [\n    {\"name\": \"die\", \"mas\": 1}\n  ]\n}";
    let text = Scene::from_text(json, Format::Json).unwrap_err().to_string();
    assert!(text.starts_with("scene: JSON parse error at line 3, column 25\n  |\n3 |     {\"name\": \"die\", \"mas\": 1}\n  |                         ^\nunknown field `mas`, expected one of `name`"), "{text}");
}

#[test]
fn rust_callers_are_told_the_same() {
    let mut scene = Scene::new();
    scene.add(bryla::Body::new("die", Cuboid::new([0.1; 3])).mass(1.0)).unwrap();
    let error = scene.add(bryla::Body::new("die", Cuboid::new([0.1; 3])).mass(1.0)).unwrap_err();
    assert_eq!(error, Error::value("scene", "body name", "one that no other body has", "die"));
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]).on(["ball"]));
    let message = scene.run(0.0..1.0, &RunOptions::default()).unwrap_err().to_string();
    assert_eq!(message, "effect 1 (uniform_gravity): body names \"ball\", which is not in the scene; there is die");
    let message = scene.run(1.0..0.0, &RunOptions::method(Method::Heun).step(0.1)).unwrap_err().to_string();
    assert!(message.starts_with("effect 1"), "{message}");
    let message = "rk5".parse::<Method>().unwrap_err().to_string();
    assert!(message.starts_with("run: method must be one of euler, heun, semi_implicit_euler, rk4"), "{message}");
}
