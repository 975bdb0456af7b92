#!/usr/bin/env python3
"""Tests completions and man pages with the shells and readers: completion_test.py [--installed] FOLDER SHELL.

FOLDER is the output of bdpt_manual; SHELL is bash, zsh, fish or man. With --installed FOLDER is PREFIX/share of an
installation, whose files shells find by the name of the command; bash does so with the package bash-completion. Exits
with 77 if the shell is not installed. Runs in a folder that has scene.glb. bdpt itself may be missing, because
completions do not start it.
"""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

# Text before the tab key, and the texts that the completion must or must not offer.
CASES = [
    ("bdpt ver", ["verify", "version"], ["render"]),
    ("bdpt render --integ", ["--integrator"], ["--samples"]),
    ("bdpt render --sampl", ["--sampler", "--samples"], ["--seed"]),
    ("bdpt render --heuristic ", ["balance", "power", "maximum"], ["sobol"]),
    ("bdpt plan --for ku", ["kubernetes"], ["slurm"]),
    ("bdpt render sce", ["scene.glb"], []),
    ("bdpt render --env no", ["none"], []),
    ("bdpt render -o sce", ["scene.glb"], []),
    ("bdpt bench --output fol", ["folder"], []),
    ("bdpt help ver", ["verify"], ["render"]),
]
SECONDS = 20.0
BASH_COMPLETION = "/usr/share/bash-completion/bash_completion"


class InteractiveShell:
    """Runs a shell in a pseudo-terminal."""

    def __init__(self, command, setup):
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.environ.update({"TERM": "dumb", "PS1": "> ", "HOME": os.getcwd()})
            os.execvp(command[0], command)
        # The quotes keep the terminal's echo from matching; only the shell's answer does.
        os.write(self.terminal, (setup + "; echo rea''dy\n").encode())
        assert "ready" in (shown := self.read_until("ready", SECONDS)), shown

    def read_until(self, mark, seconds):
        shown = ""
        end = time.monotonic() + seconds
        while time.monotonic() < end and mark not in shown:
            if select.select([self.terminal], [], [], 0.05)[0]:
                shown += os.read(self.terminal, 65536).decode(errors="replace")
        return shown

    def complete(self, line):
        """Types `line` and three tabs; returns what the shell shows."""
        os.write(self.terminal, (line + "\t\t\t").encode())
        shown = self.read_until("\0", 0.4)  # the shell drops its list when more is typed
        os.write(self.terminal, b"\x15echo do''ne\n")  # control-U
        shown += self.read_until("done", SECONDS)
        return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", shown.split("echo do")[0])

    def close(self):
        os.kill(self.pid, 9)
        os.waitpid(self.pid, 0)
        os.close(self.terminal)


class Fish:
    """Asks fish, which prints completions without a terminal."""

    def __init__(self, setup):
        self.setup = setup

    def complete(self, line):
        script = f"{self.setup}; complete -C '{line}'"
        return subprocess.run(["fish", "-c", script], capture_output=True, text=True, check=True).stdout

    def close(self):
        pass


def start(shell, folder, installed):
    if shell == "bash":
        file = BASH_COMPLETION if installed else f"{folder}/bash/bdpt"
        return InteractiveShell(["bash", "--norc", "-i"],
                                f"bind 'set enable-bracketed-paste off'; export XDG_DATA_DIRS={folder}; source {file}")
    if shell == "zsh":
        functions = "zsh/site-functions" if installed else "zsh"
        return InteractiveShell(["zsh", "-f", "-i"], f"setopt no_beep; LISTMAX=1000; fpath=({folder}/{functions} $fpath); "
                                "autoload -U compinit; compinit -u -D")
    if installed:  # fish completes only commands that exist
        return Fish(f"set PATH {folder}/../bin $PATH; set fish_complete_path {folder}/fish/vendor_completions.d")
    return Fish(f"source {folder}/fish/bdpt.fish")


def check_shell(shell, folder, installed):
    faults = []
    session = start(shell, folder, installed)
    for line, there, absent in CASES:
        shown = session.complete(line)
        words = set(re.findall(r"[\w.-]+", shown))
        for word in there:
            if word not in words:
                faults.append(f"{shell}: {line!r} does not offer {word}: {shown!r}")
        for word in absent:
            if word in words:
                faults.append(f"{shell}: {line!r} offers {word}: {shown!r}")
    session.close()
    return faults


def check_pages(folder):
    pages = sorted(pathlib.Path(folder, "man1").glob("*.1"))
    faults = [] if len(pages) >= 8 else [f"only {len(pages)} pages"]
    for page in pages:
        lint = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True)
        # Pages have no date, because every build regenerates them.
        said = [line for line in lint.stdout.splitlines() if "missing date" not in line]
        faults += said
        if re.search(r"\w\.\.(\s|$)", page.read_text()):
            faults.append(f"{page.name} has a sentence with two points")
    text = subprocess.run(["mandoc", "-T", "utf8", pathlib.Path(folder, "man1/bdpt-render.1")], capture_output=True,
                          text=True, check=True).stdout
    text = re.sub(r".\x08", "", text)
    for expected in ("-o, --output FILE", "--integrator pt|nee|mis", "EXIT STATUS", "bdpt render scene.gltf -o out.exr",
                     "--samples A:B"):
        if expected not in text:
            faults.append(f"bdpt-render.1 does not say {expected!r}")
    return faults


def main():
    installed = sys.argv[1] == "--installed"
    folder, shell = os.path.abspath(sys.argv[-2]), sys.argv[-1]
    program = "mandoc" if shell == "man" else shell
    if shutil.which(program) is None:
        print(f"skipped: {program} is not installed")
        return 77
    if installed and shell == "bash" and not os.path.exists(BASH_COMPLETION):
        print("skipped: bash-completion is not installed")
        return 77
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        os.mkdir("folder")
        pathlib.Path("scene.glb").touch()
        faults = check_pages(folder) if shell == "man" else check_shell(shell, folder, installed)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
