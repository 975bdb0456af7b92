"""Starts `bdpt view` for the tests, measures its resources, and sends requests by raw sockets."""

import pathlib
import re
import select
import signal
import socket
import subprocess
import sys
import time

SKIPPED = 77
PATIENCE = 60  # [s] to wait for an expected event


def expect(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")
    print(f"ok: {what}", flush=True)


def wait_for(condition, what):
    """Waits until a function returns a true value and returns it; fails the test after a timeout."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    sys.exit(f"failed: {what} (waited {PATIENCE} s)")


class Server:
    """Runs the server as a context manager. A `scene` without a folder is one of `folder`, else of this one."""

    def __init__(self, bdpt, scene, *options, port=0, folder=None):
        path = pathlib.Path(scene)
        scene = path.resolve() if folder is None or path.parent != pathlib.Path() else path
        self.process = subprocess.Popen([pathlib.Path(bdpt).resolve(), "view", str(scene), "--listen", f"127.0.0.1:{port}", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, bufsize=1, cwd=folder)
        self.url = self._read_address()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", self.url)
        expect(found, f"the command prints its address ({self.url})")
        self.port, self.token = int(found[1]), found[2]

    def _read_address(self):
        """Reads the first line of output."""
        if not select.select([self.process.stdout], [], [], PATIENCE)[0]:
            self.process.kill()
            sys.exit("failed: bdpt view prints no address")
        return self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        """Ends the process as Ctrl-C does, and returns the exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.process.stdout.close()
        return self.process.returncode

    def kill(self):
        self.process.kill()
        self.process.wait()

    @property
    def alive(self):
        return self.process.poll() is None

    # These report resources of the process, from Linux's /proc.

    def threads(self):
        return len(list(pathlib.Path(f"/proc/{self.process.pid}/task").iterdir()))

    def files(self):
        return len(list(pathlib.Path(f"/proc/{self.process.pid}/fd").iterdir()))

    def memory(self):
        """Returns the resident memory [MiB]."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text(encoding="utf-8")
        return int(re.search(r"VmRSS:\s+(\d+)", text)[1]) / 1024

    def listening(self):
        """Returns the addresses that its sockets listen on, as "127.0.0.1:80"; those of IPv6 in the digits of /proc."""
        inodes = set()
        for link in pathlib.Path(f"/proc/{self.process.pid}/fd").iterdir():
            try:
                found = re.fullmatch(r"socket:\[(\d+)\]", str(link.readlink()))
            except OSError:
                continue
            if found:
                inodes.add(found[1])
        addresses = []
        for table in ("tcp", "tcp6"):
            path = pathlib.Path("/proc/net", table)
            for line in path.read_text(encoding="utf-8").splitlines()[1:] if path.exists() else ():
                cells = line.split()
                if cells[3] == "0A" and cells[9] in inodes:
                    host, port = cells[1].split(":")
                    plain = ".".join(str(byte) for byte in reversed(bytes.fromhex(host))) if len(host) == 8 else host
                    addresses.append(f"{plain}:{int(port, 16)}")
        return addresses

    # These send requests.

    @property
    def host(self):
        return f"127.0.0.1:{self.port}"

    def connect(self, timeout=PATIENCE):
        return socket.create_connection(("127.0.0.1", self.port), timeout)

    def request(self, target, headers=None, method="GET", body=b""):
        """Returns status and body of an answer; the status is 0 without one. `headers` replace those of a browser."""
        lines = {"Host": self.host, "Connection": "close", **(headers or {})}
        text = f"{method} {target} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items() if v is not None) + "\r\n"
        try:
            with self.connect() as connection:
                connection.sendall(text.encode("latin-1") + body)
                return read_answer(connection)
        except ConnectionError:
            return 0, b""

    def path(self, name="", token=None):
        """Returns the path of a file of the server; "" is the page."""
        return f"/{self.token if token is None else token}/{name}"

    def get(self, name=""):
        """Returns the body of a file of the server."""
        status, body = self.request(self.path(name))
        expect(status == 200, f"{name or 'the page'} is served ({status} {body[:200] if status != 200 else ''})")
        return body


def received(connection):
    """Reads until the other side closes or resets."""
    parts = []
    while True:
        try:
            part = connection.recv(1 << 16)
        except (ConnectionError, socket.timeout):
            break
        if not part:
            break
        parts.append(part)
    return b"".join(parts)


def read_answer(connection):
    """Returns status and body of the answer; status 0 means that the connection was closed without one."""
    head, _, body = received(connection).partition(b"\r\n\r\n")
    found = re.match(rb"HTTP/1\.[01] (\d{3})", head)
    if found and re.search(rb"(?i)transfer-encoding: *chunked", head):
        body = decode_chunks(body)
    return int(found[1]) if found else 0, body


def decode_chunks(body):
    parts = []
    while True:
        size, _, body = body.partition(b"\r\n")
        count = int(size.split(b";")[0] or b"0", 16)
        if count == 0:
            return b"".join(parts)
        parts.append(body[:count])
        body = body[count + 2:]
