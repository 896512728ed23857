"""The page in a cell of a notebook: press there with the mouse, and get the contact data here as an array.

    page = palpate.view.widget()          # the last line of a cell shows it
    page.press("T6 right 30 mm", 8)       # or press with the mouse
    page.felt["force"]                    # (N, 3) newtons, sixty rows a second of touch
    page.recorded()["force_n"]            # every tick of a millisecond, after that

The engine runs in the page, in WebAssembly, on the page's own trunk or on a mesh that is given to it. A thread of this
process serves the page on 127.0.0.1; nothing comes from a network. Only who has the token of the address is heard.
"""

from __future__ import annotations

import hmac
import http.server
import itertools
import json
import os
import pathlib
import secrets
import sys
import threading
from collections import deque
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Widget", "page_folder"]

FELT = np.dtype(
    [
        ("tick", np.int64),
        ("finger", np.int8),
        ("touch", np.int8),
        ("depth_mm", np.float64),
        ("tip", np.float64, 3),
        ("proxy", np.float64, 3),
        ("normal", np.float64, 3),
        ("force", np.float64, 3),
    ]
)
_NUMBERS = 16  # a row
_FINGERS = {"left": 0, "right": 1}
_KEPT_ROWS = 1_000_000  # some two hours of touch by two fingers, 130 MB
_MOST_BYTES = 256 << 20  # of an exchange: five minutes of ticks as text
_MOST_SITE_BYTES = 64 << 20
_POLL_S = 0.05  # until an end is noticed
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".mjs": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
    ".wasm": "application/wasm",
    ".txt": "text/plain; charset=utf-8",
}
# Notebooks show the page in a frame of their own: those of this computer may.
_FRAMES = "frame-ancestors 'self' http://localhost:* http://127.0.0.1:* https://localhost:* https://127.0.0.1:* vscode-webview:"


def page_folder(site: str | os.PathLike[str] | None = None) -> pathlib.Path:
    """The folder of the built page: `site`, else $PALPATE_SITE, else the wheel's, the installed one, that of a build.

    Raises FileNotFoundError, which names what was looked at.
    """
    if site is not None:
        candidates = [pathlib.Path(site)]
    elif "PALPATE_SITE" in os.environ:
        candidates = [pathlib.Path(os.environ["PALPATE_SITE"])]
    else:
        here = pathlib.Path(__file__).resolve().parent
        # PREFIX/lib/python3/dist-packages/palpate, or build/release/python/palpate
        prefixes = [*list(here.parents)[3:4], pathlib.Path(sys.prefix), pathlib.Path("/usr/local"), pathlib.Path("/usr")]
        installed = [prefix / "share/palpate/web" for prefix in prefixes]
        candidates = [here / "web", *installed, *(build / "web/site" for build in list(here.parents)[2:3])]
    for folder in candidates:
        if (folder / "index.html").is_file() and (folder / "notebook.js").is_file():
            return folder
    looked = ", ".join(str(folder) for folder in dict.fromkeys(candidates))
    raise FileNotFoundError(f"palpate.view.widget: no page in {looked}; build it with tools/build-web, or set site= or PALPATE_SITE to its folder")


def _files_of(folder: pathlib.Path) -> dict[str, bytes]:
    """The files that can be requested, by name; a request never opens a path."""
    files: dict[str, bytes] = {}
    size = 0
    for file in sorted(folder.iterdir()):
        if file.name.startswith(".") or file.is_symlink() or not file.is_file():
            continue
        size += file.stat().st_size
        if size > _MOST_SITE_BYTES:
            raise ValueError(f"palpate.view.widget: {folder} has more than {_MOST_SITE_BYTES >> 20} MB; check that it is the page's folder")
        files["/" + file.name] = file.read_bytes()
    files["/"] = files["/index.html"]
    return files


