#!/usr/bin/env python3
"""Sends requests to `bdpt view` that it must refuse, by raw sockets: security_test.py BDPT SCENE.

Each refusal is one line, and the server keeps running."""

import json
import os
import pathlib
import random
import re
import shlex
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse

import web_socket
from served import Server, read_answer, expect, received, wait_for
from web_socket import WebSocket, handshake

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "apps" / "ids"))
from exr_file import ExrFile  # noqa: E402

CONNECTIONS = 10_000
AT_ONCE = 200  # far below the usual limit of 1024 open files; each connection takes two
MEBIBYTE = 1 << 20


def refused(answer, what, statuses=range(400, 500)):
    status, body = answer
    text = body.decode("utf-8", "replace")
    expect(status in statuses and text.strip() and text.strip().count("\n") == 0 and len(text) < 300,
           f"{what} is refused in one line: {status} {text.strip()[:120]}")


def check_loopback(server):
    addresses = server.listening()
    expect(addresses == [f"127.0.0.1:{server.port}"], f"it listens at the loopback address alone: {addresses}")


def check_page(server):
    with server.connect() as connection:
        connection.sendall(f"GET {server.path()} HTTP/1.1\r\nHost: {server.host}\r\nConnection: close\r\n\r\n".encode())
        head, _, body = received(connection).partition(b"\r\n\r\n")
    head = head.decode("latin-1").lower()
    expect(head.startswith("http/1.1 200") and b"</html>" in body, "the page is served")
    expect("access-control-allow" not in head, "no other page may read it")
    for header in ("content-security-policy:", "x-content-type-options: nosniff", "cache-control: no-store"):
        expect(header in head, f"it has the header {header}")
    outside = re.findall(rb"(?:src|href)\s*=\s*\"(?!#|data:)[^\"]*\"", body)
    expect(outside == [], f"and names nothing outside of itself {outside}")


def check_hosts(server):
    page = server.path()
    for host in ("evil.example", f"evil.example:{server.port}", f"127.0.0.1.evil.example:{server.port}", f"127.0.0.1:x{server.port}",
                 f"127.0.0.1:{server.port}@evil.example", "", None):
        refused(server.request(page, {"Host": host}), f"the host {host!r}")
    refused(server.request(server.path("save.exr"), {"Host": "evil.example"}), "another host of a saved picture")
    for origin in ("http://evil.example", "https://" + server.host, "null", f"http://127.0.0.1:{server.port}.evil.example", "http://127.0.0.1:1"):
        with server.connect() as connection:
            connection.sendall(handshake(server, server.token, {"Origin": origin}))
            refused(read_answer(connection), f"a web socket of the origin {origin}")


def check_tokens(server):
    good = server.token
    wrong = [None, "", good[:-1], good + "0", good[::-1], "0" * len(good), good.upper() if good != good.upper() else good.lower(),
             good[:-1] + ("0" if good[-1] != "0" else "1"), "%00" + good, good + "%00"]
    for token in wrong:
        for name in ("", "save.png", "save.exr", "save.json"):
            path = f"/{name}" if token is None else server.path(name, token)
            refused(server.request(path), f"{name or 'the page'} with the token {token if token is None else token[:6] + '...'}", (403, 404))
        with server.connect() as connection:
            connection.sendall(handshake(server, token))
            refused(read_answer(connection), "a web socket with it", (403, 404))
    with server.connect() as connection:
        connection.sendall(handshake(server, good))
        head = connection.recv(100)
    expect(head.startswith(b"HTTP/1.1 101"), f"a web socket with the token is opened {head[:40]}")


def check_paths(server):
    for name in ("../../../../etc/passwd", "%2e%2e/%2e%2e/%2e%2e/etc/passwd", "..%2f..%2f..%2fetc%2fpasswd", "/etc/passwd", "view.html",
                 "page/main.js", ".git/config", "save.exr/../../etc/passwd", "%00", "save.exr%00.png", "save", "favicon.ico", "socket/x",
                 "a/" * 1000):
        answer = server.request(server.path(name))
        refused(answer, f"the path {name[:40]}")
        expect(b"root:" not in answer[1], "and gives no file away")
    for path in ("/", "//", "/etc/passwd", "/../etc/passwd", f"/{server.token}", f"//{server.token}/", f"/x/../{server.token}/"):
        refused(server.request(path), f"the path {path.replace(server.token, 'TOKEN')}")
    for target in (f"http://evil.example{server.path()}", "*", "evil.example:80", ""):
        status, _ = server.request(target)
        expect(400 <= status < 500 or status == 0, f"the target {target[:24]!r} is refused ({status})")


