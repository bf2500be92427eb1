//! Functions of exponential decay that do not cancel where it is weak.

/// `φ₁(z) = (1 − e^(−z))/z` and `φ₂(z) = (1 − φ₁)/z = (z − 1 + e^(−z))/z²`; `φ₁(0) = 1`, `φ₂(0) = ½`.
pub fn decay_functions(z: f64) -> (f64, f64) {
    if z.abs() < 0.5 {
        // φ₂ = Σ (−z)ⁿ/(n + 2)!, to rounding after 15 terms; φ₁ = 1 − z φ₂
        let mut phi2 = 0.0;
        for n in (0..15).rev() {
            phi2 = (1.0 - z * phi2) / f64::from(n + 2);
        }
        return (1.0 - z * phi2, phi2);
    }
    let phi1 = -libm::expm1(-z) / z;
    (phi1, (1.0 - phi1) / z)
}
