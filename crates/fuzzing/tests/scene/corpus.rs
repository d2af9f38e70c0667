//! Corpus: valid texts of every format, to be changed.

use fuzzing::with_toml_punctuation;

/// Signs and words of the formats.
pub(crate) fn words() -> Vec<&'static str> {
    with_toml_punctuation(&WORDS)
}

const WORDS: [&str; 32] = [
    "<",
    ">",
    "/>",
    "</",
    "<vehicle ",
    "<timestep time=\"1\">",
    "</timestep>",
    "<!--",
    "-->",
    "<![CDATA[",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&b;",
    "&#0;",
    "&#x110000;",
    "<?xml",
    "type=\"car\"",
    "nan",
    "inf",
    "-",
    "true",
    "1979-05-27",
    "0x",
    "v",
    "vn",
    "f",
    "usemtl",
    "\\\n",
    "vertex",
    "endfacet",
    "//",
    "bus",
    "car-suv",
];

pub(crate) const STL: &[&str] = &[
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n",
];
pub(crate) const OBJ: &[&str] = &[
    "# square\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl paint\nf 1//1 2//1 3//1 4//1\ng back\nusemtl glass\nf -4 -3 -2 \\\n-1\nf 1/1 2/1 3/1\nl 1 2\n",
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0.5 1 1\nf 1 2 3 4 5 6\nf 1 2 7\nf 2 3 7\n",
];
pub(crate) const MATERIALS: &[&str] = &[
    "[materials]\nsteel = { substance = \"metal\" }\nglass = { substance = \"glass\", thickness_mm = 5.0 }\nbumper = { layers = [{ substance = \"polypropylene\", thickness_mm = 3 }, { permittivity = [2.5, 0.1], thickness_mm = 0.1 }], backing = \"metal\", coherent = false }\n",
    include_str!("../../../../scenes/vehicles.materials.toml"),
];
pub(crate) const PATTERN: &[&str] = &[
    "az_deg, el_deg, gain_db\n-90, 0, -20\n-45, 0, -6\n0, 0, 0 # ahead\n45, 0, -6\n90, 0, -20\n0, -30, -9\n0, 30, -9\n",
    "az_deg,el_deg,gain_db\n-9,-9,-2\n0,-9,-1\n9,-9,-2\n-9,0,-1\n0,0,0\n9,0,-1\n-9,9,-2\n0,9,-1\n9,9,-2\n",
];
pub(crate) const CALIBRATION: &[&str] =
    &["tx,rx,gain_db,phase_deg\n0,0,1.25,-14.2\n0,1,0,0\n# second\n0,2,-1,10\n0,3,0.5,359\n"];
pub(crate) const FCD: &[&str] = &[concat!(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- made by hand -->\n<fcd-export xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n",
    "  <timestep time=\"0.00\">\n    <vehicle id=\"a\" x=\"5.75\" y=\"40.00\" angle=\"180.00\" type=\"car\" speed=\"10.00\" pos=\"1\" lane=\"n_0\" slope=\"0\"/>\n",
    "    <vehicle id=\"b.1\" x=\"2\" y=\"60\" z=\"0.5\" angle=\"180\" type=\"car@flow.3\" speed=\"12\"/>\n  </timestep>\n",
    "  <timestep time=\"0.10\">\n    <vehicle id=\"a\" x=\"5.75\" y=\"39.00\" angle=\"170.00\" type=\"car\" speed=\"10.00\"/>\n",
    "    <vehicle id=\"b.1\" x=\"5.75\" y=\"58.8\" angle=\"180\" type=\"car@flow.3\" speed=\"12\"></vehicle>\n    <person id=\"p\" x=\"1\" y=\"2\"/>\n  </timestep>\n",
    "  <timestep time=\"0.20\"/>\n  <timestep time=\"0.30\">\n    <vehicle id=\"a\" x=\"5.75\" y=\"37.00\" angle=\"-180.00\" type=\"car\" speed=\"10.00\"/>\n  </timestep>\n</fcd-export>\n"
)];

