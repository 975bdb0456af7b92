#!/usr/bin/env python3
"""Renders models and their twins, made by glTF Transform, and reports whether the images agree.

    twins.py COMMAND MODEL... [--converter PROGRAM] [--size WxH] [--spp N] [--noise FACTOR]
             [--kinds NAME,...] [--keep FOLDER]

COMMAND is bdpt. A twin encodes the same model differently: compressed meshes (draco, meshopt), integer vertices
(quantized), sparse accessors, lossless WebP textures (webp). The difference is mean FLIP. A converter may reorder
triangles and nodes, which changes the random numbers that each of them gets. Two renders of the model itself with
different seeds therefore measure the noise; a twin may differ by that, plus a little where vertices are rounded. The
exit code is 1 if a twin differs or is not rendered, 77 if the converter is not installed (`npm install
@gltf-transform/cli`).
"""

import argparse
import dataclasses
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

# For each kind: the converter's arguments, and the mean FLIP that rounding may add to the noise (rounding moves
# vertices by 1 / 2^14 of the model).
EXACT, MOVED = 0.001, 0.005
KINDS = {
    "draco": (["draco"], MOVED),
    "meshopt": (["meshopt"], MOVED),
    "quantized": (["quantize"], MOVED),
    "sparse": (["sparse"], EXACT),
    "webp": (["webp", "--lossless", "true"], EXACT),
}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--converter", default="gltf-transform")
    parser.add_argument("--size", default="96x72")
    parser.add_argument("--spp", default="32")
    parser.add_argument("--noise", type=float, default=1.2, help="times that of the model with another seed")
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--keep", type=pathlib.Path, help="write twins and images here")
    return parser.parse_args(words)


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=600, check=False)


def render(options, model, image, seed=0):
    """Renders a model; returns None, or the reason why there is no image."""
    done = run(options.command, "render", model, "-o", image, "--size", options.size, "--spp", options.spp, "--seed",
               seed, "--quiet")
    return None if done.returncode == 0 else done.stderr.strip()


def compare_images(command, image, reference):
    """Returns the mean FLIP between two images."""
    done = run(command, "compare", image, reference, "--json")
    if done.returncode != 0:
        sys.exit(done.stderr)
    return read_mean_flip(json.loads(done.stdout))


def read_mean_flip(report):
    return report["metrics"]["flip"]["mean"]


@dataclasses.dataclass
class Verdict:
    equal: bool
    text: str


def compare(options, twin, model, rounding, folder):
    """Compares the images of two models; they may differ by noise and by `rounding`. Writes the images to `folder`."""
    plain, other = (folder / f"{model.stem}-{seed}.exr" for seed in range(2))
    image = folder / f"{twin.stem}.exr"
    for what, where, seed in ((model, plain, 0), (model, other, 1), (twin, image, 0)):
        refusal = render(options, what, where, seed)
        if refusal:
            return Verdict(False, f"NOT RENDERED: {refusal}")
    tolerance = rounding + options.noise * compare_images(options.command, other, plain)
    found = compare_images(options.command, image, plain)
    equal = found <= tolerance
    return Verdict(equal, f"mean FLIP {found:.5f}, at most {tolerance:.5f}: {'equal' if equal else 'NOT EQUAL'}")


def check_kind(options, model, kind, folder):
    """Returns whether the twin of one kind equals the model. A twin that cannot be made counts as equal."""
    words, rounding = KINDS[kind]
    twin = folder / f"{model.stem}-{kind}.glb"
    made = run(options.converter, words[0], model, twin, *words[1:])
    if made.returncode != 0 or not twin.exists():
        print(f"  {kind}: the converter cannot: {(made.stderr or made.stdout).strip().splitlines()[-1:]}")
        return True
    verdict = compare(options, twin, model, rounding, folder)
    print(f"  {kind}: {verdict.text}", flush=True)
    return verdict.equal


def check_model(options, model, folder):
    print(model)
    # The list makes all() check every kind, even after a failure.
    return all([check_kind(options, model, kind, folder) for kind in options.kinds.split(",")])


def main():
    options = parse(sys.argv[1:])
    if not shutil.which(options.converter):
        print(f"{options.converter} is not there")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = options.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        results = [check_model(options, model, folder) for model in options.models]
    print(f"{sum(results)} of {len(results)} models are equal to all of their twins")
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
