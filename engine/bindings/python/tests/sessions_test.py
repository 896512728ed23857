"""Sessions read from Python are what the command exports, and are felt again to the bit."""

from __future__ import annotations

import subprocess
import threading

import numpy as np
import pytest

import palpate
from palpate.sessions import Session, repair

SCENE = """
seconds = 0.4
title = "two fingers"
[body]
kind = "torso"
[[finger]]
name = "index"
at = "T6 right 30 mm"
script = [ { do = "press", depth_mm = 7, seconds = 0.2 }, { do = "drag", by_mm = [0, 15], seconds = 0.2 } ]
[[finger]]
name = "middle"
at = "T9 left 30 mm"
script = [ { do = "press", depth_mm = 5, seconds = 0.4 } ]
"""


@pytest.fixture(scope="module")
def recorded(command, tmp_path_factory):
    """A session that the command wrote, and its export as arrays."""
    folder = tmp_path_factory.mktemp("recorded")
    (folder / "scene.toml").write_text(SCENE)
    run = [command, "simulate", "scene.toml", "--no-pictures", "--session", "-o", "out"]
    subprocess.run(run, cwd=folder, check=True, capture_output=True)
    export = [command, "recording", "export", "out/run.session", "--npz", "run.npz"]
    subprocess.run(export, cwd=folder, check=True, capture_output=True)
    return folder / "out" / "run.session", dict(np.load(folder / "run.npz"))


def test_every_column_is_that_of_the_export(recorded):
    file, exported = recorded
    with Session(file) as run:
        assert [finger["name"] for finger in run.fingers] == ["index", "middle"]
        for name in ("index", "middle"):
            table = run.samples(finger=name)
            assert set(table) == {column["name"] for column in run.columns}
            for column, values in table.items():
                wanted = exported[f"{name}.{column}"]
                assert values.dtype == wanted.dtype
                assert values.tobytes() == wanted.tobytes(), column


def test_vectors_have_names_and_spans_have_both_ends(recorded):
    file, exported = recorded
    with Session(file) as run:
        part = run.samples(["tick", "force", "tip"], finger=1, span=(300, 399))
        assert part["force"].shape == (100, 3)
        assert list(part["tick"]) == list(range(300, 400))
        np.testing.assert_array_equal(part["force"][:, 2], exported["middle.force_z_n"][300:400])
        assert np.linalg.norm(part["force"], axis=1).max() > 0.1


def test_blocks_together_are_the_whole(recorded):
    file, _ = recorded
    with Session(file) as run:
        whole = run.samples(["tick", "force"])
        blocks = list(run.blocks(37, ["tick", "force"]))
        assert len(blocks) == -(-len(whole["tick"]) // 37)
        for field in whole:
            np.testing.assert_array_equal(np.concatenate([block[field] for block in blocks]), whole[field])


def test_a_replay_is_identical_and_its_world_gives_the_same_forces(recorded):
    file, _ = recorded
    with Session(file) as run:
        report = run.replay()
        assert report.identical
        assert report.ticks == run.header["samples"] == 2 * 400
        assert report.first_difference is None
        world = run.world()
        felt = world.rollout(run.samples(["tip"])["tip"][None], fields=("force",))["force"][0]
        np.testing.assert_array_equal(felt, run.samples(["force"])["force"])


def test_a_loop_of_python_records_what_it_felt(torso, tmp_path):
    file = tmp_path / "mine.session"
    tips = torso.tips("T6 right 30 mm", np.linspace(-2.0, 6.0, 300))
    felt = []
    with palpate.devices.Loop(torso, session=file, notes="by a script") as loop:
        for tip in tips:
            felt.append(loop.tick(tip)[0].force)
        loop.mark("deep")
        assert not file.exists()  # until it is finished
    with Session(file) as run:
        assert run.header["notes"] == "by a script"
        assert run.header["ended_by"] == "done"
        np.testing.assert_array_equal(run.samples(["force"])["force"], felt)
        assert [(event["kind"], event["tick"]) for event in run.events() if event["kind"] == "mark"] == [("mark", 299)]
        assert run.replay().identical
    finger = palpate.Finger(torso)
    np.testing.assert_array_equal(felt, [finger.step(tip).force for tip in tips])


def test_a_replay_names_the_first_difference(torso, tmp_path):
    """A scene that is not the one that was felt: the file's is changed behind its back."""
    import sqlite3

    file = tmp_path / "changed.session"
    with palpate.devices.Loop(torso, session=file) as loop:
        for tip in torso.tips("T6 right 30 mm", np.linspace(-2.0, 6.0, 200)):
            loop.tick(tip)
    with sqlite3.connect(file) as database:
        database.execute("UPDATE worlds SET scene = scene || char(10) || '[[dysfunction]]' || char(10) || 'at = \"T6 right 30 mm\"'")
    with Session(file) as run:
        report = run.replay()
    assert not report.identical
    assert report.different > 50
    assert report.first_difference.field.startswith("force_")
    assert report.first_difference.recorded != report.first_difference.replayed


def test_what_is_wrong_is_said(recorded, tmp_path):
    file, _ = recorded
    broken = tmp_path / "broken.session"
    broken.write_bytes(b"no session")
    with pytest.raises(palpate.Error) as caught:
        Session(broken)
    assert caught.value.file == str(broken)
    with Session(file) as run:
        with pytest.raises(palpate.Error, match="force_x_n|force"):
            run.samples(["forces"])
        with pytest.raises(palpate.Error, match="indix"):
            run.samples(finger="indix")
        with pytest.raises(IndexError):
            run.samples(finger=2)
        with pytest.raises(ValueError):
            run.samples(span=(20, 10))
    with pytest.raises(ValueError, match="closed"):
        run.samples()


def test_threads_are_told_to_take_one_each(recorded):
    file, _ = recorded
    told = []

    def read(run):
        for _ in range(20):
            try:
                run.samples()
            except RuntimeError as error:
                told.append(str(error))

    with Session(file) as shared:
        threads = [threading.Thread(target=read, args=(shared,)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert all("in use" in words for words in told)
    with Session(file) as own:
        assert len(own.samples(["tick"])["tick"]) == 400


def test_a_torn_session_is_mended_and_its_loss_is_told(recorded, tmp_path):
    file, exported = recorded
    whole = repair(file, tmp_path / "whole.session")
    assert whole.nothing_lost and whole.samples == 800 and whole.lost == []
    torn = tmp_path / "torn.session"
    torn.write_bytes(file.read_bytes()[: file.stat().st_size // 2])
    before = torn.read_bytes()
    mended = repair(torn, tmp_path / "mended.session")
    assert torn.read_bytes() == before, "only read"
    assert not mended.nothing_lost and mended.bytes_missing > 0
    if mended.samples:
        with Session(tmp_path / "mended.session") as run:
            kept = run.samples(["tick", "force"])
            rows = np.searchsorted(exported["index.tick"], kept["tick"])
            assert (kept["force"][:, 0] == exported["index.force_x_n"][rows]).all()
    with pytest.raises(palpate.Error, match="already"):
        repair(file, tmp_path / "whole.session")
    assert repair(file, tmp_path / "whole.session", overwrite=True).nothing_lost
    with pytest.raises(palpate.Error):
        repair(tmp_path / "nowhere.session", tmp_path / "other.session")
