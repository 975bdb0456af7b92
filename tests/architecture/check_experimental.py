#!/usr/bin/env python3
"""Tests that docs/library.md names what may change in a minor version: the declarations that headers mark
BDPT_EXPERIMENTAL, and the options of the command whose help says "experimental": check_experimental.py SOURCE COMMAND
"""

import pathlib
import re
import subprocess
import sys

MARK = re.compile(r"^ *BDPT_EXPERIMENTAL (?:[\w:<>]+ )*(\w+)", re.M)
OPTION = re.compile(r"^  (?:-\w, )?(--[\w-]+)(.*\n(?: {4,}\S.*\n)*)", re.M)


def main():
    source, command = pathlib.Path(sys.argv[1]), sys.argv[2]
    marked = {name for header in source.glob("lib/**/include/**/*.h") for name in MARK.findall(header.read_text(encoding="utf-8"))}
    text = (source / "docs/library.md").read_text(encoding="utf-8").partition("\n## What may change\n")[2].partition("\n## ")[0]
    listed = set(re.findall(r"`(?:\w+::)?(\w+)`", text)) - {"BDPT_EXPERIMENTAL"}
    said = subprocess.run([command, "render", "--help-all"], check=True, capture_output=True, text=True).stdout
    helped = {name for name, words in OPTION.findall(said) if "experimental" in words.lower()}
    options = set(re.findall(r"`(--[\w-]+)", text))
    assert marked and listed == marked, f"docs/library.md lists {sorted(listed)}, but headers mark {sorted(marked)}"
    assert helped and options == helped, f"docs/library.md lists {sorted(options)}, but the help says it of {sorted(helped)}"


main()
