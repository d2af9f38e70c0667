//! Contents of hostile files, whatever their names say they are.

use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write as _;

/// Names and bytes of contents for every reader, never a whole number of integer samples, which would be a
/// recording.
pub(crate) fn of_any() -> Vec<(&'static str, Vec<u8>)> {
    let uneven = |(name, mut bytes): (&'static str, Vec<u8>)| {
        bytes.extend((!bytes.is_empty() && bytes.len().is_multiple_of(4)).then_some(b' '));
        (name, bytes)
    };
    all_of_any().into_iter().map(uneven).collect()
}

fn all_of_any() -> Vec<(&'static str, Vec<u8>)> {
    let pseudo_random = |i: u32| i.wrapping_mul(2_654_435_761).to_le_bytes()[3];
    vec![
        ("empty", vec![]),
        ("a blank", b" ".to_vec()),
        ("zeros", vec![0; 5000]),
        ("ones", vec![0xff; 5000]),
        ("noise", (0..5000).map(pseudo_random).collect()),
        ("a sentence", b"this is none of it\n".to_vec()),
        ("UTF-16", "solid name = 3".encode_utf16().flat_map(u16::to_be_bytes).collect()),
        ("a byte order mark", "\u{feff}\u{feff}x".as_bytes().to_vec()),
        ("one long word", vec![b'a'; 3 << 20]),
        ("brackets", vec![b'['; 1 << 20]),
        ("braces", b"{\"a\":".repeat(1 << 18)),
        ("tags", b"<a>".repeat(1 << 19)),
        ("dots", [b"a.".repeat(1 << 20), b"a = 1".to_vec()].concat()),
        ("levels", levels().into_bytes()),
        ("tables", b"[a]\n".repeat(1 << 19)),
        ("a gibibyte packed", packed(1 << 30)),
        ("a terminal's commands", b"\x1b[2J\x1b]0;title\x07\r\x08 = \x1b[31m\n".to_vec()),
        ("an envelope of nothing", [&b"WAYSIDE\n"[..], &[0xff; 500]].concat()),
        ("a container of nothing", [&b"glTF\x02\0\0\0"[..], &[0xff; 500]].concat()),
        ("an array of nothing", [&b"\x93NUMPY\x02\0"[..], &[0xff; 500]].concat()),
    ]
}

/// Six thousand tables of TOML within one another, within a table that some readers pass over.
fn levels() -> String {
    let key = vec!["a"; 79].join(".");
    format!("{key} = {}1{}\n", format!("{{ {key} = ").repeat(79), " }".repeat(79))
}

fn packed(zeros: usize) -> Vec<u8> {
    let mut packer = GzEncoder::new(vec![], Compression::fast());
    let block = vec![0; 1 << 20];
    (0..zeros >> 20).for_each(|_| packer.write_all(&block).unwrap());
    packer.finish().unwrap()
}

/// A `.npy` with that header.
pub(crate) fn npy(header: &str, values: usize) -> Vec<u8> {
    let length = (header.len() as u16).to_le_bytes();
    [&b"\x93NUMPY\x01\0"[..], &length, header.as_bytes(), &vec![0; 8 * values]].concat()
}

/// Headers that claim what is not there, or what no memory holds.
pub(crate) fn headers() -> Vec<Vec<u8>> {
    let dictionary = |descr: &str, order: &str, shape: &str| {
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n")
    };
    let shapes = [
        "(1000000000000, 4, 16, 64)",
        "(18446744073709551615, 4, 16, 64)",
        "(99999999999999999999999, 4, 16, 64)",
        "(-1, 4, 16, 64)",
        "(1, 4, 16)",
        "()",
        "(4096,)",
        "(0, 4, 16, 64)",
        "(2, 4, 16, 64)",
        "(1, 4, 16, 32)",
        "(1, 4, 16, 64",
        "1, 4, 16, 64",
        "(1, (4, 16), 64)",
        "(1.5, 4, 16, 64)",
    ];
    let mut all: Vec<String> = shapes.iter().map(|shape| dictionary("<c8", "False", shape)).collect();
    all.extend(
        ["<c16", "<f4", "|O", "<c8', 'x': '", ""].map(|descr| dictionary(descr, "False", "(1, 4, 16, 64)")),
    );
    all.extend(["True", "Maybe", ""].map(|order| dictionary("<c8", order, "(9, 4, 16, 64)")));
    all.extend(["{}", "{'shape': (1, 4, 16, 64)}", "\u{1f697}", &"(".repeat(60_000)].map(str::to_owned));
    let mut files: Vec<Vec<u8>> = all.iter().map(|header| npy(header, 4096)).collect();
    files.push([&b"\x93NUMPY\x02\0"[..], &u32::MAX.to_le_bytes(), b"{'descr'"].concat());
    files.push(b"\x93NUMPY".to_vec());
    files
}