class _Exchange:
    """Messages between page and Python. Thread-safe."""

    def __init__(self) -> None:
        self.token = secrets.token_urlsafe(24)
        self.changed = threading.Condition()
        self.rows: deque[NDArray[np.float64]] = deque()  # of an exchange each
        self.count = 0  # of all rows
        self.requests: list[dict[str, Any]] = []
        self.answers: dict[int, dict[str, Any]] = {}
        self.waited_for: set[int] = set()
        self.mesh = b""
        self.body: str | None = None
        self.closed = False
        self.ids = itertools.count(1)

    def take(self, message: Any) -> list[dict[str, Any]]:
        """Accepts a message from the page and returns the requests for it. Raises ValueError for a message of another form."""
        if not isinstance(message, dict) or not isinstance(message.get("rows"), list) or not isinstance(message.get("answers"), list):
            raise ValueError("an exchange must have rows and answers")
        rows = np.asarray(message["rows"], dtype=np.float64).reshape(-1, _NUMBERS)
        for answer in message["answers"]:
            if not isinstance(answer, dict) or not isinstance(answer.get("id"), int):
                raise ValueError("an answer must have an id")
        with self.changed:
            self.keep(rows)
            self.body = message.get("body")
            # One that is not waited for any more is of nobody.
            self.answers.update((answer["id"], answer) for answer in message["answers"] if answer["id"] in self.waited_for)
            requests, self.requests = self.requests, []
            self.changed.notify_all()
        return requests

    def keep(self, rows: NDArray[np.float64]) -> None:
        if len(rows) > 0:
            self.rows.append(rows)
            self.count += len(rows)
        while self.rows and self.count - len(self.rows[0]) >= _KEPT_ROWS:
            self.count -= len(self.rows.popleft())

    def ask(self, name: str, given: dict[str, Any], seconds: float) -> Any:
        """Sends a request to the page and waits for the result. Raises RuntimeError with its message, TimeoutError."""
        with self.changed:
            number = next(self.ids)
            self.requests.append({"id": number, "name": name, **given})
            self.waited_for.add(number)
            try:
                if not self.changed.wait_for(lambda: self.closed or number in self.answers, seconds):
                    raise TimeoutError(f"palpate.view.widget: the page did not answer within {seconds:g} s; show it in a cell first")
                if self.closed:
                    raise RuntimeError("palpate.view.widget: the widget is closed")
                answer = self.answers.pop(number)
            finally:
                self.waited_for.discard(number)
                self.requests = [one for one in self.requests if one["id"] != number]
        if "error" in answer:
            raise RuntimeError(f"palpate.view.widget: {answer['error']}")
        return answer.get("result")


class _Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, files: dict[str, bytes], exchange: _Exchange) -> None:
        self.files = files
        self.exchange = exchange
        super().__init__(("127.0.0.1", 0), _Visit)


