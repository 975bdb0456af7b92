"""Tests run(): the command in Python, with its files, options and messages."""

import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import bdpt
import numpy as np
import pytest

SCENE = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "cornell-box.gltf"
SMALL = {"size": (24, 16), "integrator": "bdpt"}


def test_a_job_writes_the_files_of_the_command(command, tmp_path):
    ours, png, part, its = (tmp_path / name for name in ("ours.exr", "ours.png", "ours.part.exr", "its.part.exr"))
    [image] = bdpt.run(SCENE, output=[ours, png], part=part, spp=3, aov=["albedo", "depth"], **SMALL)
    assert image.files == [ours, png, part] and all(file.stat().st_size for file in image.files)
    assert image.spp == 3 and image.seconds > 0 and image.noise > 0 and math.isfinite(image.exposure)
    assert not image.stopped and image.frame is None and image.camera is None and "ours.png" in repr(image)
    command("render", SCENE, "--size", "24x16", "--integrator", "bdpt", "--spp", "3", "--aov", "albedo,depth", "--part", its, "-q")
    one, other = bdpt.read_part(part), bdpt.read_part(its)
    assert np.array_equal(one.image, other.image) and one.image.any()
    assert len(one.layers) >= 2 and all(np.array_equal(one.layers[name], other.layers[name]) for name in other.layers)


def test_values_are_those_of_python_and_numpy(tmp_path):
    def stats(**options):
        bdpt.run(SCENE, output=tmp_path / "a.png", stats=tmp_path / "a.json", **{"spp": 1, **SMALL, **options})
        return json.loads((tmp_path / "a.json").read_text())["settings"]

    large = stats(seed=2**64 - 1, clamp=np.float32(2.5), size=np.array([8, 4]), spp=np.int64(2), from_=(0, 0.3, 1), max_depth=None)
    assert large["seed"] == 2**64 - 1 and large["clamp"] == 2.5 and large["spp"] == 2
    assert "clamp" not in stats(clamp=math.inf)


def test_a_job_file_is_overridden_by_options(tmp_path):
    file = tmp_path / "a.json"
    file.write_text(json.dumps({"bdpt_job": 1, "file": str(SCENE), "output": ["in-folder.exr"], "spp": 2, "size": "8x8",
                                "denoise": True}))
    [image] = bdpt.run(file, denoise=False)
    assert image.files == [tmp_path / "in-folder.exr"] and image.spp == 2
    [image] = bdpt.run(file, denoise=False, spp=3, output=str(tmp_path / "other.png"))
    assert image.files == [tmp_path / "other.png"] and image.spp == 3


def test_progress_and_messages_are_told(tmp_path, capfd):
    seen, told = [], []
    images = bdpt.run(SCENE, output=tmp_path / "a.#.exr", orbit=2, spp=16, env="none", progress=seen.append,
                      message=lambda kind, text: told.append((kind, text)), **SMALL)
    assert [image.frame for image in images] == [1, 2]
    assert {now.image for now in seen} == {0, 1} and {now.images for now in seen} == {2}
    assert seen[-1].fraction == 1 and seen[-1].spp == 16 and seen[-1].seconds > 0 and seen[-1].seconds_left == 0
    assert {kind for kind, _ in told} <= {"note", "warning"} and any("a.2.exr" in text for _, text in told)
    captured = capfd.readouterr()
    assert captured.out == "" and captured.err == ""


def test_what_a_callback_raises_ends_the_job(tmp_path):
    def fail(*_):
        raise ValueError("enough")

    for callback in ({"progress": fail}, {"message": fail}):
        with pytest.raises(ValueError, match="enough"):
            bdpt.run(SCENE, output=tmp_path / "a.exr", spp=4, **SMALL, **callback)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("options, code, text", [
    ({"sppp": 3}, 2, r"run\(\) got an unexpected keyword argument 'sppp'; did you mean 'spp'\?"), ({"spp": 0}, 4, "spp=0: expected a whole number"),
    ({"noise": "2%", "samples": "0:1"}, 2, "^noise cannot be combined with samples"), ({"output": "-"}, 2, "standard"),
    ({"integrator": "ptt"}, 4, "integrator='ptt': expected pt, nee"), ({"display": "localhost"}, 2, "unexpected keyword argument 'display'"),
    ({"width": 320}, 2, "'width'; did you mean 'size'"), ({"output": ["a.xyz"]}, 2, "a.xyz")])
def test_wrong_options_are_errors(options, code, text):
    with pytest.raises(bdpt.Error, match=text) as raised:
        bdpt.run(SCENE, **options)
    assert raised.value.code == code
    with pytest.raises(bdpt.Error, match="'stats': it is an option of run"):
        bdpt.render(bdpt.load(SCENE), stats="a.json")


def test_other_threads_run_while_a_job_does(tmp_path):
    """Only another thread can end this job before its time is over."""

    def interrupt():
        for _ in range(200):
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    with pytest.raises(KeyboardInterrupt):
        thread.start()
        bdpt.run(SCENE, output=tmp_path / "a.exr", spp=10**9, time="60s", **SMALL)
    thread.join()


@pytest.mark.parametrize("callback", ["progress", "message"])
def test_an_interrupt_within_a_callback_writes_what_is_there(tmp_path, callback):
    def interrupt(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bdpt.run(SCENE, output=tmp_path / "a.exr", spp=10**9, **SMALL, **{callback: interrupt})
    assert (tmp_path / "a.exr").stat().st_size > 0


def test_control_c_stops_a_job_and_writes_what_is_there(tmp_path):
    program = ("import bdpt, sys\n"
               "def progress(now): print(now.spp, flush=True)\n"
               "try: bdpt.run(sys.argv[1], output=sys.argv[2], spp=10**9, size=(24, 16), progress=progress)\n"
               "except KeyboardInterrupt: print('interrupted', flush=True)\n")
    process = subprocess.Popen([sys.executable, "-c", program, str(SCENE), str(tmp_path / "out.exr")], text=True,
                               stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(pathlib.Path(bdpt.__file__).parents[1])})
    try:
        assert int(process.stdout.readline()) > 0
        process.send_signal(signal.SIGINT)
        lines = process.communicate(timeout=60)[0].splitlines()
    finally:
        process.kill()
    assert lines[-1] == "interrupted" and process.returncode == 0
    assert (tmp_path / "out.exr").stat().st_size > 0
