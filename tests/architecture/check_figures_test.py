#!/usr/bin/env python3
"""Plants mistakes in a figure and expects check_figures to find each, and nothing in a sound one."""

import dataclasses
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
import check_figures

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "figures"))
import make_figures
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

# Name -> (changes of the first cell, a part of the finding)
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
    return check_figures.figure_errors(figures, readme, {"box.gltf"}, check_figures.options_of(HELP))


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
        timed = Figure("Time", 1, (dataclasses.replace(cells[0], spp=None, seconds=9.0),))
        self.assertEqual(make_figures.scaled(timed, scale)[0][0].seconds, 0.5)


if __name__ == "__main__":
    unittest.main()
