//! Recordings of devices and arrays: `.npy`, DCA1000, SigMF, with what stands beside them, the
//! configurations of boards, and labels of datasets.

use crate::commands::{note, noted, noted_of_content, put};
use crate::sound;
use fuzzing::{Noise, Reader, change_json, change_json_like, change_numbers, changed_text};
use serde_json::{Value, json};
use std::path::Path;

/// Numbers of a frame: channels, chirps, samples of the small scene.
const SHAPE: [usize; 3] = [4, 16, 32];

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader::refusing("npy", 200, write_npy, noted_of_content),
        Reader::refusing("tensor", 40, write_tensor, noted_of_content),
        Reader::refusing("dca1000", 200, write_dca1000, noted_of_content),
        Reader::refusing("sigmf", 200, write_sigmf, noted),
        Reader::refusing("mat", 200, write_mat, noted_of_content),
        Reader::refusing("radar-cloud", 200, write_cloud, noted_of_content),
        Reader::refusing("device-config", 200, write_config, noted_of_content),
        Reader::refusing("set-labels", 100, write_labels, noted_of_content),
    ]
}

fn import(noise: &mut Noise, folder: &Path, file: &str) {
    sound::texts(folder);
    let step = noise.pick(&["", "", " --step=0.5", " --step=1e-30", " --step=1e30"]);
    // Files whose samples are never integers have no step.
    let step = if file.ends_with(".npy") || file.ends_with(".mat") { "" } else { step };
    note(folder, &format!("import @{file} --scene @sound/small.toml --out @O{step}"));
}

/// Bytes of so many values of frames of the small scene, sometimes more or fewer, some of them strange.
fn samples(noise: &mut Noise, of_a_value: usize) -> Vec<u8> {
    let frames = 1 + noise.below(3);
    let mut bytes: Vec<u8> =
        (0..frames * SHAPE.iter().product::<usize>() * of_a_value).map(|i| (i % 61) as u8).collect();
    if noise.one_in(3) {
        change_numbers(noise, &mut bytes);
    }
    match noise.below(8) {
        0 => bytes.truncate(noise.below(bytes.len())),
        1 => bytes.extend(vec![0; noise.times()]),
        2 => bytes.clear(),
        _ => {}
    }
    bytes
}

fn write_npy(noise: &mut Noise, folder: &Path) {
    let [channels, chirps, length] = SHAPE;
    let values = samples(noise, 8);
    let frames = values.len() / (8 * channels * chirps * length);
    let shape = noise.pick(&[
        "({f}, 4, 16, 32)",
        "({f}, 4, 16, 32)",
        "(4, 16, 32)",
        "(32, 16, 4, {f})",
        "({f}, 4, 16, 32,)",
    ]);
    let array = array(noise, &shape.replace("{f}", &frames.to_string()), values);
    put(folder, "x.npy", &array);
    import(noise, folder, "x.npy");
}

/// Range, azimuth and Doppler of the small scene.
fn write_tensor(noise: &mut Noise, folder: &Path) {
    let [_, chirps, length] = SHAPE;
    let values: Vec<u8> = (0..8 * chirps * length * 256).map(|i| (i % 61) as u8).collect();
    let shape =
        noise.pick(&["(32, 256, 16)", "(32, 256, 16)", "(32, 256, 16)", "(16, 256, 32)", "(32, 16, 256)"]);
    let mut array = array(noise, shape, values);
    if noise.one_in(3) {
        let from = array.len() - noise.below(array.len() / 2);
        change_numbers(noise, &mut array[from..]);
    }
    put(folder, "x.npy", &array);
    import(noise, folder, "x.npy");
}

/// An array of NumPy's, its head changed now and then.
fn array(noise: &mut Noise, shape: &str, values: Vec<u8>) -> Vec<u8> {
    let order = noise.pick(&["False", "False", "True"]);
    let mut head = format!("{{'descr': '<c8', 'fortran_order': {order}, 'shape': {shape}, }}\n").into_bytes();
    if noise.one_in(2) {
        head = changed_text(
            noise,
            &head,
            &["{", "}", "(", ")", "'", ",", ":", "'descr'", "'<f8'", "None", "4L"],
        );
    }
    let mut length = (head.len() as u32).to_le_bytes();
    if noise.one_in(6) {
        length[noise.below(4)] ^= 1 << noise.below(8);
    }
    let wide = head.len() > 65_535 || noise.one_in(4);
    let begin = if wide {
        [&b"\x93NUMPY\x02\0"[..], &length].concat()
    } else {
        [&b"\x93NUMPY\x01\0"[..], &length[..2]].concat()
    };
    let mut bytes = [begin, head, values].concat();
    if noise.one_in(8) {
        let at = noise.below(bytes.len().min(12));
        bytes[at] ^= 1 << noise.below(8);
    }
    bytes
}

