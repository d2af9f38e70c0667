//! Configurations that are read, and those that are refused with their line.

use super::*;

const SDK: &str = include_str!("../../../../fixtures/devices/xwr1843.cfg");
const LOG: &str = include_str!("../../../../fixtures/devices/studio-log.txt");
const SCRIPT: &str = include_str!("../../../../fixtures/devices/studio.lua");

fn refused(text: &str, board: Option<Board>) -> String {
    let fault = settings(text, board).unwrap_err();
    format!("{}: {}", fault.line.unwrap_or_default(), fault.rule)
}

fn scene_of(text: &str, board: Option<Board>) -> String {
    scene_text(&settings(text, board).unwrap(), Path::new("a.cfg")).unwrap()
}

#[test]
fn a_log_a_script_and_a_cfg_of_the_same_chirps_give_the_same_tables() {
    let values = |text: &str, board| {
        let told = scene_tables::entries(&settings(text, board).unwrap());
        told.into_iter().map(|entry| (entry.key, entry.value)).collect::<Vec<_>>()
    };
    let [sdk, script] =
        [(SDK, Some(Board::Xwr1843)), (SCRIPT, None)].map(|(text, board)| values(text, board));
    assert_eq!(sdk, script);
    let expected = [
        ("start_frequency_ghz", "77.42"),
        ("slope_mhz_per_us", "60.0"),
        ("sample_rate_msps", "2.5"),
        ("samples", "128"),
        ("idle_us", "40.8"),
        ("chirps", "128"),
        ("tx_half_wavelengths", "[[0.0, 0.0], [4.0, 0.0]]"),
        ("rx_half_wavelengths", "[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]"),
        ("multiplexing", "\"tdm\""),
        ("sampling", "\"complex\""),
    ];
    assert_eq!(sdk, expected.map(|(key, value)| (key, value.to_owned())));
    // Codes are steps of 54 Hz and 48 kHz/µs: 1243 of them are 60.011737 MHz/µs.
    let log = values(LOG, None);
    let number = |key: &str| log.iter().find(|(k, _)| *k == key).unwrap().1.parse::<f64>().unwrap();
    assert!((number("slope_mhz_per_us") - 1243.0 * 3600.0 * 900.0 / f64::from(1 << 26)).abs() < 1e-8);
    assert!((number("start_frequency_ghz") - 77.0 - 7e-3 * number("slope_mhz_per_us")).abs() < 1e-7);
    assert_eq!((number("samples"), number("chirps"), number("idle_us")), (128.0, 128.0, 40.8));
}

#[test]
fn the_last_commands_before_the_last_start_of_the_sensor_count() {
    let again = LOG.replace(
        "API:SensorStart,0,",
        "API:SensorStart,0,\n1: API:ProfileConfig,0,1435384036,1,1,9999,0,0,9,0,64,9000,0,0,30,0,",
    );
    assert_eq!(settings(&again, None), settings(LOG, None));
}

