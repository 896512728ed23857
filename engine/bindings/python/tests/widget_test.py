"""The page in a cell: served to who asks by the right name, heard from who has the token, and asked for things.

A client of HTTP stands for the page here; engine/web/tests/notebook.mjs tests the page's side.
"""

from __future__ import annotations

import functools
import http.client
import http.server
import json
import pathlib
import shutil
import socket
import subprocess
import threading
import urllib.parse

import numpy as np
import pytest

import palpate
from conftest import SOURCE, dome
from palpate.notebook import page_folder

ROW = [16, 1, 2, 1.5, 1, 2, 3, 4, 5, 6, 0, 0, 1, 0.25, 0, 2.1000000000000001]
CSV = ("t_s,finger,tip_x_mm,tip_y_mm,tip_z_mm,proxy_x_mm,proxy_y_mm,proxy_z_mm,anchor_x_mm,anchor_y_mm,anchor_z_mm,"
       "force_x_n,force_y_n,force_z_n,depth_mm,state,triangle,device_x_n,device_y_n,device_z_n,contact_status,safety_status\n"
       "0.001,left,1,2,3,4,5,6,7,8,9,0.1,0.2,0.30000000000000004,1.5,stick,12,0,0,0,0,0\n"
       "0.002,left,1,2,3,4,5,6,7,8,9,0.1,0.2,0.4,1.5,slip,12,0,0,0,0,0\n")


@pytest.fixture
def site(tmp_path: pathlib.Path) -> pathlib.Path:
    folder = tmp_path / "site"
    folder.mkdir()
    (folder / "index.html").write_text("<!doctype html><title>Palpate</title>")
    (folder / "notebook.js").write_text("export {};")
    (folder / "palpate.wasm").write_bytes(b"\0asm")
    (folder / ".hidden").write_text("not for the page")
    (tmp_path / "secret.txt").write_text("not for the page")
    return folder


@pytest.fixture
def widget(site: pathlib.Path):
    with palpate.view.widget(site=site) as made:
        yield made


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *words) -> None:
        pass


class Page:
    """What engine/web/page/notebook.js does, by hand."""

    def __init__(self, widget) -> None:
        address = urllib.parse.urlsplit(widget.url)
        self.host = address.netloc
        self.token = address.fragment.partition("=")[2]

    def get(self, path: str, **headers: str) -> tuple[int, bytes, http.client.HTTPResponse]:
        return self.request("GET", path, None, headers)

    def request(self, method: str, path: str, body: bytes | None, headers: dict) -> tuple[int, bytes, http.client.HTTPResponse]:
        connection = http.client.HTTPConnection(self.host, timeout=10)
        connection.request(method, path, body, headers)
        answer = connection.getresponse()
        text = answer.read()
        connection.close()
        return answer.status, text, answer

    def raw(self, *lines: str) -> int:
        """The status of a request of these lines."""
        name, port = self.host.split(":")
        with socket.create_connection((name, int(port)), timeout=10) as link:
            link.sendall("\r\n".join([*lines, "Connection: close", "", ""]).encode())
            return int(link.makefile("rb").read().split()[1])

    def exchange(self, rows=(), answers=(), **headers: str) -> tuple[int, list]:
        body = json.dumps({"body": "built-in trunk", "rows": list(rows), "answers": list(answers)}).encode()
        status, text, _ = self.request("POST", "/notebook/exchange", body, {"Authorization": f"Bearer {self.token}", **headers})
        return status, json.loads(text)["requests"] if status == 200 else []

    def does(self, answer, then) -> dict:
        """Runs `then` in Python while the page gives its one request this answer; the request."""
        asked: list = []

        def serve() -> None:
            while not asked:
                asked.extend(self.exchange()[1])
            self.exchange(answers=[{"id": asked[0]["id"], **answer}])

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            self.gave = then()
        finally:
            thread.join()
        return asked[0]


def test_a_cell_shows_the_page_and_its_files_alone(widget):
    page = Page(widget)
    assert f'<iframe src="{widget.url}"' in widget._repr_html_()
    status, text, answer = page.get("/")
    assert (status, text) == (200, b"<!doctype html><title>Palpate</title>")
    assert answer.headers["Content-Type"].startswith("text/html") and "frame-ancestors" in answer.headers["Content-Security-Policy"]
    assert page.get("/palpate.wasm")[2].headers["Content-Type"] == "application/wasm"
    for path in ("/.hidden", "/../secret.txt", "/%2e%2e/secret.txt", "/notebook", "/site"):
        assert page.get(path)[0] == 404, path


