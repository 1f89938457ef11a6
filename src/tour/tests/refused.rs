//! What does not read, and what is said about it: one clear problem for each fault, with its place.

use super::*;

#[test]
fn a_path_that_leaves_the_folder_is_refused_in_every_field() {
    for (place, path) in Tour::read(FULL).unwrap().files() {
        for bad in ["../x.png", "/x.png", "C:/x.png", "http://x.org/x.png", "a\\\\..\\\\x.png", ""] {
            let found = problems_with(&format!("{:?}", path.as_str()), &format!("\"{bad}\""));
            only(&found, &place, &["path", "tour's folder"]);
        }
    }
}

#[test]
fn a_text_that_is_no_tour_gets_one_clear_problem() {
    for (text, words) in [
        ("", ["1:1", "empty", "picture-tour new"]),
        ("  \n// nothing\n", ["1:1", "empty", "picture-tour new"]),
        ("{\"version\": 1}", ["1:1", "no tour file", "picture-tour new"]),
        ("\u{89}PNG\r\n\u{1a}\nxyz", ["1:1", "no tour file", "picture-tour new"]),
        ("Dear reader,\nthis is a letter.", ["1:1", "no tour file", "picture-tour new"]),
        ("Thus spoke the lake", ["1:1", "read as RON", "picture-tour new"]),
        ("(hello world)", ["1:", "read as RON", "picture-tour new"]),
    ] {
        let found = problems(text);
        assert_eq!(found.len(), 1, "{text:?}: {found:?}");
        let shown = Problems(found).with_file("lake.tour.ron").to_string();
        for word in words.iter().chain(&["lake.tour.ron:1"]) {
            assert!(shown.contains(word), "{word} is not in: {shown}");
        }
    }
}

#[test]
fn a_truncated_file_is_told_as_such_wherever_it_ends() {
    let end = FULL.trim_end().len();
    for length in (40..end).filter(|&length| FULL.is_char_boundary(length)) {
        let found = problems(&FULL[..length]);
        let last = found.last().unwrap();
        assert!(last.message.contains("ends in the middle") && last.place.line.is_some(), "{length}: {last}");
    }
}

#[test]
fn hostile_texts_end_in_problems_soon() {
    let nested = |open: &str| format!("(version: 1, picture: {}", open.repeat(100_000));
    let many_bad_points = format!("Polygon([{}])", "(NaN, 0),".repeat(4000));
    let too_many_corners = format!("Polygon([{}])", "(0, 0),".repeat(100_000));
    let old = "Polygon([(0, 517), (1920, 516), (1920, 1080), (0, 1080)])";
    let texts = [
        nested("("),
        nested("["),
        nested("{a:"),
        nested("/*"),
        nested("Some("),
        FULL.replace(old, &many_bad_points),
        FULL.replace(old, &too_many_corners),
        format!("({})", "a: 1,".repeat(20_000)),
    ];
    for text in texts {
        let start = std::time::Instant::now();
        let found = problems(&text);
        let seconds = start.elapsed().as_secs_f64();
        assert!(!found.is_empty() && seconds < 5.0, "{seconds} s for {}", &text[..40]);
    }
}

#[test]
fn versions_are_told_apart() {
    only(&problems_with("version: 1,", ""), "version", &["missing", "version: 1"]);
    only(&problems_with("version: 1,", "version: 0,"), "version", &["missing"]);
    let newer = FULL.replace("version: 1,", "version: 2, colour: Red,").replace("wind:", "storm:");
    only(&problems(&newer), "version", &[":3:12", "newer version of the program", "2 > 1"]);
    only(&problems("(version: 99999999999)"), "version", &["newer version"]);
}

