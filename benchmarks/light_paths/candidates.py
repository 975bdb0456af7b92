"""The numbers of light paths and connections that `auto` chooses from, as its source lists them."""

import pathlib
import re

HEADER = pathlib.Path(__file__).resolve().parents[2] / "lib/src/pilot/candidates.h"


def read_candidates():
    """Returns (light paths, connections, connection rays) of each candidate; the first, without light paths, is mis."""
    found = re.findall(r"Candidate\{([\d., ]+)\}", HEADER.read_text())
    return [tuple(float(number) for number in (*each.split(","), "0")[:3]) for each in found]