pub(crate) const NET: &[&str] = &[concat!(
    "<?xml version=\"1.0\"?>\n<net version=\"1.20\">\n <location netOffset=\"0.00,0.00\"/>\n",
    " <edge id=\":c_0\" function=\"internal\"><lane id=\":c_0_0\" index=\"0\" shape=\"2,30 2,-4\" width=\"3.75\"/></edge>\n",
    " <edge id=\"n_in\"><lane id=\"n_in_0\" index=\"0\" width=\"3.75\" shape=\"2.00,100.00 2.00,30.00\"/>",
    "<lane id=\"n_in_1\" shape=\"5.75,100.00,0.5 5.75,30.00,0.5\"></lane></edge>\n",
    " <edge id=\"b\"><lane id=\"w\" allow=\"pedestrian\" shape=\"-9,0 -9,50\"/><lane id=\"b_1\" shape=\"-20,10 -10,10 -10,20\"/></edge>\n</net>\n"
)];

const SHEET: &str = "v 0 0 0\nv 4 0 0.5\nv 4 2 0.5\nv 0 2 0\nf 1 2 3 4\n";
/// A scene of every table.
const ALL: &str = include_str!("all.toml");

pub(crate) const SCENES: &[&str] = &[
    ALL,
    // The project's own vehicles take a hundred times what reading a scene takes: these have none.
    "name = \"two\"\n[radar.waveform]\nsamples = 64\n[[radars]]\nid = \"a\"\n[[radars]]\nid = \"b\"\nposition_m = [9, 0, 3]\n[radars.array]\npreset = \"1x4\"\n[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\nposition_m = [0, 9, 0]\n",
    "name = \"files\"\nframes = 3\n[fidelity]\nmaterials = \"m.toml\"\n[radar.array]\npreset = \"1x4\"\npattern = \"table\"\npattern_file = \"p.csv\"\n[dsp]\ncalibration = \"c.csv\"\n[[target]]\nkind = \"mesh\"\nid = \"m\"\nmodel = \"sheet.obj\"\nlane = 2\ny_m = 30\n[intersection]\nlane_centres_m = [2, 6]\n[[clutter]]\nid = \"c\"\nmodel = \"sheet.obj\"\nposition_m = [0, 9, 0]\n",
];

/// A scene whose model is the asset, and whose road and materials are of OpenMATERIAL 3D.
const OPENMATERIAL: &str = concat!(
    "name = \"o\"\n[materials]\nglass = { openmaterial = \"g.xomp\", thickness_mm = 5 }\n",
    "[road]\nopenmaterial = \"g.xomp\"\n",
    "[[target]]\nkind = \"mesh\"\nid = \"m\"\nmodel = \"o.xoma\"\nlane = 2\ny_m = 30\n",
    "[intersection]\nlane_centres_m = [2, 6]\n"
);

/// Files that stand beside a case, whatever it is.
pub(crate) const FILES: [(&str, &str); 12] = [
    ("sheet.obj", SHEET),
    ("openmaterial.toml", OPENMATERIAL),
    ("t.fcd.xml", FCD[0]),
    ("t.net.xml", NET[0]),
    (
        "network.toml",
        "name = \"n\"\n[traffic]\nfcd = \"t.fcd.xml\"\nnet = \"t.net.xml\"\nmodels = { car = \"sheet.obj\" }\n",
    ),
    ("p.csv", PATTERN[0]),
    ("c.csv", CALIBRATION[0]),
    ("m.toml", MATERIALS[0]),
    ("vehicles.materials.toml", MATERIALS[1]),
    ("pattern.toml", "name = \"p\"\n[radar.array]\npattern = \"table\"\npattern_file = \"p.csv\"\n"),
    ("calibration.toml", "name = \"c\"\n[radar.array]\npreset = \"1x4\"\n[dsp]\ncalibration = \"c.csv\"\n"),
    (
        "traffic.toml",
        "name = \"t\"\nframe_interval_s = 0.05\n[traffic]\nfcd = \"t.fcd.xml\"\nmodels = { car = { model = \"sheet.obj\", class = \"car\" }, bus = \"sheet.obj\" }\n",
    ),
];
