"""Devices that need no hardware: a script, a playback, a simulated hand; loops by hand and by the servo thread."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import palpate
from palpate import devices


def test_probe_says_what_the_command_says(command):
    answer = subprocess.run([command, "devices", "--json"], capture_output=True, text=True).stdout
    theirs = {row["name"]: row for row in json.loads(answer)}
    ours = {row["name"]: row for row in devices.probe()}
    assert list(ours) == list(theirs)
    for name, row in ours.items():
        if name == "mouse":  # the command lends it a window's link
            continue
        assert (row["available"], row["reason"]) == (theirs[name]["available"], theirs[name]["reason"]), name


def test_a_name_that_is_none_is_answered_with_the_nearest():
    with pytest.raises(palpate.Error, match="playback"):
        devices.open("playbak:file.csv")
    with pytest.raises(palpate.Error, match="nowhere.csv"):
        devices.open("playback:nowhere.csv")


def test_a_playback_gives_its_positions_and_rests_at_the_last(tmp_path):
    file = tmp_path / "path.csv"
    file.write_text("t_s,x_mm,y_mm,z_mm\n0,0,0,50\n0.010,10,0,50\n")
    with devices.open(f"playback:{file}") as device:
        read = [device.read() for _ in range(15)]
        np.testing.assert_allclose(np.array(read)[:11, 0], np.arange(11.0), atol=1e-9)
        assert read[14][0] == 10.0
        assert device.read(3)[0] == pytest.approx(3.0)
        device.write([0, 0, 1])  # a device that only points drops it
        assert device.capabilities["takes_force"] is False
    with pytest.raises(ValueError, match="closed"):
        device.read()
    device.close()


def test_a_loop_over_a_script_feels_what_a_finger_feels(torso):
    tips = torso.tips("T9 left 30 mm", np.linspace(-2, 6, 250))
    with devices.Loop(torso, [devices.script(tips)]) as loop:
        felt = [loop.tick()[0].force for _ in tips]
        assert loop.device_forces.shape == (1, 3)
        assert loop.ticks == 250
    finger = palpate.Finger(torso)
    np.testing.assert_array_equal(felt, [finger.step(tip).force for tip in tips])


def test_a_device_that_is_lent_is_in_use_until_it_is_given_back(torso):
    device = devices.script([[0.0, 0.0, 900.0]])
    with devices.Loop(torso, [device]):
        with pytest.raises(RuntimeError, match="in use"):
            device.read()
        with pytest.raises(RuntimeError, match="in use"):
            devices.Loop(torso, [device])
    assert device.read() == pytest.approx([0.0, 0.0, 900.0])
    with pytest.raises(RuntimeError, match="in use"):
        devices.Loop(torso, [device, device])


def test_forces_are_limited_on_their_way_to_a_hand(torso):
    """A simulated hand on a simulated Omni: it may be sent 3.3 N and no more, however stiff the skin."""
    with devices.open("hand:stylus_z,omni", origin_mm=torso.place("T6 right 30 mm") + [0, 0, 20.0]) as hand:
        assert hand.capabilities["takes_force"] is True
        most = hand.capabilities["max_force_n"]
        with devices.Loop(torso, [hand]) as loop:
            forces = []
            for _ in range(400):
                loop.tick()
                forces.append(np.linalg.norm(loop.device_forces[0]))
    assert max(forces) <= (most or 3.3) + 1e-9


def test_the_servo_thread_records_a_session_that_replays(torso, tmp_path):
    file = tmp_path / "driven.session"
    tips = torso.tips("T6 right 30 mm", np.concatenate([np.linspace(-3, 5, 200), np.linspace(5, -3, 200)]))
    report = devices.drive(torso, [devices.script(tips)], 0.6, session=file)
    assert 300 <= report["ticks"] + report["overruns"] <= 1500
    assert report["compute_us"]["p50"] > 0.0
    with palpate.sessions.Session(file) as run:
        assert run.header["ended_by"] == "done"
        assert run.replay().identical
        assert np.linalg.norm(run.samples(["force"])["force"], axis=1).max() > 0.1


def test_ctrl_c_ends_a_drive_and_keeps_its_session(torso, tmp_path):
    file = tmp_path / "broken_off.session"
    threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        devices.drive(torso, [devices.script([[0.0, 0.0, 900.0]])], 60.0, session=file)
    assert time.monotonic() - begun < 5.0
    with palpate.sessions.Session(file) as run:
        assert run.header["ended_by"] == "interrupted"


def test_another_thread_of_python_runs_beside_a_drive(torso):
    count = 0
    end = threading.Event()

    def counting():
        nonlocal count
        while not end.is_set():
            count += 1

    thread = threading.Thread(target=counting)
    thread.start()
    devices.drive(torso, [devices.script([[0.0, 0.0, 900.0]])], 0.3)
    end.set()
    thread.join()
    assert count > 1000


def test_what_makes_no_sense_is_refused(torso):
    with pytest.raises(ValueError, match="tips"):
        devices.script([[0.0, 0.0, math.nan]])
    with pytest.raises(ValueError, match="seconds"):
        devices.drive(torso, [devices.script([[0, 0, 900]])], -1)
    with devices.Loop(torso, fingers=2) as loop:
        with pytest.raises(ValueError, match="no device moves the fingers"):
            loop.tick()
        with pytest.raises(ValueError, match=r"\(2, 3\)"):
            loop.tick([0.0, 0.0, 900.0])
        assert [touch.state for touch in loop.tick([[0, 0, 900], [9, 0, 900]])] == ["free", "free"]
        with pytest.raises(ValueError, match="does not record a session"):
            loop.mark("here")
    with pytest.raises(ValueError, match="closed"):
        loop.tick([[0, 0, 900], [9, 0, 900]])
