//! Broken scenes: each is refused with its line, its column and the rule it breaks, and all rules at once.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends where it meets what it did not expect")]

use scene::{ReadOptions, SceneErrors};
use std::path::Path;

/// `start` of every case: line 1; what a case adds begins in line 2.
const NAME: &str = "name = \"broken\"\n";
/// A sound target up to line 6; what a case adds begins in line 7.
const POINT: &str =
    "name = \"broken\"\n[[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 1\n";
/// A sound vehicle up to line 6; what a case adds begins in line 7.
const CAR: &str = "name = \"broken\"\n[[target]]\nkind = \"mesh\"\nid = \"c\"\nposition_m = [2, 30, 0]\nmodel = \"car-suv\"\n";

/// Content of a scene after its sound beginning, where it is refused (line:column) and in which words.
type Case = (&'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const CASES: &[Case] = &[
    // The text.
    (NAME, "frames = \n", "2:10", "not valid TOML"),
    (NAME, "[radar\nposition_m = [0, 0, 6]\n", "2:7", "not valid TOML"),
    (NAME, "name = \"again\"\n", "2:1", "not valid TOML: duplicate key"),
    (NAME, "[radar]\n[radar]\n", "3:2", "not valid TOML: duplicate key"),
    (NAME, "seed = 1 2\n", "2:8", "not valid TOML"),
    ("", "seed = 2\n", "1:1", "key `name` is missing"),
    // Keys.
    (NAME, "frmes = 2\n", "2:1", "unknown key `frmes`; the nearest is `frames`"),
    (NAME, "samples = 2\n", "2:1", "unknown key `samples` here; it belongs into [radar.waveform]"),
    (NAME, "[radra]\n", "2:2", "unknown key `radra`; the nearest is `radar`"),
    (NAME, "[radar]\nposition = [0, 0, 6]\n", "3:1", "[radar]: unknown key `position`; the nearest is `position_m`"),
    (NAME, "[radar.waveform]\n  slope_mhz_us = 12.5\n", "3:3", "[radar.waveform]: unknown key `slope_mhz_us`; the nearest is `slope_mhz_per_us`"),
    (NAME, "[radar.link]\nantenna_gain_dB = 1\n", "3:1", "nearest is `antenna_gain_dbi`"),
    (NAME, "[dsp]\ntraining_cell = [1, 1]\n", "3:1", "nearest is `training_cells`"),
    (POINT, "  velocty_mps = [0, 0, 0]\n", "7:3", "target `p`: unknown key `velocty_mps`; the nearest is `velocity_mps`"),
    (NAME, "[noise]\nxyzzy = 1\nnoise_figure_db = 3\n", "3:1", "[noise]: unknown key `xyzzy`"),
    // Keys of other tables: the likeliest first, of those that take such a value.
    (NAME, "lane_width_m = 3\n", "2:1", "unknown key `lane_width_m` here; it belongs into [intersection] or [radar.intersection]"),
    (NAME, "[radar]\nlane_centres_m = [2]\n", "3:1", "[radar]: unknown key `lane_centres_m` here; it belongs into [intersection] or [radar.intersection]"),
    (POINT, "materials = \"van.materials.toml\"\n", "7:1", "target `p`: unknown key `materials` here; it belongs into [fidelity]"),
    (NAME, "[dsp]\nmaterials = { a = { substance = \"metal\" } }\n", "3:1", "[dsp]: unknown key `materials` here; it belongs into the beginning of the file"),
    (NAME, "[dsp]\nmaterials = 3\n", "3:1", "it belongs into the beginning of the file or [fidelity]"),
    (NAME, "[dsp]\nmodel = \"car-suv\"\n", "3:1", "it belongs into [[target]], [[clutter]] or models of [traffic]"),
    (NAME, "[dsp]\nmodel = [\"car-suv\"]\n", "3:1", "it belongs into models of [traffic]"),
    (NAME, "[dsp]\nid = \"a\"\n", "3:1", "it belongs into [[target]], [[radars]] or [[clutter]]"),
    (NAME, "[dsp]\nlabel = \"a\"\n", "3:1", "the nearest is `class` of [[target]]"),
    (NAME, "[road]\nvelocity_mps = [0, 1, 0]\n", "3:1", "[road]: unknown key `velocity_mps` here; it belongs into [[target]] or [[radar.interferer]]"),
    (NAME, "position_m = [0, 9, 0]\n", "2:1", "it belongs into [[target]], [radar], [[radars]], [[clutter]] or [[radar.interferer]]"),
    // Keys as others call them.
    (NAME, "[radar]\ntilt_deg = -10\n", "3:1", "[radar]: unknown key `tilt_deg`; the nearest is `boresight_el_deg`"),
    (NAME, "[radar.array]\ntilt_deg = -10\n", "3:1", "unknown key `tilt_deg`; the nearest is `boresight_el_deg` of [radar]"),
    (NAME, "[radar.waveform]\nbandwidth_mhz = 600\n", "3:1", "the nearest is `slope_mhz_per_us`"),
    (POINT, "speed_mps = 3\n", "7:1", "target `p`: unknown key `speed_mps`; the nearest is `velocity_mps`"),
    // An array of so many wavelengths that a search of its directions would not end.
    (NAME, "[radar.array]\ntx_half_wavelengths = [[0, 0], [2000, 2000]]\nrx_half_wavelengths = [[0, 0], [1, 0], [0, 1]]\n", "3:23", "in 8192 × 8192 directions (right × up); the limit is 4194304"),
    // Hardware.
    (NAME, "[radar.array]\npreset = \"1x4\"\nrx_delays_ps = [1, 2]\n", "4:16", "`rx_delays_ps` must have 4 values, has 2"),
    (NAME, "[radar.receiver]\nadc_bits = 12\n", "3:12", "`adc_bits` needs `full_scale_dbm` beside it"),
    (NAME, "[radar.receiver]\nphase_noise_dbc_hz = [[0, -80], [1e5, -90]]\n", "3:22", "`phase_noise_dbc_hz` must be a number above 0, up to 1e12, is 0"),
    (NAME, "[radar.receiver]\nphase_noise_dbc_hz = [[1e5, 3]]\n", "3:22", "`phase_noise_dbc_hz` must be a number from -300 to 0, is 3"),
    (NAME, "[radar.receiver]\nphase_noise_dbc_hz = [[1e5, -80], [1e4, -90]]\n", "3:22", "the first numbers of the pairs of `phase_noise_dbc_hz` must grow"),
    (NAME, "[radar.receiver]\nphase_noise_dbc_hz = [[1e5, -90]]\n[radar.waveform]\nchirps = 128\nidle_us = 2000\n", "3:22", "with phase noise a frame lasts at most 1048576 sample intervals, this one 1343488"),
    (NAME, "[radar.receiver]\nsampling = \"i\"\n", "3:12", "`sampling` cannot be `i`; it can be `complex`, `real`"),
    (NAME, "[radar.receiver]\nsampling = \"real\"\n[dsp]\nrefine = \"on\"\n", "5:10", "`refine` and `sampling = \"real\"` exclude one another"),
    (NAME, "[radar.waveform]\nsamples = 32\n[radar.receiver]\nsampling = \"real\"\n[dsp]\ntraining_cells = [4, 8]\n", "7:18", "guard and training cells need 21 cells of range, the map has 16"),
    // Other radars.
    (NAME, "[[radar.interferer]]\nposition_m = [0, 0.5, 6]\neirp_dbm = 30\n", "3:14", "it is 0.5 m from the radar, nearer than 1 m"),
    (NAME, "[[radar.interferer]]\nposition_m = [0, 80, 1]\n", "2:1", "[radar.interferer]: key `eirp_dbm` is missing"),
    (NAME, "[[radar.interferer]]\nposition_m = [0, 80, 1]\neirp_dbm = 30\nchirp_interval_us = 40\n", "5:21", "`chirp_interval_us` is 40, shorter than a chirp of 50 µs"),
    (NAME, "[[radar.interferer]]\nposition_m = [0, 80, 1]\neirp_dbm = 30\nslope = 40\n", "5:1", "[radar.interferer]: unknown key `slope`; the nearest is `slope_mhz_per_us`"),
    (NAME, "[radar]\ninterferer = 3\n", "3:14", "`interferer` must be an array of tables"),
    // Schedules.
    (NAME, "[radar.waveform]\nsub_frame_idle_us = [10]\n", "3:21", "`sub_frame_idle_us` must have from 2 to 8 values, has 1"),
    (NAME, "[radar.waveform]\nsub_frame_idle_us = [10, 35]\nidle_us = 10\n", "3:21", "`sub_frame_idle_us` and `idle_us` exclude one another"),
    (NAME, "[radar.waveform]\nstagger_us = [-1, 3]\n", "3:15", "`stagger_us` must be a number from 0 to 1000000, is -1"),
    (NAME, "[radar.waveform]\nstagger_us = [1, 3]\n[radar.array]\nmultiplexing = \"bpm\"\n", "3:14", "`stagger_us` and the multiplexing `bpm` exclude one another"),
    (NAME, "[radar.waveform]\nstagger_us = [1, 3]\n[radar.array]\nmultiplexing = \"ddm\"\n", "3:14", "`stagger_us` and the multiplexing `ddm` exclude one another"),
    // Types.
    (NAME, "frames = 2.5\n", "2:10", "`frames` must be a whole number, is a number with a point"),
    (NAME, "radar = 3\n", "2:9", "`radar` must be a table, is a whole number"),
    (NAME, "target = 3\n", "2:10", "`target` must be an array of tables"),
    (NAME, "[target]\nid = \"p\"\n", "2:1", "`target` must be an array of tables"),
    (NAME, "[radar]\nposition_m = 6\n", "3:14", "`position_m` must be a list, is a whole number"),
    (NAME, "[radar]\nposition_m = [0, 6]\n", "3:14", "`position_m` must have 3 values, has 2"),
    (NAME, "[radar]\nposition_m = [0, \"0\", 6]\n", "3:18", "`position_m` must be a list of numbers, is a text"),
    (NAME, "[radar]\nboresight_az_deg = \"north\"\n", "3:20", "`boresight_az_deg` must be a number, is a text"),
    (NAME, "[dsp]\nrange_window = true\n", "3:16", "`range_window` must be a text in quotes, is true or false"),
    (NAME, "frame_interval_s = 2026-11-21\n", "2:20", "`frame_interval_s` must be a number, is a date or time"),
    ("", "name = 3\n", "1:8", "`name` must be a text in quotes, is a whole number"),
    // Values.
    ("", "name = \"a/b\"\n", "1:8", "`name` must be 1 to 64 letters"),
    ("", "name = \"\"\n", "1:8", "`name` must be 1 to 64 letters"),
    ("", "name = \"..\"\n", "1:8", "`name` must be 1 to 64 letters"),
    (NAME, "seed = -1\n", "2:8", "`seed` must be a number from 0"),
    (NAME, "seed = 9223372036854775808\n", "2:8", "`seed` must be a whole number up to 9223372036854775807"),
    (NAME, "frames = 0\n", "2:10", "`frames` must be a number from 1 to 1000000, is 0"),
    (NAME, "frame_interval_s = 0\n", "2:20", "`frame_interval_s` must be a number above 0"),
    (NAME, "frames = 2\nframe_interval_s = 1e-3\n", "3:20", "shorter than a frame of 0.00768 s"),
    (NAME, "[traffic]\nosi = \"a.osi\"\nfcd = \"b.xml\"\n", "3:7", "fcd"),
    (NAME, "[traffic]\nend_s = 1\n", "2:1", "fcd"),
    (NAME, "frame_interval_s = 5e-324\n[traffic]\nfcd = \"scene.obj\"\n", "2:20", "shorter than a frame of 0.00768 s"),
    (NAME, "[radar]\nposition_m = [0, nan, 6]\n", "3:18", "`position_m` must be a number from -100000 to 100000, is NaN"),
    (NAME, "[radar]\nposition_m = [0, 0, inf]\n", "3:21", "is inf"),
    (NAME, "[radar]\nboresight_el_deg = 91\n", "3:20", "`boresight_el_deg` must be a number from -90 to 90, is 91"),
    (NAME, "[radar.waveform]\nstart_frequency_ghz = 77e9\n", "3:23", "from 0.1 to 1000, is 7.7e10"),
    (NAME, "[radar.waveform]\nslope_mhz_per_us = -2000\n", "3:20", "the sweep ends at -23 GHz; with `slope_mhz_per_us` it must end from 0.1 to 2000 GHz"),
    (NAME, "[radar.waveform]\nslope_mhz_per_us = 1e4\nsample_rate_msps = 1e-3\n", "3:20", "the sweep ends at 2560077 GHz; with `slope_mhz_per_us` it must end from 0.1 to 2000 GHz"),
    (NAME, "[radar.waveform]\nslope_mhz_per_us = 0.0\n", "3:20", "`slope_mhz_per_us` must not be 0"),
    (NAME, "[radar.waveform]\nsample_rate_msps = 0\n", "3:20", "`sample_rate_msps`"),
    (NAME, "[radar.waveform]\nsamples = 4\n", "3:11", "`samples` must be a number from 8 to 65536, is 4"),
    (NAME, "[radar.waveform]\nchirps = 99999999999999999999999\n", "3:10", "`chirps` must be a number from 1 to 65536"),
    (NAME, "[radar.waveform]\nidle_us = -1\n", "3:11", "`idle_us` must be a number from 0"),
    (NAME, "[radar.waveform]\nsamples = 65536\nchirps = 65536\n", "3:11", "12 channels × 65536 chirps × 65536 samples are more than 134217728 values"),
    // The array.
    (NAME, "[radar.array]\npreset = \"4x4\"\n", "3:10", "`preset` cannot be `4x4`; it can be `1x1`, `1x4`, `3x4`, `6x8`, `12x16`"),
    (NAME, "[radar.array]\npreset = \"1x1\"\ntx_half_wavelengths = [[0, 0]]\nrx_half_wavelengths = [[0, 0]]\n", "3:10", "`preset` and `tx_half_wavelengths` exclude one another"),
    (NAME, "[radar.array]\ntx_half_wavelengths = [[0, 0]]\n", "3:23", "`tx_half_wavelengths` needs `rx_half_wavelengths` beside it"),
    (NAME, "[radar.array]\nrx_half_wavelengths = [[0, 0]]\n", "3:23", "`rx_half_wavelengths` needs `tx_half_wavelengths` beside it"),
    (NAME, "[radar.array]\ntx_half_wavelengths = []\nrx_half_wavelengths = [[0, 0]]\n", "3:23", "must have from 1 to 256 values, has 0"),
    (NAME, "[radar.array]\ntx_half_wavelengths = [[0, 0, 0]]\nrx_half_wavelengths = [[0, 0]]\n", "3:24", "must have 2 values, has 3"),
    (NAME, "[radar.array]\ntx_half_wavelengths = [0, 1]\nrx_half_wavelengths = [[0, 0]]\n", "3:24", "must be a list of pairs of numbers"),
    (NAME, "[radar.array]\nmultiplexing = \"fdm\"\n", "3:16", "it can be `simultaneous`, `tdm`, `ddm`, `bpm`"),
    (NAME, "[radar.array]\npolarization = \"v\"\n", "3:16", "it can be `vv`, `hh`, `vh`, `hv`"),
    (NAME, "[radar.array]\npattern = \"horn\"\n", "3:11", "it can be `isotropic`, `cosine`, `table`"),
    (NAME, "[radar.array]\npattern = \"cosine\"\n", "2:1", "[radar.array]: key `cosine_exponent` is missing"),
    (NAME, "[radar.array]\npattern = \"table\"\n", "2:1", "[radar.array]: key `pattern_file` is missing"),
    (NAME, "[radar.array]\npattern = \"table\"\npattern_file = \"not-there.csv\"\n", "4:16", "not-there.csv: cannot be read"),
    (NAME, "[radar.array]\npattern_file = \"a.csv\"\n", "3:16", "key `pattern_file` has no meaning for an isotropic pattern"),
    (NAME, "[radar.array]\ncosine_exponent = 1\n", "3:19", "key `cosine_exponent` has no meaning for an isotropic pattern"),
    // Noise, processing, fidelity, road.
    (NAME, "[noise]\n", "2:1", "[noise]: key `noise_figure_db` is missing"),
    (NAME, "[noise]\nnoise_figure_db = 12\nsnr_db = 20\n", "3:19", "`noise_figure_db` and `snr_db` exclude one another"),
    (NAME, "[noise]\nsnr_db = 20\ntemperature_k = 290\n", "4:17", "`temperature_k` and `snr_db` exclude one another"),
    (NAME, "[noise]\nnoise_figure_db = 12\ntemperature_k = 0\n", "4:17", "`temperature_k` must be a number above 0"),
    (NAME, "[noise]\nnoise_figure_db = -1\n", "3:19", "`noise_figure_db` must be a number from 0"),
    (NAME, "[dsp]\nrange_window = \"kaiser\"\n", "3:16", "`range_window` cannot be `kaiser`"),
    (NAME, "[dsp]\ndoppler_window = \"chebyshev\"\n", "3:18", "it can be `rect`, `hann`, `hamming`, `blackman`, `chebyshev-80`"),
    (NAME, "[dsp]\ndoppler_window = \"chebyshev-nan\"\n", "3:18", "cannot be `chebyshev-nan`"),
    (NAME, "[dsp]\nrange_window = \"chebyshev-19\"\n", "3:16", "it can be `rect`, `hann`, `hamming`, `blackman`, `chebyshev-80` or another level from 20 to 200 dB"),
    (NAME, "[dsp]\nnearest_m = -1\n", "3:13", "`nearest_m` must be a number from 0 to"),
    (NAME, "[dsp]\nfalse_alarm_rate = 1\n", "3:20", "`false_alarm_rate` must be a number from 1e-30 to 0.5, is 1"),
    (NAME, "[dsp]\nfalse_alarm_rate = 0\n", "3:20", "`false_alarm_rate` must be a number from 1e-30 to 0.5, is 0"),
    (NAME, "[dsp]\nfalse_alarm_rate = 5e-324\n", "3:20", "`false_alarm_rate` must be a number from 1e-30 to 0.5, is 5e-324"),
    (NAME, "[dsp]\nguard_cells = [2, -2]\n", "3:19", "`guard_cells` must be a number from 0"),
    (NAME, "[dsp]\ntraining_cells = [70, 8]\n", "3:18", "guard and training cells need 145 cells of Doppler, the map has 128"),
    (NAME, "[dsp]\ntraining_cells = [4, 200]\n", "3:18", "guard and training cells need 405 cells of range, the map has 256"),
    (NAME, "[dsp]\ntraining_cells = [0, 0]\n", "3:18", "`training_cells` are none"),
    (NAME, "[dsp]\ndetector = \"cfar\"\n", "3:12", "`cfar`; it can be `ca-cfar`, `go-cfar`, `so-cfar`, `os-cfar`"),
    (NAME, "[dsp]\ncluster = \"bicycles\"\n", "3:11", "`cluster` cannot be `bicycles`; it can be `vehicles`, `people`"),
    (NAME, "[dsp]\ncluster_range_m = 0\n", "3:19", "`cluster_range_m` must be a number above 0"),
    (NAME, "[fidelity]\naccuracy_db = 0\n", "3:15", "`accuracy_db` must be a number from -120, below 0, is 0"),
    (NAME, "[fidelity]\nfor = \"lanes\"\n", "3:7", "`for` cannot be `lanes`; it can be `cube`, `detection`, `tracks`, `class`"),
    (NAME, "[fidelity]\nfor = \"class\"\naccuracy_db = -20\n", "3:7", "`for` and `accuracy_db` exclude one another"),
    (NAME, "[fidelity]\ngoal = \"class\"\n", "3:1", "unknown key `goal`; the nearest is `for`"),
    (NAME, "[fidelity]\nbounces = 0\n", "3:11", "`bounces` must be a number from 1"),
    (NAME, "[fidelity]\nedges = \"yes\"\n", "3:9", "`edges` cannot be `yes`; it can be `off`, `on`"),
    (NAME, "[fidelity]\nsides = \"both\"\n", "3:9", "it can be `two`, `one`"),
    (NAME, "[fidelity]\necho = \"table\"\n", "3:8", "it can be `paths`, `rcs-table`"),
    (NAME, "[fidelity]\nwheels = \"round\"\n", "3:10", "`wheels` cannot be `round`; it can be `still`, `turning`"),
    (NAME, "[fidelity]\necho = \"rcs-table\"\n[model]\ndetail = \"statistical\"\n", "5:10", "`detail` and `echo = \"rcs-table\"` exclude one another"),
    (NAME, "[fidelity]\necho = \"rcs-table\"\nwheels = \"turning\"\n", "4:10", "`wheels` and `echo = \"rcs-table\"` exclude one another"),
    (NAME, "[fidelity]\nsides = \"one\"\n[road]\n", "3:9", "`sides` and `[road]` exclude one another"),
    (NAME, "[road]\n[fidelity]\necho = \"rcs-table\"\n", "4:8", "`echo` and `[road]` exclude one another"),
    (NAME, "[intersection]\nlane_centres_m = [2, 5]\n", "3:18", "lanes 1 and 2 overlap: centres 3 m apart, 3.75 m wide"),
    (NAME, "[intersection]\nlane_width_m = 0\n", "3:16", "`lane_width_m` must be a number above 0"),
    // Targets.
    (NAME, "[[target]]\nid = \"p\"\nposition_m = [0, 0, 0]\n", "2:1", "target `p`: key `kind` is missing"),
    (NAME, "[[target]]\nkind = \"point\"\nrcs_m2 = 1\nposition_m = [0, 9, 0]\n", "2:1", "target `#1`: key `id` is missing"),
    (POINT, "wheel_radius_m = 0.3\n[fidelity]\necho = \"rcs-table\"\n", "7:18", "target `p`: `wheel_radius_m` and `echo = \"rcs-table\"` exclude one another"),
    (NAME, "[[target]]\nkind = \"sphere\"\nid = \"p\"\nposition_m = [0, 9, 0]\n", "3:8", "`kind` cannot be `sphere`; it can be `mesh`, `point`"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\n", "2:1", "target `p`: key `position_m` is missing"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [0, 9, 0]\n", "2:1", "target `p`: key `rcs_m2` is missing"),
    (NAME, "[[target]]\nkind = \"mesh\"\nid = \"c\"\nposition_m = [0, 9, 0]\n", "2:1", "target `c`: key `model` is missing"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p,1\"\nrcs_m2 = 1\nposition_m = [0, 9, 0]\n", "4:6", "`id` must be 1 to 64 letters"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = -1\nposition_m = [0, 9, 0]\n", "5:10", "`rcs_m2` must be a number from 0"),
    (POINT, "[[target]]\nkind = \"point\"\nid = \"p\"\nposition_m = [2, 30, 1]\nrcs_m2 = 1\n", "9:6", "target `p`: id `p` is taken by the one in line 2"),
    (POINT, "lane = 2\ny_m = 30\n", "7:8", "`lane` and `position_m` exclude one another"),
    (POINT, "class = \"car\"\n", "7:9", "key `class` has no meaning for a point target"),
    (POINT, "yaw_deg = 3\n", "7:11", "key `yaw_deg` has no meaning for a point target"),
    (POINT, "velocity_mps = [0, 3e8, 0]\n", "7:20", "`velocity_mps` must be a number from -340 to 340, is 300000000"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\nlane = 2\n", "6:8", "`lane` needs `y_m` beside it"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\ny_m = 2\n", "6:7", "`y_m` needs `lane` beside it"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\nlane = 4\ny_m = 40\n", "6:8", "lane 4 does not exist; lanes are numbered 1 to 3"),
    (NAME, "[[target]]\nkind = \"point\"\nid = \"p\"\nrcs_m2 = 1\nposition_m = [0, 0, 6]\n", "6:14", "target `p`: a point target must be a wavelength of 0.003"),
    (CAR, "class = \"tram\"\n", "7:9", "it can be `car`, `bus`, `truck`, `motorcycle`"),
    (CAR, "rcs_m2 = 1\n", "7:10", "key `rcs_m2` has no meaning for a mesh target"),
    (CAR, "unit_scale = 0\n", "7:14", "`unit_scale` must be a number from 1e-9 to 1000000, is 0"),
    (CAR, "unit_scale = 0.01\n", "7:14", "key `unit_scale` has no meaning for one of the project's vehicles"),
    (POINT, "wheel_angle_deg = 3\n", "7:19", "`wheel_angle_deg` needs `wheel_radius_m` beside it"),
    (CAR, "acceleration_mps2 = [0, 101, 0]\n", "7:25", "`acceleration_mps2` must be a number from -100 to 100, is 101"),
    (CAR, "yaw_deg = 1e3\n", "7:11", "`yaw_deg` must be a number from -360 to 360, is 1000"),
    (CAR, "[[target]]\nkind = \"mesh\"\nid = \"d\"\nposition_m = [2, 30, 0]\nmodel = \"car-suw\"\n", "11:9", "model `car-suw` is neither a .glb, .gltf, .stl, .obj or .xoma file nor one of the project's vehicles; the nearest is `car-suv`"),
    (CAR, "[[target]]\nkind = \"mesh\"\nid = \"d\"\nposition_m = [2, 30, 0]\nmodel = \"absent.glb\"\n", "11:9", "absent.glb: cannot be read"),
    (CAR, "[[target]]\nkind = \"mesh\"\nid = \"d\"\nposition_m = [2, 30, 0]\nmodel = \"scene.obj\"\n", "11:9", "scene.obj:1: expected a polygonal OBJ statement"),
    // The road.
    (NAME, "[road]\nmirror = \"off\"\nsubstance = \"asphalt\"\n", "4:13", "key `substance` has no meaning for a road that is no mirror"),
    (NAME, "[road]\nopenmaterial = 5\n", "3:16", "[road]: `openmaterial` must be a text in quotes, is a whole number"),
    (NAME, "[road]\nsubstance = \"asphalt\"\nopenmaterial = \"a.xomp\"\n", "4:16", "`openmaterial` and `substance` exclude one another"),
    (NAME, "[road]\nbackscatter = \"on\"\n", "3:15", "`backscatter` cannot be `on`; it can be `off`, `floor`"),
    (NAME, "[road]\nbackscatter_gamma_db = -20\n", "3:24", "`backscatter_gamma_db` needs `backscatter = \"floor\"` beside it"),
    (NAME, "[road]\nbackscatter = \"floor\"\nbackscatter_gamma_db = 40\n", "4:24", "`backscatter_gamma_db` must be a number from -100 to 30, is 40"),
    (NAME, "[road]\nbackscatter = \"floor\"\n[radar.array]\npolarization = \"vh\"\n", "3:15", "`backscatter` and `a cross polarization` exclude one another"),
    (NAME, "[road]\nmirror = \"off\"\nbackscatter = \"floor\"\n[fidelity]\necho = \"rcs-table\"\n", "4:15", "`backscatter` and `echo = \"rcs-table\"` exclude one another"),
    (NAME, "[road]\nbackscatter = \"floor\"\n[radar]\nposition_m = [0, 0, 0]\n", "3:15", "`backscatter` and `a radar that is not above the road` exclude one another"),
    // Clutter.
    (NAME, "[[clutter]]\nmodel = \"pole\"\nposition_m = [0, 9, 0]\n", "2:1", "clutter `#1`: key `id` is missing"),
    (NAME, "[[clutter]]\nid = \"k\"\nmodel = \"kerb\"\nlength_m = 9\n", "2:1", "clutter `k`: key `position_m` is missing"),
    (NAME, "[[clutter]]\nid = \"k\"\nmodel = \"kerb\"\nposition_m = [0, 9, 0]\n", "2:1", "clutter `k`: key `length_m` is missing"),
    (NAME, "[[clutter]]\nid = \"k\"\nmodel = \"curb\"\nposition_m = [0, 9, 0]\n", "4:9", "model `curb` is neither a .glb, .gltf, .stl, .obj or .xoma file nor one of the project's street furniture; the nearest is `kerb`"),
    (NAME, "[[clutter]]\nid = \"p\"\nmodel = \"pole\"\nlength_m = 9\nposition_m = [0, 9, 0]\n", "5:12", "key `length_m` has no meaning for a pole"),
    (NAME, "[[clutter]]\nid = \"p\"\nmodel = \"scene.obj\"\nheight_m = 9\nposition_m = [0, 9, 0]\n", "5:12", "key `height_m` has no meaning for a mesh file"),
    (NAME, "[[clutter]]\nid = \"p\"\nmodel = \"pole\"\ndiameter_m = 0\nposition_m = [0, 9, 0]\n", "5:14", "`diameter_m` must be a number from 0.01 to 5, is 0"),
    (NAME, "[[clutter]]\nid = \"p\"\nmodel = \"pole\"\nvelocity_mps = [0, 1, 0]\nposition_m = [0, 9, 0]\n", "5:1", "clutter `p`: unknown key `velocity_mps` here"),
    (POINT, "[[clutter]]\nid = \"p\"\nmodel = \"pole\"\nposition_m = [0, 9, 0]\n", "8:6", "clutter `p`: id `p` is taken by the one in line 2"),
    (CAR, "[[target]]\nkind = \"mesh\"\nid = \"d\"\nposition_m = [2, 30, 0]\nmodel = \"scene.obj\"\nvehicle_seed = 3\n", "12:16", "key `vehicle_seed` has no meaning for a mesh file"),
];

#[test]
fn every_broken_scene_is_refused_at_its_place_with_its_rule() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.obj"), "name = \"no mesh\"\n").unwrap();
    let file = folder.path().join("scene.toml");
    let mut failures = vec![];
    for (start, rest, place, words) in CASES {
        let Err(errors) = read_text(&file, &format!("{start}{rest}")) else {
            failures.push(format!("accepted: {rest}"));
            continue;
        };
        let beginning = format!("{}:{place}: ", file.display());
        let lines: Vec<String> = errors.0.iter().map(ToString::to_string).collect();
        if !lines.iter().any(|line| line.starts_with(&beginning) && line.contains(words)) {
            failures.push(format!("wanted {place} {words}\n  got {lines:?}"));
        }
    }
    assert!(failures.is_empty(), "{} of {}:\n{}", failures.len(), CASES.len(), failures.join("\n"));
}

