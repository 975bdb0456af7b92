"""Starts the command bdpt of a wheel, the program beside this file: bdpt, or python -m bdpt."""

import os
import pathlib
import sys


def main() -> None:
    program = pathlib.Path(__file__).resolve().with_name("bdpt")
    os.execv(program, ["bdpt", *sys.argv[1:]])


if __name__ == "__main__":
    main()
