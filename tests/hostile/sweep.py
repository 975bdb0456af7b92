#!/usr/bin/env python3
"""Runs the command on untrusted files, and counts the outcomes.

    sweep.py COMMAND SCENE [FOLDER...] [--assets NAME] [--mutants N] [--seed N] [--timeout S] [--memory GB]
             [--every N] [--jobs N] [--trace] [--json FILE] [--keep FOLDER]

Runs `bdpt info` and `bdpt render` on each scene, and `bdpt merge` on each part of a render (.part.exr), which it then
resumes. Each environment lights SCENE, which must be valid; any other image becomes a texture. In addition to the files
of the folders it tests mutants of the valid ones (N of each small one), and scenes that try to read files outside of
their folders. If the Khronos validator's report lies beside a file, it compares the verdicts, also for a twin of the
file that shows all its meshes.

Faults are crashes, hangs, escapes, lack of memory, error messages that are not one line with a documented exit code,
half-written files, and verdicts that contradict the validator's. They are listed, and the exit code is 1. --trace
checks every file that is opened (strace).
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

import escapes
import mutants
import verdicts

SANITIZER = re.compile(r"(AddressSanitizer|runtime error|LeakSanitizer|UndefinedBehaviorSanitizer).*")
REFUSAL_TOLD = re.compile(r"^rendering   would fail with exit code (\d+): (?!no triangles)(.*)$", re.MULTILINE)
REFUSALS = {3: "not found", 4: "invalid", 5: "unsupported"}
SCENES, ENVIRONMENTS = (".gltf", ".glb"), (".exr", ".hdr")
PART = ".part.exr"
TEXTURES = (".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".bmp", ".gif")
LARGEST_ORIGIN = 300_000  # [bytes], limit of files that mutants are made of

Case = collections.namedtuple("Case", "name group file expected codes", defaults=(None, ()))
Result = collections.namedtuple("Result", "case outcome faults opened")


class Runner:
    def __init__(self, options, scratch):
        self.options = options
        self.scratch = scratch
        self.sanitized = b"__asan_init" in pathlib.Path(options.command).read_bytes()
        self.usual = set()
        self.environment = dict(
            os.environ, UBSAN_OPTIONS="print_stacktrace=1:exitcode=99",
            ASAN_OPTIONS=f"exitcode=99:detect_leaks=0:hard_rss_limit_mb={options.memory * 1024}")

    def limit(self):
        # AddressSanitizer reserves address space and has a limit of its own.
        if not self.sanitized:
            size = self.options.memory << 30
            resource.setrlimit(resource.RLIMIT_AS, (size, size))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def call(self, words, folder):
        """Returns (exit code, or None after a timeout; stderr; opened files)."""
        trace = folder / "trace"
        prefix = ["strace", "-ff", "-qq", "-s", "4096", "-e", "trace=open,openat,openat2,creat", "-o",
                  str(trace)] if self.options.trace else []
        try:
            done = subprocess.run([*prefix, self.options.command, *words], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=self.options.timeout,
                                  env=self.environment, preexec_fn=self.limit, check=False)
            code, text = done.returncode, done.stderr.decode("utf-8", "replace")
            refusal = REFUSAL_TOLD.search(done.stdout.decode("utf-8", "replace"))
            if code == 0 and refusal:  # bdpt info reports why a render would fail
                code, text = int(refusal[1]), text + f"bdpt: error: {refusal[2]}\n"
        except subprocess.TimeoutExpired:
            code, text = None, ""
        # strace writes a file for each thread, so that lines are not interleaved.
        opened = set().union(*(escapes.opened_files(part.read_text(errors="replace")) for part in folder.glob("trace.*")))
        return code, text, opened

    def words(self, case, image, folder):
        """Returns the commands to run on a file."""
        small = ["-o", str(image), "--size", "8x8", "--spp", "1", "--max-depth", "4", "--threads", "1"]
        suffix = case.file.suffix.lower()
        if case.file.name.endswith(PART):
            part = folder / ("copy" + PART)
            shutil.copy(case.file, part)
            return [["merge", str(case.file), "-o", str(image), "--partial"],
                    ["render", str(self.options.scene), "--part", str(part), "--size", "8x8", "--spp", "1"]]
        if suffix in SCENES:
            moved = ["--frame-time", "0.4", "--animation", "all"]
            return [["info", str(case.file)], ["render", str(case.file), *small, *moved]]
        if suffix in TEXTURES:
            shutil.copy(case.file, folder / ("picture" + suffix))
            (folder / "inside.bin").write_bytes(bytes(36))
            scene = folder / "scene.gltf"
            scene.write_text(json.dumps(escapes.scene("inside.bin", "picture" + suffix)))
            return [["info", str(scene)]]
        return [["render", str(self.options.scene), "--env", str(case.file), *small]]

    def run(self, case):
        with tempfile.TemporaryDirectory(dir=self.scratch) as name:
            folder = pathlib.Path(name)
            image = folder / "out.exr"
            faults, outcomes, opened = [], [], set()
            for words in self.words(case, image, folder):
                code, text, files = self.call(words, folder)
                opened |= files
                outcome, fault = judge(code, text, image if str(image) in words else None)
                outcomes.append(outcome)
                faults += [f"{words[0]}: {fault}"] if fault else []
            if case.expected == "refuse" and outcomes[0] != "refused" and outcomes[-1] != "refused":
                kind = "escape" if case.group == "escapes" else "verdict"
                faults.append(f"{kind}: should be refused: {', '.join(case.codes)}")
            if case.expected == "load" and outcomes[0] == "refused":
                faults.append(f"verdict: should load: {', '.join(case.codes)}: {text.strip()[-200:]}")
            folders = {case.file.resolve().parent, folder.resolve(), pathlib.Path(self.options.scene).resolve().parent}
            faults += [f"escape: opened {path}" for path in escapes.outside(opened, self.usual, folders)] \
                if self.usual else []
            return Result(case, outcomes[-1], faults, opened)


def judge(code, text, image):
    """Returns (outcome, fault or None) of one call."""
    lines = text.splitlines()
    finding = SANITIZER.search(text)
    if code is None:
        return "hang", "hang: the time is up"
    if finding or code < 0 or code in (1, 99) or code > 100:
        return "crash", f"crash: exit code {code}: {finding.group(0) if finding else text.strip()[-200:]}"
    if code == 7:
        return "memory", f"memory: {text.strip()[-200:]}"
    if code == 0:
        if image and not image.exists():
            return "crash", "crash: exit code 0 without an image"
        return ("warned" if any(re.match(r"bdpt: warning: .*?: /", line) for line in lines) else "accepted"), None
    errors = [line for line in lines if line.startswith("bdpt: error: ")]
    others = [line for line in lines if not line.startswith("bdpt: ")]
    if code not in REFUSALS or len(errors) != 1 or others:
        return "refused", f"message: exit code {code}: {text.strip()[-300:]}"
    if any(ord(letter) < 32 for letter in errors[0]):
        return "refused", f"message: control characters: {errors[0]!r}"
    if image and image.exists():
        return "refused", "message: refused, but there is an image"
    return "refused", None


def scene_cases(file, group, scratch):
    """Yields the file, and its twin that shows all meshes."""
    expected, codes = verdicts.expected_verdict(file)
    document = verdicts.read_document(file) if file.suffix == ".gltf" else None
    twin = verdicts.shown(document) if document else None
    # Parts of the document that are not in use may stay unchecked.
    yield Case(file.name, group, file, "load" if expected == "load" else None if twin else expected, codes)
    if twin:
        folder = pathlib.Path(tempfile.mkdtemp(dir=scratch))
        for sibling in file.parent.iterdir():
            if sibling.is_file() and sibling.suffix not in (*SCENES, ".json") and sibling.stat().st_size < 1 << 20:
                shutil.copy(sibling, folder)
        (folder / file.name).write_text(json.dumps(twin))
        yield Case(file.name + " (shown)", group, folder / file.name, expected, codes)


def folder_cases(folder, scratch, every):
    files = sorted(file for file in folder.rglob("*") if file.is_file())[::every]
    for file in files:
        group = file.relative_to(folder).parts[0] if file.parent != folder else folder.name
        with file.open("rb") as stream:
            is_exr = stream.read(4) == b"\x76\x2f\x31\x01"
        if file.suffix.lower() in SCENES:
            yield from scene_cases(file, group, scratch)
        elif is_exr or file.suffix.lower() in (*ENVIRONMENTS, *TEXTURES):
            yield Case(file.name, group, file)


def mutant_cases(folders, scratch, count, seed, every):
    """Yields mutants of files that are complete in themselves or whose neighbours are copied."""
    for folder in folders:
        files = sorted(file for file in folder.rglob("*")
                       if file.suffix in (*SCENES, *ENVIRONMENTS, *TEXTURES) and "hostile" not in file.parts)
        for file in files[::every]:
            if file.stat().st_size > LARGEST_ORIGIN:
                continue
            place = pathlib.Path(tempfile.mkdtemp(dir=scratch))
            for sibling in file.parent.iterdir():
                if sibling.is_file() and sibling != file and sibling.stat().st_size < 4 << 20:
                    shutil.copy(sibling, place)
            for i in range(count):
                mutant = place / f"{seed}-{i}-{file.name}"
                mutant.write_bytes(mutants.mutate(file.read_bytes(), f"{file.name} {seed} {i}"))
                yield Case(mutant.name, "mutants", mutant)


def keep(result, folder):
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copy(result.case.file, folder)


def report(results):
    """Prints counts by group, then all faults; returns whether there are none, and the counts."""
    columns = ["tried", "refused", "warned", "accepted", "crash", "hang", "memory", "escape", "verdict", "message"]
    counts = collections.defaultdict(collections.Counter)
    for result in results:
        kinds = {fault.split(": ")[1] if fault.split(": ")[0] in ("info", "render") else fault.split(":")[0]
                 for fault in result.faults}
        for group in (result.case.group, "all"):
            counts[group].update(["tried", *({result.outcome} | kinds)])
    width = max(map(len, counts)) + 1
    print(" " * width + "".join(f"{column:>10}" for column in columns))
    for group in [*sorted(set(counts) - {"all"}), "all"]:
        print(f"{group:<{width}}" + "".join(f"{counts[group][column]:>10}" for column in columns))
    for result in results:
        for fault in result.faults:
            print(f"FAULT {result.case.group}/{result.case.name}: {fault}")
    return not any(result.faults for result in results), counts


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("folders", nargs="*", type=pathlib.Path)
    parser.add_argument("--assets", metavar="NAME", help="a folder in that which BDPT_TEST_ASSETS names")
    parser.add_argument("--mutants", type=int, default=0, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=10.0)
    parser.add_argument("--memory", type=int, default=4, metavar="GB")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every N-th file")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--trace", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for files that broke a promise")
    return parser.parse_args(words)


def main():
    options = parse(sys.argv[1:])
    if options.assets is not None:
        assets = os.environ.get("BDPT_TEST_ASSETS")
        if not assets:
            print("skipped: BDPT_TEST_ASSETS does not name a folder of files")
            sys.exit(77)
        options.folders.append(pathlib.Path(assets) / options.assets)
    if options.trace and not shutil.which("strace"):
        print("strace is not here, so only planted files tell of escapes")
        options.trace = False
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        runner = Runner(options, scratch)
        planted = [Case(file.name, "escapes", file, "refuse" if refuse else None, ("a way out of the folder",))
                   for file, refuse in escapes.plant(scratch / "planted")]
        # A valid scene opens only usual files: libraries, the module for images.
        sound = runner.run(planted[-1])
        if sound.outcome not in ("accepted", "warned"):
            sys.exit(f"the sound scene does not render: {sound}")
        runner.usual = {str(path) for path in sound.opened}
        cases = list(planted)
        for folder in options.folders:
            cases += folder_cases(folder, scratch, options.every)
        cases += mutant_cases(options.folders, scratch, options.mutants, options.seed, options.every)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            results = list(pool.map(runner.run, cases))
        fine, counts = report(results)
        if options.json:
            options.json.write_text(json.dumps(counts, indent=1))
        for result in results:
            if result.faults and options.keep:
                keep(result, options.keep)
    sys.exit(0 if fine else 1)


if __name__ == "__main__":
    main()
