#!/usr/bin/env python3
"""Tests that check_math finds each planted call."""

import sys
import unittest

sys.dont_write_bytecode = True
import check_math

SOUND = {
    "lib/a/image_metadata.cpp.o": "                 U tanf\n",
    "apps/a/filled_share.cpp.o": "                 U tanf\n",
    "apps/a/frame.cpp.o": "                 U log10\n",
    "apps/a/view_camera.cpp.o": "                 U atan2f\n",
    "apps/a/inspect_report.cpp.o": "                 U cos\n",
    "lib/a/display.cpp.o": "                 U powf\n                 U exp2\n",
    "lib/a/light_meter.cpp.o": "                 U log2\n",
    "lib/b/film.cpp.o": "                 U ldexp@GLIBC_2.2.5\n                 U sqrtf\n                 U floor\n"
                        "                 U _ZSt3sinSt7complexIfE\n                 U exponent\n                 w logger\n",
}


class CheckMath(unittest.TestCase):
    def test_sound_objects_have_no_findings(self):
        self.assertEqual(check_math.check(SOUND), [])

    def test_planted_calls_are_found(self):
        for name in ("sin", "cosf", "sincosf", "tanh", "asinf", "atan2", "atan2f", "exp", "exp2f", "expm1", "exp10", "log",
                     "log1pf", "log2", "log10l", "pow", "powf", "powl", "cbrt", "hypotf", "erf", "tgamma", "lgammaf",
                     "__expf_finite", "sinf32x", "_ZGVbN4v_sinf", "pow@GLIBC_2.29"):
            with self.subTest(name):
                objects = {**SOUND, "lib/b/bsdf.cpp.o": f"                 U {name}\n"}
                found = check_math.check(objects)
                self.assertEqual(len(found), 1)
                self.assertIn("bsdf.cpp calls " + name.partition("@")[0], found[0])

    def test_needless_permissions_are_found(self):
        objects = {**SOUND, "lib/a/display.cpp.o": ""}
        self.assertEqual(check_math.check(objects), ["display.cpp is allowed to call what it does not call"])


if __name__ == "__main__":
    unittest.main()
