"""Implements the subset of a web socket client [RFC 6455] that the tests of bdpt view need."""

import base64
import json
import os
import socket
import struct

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


def handshake(server, token, headers=None):
    """Returns the opening request of a web socket."""
    lines = {"Host": server.host, "Origin": f"http://{server.host}", "Upgrade": "websocket", "Connection": "Upgrade",
             "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), **(headers or {})}
    path = "/socket" if token is None else f"/{token}/socket"
    return (f"GET {path} HTTP/1.1\r\n" + "".join(f"{k}: {v}\r\n" for k, v in lines.items() if v is not None)
            + "\r\n").encode()


class WebSocket:
    """Imitates a window of the page, without a browser."""

    def __init__(self, server, small_buffer=False):
        self.connection = server.connect()
        if small_buffer:
            self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.connection.sendall(handshake(server, server.token))
        self.data = b""
        while b"\r\n\r\n" not in self.data:
            self._more()
        head, _, self.data = self.data.partition(b"\r\n\r\n")
        if not head.startswith(b"HTTP/1.1 101"):
            raise RuntimeError(f"no web socket: {head[:80]}")
        self.sequence = 0

    def close(self):
        self.connection.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _more(self):
        part = self.connection.recv(1 << 16)
        if not part:
            raise ConnectionError("the server closed the web socket")
        self.data += part

    def _take(self, count):
        while len(self.data) < count:
            self._more()
        result, self.data = self.data[:count], self.data[count:]
        return result

    def send_frame(self, kind, payload):
        mask = os.urandom(4)
        size = len(payload)
        head = bytes([0x80 | kind]) + (bytes([0x80 | size]) if size < 126 else bytes([0xfe]) + struct.pack(">H", size)
                                       if size < 65536 else bytes([0xff]) + struct.pack(">Q", size))
        self.connection.sendall(head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload)))

    def ask(self, **what):
        """Sends a request; returns its number."""
        self.sequence += 1
        self.send_frame(TEXT, json.dumps({"seq": self.sequence, **what}).encode())
        return self.sequence

    def receive(self):
        """Returns the next message: a dictionary, or bytes of pixels. Answers pings."""
        parts, kind = b"", None
        while True:
            first, second = self._take(2)
            size = second & 127
            if size == 126:
                size = struct.unpack(">H", self._take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self._take(8))[0]
            payload = self._take(size)
            opcode = first & 15
            if opcode == PING:
                self.send_frame(PONG, payload)
            elif opcode == CLOSE:
                raise ConnectionError("the server closed the web socket")
            elif opcode != PONG:
                kind = opcode or kind
                parts += payload
                if first & 128:
                    return json.loads(parts) if kind == TEXT else parts

    def answer(self, sequence):
        """Waits for the answer to a request; drops earlier messages."""
        while True:
            message = self.receive()
            if isinstance(message, dict) and message.get("ack") == sequence:
                return message

    def state(self, wanted=lambda state: True):
        """Returns the next state for which `wanted` holds."""
        while True:
            message = self.receive()
            if isinstance(message, dict) and "state" in message and wanted(message["state"]):
                return message["state"]
