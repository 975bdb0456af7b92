#!/usr/bin/env python3
"""Fails when the list of options in docs/render.md differs from the options of the command, in names or values:
check_options.py ROOT BDPT."""

import pathlib
import re
import subprocess
import sys


def options_of_help(text):
    """The options that a help text describes, each as "--name VALUE" or "--name"."""
    found = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: (\S+))?", text, flags=re.M)
    return {" ".join(filter(None, option)) for option in found} - {"--help", "--help-all"}


def options_of_page(text):
    """The options that the list in the section "Options" names, written alike."""
    section = text.partition("\n## Options\n")[2].partition("\n## ")[0]
    items = " ".join(line.strip() for line in re.findall(r"^(?:- |  ).*$", section, flags=re.M))
    return re.findall(r"`(--[^`]+)`", items)


def main():
    root, bdpt = pathlib.Path(sys.argv[1]), sys.argv[2]
    text = subprocess.run([bdpt, "render", "--help-all"], capture_output=True, text=True, check=True).stdout
    known, listed = options_of_help(text), options_of_page((root / "docs/render.md").read_text(encoding="utf-8"))
    errors = ["bdpt render --help-all: no options found"] if not known else []
    errors += [f"docs/render.md: lacks the option {option}" for option in sorted(known - set(listed))]
    errors += [f"docs/render.md: bdpt render has no option {option}" for option in sorted(set(listed) - known)]
    errors += [f"docs/render.md: names {option} twice" for option in sorted(set(listed)) if listed.count(option) > 1]
    print("\n".join(errors) or f"{len(known)} options are listed")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
