#!/usr/bin/env python3
"""A finger that another program moves: presses the skin slowly and prints what it felt.

Start Palpate first, then this:

    palpate simulate --realtime --device remote --out felt
    python3 examples/remote_finger.py

A datagram to 127.0.0.1:4730 says where the finger is, "p x y z" in mm from where its path would begin; while such poses
come, every tick of the servo is answered by the force on it, "f x y z" in N (docs/reference/remote.md). No library is
needed, nor a certain language. To another computer every message is signed by a key that both sides have:

    openssl rand -hex 32 > remote.key; chmod 600 remote.key    # copy it to both
    PALPATE_REMOTE_KEY_FILE=remote.key palpate simulate --realtime --device remote:0.0.0.0:4730 --out felt
    python3 examples/remote_finger.py --host 192.168.1.20 --key-file remote.key
"""
import argparse
import hashlib
import hmac
import os
import pathlib
import socket
import time

HELLO_BYTES = 192
SILENCE_S = 1.0  # after which the finger is free, and a new conversation is needed


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=4730)
    parser.add_argument("--key-file", type=pathlib.Path, help="the key that Palpate was started with")
    parser.add_argument("--depth-mm", type=float, default=20.0, help="how far down from the start")
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--wait", type=float, default=30.0, help="so long for somebody to listen, s")
    parser.add_argument("--rate-hz", type=float, default=500.0, help="poses a second; at least 100")
    return parser.parse_args()


class Plain:
    """Messages as they are: on this machine."""

    def sent(self, pose):
        return pose

    def received(self, message):
        return message.split()


class Signed:
    """Every message ends with its HMAC-SHA256; poses and answers count up within the conversation that a hello begins."""

    def __init__(self, key):
        self.key = key
        self.theirs, self.newest = None, 0
        self.greet()

    def greet(self):
        self.ours, self.heard, self.greeted = os.urandom(16).hex(), time.monotonic(), False

    def sign(self, text):
        return f"{text} {hmac.new(self.key, text.encode(), hashlib.sha256).hexdigest()}"

    def sent(self, pose):
        if time.monotonic() - self.heard > SILENCE_S:
            self.greet()
        if not self.greeted:
            return self.sign(f"hello {self.ours}").ljust(HELLO_BYTES)
        self.number += 1
        return self.sign(f"{pose} {self.theirs} {self.number}")

    def received(self, message):
        text, _, signature = message.decode("ascii", "replace").strip().rpartition(" ")
        if not hmac.compare_digest(self.sign(text).encode(), f"{text} {signature}".encode()):
            return []
        words = text.split()
        if words[:2] == ["challenge", self.ours] and len(words) == 4 and not self.greeted:
            if words[2] != self.theirs:
                self.theirs, self.newest = words[2], 0
            self.number, self.heard, self.greeted = int(words[3]), time.monotonic(), True
        elif len(words) == 6 and words[4] == self.theirs and int(words[5]) > self.newest:
            self.newest, self.heard = int(words[5]), time.monotonic()
            return [word.encode() for word in words[:4]]
        return []


def newest_force(link, speech, force):
    """The last answer that waits; some come for each pose."""
    while True:
        try:
            words = speech.received(link.recv(512))
        except (BlockingIOError, ConnectionRefusedError):
            return force
        if len(words) == 4 and words[0] == b"f":
            force = [float(word) for word in words[1:]]


def main():
    wanted = arguments()
    speech = Signed(wanted.key_file.read_bytes().strip()) if wanted.key_file else Plain()
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.setblocking(False)
    link.connect((wanted.host, wanted.port))
    force, hardest, answers = None, 0.0, 0
    started = time.monotonic()
    while (now := time.monotonic() - started) < (wanted.seconds if answers else wanted.wait):
        share = min(1.0, now / (0.8 * wanted.seconds)) if answers else 0.0  # down slowly, then hold
        try:
            link.send(speech.sent(f"p 0 0 {-wanted.depth_mm * share:.6f}").encode())
        except ConnectionRefusedError:
            pass  # nobody listens yet
        force = newest_force(link, speech, force)
        if force is not None:
            started = started if answers else time.monotonic()  # somebody listens now
            answers += 1
            hardest = max(hardest, sum(f * f for f in force) ** 0.5)
        time.sleep(1.0 / wanted.rate_hz)
    print(f"answered {answers} times, hardest {hardest:.3f} N")
    return 0 if answers > 0 else 1


if __name__ == "__main__":
    raise SystemExit(main())