def check_methods(server):
    for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT", "FOO"):
        refused(server.request(server.path(), method=method), f"the method {method}")


def send_repeatedly(connection, part, most):
    """Sends a part again and again until the other side closes; returns the number of bytes accepted."""
    sent = 0
    try:
        while sent < most:
            connection.sendall(part)
            sent += len(part)
    except (ConnectionError, socket.timeout):
        pass
    return sent


def check_bodies(server):
    before = server.memory()
    gigabyte = 1 << 30
    most = 64 * MEBIBYTE  # far above what sockets buffer
    for name, header, part in (("a gigabyte", f"Content-Length: {gigabyte}", bytes(65536)),
                               ("a chunked body", "Transfer-Encoding: chunked", b"10000\r\n" + bytes(65536) + b"\r\n"),
                               ("one larger than any number", f"Content-Length: {10 ** 30}", bytes(65536)),
                               ("a negative number of bytes", "Content-Length: -1", bytes(65536))):
        for method, file in (("POST", ""), ("GET", ""), ("POST", "save.exr")):
            with server.connect() as connection:
                connection.sendall(f"{method} {server.path(file)} HTTP/1.1\r\nHost: {server.host}\r\n{header}\r\n\r\n".encode())
                sent = send_repeatedly(connection, part, most)
                expect(sent < most, f"{method} {file or 'page'} with {name}: the connection is closed ({sent >> 10} KiB were sent)")
    expect(server.memory() < before + 64, f"memory does not grow with bodies ({before:.0f} to {server.memory():.0f} MiB)")
    with server.connect() as connection:
        connection.sendall(f"POST {server.path()} HTTP/1.1\r\nHost: {server.host}\r\nContent-Length: {gigabyte}\r\n\r\n".encode())
        refused(read_answer(connection), "a gigabyte that has not come yet")


def put(server, name="sky.hdr", body=b"", **headers):
    """Gives a file as the page does."""
    lines = {"Origin": f"http://{server.host}", "Content-Length": str(len(body)), **headers}
    return server.request(server.path(f"environment?name={urllib.parse.quote(name, safe='')}"), lines, "PUT", body)


def check_given_files(server):
    """Tests who may give an environment, and what the server does with it."""
    sky = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + bytes([200, 100, 50, 130] * 8)
    for what, answer in (("another origin", put(server, body=sky, Origin="http://evil.example")), ("no origin", put(server, body=sky, Origin=None)),
                         ("another host", put(server, body=sky, Host="evil.example")),
                         ("a wrong token", server.request(f"/{'0' * 32}/environment?name=a.hdr", {"Origin": f"http://{server.host}"}, "PUT")),
                         ("another path", server.request(server.path("save.exr?name=a.hdr"), {"Origin": f"http://{server.host}"}, "PUT"))):
        refused(answer, f"a file from {what}", (403, 405))
    for name in ("", "../x.hdr", "/etc/x.hdr", "a\\b.hdr", ".hidden", "none", "studio", "scene", "-", "a\nb.hdr", "a\0.hdr", "a" * 300 + ".hdr"):
        refused(put(server, name, sky), f"the name {name[:20]!r}", (400,))
    refused(server.request(server.path("environment?file=a.hdr"), {"Origin": f"http://{server.host}"}, "PUT"), "a file without a name", (400,))
    for what, lines in (("257 MiB", {"Content-Length": str(257 * MEBIBYTE)}), ("10^30 bytes", {"Content-Length": str(10 ** 30)})):
        refused(put(server, **lines), f"a file of {what}")
    with server.connect() as connection:  # whose size is not told
        connection.sendall(f"PUT {server.path('environment?name=a.hdr')} HTTP/1.1\r\nHost: {server.host}\r\nOrigin: http://{server.host}\r\n"
                           "Transfer-Encoding: chunked\r\n\r\n".encode())
        sent = send_repeatedly(connection, b"100000\r\n" + bytes(MEBIBYTE) + b"\r\n", 300 * MEBIBYTE)
        expect(sent < 300 * MEBIBYTE, f"one that does not end: the connection is closed ({sent >> 20} MiB were sent)")
    wait_for(lambda: put(server, body=b"")[0] != 503, "the next file is taken")
    with WebSocket(server) as window:
        before = window.state(lambda state: "environment" in state)
        status, text = put(server, "broken.hdr", sky[:-5])
        expect(status == 400 and b"broken.hdr" in text and b"/tmp" not in text and text.strip().count(b"\n") == 0, f"a broken file: {text}")
        expect(window.state(lambda state: state["message"])["environment"] == before["environment"], "changes nothing")
        status, text = put(server, "my sky.hdr", sky)
        expect(status == 200, f"a file is taken ({status} {text})")
        state = window.state(lambda state: state["environment"] == "my sky.hdr" and state["slots"][0]["done"])
        expect(state["message"] is None and "my sky.hdr" in state["environments"], "and chosen")
    expect("'--env=my sky.hdr'" in state["command"], f"the command has its own name: {state['command'][-120:]}")
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "my sky.hdr").write_bytes(sky)
        subprocess.run([server.process.args[0], *shlex.split(state["command"])[1:], "-o", "command.exr", "--quiet"], check=True, cwd=folder)
        pathlib.Path(folder, "saved.exr").write_bytes(server.get("save.exr"))
        of_command, of_page = (ExrFile(pathlib.Path(folder, name)) for name in ("command.exr", "saved.exr"))
        rows = [{name: [bytes(memoryview(row)) for row in rows] for name, rows in one.values.items()} for one in (of_command, of_page)]
        expect(rows[0] == rows[1], "and renders the same bits beside the file")
    expect(json.loads(server.get("save.json"))["env"] == "my sky.hdr", "so has the job")
    for i in range(12):
        expect(put(server, f"{i}.hdr", sky)[0] == 200, f"file {i} of many is taken")
    expect(1 <= len(given_files()) <= 8, f"but not all are kept: {len(given_files())}")


