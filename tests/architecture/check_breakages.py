#!/usr/bin/env python3
"""Tests that each breakage of benchmarks/breakages can still be applied, and that its scene exists:
check_breakages.py ROOT. Builds nothing."""

import pathlib
import sys

sys.dont_write_bytecode = True


def find_errors(breakage, root):
    file = root / breakage.file
    found = file.read_text(encoding="utf-8").count(breakage.old) if file.exists() else 0
    errors = [] if found == 1 else [f"{breakage.name}: {breakage.file} holds what it replaces {found} times, not once"]
    if breakage.new == breakage.old:
        errors.append(f"{breakage.name}: nothing is broken")
    if not (root / "scenes" / breakage.scene).exists():
        errors.append(f"{breakage.name}: no such scene: {breakage.scene}")
    return errors


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(root / "benchmarks" / "breakages"))
    from breakages import BREAKAGES
    errors = [error for breakage in BREAKAGES for error in find_errors(breakage, root)]
    print("\n".join(errors) or f"{len(BREAKAGES)} breakages can be planted")
    sys.exit(1 if errors else 0)


if __name__ == "__main__":
    main()
