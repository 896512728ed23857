"""The eight tasks of a user's first minute, each in a real window from a fresh HOME. Where the window cannot do one yet,
its row says why."""
import dataclasses
import math
import struct
import time

import desktop
from desktop import HEIGHT, WIDTH, Fresh, Gone, Window


# The middle of the back, beside the panel, as the first view of 1600 x 1000 shows it.
OVER_BACK = (960, 430)
# The same in the window of the training, which is 1280 x 800 and has its panel on the right.
OVER_TRAINED_BACK = (500, 480)


@dataclasses.dataclass
class Task:
    name: str
    actions: int
    seconds: float
    done: bool
    old_actions: int = 0  # of version 0.2.0, before there was a start page; see OLD
    old_way: str = ""
    reason: str = ""


# What the same needed in version 0.2.0, whose window had no start page: counted by its documents, not measured. A
# command line counts as one action, whatever its length.
OLD = {
    "touch T6": (3, "names (I), wheel until they can be told apart, press by eye"),
    "open my STL": (2, "Ctrl+O, a click on the file"),
    "dysfunction at T9 left, saved": (5, "names (I), editor (E), click by eye, wheel for its size, Ctrl+S; without words"),
    "train one practice block": (1, "another command, `palpate train`; then as many as now"),
    "measure a pair": (5, "Ctrl+M, twice a button and a file; not from a start page"),
    "start a class and join it": (4, "four commands, `palpate class init`, `serve`, `watch`, `train --class`"),
    "replay a recording": (2, "Ctrl+O, a click on the file"),
    "make a film": (3, "pictures (Shift+F12), stop, ffmpeg"),
}


RUN = ("run", "--verbose", "--width", str(WIDTH), "--height", str(HEIGHT))


class Run:
    """The programs and the desktop of one task."""

    def __init__(self, palpate, desktop, fresh):
        self.palpate, self.desktop, self.fresh = palpate, desktop, fresh

    def window(self, *arguments):
        return Window(self.desktop, [self.palpate, *RUN, *arguments], self.fresh.home,
                      self.fresh.folder)

    def start(self):
        window = self.window()
        window.until(lambda: window.page_s is not None, "the start page")
        while self.desktop.is_black() and time.monotonic() < window.started + 20.0:
            time.sleep(0.005)
        window.page_s = time.monotonic() - window.started
        return window


BALL_BELTS, BALL_SLICES = 24, 48
BALL_TRIANGLES = 2 * BALL_SLICES * (BALL_BELTS - 1)


def write_stl(file, size_mm):
    """A ball, binary."""
    def at(i, j):
        theta, phi = math.pi * i / BALL_BELTS, 2 * math.pi * j / BALL_SLICES
        return tuple(size_mm / 2 * c for c in
                     (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
    triangles = []
    for i in range(BALL_BELTS):
        for j in range(BALL_SLICES):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, c, b)] * (i < BALL_BELTS - 1) + [(a, d, c)] * (i > 0)
    with open(file, "wb") as out:
        out.write(b"ball".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *[c for corner in triangle for c in corner], 0))


def touch_t6(run, window):
    window.click("start/touch")
    window.until(lambda: "depth" in window.frame, "the first frame")
    far = window.number("distance")
    window.key("ctrl+f")
    window.type("T6")
    window.key("Return")
    window.until(lambda: window.number("distance") < 0.7 * far and "At T6" in window.frame["message"], "the flight to T6")
    window.key("Return")
    window.until(lambda: window.number("depth") > 3.0, "a press")


def open_stl(run, window):
    window.click("start/here/ball.stl")
    window.until(lambda: window.number("body") == BALL_TRIANGLES, "the body of my file")


def make_dysfunction(run, window):
    window.click("start/touch")
    window.until(lambda: "depth" in window.frame, "the first frame")
    window.click("panel/Dysfunctions", at_share=0.3)
    window.click("dysfunctions/new")
    window.type("T9 left 51")
    window.key("Return")
    window.until(lambda: window.has("dysfunctions/change"), "the dysfunction")
    window.key("ctrl+s")
    scene = run.fresh.folder / "scene.toml"
    window.until(scene.exists, "the saved scene")
    if "T9 left" not in scene.read_text(encoding="utf-8"):
        raise Gone("the scene says no place in words")


def answered(window, *numbers):
    """The next of these places, by its number; Enter again where it was not pressed first."""
    for number in numbers:
        seen = window.screen
        window.type(number)
        window.key("Return")
        try:
            window.until(lambda: window.screen != seen, "the answer", 3.0)
        except Gone:
            window.key("Return")


