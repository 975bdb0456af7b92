"""Compares the output of many command lines with recorded output: command_lines_test.py [--record] BDPT SCENES.

command_lines.txt has a block for each: the line, the exit code, the output (> standard output, ! standard error) and
the files that were written (+). near_misses.txt has lines that people type who know other programs: each is understood,
or answered with what to type. The lines of a table run one after the other in one folder, with box.gltf (a scene of
SCENES), sky.hdr, empty.gltf, and files that are no scenes. --record writes the current output: review the difference
before committing it.
"""

import pathlib
import shlex
import subprocess
import sys
import tempfile

TABLES = {"command_lines.txt": 300, "near_misses.txt": 60}  # with the least number of lines
KTX = b'''{"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_texture_basisu"],
"extensionsRequired": ["KHR_texture_basisu"]}'''
SKY = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81"


def list_files(folder):
    """Returns the names of the files below the folder, with their modification times."""
    return {str(file.relative_to(folder)): file.stat().st_mtime_ns for file in folder.rglob("*") if file.is_file()}


def run_line(bdpt, folder, line):
    """Runs one command line; returns its block."""
    words = shlex.split(line)[1:]
    before = list_files(folder)
    ran = subprocess.run([bdpt, *words], cwd=folder, capture_output=True, stdin=subprocess.DEVNULL, timeout=300,
                         check=False)
    written = sorted(name for name, time in list_files(folder).items() if before.get(name) != time)
    lines = [f"$ {line}", f"exit code {ran.returncode}"]
    lines += ["> " + text for text in ran.stdout.decode().splitlines()]
    lines += ["! " + text for text in ran.stderr.decode().splitlines()]
    lines += ["+ " + name for name in written]
    return [text.rstrip() for text in lines]


def read_table(text):
    """Parses blocks of lines: titles, which begin with #, and command lines with their recorded output."""
    return [block.splitlines() for block in text.strip().split("\n\n")]


def check_table(table, bdpt, scenes, record):
    """Runs the lines of one table; returns how many there are, and how many have another answer."""
    blocks = read_table(table.read_text())
    wrong = 0
    now = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = (scenes / "cornell-box.gltf").read_bytes()
        for file, content in {"box.gltf": scene, "sky.hdr": SKY, "empty.gltf": b"", "cut.gltf": scene[:len(scene) // 2],
                              "notes.md": b"# Notes\n", "model.obj": b"v 0 0 0\n", "ktx.gltf": KTX}.items():
            (folder / file).write_bytes(content)
        for block in blocks:
            if block[0].startswith("#"):
                now.append(block)
                continue
            now.append(run_line(bdpt, folder, block[0].removeprefix("$ ")))
            if now[-1] != block and not record:
                wrong += 1
                print("recorded:", *block, "now:", *now[-1], "", sep="\n")
    if record:
        table.write_text("\n\n".join("\n".join(block) for block in now) + "\n")
    return sum(block[0].startswith("$") for block in blocks), wrong


def main():
    failed = False
    for name, least in TABLES.items():
        lines, wrong = check_table(pathlib.Path(__file__).with_name(name), sys.argv[-2], pathlib.Path(sys.argv[-1]),
                                   sys.argv[1] == "--record")
        print(f"{name}: {lines} command lines, {wrong} with another answer")
        assert lines >= least, "the table is not whole"
        failed = failed or wrong > 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
