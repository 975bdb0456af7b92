#!/usr/bin/env python3
"""Tests that the sweep finds each fault, with commands that cause them on purpose."""

import pathlib
import stat
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import escapes  # noqa: E402
import mutants  # noqa: E402
import sweep  # noqa: E402
import verdicts  # noqa: E402

# {fault} is the command's behaviour; $out is the image that it should write, if any.
COMMAND = '''#!/bin/sh
for word; do [ "$previous" = -o ] && out=$word; previous=$word; done
{fault}
'''


class Judging(unittest.TestCase):
    def outcome(self, fault):
        """Returns the sweep's verdict on a command: (outcome, faults)."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            command = folder / "bdpt"
            command.write_text(COMMAND.replace("{fault}", fault))
            command.chmod(command.stat().st_mode | stat.S_IXUSR)
            file = folder / "bad.glb"
            file.write_bytes(b"glTF")
            options = sweep.parse([str(command), str(folder / "sound.gltf"), "--timeout", "1"])
            result = sweep.Runner(options, folder).run(sweep.Case("bad.glb", "files", file))
            return result.outcome, result.faults

    def check_fault(self, fault, text):
        self.assertRegex(" ".join(self.outcome(fault)[1]), text)

    def test_what_is_fine(self):
        self.assertEqual(self.outcome('echo "bdpt: error: x: no" >&2; exit 4'), ("refused", []))
        image = '[ -n "$out" ] && echo image > "$out"; '
        self.assertEqual(self.outcome(image + "exit 0"), ("accepted", []))
        self.assertEqual(self.outcome(image + 'echo "bdpt: warning: f: /nodes/0: odd" >&2; exit 0'), ("warned", []))

    def test_faults(self):
        self.check_fault("kill -SEGV $$", "crash")
        self.check_fault("exit 99", "crash")
        self.check_fault('echo "x: runtime error: odd" >&2; exit 4', "crash")
        self.check_fault('echo "bdpt: error: x" >&2; exit 1', "crash")
        self.check_fault("exec sleep 3", "hang")
        self.check_fault('echo "bdpt: error: x" >&2; exit 7', "memory")
        self.check_fault("exit 4", "message")
        self.check_fault('echo "bdpt: error: x" >&2; echo more >&2; exit 4', "message")
        self.check_fault('printf "bdpt: error: \\033[2J\\n" >&2; exit 4', "control")
        self.check_fault('echo "bdpt: error: x" >&2; exit 2', "message")
        self.check_fault('[ -n "$out" ] && echo half > "$out"; echo "bdpt: error: x" >&2; exit 4', "there is an image")
        self.check_fault("exit 0", "without an image")

    def test_escapes(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            planted = dict((file.name, refuse) for file, refuse in escapes.plant(folder / "planted"))
            self.assertGreater(len(planted), 40)
            self.assertTrue(planted["parent-image.gltf"] and planted["link-buffer.gltf"])
            self.assertFalse(planted["sound.gltf"])
        trace = ('1 openat(AT_FDCWD, "/etc/passwd", O_RDONLY) = 3\n1 open("/no", O_RDONLY) = -1 ENOENT\n'
                 '2 openat(AT_FDCWD, "/proc/self/maps", O_RDONLY) = 3\n2 openat(AT_FDCWD, "/lib/x.so", O_RDONLY) = 3\n'
                 '2 openat(AT_FDCWD, "/cut", O_RDONLY <unfinished ...>\n2 close(3) = 0\n'
                 '2 openat(AT_FDCWD, "/proc/self/root/etc/hosts", O_RDONLY) = 3\n')
        opened = escapes.opened_files(trace)
        self.assertEqual(escapes.outside(opened, {"/lib/x.so"}, [pathlib.Path("/tmp")]),
                         ["/etc/passwd", "/proc/self/root/etc/hosts"])

    def test_verdicts(self):
        with tempfile.TemporaryDirectory() as name:
            file = pathlib.Path(name) / "a.gltf"
            report = pathlib.Path(name) / "a.gltf.report.json"
            for codes, expected in (("NODE_LOOP", "refuse"), ("EMPTY_ENTITY", "load"), ("TYPE_MISMATCH", None)):
                report.write_text('{"issues":{"messages":[{"code":"%s","severity":0},{"code":"X","severity":2}]}}' % codes)
                self.assertEqual(verdicts.expected_verdict(file), (expected, [codes]))
        document = {"meshes": [{"primitives": [{"attributes": {"JOINTS_0": 0}}]}], "skins": [{}]}
        self.assertEqual(verdicts.shown(document)["nodes"], [{"mesh": 0, "skin": 0}])

    def test_mutants(self):
        seeds = pathlib.Path(__file__).parents[1] / "fuzz" / "seeds" / "scene"
        data = (seeds / "rig.glb").read_bytes()
        made = {mutants.mutate(data, seed) for seed in range(40)}
        self.assertGreater(len(made), 35)
        self.assertEqual(mutants.mutate(data, 7), mutants.mutate(data, 7))
        sound = [one for one in made if one[:4] == b"glTF" and len(one) >= 12 and
                 struct.unpack_from("<I", one, 8)[0] == len(one)]
        self.assertGreater(len(sound), 20)  # most changes are after the header


if __name__ == "__main__":
    unittest.main()
