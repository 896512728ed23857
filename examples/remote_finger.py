#!/usr/bin/env python3
"""A finger that another program moves: presses the skin slowly and prints what it felt.

Start Palpate first, then this:

    palpate simulate --realtime --device remote --out felt
    python3 examples/remote_finger.py

A datagram to 127.0.0.1:4730 says where the finger is, "p x y z" in mm from where its path would begin; every tick of the
servo is answered by the force on it, "f x y z" in N (docs/remote.md). No library is needed, nor a certain language.
"""
import argparse
import socket
import time


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, default=4730)
    parser.add_argument("--depth-mm", type=float, default=20.0, help="how far down from the start")
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--wait", type=float, default=30.0, help="so long for somebody to listen, s")
    parser.add_argument("--rate-hz", type=float, default=500.0, help="poses a second; at least 100")
    return parser.parse_args()


def newest_force(link, force):
    """The last answer that waits; answers come once a tick, whether a pose came or not."""
    while True:
        try:
            words = link.recv(256).split()
        except (BlockingIOError, ConnectionRefusedError):
            return force
        if len(words) == 4 and words[0] == b"f":
            force = [float(word) for word in words[1:]]


def main():
    wanted = arguments()
    link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    link.setblocking(False)
    link.connect(("127.0.0.1", wanted.port))
    force, hardest, answers = None, 0.0, 0
    started = time.monotonic()
    while (now := time.monotonic() - started) < (wanted.seconds if answers else wanted.wait):
        share = min(1.0, now / (0.8 * wanted.seconds)) if answers else 0.0  # down slowly, then hold
        try:
            link.send(f"p 0 0 {-wanted.depth_mm * share:.6f}\n".encode())
        except ConnectionRefusedError:
            pass  # nobody listens yet
        force = newest_force(link, force)
        if force is not None:
            started = started if answers else time.monotonic()  # somebody listens now
            answers += 1
            hardest = max(hardest, sum(f * f for f in force) ** 0.5)
        time.sleep(1.0 / wanted.rate_hz)
    print(f"answered {answers} times, hardest {hardest:.3f} N")
    return 0 if answers > 0 else 1


if __name__ == "__main__":
    raise SystemExit(main())