/// An element of a MAT-file, its length told wrong now and then.
fn element(noise: &mut Noise, kind: u32, content: &[u8]) -> Vec<u8> {
    let told = if noise.one_in(40) { noise.next() as u32 >> noise.below(32) } else { content.len() as u32 };
    let mut bytes = [kind.to_le_bytes(), told.to_le_bytes()].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn one_of<T: Copy>(noise: &mut Noise, of: &[T]) -> T {
    of[noise.below(of.len())]
}

fn write_mat(noise: &mut Noise, folder: &Path) {
    let [channels, chirps, length] = SHAPE.map(|side| side as u32);
    let sides = one_of(noise, &[[length, chirps, channels, 1], [length, chirps, channels, 1], [u32::MAX; 4]]);
    let values: usize = SHAPE.iter().product();
    let (kind, of_a_value) = one_of(noise, &[(7, 4), (7, 4), (9, 8), (3, 2), (1, 1), (77, 4)]);
    let mut part: Vec<u8> = (0..values * of_a_value).map(|i| (i % 61) as u8).collect();
    if noise.one_in(3) {
        change_numbers(noise, &mut part);
    }
    let class = one_of(noise, &[0x0807_u32, 0x0806, 0x0806, 0x0006, 0xffff]);
    let told = one_of(noise, &[4, 4, 3, 0]);
    let sides: Vec<u8> = sides[..told].iter().flat_map(|side| side.to_le_bytes()).collect();
    let content = [
        element(noise, 6, &[class.to_le_bytes(), [0; 4]].concat()),
        element(noise, 5, &sides),
        element(noise, 1, b"adcData"),
        element(noise, kind, &part),
        element(noise, kind, &part),
    ];
    let mut array = element(noise, 14, &content.concat());
    if noise.one_in(3) {
        let mut encoder = flate2::write::ZlibEncoder::new(vec![], flate2::Compression::fast());
        std::io::Write::write_all(&mut encoder, &array).unwrap();
        array = element(noise, 15, &encoder.finish().unwrap());
    }
    let mut bytes = [vec![b' '; 116], vec![0; 8], vec![0, 1, b'I', b'M'], array].concat();
    if noise.one_in(6) {
        bytes.truncate(noise.below(bytes.len()));
    }
    put(folder, "x.mat", &bytes);
    import(noise, folder, "x.mat");
}

/// Rows of a cloud: place and more, some of them strange.
fn rows(noise: &mut Noise, row_bytes: usize) -> Vec<u8> {
    let count = if noise.one_in(20) { noise.times() } else { noise.below(30) };
    let row = |i: usize| -> Vec<u8> {
        let values =
            [20.0 + (i % 40) as f32, (i % 7) as f32, 0.5, 3.0, -5.0, -5.0, 0.0].map(f32::to_le_bytes);
        values.concat().into_iter().chain(std::iter::repeat(1)).take(row_bytes).collect()
    };
    let mut bytes: Vec<u8> = (0..count).flat_map(row).collect();
    if !bytes.is_empty() && noise.one_in(2) {
        change_numbers(noise, &mut bytes);
    }
    if !bytes.is_empty() && noise.one_in(8) {
        bytes.truncate(noise.below(bytes.len()));
    }
    bytes
}

fn write_cloud(noise: &mut Noise, folder: &Path) {
    sound::texts(folder);
    let name = noise.pick(&["x.bin", "x.pcd"]);
    let bytes = if name == "x.bin" {
        rows(noise, 28)
    } else {
        let rows = rows(noise, 24);
        let points = if noise.one_in(10) { noise.next() as usize } else { rows.len() / 24 };
        let head = format!(
            "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rcs vx vy\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n\
             COUNT 1 1 1 1 1 1\nWIDTH {points}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA binary\n"
        );
        let mut head = head.into_bytes();
        if noise.one_in(2) {
            head =
                changed_text(noise, &head, &["x", "y", "8", "1", "I", "U", "F", "DATA", "POINTS", "\n", " "]);
        }
        [head, rows].concat()
    };
    put(folder, name, &bytes);
    note(folder, &format!("import @{name} --scene @sound/small.toml --out @O.points"));
}

fn write_dca1000(noise: &mut Noise, folder: &Path) {
    let bytes = samples(noise, 4);
    put(folder, "x.bin", &bytes);
    let frames = bytes.len() / (4 * SHAPE.iter().product::<usize>());
    let mut told = json!({
        "blake3": blake3::hash(&bytes).to_hex().to_string(), "sqrt_w_per_step": 1e-9,
        "shape": ["frame", "chirp of any transmitter", "receiver", "sample"], "sizes": [frames, 16, 4, 32],
        "sample_rate_hz": 1e7, "of": "x.bin",
    });
    for _ in 0..noise.below(3) {
        change_json(noise, &mut told, &["blake3", "sizes", "sqrt_w_per_step"], strange);
    }
    let text = serde_json::to_vec(&told).unwrap();
    let text =
        if noise.one_in(4) { changed_text(noise, &text, &["{", "}", "[", "\"", "1e999"]) } else { text };
    put(folder, noise.pick(&["x.bin.json", "x.json"]), &text);
    import(noise, folder, "x.bin");
}

fn write_sigmf(noise: &mut Noise, folder: &Path) {
    let (kind, bytes) = if noise.one_in(2) { ("cf32_le", 8) } else { ("ci16_le", 4) };
    let mut meta = json!({
        "global": {
            "core:version": "1.0.0", "core:datatype": kind, "core:num_channels": 4,
            "core:sample_rate": 5.12e6,
        },
        "captures": [{ "core:sample_start": 0, "core:frequency": 7.7e10 }], "annotations": [],
    });
    for _ in 0..noise.below(4) {
        change_json(noise, &mut meta, &["core:datatype", "core:num_channels", "global"], strange);
    }
    let text = serde_json::to_vec(&meta).unwrap();
    let text =
        if noise.one_in(4) { changed_text(noise, &text, &["{", "}", "[", "\"", "1e999"]) } else { text };
    put(folder, "x.sigmf-meta", &text);
    if !noise.one_in(16) {
        put(folder, "x.sigmf-data", &samples(noise, bytes));
    }
    let file = noise.pick(&["x.sigmf-meta", "x.sigmf-data"]);
    import(noise, folder, file);
}

/// Configurations of boards, to a scene and beside one.
fn write_config(noise: &mut Noise, folder: &Path) {
    const CONFIGS: [&str; 3] = [
        include_str!("../../../../fixtures/devices/xwr1843.cfg"),
        include_str!("../../../../fixtures/devices/studio-log.txt"),
        include_str!("../../../../fixtures/devices/studio.lua"),
    ];
    const WORDS: [&str; 24] = [
        "profileCfg",
        "chirpCfg",
        "frameCfg",
        "channelCfg",
        "advFrameCfg",
        "bpmCfg",
        "flushCfg",
        "API:",
        "ar1.",
        "ProfileConfig",
        "ChirpConfig",
        "FrameConfig",
        "ChanNAdcConfig",
        "SensorStart",
        "(",
        ")",
        ",",
        "%",
        "--",
        "0xff",
        "511",
        "4294967295",
        "-1",
        "1e308",
    ];
    let whole = noise.pick(&CONFIGS);
    let text = changed_text(noise, whole.as_bytes(), &WORDS);
    put(folder, "x.cfg", &text);
    if noise.one_in(2) {
        note(
            folder,
            &format!(
                "scene-from @x.cfg --device {} --out @O",
                noise.pick(&["xwr1843", "xwr6843", "xwr1642"])
            ),
        );
        return;
    }
    sound::texts(folder);
    put(folder, "x.bin", &samples(noise, 4));
    note(folder, "import @x.bin --scene @sound/small.toml --config @x.cfg --out @O");
}

/// Folder of a set, its files that `score` reads, and what it is told to read.
type LabelFiles = (&'static str, &'static [&'static str], &'static str);

const LABEL_FILES: [LabelFiles; 2] = [
    (
        "kitti/training",
        &["label_2/00000.txt", "label_2/00001.txt", "calib/00000.txt", "calib/00001.txt"],
        "labels/label_2",
    ),
    (
        "nuscenes/v1.0-wayside",
        &[
            "sample_data.json",
            "ego_pose.json",
            "calibrated_sensor.json",
            "sample_annotation.json",
            "instance.json",
            "category.json",
        ],
        "labels",
    ),
];

/// Labels of a run's points, one file of them changed.
fn write_labels(noise: &mut Noise, folder: &Path) {
    sound::labels(folder);
    let (set, files, place) = one_of(noise, &LABEL_FILES);
    let at_fault = noise.pick(files);
    for name in files {
        let whole = std::fs::read(folder.join("sound").join(set).join(name)).unwrap();
        let bytes = if *name == at_fault { changed_labels(noise, &whole) } else { whole };
        let file = folder.join("labels").join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, bytes).unwrap();
    }
    note(folder, &format!("score @sound/run/frames.points --labels @{place}"));
}

/// A table changed by its values, which leaves its syntax right, or any of the files by its words.
fn changed_labels(noise: &mut Noise, whole: &[u8]) -> Vec<u8> {
    let table: Option<Value> = serde_json::from_slice(whole).ok();
    if let Some(mut table) = table.filter(|_| !noise.one_in(3)) {
        change_json_like(noise, &mut table);
        return serde_json::to_vec(&table).unwrap();
    }
    let words =
        ["Car", "truck", "DontCare", "R0_rect:", "Tr_velo_to_cam:", "1e9", "0", "-1", "nan", "\n", "{"];
    changed_text(noise, whole, &words)
}

/// Values at which descriptions of recordings stumble.
fn strange(noise: &mut Noise) -> Value {
    match noise.below(8) {
        0 => json!(noise.below(9)),
        1 => json!(u64::MAX),
        2 => json!(-1.5),
        3 => serde_json::from_str(&noise.number()).unwrap_or(Value::Null),
        4 => json!(noise.pick(&["cf32_le", "ci16_le", "cf64_le", "ru8", ""])),
        5 => (0..noise.times().min(100)).fold(json!(1), |inner, _| json!([inner])),
        6 => json!("x".repeat(noise.times())),
        _ => Value::Null,
    }
}
