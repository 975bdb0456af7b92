"""Receives the image of a running `bdpt render --display` by the protocol of tev."""

import socket
import struct
import threading

import numpy as np

CREATE_IMAGE, UPDATE_IMAGE = 4, 6


class LiveImage:
    """Listens on a loopback port. `take()` returns the latest image."""

    def __init__(self):
        self._server = socket.create_server(("127.0.0.1", 0))
        self._server.settimeout(0.2)
        self.address = f"127.0.0.1:{self._server.getsockname()[1]}"
        self._lock = threading.Lock()
        self._pixels, self._changed, self._closed = None, False, False
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def take(self):
        """Returns the image as (height, width, 3), row 0 on top, if it has changed since the last call; else None."""
        with self._lock:
            changed, self._changed = self._changed, False
            return self._pixels.copy() if changed else None

    def close(self):
        self._closed = True
        self._thread.join()
        self._server.close()

    def _serve(self):
        while not self._closed:
            try:
                connection = self._server.accept()[0]
            except OSError:
                continue
            with connection, connection.makefile("rb") as stream:
                connection.settimeout(None)
                try:
                    while message := self._message(stream):
                        self._take_message(message)
                except (OSError, ValueError, struct.error):
                    pass  # a preview may break off

    @staticmethod
    def _message(stream):
        length = stream.read(4)
        return stream.read(struct.unpack("<I", length)[0] - 4) if len(length) == 4 else b""

    def _take_message(self, message):
        at = message.index(b"\0", 2) + 1  # skips kind, flag and name
        if message[0] == CREATE_IMAGE:
            width, height = struct.unpack_from("<ii", message, at)
            with self._lock:
                self._pixels = np.zeros((height, width, 3), np.float32)
        elif message[0] == UPDATE_IMAGE and self._pixels is not None:
            at += 4
            for _ in range(3):
                at = message.index(b"\0", at) + 1
            x, y, width, height = struct.unpack_from("<4i", message, at)
            rows = np.frombuffer(message, "<f4", width * height * 3, at + 16 + 2 * 3 * 8)
            with self._lock:
                self._pixels[y:y + height, x:x + width] = rows.reshape(height, width, 3)
                self._changed = True
