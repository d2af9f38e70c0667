//! Configurations that are read, and those that are refused with their line.

use super::*;
use crate::devices::Lanes;

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
        (
            with("channelCfg 15 5 0", "channelCfg 15 5 0 0 0"),
            at("channelCfg"),
            "it has 3 numbers, 5 are here",
        ),
        (with(" 128 0 50 1 0", " 128 0 128 50 1 0"), at("frameCfg"), "it has 7 numbers, 8 are here"),
        (with(" 0 50 1 0", " 0 23.5 1 0"), at("frameCfg"), "256 chirps of 92 µs take 23.552 ms"),
        (with(" 0 50 1 0", " 0 0 1 0"), at("frameCfg"), "its period is 0 ms"),
        (with("lowPower 0 0", "lvdsStreamCfg -1 0"), at("lowPower"), "it has 4 numbers, 2 are here"),
        (with(" 128 2500 ", " 128 nan "), at("profileCfg"), "the sample rate is `nan`"),
        (with(" 128 2500 ", " 200 2500 "), at("profileCfg"), "the ramp, which ends after 62"),
        (with("profileCfg 0 77", "profileCfg 0 60"), at("profileCfg"), "chirps begin at 60 GHz"),
        (with(" 0 0 60 1 ", " 0 0 75 1 "), at("profileCfg"), "the last sample is taken at 81.365 GHz"),
        (with(" 0 0 60 1 ", " 0 0 -60 1 "), at("profileCfg"), "sends from 76 to 81"),
        (with(" 0 0 60 1 ", " 0 8 60 1 "), at("profileCfg"), "phases of several transmitters"),
        (with("adcCfg 2 1", "adcCfg 2 3"), at("adcCfg"), "format 3, pseudo real, is not read"),
        (with("adcCfg 2 1", "adcCfg 2 4"), at("adcCfg"), "the format of samples is 4"),
        (with("adcCfg 2 1", "adcCfg 2 0"), at("adcbufCfg"), "its samples are complex, those of adcCfg"),
    ] {
        assert!(text.starts_with(&format!("{line}: ")) && text.contains(told), "{line} {told}: {text}");
    }
    assert!(refused(SDK, Some(Board::Xwr1642)).contains("the xwr1642 has 2 transmitters"));
    assert!(refused("channelCfg 15 5 0", None).contains("there is no frameCfg"));
    let nameless = LOG.replace("API:select_chip_version,AR1843", "API:other,0");
    assert!(refused(&nameless, None).contains("--device"));
    assert!(refused("ar1.ProfileConfig(0, 77,", None).contains("the call does not end"));
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
        let configured = ConfigFile { file: Path::new("a.cfg"), settings: &settings };
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
    let settings = settings(&SDK.replace(" 128 2500 ", " 3 2500 "), Some(Board::Xwr1843)).unwrap();
    let error = scene_text(&settings, Path::new("a.cfg")).unwrap_err().to_string();
    assert!(error.starts_with(&format!("{profile}`samples` must be a number from 8")), "{error}");
}

#[test]
fn a_scene_that_is_made_has_the_noise_of_the_boards_data_sheet() {
    let noise = |text: &str, board| {
        let scene = scene_of(text, Some(board));
        let line = scene.lines().find(|line| line.starts_with("noise_figure_db")).unwrap().to_owned();
        assert!(line.contains("a recording's own level is taken from its map"), "{line}");
        line
    };
    let low = SDK.replace("profileCfg 0 77", "profileCfg 0 76").replace(" 0 0 60 1 ", " 0 0 15 1 ");
    let sixty = SDK.replace("profileCfg 0 77", "profileCfg 0 60").replace(" 0 0 60 1 ", " 0 0 50 1 ");
    for (text, board, told) in [
        (SDK, Board::Xwr1843, "noise_figure_db = 15.0 "),
        (&low, Board::Xwr1843, "noise_figure_db = 14.0 "),
        (&sixty, Board::Xwr6843, "noise_figure_db = 12.0 "),
    ] {
        let line = noise(text, board);
        assert!(line.starts_with(told), "{line}");
    }
}

