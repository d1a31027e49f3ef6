//! Numbers as text for people.

/// Bytes for people: `1.5 GiB`.
pub(crate) fn bytes(count: u64) -> String {
    const UNITS: [&str; 5] = ["KiB", "MiB", "GiB", "TiB", "PiB"];
    if count < 1024 {
        return format!("{count} B");
    }
    let mut value = count as f64 / 1024.0;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    format!("{value:.1} {}", UNITS[unit])
}

/// An integer with its digits in groups of three: `17,160`.
pub(crate) fn grouped(count: impl TryInto<i64>) -> String {
    let Ok(count) = count.try_into() else {
        return "more than 2^63".to_owned();
    };
    let digits = count.unsigned_abs().to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 + 1);
    if count < 0 {
        text.push('-');
    }
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A coordinate or measure for people: six significant digits, no padding.
pub(crate) fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{}", if x == 0.0 { 0.0 } else { x });
    }
    let size = x.abs();
    if (1e-4..1e7).contains(&size) {
        let decimals = (5 - size.log10().floor() as i32).clamp(0, 12) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{x:.5e}")
    }
}

/// A point for people.
pub(crate) fn point(p: glam::DVec3) -> String {
    format!("({}, {}, {})", number(p.x), number(p.y), number(p.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people() {
        assert_eq!(grouped(17_160), "17,160");
        assert_eq!(grouped(-1_000_000), "-1,000,000");
        assert_eq!(grouped(7), "7");
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(1_610_612_736), "1.5 GiB");
        assert_eq!(number(-0.0), "0");
        assert_eq!(number(1.5), "1.5");
        assert_eq!(number(123_456.789), "123457");
        assert_eq!(number(1e308), "1.00000e308");
        assert_eq!(number(f64::NAN), "NaN");
    }
}
