#!/usr/bin/env python3
"""Compares the choice of --integrator auto with the best choice by hand in real models: real_hand_table.py BDPT MODELS

The scenes and the folder MODELS are those of real_scenes.py, the columns those of hand_table.py. Needs numpy."""

import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "light_paths"))
import hand_table
import mixed_light_scenes
import real_scenes


def main():
    parser = hand_table.make_parser(__doc__, "240x135", 16)
    parser.add_argument("models", type=pathlib.Path, metavar="MODELS")
    parser.add_argument("--only", default="", help="scenes whose names this regular expression matches")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as made:
        mixed_light_scenes.write(made)
        hand_table.compare_scenes(
            [(name, (path, *options, "--max-depth", "8"))
             for name, path, options in real_scenes.find_scenes(arguments, pathlib.Path(made))], arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
