//! The discrete rotation of Moser and Veselov, preprocessed (Hairer, Vilmart 2006, J. Phys. A 39:13225).
//!
//! ```text
//! h L₀ = 2 (e₀ J e + e × J e)     h L₁ = 2 (e₀ J e − e × J e)     e₀² + |e|² = 1     J = diag(J₁, J₂, J₃)
//! ```
//!
//! The unit quaternion (e₀, e) is the rotation of a step, seen from the body: `L₁` is `L₀` turned back by it, so that
//! |L| stays, and with it `Σ L²/J`. With J the moments of inertia the rotation is right to order 2. It runs on the
//! same curve as the true motion, only at another pace (`McLachlan`, Zanna 2005, Found. Comput. Math. 5:87), so that
//! moments can be found with which it is right to any order:
//!
//! ```text
//! 1/J_i = a_i (1 + h² s₃ + h⁴ s₅ + …) + h² d₃ + h⁴ d₅ + …     a = 1/I,  A₁ = Σ a_i,  A₂ = Σ a_i a_j,  A₃ = a₁ a₂ a₃
//! s₃ = (−2 A₁ H + A₂ C)/6     d₃ = (A₂ H − 2 A₃ C)/6              H = ½ Σ a L²,  C = ½ |L|²
//! ```
//!
//! The first pair is Hairer's and Vilmart's; the others are those polynomials with which J solves the equation above
//! for the quaternion of the true motion, found in rational arithmetic. Since H and C stay, so does J, and the energy
//! is kept as |L| is. Steps in which the body turns by more than a radian or so have no such rotation,
//! or another than the motion's.

use crate::math::{Matrix3, Vector3, rotation};

/// Rounds of Newton's iteration [-]: it doubles its digits each, from one or more at the start.
const ROUNDS: usize = 12;

/// The rotation of a step of length `h` as (e₀ − 1, e), for L and inverse moments in principal axes, right to this
/// order: 2, 4, 6, 8 or 10. Not finite where there is none.
pub(super) fn rotation(momentum: &Vector3, inverse: &Vector3, h: f64, order: u32) -> (f64, Vector3) {
    // in units of the largest inverse moment, so that no power overflows
    let unit = inverse.amax();
    let (a, l) = (inverse / unit, (h * unit) * momentum);
    let [s, d] = corrections(&a, &l, order);
    let j = a.map(|a| 1.0 / (a * (1.0 + s) + d));

    // e₀ J e + e × J e = ½ h L
    let target = 0.5 * l;
    let mut e = target.component_div(&j);
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        let e0 = (1.0 - e.norm_squared()).sqrt();
        let m = j.component_mul(&e);
        let miss = e0 * m + e.cross(&m) - target;
        let slope = Matrix3::from_diagonal(&(e0 * j)) - m * e.transpose() / e0
            + rotation::cross_matrix(&e) * Matrix3::from_diagonal(&j)
            - rotation::cross_matrix(&m);
        let Some(inverse) = slope.try_inverse() else { return (f64::NAN, e) };
        let step = inverse * miss;
        e -= step;

        // until rounding stops it
        let size = step.amax();
        if size == 0.0 || size >= 0.5 * last {
            break;
        }
        last = size;
    }
    let e2 = e.norm_squared();
    (-e2 / (1.0 + (1.0 - e2).sqrt()), e)
}

/// `Σ h^(k−1) s_k` and `Σ h^(k−1) d_k` to an order; `l` is h L.
#[rustfmt::skip]
fn corrections(a: &Vector3, l: &Vector3, order: u32) -> [f64; 2] {
    let (h, c) = (0.5 * a.dot(&l.component_mul(l)), 0.5 * l.norm_squared());
    let (a1, a2, a3) = (a.sum(), a.x * a.y + a.y * a.z + a.z * a.x, a.product());
    let (mut s, mut d) = (0.0, 0.0);
    if order >= 4 {
        s += (-2.0 * a1 * h + a2 * c) / 6.0;
        d += (a2 * h - 2.0 * a3 * c) / 6.0;
    }
    if order >= 6 {
        s += (h * h * (2.0 * a1 * a1 - a2) + h * c * (8.0 * a3 - 2.0 * a1 * a2) + c * c * (2.0 * a2 * a2 - 6.0 * a1 * a3)) / 60.0;
        d += (h * h * (-a1 * a2 - 6.0 * a3) + h * c * (8.0 * a1 * a3 - a2 * a2) - c * c * a2 * a3) / 60.0;
    }
    if order >= 8 {
        s += (h * h * h * (4.0 * a1 * (a2 - a1 * a1) + 72.0 * a3)
            + h * h * c * (6.0 * a1 * a1 * a2 + 41.0 * a2 * a2 - 212.0 * a1 * a3)
            + h * c * c * (-36.0 * a1 * a2 * a2 + 132.0 * a1 * a1 * a3 - 30.0 * a2 * a3)
            + c * c * c * (17.0 * a2 * a2 * a2 - 66.0 * a1 * a2 * a3 + 100.0 * a3 * a3)) / 2520.0;
        d += (h * h * h * (2.0 * a1 * a1 * a2 - 26.0 * a2 * a2 + 60.0 * a1 * a3)
            + h * h * c * (13.0 * a1 * a2 * a2 - 64.0 * a1 * a1 * a3 + 110.0 * a2 * a3)
            + h * c * c * (2.0 * a2 * a2 * a2 - 2.0 * a1 * a2 * a3 - 176.0 * a3 * a3)
            + c * c * c * (72.0 * a1 * a3 * a3 - 19.0 * a2 * a2 * a3)) / 2520.0;
    }
    if order >= 10 {
        let (a11, a22, a33) = (a1 * a1, a2 * a2, a3 * a3);
        s += (h * h * h * h * (2.0 * a11 * a11 - 3.0 * a11 * a2 + 153.0 * a22 - 486.0 * a1 * a3)
            + h * h * h * c * (-4.0 * a1 * a11 * a2 - 264.0 * a1 * a22 + 1104.0 * a11 * a3 - 828.0 * a2 * a3)
            + h * h * c * c * (156.0 * a11 * a22 - 612.0 * a1 * a11 * a3 + 18.0 * a2 * a22 + 180.0 * a1 * a2 * a3 + 1908.0 * a33)
            + h * c * c * c * (-154.0 * a1 * a2 * a22 + 612.0 * a11 * a2 * a3 + 282.0 * a22 * a3 - 2256.0 * a1 * a33)
            + c * c * c * c * (62.0 * a22 * a22 - 342.0 * a1 * a22 * a3 + 378.0 * a11 * a33 + 291.0 * a2 * a33)) / 45360.0;
        d += (h * h * h * h * (-a1 * a11 * a2 - 6.0 * a1 * a22 - 126.0 * a11 * a3 + 459.0 * a2 * a3)
            + h * h * h * c * (-30.0 * a11 * a22 + 128.0 * a1 * a11 * a3 + 194.0 * a2 * a22 - 552.0 * a1 * a2 * a3 - 1296.0 * a33)
            + h * h * c * c * (-30.0 * a1 * a2 * a22 + 114.0 * a11 * a2 * a3 - 798.0 * a22 * a3 + 2136.0 * a1 * a33)
            + h * c * c * c * (-a22 * a22 + 222.0 * a1 * a22 * a3 - 864.0 * a11 * a33 + 684.0 * a2 * a33)
            + c * c * c * c * (-61.0 * a2 * a22 * a3 + 243.0 * a1 * a2 * a33 - 610.0 * a3 * a33)) / 45360.0;
    }
    [s, d]
}
