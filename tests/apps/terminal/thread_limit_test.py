#!/usr/bin/env python3
"""Tests commands with a low thread limit: thread_limit_test.py COMMAND SCENE. Exits with 77 (skipped) without root,
which the test needs to become a user without other processes, and if that user may not run the command.

A command renders with fewer threads and says so, or ends with exit code 7 and the cause.
"""

import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

COMMAND, SCENE = sys.argv[1:3]
USER = 54321
HOW = ["--size", "32x24", "--spp", "4", "--integrator", "bdpt"]
MOST = 14


def bdpt(words, limit, cwd):
    def become_user():
        resource.setrlimit(resource.RLIMIT_NPROC, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        os.setgroups([])
        os.setgid(USER)
        os.setuid(USER)
    return subprocess.run([COMMAND, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, check=False, cwd=cwd, preexec_fn=become_user, timeout=300)


def is_correct(done, image):
    message = done.stderr.decode()
    if done.returncode == 0:
        return image is None or image.exists()
    return done.returncode == 7 and "system limits how many" in message.splitlines()[-1]


def checks(folder):
    scene = folder / "scene.gltf"
    image = folder / "a.exr"
    volume = folder / "smoke.vdb"
    codes = []
    for limit in range(1, MOST + 1):
        commands = {
            "render": (["render", scene, *HOW, "-o", image, "--threads", "64"], image),
            "default threads": (["render", scene, *HOW, "-o", image], image),
            "denoise, merge": (["merge", folder / "p.part.exr", "-o", image], image),
            "compare": (["compare", folder / "b.exr", folder / "b.exr"], None),
            "verify": (["verify", scene, "--time", "0.3s", "--threads", "32", "--size", "16x12"], None),
        }
        if volume.exists():
            commands["volume"] = (["render", scene, *HOW, "-o", image, "--volume", volume, "--threads", "64"], image)
        for what, (words, output) in commands.items():
            image.unlink(missing_ok=True)
            done = bdpt(words, limit, folder)
            message = done.stderr.decode()
            passed = is_correct(done, output) or (what == "verify" and done.returncode in (10, 11))
            yield f"{what}, limit {limit}: {done.returncode}: {message}", passed
            if what == "render":
                codes.append(done.returncode)
                warned = "of 64 threads: " in message
                yield f"a warning, limit {limit}: {message}", warned or done.returncode != 0
    yield f"enough threads for a render: {codes}", codes[-1] == 0
    done = bdpt(["render", scene, *HOW, "-o", image, "--threads", "4"], 400, folder)
    yield f"no limit, no warning: {done.stderr}", done.returncode == 0 and b"threads: " not in done.stderr


if os.geteuid() != 0:
    print("skipped: only root can become another user")
    sys.exit(77)
with tempfile.TemporaryDirectory() as name:
    FOLDER = pathlib.Path(name)
    for file in pathlib.Path(SCENE).parent.glob(pathlib.Path(SCENE).stem + ".*"):
        shutil.copy(file, FOLDER / file.name)
    shutil.copy(SCENE, FOLDER / "scene.gltf")
    smoke = pathlib.Path(SCENE).with_name("smoke.vdb")
    known = subprocess.run([COMMAND, "render", SCENE, *HOW, "-o", FOLDER / "b.exr", "--volume", smoke],
                           capture_output=True, check=False)
    if known.returncode == 0:  # needs OpenVDB
        shutil.copy(smoke, FOLDER / "smoke.vdb")
    subprocess.run([COMMAND, "render", SCENE, *HOW, "-o", FOLDER / "b.exr", "--part", FOLDER / "p.part.exr", "-q"],
                   check=True)
    for path in [FOLDER, *FOLDER.iterdir()]:
        os.chmod(path, 0o755)
        os.chown(path, USER, USER)
    try:
        RESULTS = list(checks(FOLDER))
    except PermissionError:
        print(f"skipped: other users may not run {COMMAND}")
        sys.exit(77)
FAILED = [what for what, passed in RESULTS if not passed]
print("\n".join(f"failed: {what}" for what in FAILED) or f"{len(RESULTS)} checks passed")
sys.exit(1 if FAILED else 0)
