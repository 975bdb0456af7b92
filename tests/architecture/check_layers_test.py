#!/usr/bin/env python3
"""Tests that check_layers finds each planted violation in a small tree, and none in the correct tree."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import check_layers

SOUND = {
    "lib/CMakeLists.txt": "add_library(bdpt\n  # src/math/forgotten.cpp\n  src/math/warp.cpp\n  src/path/walk.cpp\n"
                          "  src/geometry/ray.cpp\n  src/render/render.cpp)\n",
    "lib/include/bdpt/types.h": "#pragma once\n#include <glm/vec3.hpp>\n#include <vector>\n",
    "lib/include/bdpt/scene.h": "#pragma once\n#include <bdpt/types.h>\n",
    "lib/src/math/warp.h": "#pragma once\n#include <bdpt/types.h>\n",
    "lib/src/math/warp.cpp": '#include "math/warp.h"\n#include <cmath>\n',
    "lib/src/material/bsdf.h": '#pragma once\n#include "math/warp.h"\n',
    "lib/src/geometry/ray.h": "#pragma once\n",
    "lib/src/geometry/ray.cpp": '#include "geometry/ray.h"\n#include <embree3/rtcore.h>\n#include <xmmintrin.h>\n',
    "lib/src/path/walk.h": "#pragma once\n",
    "lib/src/path/walk.cpp": '#include "path/walk.h"\n#include "geometry/ray.h"\n#include "material/bsdf.h"\n',
    "lib/src/render/render.cpp": '#include "path/walk.h"\n#include <tbb/parallel_for.h>\n',
    "lib/io/CMakeLists.txt": "add_library(bdpt_io)\ninclude(reading.cmake)\n",
    "lib/io/reading.cmake": "target_sources(bdpt_io PRIVATE src/output/exr.cpp\n  "
                           "src/gltf/scene/read.cpp src/oiio_module/module.cpp)\n",
    "lib/io/src/oiio_module/module.cpp": "#include <OpenImageIO/imageio.h>\n",
    "lib/io/include/bdpt/io/exr.h": "#pragma once\n#include <bdpt/types.h>\n#include <filesystem>\n",
    "lib/io/src/output/exr.cpp": "#include <bdpt/io/exr.h>\n#include <OpenEXR/ImfArray.h>\n#include <unistd.h>\n",
    "lib/io/src/gltf/scene/read.cpp": '#include "gltf/scene/read.h"\n#include <tiny_gltf.h>\n'
                                      '#include <nlohmann/json.hpp>\n',
    "lib/io/src/gltf/scene/read.h": '#pragma once\n#include "gltf/geometry/mesh.h"\n',
    "lib/io/src/gltf/geometry/mesh.h": "#pragma once\n",
    "apps/bdpt/CMakeLists.txt": "add_executable(bdpt_cli main.cpp parser/words.cpp parser/command_parser.cpp)\n",
    "apps/bdpt/main.cpp": '#include "commands/render.h"\n#include <bdpt/io/exr.h>\n#include <fmt/core.h>\n'
                          "#include <csignal>\n",
    "apps/bdpt/commands/render.h": '#pragma once\n#include "parser/words.h"\n#include "options/list.h"\n',
    "apps/bdpt/parser/words.h": "#pragma once\n",
    "apps/bdpt/parser/words.cpp": '#include "parser/words.h"\n',
    "apps/bdpt/parser/command_parser.cpp": '#include "parser/command_parser.h"\n#include <CLI/CLI.hpp>\n',
    "apps/bdpt/parser/command_parser.h": "#pragma once\n",
    "lib/job/CMakeLists.txt": "add_library(bdpt_job src/options/list.cpp src/run/run.cpp)\n",
    "lib/job/include/bdpt/job.h": "#pragma once\n#include <bdpt/types.h>\n",
    "lib/job/src/options/list.h": "#pragma once\n",
    "lib/job/src/options/list.cpp": '#include "options/list.h"\n#include <bdpt/io/exr.h>\n#include <nlohmann/json.hpp>\n',
    "lib/job/src/run/run.cpp": '#include "options/list.h"\n#include <bdpt/job.h>\n',
    "lib/view/CMakeLists.txt": "add_library(bdpt_view src/session/session.cpp src/server/server.cpp)\n",
    "lib/view/src/session/session.h": '#pragma once\n#include "options/list.h"\n',
    "lib/view/src/session/session.cpp": '#include "session/session.h"\n',
    "lib/view/src/server/server.cpp": '#include "session/session.h"\n#include <boost/asio/post.hpp>\n',
    "lib/eval/CMakeLists.txt": "add_library(bdpt_eval src/metrics/flip.cpp)\n",
    "lib/eval/include/bdpt/eval/flip.h": "#pragma once\n#include <bdpt/types.h>\n#include <vector>\n",
    "lib/eval/src/metrics/flip.cpp": '#include <bdpt/eval/flip.h>\n#include <bdpt/io/exr.h>\n'
                                               '#include <nlohmann/json.hpp>\n#include <oneapi/tbb/parallel_for.h>\n',
    "tests/unit/CMakeLists.txt": "bdpt_add_tests(unit ../support/means.cpp math/warp_test.cpp)\n",
    "tests/support/means.cpp": '#include "catch.hpp"\n',
    "tests/unit/math/warp_test.cpp": '#include "math/warp.h"\n#include "catch.hpp"\n',
    "tests/support/catch.hpp": "#include <catch2/catch.hpp>\n",
}

# Maps a name to (file, its text or a line that is added to it, a part of the finding).
VIOLATIONS = {
    "lower layer includes higher": ("lib/src/math/warp.h", '#include "path/walk.h"', "math (layer 1) may not include"),
    "layers of one height": ("lib/src/material/bsdf.h", '#include "geometry/ray.h"', "material (layer 3) may not"),
    "include without layer": ("lib/src/math/warp.h", '#include "warp_detail.h"', "does not name its layer"),
    "unusual spacing": ("lib/src/math/warp.h", '  #  include  "render/render.h"', "math (layer 1) may not include"),
    "unknown layer": ("lib/src/util/misc.h", '#include "math/warp.h"', "unknown layer util"),
    "core includes io": ("lib/src/render/render.cpp", "#include <bdpt/io/exr.h>", "may not include <bdpt/io/exr.h>"),
    "public header includes internal": ("lib/include/bdpt/scene.h", '#include "math/warp.h"', "is public"),
    "public header includes embree": ("lib/include/bdpt/scene.h", "#include <embree3/rtcore.h>", "<embree3/rtcore.h>"),
    "public header includes tbb": ("lib/include/bdpt/scene.h", "#include <tbb/task_arena.h>", "<tbb/task_arena.h>"),
    "public header includes io": ("lib/include/bdpt/scene.h", "#include <bdpt/io/exr.h>", "<bdpt/io/exr.h>"),
    "public io header includes OpenEXR": ("lib/io/include/bdpt/io/exr.h", "#include <OpenEXR/ImfArray.h>", "OpenEXR"),
    "embree beyond geometry": ("lib/src/path/walk.h", "#include <embree4/rtcore.h>", "<embree4/rtcore.h>"),
    "tbb beyond render and scene": ("lib/src/path/walk.h", "#include <oneapi/tbb/blocked_range.h>", "<oneapi/tbb/"),
    "OpenImageIO beyond its module": ("lib/io/src/output/exr.cpp", "#include <OpenImageIO/imageio.h>", "<OpenImageIO/"),
    "OpenImageIO in the core": ("lib/src/material/bsdf.h", "#include <OpenImageIO/imageio.h>", "<OpenImageIO/"),
    "JSON in the core": ("lib/src/path/walk.h", "#include <nlohmann/json.hpp>", "<nlohmann/json.hpp>"),
    "CLI11 in io": ("lib/io/src/output/exr.cpp", "#include <CLI/CLI.hpp>", "<CLI/CLI.hpp>"),
    "Catch2 beyond tests": ("apps/bdpt/main.cpp", "#include <catch2/catch.hpp>", "<catch2/catch.hpp>"),
    "OpenEXR in apps": ("apps/bdpt/main.cpp", "#include <OpenEXR/ImfArray.h>", "<OpenEXR/ImfArray.h>"),
    "io reaches into the core": ("lib/io/src/output/exr.cpp", '#include "camera/film.h"', "reaches into lib/src"),
    "lower layer of io includes higher": ("lib/io/src/gltf/geometry/mesh.h", '#include "gltf/scene/read.h"',
                                          "gltf/geometry (layer 7) may not include"),
    "layers of io of one height": ("lib/io/src/gltf/geometry/mesh.h", '#include "gltf/material/texture.h"',
                                   "gltf/geometry (layer 7) may not include"),
    "include without layer in io": ("lib/io/src/gltf/scene/read.h", '#include "mesh.h"', "does not name its layer"),
    "unknown layer of io": ("lib/io/src/gltf/mesh.h", '#include "file/json.h"', "unknown layer gltf"),
    "the parser includes a command": ("apps/bdpt/parser/words.h", '#include "commands/render.h"',
                                  "parser (layer 2) may not include"),
    "include of the command without layer": ("apps/bdpt/parser/words.h", '#include "words.h"',
                                             "does not name its layer"),
    "unknown layer of the command": ("apps/bdpt/util/words.h", '#include "parser/words.h"', "unknown layer util"),
    "app reaches into the core": ("apps/bdpt/main.cpp", '#include "path/walk.h"', "reaches into lib/src"),
    "lower layer of jobs includes higher": ("lib/job/src/options/list.h", '#include "run/run.h"',
                                            "options (layer 2) may not include"),
    "jobs include the command": ("lib/job/src/run/run.cpp", '#include "commands/render.h"', "does not name its layer"),
    "jobs reach into the core": ("lib/job/src/run/run.cpp", '#include "path/walk.h"', "reaches into lib/src"),
    "a public header of jobs includes options": ("lib/job/include/bdpt/job.h", '#include "options/list.h"', "is public"),
    "lower layer of views includes higher": ("lib/view/src/session/session.h", '#include "server/server.h"',
                                             "session (layer 3) may not include"),
    "Boost beyond the server": ("lib/view/src/session/session.h", "#include <boost/asio/post.hpp>", "<boost/asio/"),
    "the command includes a session": ("apps/bdpt/commands/render.h", '#include "session/session.h"',
                                       "does not name its layer"),
    "eval reaches into the core": ("lib/eval/src/metrics/flip.cpp", '#include "path/walk.h"',
                                      "reaches into lib/src"),
    "JSON in a header of eval": ("lib/eval/include/bdpt/eval/flip.h",
                                        "#include <nlohmann/json.hpp>", "<nlohmann/json.hpp>"),
    "CLI11 in another file of the command": ("apps/bdpt/parser/words.cpp", "#include <CLI/CLI.hpp>", "<CLI/CLI.hpp>"),
    "CLI11 in eval": ("lib/eval/src/metrics/flip.cpp", "#include <CLI/CLI.hpp>", "<CLI/CLI.hpp>"),
    "io includes eval": ("lib/io/src/output/exr.cpp", "#include <bdpt/eval/flip.h>", "<bdpt/eval/"),
    "C header": ("lib/src/math/warp.h", "#include <math.h>", "may not include <math.h>"),
    "file too long": ("lib/src/path/walk.h", "\n" * 600, "601 lines, 600 at most"),
    "source not listed": ("lib/src/math/forgotten.cpp", '#include "math/warp.h"', "is in no list of CMake"),
    "source listed in part": ("apps/bdpt/ain.cpp", "", "is in no list of CMake"),
    "test not listed": ("tests/unit/math/frame_test.cpp", '#include "catch.hpp"', "is in no list of CMake"),
}


class CheckLayers(unittest.TestCase):
    def findings(self, extra=None):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for path, text in SOUND.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            if extra:
                path, line, _ = extra
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                with open(root / path, "a", encoding="utf-8") as file:
                    file.write(line + ("" if line.endswith("\n") else "\n"))
            return check_layers.check(root)[0]

    def test_sound_tree_has_no_findings(self):
        self.assertEqual(self.findings(), [])

    def test_each_violation_is_the_only_finding(self):
        for name, violation in VIOLATIONS.items():
            with self.subTest(name):
                found = self.findings(violation)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(violation[0] + ": "), found)
                self.assertIn(violation[2], found[0])

    def test_crowded_folder_is_the_only_finding(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            crowd = root / "lib/include/bdpt"
            (crowd / "part").mkdir(parents=True)
            for number in range(30):
                (crowd / f"header_{number}.h").write_text("#pragma once\n", encoding="utf-8")
            (crowd / "part/other.h").write_text("#pragma once\n", encoding="utf-8")
            self.assertEqual(check_layers.check(root)[0], [])
            (crowd / "one_more.h").write_text("#pragma once\n", encoding="utf-8")
            self.assertEqual(check_layers.check(root)[0],
                             ["lib/include/bdpt: 31 sources side by side, 30 at most"])

    def test_empty_tree_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            errors, count = check_layers.check(pathlib.Path(folder))
        self.assertEqual(count, 0)
        self.assertEqual(len(errors), 1)


if __name__ == "__main__":
    unittest.main()
