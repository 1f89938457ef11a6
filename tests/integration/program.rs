//! The program as people run it: arguments in; exit status, output and files out.
//!
//! Status 0: done. 1: the tour has problems. 2: it could not run, a tour file that is not there included.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::process::Output;
use std::process::Stdio;

use bevy_picture_tour::picture::Picture;
use bevy_picture_tour::picture::PngPixels;
use bevy_picture_tour::picture::decode_picture;
use bevy_picture_tour::picture::save_png;
use glam::UVec2;
use tempfile::TempDir;

use crate::support::adapter;

const SIZE: UVec2 = UVec2::new(96, 54);

/// A folder with a small picture: light above, a mirror image below.
fn folder_with_picture() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let pixels: Vec<[u8; 3]> = (0..SIZE.y)
        .flat_map(|y| {
            (0..SIZE.x).map(move |x| (x as u8, if y < 30 { 8 * y as u8 } else { 250 - 4 * y as u8 }))
        })
        .map(|(x, y)| [2 * x, y, 120])
        .collect();
    save_png(&folder.path().join("pond.png"), SIZE, PngPixels::Rgb(&pixels)).unwrap();
    folder
}

/// The same with a tour that `new` wrote.
fn folder_with_tour() -> TempDir {
    let folder = folder_with_picture();
    let made = run(folder.path(), &["new", "pond.png"]);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    folder
}

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_picture-tour"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn png(path: &Path) -> Picture {
    decode_picture(&fs::read(path).unwrap(), "frame").unwrap().picture
}

#[test]
fn the_demo_has_no_problems_and_says_what_was_assumed() {
    let checked = run(Path::new("."), &["check"]);
    let text = stdout(&checked);
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    for word in ["focal length", "measured", "rowing boat", "predicted", "forward"] {
        assert!(text.contains(word), "{word:?} is missing in:\n{text}");
    }
}

#[test]
fn a_baked_tour_is_used_while_it_is_fresh_and_told_when_it_is_not() {
    let folder = folder_with_tour();
    let render = |to: &str| run(folder.path(), &["render", "pond.tour.ron", "--out", to, "--reference"]);
    assert_eq!(render("built").status.code(), Some(0));
    let made = run(folder.path(), &["bake", "pond.tour.ron"]);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let baked = folder.path().join("pond.tour.baked");
    let sound = fs::read(&baked).unwrap();
    assert!(stdout(&run(folder.path(), &["bake", "pond.tour.ron"])).contains("is fresh"));

    let frame = |from: &str| png(&folder.path().join(from).join("first_view.png"));
    let from_baked = render("baked");
    assert_eq!(stderr(&from_baked), "");
    assert_eq!(frame("baked"), frame("built"));

    let alone = run(folder.path(), &["render", "pond.tour.baked", "--out", "alone", "--reference"]);
    assert_eq!(alone.status.code(), Some(0), "{}", stderr(&alone));
    assert_eq!(frame("alone"), frame("built"));

    let mut damaged = sound.clone();
    let last = damaged.len() - 1;
    damaged[last] ^= 1;
    fs::write(&baked, damaged).unwrap();
    let told = stderr(&render("damaged"));
    assert!(told.contains("pond.tour.baked is not used") && told.contains("damaged"), "{told}");
    let alone = run(folder.path(), &["check", "pond.tour.baked"]);
    assert!(alone.status.code() == Some(2) && stderr(&alone).contains("damaged"), "{}", stderr(&alone));
    assert_eq!(frame("damaged"), frame("built"));

    fs::write(&baked, sound).unwrap();
    let picture = fs::read(folder.path().join("pond.png")).unwrap();
    // A byte behind the picture's end changes nothing but the file.
    fs::write(folder.path().join("pond.png"), [picture, vec![0]].concat()).unwrap();
    let told = stderr(&render("stale"));
    assert!(told.contains("stale") && told.contains("picture-tour bake"), "{told}");
}