#[test]
fn a_converter_that_no_command_tells_of_is_taken_with_a_remark() {
    let without = SDK.replace("adcCfg 2 1\n", "");
    let told = "sampling = \"complex\"            # I and Q, 16 bits";
    for (text, remark) in [(SDK, "\n"), (&without, ": taken, the file does not say\n")] {
        let scene = scene_of(text, Some(Board::Xwr1843));
        assert!(scene.contains(&format!("{told}{remark}")), "{scene}");
    }
    // What is passed on are samples of the converter.
    let real = without.replace("adcbufCfg -1 0 0 1 1", "adcbufCfg -1 1 0 1 1");
    assert_eq!(settings(&real, Some(Board::Xwr1843)).unwrap().sampling, artifact::radar::Sampling::Real);
}

#[test]
fn words_between_the_samples_of_a_recording_are_refused_with_the_command_that_has_them_sent() {
    let stream = |text: &str, board| {
        let told = check_stream(Path::new("a.cfg"), &settings(text, board).unwrap());
        told.map_err(|failure| failure.to_string())
    };
    let line = 1 + SDK.lines().position(|line| line == "lowPower 0 0").unwrap();
    for (words, between) in [
        ("-1 0 0 0", None),
        ("-1 0 1 0", None),
        ("-1 1 0 0", None),
        ("-1 1 1 0", Some("a header for each chirp")),
        ("-1 0 4 0", Some("parameters and quality of each chirp")),
        ("-1 0 1 1", Some("words of the software")),
    ] {
        let text = SDK.replace("lowPower 0 0", &format!("lvdsStreamCfg {words}"));
        let told = between.map_or(Ok(()), |between| {
            let rule = format!("a recording has {between} between its samples; samples alone are read");
            Err(format!("a.cfg:{line}: lvdsStreamCfg: {rule}"))
        });
        assert_eq!(stream(&text, Some(Board::Xwr1843)), told, "{words}");
    }
    let again = SDK.replace("lowPower 0 0", "lvdsStreamCfg -1 1 1 0\nlvdsStreamCfg -1 0 1 0");
    assert_eq!(stream(&again, Some(Board::Xwr1843)), Ok(()), "the last one counts");
    for (path, is_read) in [("513, 1216644097, 0", true), ("513, 1216644150, 0", false)] {
        let told = stream(&script(FRAME, &format!("ar1.DataPathConfig({path})\n{FRAME}")), None);
        assert_eq!(told.is_ok(), is_read, "{told:?}");
        assert!(told.err().is_none_or(|told| told.contains("DataPathConfig: a recording has parameters")));
    }
    for (path, is_read) in [("1,1,0,", true), ("1,54,0,", false), ("1,6,0,", false), ("1,1,14,", false)] {
        let of_log = LOG.replace("API:LaneConfig", &format!("API:DataPathConfig,{path}\n2: API:LaneConfig"));
        assert_eq!(stream(&of_log, None).is_ok(), is_read, "{path}");
    }
}

/// The script with other text in the place of some.
fn script(from: &str, to: &str) -> String {
    assert!(SCRIPT.contains(from), "{from}");
    SCRIPT.replace(from, to)
}

const FRAME: &str = "ar1.FrameConfig(0, 1, 8, 128, 50, 0, 1)";

#[test]
fn calls_of_a_script_that_change_chirps_in_other_ways_are_refused_by_name_and_line() {
    let frame = 1 + SCRIPT.lines().position(|line| line.starts_with("ar1.FrameConfig")).unwrap();
    for (call, told) in [
        ("ar1.AdvChirpConfig(2, 0, 0, 1, 100)", "AdvChirpConfig: tables of chirps' parameters"),
        ("ar1.AdvChirpLUTLoad(\"a.txt\")", "AdvChirpLUTLoad: tables"),
        ("ar1.SetTxEnAdvChirpConfigLUT(32, 4, 3, 7, 3, 7)", "SetTxEnAdvChirpConfigLUT: tables"),
        ("ar1.SetPerChirpPhaseShifterConfig(1, 1, 0, 0, 32)", "SetPerChirpPhaseShifterConfig: phases"),
        ("ar1.DynChirpConfig(0, 0, 0)", "DynChirpConfig: chirps that are changed"),
        ("ar1.BpmChirpConfig(0, 0, 1)", "BpmChirpConfig: binary phases"),
        ("ar1.SetPerChirpPhaseShifterConfig_mult(1, 1, 1, 0, 0, 0)", "cascades"),
        ("ar1.LVDSLaneConfig(0, 1, 0, 0, 0, 1, 0, 0)", "lanes 0b1 are not read"),
        ("ar1.ChanNAdcConfig(1, 0, 1, 1, 1, 1, 1, 2, 3, 0)", "format 3, pseudo real"),
        ("ar1.ChanNAdcConfig(1, 0, 1, 1, 1, 1, 1, 2, 1, 65536)", "ChanNAdcConfig: cascades"),
    ] {
        let text = refused(&script(FRAME, &format!("x() {call} {FRAME}")), None);
        assert!(text.starts_with(&format!("{frame}: ")) && text.contains(told), "{call}: {text}");
    }
    let idle = script(FRAME, &format!("ar1.SetPerChirpPhaseShifterConfig(1, 1, 0, 0, 0)\n{FRAME}"));
    assert!(settings(&idle, None).is_ok(), "phases of 0 change nothing");
    let reduced = script("1, 2, 1, 0)", "1, 2, 131073, 1)");
    assert_eq!(
        settings(&reduced, None).unwrap(),
        settings(SCRIPT, None).unwrap(),
        "upper bits of the format"
    );
    let phases = script("62, 0, 0, 0, 0, 0, 0, 60", "62, 0, 0, 0, 0, 32, 0, 60");
    assert!(refused(&phases, None).contains("ProfileConfig: phases of several transmitters"));
    let cascade = LOG.replace("ChannelConfig,5,15,0,", "ChannelConfig,5,15,1,");
    assert!(refused(&cascade, None).contains("ChannelConfig: cascades"));
}

