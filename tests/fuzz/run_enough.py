#!/usr/bin/env python3
"""Runs a target of libFuzzer until it has run enough inputs: run_enough.py FLOOR SECONDS PROGRAM ARGUMENT...

It runs for SECONDS, or FLOOR inputs where SECONDS is 0. Where that were fewer than FLOOR inputs, as on a busy machine,
it runs the rest, for five minutes in all: a target that needs longer is too slow to find anything, and this fails.
"""
import re
import subprocess
import sys
import time

LONGEST = 300  # [s]


def main():
    floor, seconds = int(sys.argv[1]), int(sys.argv[2])
    until = [f"-max_total_time={seconds}" if seconds > 0 else f"-runs={floor}"]
    end = time.monotonic() + LONGEST
    runs = 0
    while runs < floor:
        left = int(end - time.monotonic())
        if left <= 0:
            sys.exit(f"{runs} inputs in {LONGEST} s, but {floor} are needed to find anything")
        if runs > 0:
            until = [f"-runs={floor - runs}", f"-max_total_time={left}"]
        done = subprocess.run([sys.argv[3], *until, *sys.argv[4:]], stderr=subprocess.PIPE, text=True, errors="replace",
                              check=False)
        print(done.stderr, end="", flush=True)
        if done.returncode != 0:
            sys.exit(done.returncode)
        found = re.search(r"^stat::number_of_executed_units: +(\d+)", done.stderr, re.MULTILINE)
        if not found:
            sys.exit("the target did not count its runs (-print_final_stats=1)")
        runs += int(found.group(1))
    print(f"{runs} inputs")


if __name__ == "__main__":
    main()
