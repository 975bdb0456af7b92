#!/usr/bin/env python3
"""Tests that Doxygen accepts the public headers, and that each type, function or constant of a namespace has a comment:
check_api_reference.py DOXYFILE. Exits with 77 without Doxygen.

Members of classes, like `int width`, need no comment.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
MEMBER = re.compile(r"Member .* of (struct|class|union) \S+ is not documented|No output formats selected")


def run_doxygen(doxyfile, extract_all):
    """Returns Doxygen's warnings. `extract_all` is YES, as in the target `docs`, or NO to warn about missing
    comments."""
    with tempfile.TemporaryDirectory() as folder:
        settings = (f'@INCLUDE = "{doxyfile}"\nOUTPUT_DIRECTORY = "{folder}"\nEXTRACT_ALL = {extract_all}\n'
                    "GENERATE_HTML = NO\nGENERATE_XML = YES\nWARN_AS_ERROR = NO\n")
        done = subprocess.run(["doxygen", "-"], input=settings, capture_output=True, text=True, check=False)
        made = list(pathlib.Path(folder, "xml").glob("*.xml"))
    lines = [line for line in done.stderr.splitlines() if ": warning:" in line or ": error:" in line]
    if done.returncode or len(made) < 2:
        lines.append(f"doxygen: exit code {done.returncode}, {len(made)} files: {done.stderr[-500:]}")
    return [line for line in lines if not MEMBER.search(line)], len(made)


def main():
    if not shutil.which("doxygen"):
        print("doxygen is not installed")
        sys.exit(SKIPPED)
    doxyfile = pathlib.Path(sys.argv[1])
    if not doxyfile.is_file():
        print("doxygen was not installed when the project was configured")
        sys.exit(SKIPPED)
    results = [run_doxygen(doxyfile.resolve(), extract_all) for extract_all in ("YES", "NO")]
    found = sorted({line for lines, _ in results for line in lines})
    print("\n".join(found) or f"{results[0][1]} pages without a warning")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
