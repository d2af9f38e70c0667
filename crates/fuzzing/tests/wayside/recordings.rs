//! Recordings of devices and arrays: `.npy`, DCA1000, SigMF, with what stands beside them, the
//! configurations of boards, and labels of datasets.

use crate::commands::{put, run_scheduled, run_scheduled_on_content, schedule};
use crate::corpus;
use fuzzing::{FuzzRng, Reader, mutate_json, mutate_json_keeping_types, mutate_text, mutate_word32};
use serde_json::{Value, json};
use std::path::Path;

/// Numbers of a frame: channels, chirps, samples of the small scene.
const SHAPE: [usize; 3] = [4, 16, 32];

pub(crate) fn readers() -> Vec<Reader> {
    vec![
        Reader::refusing("npy", 200, write_npy, run_scheduled_on_content),
        Reader::refusing("tensor", 40, write_tensor, run_scheduled_on_content),
        Reader::refusing("dca1000", 200, write_dca1000, run_scheduled_on_content),
        Reader::refusing("sigmf", 200, write_sigmf, run_scheduled),
        Reader::refusing("mat", 200, write_mat, run_scheduled_on_content),
        Reader::refusing("radar-cloud", 200, write_cloud, run_scheduled_on_content),
        Reader::refusing("device-config", 200, write_config, run_scheduled_on_content),
        Reader::refusing("set-labels", 100, write_labels, run_scheduled_on_content),
    ]
}

fn import(rng: &mut FuzzRng, folder: &Path, file: &str) {
    corpus::texts(folder);
    let step = rng.choose(&["", "", " --step=0.5", " --step=1e-30", " --step=1e30"]);
    // Files whose samples are never integers have no step.
    let step = if file.ends_with(".npy") || file.ends_with(".mat") { "" } else { step };
    schedule(folder, &format!("import @{file} --scene @sound/small.toml --out @O{step}"));
}

/// Bytes of so many values of frames of the small scene, sometimes more or fewer, some of them strange.
fn samples(rng: &mut FuzzRng, of_a_value: usize) -> Vec<u8> {
    let frames = 1 + rng.below(3);
    let mut bytes: Vec<u8> =
        (0..frames * SHAPE.iter().product::<usize>() * of_a_value).map(|i| (i % 61) as u8).collect();
    if rng.one_in(3) {
        mutate_word32(rng, &mut bytes);
    }
    match rng.below(8) {
        0 => bytes.truncate(rng.below(bytes.len())),
        1 => bytes.extend(vec![0; rng.repeat_count()]),
        2 => bytes.clear(),
        _ => {}
    }
    bytes
}

fn write_npy(rng: &mut FuzzRng, folder: &Path) {
    let [channels, chirps, length] = SHAPE;
    let values = samples(rng, 8);
    let frames = values.len() / (8 * channels * chirps * length);
    let shape = rng.choose(&[
        "({f}, 4, 16, 32)",
        "({f}, 4, 16, 32)",
        "(4, 16, 32)",
        "(32, 16, 4, {f})",
        "({f}, 4, 16, 32,)",
    ]);
    let array = array(rng, &shape.replace("{f}", &frames.to_string()), values);
    put(folder, "x.npy", &array);
    import(rng, folder, "x.npy");
}

/// Range, azimuth and Doppler of the small scene.
fn write_tensor(rng: &mut FuzzRng, folder: &Path) {
    let [_, chirps, length] = SHAPE;
    let values: Vec<u8> = (0..8 * chirps * length * 256).map(|i| (i % 61) as u8).collect();
    let shape =
        rng.choose(&["(32, 256, 16)", "(32, 256, 16)", "(32, 256, 16)", "(16, 256, 32)", "(32, 16, 256)"]);
    let mut array = array(rng, shape, values);
    if rng.one_in(3) {
        let from = array.len() - rng.below(array.len() / 2);
        mutate_word32(rng, &mut array[from..]);
    }
    put(folder, "x.npy", &array);
    import(rng, folder, "x.npy");
}

/// An array of NumPy's, its head changed now and then.
fn array(rng: &mut FuzzRng, shape: &str, values: Vec<u8>) -> Vec<u8> {
    let order = rng.choose(&["False", "False", "True"]);
    let mut head = format!("{{'descr': '<c8', 'fortran_order': {order}, 'shape': {shape}, }}\n").into_bytes();
    if rng.one_in(2) {
        head =
            mutate_text(rng, &head, &["{", "}", "(", ")", "'", ",", ":", "'descr'", "'<f8'", "None", "4L"]);
    }
    let mut length = (head.len() as u32).to_le_bytes();
    if rng.one_in(6) {
        length[rng.below(4)] ^= 1 << rng.below(8);
    }
    let wide = head.len() > 65_535 || rng.one_in(4);
    let begin = if wide {
        [&b"\x93NUMPY\x02\0"[..], &length].concat()
    } else {
        [&b"\x93NUMPY\x01\0"[..], &length[..2]].concat()
    };
    let mut bytes = [begin, head, values].concat();
    if rng.one_in(8) {
        let at = rng.below(bytes.len().min(12));
        bytes[at] ^= 1 << rng.below(8);
    }
    bytes
}

