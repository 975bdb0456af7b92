#!/usr/bin/env python3
"""Writes a source file that compiles the examples of all public headers: header_examples.py ROOT OUTPUT.cpp. Fails,
with a line for each, when headers have no example.

A public header begins with `#pragma once`, an empty line and a comment that explains the use of the header:

    /// @file
    /// Reads glTF files.
    ///
    /// @code{.cpp}
    /// bdpt::io::LoadedScene file = bdpt::io::load_gltf("room.glb");
    /// const bdpt::Scene scene(std::move(file.scene));
    /// @endcode

An example is the body of a function or, to take parameters, a whole function: then `{` has a line of its own. A
header may have several.
The source file includes all public headers and the usual ones of the standard library.
"""

import pathlib
import re
import sys

FOLDERS = ("lib/include", "lib/io/include", "lib/eval/include", "lib/job/include")
EXEMPT = ("bdpt/export.h",)  # a macro for the headers themselves
STANDARD = ("algorithm", "array", "atomic", "chrono", "cmath", "cstddef", "cstdint", "cstdlib", "filesystem", "fstream",
            "functional", "iostream", "limits", "memory", "numbers", "optional", "span", "stop_token", "string",
            "string_view", "thread", "type_traits", "utility", "variant", "vector")
COMMENT = re.compile(r"#pragma once\n\n(/// @file\n(?:///.*\n)+)")
EXAMPLE = re.compile(r"^/// @code\{\.cpp\}\n((?:///.*\n)+?)/// @endcode\n", re.MULTILINE)


def find_public_headers(root):
    """Returns files and the names by which they are included, in the order of the names."""
    headers = []
    for folder in FOLDERS:
        for file in (root / folder).rglob("*"):
            name = file.relative_to(root / folder).as_posix()
            if name.endswith((".h", ".h.in")):
                headers.append((name.removesuffix(".in"), file))
    return sorted(headers)


def find_examples(text):
    """Returns, for each example of a header, the line where it begins, counted from 1, and its lines, indented."""
    comment = COMMENT.match(text)
    examples = []
    for example in EXAMPLE.finditer(comment[1]) if comment else ():
        line = text.count("\n", 0, comment.start(1) + example.start(1)) + 1
        # Keeps the columns of the header, for compiler messages.
        examples.append((line, ["    " + line[4:] for line in example[1].splitlines()]))
    return examples


def write_function(name, file, number, example):
    """Returns the text of a namespace with example `number`, from 0, of the header `name`."""
    line, code = example
    begin, end = ("", "") if "    {" in code else ("void run()\n{\n", "}\n")
    space = "example_" + re.sub(r"\W", "_", name.removesuffix(".h")) + (f"_{number}" if number else "")
    return f'namespace {space} {{\n{begin}#line {line} "{file.as_posix()}"\n' + "\n".join(code) + f"\n{end}}}\n"


def source(root):
    """Returns the text of the source file, and the errors: a line for each header without an example."""
    headers = find_public_headers(root)
    errors = [] if headers else [f"{root}: no public headers"]
    functions = []
    for name, file in headers:
        examples = find_examples(file.read_text(encoding="utf-8"))
        functions += [write_function(name, file, number, example) for number, example in enumerate(examples)]
        if not examples and name not in EXEMPT:
            errors.append(f"{file.relative_to(root).as_posix()}: no example after #pragma once: a comment with "
                          "/// @file, /// @code{.cpp} and /// @endcode")
    includes = [f"#include <{name}>\n" for name in [name for name, _ in headers] + list(STANDARD)]
    return "// Made by tests/examples/header_examples.py.\n" + "".join(includes) + "\n" + "\n".join(functions), errors


def main():
    text, errors = source(pathlib.Path(sys.argv[1]).resolve())
    if errors:
        sys.exit("\n".join(errors))
    pathlib.Path(sys.argv[2]).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