#[test]
fn advanced_frames_of_a_script_are_refused_and_beside_a_plain_one_the_way_out_is_told() {
    let advanced = "ar1.AdvanceFrameConfig(2, 1536, 0, 0, 1, 64)";
    let text = refused(&script(FRAME, advanced), None);
    assert!(text.contains("AdvanceFrameConfig: advanced frames of sub-frames are not read"), "{text}");
    let both = script(FRAME, &format!("if x then\n{FRAME}\nelse\n{advanced}\nend"));
    let line = 1 + both.lines().position(|line| line == advanced).unwrap();
    let text = refused(&both, None);
    let told = format!("FrameConfig stands in line {}: control flow is not followed, leave out", line - 2);
    assert!(text.starts_with(&format!("{line}: AdvanceFrameConfig")) && text.contains(&told), "{text}");
}

#[test]
fn remarks_texts_and_the_layout_of_a_script_change_nothing() {
    let told = settings(SCRIPT, None).unwrap();
    let other = "ar1.FrameConfig(0, 1, 8, 64, 20, 0, 1)";
    for to in [
        format!("--[[ {other} ]] {FRAME}"),
        format!("--[[\n{other}\n]]\n{FRAME}"),
        format!("--[==[\nar1.StartFrame()\n]] ]==]\n{FRAME}"),
        format!("WriteToLog(\"--- frame\", \"red\") {FRAME}"),
        format!("{other} {FRAME}"),
        format!("{FRAME} -- {other}"),
        FRAME.replace(", 8", ",\n  8"),
    ] {
        let found = settings(&script(FRAME, &to), None).unwrap();
        assert_eq!(scene_tables::entries(&found).len(), scene_tables::entries(&told).len(), "{to}");
        assert_eq!((found.frame.value, found.profile.value), (told.frame.value, told.profile.value), "{to}");
    }
    let helper = format!("function go() ar1.StartFrame() end\n{}", script("ar1.StartFrame()", "go()"));
    assert_eq!(settings(&helper, None).unwrap().frame.value, told.frame.value, "a start within a function");
    let remarked = SDK.replace("sensorStop", "% exported beside ar1.lua\nsensorStop");
    assert!(settings(&remarked, Some(Board::Xwr1843)).is_ok(), "a .cfg whose remark names ar1.");
}

#[test]
fn commands_in_branches_are_remarked_on_and_refused_where_they_differ() {
    let other = "ar1.FrameConfig(0, 1, 8, 64, 20, 0, 1)";
    let line = 1 + SCRIPT.lines().position(|line| line == FRAME).unwrap();
    for to in [
        format!("if x then {FRAME} else {other} end"),
        format!("{FRAME} if x then {other} end"),
        format!("if x then {other} end {FRAME}"),
    ] {
        let text = refused(&script(FRAME, &to), None);
        let told = format!("{line}: FrameConfig: line {line} has it with other numbers");
        assert!(text.starts_with(&told) && text.contains("control flow is not followed"), "{to}: {text}");
    }
    let same = settings(&script(FRAME, &format!("if x then\n{FRAME}\nelse\n{FRAME}\nend")), None).unwrap();
    let [remark] = &same.remarks[..] else { panic!("{:?}", same.remarks) };
    assert_eq!(remark.line, line + 1);
    assert_eq!(remark.text, "it stands in a branch of `if`, as 1 more do: all are taken to run");
    assert_eq!(settings(SCRIPT, None).unwrap().remarks, [], "a condition is no branch");
}

