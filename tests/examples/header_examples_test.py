#!/usr/bin/env python3
"""Tests that each public header has an example, and that header_examples reports planted headers without one."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import header_examples

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOUND = {
    "lib/include/bdpt/export.h": "#pragma once\n\n/// Marks what users may call.\n#define BDPT_EXPORT\n",
    "lib/include/bdpt/version.h.in": "#pragma once\n\n/// @file\n/// Tells the version.\n///\n/// @code{.cpp}\n"
                                     "/// bdpt::version();\n/// bdpt::version();\n/// @endcode\n\nint version();\n",
    "lib/io/include/bdpt/io/exr.h": "#pragma once\n\n/// @file\n/// Writes images.\n///\n/// @code{.cpp}\n"
                                    "/// void f(int n)\n/// {\n///\n///     ++n;\n/// }\n/// @endcode\n\n"
                                    "#include <vector>\n",
}
# Maps a name to (header, its text after the first two lines).
WITHOUT = {
    "no comment": ("lib/include/bdpt/scene.h", "#include <vector>\n"),
    "comment without example": ("lib/include/bdpt/scene.h", "/// @file\n/// Holds a scene.\n\nint i;\n"),
    "empty example": ("lib/include/bdpt/scene.h", "/// @file\n/// @code{.cpp}\n/// @endcode\n\nint i;\n"),
    "example without end": ("lib/include/bdpt/scene.h", "/// @file\n/// @code{.cpp}\n/// f();\n\nint i;\n"),
    "example of something else": ("lib/eval/include/bdpt/eval/flip.h",
                                  "#include <vector>\n\n/// @code{.cpp}\n/// f();\n/// @endcode\nint i;\n"),
    "example after the includes": ("lib/io/include/bdpt/io/png.h",
                                   "#include <vector>\n\n/// @file\n/// @code{.cpp}\n/// f();\n/// @endcode\n"),
}


def run(root):
    """Runs the script on a tree; returns its exit code, its messages, and the text that it writes, if any."""
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "examples.cpp"
        done = subprocess.run([sys.executable, header_examples.__file__, str(root), str(output)], capture_output=True,
                              text=True, check=False)
        return done.returncode, done.stderr, output.read_text("utf-8") if output.exists() else None


class HeaderExamples(unittest.TestCase):
    def planted(self, extra=None):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for path, text in {**SOUND, **dict([extra] if extra else [])}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return run(root)

    def test_every_public_header_has_an_example(self):
        code, errors, text = run(ROOT)
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("#include <bdpt/render.h>\n", text)
        self.assertIn("namespace example_bdpt_render {\n", text)

    def test_examples_keep_their_places_and_signatures(self):
        code, errors, text = self.planted()
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("#include <bdpt/export.h>\n#include <bdpt/io/exr.h>\n#include <bdpt/version.h>\n", text)
        self.assertNotIn("namespace example_bdpt_export", text)
        self.assertRegex(text, r'namespace example_bdpt_io_exr \{\n#line 7 "/.*/bdpt/io/exr\.h"\n'
                               r'    void f\(int n\)\n    \{\n *\n        \+\+n;\n    \}\n\}\n')
        self.assertRegex(text, r'namespace example_bdpt_version \{\nvoid run\(\)\n\{\n#line 7 "/.*/version\.h\.in"\n'
                               r'    bdpt::version\(\);\n    bdpt::version\(\);\n\}\n\}\n')

    def test_each_header_without_example_is_reported(self):
        for name, (header, rest) in WITHOUT.items():
            with self.subTest(name):
                code, errors, text = self.planted((header, "#pragma once\n\n" + rest))
                self.assertEqual(code, 1)
                self.assertEqual(errors.count("\n"), 1, errors)
                self.assertTrue(errors.startswith(header + ": no example"), errors)
                self.assertIsNone(text)

    def test_tree_without_headers_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            code, errors, _ = run(folder)
        self.assertEqual(code, 1)
        self.assertIn("no public headers", errors)


if __name__ == "__main__":
    unittest.main()