/// Descriptions of SigMF that do not describe the file beside them.
pub(crate) const SIGMF: [&str; 8] = [
    r#"{"global": {"core:datatype": "cf32_le", "core:num_channels": 1e300}}"#,
    r#"{"global": {"core:datatype": "cf32_le", "core:num_channels": -4}}"#,
    r#"{"global": {"core:datatype": "cf32_be", "core:num_channels": 4}}"#,
    r#"{"global": {"core:datatype": ["cf32_le"], "core:num_channels": 4}}"#,
    r#"{"global": {"core:num_channels": 4}}"#,
    r#"{"global": [], "captures": 3}"#,
    "[1, 2]",
    r#"{"global": {"core:datatype": "cf32_le", "core:num_channels": 4, "core:datatype": "ci16_le"}"#,
];

/// Recordings of traffic that cost more than they say.
pub(crate) fn recordings() -> Vec<Vec<u8>> {
    let vehicle = |id: &str, kind: &str| {
        format!("<vehicle id=\"{id}\" x=\"2\" y=\"20\" angle=\"180\" type=\"{kind}\" speed=\"3\"/>")
    };
    let step = |time: &str, inside: &str| format!("<timestep time=\"{time}\">{inside}</timestep>");
    let file = |inside: String| format!("<fcd-export>{inside}</fcd-export>").into_bytes();
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=\"\"")).collect();
    let many: String = (0..600_000).map(|i| vehicle(&format!("{i}"), "car")).collect();
    vec![
        file("<a>".repeat(100_000)),
        file(format!("<timestep time=\"0\"{attributes}></timestep>")),
        file(step("0", &format!("<vehicle{attributes}/>"))),
        file(step("0", &vehicle(&"x".repeat(1 << 19), "car"))),
        file(step("0", &vehicle("a", &"t".repeat(1 << 19)))),
        file(step("0", &vehicle("a", "tram")) + &step("1", &vehicle("b", "ship"))),
        file(step("0", &vehicle("a", "car")) + &step("1e12", &vehicle("a", "car"))),
        file(step("0", &vehicle("a", "car")) + &step("nan", "")),
        file(step("1e308", "") + &step("1e309", "")),
        file(step("0", &many)),
        file(step("0", &(vehicle("a", "car") + &vehicle("a", "car")))),
        b"<!DOCTYPE a [<!ENTITY b \"cc\"><!ENTITY c \"&b;&b;\">]><fcd-export>&c;<timestep time=\"&c;\"/></fcd-export>"
            .to_vec(),
        b"<fcd-export><timestep time=\"0\">".to_vec(),
        b"<fcd-export></fcd-import>".to_vec(),
        b"<routes/>".to_vec(),
        [b"<fcd-export>".to_vec(), b" ".repeat(2 << 20)].concat(),
        [b"<fcd-export ".to_vec(), b"a".repeat(2 << 20)].concat(),
    ]
}

/// Networks that cost more than they say, or hold no lane that a radar could tell by.
pub(crate) fn networks() -> Vec<Vec<u8>> {
    let file = |inside: String| format!("<net>{inside}</net>").into_bytes();
    let lane = |id: &str, shape: &str| format!("<edge><lane id=\"{id}\" shape=\"{shape}\"/></edge>");
    let places: String = (0..200_000).map(|i| format!("{i},0 ")).collect();
    vec![
        file("<edge>".repeat(100_000)),
        file(lane("a", "2,20 2,50").repeat(100_000)),
        file(lane("a", &places)),
        file(lane("a", "900,900 990,900")),
        file(lane("a", "2,20 2,1e999")),
        file(lane(&"x".repeat(1 << 19), "2,20 2,50")),
        file(format!("<edge><lane{}/></edge>", " b=\"\"".repeat(100_000))),
        b"<net>".to_vec(),
        b"<net></edge>".to_vec(),
        b"<routes/>".to_vec(),
        [b"<net>".to_vec(), b" ".repeat(2 << 20)].concat(),
        [b"<net ".to_vec(), b"a".repeat(2 << 20)].concat(),
    ]
}

/// Meshes whose text is short and whose mesh is not, or that are no mesh.
pub(crate) fn objects() -> Vec<Vec<u8>> {
    let names: String = (0..70_000).map(|i| format!("usemtl m{i}\nf 1 2 3\n")).collect();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let text = |rest: &str| format!("{corners}{rest}").into_bytes();
    vec![
        text(&names),
        text(&format!("f{}", " 1 2 3".repeat(100_000))),
        text(&format!("f 1 2 {}3 4", "\\\n".repeat(100_000))),
        text("f 9223372036854775807 2 3"),
        text("f -9223372036854775808 2 3"),
        text("f 1//1 2//1 3//1"),
        text("f 1 2"),
        text("v nan 0 0\nf 1 2 4"),
        text("v 1e400 0 0\nf 1 2 4"),
        text("v 1e308 0 0\nf 1 2 4"),
        text("curv 1 2 3"),
        text("f 1 1 1"),
        text("v 5e-324 0 0\nf 1 4 4\n"),
        text(&format!("f 1 2 {}", "9".repeat(1 << 20))),
    ]
}
