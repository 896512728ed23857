"""Photographs of dots: what is measured is the truth that was painted; what cannot be believed is refused with reasons."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

import palpate
from palpate import measure


@pytest.fixture(scope="module")
def painted():
    return measure.synthesize(15, megapixels=1.0, tail="compact", half_major_mm=80, ratio=1.3, direction_deg=90, drag_deg=90)


def between(one: float, other: float) -> float:
    """Degrees between two axes without a sense."""
    return abs((one - other + 90) % 180 - 90)


def test_the_ellipse_is_the_painted_one_within_its_uncertainty(painted):
    found = measure.dots(painted.before, painted.after, again=painted.again)
    assert found.accepted, found.findings
    truth, ellipse = painted.truth, found.ellipse
    assert truth["half_major_mm"] == pytest.approx(80.0, rel=0.01)
    assert abs(ellipse.half_major_mm.value - truth["half_major_mm"]) < 4 * ellipse.half_major_mm.sd
    assert float(ellipse.half_major_mm) == pytest.approx(truth["half_major_mm"], rel=0.1)
    assert float(ellipse.major_over_minor) == pytest.approx(truth["major_over_minor"], rel=0.1)
    assert between(float(ellipse.direction_deg), truth["direction_deg"]) < 10
    assert between(float(found.drag_deg), truth["drag_deg"]) < 5
    assert float(found.peak_mm) == pytest.approx(truth["peak_mm"], rel=0.1)


def test_dots_are_arrays_that_the_fit_explains(painted):
    found = measure.dots(painted.before, painted.after)
    dots = found.dots
    seen = np.isfinite(dots["after_px"]).all(axis=1)
    assert seen.sum() == found.matched > 60
    assert dots["site"].shape == dots["skin_mm"].shape == dots["moved_mm"].shape
    far = np.linalg.norm(dots["moved_mm"][seen], axis=1)
    assert far.max() > 5.0 and far.min() < 1.5
    assert np.median(dots["residual_mm"][seen]) < 0.5
    assert found.contour_mm.shape[1] == 2 and len(found.contour_mm) > 20


def test_files_and_arrays_are_the_same_to_the_command(command, painted, tmp_path):
    subprocess.run(
        [command, "measure", "synthesize", "-o", "P", "--megapixels", "1", "--seed", "15", "--tail", "compact", "--half-major-mm", "80",
         "--ratio", "1.3", "--direction-deg", "90", "--drag-deg", "90"],
        cwd=tmp_path, check=True, capture_output=True,
    )
    run = [command, "measure", "dots", "P/before.jpg", "P/after.jpg", "--null", "P/before2.jpg", "--json"]
    theirs = json.loads(subprocess.run(run, cwd=tmp_path, check=True, capture_output=True, text=True).stdout)
    ours = measure.dots(tmp_path / "P/before.jpg", str(tmp_path / "P/after.jpg"), again=tmp_path / "P/before2.jpg")
    assert ours.accepted
    assert json.dumps(theirs).find(f"{ours.ellipse.half_major_mm.value:.3f}"[:-1]) > 0


def test_a_refusal_has_its_reason_and_raises_nothing(painted):
    blank = np.full((400, 400, 3), 200, np.uint8)
    nothing = measure.dots(blank, blank)
    assert not nothing.accepted
    assert nothing.ellipse is None
    assert nothing.findings[0]["severity"] == "refusal" and nothing.findings[0]["text"]
    still = measure.synthesize(3, peak_mm=0.0)
    refused = measure.dots(still.before, still.after)
    assert not refused.accepted
    swapped = measure.dots(painted.after, painted.before)
    assert not swapped.accepted or swapped.findings


def test_a_row_of_a_table_is_read_by_the_maps(command, painted, tmp_path):
    found = measure.dots(painted.before, painted.after)
    (tmp_path / "keys.csv").write_text(measure.row_header() + found.row("P1", (0.0, 73.0)))
    subprocess.run([command, "body", "map", "ellipses", "--keys", "keys.csv", "-o", "map.png"], cwd=tmp_path, check=True)
    with pytest.raises(ValueError, match="name"):
        found.row("a,b", (0, 0))


def test_what_makes_no_sense_is_refused(painted, tmp_path):
    with pytest.raises(palpate.Error, match="one camera"):
        measure.dots(painted.before, painted.after[:-10])
    with pytest.raises(ValueError, match="before"):
        measure.dots(painted.before.astype(float), painted.after)
    with pytest.raises(palpate.Error, match="spacing"):
        measure.dots(painted.before, painted.after, spacing_mm=0.0)
    with pytest.raises(ValueError, match="head"):
        measure.dots(painted.before, painted.after, head="up")
    with pytest.raises(palpate.Error, match="nowhere"):
        measure.dots(tmp_path / "nowhere.jpg", painted.after)
    with pytest.raises(ValueError, match="ratio"):
        measure.synthesize(1, ratio=9.0)
    with pytest.raises(ValueError, match="tail"):
        measure.synthesize(1, tail="short")


ROWS = """name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,drag_deg,subject
P1,0,73,80,1.5,90,90,a
P1,0,73,80,1.5,90,0,a
P2,30,0,60,1.2,0,90,a
P2,30,0,66,1.2,0,90,b
"""


def test_presses_become_key_points_as_the_command_makes_them(command, tmp_path):
    (tmp_path / "rows.csv").write_text(ROWS)
    run = [command, "measure", "average", "rows.csv", "--mirror", "P2:P3", "-o", "keys.csv"]
    subprocess.run(run, cwd=tmp_path, check=True, capture_output=True)
    for table in (ROWS, tmp_path / "rows.csv", str(tmp_path / "rows.csv")):
        means = measure.average([table], mirrors={"P2": "P3"})
        assert means.key_points() == (tmp_path / "keys.csv").read_text()
    p1, p2, p3 = means.points
    assert p1.along_drag is not None and len(p1.drags) == 2 and p1.remark == ""
    assert p2.along_drag is None and p2.remark
    assert p2.mean.subjects == p2.mean.presses == 2
    assert float(p2.mean.half_major_mm) == pytest.approx((60 * 66) ** 0.5), "of logarithms"
    assert p3.mirrored_from == "P2" and p3.place_mm == (-30.0, 0.0)
    assert [point.name for point in measure.average([ROWS], drag="right").points] == ["P1"]


def test_of_several_tables_each_is_a_persons(tmp_path):
    alone = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg\nP1,0,0,{},1.5,90\n"
    means = measure.average([alone.format(50), alone.format(60)])
    assert means.points[0].mean.subjects == 2


def test_tables_that_make_no_sense_name_file_and_line(tmp_path):
    (tmp_path / "bad.csv").write_text(ROWS + "P4,0,0,none,1,0,90,a\n")
    with pytest.raises(palpate.Error) as caught:
        measure.average([tmp_path / "bad.csv"])
    assert caught.value.line == 6 and str(caught.value.file).endswith("bad.csv")
    with pytest.raises(ValueError, match="drag"):
        measure.average([ROWS], drag="sideways")
    with pytest.raises(palpate.Error):
        measure.average([ROWS], mirrors={"P9": "P10"})


def test_the_stencil_is_that_of_the_command(command, tmp_path):
    subprocess.run([command, "measure", "stencil", "-o", "s.svg", "--page", "tiled-a4"], cwd=tmp_path, check=True, capture_output=True)
    sheets = measure.stencil(page="tiled-a4")
    assert len(sheets) > 1
    for sheet in sheets:
        assert (tmp_path / f"s-{sheet.name}.svg").read_text() == sheet.svg
    with pytest.raises(palpate.Error):
        measure.stencil(page="a4", columns=60)
    with pytest.raises(ValueError, match="page"):
        measure.stencil(page="a1")
