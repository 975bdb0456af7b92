"""Runs the command bdpt, by python -m bdpt."""

from bdpt._command import main

main()
