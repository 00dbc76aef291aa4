//! Tests of files that mean harm: pipes, devices, links, and paths that lead elsewhere.

use std::fs::{self, File};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rayline_simulator::raster::Raster;

use crate::bench::{BALL, Bench, SQUARE, pixels};

/// A scene whose ball has this picture, and a mesh.
fn scene(picture: &str, mesh: &str) -> String {
    format!(
        "Scene(
            camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
            materials: [(ambient: 1, diffuse: 0, color: Placed(figure: Image(\"{picture}\")))],
            objects: [(shape: Mesh(\"{mesh}\"), material: 0)],
        )"
    )
}

const TRIANGLE: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
const RED: &[u8] = b"P6 1 1 255 \xff\x00\x00";

impl Bench {
    /// Makes a named pipe; false where there is no command for it.
    fn pipe(&self, name: &str) -> bool {
        Command::new("mkfifo").arg(self.path(name)).status().is_ok_and(|status| status.success())
    }

    /// The message of a run that must fail in time.
    fn error_in_time(&self, arguments: &[&str], input: impl Into<Stdio>) -> String {
        let output = self.run_in_time(arguments, input);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        String::from_utf8(output.stderr).unwrap().trim().to_owned()
    }

    /// A render of a small picture that must succeed in time: its pixels and the notes.
    fn render_in_time(&self, scene: &[&str], input: impl Into<Stdio>) -> (Vec<u8>, String) {
        let output = self.run_in_time(&[&["render", "-o", "-", "--size", "16x12"], scene].concat(), input);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{scene:?}: {said}");
        (Raster::decode(&output.stdout).unwrap().rgb(), said)
    }
}

#[test]
fn pipes_devices_and_folders_are_not_read() {
    let bench = Bench::new();
    fs::create_dir(bench.path("folder.obj")).unwrap();
    symlink("/dev/zero", bench.path("zero.obj")).unwrap();
    symlink("/dev/zero", bench.path("zero.ppm")).unwrap();
    bench.write("triangle.obj", TRIANGLE);
    bench.write("device.ron", scene("zero.ppm", "triangle.obj"));
    let mut cases = vec![
        ("zero.obj", "cannot read zero.obj: it is a device, and only regular files are read"),
        ("folder.obj", "cannot read folder.obj: it is a folder, and only regular files are read"),
    ];
    if bench.pipe("pipe.nff") && bench.pipe("pipe.obj") {
        bench.write("red.ppm", RED);
        bench.write("pipe.ron", scene("red.ppm", "pipe.obj"));
        cases.push(("pipe.nff", "cannot read pipe.nff: it is a pipe, and only regular files are read"));
        cases.push(("pipe.ron", "pipe.ron:4:37: `pipe.obj`: cannot read pipe.obj: it is a pipe"));
    }
    for (name, expected) in cases {
        for command in [&["render", name][..], &["check", name], &["pixel", name, "0,0"]] {
            let error = bench.error_in_time(command, Stdio::null());
            assert!(error.starts_with(&format!("rayline: {expected}")), "{error}");
        }
    }
    // From within a scene, too.
    let error = bench.error_in_time(&["render", "device.ron", "--allow-paths"], Stdio::null());
    assert!(error.contains("`zero.ppm`: it is a device"), "{error}");
    let error = bench.error_in_time(&["render", "/dev/zero", "--format", "nff"], Stdio::null());
    assert!(error.contains("it is a device"), "{error}");
    // A device as standard input is read up to the limit.
    let error = bench.error_in_time(&["render", "-", "--format", "nff"], File::open("/dev/zero").unwrap());
    assert_eq!(
        error,
        "rayline: cannot read standard input: it has more than 512 MiB, which is the limit; use a smaller file"
    );
}

#[test]
fn files_beyond_the_limit_are_refused_at_once() {
    let bench = Bench::new();
    File::create(bench.path("large.obj")).unwrap().set_len((1 << 29) + 1).unwrap();
    let error = bench.error_in_time(&["render", "large.obj"], Stdio::null());
    assert_eq!(
        error,
        "rayline: cannot read large.obj: it has more than 512 MiB, which is the limit; use a smaller file"
    );
    let help = bench.output(&["render", "--help"]).split_whitespace().collect::<Vec<_>>().join(" ");
    for limit in ["512 MiB in one file", "1024 MiB in all files", "4096 files", "67108864 pixels", "65535"] {
        assert!(help.contains(limit), "{limit}: {help}");
    }
}

#[test]
fn a_scene_refers_to_files_in_its_folder_only() {
    let outer = Bench::new();
    fs::create_dir_all(outer.path("scenes/parts")).unwrap();
    outer.write("out.mtl", "newmtl red\nKd 0 1 0\n");
    outer.write("out.ppm", RED);
    outer.write("out.obj", TRIANGLE);
    outer.write("scenes/in.mtl", "newmtl red\nKd 1 0 0\n");
    outer.write("scenes/in.ppm", RED);
    outer.write("scenes/in.obj", TRIANGLE);
    symlink("../out.mtl", outer.path("scenes/link.mtl")).unwrap();
    symlink("../out.ppm", outer.path("scenes/link.ppm")).unwrap();
    symlink("in.mtl", outer.path("scenes/inner.mtl")).unwrap();
    let green = |pixels: &[u8]| pixels.chunks(3).any(|pixel| pixel[1] > 100 && pixel[0] < 50);
    let absolute = outer.path("out.mtl").to_string_lossy().into_owned();
    for name in ["../out.mtl", &absolute, "link.mtl", "parts/../../out.mtl"] {
        outer.write("scenes/model.obj", SQUARE.replace("square.mtl", name));
        let (pixels, notes) = outer.render_in_time(&["scenes/model.obj"], Stdio::null());
        assert!(!green(&pixels) && notes.contains("not in the folder of the scene or below it"), "{notes}");
        let (pixels, notes) = outer.render_in_time(&["scenes/model.obj", "--allow-paths"], Stdio::null());
        assert!(green(&pixels) && !notes.contains("not in the folder"), "{name}: {notes}");
    }
    for name in ["in.mtl", "./in.mtl", "parts/../in.mtl", "inner.mtl"] {
        outer.write("scenes/model.obj", SQUARE.replace("square.mtl", name));
        let (_, notes) = outer.render_in_time(&["scenes/model.obj"], Stdio::null());
        assert!(!notes.contains("left out"), "{name}: {notes}");
    }
    for (picture, mesh) in [("../out.ppm", "in.obj"), ("link.ppm", "in.obj"), ("in.ppm", "../out.obj")] {
        outer.write("scenes/scene.ron", scene(picture, mesh));
        let error = outer.error_in_time(&["render", "scenes/scene.ron"], Stdio::null());
        assert!(
            error.contains(
                "it is not in the folder of the scene or below it; move it there, or use --allow-paths"
            ),
            "{error}"
        );
        outer.render_in_time(&["scenes/scene.ron", "--allow-paths"], Stdio::null());
    }
    // A model in a folder of the scene may use what lies beside that folder.
    outer.write("scenes/parts/model.obj", format!("mtllib ../in.mtl\n{TRIANGLE}"));
    outer.write("scenes/scene.ron", scene("in.ppm", "parts/model.obj"));
    outer.render_in_time(&["scenes/scene.ron"], Stdio::null());
}

#[test]
fn standard_input_is_a_scene_in_the_current_folder() {
    let bench = Bench::new();
    bench.write("ball.nff", BALL);
    bench.write("square.mtl", "newmtl red\nKd 1 0 0\n");
    bench.write("square.obj", SQUARE);
    bench.write("in.ppm", RED);
    bench.write("in.obj", TRIANGLE);
    bench.write("scene.ron", scene("in.ppm", "in.obj"));
    bench.output(&["convert", "scene.ron", "scene.rayline", "--quiet"]);
    for (name, format) in [
        ("ball.nff", Some("nff")),
        ("square.obj", Some("obj")),
        ("scene.ron", None),
        ("scene.ron", Some("ron")),
        ("scene.rayline", None),
    ] {
        let format = format.map_or_else(Vec::new, |format| vec!["--format", format]);
        let piped = bench.render_in_time(&[&["-"], &format[..]].concat(), bench.open(name)).0;
        assert!(piped == bench.render_in_time(&[name], Stdio::null()).0, "{name}");
    }
    bench.write("broken.nff", "v from 0 0");
    for (name, arguments, expected) in [
        ("square.obj", &["-"][..], "the format of standard input is not known; name it with --format"),
        ("broken.nff", &["-", "--format", "nff"], "standard input:1: the file ends where"),
    ] {
        let error = bench.error_in_time(&[&["render"], arguments].concat(), bench.open(name));
        assert!(error.starts_with(&format!("rayline: {expected}")), "{error}");
    }
    // The file of a picture needs a name.
    bench.run_in_time(&["render", "-", "--size", "8x6"], bench.open("scene.ron"));
    assert_eq!(pixels(&bench.path("stdin.png")).0, 8);
    // A file without extension can be read as well.
    fs::rename(bench.path("ball.nff"), bench.path("ball")).unwrap();
    bench.render_in_time(&["ball", "--format", "nff"], Stdio::null());
}

/// The arguments of each kind of output, without the path.
const OUTPUTS: [&[&str]; 5] = [
    &["render", "classic", "--size", "8x6", "-o"],
    &["render", "classic", "--size", "8x6", "-o", "picture.png", "--stats"],
    &["record", "classic", "--size", "8x6", "--seconds", "0.2", "-o"],
    &["convert", "classic"],
    &["bake", "classic"],
];

#[test]
fn outputs_go_through_standard_output_devices_and_pipes() {
    let bench = Bench::new();
    let begins: [&[u8]; 5] = [b"\x89PNG", b"{", b"GIF8", b"(", b"//"];
    for (arguments, begin) in OUTPUTS.iter().zip(begins) {
        let to = |path: &str| bench.run_in_time(&[arguments, &[path][..]].concat(), Stdio::null());
        let written = to("-");
        let said = String::from_utf8_lossy(&written.stderr);
        assert!(written.status.success(), "{arguments:?}: {said}");
        assert!(written.stdout.starts_with(begin), "{arguments:?}");
        assert!(said.contains("8x6") || said.contains("bytes;"), "{said}");
        assert!(to("/dev/stdout").stdout.starts_with(begin), "{arguments:?}");
        assert!(to("/dev/null").status.success(), "{arguments:?}");
        assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
        symlink("/dev/stdout", bench.path("link")).unwrap();
        assert!(to("link").stdout.starts_with(begin), "{arguments:?}");
        assert!(bench.path("link").is_symlink());
        fs::remove_file(bench.path("link")).unwrap();
        if bench.pipe("pipe") {
            let path = bench.path("pipe");
            let reader = std::thread::spawn(move || fs::read(path).unwrap());
            assert!(to("pipe").status.success(), "{arguments:?}");
            assert!(reader.join().unwrap().starts_with(begin), "{arguments:?}");
            assert!(bench.path("pipe").metadata().unwrap().file_type().is_fifo());
            fs::remove_file(bench.path("pipe")).unwrap();
        }
    }
    let error = bench.error_in_time(&["render", "classic", "-o", "-", "--stats", "-"], Stdio::null());
    assert!(error.contains("two files cannot be written to standard output"), "{error}");
}

#[test]
fn outputs_follow_links_and_keep_permissions() {
    let bench = Bench::new();
    fs::create_dir(bench.path("elsewhere")).unwrap();
    let names = ["a.png", "a.json", "a.gif", "a.ron", "a.rs"];
    for (arguments, name) in OUTPUTS.iter().zip(names) {
        let target = bench.path("elsewhere").join(name);
        symlink(Path::new("elsewhere").join(name), bench.path(name)).unwrap();
        let write = || {
            let output = bench.run_in_time(&[arguments, &[name][..]].concat(), Stdio::null());
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            assert!(bench.path(name).is_symlink() && target.metadata().unwrap().len() > 10, "{name}");
        };
        // The link leads to nothing at first.
        write();
        for mode in [0o600, 0o640, 0o755] {
            fs::write(&target, "old").unwrap();
            fs::set_permissions(&target, fs::Permissions::from_mode(mode)).unwrap();
            write();
            assert_eq!(target.metadata().unwrap().permissions().mode() & 0o777, mode, "{name}");
        }
    }
    // Nothing is left behind.
    assert_eq!(fs::read_dir(bench.path("elsewhere")).unwrap().count(), names.len());
    symlink("circle.png", bench.path("circle.png")).unwrap();
    let error = bench.error_in_time(&["render", "classic", "-o", "circle.png"], Stdio::null());
    assert!(error.contains("its symbolic links lead in a circle"), "{error}");
}

/// The page of a gallery may be a pipe, or a link.
#[test]
fn galleries_follow_links_and_never_hang() {
    let bench = Bench::new();
    bench.write("scene.ron", scene("in.ppm", "in.obj"));
    bench.write("in.ppm", RED);
    bench.write("in.obj", TRIANGLE);
    bench.write("page.md", "# Gallery\n\nWritten by `rayline gallery`");
    bench.write("picture", "old");
    symlink("page.md", bench.path("README.md")).unwrap();
    symlink("picture", bench.path("scene.png")).unwrap();
    let output = bench.run_in_time(&["gallery", "."], Stdio::null());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(bench.path("README.md").is_symlink() && bench.path("scene.png").is_symlink());
    assert!(fs::read_to_string(bench.path("page.md")).unwrap().contains("scene.png"));
    assert_eq!(pixels(&bench.path("picture")).0, 320);
    if bench.pipe("pipe.ron") {
        let error = bench.error_in_time(&["gallery", "."], Stdio::null());
        assert!(error.contains("it is a pipe"), "{error}");
    }
}

/// Earlier versions took minutes, or more than an hour.
#[test]
fn large_scenes_and_pictures_take_seconds() {
    let bench = Bench::new();
    let balls = "s 0 0 0 1\n".repeat(60_000);
    bench.write("equal.nff", BALL.replace("s 0 0 0 1\n", &balls));
    // So does a scene that names one mesh of 800 triangles 3,000 times.
    let vertex =
        |index: u32| format!("v {} {} 0\n", f64::from(index % 21) / 20.0, f64::from(index / 21) / 20.0);
    let face = |index: u32| {
        let first = index / 20 * 21 + index % 20 + 1;
        format!("f {first} {} {} {}\n", first + 1, first + 22, first + 21)
    };
    let mesh: String = (0..441).map(vertex).chain((0..400).map(face)).collect();
    bench.write("mesh.obj", mesh);
    let object = "(shape: Mesh(\"mesh.obj\"), material: 0),";
    bench.write("in.ppm", RED);
    bench.write(
        "meshes.ron",
        scene("in.ppm", "mesh.obj").replace("(shape: Mesh(\"mesh.obj\"), material: 0)", &object.repeat(3000)),
    );
    for equal in ["equal.nff", "meshes.ron"] {
        let start = Instant::now();
        for arguments in [&["render", equal, "--size", "320x240"][..], &["check", equal]] {
            assert!(bench.run_in_time(arguments, Stdio::null()).status.success(), "{equal}");
        }
        // Ten times as long as it takes, for machines that do other things as well.
        assert!(start.elapsed() < Duration::from_secs(15), "{equal}: {:?}", start.elapsed());
    }
    let ball = |index: u32| {
        format!(
            "\"{index}\": (shape: Sphere(center: ({index}, 0, 0), radius: 0.4), material: \"{}\"),",
            index % 9000
        )
    };
    let materials: String = (0..9000).map(|index| format!("\"{index}\": (diffuse: 1),")).collect();
    let balls: String = (0..60_000).map(ball).collect();
    let motions: String =
        (0..2000).map(|index| format!("(of: Object(\"{index}\"), by: (0, 1, 0)),")).collect();
    bench.write(
        "named.ron",
        format!(
            "(camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
            materials: {{{materials}}}, objects: {{{balls}}}, motions: [{motions}])"
        ),
    );
    bench.render_in_time(&["named.ron"], Stdio::null());
    let checked = bench.run_in_time(&["check", "classic", "--size", "65535x65535"], Stdio::null());
    let said = String::from_utf8(checked.stdout).unwrap();
    assert!(said.contains("estimated from one pixel of 91 in one line of 91"), "{said}");
}
