#!/usr/bin/env python3
"""Tests that figures name existing scenes, options and values, and that the README describes these figures:
check_figures.py ROOT [BDPT]. Checks no options without the command. Renders nothing."""

import dataclasses
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True


def list_options(help_text):
    """Returns option -> values, where the help lists them (a|b|c; X|R,G,B is no list), "" for flags, else None."""
    found = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: ([^\s]+))?", help_text, flags=re.M)
    return {name: set(values.split("|")) if re.fullmatch(r"[a-z0-9|-]+", values) and "|" in values
            else None if values else "" for name, values in found}


def pair_options(words, known):
    """Returns the options in a list of words, each with its value, which is "" for flags and None if it is missing."""
    pairs, rest = [], list(words)
    while rest:
        name = rest.pop(0)
        flag = known.get(name) == ""
        pairs.append((name, "" if flag else rest.pop(0) if rest else None))
    return pairs


def check_options(words, known):
    """Returns the errors in a list of options and values."""
    pairs = pair_options(words, known)
    if any(value is None for _, value in pairs):
        return [f"an option lacks its value: {' '.join(words)}"]
    errors = []
    for name, value in pairs:
        if name not in known:
            errors.append(f"bdpt render has no option {name}")
        elif known[name] and value not in known[name]:
            errors.append(f"{name} has no value {value}")
        elif name == "--disable" and not re.fullmatch(r"s\d+t\d+(,s\d+t\d+)*", value):
            errors.append(f"not a list of strategies: {value}")
        elif re.fullmatch(r"--(max-.*|light-paths)", name) and not value.isdigit():
            errors.append(f"{name} takes a number, not {value}")
    names = [name for name, _ in pairs]
    return errors + [f"{name} is given twice" for name in sorted(set(names)) if names.count(name) > 1]


def check_cell(cell, scenes, known):
    errors = [] if cell.scene in scenes else [f"no such scene: {cell.scene}"]
    if (cell.spp is None) == (cell.seconds is None):
        errors.append("it needs either samples or a time")
    if cell.rival is not None and (not cell.spp or cell.spp % cell.rounds):
        errors.append("rounds do not divide its samples")
    for words in (cell.options, cell.reference or (), cell.rival or ()):
        errors += check_options(words, known) if known else []
    return errors


def figure_errors(figures, readme, scenes, known):
    """Returns all findings, one line each. If `known` is empty, options are not checked."""
    _, _, table = readme.partition("\n## The figures\n")
    described = set(re.findall(r"^\| `([\w-]+)` \|", table, flags=re.M))
    errors = [f"{name}: only one of figures.py and README.md knows it" for name in sorted(described ^ set(figures))]
    for name, figure in figures.items():
        if not figure.cells or len(figure.cells) % figure.columns:
            errors.append(f"{name}: its last row is not full")
        for start in range(0, len(figure.cells), figure.columns):
            row = figure.cells[start:start + figure.columns]
            if len({dataclasses.replace(cell, label="") for cell in row}) < len(row):
                errors.append(f"{name}: two cells of a row show the same: {row[0].label} ...")
        for scene in {cell.scene for cell in figure.cells}:
            if all(cell.reference is None for cell in figure.cells if cell.scene == scene):
                errors.append(f"{name}: no cell of {scene} has a reference, so nothing tells the exposure")
        for cell in figure.cells:
            errors += [f"{name}: {cell.label}: {error}" for error in check_cell(cell, scenes, known)]
    return errors


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    folder = root / "benchmarks" / "figures"
    sys.path.insert(0, str(folder))
    from figures import FIGURES
    known = {}
    if len(sys.argv) > 2:
        known = list_options(subprocess.run([sys.argv[2], "render", "--help-all"], check=True, capture_output=True,
                                          text=True).stdout)
    scenes = {file.name for file in (root / "scenes").glob("*.gltf")}
    errors = figure_errors(FIGURES, (folder / "README.md").read_text(encoding="utf-8"), scenes, known)
    cells = sum(len(figure.cells) for figure in FIGURES.values())
    print("\n".join(errors) or f"{len(FIGURES)} figures of {cells} cells are right")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