#[test]
fn one_broken_rule_gives_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    // A file that is no TOML may be said to break more; the mesh file is not there in this test.
    let single = CASES.iter().filter(|case| !case.3.contains("TOML") && !case.1.contains("scene.obj"));
    for (start, rest, ..) in single {
        let errors = read_text(&file, &format!("{start}{rest}")).unwrap_err();
        assert_eq!(errors.0.len(), 1, "{rest}: {errors}");
    }
}

#[test]
fn all_broken_rules_are_reported_in_the_order_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = "\
seed = -1
[[target]]
kind = \"mesh\"
id = \"bus-2\"
model = \"absent.glb\"
position_m = [2, 30, 0]
velocty_mps = [0, -5, 0]
[radar.waveform]
samples = 2.5
chrips = 64
[dsp]
false_alarm_rate = 2
";
    let errors = read_text(&folder.path().join("scene.toml"), text).unwrap_err();
    let places: Vec<_> =
        errors.0.iter().map(|error| error.position.map(|p| (p.line, p.column)).unwrap()).collect();
    assert_eq!(places, [(1, 1), (1, 8), (5, 9), (7, 1), (9, 11), (10, 1), (12, 20)], "{errors}");
    assert_eq!(errors.to_string().lines().count(), 7);
}

#[test]
fn damage_to_one_line_does_not_hide_what_is_wrong_in_others() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{NAME}[radar]\nboresight_az_deg =\n[dsp]\nfalse_alarm_rate = 2\n");
    let errors = read_text(&folder.path().join("scene.toml"), &text).unwrap_err().to_string();
    assert!(errors.contains("not valid TOML") && errors.contains("`false_alarm_rate`"), "{errors}");
}

