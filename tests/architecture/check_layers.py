#!/usr/bin/env python3
"""Tests that the source tree follows the rules of docs/architecture.md: check_layers.py ROOT.

A folder of lib/src, lib/io/src, lib/job/src, lib/view/src or apps/bdpt includes only folders of lower layers, public headers need only GLM and the
standard library, each third-party library is used only in its area, no file is longer than 600 lines, no folder has
more than 30 sources side by side, and every source file is listed in a CMakeLists.txt or in a .cmake file beside one.
"""

import collections
import pathlib
import re
import sys

LAYERS = {"math": 1, "memory": 1, "threads": 1, "film": 2, "identity": 2, "rates": 2, "texture": 2, "geometry": 3, "material": 3, "light": 4, "camera": 4,
          "scene": 5, "path": 6, "integrator": 7, "pilot": 8, "render": 9, "inspect": 10}
JOB_LAYERS = {"machine": 1, "messages": 1, "options": 2, "plan": 3, "stage": 3, "output": 4, "run": 5, "dataset": 6}
# What is built upon lib/job may include all of it.
ABOVE_JOBS = {folder: 0 for folder in JOB_LAYERS}
VIEW_LAYERS = ABOVE_JOBS | {"state": 1, "live": 2, "session": 3, "server": 4}
COMMAND_LAYERS = ABOVE_JOBS | {"terminal": 1, "parser": 2, "report": 2, "commands": 3}
# Layers of lib/io/src. Headers are included by their folder there too.
IO_LAYERS = {"file": 1, "process": 1, "image": 2, "ies": 2, "output": 2, "volume": 2, "denoise": 2, "image/linear": 3, "part": 4, "oiio_module": 4, "vdb_reader": 4, "ktx_reader": 4, "gltf/checks": 3, "gltf/compression": 4,
             "gltf/document": 5, "gltf/animation": 6, "gltf/geometry": 7, "gltf/material": 7, "gltf/light_camera": 7,
             "gltf/scene": 8}
MAX_LINES = 600
MAX_FILES = 30
AREAS = ("lib", "apps", "tests", "benchmarks")

# Maps an area of the tree (the longest prefix counts) to the third-party and system headers that it may include.
POSIX = r"(sys/|dlfcn\.h|fcntl\.h|glob\.h|link\.h|netdb\.h|netinet/in\.h|poll\.h|signal\.h|spawn\.h|unistd\.h|termios\.h)"
INTRINSICS = r"[a-z]mmintrin\.h"
FILE_LIBRARIES = r"(OpenEXR/|Imath/|Imf|Imath|Iex|tiny_gltf\.h|nlohmann/|fmt/|png\.h|jpeglib\.h|webp/|zlib\.h)"
ALLOWED = {
    "lib/include": [r"glm/"],
    "lib/src": [r"glm/"],
    "lib/src/identity": [r"glm/", r"xxhash\.h"],
    "lib/src/geometry": [r"glm/", r"embree[34]/", INTRINSICS],
    "lib/src/scene": [r"glm/", r"(oneapi/)?tbb/"],
    "lib/src/threads": [r"(oneapi/)?tbb/"],
    "lib/src/integrator": [r"glm/", r"(oneapi/)?tbb/"],
    "lib/src/pilot": [r"glm/", r"(oneapi/)?tbb/"],
    "lib/src/render": [r"glm/", r"(oneapi/)?tbb/"],
    "lib/src/inspect": [r"glm/", r"(oneapi/)?tbb/"],
    "lib/io/include": [r"glm/"],
    "lib/src/memory": [r"(sys/mman|unistd)\.h"],
    "lib/io/src": [r"glm/", FILE_LIBRARIES, POSIX],
    "lib/io/src/process": [r"fmt/", r"(sched|seccomp)\.h", POSIX],
    "lib/io/src/gltf": [r"glm/", FILE_LIBRARIES, r"draco/", r"meshoptimizer\.h", r"(oneapi/)?tbb/"],
    "lib/io/src/oiio_module": [r"OpenImageIO/"],
    "lib/io/src/vdb_reader": [r"openvdb/", r"oneapi/tbb/", POSIX],
    "lib/io/src/ktx_reader": [POSIX],
    "lib/eval/include": [],
    "lib/eval/src": [r"glm/", r"nlohmann/", r"(oneapi/)?tbb/", r"zlib\.h"],
    "lib/job/include": [],
    "lib/job/src": [r"glm/", r"nlohmann/", r"fmt/", POSIX],
    "lib/job/src/machine": [r"(oneapi/)?tbb/", POSIX],
    "lib/view/include": [],
    "lib/view/src": [r"glm/", r"nlohmann/", r"fmt/"],
    "lib/view/src/server": [r"nlohmann/", r"fmt/", r"boost/", POSIX],
    "apps": [r"glm/", r"nlohmann/", r"fmt/", POSIX],
    "apps/python": [r"glm/", r"nlohmann/", r"fmt/", r"nanobind/", r"cxxabi\.h", POSIX],
    "apps/bdpt/parser/command_parser.cpp": [r"CLI/", r"fmt/"],
    "tests": [r"glm/", r"catch2/", r"embree[34]/", r"(oneapi/)?tbb/", FILE_LIBRARIES, POSIX, r"pthread\.h",
              INTRINSICS],
    "tests/unit/io/volume": [r"catch2/", r"openvdb/", POSIX],
    "benchmarks": [r"CLI/"],
}
# Maps an area to the headers of ours that it may include as <bdpt/...>.
OWN = {
    "lib/include": r"bdpt/(film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "lib/src": r"bdpt/(film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "lib/io": r"bdpt/(io/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "lib/eval": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "lib/job": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "lib/view": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "apps": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "tests": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
    "benchmarks": r"bdpt/(io/|eval/|film/|light/|memory/|options/|part/|tools/)?[a-z0-9_]+\.h",
}
STANDARD = re.compile(r"[a-z_]+")  # like <vector>; our code does not use the C headers with .h
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)


