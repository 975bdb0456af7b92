#!/usr/bin/env python3
"""Tests that the scripts which finish extracted roots (cmake/dist/hooks) touch no other root, such as the running system:
release_hooks_test.py SOURCE. Only folders of its own are given to them."""

import pathlib
import subprocess
import sys
import tempfile


def main():
    hooks = pathlib.Path(sys.argv[1]) / "cmake/dist/hooks"
    with tempfile.TemporaryDirectory() as folder:
        installed, empty = pathlib.Path(folder) / "installed", pathlib.Path(folder) / "empty"
        for root in (installed, empty):
            (root / "usr/share/man").mkdir(parents=True)
            (root / "etc").mkdir()
            (root / "etc/passwd").write_text("somebody", encoding="utf-8")
        (installed / "var/cache/apt/archives").mkdir(parents=True)
        (installed / "var/lib/dpkg").mkdir(parents=True)
        (installed / "var/lib/dpkg/status").write_text("Package: base-files\n", encoding="utf-8")
        for hook in ("finish_image.sh", "finish_sysroot.sh"):
            for words in ([installed], [empty], [installed, empty]):
                before = sorted(pathlib.Path(folder).rglob("*"))
                done = subprocess.run(["bash", hooks / hook, *words], capture_output=True, text=True, check=False)
                assert done.returncode == 1 and "not a root that mmdebstrap has just extracted" in done.stderr, (hook, words, done)
                assert sorted(pathlib.Path(folder).rglob("*")) == before, (hook, words)
                assert all((root / "etc/passwd").read_text(encoding="utf-8") == "somebody" for root in (installed, empty))


main()
