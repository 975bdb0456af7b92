#!/usr/bin/env python3
"""Tests that check_figures finds each planted mistake in a figure, and none in a correct one."""

import dataclasses
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import check_figures

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "figures"))
import make_figures
import sheet
from figures import Cell, Figure, strategies

HELP = """Options:
  -h,--help                     Print this help message and exit
  --spp N                       Samples per pixel
  --integrator bdpt|pt|mis      bdpt (the default)
  --max-depth N                 Longest path in edges, unlike --max-breadth
  --disable LIST                Leave these strategies out
"""
CELL = Cell("a", "box.gltf", ("--integrator", "pt", "--max-depth", "6"), 16, reference=("--max-depth", "6"))
OTHER = dataclasses.replace(CELL, options=("--disable", "s0t2,s11t1"))

# Maps a name to (changes of the first cell, a part of the finding).
MISTAKES = {
    "scene": ({"scene": "bax.gltf"}, "no such scene: bax.gltf"),
    "option": ({"options": ("--integrater", "pt")}, "no option --integrater"),
    "option that only a description has": ({"options": ("--max-breadth", "6")}, "no option --max-breadth"),
    "value": ({"options": ("--integrator", "pth")}, "--integrator has no value pth"),
    "number": ({"options": ("--max-depth", "six")}, "--max-depth takes a number"),
    "strategies": ({"options": ("--disable", "s0t2,t1")}, "not a list of strategies"),
    "value that lacks": ({"options": ("--integrator",)}, "lacks its value"),
    "option twice": ({"options": ("--max-depth", "6", "--max-depth", "5")}, "--max-depth is given twice"),
    "option of the reference": ({"reference": ("--depth", "6")}, "no option --depth"),
    "option of the rival": ({"rival": ("--depth", "6")}, "no option --depth"),
    "rounds": ({"rival": (), "rounds": 3}, "rounds do not divide"),
    "no limit": ({"spp": None}, "either samples or a time"),
    "two limits": ({"seconds": 1.0}, "either samples or a time"),
    "the same twice": ({"options": OTHER.options}, "two cells of a row show the same"),
}

README = "| `mean` | a number |\n\n## The figures\n\n| `box` | a box |\n"


def findings(cells, readme=README, columns=2):
    figures = {"box": Figure("A box", columns, cells)}
    return check_figures.figure_errors(figures, readme, {"box.gltf"}, check_figures.list_options(HELP))


class Check(unittest.TestCase):
    def test_sound_figure(self):
        self.assertEqual(findings((CELL, OTHER)), [])

    def test_mistakes(self):
        for name, (changes, finding) in MISTAKES.items():
            with self.subTest(name):
                self.assertIn(finding, "\n".join(findings((dataclasses.replace(CELL, **changes), OTHER))))

    def test_sheet(self):
        self.assertIn("last row", "\n".join(findings((CELL,))))
        self.assertIn("README", "\n".join(findings((CELL, OTHER), readme="")))
        self.assertIn("README", "\n".join(findings((CELL, OTHER), readme=README + "| `bax` | |")))
        bare = tuple(dataclasses.replace(cell, reference=None) for cell in (CELL, OTHER))
        self.assertIn("has a reference", "\n".join(findings(bare)))


