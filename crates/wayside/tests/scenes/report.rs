//! Promises of the report and its pictures to whoever opens them, on a page or on a telephone.

#![allow(clippy::unwrap_used, reason = "tests fail on unwrap")]

use crate::common::{SMALL_SCENE, Workplace};

/// The room that a telephone of 400 pixels leaves between the page's margins.
const TELEPHONE_PX: f64 = 368.0;

fn report_of(scene: &str) -> (Workplace, String) {
    let place = Workplace::new();
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out out");
    let text = String::from_utf8(place.bytes("out/report.html")).unwrap();
    (place, text)
}

/// Each drawing of a page, from its first word to its last.
fn drawings(page: &str) -> Vec<&str> {
    page.split("<svg").skip(1).map(|rest| rest.split("</svg>").next().unwrap()).collect()
}

/// Numbers of an attribute, wherever it stands.
fn numbers(text: &str, attribute: &str) -> Vec<f64> {
    let begin = format!("{attribute}=\"");
    let values = text.split(&begin).skip(1);
    values.map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect()
}

#[test]
fn every_picture_is_named_for_those_who_cannot_see_it_and_read_by_those_who_can() {
    let (_place, page) = report_of(SMALL_SCENE);
    let drawings = drawings(&page);
    assert!(drawings.len() >= 8, "four pictures of two frames");
    for drawing in &drawings {
        assert!(
            drawing.contains("<title>") && drawing.contains("role=\"img\" aria-label=\""),
            "{}",
            &drawing[..200]
        );
        let smallest = numbers(drawing, "font-size").into_iter().fold(f64::INFINITY, f64::min);
        assert!(smallest >= 12.0, "words of {smallest} px in {}", &drawing[..200]);
    }
}

#[test]
fn every_picture_has_a_form_that_fits_a_telephone_with_words_as_large() {
    let (_place, page) = report_of(SMALL_SCENE);
    for figure in page.split("<figure>").skip(1) {
        let widths: Vec<f64> = drawings(figure).iter().map(|drawing| numbers(drawing, " width")[0]).collect();
        assert_eq!(widths.len(), 2, "a form for a page, one for a telephone");
        assert!(widths[1] <= TELEPHONE_PX, "{widths:?}");
    }
    let tables = page.matches("<table>").count();
    assert_eq!(page.matches("<div class=\"scroll\" tabindex=\"0\" role=\"region\"").count(), tables);
}

#[test]
fn a_report_names_its_command_and_links_to_what_lies_beside_it() {
    let (place, page) = report_of(SMALL_SCENE);
    assert!(page.contains("wayside run small.toml --out out"));
    let links: Vec<&str> =
        page.split(" href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    for artifact in [
        "scene.scene",
        "frames.paths",
        "frames.cube",
        "frames.rdm",
        "frames.points",
        "frames.tracks",
        "summary.json",
    ] {
        assert!(links.contains(&artifact), "{artifact} of {links:?}");
    }
    links.iter().for_each(|link| assert!(place.path("out").join(link).exists(), "{link}"));
}

/// Numbers that the view's script reads of a page.
fn data_of_view(page: &str) -> serde_json::Value {
    let data = page.split("id=\"viewer-data\">").nth(1).unwrap().split("</script>").next().unwrap();
    serde_json::from_str(data).unwrap()
}

#[test]
fn the_view_holds_its_numbers_and_its_script_and_the_drawings_stand_for_it_without() {
    let (_place, page) = report_of(SMALL_SCENE);
    let data = data_of_view(&page);
    let frames = data["frames"].as_array().unwrap();
    assert_eq!((frames.len(), data["frames_all"].as_u64()), (2, Some(2)));
    let shown = &frames[1]["shown"];
    assert_eq!(shown["bodies"][0]["id"], "corner-1");
    assert_eq!(frames[1]["targets"][1]["id"], "reflector");
    // 16 rows of 64 cells, 2 bytes each: 4 letters for every 3 bytes, filled up.
    let letters = shown["map"]["levels_db"]["base64"].as_str().unwrap().len();
    assert_eq!(letters, (2_usize * 16 * 64).div_ceil(3) * 4);
    assert!(page.contains("function startViewer()") && page.contains("<section id=\"viewer\" hidden>"));
    assert!(page.contains("<noscript>") && page.contains("@media print{#viewer{display:none}}"));
    // Nothing is fetched: the page is one file.
    for fetched in ["<script src", "<link", "@import", "import ", "fetch("] {
        assert!(!page.contains(fetched), "{fetched}");
    }
}

