#!/usr/bin/env python3
"""Tests that benchmarks read all choices of auto from its source, with a stand-in for the command."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
BENCHMARKS = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "light_paths"
sys.path.insert(0, str(BENCHMARKS))
import candidates

STAND_IN = """#!/bin/sh
echo "$@" >>"{log}"
exit 11
"""


class Choices(unittest.TestCase):
    def test_all_candidates_of_the_source_are_read(self):
        found = candidates.read_candidates()
        listed = candidates.HEADER.read_text().split("std::array candidates{")[1].split("};")[0]
        self.assertEqual(len(found), listed.count("Candidate"))
        self.assertEqual(len(found), len(set(found)))
        self.assertEqual(found[0], (0, 0, 0))  # mis
        self.assertTrue(all(n > 0 for n, _, _ in found[1:]), found)

    def test_all_but_mis_are_verified(self):
        with tempfile.TemporaryDirectory() as name:
            log, command = (pathlib.Path(name) / file for file in ("log", "bdpt"))
            command.write_text(STAND_IN.format(log=log))
            command.chmod(0o755)
            done = subprocess.run([sys.executable, BENCHMARKS / "verify_choices.py", command, "a.gltf"],
                                  capture_output=True, text=True, check=False)
            verified = [line.split() for line in log.read_text().splitlines()]
        expected = candidates.read_candidates()[1:]
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"{len(expected)} inconclusive", done.stdout)
        names = ("--light-paths", "--connections", "--connection-rays")
        self.assertEqual([tuple(float(words[words.index(each) + 1]) for each in names) for words in verified], expected)


if __name__ == "__main__":
    unittest.main()
