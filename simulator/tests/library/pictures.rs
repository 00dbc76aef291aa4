//! Tests of pictures that the library renders.

use rayline::builtin::CLASSIC;
use rayline::{Material, Scene, Settings};
use rayline_simulator::{Mode, RenderOptions, render};

/// Equal opaque objects, which are left out, change no picture.
#[test]
fn equal_objects_change_no_picture() {
    let objects = [CLASSIC.objects, CLASSIC.objects].concat();
    let doubled = Scene { objects: &objects, ..CLASSIC };
    let options = RenderOptions::new(Settings::new(64, 48));
    // The glass of the scene stays twice.
    let opaque: Vec<_> =
        CLASSIC.materials.iter().map(|material| Material { transmittance: 0.0, ..*material }).collect();
    let [once, twice] =
        [CLASSIC, doubled].map(|scene| render(&Scene { materials: &opaque, ..scene }, &options).unwrap());
    assert!(once == twice);
}

#[test]
fn any_number_of_threads_and_any_lines_give_the_same_bytes() {
    let exact = RenderOptions { threads: 1, ..RenderOptions::new(Settings::new(61, 43)) };
    let options = RenderOptions { mode: Mode::Realtime, ..exact.clone() };
    let expected = render(&CLASSIC, &options).unwrap();
    assert!(expected.rays.camera < render(&CLASSIC, &exact).unwrap().rays.camera);
    for threads in [2, 3, 50] {
        let picture = render(&CLASSIC, &RenderOptions { threads, ..options.clone() }).unwrap();
        assert!(picture.rgb == expected.rgb, "{threads} threads");
    }
    for lines in [0..1, 7..43, 13..14] {
        let bytes = lines.start as usize * 61 * 3..lines.end as usize * 61 * 3;
        let picture = render(&CLASSIC, &RenderOptions { lines: Some(lines), ..options.clone() }).unwrap();
        assert!(picture.rgb == expected.rgb[bytes]);
    }
}