class _Visit(http.server.BaseHTTPRequestHandler):
    """One request. The page's own files need no token; everything else does."""

    server: _Server
    protocol_version = "HTTP/1.1"
    timeout = 20  # of a page that stops in the middle of a request

    def log_message(self, format: str, *words: Any) -> None:
        pass  # a cell is no log

    def reply(self, status: int, body: bytes = b"", kind: str = "text/plain; charset=utf-8", cache: str = "no-store") -> None:
        self.send_response(status)
        for name, value in (("Content-Type", kind), ("Content-Length", str(len(body))), ("Cache-Control", cache),
                            ("X-Content-Type-Options", "nosniff"), ("Referrer-Policy", "no-referrer"), ("Content-Security-Policy", _FRAMES)):
            self.send_header(name, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def is_ours(self) -> bool:
        """Checks the requested host name: a foreign name that resolves to 127.0.0.1 is refused."""
        port = self.server.server_address[1]
        hosts, origins = self.headers.get_all("Host") or [], self.headers.get_all("Origin") or []
        if len(hosts) != 1 or len(origins) > 1:
            return False
        return hosts[0] in (f"127.0.0.1:{port}", f"localhost:{port}") and all(o == f"http://{hosts[0]}" for o in origins)

    def has_token(self) -> bool:
        given = self.headers.get("Authorization", "")
        return hmac.compare_digest(given.encode("utf-8", "replace"), f"Bearer {self.server.exchange.token}".encode())

    def do_GET(self) -> None:
        path = self.path.partition("?")[0]
        if not self.is_ours():
            self.reply(403)
        elif path == "/notebook/mesh":
            if self.has_token():
                self.reply(200, self.server.exchange.mesh, "application/octet-stream")
            else:
                self.reply(401)
        elif path in self.server.files:
            kind = _TYPES.get(pathlib.PurePath(path if path != "/" else "/index.html").suffix, "application/octet-stream")
            self.reply(200, self.server.files[path], kind, "no-cache")
        else:
            self.reply(404)

    do_HEAD = do_GET

    def do_POST(self) -> None:
        # What is left unread of a body would be read as the next request.
        self.close_connection = True
        if not self.is_ours():
            self.reply(403)
        elif self.path != "/notebook/exchange":
            self.reply(404)
        elif not self.has_token():
            self.reply(401)
        elif self.server.exchange.closed:
            self.reply(410)
        else:
            self.exchange()

    def exchange(self) -> None:
        length = self.headers.get("Content-Length", "")
        if not length.isdecimal() or int(length) > _MOST_BYTES:
            self.reply(413)
            return
        try:
            requests = self.server.exchange.take(json.loads(self.rfile.read(int(length))))
        except (ValueError, TypeError, RecursionError) as error:
            self.reply(400, str(error).encode())
            return
        self.reply(200, json.dumps({"requests": requests}).encode(), "application/json")
        self.close_connection = False


class Widget:
    """The page of `tools/build-web`, served to a cell by a thread of this process.

    As the last line of a cell it shows itself; `url` opens it in a browser, too. Every cell that shows it has a page, a
    body and fingers of its own, and what is felt in any of them comes here. Calls that ask the page for something wait
    `timeout` seconds for it, and raise TimeoutError if no cell shows it, RuntimeError with the page's message.
    """

    def __init__(self, *, height: int = 640, site: str | os.PathLike[str] | None = None) -> None:
        if not 100 <= height <= 4000:
            raise ValueError("height must be 100 to 4000 pixels")
        self._height = height
        self._exchange = _Exchange()
        self._server = _Server(_files_of(page_folder(site)), self._exchange)
        self._thread = threading.Thread(target=self._server.serve_forever, args=(_POLL_S,), name="palpate-widget", daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """Address with the token; it allows pressing and receives the contact data."""
        return f"http://127.0.0.1:{self._server.server_address[1]}/#notebook={self._exchange.token}"

    def _repr_html_(self) -> str:
        return (f'<iframe src="{self.url}" title="Palpate" width="100%" height="{self._height}" style="border:0" '
                'allow="fullscreen; xr-spatial-tracking"></iframe>')

    def __repr__(self) -> str:
        return f"<palpate.notebook.Widget: {self._exchange.count} rows felt>"

    @property
    def felt(self) -> NDArray[np.void]:
        """Contact data so far, as a copy: (N,) rows in order, sixty per second while a finger touches.

        Fields: tick (ms), finger (0 left, 1 right), touch (0 free, 1 sticks, 2 slips), depth_mm, and (3,) each: tip, proxy (mm),
        normal (of length 1), force (N). About the newest 1,000,000 rows are kept.
        """
        with self._exchange.changed:
            rows = np.concatenate([np.zeros((0, _NUMBERS)), *self._exchange.rows])
        felt = np.zeros(len(rows), FELT)
        for i, name in enumerate(("tick", "finger", "touch", "depth_mm")):
            felt[name] = rows[:, i]
        for i, name in enumerate(("tip", "proxy", "normal", "force")):
            felt[name] = rows[:, 4 + 3 * i : 7 + 3 * i]
        return felt

    def clear(self) -> None:
        """Clears the contact data; the page keeps its own recording."""
        with self._exchange.changed:
            self._exchange.rows.clear()
            self._exchange.count = 0

    @property
    def body(self) -> str | None:
        """What the page touches; None before a cell has shown it."""
        return self._exchange.body

    def wait(self, rows: int = 1, timeout: float = 60.0) -> bool:
        """Waits for this many rows; returns whether they arrived within `timeout` seconds."""
        exchange = self._exchange
        with exchange.changed:
            return exchange.changed.wait_for(lambda: exchange.closed or exchange.count >= rows, timeout) and not exchange.closed

    def go(self, place: str, *, timeout: float = 10.0) -> None:
        """Moves the camera to a named place ("T6 right 30 mm") and the finger above it."""
        self._exchange.ask("go", {"place": place}, timeout)

    def press(self, place: str, depth_mm: float = 6.0, *, finger: str = "left", timeout: float = 10.0) -> None:
        """Presses there, 0.5 to 20 mm deep, and stays, as *Hold* does. finger: "left", "right"."""
        if not 0.5 <= depth_mm <= 20.0:
            raise ValueError("depth_mm must be 0.5 to 20")
        self._exchange.ask("press", {"place": place, "depth": float(depth_mm), "finger": _finger(finger)}, timeout)

    def lift(self, finger: str = "left", *, timeout: float = 10.0) -> None:
        """Lifts a pressed finger."""
        self._exchange.ask("lift", {"finger": _finger(finger)}, timeout)

    def open(self, vertices: ArrayLike, faces: ArrayLike, *, name: str = "mesh", timeout: float = 120.0) -> None:
        """Loads a mesh into the page: (V, 3) mm and (F, 3), repaired there. The page sets its stiffness."""
        self._exchange.mesh = _ply_of(np.asarray(vertices, dtype=np.float64), np.asarray(faces))
        self._exchange.ask("open", {"file": name + ".ply", "unit_mm": 1}, timeout)

    def recorded(self, *, timeout: float = 60.0) -> dict[str, Any]:
        """Every tick that the page stores (five minutes of touch at 1 kHz), bit by bit.

        A dict of arrays: time_s and depth_mm (N,), finger and state (N,) of text, tip_mm, proxy_mm, anchor_mm and force_n
        (N, 3); and `toml`, the scene. The columns are those of forces.csv (docs/reference/simulate.md).
        """
        result = self._exchange.ask("record", {}, timeout)
        return {**_table_of(result["csv"]), "toml": result["toml"]}

    def close(self) -> None:
        """Stops the server; open pages continue, but are no longer connected."""
        with self._exchange.changed:
            self._exchange.closed = True
            self._exchange.changed.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def __enter__(self) -> Widget:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


def _finger(name: str) -> int:
    if name not in _FINGERS:
        raise ValueError(f"finger must be 'left' or 'right', not {name!r}")
    return _FINGERS[name]


def _ply_of(vertices: NDArray[np.float64], faces: NDArray[Any]) -> bytes:
    if vertices.ndim != 2 or vertices.shape[1] != 3 or not np.isfinite(vertices).all():
        raise ValueError("vertices must be finite, of shape (V, 3)")
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu" or faces.size == 0:
        raise ValueError("faces must be integers, of shape (F, 3)")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise ValueError("faces use vertices that do not exist")
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    table = np.zeros(len(faces), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    table["count"] = 3
    table["corners"] = faces
    return head.encode() + vertices.astype("<f8").tobytes() + table.tobytes()


def _table_of(csv: str) -> dict[str, NDArray[Any]]:
    names, *rows = (line.split(",") for line in csv.splitlines())
    cells = np.array(rows, dtype=str).reshape(-1, len(names))
    column = {name: cells[:, i] for i, name in enumerate(names)}

    def number(name: str) -> NDArray[np.float64]:
        return column[name].astype(np.float64)

    def vector(name: str, unit: str) -> NDArray[np.float64]:
        return np.stack([number(f"{name}_{axis}_{unit}") for axis in "xyz"], axis=1)

    return {
        "time_s": number("t_s"),
        "finger": column["finger"],
        "state": column["state"],
        "depth_mm": number("depth_mm"),
        "tip_mm": vector("tip", "mm"),
        "proxy_mm": vector("proxy", "mm"),
        "anchor_mm": vector("anchor", "mm"),
        "force_n": vector("force", "n"),
    }
