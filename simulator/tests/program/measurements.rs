//! Tests of `rayline bench`.

use crate::bench::Bench;

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
