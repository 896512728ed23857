"""A client of `palpate serve` that shares no code with it, for tools/check-serve and tools/check-programs."""
import base64
import json
import os
import socket
import struct
import time

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Stream:
    """A WebSocket by hand: frames are counted, pings answered, texts kept."""

    def __init__(self, port, token):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=30)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET /served/contacts HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n"
                             f"Sec-WebSocket-Protocol: palpate.1, palpate.token.{token}\r\n\r\n").encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            got = self.socket.recv(4096)
            if not got:
                raise ConnectionError("the server hung up")
            self.bytes += got
        head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        if b" 101 " not in head:
            raise ConnectionError(head.decode(errors="replace"))
        self.frames = self.size = 0
        self.texts = []
        self.closed = False

    def take(self):
        """What has come; waits for something."""
        got = self.socket.recv(65536)
        if not got:
            raise ConnectionError("the server hung up")
        self.bytes += got
        self.size += len(got)
        self.read()

    def read(self):
        while len(self.bytes) >= 2:
            begin, length = 2, self.bytes[1] & 127
            if length >= 126:
                begin = 4 if length == 126 else 10
                if len(self.bytes) < begin:
                    return
                length = struct.unpack(">H" if begin == 4 else ">Q", self.bytes[2:begin])[0]
            if len(self.bytes) < begin + length:
                return
            self.hear(self.bytes[0] & 15, self.bytes[begin:begin + length])
            self.bytes = self.bytes[begin + length:]

    def hear(self, kind, payload):
        if kind == BINARY:
            self.frames += 1
        elif kind == PING:
            self.send(PONG, payload)
        elif kind == TEXT:
            self.texts = [*self.texts[-99:], json.loads(payload)]
        elif kind == CLOSE:
            self.closed = True

    def wait_for(self, right, patience_s=30.0):
        """The first text that is right; None where it does not come in time, or the stream ends."""
        end = time.monotonic() + patience_s
        self.read()
        while True:
            for text in self.texts:
                if right(text):
                    return text
            left = end - time.monotonic()
            if self.closed or left <= 0:
                return None
            self.socket.settimeout(left)
            try:
                self.take()
            except OSError:  # silent, or gone
                return None

    def say(self, **message):
        self.send(TEXT, json.dumps(message).encode())

    def send(self, kind, payload):
        head = bytes([0x80 | kind])
        head += bytes([0x80 | len(payload)]) if len(payload) < 126 else bytes([0xFE]) + struct.pack(">H", len(payload))
        self.socket.sendall(head + bytes(4) + payload)

    def close(self):
        self.socket.close()
