"""A desktop of its own: an X server without a screen whose picture can be read, a window of Palpate in it from a fresh
HOME, and hands (xdotool) that press real keys and buttons. What is waited for is a line that the program prints
(`palpate run --verbose`), never a time; where a control is, it says itself. Counterpart of engine/cli/tests/desktop/desktop.h."""
import os
import pathlib
import queue
import shutil
import signal
import struct
import subprocess
import tempfile
import threading
import time

WIDTH, HEIGHT = 1600, 1000
PATIENCE_S = 30.0


class Gone(Exception):
    """What was waited for did not come."""


def missing():
    """The programs that are needed and not there."""
    return [name for name in ("Xvfb", "xdotool") if shutil.which(name) is None]


class Desktop:
    """An X server, as long as the `with` lasts."""

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="palpate-desktop-"))
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp", "-fbdir",
             str(self.folder)], pass_fds=(write,), stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.display = ":" + answer.readline().strip()
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def environment(self, home):
        kept = {name: value for name, value in os.environ.items()
                if not name.startswith("XDG_") and name != "WAYLAND_DISPLAY"}
        return kept | {"DISPLAY": self.display, "HOME": str(home), "LIBGL_ALWAYS_SOFTWARE": "1", "LP_NUM_THREADS": "2",
                       "PALPATE_SPEECH": "off"}

    def xdotool(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       env=os.environ | {"DISPLAY": self.display})

    def windows(self):
        """How many of this program are open."""
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Palpate"], env=self.environment("/nowhere"),
                               capture_output=True, text=True, check=False)
        return len(found.stdout.split())

    def picture(self):
        """What is on the screen: rows from top to bottom, four bytes a pixel, the fourth of no meaning."""
        data = (self.folder / "Xvfb_screen0").read_bytes()  # an XWD file, which the server writes into
        header_size, colours = struct.unpack(">I", data[:4])[0], struct.unpack(">I", data[76:80])[0]
        row_bytes = struct.unpack(">I", data[48:52])[0]
        begin = header_size + 12 * colours
        return [data[begin + y * row_bytes:begin + y * row_bytes + 4 * WIDTH] for y in range(HEIGHT)]

    def is_black(self):
        return not any(any(row[0::4]) or any(row[1::4]) for row in self.picture()[::20])

    def save(self, file):
        """What is on the screen, as PPM."""
        with open(file, "wb") as out:
            out.write(b"P6 %d %d 255\n" % (WIDTH, HEIGHT))
            for row in self.picture():
                pixels = bytearray(3 * WIDTH)
                pixels[0::3], pixels[1::3], pixels[2::3] = row[2::4], row[1::4], row[0::4]
                out.write(pixels)


class Window:
    """A program with a window, read line by line. Actions are counted: a key, a letter, a click, a drag."""

    def __init__(self, desktop, command, home, folder):
        self.desktop, self.actions = desktop, 0
        self.started = time.monotonic()
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, env=desktop.environment(home), cwd=folder)
        self.lines = queue.Queue()
        self.frame, self.controls, self.screen, self.page_s, self.frames = {}, {}, "", None, []
        self.focused = False
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            self.lines.put((time.monotonic(), line.decode("utf-8", "replace").rstrip("\n")))
        self.lines.put((time.monotonic(), None))

    def _take(self, at, line):
        if line.startswith("frame "):
            head, _, message = line.partition(" message=")
            self.frame = dict(word.split("=", 1) for word in head.split()[2:]) | {"message": message}
            self.frames.append((at, float(self.frame["depth"]), self.frame["pressed"] == "1"))
        elif line.startswith("control "):
            words = line.split(" ")
            if words[-1] == "gone":
                self.controls.pop(" ".join(words[1:-1]), None)
            else:
                self.controls[" ".join(words[1:-4])] = tuple(float(word) for word in words[-4:])
        elif line.startswith("screen"):
            self.screen = line
        elif line.startswith("start page after"):
            self.page_s = at - self.started

    def until(self, ready, what, patience_s=None):
        """Reads lines until it is so; returns the time since the start. Throws Gone."""
        patience_s = PATIENCE_S if patience_s is None else patience_s
        end = time.monotonic() + patience_s
        while True:
            try:
                at, line = self.lines.get(timeout=0.02)
            except queue.Empty:  # a window that has nothing to say is ready or not all the same
                at, line = time.monotonic(), ""
            if line is None:
                raise Gone(f"{what}: the program ended: {self.process.stderr.read().decode()[-300:]}")
            self._take(at, line)
            if not self.focused and line:
                self._focus()
            if ready():
                return at - self.started
            if time.monotonic() > end:
                raise Gone(f"{what}: did not come within {patience_s:g} s ({self.frame.get('message', '')})")

    def pause(self, seconds):
        """Lets the program draw for so long."""
        end = time.monotonic() + seconds
        try:
            self.until(lambda: time.monotonic() > end, "a pause", seconds + 10.0)
        except Gone:
            pass

    def _focus(self):
        # Without a window manager nobody gives the window the focus.
        try:
            self.desktop.xdotool("search", "--onlyvisible", "--name", "Palpate", "windowfocus", "--sync")
            self.focused = True
        except subprocess.CalledProcessError:
            pass

    def number(self, name):
        return float(self.frame.get(name, "0"))

    def has(self, control):
        return control in self.controls

    def key(self, *keys):
        for key in keys:
            self.actions += 1
            self.desktop.xdotool("key", "--clearmodifiers", key)

    def type(self, text):
        self.actions += len(text)
        self.desktop.xdotool("type", "--clearmodifiers", "--delay", "8", text)

    def place_of(self, control):
        """Where it has come to rest: a dialog is laid out in two pictures."""
        self.until(lambda: self.has(control), f"the control {control}")
        for _ in range(20):
            before = self.controls.get(control)
            self.pause(0.1)
            if before and self.controls.get(control) == before:
                break
        self.until(lambda: self.has(control), f"the control {control}")
        left, top, right, below = self.controls[control]
        return round((left + right) / 2), round((top + below) / 2)

    def click(self, control, at_share=0.5):
        """On a control, by its name."""
        self.place_of(control)
        left, top, right, below = self.controls[control]
        self.click_at(round(left + at_share * (right - left)), round((top + below) / 2))

    def click_at(self, x, y):
        self.actions += 1
        self.desktop.xdotool("mousemove", x, y, "click", 1)

    def press_at(self, x, y):
        self.actions += 1
        self.desktop.xdotool("mousemove", x, y, "mousedown", 1)

    def lift(self):
        self.desktop.xdotool("mouseup", 1)

    def move(self, x, y):
        self.desktop.xdotool("mousemove", x, y)

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(15)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()


class Fresh:
    """A HOME and a working folder that nobody has used."""

    def __enter__(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="palpate-fresh-"))
        self.home, self.folder = self.root / "home", self.root / "work"
        self.home.mkdir()
        self.folder.mkdir()
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.root, ignore_errors=True)
