//! Plots with logarithmic axes, in the format SVG.

use core::fmt::Write as _;

/// Curves over the same numbers.
pub(crate) struct Plot<'p> {
    /// What runs from left to right.
    pub(crate) across: &'p str,
    /// The numbers from left to right, ascending and positive, with their names.
    pub(crate) ticks: Vec<(f64, String)>,
    /// What runs up, at one power of ten: its name.
    pub(crate) power: &'p dyn Fn(i32) -> String,
    pub(crate) curves: Vec<Curve<'p>>,
}

/// One curve: a positive number for each tick.
pub(crate) struct Curve<'p> {
    pub(crate) name: &'p str,
    pub(crate) color: &'p str,
    pub(crate) values: Vec<f64>,
}

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 360.0;
const MARGIN: f64 = 56.0;

/// Plots beside each other, as a file.
pub(crate) fn svg(plots: &[Plot<'_>]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        WIDTH * plots.len() as f64
    );
    for (number, plot) in plots.iter().enumerate() {
        // Writing into a string cannot fail.
        let _ = writeln!(svg, "<g transform=\"translate({} 0)\">", WIDTH * number as f64);
        plot.write(&mut svg);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

impl Plot<'_> {
    fn write(&self, svg: &mut String) {
        let numbers = || self.ticks.iter().map(|(number, _)| *number);
        let (first, last) = (numbers().fold(f64::MAX, f64::min), numbers().fold(0.0, f64::max));
        let span = if last > first { (last / first).ln() } else { 1.0 };
        let across = |number: f64| MARGIN + (number / first).ln() / span * (WIDTH - 2.5 * MARGIN);
        let all = || self.curves.iter().flat_map(|curve| &curve.values).copied();
        let (least, most) = (all().fold(f64::MAX, f64::min), all().fold(0.0, f64::max));
        let (low, high) = (least.log10().floor(), most.log10().ceil().max(least.log10().floor() + 1.0));
        let down =
            |value: f64| MARGIN / 2.0 + (high - value.log10()) / (high - low) * (HEIGHT - 1.5 * MARGIN);
        for (number, name) in &self.ticks {
            let (x, y) = (across(*number), HEIGHT - MARGIN);
            let _ = writeln!(
                svg,
                "<path d=\"M{x:.1} {:.1}V{y:.1}\" stroke=\"#ddd\"/><text x=\"{x:.1}\" y=\"{:.1}\" \
                 text-anchor=\"middle\">{name}</text>",
                MARGIN / 2.0,
                y + 16.0
            );
        }
        for power in low as i32..=high as i32 {
            let y = down(10f64.powi(power));
            let _ = writeln!(
                svg,
                "<path d=\"M{MARGIN} {y:.1}H{:.1}\" stroke=\"#ddd\"/><text x=\"{:.1}\" y=\"{:.1}\" \
                 text-anchor=\"end\">{}</text>",
                WIDTH - 1.5 * MARGIN,
                MARGIN - 6.0,
                y + 4.0,
                (self.power)(power)
            );
        }
        for (number, Curve { name, color, values }) in self.curves.iter().enumerate() {
            let points: Vec<String> = numbers()
                .zip(values)
                .map(|(number, value)| format!("{:.1},{:.1}", across(number), down(*value)))
                .collect();
            let (x, y) = (WIDTH - 1.3 * MARGIN, MARGIN + 18.0 * number as f64);
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
                 <text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\">{name}</text>",
                points.join(" ")
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            WIDTH / 2.0 - MARGIN / 4.0,
            HEIGHT - 14.0,
            self.across
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_go_from_tick_to_tick() {
        let ticks = vec![(1.0, "one".to_owned()), (10.0, "ten".to_owned()), (100.0, "many".to_owned())];
        let curves = vec![Curve { name: "line", color: "#123456", values: vec![0.1, 1.0, 10.0] }];
        let plot = Plot { across: "things", ticks, power: &|power| format!("10^{power}"), curves };
        let svg = svg(&[plot]);
        // From the lower left to the upper right corner, through the middle.
        assert!(svg.contains("points=\"56.0,304.0 266.0,166.0 476.0,28.0\""), "{svg}");
        for text in [">one<", ">many<", ">10^-1<", ">10^1<", ">things<", "\"#123456\">line<"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
    }
}
