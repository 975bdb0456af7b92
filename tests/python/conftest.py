"""Provides fixtures for the tests: the package, the command beside it, and a scene."""

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
    """Returns a function that runs bdpt and returns its output; skips the test if BDPT_COMMAND is not set."""
    program = os.environ.get("BDPT_COMMAND")
    if not program:
        pytest.skip("BDPT_COMMAND is not set")

    def run(*words):
        subprocess.run([program, *map(str, words)], check=True)

    return run
