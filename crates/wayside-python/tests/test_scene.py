"""A scene from a path or a dictionary, and what is refused."""

from __future__ import annotations

import importlib.metadata
from pathlib import Path

import numpy as np
import pytest
from conftest import PROJECT, small_scene

import wayside


def test_a_dictionary_and_the_file_of_its_text_are_one_scene(tmp_path: Path) -> None:
    of_dictionary = wayside.Scene(small_scene(seed=7))
    file = tmp_path / "scene.toml"
    file.write_text(of_dictionary.toml)
    of_file = wayside.Scene(file)
    assert (of_file.name, of_file.seed, of_file.frames, of_file.targets) == (
        "reflectors",
        7,
        2,
        ["near", "far"],
    )
    assert np.array_equal(of_file.echo().samples, of_dictionary.echo().samples)


def test_a_file_is_refused_with_file_line_place_and_rule(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text('name = "a"\nframes = 0\n[radar]\npositon_m = [0, 0, 6]\n')
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.Scene(file)
    error = refused.value
    assert [fault["line"] for fault in error.faults] == [2, 4]
    fault = error.faults[1]
    assert (fault["file"], fault["column"], fault["place"]) == (str(file), 1, "[radar]")
    assert fault["rule"] == "unknown key `positon_m`; the nearest is `position_m`"
    assert str(error).endswith(f"{file}:4:1: [radar]: {fault['rule']}")
    assert error.kind == "refused"


def test_a_dictionary_is_refused_with_the_same_rule_and_without_a_file() -> None:
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.Scene({"name": "a", "radar": {"positon_m": [0, 0, 6]}})
    error = refused.value
    assert (error.file, error.line, error.place) == (None, None, "[radar]")
    assert str(error) == "[radar]: unknown key `positon_m`; the nearest is `position_m`"


def test_a_file_that_is_missing_is_the_systems_fault() -> None:
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.Scene("no-such-scene.toml")
    assert refused.value.kind == "system"
    assert refused.value.file == "no-such-scene.toml"


def test_a_path_that_was_given_to_a_run_is_the_file_of_its_failure(tmp_path: Path) -> None:
    plain, missing = tmp_path / "plain", tmp_path / "none.model"
    plain.write_text("mine")
    scene = wayside.Scene(small_scene())
    for out, options, file in (
        (plain, {}, plain),
        (tmp_path / "out", {"classifier": missing}, missing),
        (tmp_path / "out", {"cache": plain}, plain),
    ):
        with pytest.raises(wayside.WaysideError) as refused:
            scene.run(out, **options)
        assert refused.value.file == str(file), str(refused.value)
    assert plain.read_text() == "mine"


def test_a_file_that_a_dictionary_names_is_missing_and_no_file_of_ours_is_told() -> None:
    target = {"kind": "mesh", "id": "x", "model": "nope.glb", "position_m": [0.0, 30.0, 0.0]}
    with pytest.raises(wayside.WaysideError) as refused:
        wayside.Scene(small_scene(target=[target]))
    error = refused.value
    assert (error.kind, error.file, error.place) == ("system", None, "target `x`")
    assert str(error).startswith("target `x`: ")
    assert "scene.toml" not in str(error)


def test_an_accuracy_above_the_echo_is_refused() -> None:
    with pytest.raises(ValueError, match="accuracy_db: from -120 to below 0, is 5"):
        wayside.Scene(small_scene(), accuracy_db=5)


def test_a_value_that_toml_does_not_have_is_refused_with_its_key() -> None:
    with pytest.raises(TypeError, match=r"radar\.position_m: a scene holds no NoneType"):
        wayside.Scene({"name": "a", "radar": {"position_m": None}})


def test_arrays_of_numpy_are_values_of_a_scene() -> None:
    scene = small_scene()
    scene["radar"]["position_m"] = np.array([0.0, 0.0, 5.0])
    scene["frames"] = np.int64(3)
    assert wayside.Scene(scene).frames == 3


def test_files_of_a_dictionary_are_seen_from_its_folder(tmp_path: Path) -> None:
    (tmp_path / "sign.obj").write_text("v 0 0 1\nv 0 1 1\nv 0 1 2\nv 0 0 2\nf 1 2 3 4\n")
    target = {"kind": "mesh", "id": "sign", "model": "sign.obj", "position_m": [0.0, 20.0, 0.0]}
    scene = small_scene(target=[target])
    assert wayside.Scene(scene, folder=tmp_path).targets == ["sign"]
    with pytest.raises(wayside.WaysideError, match="sign.obj"):
        wayside.Scene(scene, folder=tmp_path / "elsewhere")
    own = small_scene(target=[target | {"model": "car-suv"}])
    assert wayside.Scene(own, folder=tmp_path).targets == ["sign"]


SIGN = "v 0 0 1\nv 0 1 1\nv 0 1 2\nv 0 0 2\nf 1 2 3 4\n"


def test_files_beside_a_dictionary_are_no_own_vehicles(tmp_path: Path) -> None:
    (tmp_path / "car-suv").mkdir()
    target = {"kind": "mesh", "id": "car", "model": "car-suv", "position_m": [0.0, 20.0, 0.0]}
    assert wayside.Scene(small_scene(target=[target]), folder=tmp_path).targets == ["car"]


FCD = """<fcd-export>
<timestep time="0.00"><vehicle id="a" x="3.0" y="40.0" angle="180" type="sign" speed="8"/></timestep>
<timestep time="0.10"><vehicle id="a" x="3.0" y="39.2" angle="180" type="sign" speed="8"/></timestep>
<timestep time="0.20"><vehicle id="a" x="3.0" y="38.4" angle="180" type="sign" speed="8"/></timestep>
</fcd-export>
"""


@pytest.mark.parametrize("models", ["sign.obj", ["sign.obj"], {"model": ["sign.obj"]}, {"model": "sign.obj"}])
def test_models_of_traffic_are_seen_from_the_dictionarys_folder(models: object, tmp_path: Path) -> None:
    (tmp_path / "sign.obj").write_text(SIGN)
    (tmp_path / "fcd.xml").write_text(FCD)
    traffic = {"fcd": "fcd.xml", "models": {"sign": models}}
    scene = small_scene(target=[], traffic=traffic)
    assert len(wayside.Scene(scene, folder=tmp_path).trace()[0]) > 0
    with pytest.raises(wayside.WaysideError, match=r"elsewhere/sign\.obj"):
        wayside.Scene(scene, folder=tmp_path / "elsewhere")


def test_a_name_that_is_no_unicode_is_refused_with_its_key() -> None:
    target = {"kind": "mesh", "id": "x", "model": "caf\udce9.obj", "position_m": [0.0, 30.0, 0.0]}
    with pytest.raises(ValueError, match=r"target\.model: a scene holds Unicode"):
        wayside.Scene(small_scene(target=[target]))


@pytest.mark.parametrize("seed", [-1, 2**63, 2**80])
def test_a_seed_beyond_the_whole_numbers_of_toml_is_refused(seed: int) -> None:
    with pytest.raises(ValueError, match=f"seed: it must be from 0 to 9223372036854775807, is {seed}"):
        wayside.Scene(small_scene(), seed=seed)
    with pytest.raises(wayside.WaysideError, match="`seed` must be a"):
        wayside.Scene(small_scene(seed=seed))


def written(file: Path, **changes: object) -> Path:
    file.write_text(wayside.Scene(small_scene(**changes)).toml)
    return file


def test_a_scene_that_has_changed_since_is_not_run(tmp_path: Path) -> None:
    scene = wayside.Scene(written(tmp_path / "scene.toml", seed=1))
    text = scene.toml
    written(tmp_path / "scene.toml", seed=99, frames=3)
    assert (scene.toml, scene.seed, scene.radars) == (text, 1, [])
    with pytest.raises(wayside.WaysideError, match=r"scene\.toml: it has changed since the scene was read"):
        scene.run(tmp_path / "out")
    assert not (tmp_path / "out").exists()
    written(tmp_path / "scene.toml", seed=1)
    assert scene.run(tmp_path / "out")["seed"] == 1


def test_a_model_that_has_changed_since_is_not_run(tmp_path: Path) -> None:
    (tmp_path / "sign.obj").write_text(SIGN)
    target = {"kind": "mesh", "id": "sign", "model": "sign.obj", "position_m": [0.0, 20.0, 0.0]}
    scene = wayside.Scene(small_scene(target=[target]), folder=tmp_path)
    (tmp_path / "sign.obj").write_text(SIGN.replace("2", "3", 1))
    with pytest.raises(wayside.WaysideError, match=r"sign\.obj: it has changed since the scene was read"):
        scene.run(tmp_path / "out")
    (tmp_path / "sign.obj").unlink()
    with pytest.raises(wayside.WaysideError, match=r"^target `sign`: ") as refused:
        scene.run(tmp_path / "out")
    assert refused.value.place == "target `sign`"


def test_a_relative_name_is_seen_from_where_the_scene_was_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written(tmp_path / "scene.toml", frames=1)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path)
    scene = wayside.Scene("scene.toml")
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert scene.run("out")["frames"]
    assert (tmp_path / "elsewhere/out/summary.json").exists()


