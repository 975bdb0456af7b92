#!/usr/bin/env python3
"""Tests that our objects call no functions of the C library whose last bits depend on the CPU or on the library's
version: check_math.py READELF OBJECT...

Symbols are read by `readelf`: `nm` may list those of the intermediate code that objects of clang contain, too. Images
are equal to the bit on all machines, so code that affects the film uses lib/src/math/elementary.h instead.
"""

import pathlib
import re
import subprocess
import sys

# Lists functions of <math.h>, with the suffixes of float and long double, and their vector versions as compilers call
# them.
INEXACT = re.compile(r"(?:a?(?:sin|cos|tan)h?|atan2|sincos|exp(?:2|10|m1)?|log(?:2|10|1p)?|pow|cbrt|hypot|erfc?|[lt]gamma"
                     r"|j[01n]|y[01n])(?:f|l|f32x?|f64x?|f128)?(?:_finite)?|_ZGV\w+")
# Lists source files that need them for results outside of the film.
ALLOWED = {
    "inspect_report.cpp": "a picture for people",
    "image_metadata.cpp": "matrices among the metadata of files",
    "display.cpp": "the image for a screen",
    "light_meter.cpp": "the exposure for a screen",
    "view_camera.cpp": "the place of a camera that words then say",
    "filled_share.cpp": "a note for people",
    "frame.cpp": "false colours",
}

def find_inexact_calls(symbols):
    """Returns the functions among lines about undefined symbols, which end with their names, whose results may differ."""
    names = [line.split()[-1].partition("@")[0] for line in symbols.splitlines() if line.strip()]
    return sorted({name for name in names if INEXACT.fullmatch(re.sub(r"^__", "", name))})

def check(symbols_of):
    """Returns all findings. `symbols_of` maps each object to lines about its undefined symbols."""
    errors, used = [], set()
    for path, symbols in symbols_of.items():
        source = re.sub(r"\.o(bj)?$", "", pathlib.Path(path).name)
        calls = find_inexact_calls(symbols)
        if calls and source in ALLOWED:
            used.add(source)
        elif calls:
            errors.append(f"{source} calls {', '.join(calls)}: use math/elementary.h, or say in check_math.py why not")
    errors += [f"{source} is allowed to call what it does not call" for source in sorted(ALLOWED.keys() - used)]
    return errors

def list_undefined(readelf, path):
    """Returns the lines about undefined symbols with names."""
    symbols = subprocess.run([readelf, "--wide", "--symbols", path], check=True, capture_output=True, text=True).stdout
    return "\n".join(re.sub(r" \(\d+\)$", "", line) for line in symbols.splitlines() if re.search(r" UND \S", line))

def main():
    readelf, *objects = sys.argv[1:]
    errors = check({path: list_undefined(readelf, path) for path in objects})
    print("\n".join(errors) or f"{len(objects)} objects call exact functions only")
    sys.exit(bool(errors) or not objects)

if __name__ == "__main__":
    main()
