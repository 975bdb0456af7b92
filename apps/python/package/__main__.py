"""python -m bdpt is the command bdpt."""

from bdpt._command import main

main()