#[test]
fn lanes_of_a_script_are_read_and_another_chip_than_the_one_asked_for_is_remarked_on() {
    for (lanes, told) in [("1, 1, 0, 0", Lanes::Two), ("1, 1, 1, 1", Lanes::Four)] {
        let call = format!("ar1.LVDSLaneConfig(0, {lanes}, 1, 0, 0)\n{FRAME}");
        assert_eq!(settings(&script(FRAME, &call), None).unwrap().lanes(), Some(told));
    }
    let remarks = |board| settings(LOG, board).unwrap().remarks;
    let [remark] = &remarks(Some(Board::Xwr1443))[..] else { panic!("no remark") };
    let text = "select_chip_version: it names the chip of the xwr1843; --device xwr1443 is taken";
    assert_eq!((remark.line, remark.text.as_str()), (2, text));
    assert_eq!((remarks(Some(Board::Xwr1843)), remarks(None)), (vec![], vec![]));
}

#[test]
fn the_frames_of_scene_and_configuration_have_to_be_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("s.toml");
    let settings = settings(SDK, Some(Board::Xwr1843)).unwrap();
    let configured = ConfigFile { file: Path::new("a.cfg"), settings: &settings };
    let with = |text: &str| {
        std::fs::write(&file, format!("name = \"a\"\n{text}\n")).unwrap();
        scene_with(&file, None, &configured).map_err(|failure| failure.to_string())
    };
    assert_eq!(with("").unwrap().frame_interval_s, 0.05);
    assert_eq!(with("frame_interval_s = 0.05").unwrap().frame_interval_s, 0.05);
    let line = settings.frame.line;
    for (text, told) in [
        ("frame_interval_s = 0.1", format!("frame_interval_s is 0.1; a.cfg:{line} has 0.05")),
        (
            "[radar.waveform]\nsub_frame_idle_us = [40.8, 45.0]",
            format!(
                "radar.waveform.sub_frame_idle_us is one of chirp intervals of [92.0, 96.2] µs; a.cfg:{line}"
            ),
        ),
        (
            "[radar.waveform]\nstagger_us = [0.0, 3.0]",
            format!("radar.waveform.stagger_us is not 0 throughout; a.cfg:{line}"),
        ),
    ] {
        let error = with(text).unwrap_err();
        assert!(error.contains(&told), "{text}: {error}");
    }
}

#[test]
fn antennas_on_the_package_are_no_board_s_and_another_platform_is_remarked_on() {
    let with = |platform: &str| format!("% Platform:{platform}\n{SDK}");
    for name in ["xWR18xx_AOP", "xWR68xxODS"] {
        let fault = settings(&with(name), Some(Board::Xwr1843)).unwrap_err();
        assert_eq!(fault.line, Some(1));
        assert!(
            fault.rule.contains(&format!("antennas of {name} are not those of the xwr1843")),
            "{fault:?}"
        );
        assert!(settings(&with(name), None).is_ok(), "without a board nothing is said of antennas");
    }
    let remarks = |platform: &str| settings(&with(platform), Some(Board::Xwr1843)).unwrap().remarks;
    assert_eq!(remarks("xWR18xx"), []);
    let [remark] = &remarks("xWR14xx")[..] else { panic!("no remark") };
    assert_eq!(
        (remark.line, remark.text.as_str()),
        (1, "its comment names the platform xWR14xx; the xwr1843 is taken")
    );
}

#[test]
fn recordings_of_another_layout_than_the_assumed_one_are_told() {
    let layout = |text: &str, board| settings(text, Some(board)).unwrap().unusual_layout();
    assert_eq!(layout(SDK, Board::Xwr1843), None);
    let swapped = SDK.replace("adcbufCfg -1 0 0 1 1", "adcbufCfg -1 0 1 1 1");
    assert_eq!(layout(&swapped, Board::Xwr1843), Some("Q before I"));
    assert_eq!(layout(SDK, Board::Xwr1443), Some("four lanes"));
    assert_eq!(layout(&swapped, Board::Xwr1443), Some("four lanes and Q before I"));
    assert!(scene_of(&swapped, Some(Board::Xwr1843)).contains("Import its recordings with --config a.cfg"));
}
