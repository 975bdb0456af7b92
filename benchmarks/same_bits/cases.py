"""Lists the renders that both programs make: each scene with each integrator, and options that cover every part of
light transport, on scenes where they matter."""

import dataclasses
import pathlib
import re

INTEGRATORS = ("bdpt", "mis", "pt", "nee", "lt")
LENS = ("--lens-radius", "0.05", "--focus-distance", "1")
# The lens is so wide, and so far inside the box, that light paths hit it.
WIDE_LENS = ("--lens-radius", "0.1", "--focus-distance", "0.5", "--from", "0.278,0.273,-0.1", "--look-at",
             "0.278,0.273,0.28", "--fov", "100")
# The point lies in the roughest sphere of glass-rough.gltf, below the lamp.
INSIDE_GLASS = ("--from", "1.05,0.29,0.3", "--look-at", "1.05,1.5,0.31", "--fov", "90")
LAYERS = "albedo,normal,depth,position,samples,variance,alpha"
ENVIRONMENT = "ENVIRONMENT"  # placeholder for the file that `write_environment` makes
FOLDER = "FOLDER"  # placeholder for the output folder of a program

ALL = ""
NO_LENS = "orthographic"  # cameras without a lens refuse lens options
MANY_LIGHTS = "night-market|veach-plates|fourteen|room-profiles|alpha"
VARIED = ("material-layers|veach-plates|cornell-spheres-hidden|glass-rough|door-ajar|shading-normals|nine-spheres|"
          "textured-emitter|room-sun|alpha")


@dataclasses.dataclass(frozen=True)
class Options:
    """Options for scenes whose name matches `scenes` and not `but`."""

    name: str
    words: tuple
    scenes: str = ALL
    but: str = "^$"
    integrators: tuple = ("bdpt",)

    def fit(self, scene):
        return re.search(self.scenes, scene) and not re.search(self.but, scene)


