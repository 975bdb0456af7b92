#!/usr/bin/env python3
"""Tests many moves, and windows that close or do not read, for leaks and delays: load_test.py BDPT SCENE. Needs no
browser."""

import struct
import sys
import tempfile

from served import Server, expect, wait_for
from web_socket import WebSocket

SAMPLES = 4
MOVES = 1000
MOST_GROWTH = 32  # [MiB]


def parse_header(message):
    """Parses the header of a pixel message to a dictionary."""
    names = ("version", "slot", "generation", "sequence", "grid_width", "grid_height", "x", "y", "width", "height", "samples", "channels", "denoised")
    return dict(zip(names, struct.unpack_from("<13I", message)))


def wait_until_finished(window):
    """Waits until all samples are rendered; returns the state."""
    return window.state(lambda state: "slots" in state and all(slot["done"] for slot in state["slots"]))


def wait_for_move(window, sequence):
    """Waits for pixels that show a move; returns their header."""
    while True:
        message = window.receive()
        if isinstance(message, bytes):
            found = parse_header(message)
            if found["sequence"] >= sequence:
                return found


def move(window, i=0):
    return window.ask(move={"orbit": [0.01 if i % 2 else -0.01, 0], "pan": [0, 0], "dolly": 1})


def check_pixels(server):
    """Tests that sizes of messages match their headers, and that the last one is the whole picture."""
    with WebSocket(server) as window:
        size = window.state(lambda state: "size" in state)["size"]
        while True:
            message = window.receive()
            if not isinstance(message, bytes):
                continue
            found = parse_header(message)
            expect(found["version"] == 3 and len(message) == 52 + 2 * found["channels"] * found["width"] * found["height"]
                   and found["x"] + found["width"] <= found["grid_width"] and found["y"] + found["height"] <= found["grid_height"],
                   f"an update of {found['grid_width']}x{found['grid_height']} pixels after {found['samples']} samples")
            if [found["grid_width"], found["grid_height"]] == size and found["samples"] == SAMPLES:
                break


def check_two_windows(server):
    with WebSocket(server) as first, WebSocket(server) as second:
        before = wait_until_finished(first)
        wait_until_finished(second)
        wait_for_move(first, move(first))
        after = second.state(lambda state: state["camera"] != before["camera"])
        expect(after["camera"]["from"] != before["camera"]["from"], "what one window turns, the other sees")
        wait_for_move(second, move(second))
        expect(wait_until_finished(first)["slots"][0]["samples"] == SAMPLES, "and both see all samples")


def check_slow_reader(server):
    """Tests that a window that reads nothing delays neither the render nor the other windows, and that its pictures do
    not accumulate."""
    with WebSocket(server, small_buffer=True) as slow, WebSocket(server) as quick:
        wait_until_finished(quick)
        memory = server.memory()
        for i in range(40):
            move(slow, i)
            wait_for_move(quick, move(quick, i))
        expect(wait_until_finished(quick)["slots"][0]["samples"] == SAMPLES, "beside a window that does not read, another one sees 40 moves")
        expect(server.memory() < memory + MOST_GROWTH, f"nothing piles up ({memory:.0f} to {server.memory():.0f} MiB)")
    with WebSocket(server) as window:
        wait_until_finished(window)


def check_closed_windows(server):
    """Tests windows that close while pixels arrive."""
    threads, files = server.threads(), server.files()
    for i in range(50):
        with WebSocket(server) as window:
            if i % 2:
                window.receive()
            move(window, i)
    with WebSocket(server) as window:
        wait_until_finished(window)
    wait_for(lambda: server.threads() <= threads and server.files() <= files, "50 windows that closed leave neither threads nor files")
    expect(server.alive, "50 windows close in the middle: the server is alive, without their threads and files")


def check_moves(server):
    def moves(window, count):
        for i in range(count):
            window.answer(move(window, i))

    with WebSocket(server) as window:
        wait_until_finished(window)
        moves(window, 200)  # allocates what is allocated once
        wait_until_finished(window)
        threads, files, memory = server.threads(), server.files(), server.memory()
        moves(window, MOVES)
        wait_for_move(window, move(window))
        wait_until_finished(window)
        wait_for(lambda: server.threads() <= threads and server.files() <= files, "threads and files end")
        grown = server.memory() - memory
        expect(grown < MOST_GROWTH, f"{MOVES} moves leave no threads, files and memory ({grown:+.1f} MiB of {memory:.0f})")


def main():
    bdpt, scene = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder, Server(bdpt, scene, "--size", "80x60", "--spp", str(SAMPLES), folder=folder) as server:
        for check in (check_pixels, check_two_windows, check_slow_reader, check_closed_windows, check_moves):
            print(f"-- {check.__name__}", flush=True)
            check(server)
        expect(server.stop() == 0, "Ctrl-C ends it with exit code 0")


if __name__ == "__main__":
    main()
