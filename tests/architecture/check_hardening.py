#!/usr/bin/env python3
"""Checks that attacks on what we build find no easy ways: check_hardening.py READELF FILE...

Each program and shared library must be loaded at any address, without memory that is writable and executable, and with
addresses of functions that are bound at start and read-only afterwards. Those that read files guard their stack.
"""

import pathlib
import re
import subprocess
import sys

READ_NO_FILES = ("libbdpt.so", "libbdpt_eval.so")


def list_faults(readelf, file):
    text = subprocess.run([readelf, "-hldW", "--dyn-syms", file], capture_output=True, check=True, text=True).stdout
    faults = [] if re.search(r"Type:\s+DYN", text) else ["is not position-independent"]
    faults += [] if "GNU_RELRO" in text else ["has no segment GNU_RELRO"]
    faults += [] if re.search(r"\((FLAGS|FLAGS_1)\).*\b(BIND_NOW|NOW)\b", text) else ["binds functions lazily (no BIND_NOW)"]
    segments = re.findall(r"^\s+(\S+)(?:\s+0x[0-9a-f]+){5}\s+([R ][W ][E ])", text, re.MULTILINE)
    if not any(name == "GNU_STACK" for name, _ in segments):
        faults.append("has an executable stack (no segment GNU_STACK)")
    faults += [f"has a segment {name} that is writable and executable" for name, flags in segments if flags[1:] == "WE"]
    if not pathlib.Path(file).name.startswith(READ_NO_FILES) and "__stack_chk_fail" not in text:
        faults.append("does not guard its stack")
    return faults


def main():
    readelf, *files = sys.argv[1:]
    faults = [f"{file} {fault}" for file in files for fault in list_faults(readelf, file)]
    print("\n".join(faults) or f"{len(files)} files are hardened")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
