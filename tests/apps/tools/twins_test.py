#!/usr/bin/env python3
"""Tests that scenes and their twins, which a converter has encoded differently, give the same image:
twins_test.py COMMAND ROOT.

Then tests that scenes that differ are found to differ.
"""

import argparse
import pathlib
import sys
import tempfile

COMMAND, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(ROOT / "benchmarks" / "assets"))

import twins  # noqa: E402

DATA = ROOT / "tests" / "data" / "twins"
# Each row has the twin, its original, and the mean FLIP that rounding may cause.
PAIRS = [
    (DATA / "instances-quantized.glb", ROOT / "scenes" / "instances.gltf", twins.MOVED),
    (DATA / "textured-emitter-webp.glb", ROOT / "scenes" / "textured-emitter.gltf", twins.EXACT),
    (DATA / "bump-sparse.glb", DATA / "bump.glb", twins.EXACT),
]
OTHERS = [
    (ROOT / "scenes" / "cornell-box.gltf", ROOT / "scenes" / "cornell-box-hidden.gltf", twins.MOVED),
    (ROOT / "tests" / "data" / "compressed" / "wave.glb", DATA / "bump.glb", twins.MOVED),
]


def main():
    failures = []
    with tempfile.TemporaryDirectory() as name:
        for pairs, expected in ((PAIRS, True), (OTHERS, False)):
            for twin, model, rounding in pairs:
                # Lossless encodings that keep the order use the same random numbers.
                options = argparse.Namespace(command=COMMAND, size="48x36", spp="8",
                                             noise=0 if rounding == twins.EXACT else 1.2)
                verdict = twins.compare(options, twin, model, rounding, pathlib.Path(name))
                print(f"{twin.name} and {model.name}: {verdict.text}")
                if verdict.equal != expected:
                    failures.append(twin.name)
    sys.exit(f"wrong verdicts: {', '.join(failures)}" if failures else 0)


if __name__ == "__main__":
    main()