#[test]
fn a_missing_file_is_the_systems_fault_and_a_broken_one_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let absent = scene::read(&folder.path().join("absent.toml"), &whole()).unwrap_err();
    assert!(absent.is_system() && absent.to_string().contains("absent.toml: cannot be read"), "{absent}");
    let a_folder = scene::read(folder.path(), &whole()).unwrap_err();
    assert!(a_folder.is_system(), "{a_folder}");
    let file = folder.path().join("scene.toml");
    let model = CAR.replace("car-suv", "absent.glb");
    assert!(read_text(&file, &model).unwrap_err().is_system());
    let both = read_text(&file, &format!("{model}colour = \"red\"\n")).unwrap_err();
    assert!(!both.is_system(), "what was read is refused too: {both}");
    std::fs::write(&file, b"name = \"\xff\"\n").unwrap();
    let not_text = scene::read(&file, &whole()).unwrap_err();
    assert!(
        !not_text.is_system() && not_text.to_string().contains("not UTF-8 text from byte 8 on"),
        "{not_text}"
    );
    std::fs::write(&file, vec![b'#'; 5 << 20]).unwrap();
    assert!(scene::read(&file, &whole()).unwrap_err().to_string().contains("has more than 4194304 bytes"));
}

fn read_text(file: &Path, text: &str) -> Result<artifact::scene::SceneHeader, SceneErrors> {
    std::fs::write(file, text).unwrap();
    scene::read(file, &whole())
}