class Table(unittest.TestCase):
    def test_strategies_that_are_kept_are_not_disabled(self):
        option, names = strategies(2, 2, lambda s, t: (s, t) != (1, 1))
        self.assertEqual((option, names), ("--disable", "s1t1"))
        self.assertEqual(strategies(2, 2, lambda s, t: True), ())
        self.assertEqual(strategies(2, 1, lambda s, t: False)[1], "s1t1,s2t0,s2t1")

    def test_quick_cells_are_those_that_fit(self):
        cells = tuple(Cell(f"{name}, {count} spp", "box.gltf", ("--integrator", name), count)
                      for name in ("pt", "bdpt") for count in (1, 64, 256, 1024))
        scale = make_figures.Scale(32, 64, 64, 0.5)
        small, columns = make_figures.scaled(Figure("Samples", 4, cells), scale)
        self.assertEqual([cell.label for cell in small], ["pt, 1 spp", "pt, 64 spp", "bdpt, 1 spp", "bdpt, 64 spp"])
        self.assertEqual((columns, {cell.spp for cell in small}), (2, {1, 64}))
        repeated = (cells[0], cells[1], cells[0], cells[4])
        self.assertEqual(make_figures.scaled(Figure("Rows", 2, repeated), scale), (list(repeated), 2))
        timed = Figure("Time", 1, (dataclasses.replace(cells[0], label="pt, 9 s", spp=None, seconds=9.0),))
        small = make_figures.scaled(timed, scale)[0][0]
        self.assertEqual((small.seconds, small.label), (0.5, "pt, 0.5 s"))

    def test_sums_of_lengths(self):
        """Tests that the reference of each cell has all paths that its subpaths can make; cells have no splats."""
        for cell in make_figures.FIGURES["lengths-grid"].cells:
            words = dict(zip(cell.options[::2], cell.options[1::2]))
            m, w = int(words["--max-camera-depth"]), int(words["--max-light-depth"])
            self.assertEqual(cell.reference, ("--max-depth", str(m + w + 1)) if m else None)
            disabled = set(words["--disable"].split(","))
            self.assertTrue({f"s{s}t1" for s in range(1, w + 2)} <= disabled, cell.label)
            self.assertFalse([name for name in disabled if not name.endswith(("t0", "t1"))], cell.label)

    def test_ends(self):
        """Tests that "end to end only" leaves a single strategy, and its reference all others of that length."""
        cell = next(c for c in make_figures.FIGURES["lamp-box"].cells if c.label == "2-3 end to end only")
        everything = {f"s{s}t{t}" for s in range(8) for t in range(8) if 2 <= s + t <= 7}
        within = {f"s{s}t{t}" for s in range(5) for t in range(4) if s + t >= 2}
        self.assertEqual(within - set(cell.options[-1].split(",")), {"s4t3"})
        left = everything - set(cell.reference[-1].split(","))
        self.assertEqual(left - {"s0t7", "s7t0"}, {f"s{s}t{7 - s}" for s in range(1, 7)})


    def test_captions(self):
        """Tests the measurements below the label."""
        row = {"samples": 16, "seconds": 2.0, "relmse": 0.125}
        self.assertEqual(make_figures.captions(row), ["relMSE 0.125, 16 spp, 2 s"])


@unittest.skipUnless(shutil.which("oiiotool"), "oiiotool is not there")
class Images(unittest.TestCase):
    def test_means_and_maxima(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            files = []
            for value in (1, 3, 4, 2):
                files.append(folder / f"{value}.exr")
                sheet.oiiotool("--pattern", f"constant:color={value},{2 * value},0", "4x3", 3, "-d", "float",
                               "-o", files[-1])
            sheet.mean_of_maxima([files[:2], files[2:]], folder / "out.exr")
            self.assertEqual(sheet.mean(folder / "out.exr"), [3.5, 7.0, 0.0])

    def test_sheet(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            sheet.oiiotool("--pattern", "constant:color=0.25,0.5,4", "52x26", 3, "-d", "float", "-o", folder / "a.exr")
            sheet.shown(folder / "a.exr", (52, 26), sheet.developed(1.0), ("", ""), folder / "a.png")
            sheet.mosaic([folder / "a.png"] * 3, 2, folder / "sheet.png")
            height = 104 + (4 + 2 * sheet.LINE if sheet.font() else 0)
            self.assertIn(f"{2 * 208 + 4} x {2 * height + 4}, 3 channel", " ".join(
                sheet.oiiotool("--info", folder / "sheet.png").split()).replace(" x  ", " x "))
            sheet.oiiotool(folder / "a.png", "--cut", "208x104", "-d", "float", "-o", folder / "cut.exr")
            red, green, blue = sheet.mean(folder / "cut.exr")  # means of 0.5, 1 and 8 as sRGB
            self.assertAlmostEqual(red, 188 / 255, delta=0.01)
            self.assertEqual((green, blue), (1.0, 1.0))

    def test_false_colours(self):
        """Tests a channel besides the image's, from dark to bright, up to the greatest value."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            sums = []
            for value in (0, 2, 4, 9):
                sheet.oiiotool("--pattern", f"constant:color=1,1,1,{value}", "4x4", 4, "--chnames", "R,G,B,sampleCount.Y", "-d",
                               "float", "-o", folder / "a.exr")
                self.assertEqual(sheet.mean(folder / "a.exr", "sampleCount.Y"), [value])
                sheet.shown(folder / "a.exr", (4, 4), sheet.false_colours("sampleCount.Y", 4.0), (), folder / "a.png")
                sheet.oiiotool(folder / "a.png", "--cut", "208x208", "-d", "float", "-o", folder / "cut.exr")
                sums.append(sum(sheet.mean(folder / "cut.exr")))
            self.assertLess(sums[0], 0.1)
            self.assertLess(sums[0] + 0.3, sums[1])
            self.assertLess(sums[1] + 0.3, sums[2])
            self.assertEqual(sums[2], sums[3])


if __name__ == "__main__":
    unittest.main()