#[test]
fn every_unknown_field_is_told_with_its_nearest_name() {
    let text = FULL
        .replace("damping: 0.1", "dampening: 0.1")
        .replace("principal_point", "principle_point")
        .replace("sky: (", "heaven: 3, sky: (drift_speed: 1, ")
        .replace("hold: 1", "speed: 1")
        .replace("pairs: [", "contact: [], pairs: [");
    let found = problems(&text);
    let shown = Problems(found.clone()).to_string();
    assert_eq!(found.len(), 6, "{shown}");
    for (path, advice) in [
        ("objects[1].motion.dampening", "`damping`"),
        ("camera.principle_point", "`principal_point`"),
        ("heaven", "leave it out"),
        ("sky.drift_speed", "`drift`"),
        ("path.keyframes[1].speed", "has a field of that name"),
        ("water.contact", "`objects`"),
    ] {
        let problem = found.iter().find(|problem| problem.place.path == path);
        let problem = problem.unwrap_or_else(|| panic!("{path} is not in: {shown}"));
        assert!(problem.advice.contains(advice), "{problem}");
        assert!(problem.place.line.is_some(), "{problem}");
    }
}

#[test]
fn unknown_variants_and_wrong_types_get_advice() {
    let variant = problems_with("Painting", "Paintng");
    only(&variant, "", &[":4:", "`Paintng`", "write `Painting`"]);
    only(&problems_with("speed: 1.2", "speed: \"fast\""), "", &[":31:", "number"]);
    only(&problems_with("(1920, 1080), m", "(1920, -3), m"), "", &[":4:"]);
    only(&problems_with("support: Ground, ", ""), "", &["`support`", "missing"]);
    only(&problems_with("closed: true", "closed: yes"), "", &[":31:", "`true` or `false`"]);
    // Unknown fields before the place are told all the same.
    assert_eq!(problems(&FULL.replace("size: (", "sizes: (").replace("Trunk", "Tronk")).len(), 2);
}

#[test]
fn a_nested_problem_has_its_line_and_column() {
    let found = problems_with("(0, -11)", "(0, NaN)");
    only(&found, "objects[0].motion.waypoints[0]", &["finite"]);
    let line = FULL.lines().position(|line| line.contains("waypoints")).unwrap();
    let column = FULL.lines().nth(line).unwrap().find("(0, -11)").unwrap();
    assert_eq!((found[0].place.line, found[0].place.column), (Some(line + 1), Some(column + 1)));
    let shown = Problems(found).with_file("lake.tour.ron").to_string();
    let start = format!("lake.tour.ron:{}:{}: objects[0].motion.waypoints[0] = ", line + 1, column + 1);
    assert!(shown.starts_with(&start), "{shown} does not start with {start}");
}

