//! Numbers and counts in words, for reports and messages.

/// A number with four digits, in powers of ten where it is small or large.
pub(crate) fn short(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e5).contains(&size) {
        return format!("{x:.3e}");
    }
    let decimals = [1e3, 1e2, 1e1, 1e0, 1e-1, 1e-2].iter().filter(|&&bound| size < bound).count();
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A count with its noun: `1 body`, `2 bodies`.
pub(crate) fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_four_digits() {
        let numbers = [0.0, 1.0, -0.5, 3.14259, 1234.56, 99999.0, 1e5, 9.99e-4, -2.5e-9, f64::INFINITY];
        let texts = ["0", "1", "-0.5", "3.143", "1235", "99999", "1.000e5", "9.990e-4", "-2.500e-9", "inf"];
        assert_eq!(numbers.map(short), texts);
    }
}