def given_files():
    """Returns the temporary copies of files that pages gave."""
    return list(pathlib.Path(os.environ["TMPDIR"]).glob("*/*.hdr"))


def check_headers(server):
    for name, text in (("a header of a megabyte", "X-Long: " + "a" * MEBIBYTE + "\r\n"),
                       ("100,000 headers", "".join(f"X-{i}: 1\r\n" for i in range(100_000))),
                       ("a line that goes on", "X: 1\r\n" + " 2\r\n" * 100_000)):
        with server.connect() as connection:
            sent = send_repeatedly(connection, f"GET {server.path()} HTTP/1.1\r\nHost: {server.host}\r\n{text}\r\n".encode(), 1)
            status, _ = read_answer(connection)
            expect(status in range(400, 500) or status == 0, f"{name} is refused ({status}, {sent} bytes sent)")
    status, _ = server.request(server.path("a" * MEBIBYTE))
    expect(status in range(400, 500) or status == 0, f"a target of a megabyte is refused ({status})")


def check_garbage(server):
    noise = random.Random(1)
    for name, data in (("random bytes", noise.randbytes(4096)), ("zeros", bytes(4096)), ("empty lines", b"\r\n" * 2000),
                       ("a greeting of TLS", bytes.fromhex("16030100c8010000c40303") + noise.randbytes(190)),
                       ("HTTP/0.9", b"GET /\r\n\r\n"), ("HTTP/2", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), ("HTTP/9.9", b"GET / HTTP/9.9\r\n\r\n"),
                       ("two hosts", f"GET {server.path()} HTTP/1.1\r\nHost: {server.host}\r\nHost: evil.example\r\n\r\n".encode()),
                       ("two lengths", b"POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n")):
        with server.connect(timeout=5) as connection:
            try:
                connection.sendall(data)
                connection.shutdown(socket.SHUT_WR)
            except OSError:
                pass
            status, _ = read_answer(connection)
            expect(status == 0 or 400 <= status < 500, f"{name}: refused ({status})")
    expect(server.alive, "the server is alive")


def check_many_connections(server):
    threads = server.threads()
    opened = 0
    while opened < CONNECTIONS:
        connections = []
        for i in range(AT_ONCE):
            try:
                connections.append(server.connect())
                if i % 2:
                    connections[-1].sendall(b"GET / HT")  # the rest is never sent
            except OSError:
                pass
        opened += AT_ONCE
        for connection in connections:
            # Resets the connection, so that no port waits for late packets.
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            connection.close()
    wait_for(lambda: server.request(server.path())[0] == 200, "the page is served again")
    expect(server.alive, f"{opened} connections in turns: the page is still served")
    wait_for(lambda: server.threads() <= threads + 4, "their threads end")
    wait_for(lambda: server.files() < 64, "their files are closed")