fn whole() -> ReadOptions {
    ReadOptions::whole()
}

#[test]
fn of_many_broken_rules_the_first_hundred_are_told_and_the_others_counted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("many.toml");
    // As many keys as a file may hold; the time grows with them, not with their square, which was minutes.
    for count in [101_u64, 300_000] {
        let keys: String = (0..count).map(|i| format!("k{i}=1\n")).collect();
        let start = std::time::Instant::now();
        let errors = read_text(&file, &format!("name = \"many\"\n{keys}")).unwrap_err();
        assert!(start.elapsed().as_secs() < 60, "{count} keys take {:?}", start.elapsed());
        assert_eq!((errors.0.len(), errors.1), (100, count - 100));
        let text = errors.to_string();
        assert!(text.contains("many.toml:101:1: unknown key `k99`"), "the first of the file: {text}");
        assert!(text.ends_with(&format!("\nand {} more", count - 100)), "{text}");
    }
    // Ids that are taken, too.
    let point = "[[target]]\nkind=\"point\"\nid=\"p\"\nposition_m=[0,9,0]\nrcs_m2=1\n";
    let errors = read_text(&file, &format!("name = \"many\"\n{}", point.repeat(60_000))).unwrap_err();
    assert_eq!(errors.1, 59_999 - 100);
}