def practise(run, window):
    """Answers by the keyboard, one place for all, until the block is over."""
    window.click("start/train")
    window.until(lambda: window.screen, "the training")
    window.focused = False
    end = time.monotonic() + max(240.0, 8.0 * desktop.PATIENCE_S)
    while time.monotonic() < end:
        seen = window.screen
        if "Another block" in seen:
            return
        if "One moment" in seen:
            window.pause(0.05)
            continue
        if "Welcome" in seen or "What would you like to do" in seen:
            window.click("training/button/1")
        elif "Touch the back" in seen:
            window.press_at(*OVER_TRAINED_BACK)
            window.until(lambda: "Your device works" in window.screen, "the press")
            window.lift()
            window.key("space")
        elif window.has("training/site/1"):
            answered(window, "1")
        elif window.has("training/site/4"):  # familiarisation knows two places
            answered(window, "4", "10")
        else:
            window.key("space" if "Space" in seen else "Return")
        try:
            window.until(lambda: window.screen != seen, "the next screen", 3.0)
        except Gone:
            pass
    raise Gone(f"the block did not end: {window.screen}")


def measure_pair(run, window):
    window.click("start/measure")
    window.click("measuring/here")
    window.until(lambda: window.has("measuring/result"), "the result", 60.0)
    window.click("measuring/place")
    window.pause(0.3)
    window.type("T6 left 40 mm")
    window.pause(0.5)
    window.click("measuring/accept")
    table = run.fresh.folder / "key_points.csv"
    window.until(table.exists, "the table")


def replay(run, window):
    window.click("start/here/press.session")
    window.until(lambda: window.has("replay/play"), "the bar of the replay", 60.0)


def make_film(run, window):
    window.click("start/touch")
    window.until(lambda: "depth" in window.frame, "the first frame")
    window.click("menu/File")
    window.click("menu/Save film")
    window.until(lambda: window.has("film/file"), "the dialog")
    window.key("Return")
    window.until(lambda: not window.has("film/file"), "the film's beginning")
    window.press_at(*OVER_BACK)
    window.until(lambda: window.number("depth") > 1.0, "a press")
    window.pause(1.0)
    window.lift()
    window.click("menu/File")
    window.click("menu/Stop the film")
    window.until(lambda: any(run.fresh.folder.rglob("*.webm")), "the film", 30.0)


def join_class(run, window):
    window.click("start/class")
    window.until(lambda: window.has("class/folder"), "the dialog")
    window.key("Return")
    window.until(lambda: window.has("class/end"), "the class", 60.0)
    before = run.desktop.windows()
    window.click("class/join")
    window.until(lambda: run.desktop.windows() > before, "the training of the station", 60.0)


TASKS = {
    "touch T6": touch_t6,
    "open my STL": open_stl,
    "dysfunction at T9 left, saved": make_dysfunction,
    "train one practice block": practise,
    "measure a pair": measure_pair,
    "start a class and join it": join_class,
    "replay a recording": replay,
    "make a film": make_film,
}


def prepared(run, name):
    """Files that the user of a task brings."""
    import subprocess
    environment = run.desktop.environment(run.fresh.home)
    if name == "open my STL":
        write_stl(run.fresh.folder / "ball.stl", 300.0)
    if name == "measure a pair":
        subprocess.run([run.palpate, "measure", "synthesize", "-o", "photos"], cwd=run.fresh.folder, env=environment,
                       check=True, stdout=subprocess.DEVNULL)
        for word in ("before", "after"):
            file = next((run.fresh.folder / "photos").glob(f"*{word}*.*"))
            file.rename(run.fresh.folder / f"{word}{file.suffix}")
    if name == "replay a recording":
        subprocess.run([run.palpate, "simulate", "--preset", "vhb", "--session", "-o", "results"], cwd=run.fresh.folder,
                       env=environment, check=True, stdout=subprocess.DEVNULL)
        (run.fresh.folder / "results" / "run.session").rename(run.fresh.folder / "press.session")


def done(palpate, desktop, name, pictures=None):
    """One task, from a fresh HOME; never throws for what the window did or did not. `pictures`: a folder for what was on
    the screen at its end."""
    way = TASKS[name]
    old, old_way = OLD[name]
    if isinstance(way, str):
        return Task(name, 0, 0.0, False, old, old_way, way)
    with Fresh() as fresh:
        run = Run(palpate, desktop, fresh)
        window = None
        try:
            prepared(run, name)
            window = run.start()
            way(run, window)
            return Task(name, window.actions, time.monotonic() - window.started, True, old, old_way)
        except Exception as trouble:  # noqa: BLE001: the row says it
            actions = window.actions if window else 0
            seconds = time.monotonic() - window.started if window else 0.0
            return Task(name, actions, seconds, False, old, old_way, f"{type(trouble).__name__}: {trouble}")
        finally:
            if pictures:
                desktop.save(pictures / f"{name.split(',')[0].replace(' ', '-')}.ppm")
            if window:
                window.end()
