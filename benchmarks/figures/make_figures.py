#!/usr/bin/env python3
"""Renders figures: for each a sheet of labelled images and their measurements.

make_figures.py --list
make_figures.py NAME... -o DIR [--scale quick|medium|full] [--bdpt PATH]    (or all for NAME)

Writes DIR/NAME.png, NAME.json and NAME.csv, and the images as DIR/NAME/NN.exr. Needs oiiotool."""

import argparse
import csv
import dataclasses
import json
import pathlib
import shlex
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
import sheet
from figures import FIGURES

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE_SEED = 1000  # differs from the seeds of all cells: errors of equal random numbers would cancel


@dataclasses.dataclass(frozen=True)
class Scale:
    """Limits the size of images and the samples of cells."""

    width: int
    most_spp: int
    most_reference_spp: int
    most_seconds: float


SCALES = {"quick": Scale(52, 64, 256, 0.3), "medium": Scale(128, 1024, 512, 4.0),
          "full": Scale(256, 1 << 20, 1 << 20, 1e9)}


def aspect_ratio(scene):
    """Returns the aspect ratio of the first camera of the file."""
    cameras = json.loads((ROOT / "scenes" / scene).read_text(encoding="utf-8"))["cameras"]
    return cameras[0]["perspective"]["aspectRatio"]


def compute_size(scene, scale):
    return scale.width, round(scale.width / aspect_ratio(scene))


def scaled(figure, scale):
    """Returns the figure's cells within the limits of the scale, and the number of columns. Drops cells that the limits
    make equal to the one before."""
    cells = []
    for cell in figure.cells:
        small = dataclasses.replace(cell, spp=cell.spp and min(cell.spp, scale.most_spp),
                                    seconds=cell.seconds and min(cell.seconds, scale.most_seconds))
        if cell.spp != small.spp:
            small = dataclasses.replace(small, label=cell.label.replace(f"{cell.spp} spp", f"{small.spp} spp"))
        if cell.seconds != small.seconds:
            small = dataclasses.replace(small, label=cell.label.replace(f"{cell.seconds:g} s", f"{small.seconds:g} s"))
        if small == cell or small not in cells:
            cells.append(small)
    rows = len(figure.cells) // figure.columns
    return cells, len(cells) // rows if len(cells) % rows == 0 else figure.columns


