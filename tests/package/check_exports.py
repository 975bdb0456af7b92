#!/usr/bin/env python3
"""Tests that a shared library exports exactly what its public headers mark BDPT_EXPORT:
check_exports.py NM LIBRARY HEADERS [HEADERS OF LIBRARIES BELOW]..."""

import pathlib
import re
import subprocess
import sys

TYPE = re.compile(r"^(?:class|struct|enum class) (?:BDPT_EXPORT )?(\w+)\b(?!;)", re.M)
CLASS = re.compile(r"^(?:class|struct) BDPT_EXPORT (\w+)", re.M)
FUNCTION = re.compile(r"^(?:\[\[nodiscard\]\] )?BDPT_EXPORT [^;{}()]*?(\w+)\(", re.M)
# Our style does not indent the content of namespaces, so these lines begin declarations of free functions.
UNMARKED = re.compile(r"^(?!.*BDPT_EXPORT)(?:\[\[nodiscard\]\] )?(?!inline|constexpr|template|using|class|struct|enum)"
                      r"[\w:][\w:<>,&* ]* (\w+)\(", re.M)
# Templates of the standard library leave these symbols in any program; with a return type, or as the type of a
# function, too. fmt makes its exceptions visible itself from version 10 on.
STANDARD = re.compile(r"^(?:(?:typeinfo|typeinfo name|vtable|VTT|guard variable) for )?"
                      r"(?:(?:(?:unsigned|long|int|bool|char|void|float|double|short|auto) )+(?:\((?:\*\)\()?)?)?"
                      r"(?:std|__gnu_cxx|__cxxabiv1)::|^decltype ?\(.*\) std::|^__|^operator (?:new|delete)"
                      r"|^(?:typeinfo|typeinfo name|vtable) for fmt::v\d+::\w+_error$")
OF_CLASS = r"(?:(?:typeinfo|typeinfo name|vtable|VTT) for )?"


def find_public_names(folder):
    """Returns the names of all types, the marked classes and the marked functions, and findings about functions without
    a mark."""
    types, classes, functions, errors = set(), set(), set(), []
    for header in sorted(pathlib.Path(folder).rglob("*.h")):
        text = header.read_text(encoding="utf-8")
        space = re.search(r"^namespace ([\w:]+) \{", text, re.M)
        if space:
            types.update(f"{space[1]}::{name}" for name in TYPE.findall(text))
            classes.update(f"{space[1]}::{name}" for name in CLASS.findall(text))
            functions.update(f"{space[1]}::{name}" for name in FUNCTION.findall(text))
            errors += [f"{header.name}: {name}() is not marked BDPT_EXPORT" for name in UNMARKED.findall(text)]
    return types, classes, functions, errors


def check(symbols, folder, folders_below=()):
    """Returns all findings for the lines of `nm -DC --defined-only`, and the number of public names."""
    types, classes, functions, errors = find_public_names(folder)
    below = [find_public_names(other) for other in folders_below]
    types.update(*(names[0] for names in below))
    copied = set().union(*(names[1] for names in below))  # inline functions of lower libraries may appear here too
    missing = classes | functions
    for line in symbols.splitlines():
        name = re.sub(r"^[0-9a-f]* *\w ", "", line)
        # Function templates are listed with their return type.
        head = re.sub(r"\[abi:\w+\]|^(?:(?:unsigned|long|int|bool|float|double) )+(?=bdpt::)", "", name).partition("(")[0]
        owner = next((c for c in classes if re.match(rf"{OF_CLASS}{c}(::|$)", head)), None)
        if owner or head in functions:
            missing.discard(owner or head)
        elif any(re.match(rf"{OF_CLASS}{c}(::|$)", head) for c in copied):
            continue
        elif not STANDARD.match(name) or not types.issuperset(re.findall(r"\bbdpt(?:::\w+)+", name)):
            errors.append(f"exported, but not public: {name}")
    errors += [f"public, but not exported: {name}" for name in sorted(missing)]
    if not classes | functions:
        errors.append(f"{folder}: nothing is marked BDPT_EXPORT")
    return errors, len(classes | functions)


def main():
    nm, library, *folders = sys.argv[1:]
    symbols = subprocess.run([nm, "-DC", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    errors, count = check(symbols, folders[0], folders[1:])
    print("\n".join(errors) or f"{count} public names are exported, nothing else")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