/// An element of a MAT-file, its length told wrong now and then.
fn element(rng: &mut FuzzRng, kind: u32, content: &[u8]) -> Vec<u8> {
    let told = if rng.one_in(40) { rng.next_u64() as u32 >> rng.below(32) } else { content.len() as u32 };
    let mut bytes = [kind.to_le_bytes(), told.to_le_bytes()].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn one_of<T: Copy>(rng: &mut FuzzRng, of: &[T]) -> T {
    of[rng.below(of.len())]
}

fn write_mat(rng: &mut FuzzRng, folder: &Path) {
    let [channels, chirps, length] = SHAPE.map(|side| side as u32);
    let sides = one_of(rng, &[[length, chirps, channels, 1], [length, chirps, channels, 1], [u32::MAX; 4]]);
    let values: usize = SHAPE.iter().product();
    let (kind, of_a_value) = one_of(rng, &[(7, 4), (7, 4), (9, 8), (3, 2), (1, 1), (77, 4)]);
    let mut part: Vec<u8> = (0..values * of_a_value).map(|i| (i % 61) as u8).collect();
    if rng.one_in(3) {
        mutate_word32(rng, &mut part);
    }
    let class = one_of(rng, &[0x0807_u32, 0x0806, 0x0806, 0x0006, 0xffff]);
    let told = one_of(rng, &[4, 4, 3, 0]);
    let sides: Vec<u8> = sides[..told].iter().flat_map(|side| side.to_le_bytes()).collect();
    let content = [
        element(rng, 6, &[class.to_le_bytes(), [0; 4]].concat()),
        element(rng, 5, &sides),
        element(rng, 1, b"adcData"),
        element(rng, kind, &part),
        element(rng, kind, &part),
    ];
    let mut array = element(rng, 14, &content.concat());
    if rng.one_in(3) {
        let mut encoder = flate2::write::ZlibEncoder::new(vec![], flate2::Compression::fast());
        std::io::Write::write_all(&mut encoder, &array).unwrap();
        array = element(rng, 15, &encoder.finish().unwrap());
    }
    let mut bytes = [vec![b' '; 116], vec![0; 8], vec![0, 1, b'I', b'M'], array].concat();
    if rng.one_in(6) {
        bytes.truncate(rng.below(bytes.len()));
    }
    put(folder, "x.mat", &bytes);
    import(rng, folder, "x.mat");
}

/// Rows of a cloud: place and more, some of them strange.
fn rows(rng: &mut FuzzRng, row_bytes: usize) -> Vec<u8> {
    let count = if rng.one_in(20) { rng.repeat_count() } else { rng.below(30) };
    let row = |i: usize| -> Vec<u8> {
        let values =
            [20.0 + (i % 40) as f32, (i % 7) as f32, 0.5, 3.0, -5.0, -5.0, 0.0].map(f32::to_le_bytes);
        values.concat().into_iter().chain(std::iter::repeat(1)).take(row_bytes).collect()
    };
    let mut bytes: Vec<u8> = (0..count).flat_map(row).collect();
    if !bytes.is_empty() && rng.one_in(2) {
        mutate_word32(rng, &mut bytes);
    }
    if !bytes.is_empty() && rng.one_in(8) {
        bytes.truncate(rng.below(bytes.len()));
    }
    bytes
}

fn write_cloud(rng: &mut FuzzRng, folder: &Path) {
    corpus::texts(folder);
    let name = rng.choose(&["x.bin", "x.pcd"]);
    let bytes = if name == "x.bin" {
        rows(rng, 28)
    } else {
        let rows = rows(rng, 24);
        let points = if rng.one_in(10) { rng.next_u64() as usize } else { rows.len() / 24 };
        let head = format!(
            "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rcs vx vy\nSIZE 4 4 4 4 4 4\nTYPE F F F F F F\n\
             COUNT 1 1 1 1 1 1\nWIDTH {points}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA binary\n"
        );
        let mut head = head.into_bytes();
        if rng.one_in(2) {
            head = mutate_text(rng, &head, &["x", "y", "8", "1", "I", "U", "F", "DATA", "POINTS", "\n", " "]);
        }
        [head, rows].concat()
    };
    put(folder, name, &bytes);
    schedule(folder, &format!("import @{name} --scene @sound/small.toml --out @O.points"));
}

fn write_dca1000(rng: &mut FuzzRng, folder: &Path) {
    let bytes = samples(rng, 4);
    put(folder, "x.bin", &bytes);
    let frames = bytes.len() / (4 * SHAPE.iter().product::<usize>());
    let mut told = json!({
        "blake3": blake3::hash(&bytes).to_hex().to_string(), "sqrt_w_per_step": 1e-9,
        "shape": ["frame", "chirp of any transmitter", "receiver", "sample"], "sizes": [frames, 16, 4, 32],
        "sample_rate_hz": 1e7, "of": "x.bin",
    });
    for _ in 0..rng.below(3) {
        mutate_json(rng, &mut told, &["blake3", "sizes", "sqrt_w_per_step"], strange);
    }
    let text = serde_json::to_vec(&told).unwrap();
    let text = if rng.one_in(4) { mutate_text(rng, &text, &["{", "}", "[", "\"", "1e999"]) } else { text };
    put(folder, rng.choose(&["x.bin.json", "x.json"]), &text);
    import(rng, folder, "x.bin");
}

fn write_sigmf(rng: &mut FuzzRng, folder: &Path) {
    let (kind, bytes) = if rng.one_in(2) { ("cf32_le", 8) } else { ("ci16_le", 4) };
    let mut meta = json!({
        "global": {
            "core:version": "1.0.0", "core:datatype": kind, "core:num_channels": 4,
            "core:sample_rate": 5.12e6,
        },
        "captures": [{ "core:sample_start": 0, "core:frequency": 7.7e10 }], "annotations": [],
    });
    for _ in 0..rng.below(4) {
        mutate_json(rng, &mut meta, &["core:datatype", "core:num_channels", "global"], strange);
    }
    let text = serde_json::to_vec(&meta).unwrap();
    let text = if rng.one_in(4) { mutate_text(rng, &text, &["{", "}", "[", "\"", "1e999"]) } else { text };
    put(folder, "x.sigmf-meta", &text);
    if !rng.one_in(16) {
        put(folder, "x.sigmf-data", &samples(rng, bytes));
    }
    let file = rng.choose(&["x.sigmf-meta", "x.sigmf-data"]);
    import(rng, folder, file);
}

/// Configurations of boards, to a scene and beside one.
fn write_config(rng: &mut FuzzRng, folder: &Path) {
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
    let whole = rng.choose(&CONFIGS);
    let text = mutate_text(rng, whole.as_bytes(), &WORDS);
    put(folder, "x.cfg", &text);
    if rng.one_in(2) {
        schedule(
            folder,
            &format!(
                "scene-from @x.cfg --device {} --out @O",
                rng.choose(&["xwr1843", "xwr6843", "xwr1642"])
            ),
        );
        return;
    }
    corpus::texts(folder);
    put(folder, "x.bin", &samples(rng, 4));
    schedule(folder, "import @x.bin --scene @sound/small.toml --config @x.cfg --out @O");
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
fn write_labels(rng: &mut FuzzRng, folder: &Path) {
    corpus::labels(folder);
    let (set, files, place) = one_of(rng, &LABEL_FILES);
    let at_fault = rng.choose(files);
    for name in files {
        let whole = std::fs::read(folder.join("sound").join(set).join(name)).unwrap();
        let bytes = if *name == at_fault { changed_labels(rng, &whole) } else { whole };
        let file = folder.join("labels").join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, bytes).unwrap();
    }
    schedule(folder, &format!("score @sound/run/frames.points --labels @{place}"));
}

/// A table changed by its values, which leaves its syntax right, or any of the files by its words.
fn changed_labels(rng: &mut FuzzRng, whole: &[u8]) -> Vec<u8> {
    let table: Option<Value> = serde_json::from_slice(whole).ok();
    if let Some(mut table) = table.filter(|_| !rng.one_in(3)) {
        mutate_json_keeping_types(rng, &mut table);
        return serde_json::to_vec(&table).unwrap();
    }
    let words =
        ["Car", "truck", "DontCare", "R0_rect:", "Tr_velo_to_cam:", "1e9", "0", "-1", "nan", "\n", "{"];
    mutate_text(rng, whole, &words)
}

/// Values at which descriptions of recordings stumble.
fn strange(rng: &mut FuzzRng) -> Value {
    match rng.below(8) {
        0 => json!(rng.below(9)),
        1 => json!(u64::MAX),
        2 => json!(-1.5),
        3 => serde_json::from_str(&rng.number_text()).unwrap_or(Value::Null),
        4 => json!(rng.choose(&["cf32_le", "ci16_le", "cf64_le", "ru8", ""])),
        5 => (0..rng.repeat_count().min(100)).fold(json!(1), |inner, _| json!([inner])),
        6 => json!("x".repeat(rng.repeat_count())),
        _ => Value::Null,
    }
}