#[test]
fn the_view_tells_which_heights_are_assumed_and_which_measured() {
    // Codes of what heights stand on: 0 measured, 1 assumed.
    for (array, assumed_m, code) in [("1x4", Some(0.75), 1), ("6x8", None, 0)] {
        let (_place, page) = report_of(&SMALL_SCENE.replace("1x4", array));
        let data = data_of_view(&page);
        let shown = &data["frames"][0]["shown"];
        assert_eq!(shown["assumed_height_m"].as_f64(), assumed_m, "{array}");
        let objects = shown["objects"].as_array().unwrap();
        assert!(!objects.is_empty() && objects.iter().all(|object| object["height"] == code), "{objects:?}");
        assert!(shown["points"]["heights"]["base64"].is_string(), "{array}");
        assert!(page.contains("The array does not measure heights: points and objects are drawn"));
    }
}

#[test]
fn the_view_shows_the_strongest_paths_and_tells_the_power_of_all() {
    let (_place, page) = report_of(SMALL_SCENE);
    let paths = &data_of_view(&page)["frames"][0]["shown"]["paths"];
    let all = paths["all"].as_u64().unwrap();
    let of_bodies: Vec<f64> =
        paths["power_of_bodies_w"].as_array().unwrap().iter().map(|power| power.as_f64().unwrap()).collect();
    let sum = paths["all_power_w"].as_f64().unwrap();
    assert!(all >= 2 && of_bodies.iter().all(|power| *power > 0.0), "{paths}");
    // Both are sums of the same `all` numbers in another order.
    assert!((of_bodies.iter().sum::<f64>() - sum).abs() <= all as f64 * f64::EPSILON * sum);
}

#[test]
fn names_cannot_end_the_script_that_holds_them() {
    let name = "<!--<script>.obj";
    let place = Workplace::new();
    std::fs::write(place.path(name), crate::common::CORNER).unwrap();
    let scene = SMALL_SCENE.replace("model = \"corner.obj\"", &format!("model = \"{name}\""));
    std::fs::write(place.path("small.toml"), scene).unwrap();
    place.run("run small.toml --out out");
    let page = String::from_utf8(place.bytes("out/report.html")).unwrap();
    assert!(!page.contains("<!--<script>"));
    assert_eq!(data_of_view(&page)["frames"][0]["targets"][0]["model"], name);
}

#[test]
fn a_report_of_many_frames_is_not_much_larger_than_one_of_few() {
    let of = |frames: u32| {
        let (_place, page) = report_of(&SMALL_SCENE.replace("frames = 2", &format!("frames = {frames}")));
        let data = data_of_view(&page);
        (data["frames"].as_array().unwrap().len(), data["every"].as_u64().unwrap())
    };
    assert_eq!(of(30), (15, 2), "at most 24 frames");
}