#[test]
fn a_refusal_repeats_no_megabytes_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.toml");
    let word = "x".repeat(2 << 20);
    for text in [format!("{word} = 1\n"), format!("[radar]\n{word} = 1\n"), format!("[{word}]\na = 1\n")] {
        let said = read_text(&file, &format!("name = \"long\"\n{text}")).unwrap_err().to_string();
        let is_named = said.starts_with(&format!("{}:", file.display()));
        assert!(said.len() < 1 << 14 && is_named, "{} bytes", said.len());
    }
}

/// Tables in a line, each opened by a key of so many names: the parser bounds both, not their product.
fn levels(tables: usize, names: usize) -> String {
    let key = vec!["a"; names].join(".");
    format!("{key} = {}1{}", format!("{{ {key} = ").repeat(tables), " }".repeat(tables))
}

#[test]
fn nesting_without_end_is_refused_and_does_not_end_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("deep.toml");
    let deep = [
        format!("a = {}", "[".repeat(1 << 21)),
        format!("a = {}{}", "[".repeat(1 << 20), "]".repeat(1 << 20)),
        format!("a = {}", "{a=".repeat(1 << 19)),
        format!("{}a = 1", "a.".repeat(1 << 20)),
        format!("[{}a]", "a.".repeat(1 << 20)),
        format!("[[{}a]]", "a.".repeat(1 << 20)),
        "\"\"\"".repeat(1 << 19),
        levels(79, 79),
        format!("[[radars]]\nid = \"one\"\n{}", levels(79, 79)),
    ];
    for (i, text) in deep.iter().enumerate() {
        let errors = read_text(&file, &format!("name = \"deep\"\n{text}\n")).unwrap_err();
        assert!(!errors.0.is_empty() && !errors.is_system(), "{i}: {errors}");
    }
}