def test_what_is_felt_there_is_an_array_here(widget):
    page = Page(widget)
    assert widget.felt.shape == (0,) and widget.body is None
    status, requests = page.exchange(rows=[ROW, [32, *ROW[1:]]])
    assert (status, requests) == (200, [])
    assert widget.wait(2, timeout=1.0) and not widget.wait(3, timeout=0.01)
    felt = widget.felt
    assert felt["tick"].tolist() == [16, 32] and felt["finger"].tolist() == [1, 1] and felt["touch"].tolist() == [2, 2]
    assert felt["force"][0].tolist() == [0.25, 0.0, 2.1000000000000001], "to the last bit"
    assert felt["tip"].shape == (2, 3) and felt["depth_mm"][0] == 1.5
    assert widget.body == "built-in trunk"
    widget.clear()
    assert len(widget.felt) == 0


def test_only_the_newest_rows_are_kept(widget, monkeypatch):
    monkeypatch.setattr("palpate.notebook._KEPT_ROWS", 4)
    page = Page(widget)
    for tick in range(5):
        page.exchange(rows=[[2 * tick, *ROW[1:]], [2 * tick + 1, *ROW[1:]]])
    assert widget.felt["tick"].tolist() == [6, 7, 8, 9]


def test_only_who_has_the_token_and_comes_by_the_right_name_is_heard(widget):
    page = Page(widget)
    assert page.exchange(rows=[ROW], Authorization="Bearer wrong")[0] == 401
    assert page.exchange(rows=[ROW], Host="elsewhere.example")[0] == 403, "a name that leads here"
    assert page.exchange(rows=[ROW], Origin="http://elsewhere.example")[0] == 403
    assert page.get("/", Host="elsewhere.example")[0] == 403
    for lines in ([], [f"Host: {page.host}", "Host: elsewhere.example"], [f"Host: {page.host}"] + ["Origin: http://" + page.host] * 2):
        assert page.raw("GET /notebook/mesh HTTP/1.1", f"Authorization: Bearer {page.token}", *lines) == 403, lines
    assert page.get("/notebook/mesh")[0] == 401
    assert page.request("POST", "/notebook/exchange", b"{}", {"Authorization": "Bearer"})[0] == 401
    assert len(widget.felt) == 0
    assert page.exchange(rows=[ROW], Origin=f"http://{page.host}")[0] == 200


def test_a_message_of_another_form_is_refused_and_changes_nothing(widget):
    page = Page(widget)
    right = {"Authorization": f"Bearer {page.token}"}
    for body in (b"", b"[", b"[]", b"{}", b'{"rows": [[1, 2]], "answers": []}', b'{"rows": [["a"]], "answers": []}',
                 b'{"rows": [], "answers": [1]}', b'{"rows": {}, "answers": []}', b"[" * 100000):
        assert page.request("POST", "/notebook/exchange", body, right)[0] == 400, body[:40]
    assert page.request("POST", "/notebook/exchange", b"", {**right, "Content-Length": "999999999999"})[0] == 413
    assert len(widget.felt) == 0


def test_python_presses_and_lifts_and_flies(widget):
    page = Page(widget)
    request = page.does({"result": None}, lambda: widget.press("T6 right 30 mm", 8, finger="right"))
    assert request == {"id": 1, "name": "press", "place": "T6 right 30 mm", "depth": 8.0, "finger": 1}
    assert page.does({"result": None}, lambda: widget.lift("right"))["name"] == "lift"
    assert page.does({"result": None}, lambda: widget.go("T6"))["place"] == "T6"
    with pytest.raises(RuntimeError, match="no place T99"):
        page.does({"error": "this body has no place T99"}, lambda: widget.go("T99"))
    with pytest.raises(ValueError, match="0.5 to 20"):
        widget.press("T6", 30)
    with pytest.raises(ValueError, match="'left' or 'right'"):
        widget.lift("middle")


def test_every_tick_comes_as_arrays(widget):
    page = Page(widget)
    page.does({"result": {"csv": CSV, "toml": "title = 'trunk'"}}, lambda: widget.recorded())
    assert page.gave["force_n"].tolist() == [[0.1, 0.2, 0.30000000000000004], [0.1, 0.2, 0.4]]
    assert page.gave["state"].tolist() == ["stick", "slip"] and page.gave["time_s"].tolist() == [0.001, 0.002]
    assert page.gave["toml"] == "title = 'trunk'"
    page.does({"result": {"csv": CSV.partition("\n")[0] + "\n", "toml": ""}}, lambda: widget.recorded())
    assert page.gave["force_n"].shape == (0, 3), "nothing was touched"


