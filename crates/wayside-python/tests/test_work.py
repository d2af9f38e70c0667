"""Work beside the interpreter: progress, Ctrl-C, other threads."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from typing import Any

import numpy as np
import pytest
from conftest import small_scene

import wayside


def long_scene(frames: int = 400) -> dict[str, Any]:
    """A car for many frames: a minute and more."""
    car = {
        "kind": "mesh",
        "id": "car",
        "model": "car-suv",
        "position_m": [5.75, 40.0, 0.0],
        "velocity_mps": [0.0, -0.01, 0.0],
    }
    return small_scene(frames=frames, frame_interval_s=0.05, target=[car])


def test_progress_is_heard_and_its_exception_ends_the_work() -> None:
    heard: list[tuple[str, float]] = []

    def hears(text: str, share: float) -> None:
        heard.append((text, share))
        if len(heard) == 3:
            raise RuntimeError("enough")

    scene = wayside.Scene(long_scene())
    with pytest.raises(RuntimeError, match="enough"):
        scene.trace(progress=hears)
    assert len(heard) == 3
    assert all(text and 0 <= share <= 1 for text, share in heard)


def test_the_share_grows_within_a_frame_and_ends_at_one() -> None:
    scene = wayside.Scene(long_scene(frames=1))
    for work in (scene.trace, scene.echo, scene.detect):
        shares: list[float] = []
        work(progress=lambda text, share, shares=shares: shares.append(share))
        assert shares == sorted(shares)
        assert shares[-1] == 1
        assert any(0 < share < 1 for share in shares)


def many_frames() -> dict[str, Any]:
    """Frames with false alarms enough that each stage after the echo lasts for some looks at it."""
    radar = {"waveform": {"samples": 512, "chirps": 128}, "array": {"preset": "1x4"}}
    return small_scene(frames=60, radar=radar, dsp={"false_alarm_rate": 1e-3})


def raise_enough(text: str, share: float) -> None:
    raise RuntimeError(f"enough at {share}")


def is_at_rest_within(seconds: float) -> bool:
    """Whether the threads of this process have nothing to do any more."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        before = time.process_time()
        time.sleep(0.3)
        if time.process_time() - before < 0.05:
            return True
    return False


def test_a_table_that_was_called_off_begins_no_further_aspect() -> None:
    azimuths_deg = np.linspace(0, 360, 20_000, endpoint=False)
    with pytest.raises(RuntimeError, match="enough"):
        wayside.rcs("car-suv", 77.0, azimuths_deg, progress=raise_enough)
    # Aspects under way go on to their end; all of them take many minutes.
    assert is_at_rest_within(60.0)


def test_stages_of_a_receiver_tell_of_each_frame_and_can_be_called_off() -> None:
    cube = wayside.Scene(many_frames()).echo()
    maps = cube.range_doppler()
    for work in (cube.range_doppler, maps.detect):
        shares: list[float] = []
        work(progress=lambda text, share, shares=shares: shares.append(share))
        assert shares == sorted(shares)
        assert shares[-1] == 1
        assert any(0 < share < 1 for share in shares)
        with pytest.raises(RuntimeError, match=r"enough at 0\."):
            work(progress=raise_enough)


def test_the_following_of_objects_is_told_of_and_can_be_called_off() -> None:
    found = wayside.Scene(many_frames()).detect()
    shares: list[float] = []
    tracks = found.track(progress=lambda text, share: shares.append(share))
    assert (shares == sorted(shares), shares[-1], len(tracks)) == (True, 1, 60)
    with pytest.raises(RuntimeError, match="enough at "):
        found.track(progress=raise_enough)


def test_the_share_never_falls_from_one_stage_of_a_scene_to_the_next() -> None:
    scene = wayside.Scene(many_frames())
    for work in (scene.range_doppler, scene.detect, scene.track):
        shares: list[float] = []
        work(progress=lambda text, share, shares=shares: shares.append(share))
        assert shares == sorted(shares)
        assert (shares[-1], shares.count(1)) == (1, 1)


def test_other_threads_go_on_while_the_library_works() -> None:
    ticks: list[float] = []
    ended = threading.Event()

    def tick() -> None:
        while not ended.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    scene = wayside.Scene(long_scene(frames=2))
    ticker.start()
    begin = time.monotonic()
    scene.trace()
    took = time.monotonic() - begin
    ended.set()
    ticker.join()
    # Held back by the interpreter's lock there would be none.
    assert len(ticks) > 0.1 * took / 0.01


def test_progress_of_one_thread_is_of_its_own_work() -> None:
    noise = {"waveform": {"samples": 512, "chirps": 256}}
    scenes = {frames: wayside.Scene(small_scene(frames=frames, radar=noise)) for frames in (40, 37)}
    heard: dict[int, list[str]] = {40: [], 37: []}

    def echo(frames: int) -> None:
        scenes[frames].echo(progress=lambda text, share: heard[frames].append(text))

    threads = [threading.Thread(target=echo, args=(frames,)) for frames in scenes]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert any("of 40" in text for text in heard[40])
    assert any("of 37" in text for text in heard[37])
    assert not any("of 37" in text for text in heard[40])
    assert not any("of 40" in text for text in heard[37])


FORKED = """
import multiprocessing, sys, wayside
sys.path.insert(0, {tests!r})
from conftest import small_scene
def points(seed):
    return len(wayside.Scene(small_scene(seed=seed)).detect().points)
scene = wayside.Scene(small_scene())
if {worked!r}:
    scene.detect()
with multiprocessing.get_context("fork").Pool(1) as pool:
    print(pool.map(points, [1]))
"""


@pytest.mark.skipif(os.name != "posix", reason="fork of POSIX")
@pytest.mark.parametrize("worked", [False, True])
def test_a_process_forked_after_work_says_that_it_has_no_threads(worked: bool) -> None:
    script = FORKED.format(tests=os.path.dirname(__file__), worked=worked)
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    if worked:
        assert 'RuntimeError: this process was forked' in ended.stderr
        assert '"spawn" or "forkserver"' in ended.stderr
    else:
        assert ended.returncode == 0, ended.stderr


@pytest.mark.parametrize("threads", [-1, 0, 2**70])
def test_a_number_of_threads_that_is_none_is_refused(threads: int) -> None:
    with pytest.raises(ValueError, match=f"threads: it must be from 1 to 1024, is {threads}"):
        wayside.set_threads(threads)


SCRIPT = """
import sys, time, wayside
sys.path.insert(0, {tests!r})
from test_work import long_scene
scene = wayside.Scene(long_scene())
print("begun", flush=True)
try:
    scene.run({out!r})
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_run_at_once_and_leaves_nothing_half_written(tmp_path: Any) -> None:
    out = tmp_path / "out"
    script = SCRIPT.format(tests=os.path.dirname(__file__), out=str(out))
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.0)
    begin = time.monotonic()
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "interrupted\n"
    # A look each 50 ms and half a second for the frame under way; the rest is room for a busy machine.
    assert time.monotonic() - begin < 5.0
    child.wait(timeout=60)
    left = [p for p in out.rglob("*") if p.is_file() and p.name.endswith(".part")] if out.exists() else []
    assert left == []