OPTIONS = (
    Options("as it is", (), integrators=INTEGRATORS),
    # Estimators and their weights
    Options("balance", ("--heuristic", "balance"), integrators=("bdpt", "mis")),
    Options("cutoff", ("--heuristic", "cutoff"), VARIED),
    Options("maximum", ("--heuristic", "maximum"), VARIED),
    Options("uniform", ("--heuristic", "uniform"), VARIED),
    Options("disable", ("--disable", "s0t2,s1t2,s2t1,s2t2")),
    Options("merging", ("--merge-radius", "0.02"), VARIED, integrators=("vcm",)),
    Options("two light paths", ("--light-paths", "2"), integrators=("bdpt", "lt")),
    # Lengths
    Options("direct", ("--only", "direct"), VARIED, integrators=("bdpt", "mis", "lt")),
    Options("indirect", ("--only", "indirect"), VARIED, integrators=("bdpt", "mis", "lt")),
    Options("three edges", ("--max-depth", "3"), VARIED, integrators=("bdpt", "mis")),
    Options("short camera paths", ("--max-camera-depth", "2"), VARIED, integrators=("bdpt", "lt")),
    Options("short light paths", ("--max-light-depth", "1"), VARIED),
    Options("early roulette", ("--rr-start", "1"), integrators=("bdpt", "mis")),
    # Random numbers
    Options("independent", ("--sampler", "independent"), integrators=("bdpt", "mis")),
    Options("seed", ("--seed", "12345678901"), VARIED),
    # Lights
    Options("light tree", ("--light-sampling", "tree"), integrators=("bdpt", "nee")),
    Options("lights by power", ("--light-sampling", "power"), MANY_LIGHTS, integrators=("bdpt", "mis")),
    Options("default sky", ("--env", "default"), integrators=("bdpt", "mis")),
    Options("environment", ("--env", ENVIRONMENT), VARIED + "|room-environment", integrators=INTEGRATORS),
    Options("plain environment", ("--env", ENVIRONMENT, "--env-sampling", "plain"), VARIED + "|room-environment",
            integrators=("bdpt", "mis", "lt")),
    # Cameras
    Options("lens", LENS, but=NO_LENS, integrators=("bdpt", "mis")),
    Options("wide lens", WIDE_LENS, "cornell", integrators=("bdpt", "lt")),
    Options("f-stop", ("--f-stop", "2"), "cornell-box|motion|room-point"),
    Options("framed", ("--camera", "auto"), VARIED),
    Options("inside glass", INSIDE_GLASS, "glass-rough", integrators=INTEGRATORS),
    Options("panning camera", ("--camera", "1", "--frame-time", "0.3", "--shutter", "0.2"), "motion",
            integrators=INTEGRATORS),
    Options("shutter", ("--frame-time", "0.6", "--shutter", "0.04"), "motion", integrators=INTEGRATORS),
    Options("frame", ("--frame-time", "0.45"), "motion", integrators=("bdpt", "mis")),
    Options("shutter and environment", ("--frame-time", "0.2", "--shutter", "-0.1,0.1", "--env", ENVIRONMENT), "motion",
            integrators=("bdpt", "mis")),
    # Film
    Options("gaussian", ("--filter", "gaussian:1.5"), integrators=("bdpt", "mis")),
    Options("tent", ("--filter", "tent"), VARIED),
    Options("blackman-harris", ("--filter", "blackman-harris"), VARIED),
    Options("crop", ("--crop", "3,2,13,9", "--filter", "gaussian:1"), VARIED, integrators=("bdpt", "mis", "lt")),
    Options("clamp", ("--clamp", "0.5"), VARIED, integrators=("bdpt", "mis")),
    Options("layers", ("--aov", LAYERS), integrators=("mis",)),
    Options("layers under a shutter", ("--aov", LAYERS, "--frame-time", "0.6", "--shutter", "0.3"), "motion"),
    Options("strategies", ("--strategies", FOLDER + "/strategies.exr", "--strategy-depth", "4"),
            integrators=("bdpt",)),
    Options("strategies of light tracing", ("--strategies", FOLDER + "/strategies.exr", "--strategy-depth", "4"), VARIED,
            integrators=("lt",)),
    Options("half", ("--half",), VARIED),
    Options("preview", ("-o", FOLDER + "/out.png"), VARIED),
    # Textures, clocks
    Options("mip", ("--texture-filter", "mip"), "textured-emitter|alpha|shading-normals|material|glass-rough|room",
            integrators=("bdpt", "mis")),
)


@dataclasses.dataclass(frozen=True)
class Case:
    scene: pathlib.Path
    integrator: str
    options: Options

    @property
    def name(self):
        return f"{self.scene.stem}, {self.integrator}, {self.options.name}"


def all_cases(scenes):
    """Returns the cases of the given scenes: first the plain renders, then those with options."""
    return [Case(scene, integrator, options) for options in OPTIONS for scene in scenes if options.fit(scene.stem)
            for integrator in options.integrators]


def quick_cases(cases):
    """Returns each plain scene by `bdpt` and `mis`; of all others, each option and integrator on one scene."""
    groups = {}
    for case in cases:
        groups.setdefault((case.options.name, case.integrator), []).append(case)
    kept = []
    for i, ((name, integrator), group) in enumerate(groups.items()):
        whole = name == OPTIONS[0].name and integrator in ("bdpt", "mis")
        kept += group if whole else [group[i % len(group)]]  # varies the scene
    return kept


def write_environment(file):
    """Writes a sky with a gradient and a small sun, as a Radiance file."""
    width, height = 16, 8
    pixels = bytearray()
    for y in range(height):
        for x in range(width):
            sun = (x, y) == (5, 2)
            pixels += bytes((255, 240, 200, 136) if sun else (100 + 10 * y, 120 + 4 * x, 250 - 20 * y, 128))
    file.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + bytes(pixels))
