//! The table from the codes of sRGB (IEC 61966-2-1) to linear light.

/// The linear light of each of 256 codes, in units of 1/65535.
pub(super) static LINEAR: [u16; 256] = {
    let mut table = [0; 256];
    let mut code = 0;
    while code < 256 {
        let value = code as f64 / 255.0;
        let light = if value <= 0.04045 { value / 12.92 } else { power_2_4((value + 0.055) / 1.055) };
        #[allow(clippy::indexing_slicing)] // evaluated by the compiler
        {
            table[code] = (light * 65535.0 + 0.5) as u16;
        }
        code += 1;
    }
    table
};

/// x to the power 12/5, for x from 0.08 to 1. The fifth root is found by Newton's method.
const fn power_2_4(x: f64) -> f64 {
    let (mut root, mut step) = (1.0, 0);
    while step < 60 {
        let fourth = root * root * root * root;
        root -= (fourth * root - x) / (5.0 * fourth);
        step += 1;
    }
    x * x * root * root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_standard_s_curve() {
        for (code, light) in LINEAR.into_iter().enumerate() {
            let value = code as f64 / 255.0;
            let exact = if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) };
            assert!((f64::from(light) - exact * 65535.0).abs() < 0.51, "{code}: {light}");
        }
        assert_eq!((LINEAR[0], LINEAR[255]), (0, 65535));
    }
}