#[test]
fn a_new_tour_checks_and_is_not_overwritten() {
    let folder = folder_with_tour();
    let before = fs::read(folder.path().join("pond.tour.ron")).unwrap();

    let checked = run(folder.path(), &["check", "pond.tour.ron"]);
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    assert!(stdout(&checked).contains("assumed"), "{}", stdout(&checked));

    let again = run(folder.path(), &["new", "pond.png"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("--force"), "{}", stderr(&again));
    assert_eq!(fs::read(folder.path().join("pond.tour.ron")).unwrap(), before);
    assert_eq!(run(folder.path(), &["new", "pond.png", "--force"]).status.code(), Some(0));
}

#[test]
fn a_tour_beside_another_folder_is_refused() {
    let folder = folder_with_picture();
    fs::create_dir(folder.path().join("sub")).unwrap();
    let refused = run(folder.path(), &["new", "pond.png", "--out", "sub/pond.tour.ron"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("not below it"), "{}", stderr(&refused));
}

#[test]
fn every_problem_is_told_with_file_and_line() {
    let folder = folder_with_tour();
    let path = folder.path().join("pond.tour.ron");
    let text = fs::read_to_string(&path).unwrap();
    let text = text.replace("medium:", "medum:").replace("HeightAboveWater(1.7)", "HeightAboveWater(-1)");
    fs::write(&path, &text).unwrap();
    let line = |what| text.lines().position(|line| line.contains(what)).unwrap() + 1;

    let checked = run(folder.path(), &["check", "pond.tour.ron"]);
    assert_eq!(checked.status.code(), Some(1));
    for what in ["medum", "HeightAboveWater(-1)"] {
        let place = format!("pond.tour.ron:{}:", line(what));
        assert!(stderr(&checked).contains(&place), "{place} is missing in:\n{}", stderr(&checked));
    }
    assert!(stderr(&checked).contains("`medium`"), "{}", stderr(&checked));

    let json = run(folder.path(), &["check", "pond.tour.ron", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json.status.code(), Some(1));
    assert_eq!(report["problems"].as_array().unwrap().len(), 2);
    assert_eq!(report["problems"][0]["line"], line("medum"));
}

#[test]
fn the_json_report_has_the_table_s_numbers() {
    let folder = folder_with_tour();
    let json = run(folder.path(), &["check", "pond.tour.ron", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json.status.code(), Some(0));
    assert_eq!(report["problems"], serde_json::json!([]));
    assert_eq!(report["parameters"][0]["name"], "focal_px");
    assert_eq!(report["components"][0]["name"], "background");
    assert!(report["bounds"]["left"].as_f64().unwrap() > 0.0);
}

#[test]
fn a_missing_tour_could_not_run() {
    let checked = run(Path::new("."), &["check", "no/such.tour.ron"]);
    assert_eq!(checked.status.code(), Some(2));
    assert!(stderr(&checked).contains("no/such.tour.ron"), "{}", stderr(&checked));
}

#[test]
fn views_become_frames_of_the_asked_size() {
    let folder = folder_with_tour();
    let views = r#"[{"name": "left", "position": [-0.4, 1.7, 0]},
                    {"name": "in front", "position": [0, 1.7, -1], "yaw_deg": 3}]"#;
    fs::write(folder.path().join("views.json"), views).unwrap();
    let arguments =
        ["--reference", "--samples", "4", "--size", "64x36", "--views", "views.json", "--out", "a/b"];
    let rendered = run(folder.path(), &[&["render", "pond.tour.ron"], &arguments[..]].concat());
    assert_eq!(rendered.status.code(), Some(0), "{}", stderr(&rendered));
    let frames = ["left.png", "in_front.png"].map(|name| png(&folder.path().join("a/b").join(name)));
    assert_eq!(frames.each_ref().map(Picture::size), [UVec2::new(64, 36); 2]);
    assert_ne!(frames[0], frames[1]);
}

#[test]
fn a_part_of_the_path_is_rendered_under_its_own_numbers() {
    let folder = folder_with_tour();
    let arguments =
        ["--path", "--fps", "2", "--frames", "3..5", "--reference", "--size", "32x18", "--out", "o"];
    let rendered = run(folder.path(), &[&["render", "pond.tour.ron"], &arguments[..]].concat());
    assert_eq!(rendered.status.code(), Some(0), "{}", stderr(&rendered));
    let mut files: Vec<_> =
        fs::read_dir(folder.path().join("o")).unwrap().map(|file| file.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["frame_00003.png", "frame_00004.png"]);
}

#[test]
fn bad_views_are_refused_with_their_index() {
    let folder = folder_with_tour();
    let views = r#"[{"name": "a", "position": [0, 1, 0]}, {"name": "b"}]"#;
    fs::write(folder.path().join("views.json"), views).unwrap();
    let arguments = ["render", "pond.tour.ron", "--reference", "--views", "views.json", "--out", "o"];
    let refused = run(folder.path(), &arguments);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("views.json: views[1]"), "{}", stderr(&refused));
}

#[test]
fn nobody_reading_is_no_fault() {
    let folder = folder_with_tour();
    let mut child = program(folder.path(), &["check", "pond.tour.ron"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(0), "{}", stderr(&ended));
    assert_eq!(stderr(&ended), "");
}

#[test]
fn one_frame_may_be_a_file_but_none_of_the_tour_s_own() {
    let folder = folder_with_tour();
    let view = |to: &str| run(folder.path(), &["render", "pond.tour.ron", "--reference", "--out", to]);
    let own = fs::read(folder.path().join("pond.png")).unwrap();
    fs::write(folder.path().join("views.json"), r#"[{"name": "pond", "position": [0, 1.5, 0]}]"#).unwrap();
    let render = ["render", "pond.tour.ron", "--reference", "--out"];
    let refusals: [&[&str]; 5] = [
        &["pond.png"],
        &["pond.tour.ron"],
        &[".", "--views", "views.json"],
        &["pond.png", "--views", "views.json"],
        &["./masks/../pond.png"],
    ];
    let rendered = refusals.map(|end| [&render[..], end].concat());
    let drawn = ["--sheet", "--depth"].map(|what| vec!["check", "pond.tour.ron", what, "pond.png"]);
    for arguments in rendered.into_iter().chain(drawn) {
        let refused = run(folder.path(), &arguments);
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&refused).contains("belongs to the tour"), "{arguments:?}: {}", stderr(&refused));
    }
    assert!(fs::read(folder.path().join("pond.png")).unwrap() == own, "the picture was touched");
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let refused = view("notes.txt");
    assert!(stderr(&refused).contains("notes.txt"), "{}", stderr(&refused));
    let one = view("one.png");
    assert!(one.status.success(), "{}", stderr(&one));
    assert!(folder.path().join("one.png").is_file());
    let path = ["render", "pond.tour.ron", "--reference", "--path", "--fps", "1", "--out", "many.png"];
    let refused = run(folder.path(), &path);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("frames do not fit into many.png"), "{}", stderr(&refused));
}

#[test]
fn a_loop_has_whole_frames_and_is_refused_where_it_cannot_be() {
    let Some(_gpu) = adapter() else { return };
    let folder = folder_with_tour();
    let arguments =
        ["render", "pond.tour.ron", "--out", "frames", "--loop", "8.04", "--fps", "10", "--frames", "78.."];
    let output = run(folder.path(), &arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let frames = fs::read_dir(folder.path().join("frames")).unwrap().count();
    assert_eq!(frames, 2, "80 frames of 0.1 s, of which two are asked for");
    for (arguments, why) in [
        (["--loop", "3", "--out", "frames"], "8 s to 3600 s"),
        (["--frames", "0..3", "--out", "frames"], "--loop"),
        (["--size", "64x36", "--out", "film.mp4"], "--path or --loop"),
    ] {
        let output = run(folder.path(), &[["render", "pond.tour.ron"].as_slice(), &arguments].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(why), "{}", stderr(&output));
    }
    assert!(!folder.path().join("film.mp4").exists());
}
