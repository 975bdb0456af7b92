#!/usr/bin/env python3
"""Tests that the list of options in docs/render.md has the names and values of the command's options:
check_options.py ROOT BDPT."""

import pathlib
import re
import subprocess
import sys


def read_help_options(text):
    """Returns the options that a help text describes, each as "--name VALUE" or "--name"."""
    found = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: (\S+))?", text, flags=re.M)
    return {" ".join(filter(None, option)) for option in found} - {"--help", "--help-all"}


def read_page_options(text):
    """Returns the options in the section "Options" of the page, in the same form."""
    section = text.partition("\n## Options\n")[2].partition("\n## ")[0]
    items = " ".join(line.strip() for line in re.findall(r"^(?:- |  ).*$", section, flags=re.M))
    return re.findall(r"`(--[^`]+)`", items)


def main():
    root, bdpt = pathlib.Path(sys.argv[1]), sys.argv[2]
    text = subprocess.run([bdpt, "render", "--help-all"], capture_output=True, text=True, check=True).stdout
    known, listed = read_help_options(text), read_page_options((root / "docs/render.md").read_text(encoding="utf-8"))
    errors = ["bdpt render --help-all: no options found"] if not known else []
    errors += [f"docs/render.md: lacks the option {option}" for option in sorted(known - set(listed))]
    errors += [f"docs/render.md: bdpt render has no option {option}" for option in sorted(set(listed) - known)]
    errors += [f"docs/render.md: names {option} twice" for option in sorted(set(listed)) if listed.count(option) > 1]
    print("\n".join(errors) or f"{len(known)} options are listed")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
