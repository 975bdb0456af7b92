#!/usr/bin/env python3
"""Tests that check_glossary finds each planted gap in a glossary, and none in a complete one."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import check_glossary

GLOSSARY = "# Glossary\n\n- **splat**: a contribution to another pixel: `SplatFilm`\n"
HEADER = "#pragma once\nnamespace bdpt {\nclass BDPT_EXPORT SplatFilm {\n};\n}\n"


def findings(glossary, header):
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for folder in ("docs", "lib/include/bdpt", "lib/io/include", "lib/eval/include", "apps"):
            (root / folder).mkdir(parents=True)
        (root / "docs/glossary.md").write_text(glossary)
        (root / "lib/include/bdpt/film.h").write_text(header)
        return check_glossary.errors_in(root)


class Glossary(unittest.TestCase):
    def test_complete(self):
        self.assertEqual(findings(GLOSSARY, HEADER), [])

    def test_word_without_explanation(self):
        found = findings(GLOSSARY, HEADER + "struct QuirkFilm {\n};\n")
        self.assertEqual(len(found), 1)
        self.assertIn('QuirkFilm: docs/glossary.md does not explain "quirk"', found[0])

    def test_name_that_is_gone(self):
        self.assertEqual(findings(GLOSSARY + "- **film**: `OldFilm`\n", HEADER), ["docs/glossary.md: OldFilm is not in the code"])


if __name__ == "__main__":
    unittest.main()