#[test]
fn each_wrong_value_is_told_with_place_and_reason() {
    let cases: &[(&str, &str, &str, &str)] = &[
        ("(672, 314.8)", "(672, NaN)", "water.pairs[1].point", "no point near"),
        ("(0, 482.7)", "(inf, 482.7)", "camera.horizon[0]", "no point near"),
        ("((0, 482.7), (1920, 480))", "((5, 482.7), (5, 482.7))", "camera.horizon", "the same"),
        ("((0, 482.7), (1920, 480))", "((5, 0), (6, 900))", "camera.horizon", "vertical"),
        ("(1500, 1700.5)", "(1700.5, 1500)", "camera.focal_length", "Between(1500, 1700.5)"),
        ("Between(1500, 1700.5)", "Known(0)", "camera.focal_length.Known", "range"),
        ("meters: 3.2", "meters: -3.2", "camera.scale.meters", "range"),
        ("on: \"boat\", from", "on: \"baot\", from", "camera.scale.on", "write \"boat\""),
        ("on: \"boat\", name", "on: \"baot\", name", "water.pairs[0].on", "write \"boat\""),
        ("(1920, 1080), m", "(0, 1080), m", "picture.size", "no picture has this size"),
        ("width: 1800", "width: 1900", "picture.crop", "beyond"),
        ("width: 1800", "width: 0", "picture.crop", "keeps nothing"),
        (
            "[(0, 100), (300, 100), (150, 540)]",
            "[(0, 100), (300, 100)]",
            "objects[1].outline",
            "three corners",
        ),
        ("[(0, 100), (300, 100), (150, 540)]", "[(0, 9), (3, 9), (9, 9)]", "objects[1].outline", "no area"),
        ("(150, 540)])", "(150, 540), (90, 9)])", "objects[1].outline.Polygon[2]", "crosses itself"),
        ("(674.3, 696.3)", "(674.3, 316.3)", "water.pairs[1].reflection", "px above the horizon"),
        ("(672, 314.8)", "(672, 714.8)", "water.pairs[1].reflection", "above its point"),
        ("(674.3, 696.3)", "(674.3, 500)", "water.pairs[1].reflection", "dry land"),
        ("(400, 700)", "(400, 480.0)", "objects[2].contact[0]", "above the horizon"),
        ("((400, 700), (420, 700))", "((400, 700), (400, 700))", "objects[2].contact", "left"),
        ("\"buoy\"", "\"tree\"", "objects[2].name", "objects[1].name has the same"),
        ("\"buoy\"", "\" \"", "objects[2].name", "empty"),
        ("\"buoy\"", "\"water\"", "objects[2].name", "taken"),
        ("\"mountains\"", "\"buoy\"", "background.bands[1].name", "same name"),
        ("height_above_water: 0.67", "height_above_water: -1", "ground.height_above_water", "range"),
        ("Distance(90)", "Distance(0)", "background.place", "range"),
        (
            "Contact([(0, 517), (1920, 516)])",
            "Contact([(0, 517)])",
            "background.bands[0].place.Contact",
            "two points",
        ),
        ("[(0, -11), (5.5, -20)]", "[(0, -11)]", "objects[0].motion.waypoints", "two points"),
        ("speed: 1.2", "speed: 0", "objects[0].motion.speed", "0.01 to 30"),
        ("damping: 0.1", "damping: 2", "objects[1].motion.damping", "0.01 to 1"),
        ("mass: 40", "mass: NaN", "objects[2].motion.mass", "no finite number"),
        ("speed: 4", "speed: 200", "wind.speed", "0 to 60"),
        ("gusts: 0.5", "gusts: -1", "wind.gusts", "0 to 1"),
        ("count: 200", "count: 0", "waves.sea.count", "frames"),
        ("(1, 1.5, -2)", "(1, -1.5, -2)", "path.keyframes[1].position", "under water"),
        ("seconds: 5", "seconds: -5", "path.keyframes[1].seconds", "range"),
        ("speed: 1.5", "speed: NaN", "sky.drift.speed", "finite"),
    ];
    for (old, new, path, word) in cases {
        only(&problems_with(old, new), path, &[word]);
    }
}

#[test]
fn water_ground_and_horizon_must_not_all_be_missing() {
    let file = TourFile::new("lake.png".into());
    let found = Tour::check(file).unwrap_err().0;
    let messages: Vec<&str> = found.iter().map(|problem| problem.message.as_str()).collect();
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert!(messages[0].contains("neither a horizon nor two reflection pairs"), "{messages:?}");
    assert!(messages[1].contains("neither water nor ground"), "{messages:?}");

    let horizon = "    horizon: ((0, 482.7), (1920, 480)),\n";
    Tour::read(&FULL.replace(horizon, "")).expect("three pairs do without a horizon");
    let one_pair = example()
        .replace("horizon: ((0, 482.7), (1920, 482.7)),", "")
        .replace("(point: (672.0, 314.8), reflection: (674.3, 696.3), on: \"background\"),", "");
    only(&problems(&one_pair), "camera.horizon", &["mark the horizon"]);
    let two = problems(&example().replace("support: Water", "support: Ground"));
    assert_eq!(two.len(), 2, "no ground to stand on, and nothing floats there: {two:?}");
}

#[test]
fn several_problems_are_found_at_once_in_the_order_of_the_file() {
    let text = FULL
        .replace("lake.png", "../lake.png")
        .replace("method", "methods")
        .replace("(674.3, 696.3)", "(674.3, 316.3)")
        .replace("\"buoy\"", "\"tree\"")
        .replace("speed: 4", "speed: -4");
    let found = problems(&text);
    assert_eq!(found.len(), 5, "{}", Problems(found));
    assert!(found.is_sorted_by_key(|problem| problem.place.line), "{}", Problems(found));
}
