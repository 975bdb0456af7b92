"""What the tests share: the package, the command beside it, and a scene."""

import os
import pathlib
import subprocess

import pytest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


@pytest.fixture(scope="session")
def cornell_box():
    import bdpt
    return bdpt.load(SCENES / "cornell-box.gltf")


@pytest.fixture
def command(tmp_path):
    """Runs bdpt and gives what it wrote; skips where BDPT_COMMAND does not say which bdpt."""
    program = os.environ.get("BDPT_COMMAND")
    if not program:
        pytest.skip("BDPT_COMMAND is not set")

    def run(*words):
        subprocess.run([program, *map(str, words)], check=True)

    return run