def find_area(table, path):
    """Returns the entry of the longest prefix of `path`, or None."""
    prefixes = [key for key in table if path == key or path.startswith(key + "/")]
    return table[max(prefixes, key=len)] if prefixes else None


def check_angle_include(path, header):
    """Returns the error of `#include <header>` in the file `path`, or None."""
    if header.startswith("bdpt/"):
        pattern = find_area(OWN, path)
        return None if pattern and re.fullmatch(pattern, header) else f"may not include <{header}>"
    if STANDARD.fullmatch(header):
        return None
    if any(re.match(pattern, header) for pattern in find_area(ALLOWED, path) or []):
        return None
    return f"may not include <{header}>"


def check_layer_include(layers, layer, header):
    """Returns the error of `#include "header"` in a file of `layer`, or None."""
    folder = header.rpartition("/")[0] if layers is IO_LAYERS else header.split("/")[0]
    if layer not in layers:
        return f"is in the unknown layer {layer}"
    if folder not in layers or "/" not in header:
        return f'"{header}" does not name its layer'
    if folder != layer and layers[folder] >= layers[layer]:
        return f'{layer} (layer {layers[layer]}) may not include "{header}" (layer {layers[folder]})'
    return None


# Maps an area to the layers of its folders.
AREA_LAYERS = {"lib/src": LAYERS, "lib/io/src": IO_LAYERS, "lib/job/src": JOB_LAYERS, "lib/view/src": VIEW_LAYERS,
               "apps/bdpt": COMMAND_LAYERS}


def check_quoted_include(path, header):
    """Returns the error of `#include "header"` in the file `path`, or None."""
    if re.match(r"lib/(\w+/)?include/", path):
        return f'is public: "{header}" must be a <bdpt/...> header'
    folder = header.split("/")[0]
    may_look_inside = path.startswith(("lib/src/", "tests/"))
    if folder in LAYERS and "/" in header and not may_look_inside:
        return f'reaches into lib/src: "{header}"'
    for area, layers in AREA_LAYERS.items():
        if path.startswith(area + "/"):
            inside = path.removeprefix(area + "/").rpartition("/")[0]
            return check_layer_include(layers, inside if layers is IO_LAYERS else inside.split("/")[0], header) \
                if inside else None
    return None


def find_listed_sources(root):
    """Returns all .cpp files that the CMake scripts of the tree name outside of comments."""
    listed = set()
    for area in AREAS:
        for script in [*(root / area).rglob("CMakeLists.txt"), *(root / area).rglob("*.cmake")]:
            text = re.sub(r"#.*", "", script.read_text(encoding="utf-8"))
            listed.update((script.parent / name).resolve() for name in re.findall(r"[\w./-]+\.cpp", text))
    return listed


def check(root):
    """Returns all findings, one line each; the last one reports a tree without sources."""
    errors, count = [], 0
    listed = find_listed_sources(root)
    files = [f for area in AREAS for f in sorted((root / area).rglob("*")) if f.suffix in (".h", ".hpp", ".cpp")]
    for file in files:
        path = file.relative_to(root).as_posix()
        text = file.read_text(encoding="utf-8")
        count += 1
        lines = text.count("\n")
        if lines > MAX_LINES:
            errors.append(f"{path}: {lines} lines, {MAX_LINES} at most")
        for quoted, angle in INCLUDE.findall(text):
            error = check_quoted_include(path, quoted) if quoted else check_angle_include(path, angle)
            if error:
                errors.append(f"{path}: {error}")
        if file.suffix == ".cpp" and file not in listed:
            errors.append(f"{path}: is in no list of CMake")
    for folder, number in collections.Counter(file.parent for file in files).items():
        if number > MAX_FILES:
            errors.append(f"{folder.relative_to(root).as_posix()}: {number} sources side by side, {MAX_FILES} at most")
    if count == 0:
        errors.append(f"{root}: no source files")
    return errors, count


def main():
    errors, count = check(pathlib.Path(sys.argv[1]).resolve())
    print("\n".join(errors) or f"{count} files keep the rules")
    sys.exit(bool(errors))


if __name__ == "__main__":
    main()