def test_what_a_run_will_take_is_told_before_anything_runs(scene: wayside.Scene) -> None:
    cost = scene.cost()
    assert cost["frames"] == 2
    assert 0 < cost["processor_from_s"] < cost["processor_s"] < cost["processor_to_s"]
    assert 0 < cost["expected_memory_mib"] <= cost["memory_mib"]
    assert cost["threads"] >= 1


def test_the_radar_is_told_in_the_words_of_the_summary(scene: wayside.Scene) -> None:
    radar = scene.radar
    assert radar["samples_per_chirp"] == 64
    assert radar["channels"] == 4
    # c / 2B with B = 12.5 MHz/µs · 64 / 5.12 MHz.
    assert radar["range_resolution_m"] == pytest.approx(299_792_458 / (2 * 12.5e12 * 64 / 5.12e6), rel=1e-12)


def test_a_scene_of_several_radars_asks_which_one() -> None:
    file = PROJECT / "scenes/four-directions.toml"
    several = wayside.Scene(file)
    assert len(several.radars) == 4
    with pytest.raises(wayside.WaysideError):
        several.frames  # noqa: B018


def test_the_package_holds_the_licences_of_the_project() -> None:
    files = importlib.metadata.files("wayside") or []
    for name in ("LICENSE-APACHE", "LICENSE-MIT"):
        of_package = [file.locate() for file in files if file.parts[-2:] == ("licenses", name)]
        assert [Path(str(file)).read_bytes() for file in of_package] == [(PROJECT / name).read_bytes()]