def check_half_open(server):
    """Tests that unfinished requests do not block others from the page for long."""
    held = []
    for i in range(300):
        connection = server.connect()
        connection.sendall((b"", b"G", b"GET / HTTP/1.1\r\n", b"GET / HTTP/1.1\r\nHost: ")[i % 4])
        held.append(connection)
        if i % 50 == 49:  # not after they have timed out
            expect(server.request(server.path())[0] == 200, f"with {i + 1} connections half open the page is served at once")
    with WebSocket(server) as window:
        expect(window.state()["size"], "and a web socket is opened")
    windows, refusal = [], ""
    while len(windows) < 100 and not refusal:
        try:
            windows.append(WebSocket(server))
        except (RuntimeError, ConnectionError) as error:
            refusal = str(error)
    expect(32 < len(windows) <= 64 and "503" in refusal, f"after {len(windows)} windows no more are opened: {refusal}")
    for connection in [*windows, *held]:
        connection.close()


def send_socket_frame(server, name, payload, kind=web_socket.TEXT):
    """Sends a frame to a web socket, which may answer with an error or close."""
    with WebSocket(server) as window:
        try:
            window.send_frame(kind, payload)
            sequence = window.ask(set={})
            while True:
                message = window.receive()
                if isinstance(message, dict) and message.get("ack") == sequence:
                    outcome = "goes on"
                    break
                if isinstance(message, dict) and "error" in message:
                    expect("\n" not in message["error"], f"{name}: {message['error'][:100]}")
        except (ConnectionError, OSError):
            outcome = "is closed"
    expect(server.alive, f"{name}: the web socket {outcome}, the server is alive")


def check_socket(server):
    deep = b'{"seq":7,"set":' + b'{"a":' * 20_000 + b"1" + b"}" * 20_000 + b"}"
    for name, payload in (("no JSON", b"hello"), ("not text", b"\xff\xfe\xfd"), ("an array", b"[1,2]"), ("a number", b"5"), ("deep JSON", deep),
                          ("no request", b'{"seq":7}'), ("another request", b'{"seq":7,"format_disk":true}'),
                          ("a sequence that is a text", b'{"seq":"x","reset":true}'), ("a negative sequence", b'{"seq":-1,"reset":true}')):
        send_socket_frame(server, name, payload)
    send_socket_frame(server, "binary data", random.Random(2).randbytes(1000), web_socket.BINARY)
    wrong = [{"move": "x"}, {"move": {"orbit": [1], "pan": [0, 0], "dolly": 1}}, {"move": {"orbit": [1e300, 0], "pan": [0, 0], "dolly": 1}},
             {"move": {"orbit": [0, 0], "pan": [0, 0], "dolly": 0}}, {"move": {"orbit": [0, 0], "pan": [0, 0], "dolly": -1}},
             {"move": {"orbit": [0, 0], "pan": [0, 0], "dolly": 1e300}}, {"move": {"orbit": [None, 0], "pan": [0, 0], "dolly": 1}},
             {"focus": [-1, 0]}, {"focus": [10 ** 9, 0]}, {"focus": [64, 0]}, {"inspect": [0, 48]}, {"focus": "x"}, {"inspect": [0, 10 ** 6]}, {"inspect": [0, 0], "sample": -1},
             {"inspect": {"x": 1}}, {"set": {"integrator_a": "no such"}}, {"set": {"integrator_a": 5}}, {"set": {"integrator_b": "../x"}},
             {"set": {"environment": "/etc/passwd"}}, {"set": {"environment": "../../secret.exr"}}, {"set": {"rotation": "x"}},
             {"set": {"rotation": 1e300}}, {"set": {"intensity": -1}}, {"set": {"intensity": 1e300}}, {"set": {"exposure": "bright"}},
             {"set": {"exposure": 1e300}}, {"set": {"curve": "sepia"}}, {"set": {"paused": 3}}, {"set": {"layer": "secret"}},
             {"set": {"camera": "../x"}}, {"set": {"variant": "/etc/passwd"}}, {"set": {"animation": 3}}, {"set": {"time": 1e300}},
             {"set": {"fov": 0}}, {"set": {"f_stop": -1}}, {"set": {"background": "/etc/passwd"}}, {"set": {"background": "../secret.png"}},
             {"set": {"ground": "shadow"}}, {"set": {"denoise": 3}}, {"focus": [1, 1], "turn": "no"}, {"set": {"strategy": [99, 99]}}, {"set": {"strategy": "x"}}, {"set": {"unknown": 1}}]
    with WebSocket(server) as window:
        before = window.state()
        for request in wrong:
            answer = window.answer(window.ask(**request))
            expect("error" in answer and "\n" not in answer["error"] and len(answer["error"]) < 300,
                   f"{json.dumps(request)[:80]}: {answer.get('error')}")
    with WebSocket(server) as window:
        after = window.state()
        kept = ("camera", "integrator_a", "integrator_b", "environment", "rotation", "intensity", "curve", "layer", "paused", "background", "ground",
                "variant", "animation", "time")
        expect(all(before[key] == after[key] for key in kept), "none of them changed anything")
    check_frames(server)


