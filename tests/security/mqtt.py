"""An MQTT 5 client in plain Python, as a stranger would write one: enough of the protocol for the attacks on a class."""
import contextlib
import json
import socket
import ssl
import struct
import time
import uuid

CONNECT, CONNACK, PUBLISH, PUBACK, SUBSCRIBE, SUBACK, DISCONNECT = 1, 2, 3, 4, 8, 9, 14


def _length(size):
    out = b""
    while True:
        size, digit = divmod(size, 128)
        out += bytes([digit | (0x80 if size else 0)])
        if not size:
            return out


def _text(words):
    data = words.encode() if isinstance(words, str) else words
    return struct.pack(">H", len(data)) + data


class Client:
    """Connected with the certificate in `folder` (station.crt and .key, ...). Raises OSError when it is not let in."""

    def __init__(self, folder, port, client_id, role="station", clean=True, expiry_s=0, timeout_s=5.0):
        context = ssl.create_default_context(cafile=folder / "ca.crt")
        context.load_cert_chain(folder / f"{role}.crt", folder / f"{role}.key")
        self.socket = context.wrap_socket(socket.create_connection(("localhost", port), timeout=timeout_s),
                                          server_hostname="localhost")
        self._packet_id = 0
        self._left = b""
        properties = b"\x11" + struct.pack(">I", expiry_s) if expiry_s else b""
        self.send(CONNECT << 4, _text("MQTT") + b"\x05" + bytes([2 if clean else 0]) + struct.pack(">H", 30)
                  + _length(len(properties)) + properties + _text(client_id))
        kind, body = self.receive()
        if kind != CONNACK or body[1] != 0:
            raise OSError(f"not let in: packet {kind}, reason {body[1] if len(body) > 1 else '?'}")

        self.session_was_there = bool(body[0] & 1)

    def send(self, head, body):
        self.socket.sendall(bytes([head]) + _length(len(body)) + body)

    def _exactly(self, count):
        while len(self._left) < count:
            got = self.socket.recv(65536)
            if not got:
                raise OSError("the connection ended")
            self._left += got
        data, self._left = self._left[:count], self._left[count:]
        return data

    def receive(self):
        """The next packet: its kind and body."""
        kind = self._exactly(1)[0] >> 4
        size = shift = 0
        while True:
            digit = self._exactly(1)[0]
            size |= (digit & 0x7f) << shift
            shift += 7
            if digit < 0x80:
                return kind, self._exactly(size)

    def publish(self, topic, payload, wait=True):
        """At least once. With `wait` the broker's reason code; from 128 on it has refused the message."""
        self._packet_id = self._packet_id % 65535 + 1
        self.send(PUBLISH << 4 | 2, _text(topic) + struct.pack(">H", self._packet_id) + b"\x00" + payload)
        while wait:
            kind, body = self.receive()
            if kind == PUBACK:
                return body[2] if len(body) > 2 else 0
            if kind == DISCONNECT:
                raise OSError("the broker ended the connection")
        return 0

    def drain(self, count):
        """Takes so many acknowledgements."""
        for _ in range(count):
            self.receive()

    def alive(self):
        """Not ended by the broker so far."""
        self.socket.settimeout(0.2)
        try:
            return self.receive()[0] != DISCONNECT
        except (TimeoutError, socket.timeout):
            return True
        except OSError:
            return False
        finally:
            with contextlib.suppress(OSError):
                self.socket.settimeout(5.0)

    def close(self):
        with contextlib.suppress(OSError):
            self.socket.close()


def row(body, key=None):
    """A row's message, as a station sends it."""
    return json.dumps({"seq": 1, "id": key or str(uuid.uuid4()), "t": round(time.monotonic(), 3), "row": body}).encode()