#[test]
fn what_is_not_read_is_refused_by_name_with_its_line() {
    let at = |name: &str| 1 + SDK.lines().position(|line| line.starts_with(name)).unwrap();
    let with = |from: &str, to: &str| {
        assert!(SDK.contains(from), "{from}");
        refused(&SDK.replace(from, to), Some(Board::Xwr1843))
    };
    let chirp = at("chirpCfg 1 1");
    for (text, line, told) in [
        (with("chirpCfg 1 1 0 0 0 0 0 4", "chirpCfg 1 1 0 0 0 0 0 5"), chirp, "at once"),
        (with("chirpCfg 1 1 0 0 0 0 0 4", "chirpCfg 1 1 0 0 0 0 0 2"), chirp, "channelCfg of line"),
        (with("chirpCfg 1 1 0 0 0 0 0 4", "chirpCfg 1 1 0 0 0 3 0 4"), chirp, "differ from their profile"),
        (with("chirpCfg 1 1 0 0 0 0 0 4", "chirpCfg 1 1 1 0 0 0 0 4"), chirp, "one form alone"),
        (with("chirpCfg 1 1 0 0 0 0 0 4", ""), at("frameCfg"), "chirp 1, which nothing defines"),
        (with("frameCfg 0 1 128", "frameCfg 1 0 128"), at("frameCfg"), "are none"),
        (with("frameCfg 0 1 128", "frameCfg 0 600 128"), at("frameCfg"), "from 0 to 511"),
        (with("frameCfg 0 1", "advFrameCfg 0 1"), at("frameCfg"), "advanced frames"),
        (with("bpmCfg -1 0", "bpmCfg -1 1"), at("bpmCfg"), "binary phases"),
        (with("dfeDataOutputMode 1", "dfeDataOutputMode 3"), at("dfeDataOutputMode"), "advanced frames"),
        (with("channelCfg 15 5 0", "channelCfg 15 5 1"), at("channelCfg"), "cascades"),
        (with(" 128 2500 ", " 128 nan "), at("profileCfg"), "the sample rate is `nan`"),
        (with(" 128 2500 ", " 200 2500 "), at("profileCfg"), "the ramp, which ends after 62"),
        (with("profileCfg 0 77", "profileCfg 0 60"), at("profileCfg"), "sends from 76 to 81"),
    ] {
        assert!(text.starts_with(&format!("{line}: ")) && text.contains(told), "{line} {told}: {text}");
    }
    assert!(refused(SDK, Some(Board::Xwr1642)).contains("the xwr1642 has 2 transmitters"));
    assert!(refused("channelCfg 15 5 0", None).contains("there is no frameCfg"));
    let nameless = LOG.replace("API:select_chip_version,AR1843", "API:other,0");
    assert!(refused(&nameless, None).contains("--device"));
    assert!(refused("ar1.ProfileConfig(0, 77,", None).contains("does not end in its line"));
    assert!(refused("ar1.ChirpConfig_mult(1, 0)", None).contains("cascades"));
    assert!(
        refused("ar1.ProfileConfig(0, START, 1, 1, 1, 0,0,0,0,0,0, 1, 0, 64, 2000)", None)
            .contains("`START`, not a number")
    );
}

#[test]
fn the_scene_that_is_written_is_one_with_that_radar() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("s.toml");
    for (text, board) in [(SDK, Some(Board::Xwr1843)), (LOG, None), (SCRIPT, None)] {
        std::fs::write(&file, scene_of(text, board)).unwrap();
        let header = pipeline::chain::loading::radar_only(&file, None).unwrap();
        let radar = &header.radar;
        assert_eq!((radar.array.tx_m.len(), radar.array.rx_m.len(), radar.waveform.chirps), (2, 4, 128));
        assert!((radar.repetition_interval_s() - 184e-6).abs() < 1e-12);
        let settings = settings(text, board).unwrap();
        let configured = Configured { file: Path::new("a.cfg"), settings: &settings };
        assert!(scene_with(&file, None, &configured).is_ok());
        // A scene that says nothing of the radar has it all the same.
        std::fs::write(&file, "name = \"a\"\n").unwrap();
        assert_eq!(scene_with(&file, None, &configured).unwrap().radar.waveform, radar.waveform);
        let other = "name = \"a\"\n[radar.waveform]\nsamples = 64\n";
        std::fs::write(&file, other).unwrap();
        let told = scene_with(&file, None, &configured).unwrap_err().to_string();
        let line = settings.profile.line;
        assert!(told.contains(&format!("radar.waveform.samples is 64.0; a.cfg:{line} has 128.0")), "{told}");
    }
}

#[test]
fn a_configuration_that_no_scene_may_have_is_refused_with_its_line_and_the_rule() {
    let at = |name: &str| 1 + SDK.lines().position(|line| line.starts_with(name)).unwrap();
    let profile = format!("a.cfg:{}: profileCfg: [radar.waveform]: ", at("profileCfg"));
    let frame = format!("a.cfg:{}: frameCfg: ", at("frameCfg"));
    for (from, to, told) in [
        (" 0 50 1 0", " 0 0 1 0", format!("{frame}`frame_interval_s` must be a number above 0")),
        (" 0 50 1 0", " 0 -5 1 0", format!("{frame}`frame_interval_s` must be a number above 0")),
        (" 128 2500 ", " 3 2500 ", format!("{profile}`samples` must be a number from 8")),
        (" 0 0 60 1 ", " 0 0 60000 1 ", format!("{profile}`slope_mhz_per_us` must be a number from -10000")),
    ] {
        assert!(SDK.contains(from), "{from}");
        let settings = settings(&SDK.replace(from, to), Some(Board::Xwr1843)).unwrap();
        let error = scene_text(&settings, Path::new("a.cfg")).unwrap_err().to_string();
        assert!(error.starts_with(&told), "{to}: {error}");
    }
}
