#!/usr/bin/env python3
"""Writes the Cornell box with two scattering balls: make_media_scene.py FILE.gltf.

The left one has the index of refraction of air, so its boundary is invisible; the right one is milky glass."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scenes"))
from make_scenes import cornell_room
from shapes import sphere


def scattering(gltf, name, ior, color, distance, multiscatter, anisotropy):
    return gltf.material(name, (1, 1, 1), roughness=0, extensions={
        "transmission": {"transmissionFactor": 1}, "ior": {"ior": ior},
        "volume": {"thicknessFactor": 0.2, "attenuationColor": list(color), "attenuationDistance": distance},
        "volume_scatter": {"multiscatterColor": list(multiscatter), "scatterAnisotropy": anisotropy}})


def main():
    gltf, _ = cornell_room("scattering-balls", hidden=False)
    ball = gltf.shape(*sphere(64, 32, radius=0.1))
    for name, place, material in (
            ("cloud", (0.395, 0.14, 0.37), scattering(gltf, "cloud", 1, (0.5, 0.4, 0.3), 0.06, (0.7, 0.75, 0.8), 0.3)),
            ("milky glass", (0.165, 0.101, 0.2), scattering(gltf, "milky glass", 1.5, (0.6, 0.5, 0.3), 0.1,
                                                            (0.6, 0.5, 0.4), 0.0))):
        gltf.node(name, place, mesh=gltf.mesh(name, (ball, material)))
    pathlib.Path(sys.argv[1]).write_text(gltf.text(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
