#!/usr/bin/env python3
"""Compares `bdpt compare` with other programs: compare_peers_test.py BDPT TOOL SCENE, where TOOL is numpy, flip or
idiff.

numpy needs the Python module of that name, flip the authors' flip-evaluator (which reads the files for both), idiff
OpenImageIO's program. Exits with 77 if the tool is not installed."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def skip(what):
    print(f"skipped: {what} is not installed")
    sys.exit(SKIPPED)


def compare(bdpt, image, reference, *options):
    """Returns the mean of each metric."""
    text = subprocess.run([bdpt, "compare", image, reference, "--json", *options], check=True, capture_output=True,
                          text=True).stdout
    report = json.loads(text)
    return {name: metric["mean"] for name, metric in report["metrics"].items()} | {
        "exposures": report["scale"]["flip_exposures"]}


def render(bdpt, scene, folder, samples, seed):
    file = str(folder / f"{samples}-{seed}.exr")
    subprocess.run([bdpt, "render", scene, "-o", file, "--size", "64x48", "--spp", str(samples), "--seed", str(seed),
                    "--quiet"], check=True)
    return file


def expect(name, ours, theirs, tolerance):
    print(f"{name}: ours {ours:.9g}, theirs {theirs:.9g}")
    if not abs(ours - theirs) <= tolerance * max(abs(theirs), 1e-3):
        sys.exit(f"{name} differs")


def check_numpy(bdpt, image, reference):
    try:
        import flip_evaluator  # reads EXR files, which numpy does not
        import numpy
    except ImportError as error:
        skip(error.name)
    x = flip_evaluator.load(image).astype(numpy.float64)
    r = flip_evaluator.load(reference).astype(numpy.float64)
    ours, d = compare(bdpt, image, reference), x - r
    mse = (d * d).mean()
    expect("relmse", ours["relmse"], (d * d / (r * r + 0.01)).mean(), 1e-9)
    expect("mse", ours["mse"], mse, 1e-9)
    expect("rmse", ours["rmse"], numpy.sqrt(mse), 1e-9)
    expect("mape", ours["mape"], (abs(d) / (abs(r) + 0.01)).mean(), 1e-9)
    expect("smape", ours["smape"], (abs(d) / (abs(x) + abs(r) + 0.01)).mean(), 1e-9)
    expect("psnr", ours["psnr"], 10 * numpy.log10(r.max() ** 2 / mse), 1e-9)


def check_flip(bdpt, image, reference):
    try:
        import flip_evaluator
    except ImportError as error:
        skip(error.name)
    for ppd in (67.0206432765823, 30.0):
        ours = compare(bdpt, image, reference, "--ppd", str(ppd), "--metrics", "flip")
        _, theirs, used = flip_evaluator.evaluate(reference, image, "HDR", applyMagma=False, parameters={"ppd": ppd})
        expect(f"flip at {ppd}", ours["flip"], theirs, 1e-4)
        expect("start exposure", ours["exposures"]["start"], used["startExposure"], 1e-4)
        expect("stop exposure", ours["exposures"]["stop"], used["stopExposure"], 1e-4)
        expect("exposures", ours["exposures"]["count"], used["numExposures"], 0)


def check_idiff(bdpt, image, reference):
    if not shutil.which("idiff") or not shutil.which("oiiotool"):
        skip("idiff or oiiotool")
    text = subprocess.run(["idiff", image, reference], capture_output=True, text=True).stdout
    rms, psnr = (float(re.search(rf"{name} = ([\d.e+-]+)", text)[1]) for name in ("RMS error", "Peak SNR"))
    ours = compare(bdpt, image, reference)
    expect("rmse", ours["rmse"], rms, 1e-5)
    # idiff takes the greatest value of both images as the peak, but at least 1.
    stats = "".join(subprocess.run(["oiiotool", "--stats", file], check=True, capture_output=True, text=True).stdout
                    for file in (image, reference))
    peak = max(1.0, *(float(value) for line in re.findall(r"Stats Max:(.*)\(", stats) for value in line.split()))
    expect("psnr", compare(bdpt, image, reference, "--peak", repr(peak))["psnr"], psnr, 1e-5)


def main():
    bdpt, tool, scene = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        image = render(bdpt, scene, folder, 4, 1)
        reference = render(bdpt, scene, folder, 64, 2)
        {"numpy": check_numpy, "flip": check_flip, "idiff": check_idiff}[tool](bdpt, image, reference)


if __name__ == "__main__":
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    main()
