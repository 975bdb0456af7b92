#!/usr/bin/env python3
"""Tests that scenes of strangers choose no code, connections or files: stranger_test.py BDPT SCENE. Needs no Blender."""

import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile

BDPT, SCENE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[2] / "apps/blender/bdpt_render/command.py"
SPEC = importlib.util.spec_from_file_location("command", SOURCE)
command = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(command)

SETTINGS = ["--size", "8x8", "--env-rotation", "-90", "--spp", "2", "--integrator", "pt"]
REFUSED = ("--denoise --denoiser-library {outside}", "--ktx-library={outside}", "--stats {outside}", "--display localhost:9",
           "--save-rates {outside}.exr", "--strategies {outside}.exr --integrator bdpt", "--part {outside}.exr", "--restart",
           "--output {other}.exr", "--save-job {outside}.json", "--plan {outside}", "--json", "-o {outside}.exr")


def render(folder, options):
    """Renders as the engine does; returns the exit code and the message."""
    job = folder / "job.json"
    try:
        command.write_job(job, SCENE, [*SETTINGS, *command.split_options(options)])
    except RuntimeError as error:
        return 2, str(error)
    words = [BDPT, "render", str(job), "-o", str(folder / "image.exr"), "--quiet"]
    done = subprocess.run(words, capture_output=True, check=False, text=True, timeout=60)
    return done.returncode, done.stderr


def main():
    with tempfile.TemporaryDirectory() as name:
        folder, outside = pathlib.Path(name) / "engine", pathlib.Path(name) / "outside"
        folder.mkdir()
        for options in REFUSED:
            code, message = render(folder, options.format(outside=outside, other="other"))
            written = sorted(file.name for file in pathlib.Path(name).rglob("*") if file.name not in ("engine", "job.json"))
            if options.startswith("--output"):  # the engine names the image
                assert code == 0 and written == ["image.exr"], (options, code, message, written)
                (folder / "image.exr").unlink()
                continue
            assert code in (2, 4) and message and "Traceback" not in message, (options, code, message)
            assert not written, (options, written)
        code, message = render(folder, "--seed 18446744073709551615 --clamp 1e3 --half --filter=tent --spp 3")
        assert code == 0, message
        data = (folder / "image.exr").read_bytes()
        for text in (b'"seed":18446744073709551615', b'"spp":3', b'"filter":"tent"', b'"clamp":1000'):
            assert text in data, text
        assert json.loads((folder / "job.json").read_text())["file"] == str(SCENE)
    print(f"{len(REFUSED)} options were refused")


if __name__ == "__main__":
    main()