#[test]
fn the_numbers_of_the_view_do_not_depend_on_the_number_of_threads() {
    let of = |threads: u32| {
        let place = Workplace::new();
        place.run(&format!("run small.toml --out out --threads {threads}"));
        data_of_view(&String::from_utf8(place.bytes("out/report.html")).unwrap())
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn a_report_speaks_as_the_field_does() {
    let (_place, page) = report_of(SMALL_SCENE);
    for words in
        ["Chirp interval", "Samples per chirp", "Maximum unambiguous velocity", "predicted class", "aliased"]
    {
        assert!(page.contains(words), "{words}");
    }
    for words in ["Pulse time", "Sampling points", "abnormal"] {
        assert!(!page.contains(words), "{words}");
    }
}

#[test]
fn truth_and_objects_stand_in_the_plan_the_map_and_the_points() {
    let (_place, page) = report_of(SMALL_SCENE);
    for title in ["Scene from above, frame 0", "Range-Doppler map, frame 0", "Point cloud, frame 0"] {
        let of_title = drawings(&page).into_iter().filter(|d| d.contains(&format!("aria-label=\"{title}")));
        let found: Vec<&str> = of_title.collect();
        assert_eq!(found.len(), 2, "{title}");
        for drawing in found {
            assert!(drawing.contains("truth") && drawing.contains("object"), "the legend of {title}");
            assert!(drawing.contains(">reflector<"), "a body's name in {title}");
        }
    }
}

#[test]
fn the_radar_its_boresight_and_its_field_of_view_are_in_the_plan() {
    let cosine = SMALL_SCENE
        .replace("preset = \"1x4\"", "preset = \"1x4\"\npattern = \"cosine\"\ncosine_exponent = 2.0");
    let (_place, page) = report_of(&cosine);
    let plan = drawings(&page).into_iter().find(|d| d.contains("aria-label=\"Scene from above")).unwrap();
    // cos⁴ θ is a half at 32.8°.
    for words in [">radar<", ">boresight<", "±33° (−3 dB of an element)"] {
        assert!(plan.contains(words), "{words}");
    }
}

#[test]
fn heights_are_drawn_where_the_array_measures_them_and_nowhere_else() {
    let (_place, flat) = report_of(SMALL_SCENE);
    assert!(!flat.contains("height, m") && flat.contains("heights are not measured"));
    let array = "tx_half_wavelengths = [[0.0, 0.0], [0.0, 1.0], [0.0, 2.0], [0.0, 3.0]]\n\
        rx_half_wavelengths = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]";
    let rows = SMALL_SCENE.replace("preset = \"1x4\"", array);
    let (_place, high) = report_of(&rows);
    assert!(
        high.contains("height, m")
            && high.contains("from the side")
            && !high.contains("heights are not measured")
    );
}

#[test]
fn what_lies_beyond_the_drawing_is_marked_at_its_edge() {
    let behind = format!(
        "{SMALL_SCENE}\n[[target]]\nkind = \"point\"\nid = \"behind\"\nrcs_m2 = 1.0\nposition_m = [3.0, -200.0, 1.0]\n\
         velocity_mps = [0.0, 0.0, 0.0]\n"
    );
    let (_place, page) = report_of(&behind);
    let plan = drawings(&page).into_iter().find(|d| d.contains("aria-label=\"Scene from above")).unwrap();
    assert!(plan.contains("beyond the drawing: 1 body"));
}

#[test]
fn a_map_is_exported_with_axes_on_request_and_other_artifacts_are_not() {
    let (place, _page) = report_of(SMALL_SCENE);
    place.run("export out/frames.rdm --to png --out plain.png");
    place.run("export out/frames.rdm --to png --axes on --out axes.png");
    let size =
        |name: &str| image::load_from_memory(&place.bytes(name)).map(|i| (i.width(), i.height())).unwrap();
    assert_eq!(size("plain-0000.png"), (451, 451));
    assert!(size("axes-0000.png").0 > 1000);
    let refused = place.try_run("export out/frames.points --to csv --axes on --out p.csv");
    assert_eq!(refused.status.code(), Some(2), "{}", String::from_utf8_lossy(&refused.stderr));
}

#[test]
fn pictures_with_numbers_replace_no_others_than_this_programs() {
    let (place, _page) = report_of(SMALL_SCENE);
    for kind in ["png", "exr"] {
        let own = format!("export out/frames.rdm --to {kind} --out own.{kind}");
        place.run(&own);
        place.run(&own); // its own, once more
        let foreign = format!("map-0000.{kind}");
        std::fs::write(place.path(&foreign), "a photograph").unwrap();
        let refused = place.try_run(&format!("export out/frames.rdm --to {kind} --out map.{kind}"));
        let told = String::from_utf8_lossy(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{told}");
        assert!(told.contains(&foreign) && told.contains("was not written by this program"), "{told}");
        assert_eq!(place.bytes(&foreign), b"a photograph");
    }
    place.run("export out/frames.rdm --to png --out bare");
    assert!(place.path("bare-0000").is_file(), "no dot without an ending");
}

#[test]
fn receding_is_above_in_the_exported_map() {
    // The point, 30.5 m away, recedes at 20 of the unambiguous 43 m/s.
    let one = SMALL_SCENE.replace("velocity_mps = [0.0, 0.0, 0.0]", "velocity_mps = [0.0, 20.0, 0.0]");
    let (place, _page) = report_of(&one);
    place.run("export out/frames.rdm --to png --out map.png");
    let map = image::load_from_memory(&place.bytes("map-0000.png")).unwrap().to_luma8();
    // 451 columns for 61.4 m, 7 for a range cell.
    let column = 451 * 305 / 614;
    let brightest = |rows: std::ops::Range<u32>| {
        let near = rows.flat_map(|y| (column - 10..column + 10).map(move |x| (x, y)));
        near.map(|(x, y)| map.get_pixel(x, y).0[0]).max().unwrap()
    };
    println!("receding {}, approaching {}", brightest(0..200), brightest(250..451));
    assert!(brightest(0..200) > brightest(250..451));
}

#[test]
fn the_view_of_a_table_holds_drawings_of_its_axes_in_both_forms_and_its_strongest_sequences() {
    let place = Workplace::new();
    for (axes, titles) in [
        (
            "--freq-ghz 76:78:3 --az-deg 0:2:3",
            &["Radar cross section over azimuth", "Radar cross section over frequency"][..],
        ),
        ("--freq-ghz 77 --az-deg 0", &[][..]),
    ] {
        place.run(&format!("rcs corner.obj {axes} --pictures --bounces 1 --out S.npy"));
        let page = String::from_utf8(place.bytes("S-view.html")).unwrap();
        let drawings = drawings(&page);
        assert_eq!(drawings.len(), 2 * titles.len(), "a form for a page, one for a telephone");
        for title in titles {
            let named = |drawing: &&&str| drawing.contains(&format!("aria-label=\"{title}\""));
            assert_eq!(drawings.iter().filter(named).count(), 2, "{title}");
        }
        assert!(page.contains("<noscript>") && page.matches("<table>").count() == 1);
    }
}

#[test]
fn pictures_of_a_table_say_on_which_axes_the_body_lies_upon_itself() {
    let place = Workplace::new();
    // 0.5 m deep and, at 0.01 rad steps, shown for λ/2Δφ = 0.19 m; c/2Δf is 0.15 m.
    let words = "rcs corner.obj --freq-ghz 76:78:3 --az-deg 0:1.1459:3 --pictures --bounces 1 --out S.npy";
    let told = place.run(words);
    assert!(
        told.contains("ambiguous in range: 3 frequencies")
            && told.contains("ambiguous in cross-range: 3 azimuths")
    );
    let pictures = &place.summary("S.json")["pictures"];
    println!("{pictures:#}");
    for (axis, values) in [("range", "frequencies"), ("cross_range", "azimuths")] {
        let (told, needed) = (&pictures[axis], pictures[axis]["needed"].as_u64().unwrap());
        assert_eq!((told["ambiguous"].as_bool(), told[values].as_u64()), (Some(true), Some(3)));
        assert!(needed > 3 && needed < 30, "{needed}");
    }
    let enough = pictures["range"]["needed"].as_u64().unwrap();
    let told = place.run(&format!(
        "rcs corner.obj --freq-ghz 76:78:{enough} --az-deg 0 --pictures --bounces 1 --out T.npy"
    ));
    assert!(!told.contains("ambiguous"));
    assert_eq!(place.summary("T.json")["pictures"]["range"]["ambiguous"], false);
}