def test_a_mesh_is_handed_over_as_a_file_that_the_engine_reads(widget, tmp_path):
    vertices, faces = dome(cells=8)
    page = Page(widget)
    assert page.does({"result": None}, lambda: widget.open(vertices, faces, name="dome"))["file"] == "dome.ply"
    status, ply, _ = page.get("/notebook/mesh", Authorization=f"Bearer {page.token}")
    assert status == 200
    (tmp_path / "dome.ply").write_bytes(ply)
    world = palpate.World.from_file(tmp_path / "dome.ply")
    assert len(world.triangles) == len(faces) and len(world.positions) == len(vertices)
    for wrong in ((vertices[:, :2], faces), (vertices, faces + 100000), (vertices, faces * 0.5), (vertices * np.nan, faces)):
        with pytest.raises(ValueError):
            widget.open(*wrong)


def test_a_page_that_is_not_shown_is_said(widget):
    with pytest.raises(TimeoutError, match="show it in a cell"):
        widget.go("T6", timeout=0.05)
    page = Page(widget)
    assert page.exchange() == (200, []), "what nobody waits for any more is not asked"
    assert page.exchange(answers=[{"id": 1, "result": "late"}]) == (200, [])
    assert not widget._exchange.answers, "a late answer is of nobody"


def test_after_the_end_nobody_is_heard(site):
    made = palpate.view.widget(site=site)
    page = Page(made)
    made.close()
    with pytest.raises(OSError):
        page.exchange(rows=[ROW])


def test_a_page_that_is_not_built_is_said(tmp_path, monkeypatch):
    with pytest.raises(FileNotFoundError, match="tools/build-web"):
        palpate.view.widget(site=tmp_path)
    monkeypatch.setenv("PALPATE_SITE", str(tmp_path))
    with pytest.raises(FileNotFoundError, match="PALPATE_SITE"):
        page_folder()


def test_the_page_of_a_wheel_comes_before_that_of_the_system(site, tmp_path, monkeypatch):
    monkeypatch.delenv("PALPATE_SITE", raising=False)
    package = tmp_path / "lib/python3/dist-packages/palpate"
    shutil.copytree(site, tmp_path / "share/palpate/web")
    monkeypatch.setattr("palpate.notebook.__file__", str(package / "notebook.py"))
    assert page_folder() == (tmp_path / "share/palpate/web").resolve()
    shutil.copytree(site, package / "web")
    assert page_folder() == (package / "web").resolve()


# In place of the engine: a plane with one place, where a pressed finger feels 0.1 N. The rest is the page's own.
STAND_IN = """
import { Fingers } from './fingers.js';
import { Notebook, notebookToken } from './notebook.js';
const page = { body: { name: 'plane', landmarks: [{ name: 'T6', at: [10, 20, 0], normal: [0, 0, 1] }] },
  picture: { picker: { pick: ([x, y]) => ({ place: [x, y, 0], normal: [0, 0, 1] }) } },
  source: { tip: (finger, aim) => { page.aim = aim; }, record: async () => ({ csv: 't_s', toml: '' }) } };
page.fingers = new Fingers(page.source);
page.notebook = new Notebook(page, notebookToken());
page.notebook.run();
let tick = 0;
const felt = () => ({ touch: page.aim?.pressed ? 1 : 0, depth: page.aim?.depth ?? 0, tip: page.aim?.place ?? [0, 0, 9], proxy: [0, 0, 0],
                      normal: [0, 0, 1], force: [0, 0, 0.1] });
setInterval(() => page.notebook.take([{ tick: tick += 16, fingers: [felt(), felt()] }]), 16);
"""
CHROMIUM = next((found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None)


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_in_the_frame_of_a_real_browser(tmp_path):
    site, around = tmp_path / "site", tmp_path / "around"
    site.mkdir()
    around.mkdir()
    for name in ("index.html", "notebook.js", "fingers.js", "places.js"):
        shutil.copy(SOURCE / "engine/web/page" / name, site)
    (site / "main.js").write_text(STAND_IN)
    notebook = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(around)))
    threading.Thread(target=notebook.serve_forever, args=(0.05,), daemon=True).start()
    with palpate.view.widget(site=site) as widget:
        (around / "index.html").write_text(f"<!doctype html><body>{widget._repr_html_()}</body>")
        browser = subprocess.Popen([CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                                    f"--user-data-dir={tmp_path / 'profile'}", f"http://127.0.0.1:{notebook.server_address[1]}/"],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            widget.press("T6 right 5 mm", 8, timeout=60)
            assert widget.wait(20, timeout=20)
            felt = widget.felt
            assert felt["force"][-1].tolist() == [0.0, 0.0, 0.1] and felt["depth_mm"].max() == 8.0
            assert felt["tip"][-1].tolist() == [15.0, 20.0, 0.0] and widget.body == "plane"
            widget.lift()
        finally:
            browser.terminate()
            browser.wait(20)
            notebook.shutdown()
            notebook.server_close()