class Renderer:
    """Runs bdpt. Renders each reference once for all figures."""

    def __init__(self, bdpt, scale, folder):
        self.bdpt, self.scale, self.folder, self.references = bdpt, scale, folder, {}

    def render(self, scene, options, limits, output, extra=()):
        """Renders a scene; returns the command line and its statistics."""
        width, height = compute_size(scene, self.scale)
        stats = output.with_suffix(".stats.json")
        command = [self.bdpt, "render", str(ROOT / "scenes" / scene), "--integrator", "bdpt", *options, "--size", f"{width}x{height}",
                   *limits, "-o", str(output), "--stats", str(stats), "--json", *extra]
        lines = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
        done = next(event for event in map(json.loads, lines) if event["event"] == "done")
        told = json.loads(stats.read_text(encoding="utf-8"))
        stats.unlink()
        row = {"samples": done["samples"], "seconds": done["seconds"], "exposure": done["exposure"],
               "rays": told["rays"], "command": shlex.join(["bdpt", *command[1:]])}
        return row

    def reference(self, cell, spp, folder):
        """Returns file and report of a cell's reference; None if it has none."""
        if cell.reference is None:
            return None
        spp = min(spp, self.scale.most_reference_spp)
        key = cell.scene, cell.reference, spp
        if key not in self.references:
            name = f"{pathlib.Path(cell.scene).stem}-{len(self.references):02}"
            file, preview = folder / f"{name}.exr", folder / f"{name}.png"  # the preview has automatic exposure
            limits = ("--spp", str(spp), "--seed", str(REFERENCE_SEED))
            self.references[key] = file, self.render(cell.scene, cell.reference, limits, file, ("-o", str(preview)))
        return self.references[key]

    def cell(self, cell, output):
        """Renders a cell; returns its measurements."""
        if cell.rival is None:
            limits = ("--spp", str(cell.spp)) if cell.spp else ("--time", f"{cell.seconds}s")
            return self.render(cell.scene, cell.options, limits, output)
        rounds = min(cell.rounds, cell.spp)
        pairs, reports = [], []
        for seed in range(rounds):
            limits = ("--spp", str(cell.spp // rounds), "--seed", str(seed))
            pair = [output.with_suffix(f".{seed}{letter}.exr") for letter in "ab"]
            reports += [self.render(cell.scene, options, limits, file)
                        for options, file in zip((cell.options, cell.rival), pair)]
            pairs.append(pair)
        sheet.mean_of_maxima(pairs, output)
        for file in sum(pairs, []):
            file.unlink()
        total = {kind: sum(report["rays"][kind] for report in reports) for kind in ("camera", "light", "shadow")}
        return {"samples": rounds * (cell.spp // rounds), "seconds": sum(report["seconds"] for report in reports),
                "rays": total, "command": "; ".join(report["command"] for report in reports)}

    def compare(self, image, reference, metric):
        """Returns error and bias of an image. The error includes the noise of the reference."""
        done = subprocess.run([self.bdpt, "compare", str(image), str(reference), "--relative", "--json", "--metrics",
                               f"relmse,{metric}" if metric != "relmse" else metric], check=True, stdout=subprocess.PIPE, text=True)
        report = json.loads(done.stdout)
        bias = report["bias"]["mean"]
        errors = {name: figures["mean"] for name, figures in report["metrics"].items()}
        return {**errors, "bias": bias["value"], "bias_standard_error": bias["standard_error"]}


def write_numbers(name, figure, scale_name, rows, folder):
    document = {"figure": name, "title": figure.title, "scale": scale_name, "cells": rows}
    (folder / f"{name}.json").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    keys = ["label", "scene", "samples", "seconds", "mean", "relmse", "bias", "bias_standard_error", "camera_rays",
            "light_rays", "shadow_rays"]
    keys += ["flip"] if any("flip" in row for row in rows) else []
    with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(keys)
        for row in rows:
            flat = dict(row, mean=sum(row["mean"]) / 3, **{f"{kind}_rays": row["rays"][kind]
                                                            for kind in ("camera", "light", "shadow")})
            writer.writerow([flat.get(key, "") for key in keys])


def captions(row):
    """Returns the lines of text below the label."""
    error = f"FLIP {row['flip']:.3g}, " if "flip" in row else f"relMSE {row['relmse']:.3g}, " if "relmse" in row else ""
    return [f"{error}{row['samples']} spp, {row['seconds']:.2g} s"]


def make(name, renderer, scale_name, folder):
    """Renders all cells of a figure and writes its files."""
    figure = FIGURES[name]
    cells, columns = scaled(figure, renderer.scale)
    images = folder / name
    images.mkdir(parents=True, exist_ok=True)
    references = folder / "references"
    references.mkdir(exist_ok=True)
    rows, exposures, brightest = [], {}, 0.0
    for number, cell in enumerate(cells):
        image = images / f"{number:02}.exr"
        row = {"label": cell.label, "scene": cell.scene, **renderer.cell(cell, image)}
        row["mean"] = sheet.mean(image)
        if cell.layer:
            brightest = max(brightest, cell.layer_scale * sheet.mean(image, cell.layer)[0])
        reference = renderer.reference(cell, figure.reference_spp, references)
        if reference:
            file, report = reference
            exposures[cell.scene] = report["exposure"]  # the last one applies to all images of the scene
            row.update(renderer.compare(image, file, cell.metric))
            row["reference"] = report["command"]
        row.pop("exposure", None)
        rows.append(row)
        print(f"{name} {number + 1}/{len(cells)}: {cell.label}: {', '.join(captions(row))}", flush=True)
    shown = []
    for number, (cell, row) in enumerate(zip(cells, rows)):
        shown.append(images / f"{number:02}.png")
        if cell.layer:
            look = sheet.false_colours(cell.layer, brightest)
            lines = [cell.label, f"black to yellow: 0 to {brightest:.0f}"]
        else:
            look = sheet.developed(exposures[cell.scene] if figure.exposure is None else figure.exposure)
            lines = [cell.label, *captions(row)]
        sheet.shown(images / f"{number:02}.exr", compute_size(cell.scene, renderer.scale), look, lines, shown[-1])
    sheet.mosaic(shown, columns, folder / f"{name}.png")
    write_numbers(name, figure, scale_name, rows, folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="figures, or all")
    parser.add_argument("--list", action="store_true", help="print all figures")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--scale", choices=SCALES, default="quick", help="size and samples; quick if not given")
    parser.add_argument("--bdpt", default="bdpt", metavar="PATH", help="the command; found in PATH if not given")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(f"{name:20} {len(figure.cells):3} cells  {figure.title}" for name, figure in FIGURES.items()))
        return
    names = list(FIGURES) if arguments.names == ["all"] else arguments.names
    unknown = [name for name in names if name not in FIGURES]
    if unknown or not names or not arguments.output:
        parser.error(f"no such figure: {', '.join(unknown)}" if unknown else "NAME and -o DIR are required")
    for tool in ("oiiotool", arguments.bdpt):
        if not shutil.which(tool):
            parser.error(f"{tool}: no such program")
    if not sheet.font():
        print("make_figures: oiiotool finds no font; labels are in the .json files only", file=sys.stderr)
    renderer = Renderer(arguments.bdpt, SCALES[arguments.scale], arguments.output)
    for name in names:
        try:
            make(name, renderer, arguments.scale, arguments.output)
        except subprocess.CalledProcessError as error:
            sys.exit(f"make_figures: {name}: failed: {shlex.join(error.cmd)}\n{error.stderr or ''}".rstrip())
        except OSError as error:
            sys.exit(f"make_figures: {name}: {error}")


if __name__ == "__main__":
    main()
