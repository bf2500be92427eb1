//! Heavy tops: what their equations keep is kept, and a sleeping top sleeps as long as it may.

use super::recorded::{self, Case};
use bryla::Trajectory;
use bryla::math::{Vector3, quaternion};

fn case(name: &str) -> Case {
    recorded::driven().into_iter().find(|case| case.name == name).unwrap()
}

/// Largest change of a quantity of `γ = Rᵀ e_z` and L (body axes) over the samples of a run.
fn change(case: &Case, run: &Trajectory, of: impl Fn(Vector3, Vector3) -> f64) -> f64 {
    let at = |sample: usize| {
        let q = run.states(sample)[0].orientation;
        of(quaternion::rotate(&q.conjugate(), &Vector3::z()), case.momentum(run, sample))
    };
    (0..run.times().len()).map(|sample| (at(sample) - at(0)).abs()).fold(0.0, f64::max)
}

#[test]
fn energy_and_the_momentum_about_the_vertical_are_kept_by_every_top() {
    let times: Vec<f64> = (0..=50).map(|i| 0.1 * f64::from(i)).collect();
    for case in recorded::driven().iter().filter(|case| case.name.contains("top") || case.name.contains("lagrange")) {
        for tolerance in [1e-6, 1e-10] {
            let run = case.run(&times, None, tolerance);
            let (moments, weight) = (case.moments, case.weight);
            let energy = |g: Vector3, l: Vector3| 0.5 * l.dot(&l.component_div(&moments)) + weight.dot(&g);
            let start = case.momentum(&run, 0);
            let scale = 0.5 * start.dot(&start.component_div(&moments)) + weight.norm();
            let off = change(case, &run, energy) / scale;
            let off_z = change(case, &run, |g, l| g.dot(&l)) / (start.norm() + (moments.amax() * weight.norm()).sqrt());
            println!("{}, {tolerance:e}: E {off:.2e}, L_z {off_z:.2e}", case.name);
            assert!(off <= tolerance && off_z <= tolerance, "{}: E {off:.2e}, L_z {off_z:.2e}", case.name);
        }
    }
}

/// Kovalevskaya 1889: with I₁ = I₂ = 2 I₃ and the weight c along 1, `|(ω₁ + iω₂)² − c(γ₁ + iγ₂)/I₃|²` is a fourth
/// quantity that stays.
#[test]
fn kovalevskayas_quantity_is_kept() {
    let case = case("kovalevskaya");
    let times: Vec<f64> = (0..=50).map(|i| 0.2 * f64::from(i)).collect();
    let k = |sign: f64| {
        let (moments, c) = (case.moments, case.weight.x / case.moments.z);
        move |g: Vector3, l: Vector3| {
            let w = l.component_div(&moments);
            let (real, imaginary) = (w.x * w.x - w.y * w.y - sign * c * g.x, 2.0 * w.x * w.y - sign * c * g.y);
            real * real + imaginary * imaginary
        }
    };
    for tolerance in [1e-6, 1e-11] {
        let run = case.run(&times, None, tolerance);
        let off = change(&case, &run, k(1.0));
        println!("{tolerance:e}: {off:.2e}");
        // the quantity is of size 1, and its slope along the motion's unknowns below 10
        assert!(off <= 10.0 * tolerance, "{off:.2e}");
        // with the weight upside down it is none
        assert!(change(&case, &run, k(-1.0)) > 0.1);
    }
}

/// Goryachev and Chaplygin 1900: with I₁ = I₂ = 4 I₃, the weight c along 1 and no momentum about the vertical,
/// `ω₃(ω₁² + ω₂²) − c ω₁γ₃/I₃` stays; I₃ = 1 here.
#[test]
fn goryachevs_and_chaplygins_quantity_is_kept() {
    let case = case("goryachev-chaplygin");
    let times: Vec<f64> = (0..=50).map(|i| 0.2 * f64::from(i)).collect();
    let quantity = |g: Vector3, l: Vector3| {
        let (moments, c) = (case.moments, case.weight.x);
        let w = l.component_div(&moments);
        w.z * (w.x * w.x + w.y * w.y) - c * w.x * g.z
    };
    for tolerance in [1e-6, 1e-11] {
        let run = case.run(&times, None, tolerance);
        let off = change(&case, &run, quantity);
        println!("{tolerance:e}: {off:.2e}");
        assert!(off <= 10.0 * tolerance, "{off:.2e}");
    }
}

/// A top that starts leaning by θ₀ without a sideways velocity. Above the limit `L₃² = 4 I₁ m g r` it leans by at most
/// `θ₀ L₃/√(L₃² − 4 I₁ m g r)` (small θ₀: two circles of unlike speed); below it falls to the root of
/// `β(1 − u²) = a²(cos θ₀ − u)`, `u = cos θ`, `β = 2 m g r/I₁`, `a = L₃/I₁` (Goldstein, Mechanics, §5.7).
#[test]
fn a_sleeping_top_sleeps_above_its_limit_and_wakes_below() {
    const START: f64 = 1e-3;
    for name in ["sleeping top, above its limit", "sleeping top, below its limit"] {
        let case = case(name);
        let times: Vec<f64> = (0..=600).map(|i| 0.1 * f64::from(i)).collect();
        let run = case.run(&times, None, 1e-9);
        let lean = |sample: usize| {
            let up = quaternion::rotate(&run.states(sample)[0].orientation, &Vector3::z());
            up.x.hypot(up.y).atan2(up.z)
        };
        let most = (0..times.len()).map(lean).fold(0.0, f64::max);

        let (spin, inertia, weight) = (case.momentum(&run, 0).z, case.moments.x, case.weight.z);
        let beyond = spin * spin - 4.0 * inertia * weight;
        let formula = if beyond > 0.0 {
            START * spin / beyond.sqrt()
        } else {
            let (a2, b) = ((spin / inertia).powi(2), 2.0 * weight / inertia);
            ((a2 - (a2 * a2 - 4.0 * b * (a2 * START.cos() - b)).sqrt()) / (2.0 * b)).acos()
        };
        println!("{name}: {most:.6e} rad, {formula:.6e} by the formula");
        // samples are 0.1 s apart, in which the lean near its largest changes by 1e-3 of itself at most
        assert!((most / formula - 1.0).abs() < 1e-3, "{name}: {most:.3e} rad, {formula:.3e} by the formula");
    }
}
