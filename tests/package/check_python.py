"""Tests the Python package of an installation or of an unpacked Debian package:
check_python.py PREFIX FOLDER INSTALLER BDPT SCENE VERSION.

PREFIX is where it was installed or unpacked, FOLDER and PYTHONPATH the folder of packages in it. INSTALLER is what its
metadata name. BDPT is the command whose images it must equal to the bit.
"""

import importlib.metadata
import pathlib
import subprocess
import sys
import tempfile

import bdpt
import numpy as np


def check_bits(command, scene):
    with tempfile.TemporaryDirectory() as folder:
        part = pathlib.Path(folder, "its.part.exr")
        words = ["--size", "24x16", "--spp", "2", "--integrator", "bdpt"]
        subprocess.run([command, "render", scene, *words, "--part", part, "--quiet"], check=True)
        its = bdpt.read_part(part)
        ours = bdpt.render(bdpt.load(scene), size=(24, 16), spp=2, integrator="bdpt")
        assert ours.image.any() and np.array_equal(ours.image, its.image), "not the bits of the command"


def main():
    prefix, folder, installer, command, scene, version = sys.argv[1:]
    package = pathlib.Path(bdpt.__file__).parent
    assert package == pathlib.Path(prefix, folder, "bdpt"), package
    loaded = pathlib.Path("/proc/self/maps").read_text(encoding="utf-8")
    libraries = {line.split()[-1] for line in loaded.splitlines() if "/libbdpt" in line}
    assert len(libraries) == 3 and all(name.startswith(prefix + "/lib/") for name in libraries), libraries
    assert bdpt.__version__ == version, bdpt.__version__
    known = importlib.metadata.distribution("bdpt")
    assert known.version == version and known.read_text("INSTALLER") == installer + "\n", known.version
    assert known.requires == ["numpy"] and known.metadata["Summary"].endswith("to images"), known.metadata
    for name in ("_bdpt.pyi", "py.typed"):
        assert (package / name).exists(), name
    check_bits(command, scene)


main()
