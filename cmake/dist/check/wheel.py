"""Tries the wheel in /packages, in the environment of this interpreter, where there is no compiler:
wheel.py VERSION [RUN]. An emulated interpreter cannot start programs for its processor: RUN starts the command, and the
reader of volumes is not tried."""

import pathlib
import shutil
import subprocess
import sys
import urllib.request

PREFIX = pathlib.Path(sys.prefix)
BOX, SMOKE = "/scenes/cornell-box.gltf", "/scenes/smoke.vdb"


def pip(*words):
    subprocess.run([sys.executable, "-m", "pip", "--disable-pip-version-check", *words], check=True)


def files():
    return {str(file.relative_to(PREFIX)) for file in PREFIX.rglob("*") if "__pycache__" not in file.parts}


USE = f"""
import sys, bdpt, numpy as np
assert bdpt.__version__ == sys.argv[1], bdpt.__version__
render = bdpt.render(bdpt.load({BOX!r}), size=(48, 32), spp=4)
assert render.image.shape == (32, 48, 3) and render.image.mean() > 0.01
render.save("/out/wheel.png")
if len(sys.argv) == 2:
    assert bdpt.render(bdpt.load({BOX!r}, volume={SMOKE!r}), size=(24, 24), spp=1).image.any()
views = list(bdpt.dataset({BOX!r}, views=2, spp=1, size=32))
assert len(views) == 2, views
"""


def view(command):
    """Starts a view, and gets its page."""
    with subprocess.Popen([*command, "view", BOX, "--size", "32x32"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True) as shown:
        for line in shown.stdout:
            address = next((word for word in line.split() if word.startswith("http://")), None)
            if address:
                break
        with urllib.request.urlopen(address, timeout=20) as page:
            assert b"<html" in page.read().lower()
        shown.terminate()


def main():
    version = sys.argv[1]
    for compiler in ("cc", "c++", "g++", "clang"):
        assert not shutil.which(compiler), compiler
    pip("install", "-q", "--no-index", "--find-links", "/packages", "numpy")
    before = files()
    pip("install", "-q", "--no-index", "--find-links", "/packages", "bdpt")
    subprocess.run([sys.executable, "-c", USE, *sys.argv[1:]], check=True)
    command = [PREFIX / "bin/bdpt"]
    if sys.argv[2:]:
        command = [sys.argv[2], *PREFIX.glob("lib/*/site-packages/bdpt/bdpt")]
    said = subprocess.run([*command, "--version"], check=True, capture_output=True, text=True).stdout
    assert said.startswith(f"bdpt {version}\n"), said
    view(command)
    pip("uninstall", "-q", "-y", "bdpt")
    assert files() == before, files() ^ before


main()
