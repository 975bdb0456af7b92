#!/usr/bin/env python3
"""Tests that scenes/*.gltf equal the output of scenes/make_scenes.py to the byte, and that the README lists these
files: check_scenes.py ROOT."""

import pathlib
import re
import subprocess
import sys
import tempfile


def check(scenes):
    """Returns all findings, one line each."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, str(scenes / "make_scenes.py"), folder], check=True)
        made = {file.name: file.read_bytes() for file in pathlib.Path(folder).iterdir()}
    present = {file.name: file.read_bytes() for file in scenes.glob("*.gltf")}
    described = set(re.findall(r"^\| `([\w-]+\.gltf)` \|", (scenes / "README.md").read_text(encoding="utf-8"), re.M))
    errors = [f"{name}: make_scenes.py writes it, but it is missing" for name in sorted(made.keys() - present.keys())]
    errors += [f"{name}: make_scenes.py does not write it" for name in sorted(present.keys() - made.keys())]
    errors += [f"{name}: differs from what make_scenes.py writes" for name in sorted(made.keys() & present.keys())
               if made[name] != present[name]]
    errors += [f"{name}: only one of README.md and make_scenes.py knows it"
               for name in sorted(made.keys() ^ described)]
    return errors, len(made)


def main():
    errors, count = check(pathlib.Path(sys.argv[1]).resolve() / "scenes")
    print("\n".join(errors) or f"{count} scenes are up to date")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
