//! Tests of `rayline bench` and `rayline compare`.

use crate::bench::{Bench, pixels};

#[test]
fn tables_of_all_scenes_qualities_and_numbers() {
    let bench = Bench::new();
    let said = bench.output(&["bench", "--quick"]);
    let rows = |name: &str| -> Vec<Vec<String>> {
        let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
        said.lines().filter(|line| line.starts_with(&format!("| {name} "))).map(cells).collect()
    };
    for builtin in &rayline::builtin::ALL {
        let rows = rows(builtin.name);
        let kinds: Vec<_> = rows.iter().map(|row| format!("{} {}", row[2], row[3])).collect();
        let expected =
            ["exact f32", "exact fixed", "exact f64", "realtime f32", "realtime fixed", "realtime f64"];
        assert_eq!(kinds, expected, "{said}");
        assert_eq!(rows[2][8], "same bytes");
        for row in &rows {
            let number = |cell: &str| cell.replace(',', "").parse::<f64>().unwrap();
            assert!(row[4..8].iter().all(|cell| number(cell) > 0.0), "{row:?}");
            // The pictures are tiny here. The accuracy of larger ones is tested elsewhere.
            assert!(row[8] == "same bytes" || number(&row[8]) > 25.0, "{row:?}");
        }
    }
    // The second table needs POV-Ray.
    if said.contains("POV-Ray is not installed") {
        return;
    }
    for name in ["balls_s3", "teapot_s2", "rings_s1"] {
        let rows = rows(name);
        let alike: f64 = rows[0][8].trim_end_matches(" %").parse().unwrap();
        assert!(alike > 90.0, "{said}");
    }
    assert_eq!(bench.files(), Vec::<String>::new());
}

#[test]
fn both_ways_to_draw_are_compared() {
    let bench = Bench::new();
    let said = bench.output(&["compare", "classic", "--size", "160x120", "-q", "--plot", "plot.svg"]);
    assert_eq!(bench.files(), ["classic-compare.png", "plot.svg"]);
    // Four sizes of all objects, and the first 1 and 2 of the 5 objects.
    let rows: Vec<Vec<String>> = said
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| size") && !line.contains("---"))
        .map(|line| line.split('|').map(|cell| cell.trim().to_owned()).collect())
        .collect();
    let sizes: Vec<_> = rows.iter().map(|row| (row[1].as_str(), row[2].as_str())).collect();
    let whole = "160x120";
    assert_eq!(
        sizes,
        [("20x15", "5"), ("40x30", "5"), ("80x60", "5"), (whole, "5"), (whole, "1"), (whole, "2")],
        "{said}"
    );
    let number =
        |cell: &str| cell.trim_end_matches([' ', 'm', 's', 'B']).replace(',', "").parse::<f64>().unwrap();
    for row in &rows {
        assert!(row[3..10].iter().all(|cell| number(cell) > 0.0), "{row:?}");
        assert!(number(&row[9]) > number(&row[8]), "{row:?}");
    }
    // Of 64 times the pixels, there are about as many times the rays. Facets that cover no line are left out.
    assert!(number(&rows[3][3]) > 40.0 * number(&rows[0][3]), "{said}");
    assert!(number(&rows[3][4]) < 4.0 * number(&rows[0][4]), "{said}");
    assert!(said.contains("% of the pixels show another object"), "{said}");
    let plot = std::fs::read_to_string(bench.path("plot.svg")).unwrap();
    assert_eq!(plot.matches("<polyline").count(), 4);
    let (width, height, _) = pixels(&bench.path("classic-compare.png"));
    assert_eq!((width, height), (320, 120));
}
