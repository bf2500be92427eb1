//! The order of every method, on problems without symmetry.

use super::{LARGEST_ERROR, SMALLEST_ERROR, distance, free_body, last, run, stepping_through};
use bryla::{Method, Orientation, RunOptions, Scene, Wrench};

/// The free body, driven by a torque and a force that oscillate, at a point off the centre of mass.
fn driven_body() -> Scene {
    let mut scene = free_body();
    let wrench = Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4]).point([0.1, 0.3, -0.2]);
    scene.add_effect(wrench.frame(bryla::Frame::Body).oscillating(1.7, 0.3));
    scene
}

#[test]
fn halving_the_step_divides_the_error_by_two_to_the_order() {
    let span = 4.0;
    for (name, scene) in [("free", free_body()), ("driven", driven_body())] {
        // truth: the method of order 4 with a step of 2⁻¹³, error about 1e-15 + rounding
        let truth = last(&run(&scene, span, Method::Rk4, span / 32768.0));
        for method in stepping_through(&scene) {
            for matrix in [Orientation::Quaternion, Orientation::Matrix] {
                if matrix == Orientation::Matrix && method.in_body_axes() {
                    continue;
                }
                let error = |n: u32| {
                    let options =
                        RunOptions::method(method).step(span / f64::from(n)).estimate(false).orientation(matrix);
                    // a step too long for the discrete rotation has no end
                    scene.run(0.0..span, &options).map_or(f64::INFINITY, |run| distance(&last(&run), &truth))
                };
                // steps in the ratios 3 : 4 and 2 : 3, so that the few that high orders need are among them
                let errors: Vec<_> = (2..16).flat_map(|k| [1 << k, 3 << (k - 1)]).map(|n| (n, error(n))).collect();
                let slopes: Vec<_> = errors
                    .windows(3)
                    .filter(|e| e[0].1 <= LARGEST_ERROR && e[2].1 >= SMALLEST_ERROR)
                    .map(|e| (e[0].1 / e[2].1).log2())
                    .collect();
                assert!(slopes.len() >= 2, "{method} on the {name} body: too few errors in the window: {errors:?}");
                // every slope; compositions and high orders come to their pace as the step falls, their last one
                let order = f64::from(method.order());
                let at_once = matches!(method, Method::Euler | Method::Heun | Method::SemiImplicitEuler | Method::Rk4);
                let settled = if at_once { &slopes[..] } else { &slopes[slopes.len() - 1..] };
                let least = settled.iter().copied().fold(f64::INFINITY, f64::min);
                // the next terms of a series still show where its errors meet rounding
                let slack = if method == Method::Taylor { 0.3 } else { 0.1 };
                assert!(least >= order - slack, "{method} on the {name} body ({}): {slopes:.2?}", matrix.name());

                // and half of all slopes on their way there
                let mut sorted = slopes.clone();
                sorted.sort_by(f64::total_cmp);
                let width = if method.order() <= 4 { 0.1 } else { 0.3 };
                let middle = sorted[sorted.len() / 2];
                assert!(middle >= order - width, "{method} on the {name} body ({}): {slopes:.2?}", matrix.name());
            }
        }
    }
}

#[test]
fn a_step_never_straddles_a_switch_so_the_order_survives_it() {
    // two switches at times that no step of a uniform lattice meets
    let mut scene = free_body();
    let schedule = [(0.0, 1.0), (1.2345678, -0.7), (2.3456789, 0.0)];
    scene.add_effect(bryla::Thruster::new("body", [0.1, 0.4, -0.2], [0.8, 0.3, 0.5]).schedule(schedule));
    let truth = last(&run(&scene, 3.0, Method::Rk4, 3.0 / 32768.0));
    for method in stepping_through(&scene) {
        let error = |n: u32| distance(&last(&run(&scene, 3.0, method, 3.0 / f64::from(n))), &truth);
        // the steps before the switches differ from the others, which blurs the slope of one halving: it is taken
        // over the finer half of the steps whose errors lie in the window
        let order = f64::from(method.order());
        let within: Vec<_> = (1..14)
            .flat_map(|k| [1 << k, 3 << (k - 1)])
            .map(|n| (n, error(n)))
            .skip_while(|&(_, e)| e >= LARGEST_ERROR)
            .take_while(|&(_, e)| e >= SMALLEST_ERROR)
            .collect();
        let [(first, coarse), .., (last, fine)] = within[within.len() / 2..] else {
            panic!("{method}: too few errors in the window: {within:?}")
        };
        let slope = (coarse / fine).ln() / (f64::from(last) / f64::from(first)).ln();
        assert!(slope >= order - 0.3, "{method}: {slope:.2} over {within:?}");
    }
}
