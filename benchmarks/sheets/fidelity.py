#!/usr/bin/env python3
"""Renders models in the views of a published renderer comparison, and puts the pictures side by side.

    fidelity.py BDPT OUTPUT [FOLDER] [--env FILE] [--spp N] [--width N] [--only NAME,...]

FOLDER (default: that of BDPT_TEST_ASSETS) has a folder for each model and `fidelity/MODEL/RENDERER.webp`, pictures of
the glTF Render Fidelity project of Khronos (https://github.com/KhronosGroup/glTF-Render-Fidelity). OUTPUT gets a sheet
MODEL.png for each model, with ours first, and ours.png with ours alone. The views are those of that project where it
states them; other models are shown from the front. Its light, an indoor studio, is not published: --env (default:
studio) gives a similar one, so compare relations within a picture, not numbers. Needs Pillow and NumPy.
"""

import argparse
import dataclasses
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import frames


@dataclasses.dataclass
class View:
    """A camera on an orbit around `target` [m], at `theta` and `phi` [degrees] and `radius` [m]. Theta 0 looks along
    -z, phi 90 is level. The vertical field of view is 45 degrees."""
    target: tuple = (0, 0, 0)
    theta: float = 0
    phi: float = 90
    radius: float = 1
    size: tuple = (768, 768)

    def words(self):
        theta, phi = math.radians(self.theta), math.radians(self.phi)
        way = (math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta))
        eye = [t + self.radius * w for t, w in zip(self.target, way)]
        point = lambda p: ",".join(f"{x:.9g}" for x in p)
        return ["--camera", "auto", f"--from={point(eye)}", f"--look-at={point(self.target)}", "--fov", "45"]


VIEWS = {
    "SheenCloth": View((0, 0.015, 0), radius=0.059, size=(1200, 768)),
    "CesiumMan": View((0, 0.75, 0), theta=90, radius=2),  # versions of the model differ in the direction that he faces
    "Duck": View((0, 0.86, 0), radius=2.7),
    "EnvironmentTest": View((0, 3.8, 0), radius=20, size=(1024, 768)),
    "AlphaBlendModeTest": View((0, 1.1, 0), radius=6, size=(1024, 512)),
    "TransmissionRoughnessTest": View((0, -0.09, 0), radius=1.1, size=(768, 300)),
    "AttenuationTest": View(radius=22, size=(1024, 768)),
    "SpecularTest": View((-0.18, 0, 0), radius=1.1, size=(768, 600)),
    "Box": View(theta=30, phi=60, radius=2.38),
    "AnimatedMorphCube": View(theta=30, phi=60, radius=4.75),
    "MultiUVTest": View(radius=4.25),
    "NormalTangentTest": View(radius=4.25),
    "SimpleSparseAccessor": View((3, 2, 0), radius=9),
    "InterpolationTest": View((0, 2.9, 0), radius=18.4),
    "TextureTransformTest": View(radius=4),
}
FRAMED = {"Fox": "left", "TwoSidedPlane": "0,25"}  # models without a known view are shown from the front


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path, nargs="?", default=os.environ.get("BDPT_TEST_ASSETS"))
    parser.add_argument("--env", default="studio")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--width", type=int, default=256, help="of a picture on a sheet [px]")
    parser.add_argument("--only", default="", help="models, with commas between them")
    options = parser.parse_args(words)
    if options.folder is None:
        parser.error("no FOLDER, and BDPT_TEST_ASSETS is not set")
    options.folder = pathlib.Path(options.folder)
    return options


def render(options, name, picture):
    """Renders our picture; returns whether that worked, and the messages."""
    folder = options.folder / name
    model = next(iter(sorted(folder.glob("*.glb")) + sorted(folder.glob("*.gltf"))), None)
    if model is None:
        return False, "no such model"
    view = VIEWS.get(name)
    width, height = view.size if view else (768, 768)
    size = f"{options.width}x{round(options.width * height / width)}"
    words = view.words() if view else ["--view", FRAMED.get(name, "front")]
    done = subprocess.run([str(word) for word in (
        options.command, "render", model, "-o", picture, "--size", size, "--spp", options.spp, "--env", options.env,
        "--background", "white", "--tone-map", "pbr-neutral", *words)],
        stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stderr


def main():
    options = parse(sys.argv[1:])
    options.output.mkdir(parents=True, exist_ok=True)
    ours = []
    for folder in sorted(path for path in (options.folder / "fidelity").iterdir() if path.is_dir()):
        name = folder.name
        if options.only and name not in options.only.split(","):
            continue
        with tempfile.TemporaryDirectory() as temporary:
            picture = pathlib.Path(temporary) / "ours.png"
            worked, said = render(options, name, picture)
            print(f"{name}: {'done' if worked else said.strip()}", flush=True)
            shape = VIEWS.get(name, View()).size
            size = (options.width, round(options.width * shape[1] / shape[0]))
            if worked:
                ours.append(frames.labelled(frames.opened(picture, size), [name]))
            row = [frames.labelled(frames.opened(picture if worked else None, size), [f"bdpt: {name}"])]
            row += [frames.labelled(frames.opened(other, size, (255, 255, 255)), [other.stem])
                    for other in sorted(folder.glob("*.webp"))]
            frames.grid(row, 6).save(options.output / f"{name}.png")
    if ours:
        frames.grid(ours, 7).save(options.output / "ours.png")


if __name__ == "__main__":
    main()
