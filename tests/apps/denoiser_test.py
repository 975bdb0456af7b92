#!/usr/bin/env python3
"""bdpt render --denoise with Open Image Denoise itself: denoiser_test.py BDPT SCENES.

Takes the library from the environment variable BDPT_TEST_DENOISER, a file or its folder; exits with 77 where that is not
set. Renders few samples of scenes whose light comes by splats, by camera samples and by both, and compares errors.
"""

import json
import os
import subprocess
import sys
import tempfile

# A scene, how it is rendered, and how much of the error may be left. What light paths splat is as clean as the rest.
CASES = [
    ("lamp-box", ["--integrator", "bdpt"], 0.2),
    ("lamp-box", ["--integrator", "lt"], 0.2),
    ("cornell-box", ["--integrator", "mis"], 0.4),
    ("caustic-metal", ["--integrator", "bdpt"], 0.5),
]
SIZE = ["--size", "96x96", "--quiet"]


def main():
    bdpt, scenes = sys.argv[1:3]
    library = os.environ.get("BDPT_TEST_DENOISER")
    if not library:
        print("skipped: BDPT_TEST_DENOISER is not set")
        return 77
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        def error(image, reference):
            said = subprocess.run([bdpt, "compare", image, reference, "--json", "--metrics", "relmse"], check=True,
                                  capture_output=True, text=True).stdout
            return json.loads(said)["metrics"]["relmse"]["mean"]

        for scene, options, most in CASES:
            scene_file = os.path.join(scenes, scene + ".gltf")
            paths = {name: os.path.join(folder, name + ".exr") for name in ("reference", "noisy", "clean")}
            subprocess.run([bdpt, "render", scene_file, *SIZE, "--integrator", "bdpt", "--seed", "1", "--spp", "256", "-o",
                            paths["reference"]], check=True)
            subprocess.run([bdpt, "render", scene_file, *SIZE, *options, "--spp", "8", "-o", paths["noisy"]], check=True)
            subprocess.run([bdpt, "render", scene_file, *SIZE, *options, "--spp", "8", "-o", paths["clean"], "--denoise",
                            "--denoiser-library", library], check=True)
            noisy, clean = (error(paths[name], paths["reference"]) for name in ("noisy", "clean"))
            print(f"{scene} {' '.join(options)}: relmse {noisy:.4g}, denoised {clean:.4g}")
            if not clean < most * noisy:
                faults.append(f"{scene}: {clean} is not below {most} of {noisy}")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