def is_ended(connection):
    """Tests whether the server ends a connection before its web socket would time out."""
    end = time.monotonic() + 20
    connection.settimeout(20)
    try:
        while time.monotonic() < end:
            if not connection.recv(1 << 16):
                return True
    except ConnectionError:
        return True  # reset
    except TimeoutError:
        pass
    return False


def check_frames(server):
    """Tests that frames that violate the protocol close the web socket."""
    text = b'{"seq":1,"reset":true}'
    for name, frame in (("a frame without a mask", bytes([0x81, len(text)]) + text),
                        ("a frame of a gigabyte", bytes([0x81, 0xff]) + struct.pack(">Q", 1 << 30) + bytes(4) + bytes(65536)),
                        ("a frame of 2^63 bytes", bytes([0x81, 0xff]) + struct.pack(">Q", 1 << 63) + bytes(4)),
                        ("a reserved kind", bytes([0x83, 0x80]) + bytes(4)), ("reserved bits", bytes([0xf1, 0x80]) + bytes(4)),
                        ("a long ping", bytes([0x89, 0xfe]) + struct.pack(">H", 1000) + bytes(4) + bytes(1000))):
        with WebSocket(server) as window:
            before = server.memory()
            window.connection.sendall(frame)
            try:
                while True:
                    window.receive()
            except (ConnectionError, OSError):
                pass
            expect(server.alive and server.memory() < before + 64, f"{name}: the web socket is closed")
            expect(is_ended(window.connection), f"{name}: the connection ends, although the other side keeps it")


def check_opened_address(bdpt, scene):
    """Tests the address on the command line of the browser, which other users of the machine can see."""
    with tempfile.TemporaryDirectory() as folder:
        browser, seen = pathlib.Path(folder, "xdg-open"), pathlib.Path(folder, "seen")
        browser.write_text(f'#!/bin/sh\necho "$@" > {seen}.new\nmv {seen}.new {seen}\n')
        browser.chmod(0o755)
        path, os.environ["PATH"] = os.environ["PATH"], f"{folder}:{os.environ['PATH']}"
        with Server(bdpt, scene, "--size", "64x48", "--spp", "4", "--open") as server:
            os.environ["PATH"] = path
            address = wait_for(lambda: seen.exists() and seen.read_text().strip(), "the browser is started")
            expect(server.token not in address and address.startswith(f"http://{server.host}/"), "its address has not the token")
            target = address.removeprefix(f"http://{server.host}")
            refused(server.request(target, {"Host": "evil.example"}), "another host of it")
            with server.connect() as connection:
                connection.sendall(f"GET {target} HTTP/1.1\r\nHost: {server.host}\r\n\r\n".encode())
                head = received(connection).decode("latin-1")
            expect(head.startswith("HTTP/1.1 303") and f"Location: {server.path()}\r\n" in head, "it leads to the page")
            refused(server.request(target), "the same once more", (403,))


def main():
    bdpt, scene = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as temporary:
        os.environ["TMPDIR"] = temporary
        check_all(bdpt, scene)
        expect(given_files() == [], "no file that a page gave is left")


def check_all(bdpt, scene):
    with Server(bdpt, scene, "--size", "64x48", "--spp", "4") as server:
        for check in (check_loopback, check_page, check_hosts, check_tokens, check_paths, check_methods, check_bodies, check_headers,
                      check_garbage, check_given_files, check_half_open, check_socket, check_many_connections):
            print(f"-- {check.__name__}", flush=True)
            check(server)
        check_page(server)
        expect(server.stop() == 0, "Ctrl-C ends it with exit code 0")
    check_opened_address(bdpt, scene)


if __name__ == "__main__":
    main()
