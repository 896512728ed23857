"""Threads, forks and Ctrl-C: what may run beside what, who is told that something is in use, how soon a call ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import palpate
from conftest import dome, landed, wander


def test_a_second_call_is_told(dome_world):
    fingers = palpate.Fingers(dome_world, 2000)
    tips = wander(2000, 2)
    outcome = []
    thread = threading.Thread(target=lambda: outcome.append(fingers.step(tips[:, 0], substeps=400)))
    thread.start()
    time.sleep(0.02)
    assert not outcome, "the step must still be at work"
    for call in (lambda: fingers.step(tips[:, 1]), fingers.reset, fingers.lift, fingers.touches, fingers.close):
        with pytest.raises(RuntimeError, match="in use by another call"):
            call()
    thread.join()
    assert len(outcome) == 1
    fingers.step(tips[:, 1])  # and is free again


@pytest.mark.parametrize("close", [lambda fingers: fingers.close(), lambda fingers: fingers.__exit__(None, None, None)])
def test_closed_fingers_are_told_apart(dome_world, close):
    fingers = palpate.Fingers(dome_world, 2, threads=2)
    tips = wander(2, 1)[:, 0]
    fingers.step(tips)
    close(fingers)
    for call in (lambda: fingers.step(tips), fingers.reset, fingers.lift, fingers.touches, lambda: fingers.step("nonsense")):
        with pytest.raises(ValueError, match="Fingers are closed"):
            call()
    fingers.close()
    assert fingers.world is dome_world


def test_a_failed_call_leaves_nothing_taken(dome_world):
    fingers = palpate.Fingers(dome_world, 2)
    for _ in range(2):
        with pytest.raises(ValueError):
            fingers.step([[0, 0, 0]])
    fingers.step([[0, 0, 12]] * 2)


def test_hammering_from_many_threads(dome_world):
    """Everything at once on shared objects: right answers or RuntimeError, never anything else."""
    tips = wander(8, 60)
    right = dome_world.rollout(tips)["force"]
    skin, fingers = palpate.Skin(dome_world), palpate.Fingers(dome_world, 8, threads=2)
    finger = landed(dome_world)
    end = time.monotonic() + 3.0
    wrong: list[BaseException] = []
    counts = [0] * 6
    told: list[int] = []

    def loop(which: int, body) -> None:
        try:
            while time.monotonic() < end:
                try:
                    body()
                    counts[which] += 1
                except RuntimeError as error:
                    assert "in use" in str(error)
                    told.append(which)
        except BaseException as error:
            wrong.append(error)

    def roll() -> None:
        assert np.array_equal(dome_world.rollout(tips, threads=2)["force"], right)

    def build() -> None:
        world = palpate.World.from_arrays(*dome(6))
        assert world.rebuilt("").positions.shape == (49, 3)

    bodies = [roll, lambda: skin.apply([finger.step(0, 0, 14)]), lambda: skin.copy()["positions"].sum(),
              lambda: fingers.step(tips[:, 30], substeps=900), build, fingers.touches]
    threads = [threading.Thread(target=loop, args=(i % 6, bodies[i % 6])) for i in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong, wrong
    assert all(count > 3 for count in counts[:5]), counts
    assert set(told) <= {3, 5} and told, "only Fingers are in use while others ask for them"


def run_in_child(body) -> int:
    """The exit code of a forked child that does `body`; -9 when it hung."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            body()
            code = 0
        finally:
            os._exit(code)
    end = time.monotonic() + 20
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return -9


@pytest.mark.parametrize("threads", [1, 2])
def test_a_forked_child_steps_and_ends(dome_world, threads):
    fingers = palpate.Fingers(dome_world, 600, threads=threads)
    tips = wander(600, 2)
    fingers.step(tips[:, 0], substeps=20)  # with threads they run from now on

    def child() -> None:
        ours = fingers.step(tips[:, 1], substeps=20)["force"]
        assert np.array_equal(ours, dome_world_force(dome_world, tips))
        assert dome_world.rollout(wander(64, 100), threads=2)["force"].any()
        fingers.close()

    assert run_in_child(child) == 0
    np.testing.assert_array_equal(fingers.step(tips[:, 1], substeps=20)["force"], dome_world_force(dome_world, tips))


def dome_world_force(world: palpate.World, tips: np.ndarray) -> np.ndarray:
    other = palpate.Fingers(world, len(tips))
    other.step(tips[:, 0], substeps=20)
    return other.step(tips[:, 1], substeps=20)["force"]


def test_a_child_that_is_collected_ends(dome_world):
    held = [palpate.Fingers(dome_world, 600, threads=2)]
    held[0].step(wander(600, 1)[:, 0], substeps=20)
    assert run_in_child(held.clear) == 0


def script(text: str, **options) -> subprocess.Popen:
    folder = os.path.dirname(__file__)
    return subprocess.Popen([sys.executable, "-c", textwrap.dedent(text)], cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, **options)


LONG_CALLS = {
    "rollout": "world.rollout(tips, out=out)",
    "rollout with fresh arrays": "world.rollout(tips)",
    "rollout on two threads": "world.rollout(tips, out=out, threads=2)",
    "Fingers": "palpate.Fingers(world, 64).step(tips[:, 0], substeps=4_000_000, fields=['force'])",
    "Fingers on two threads": "palpate.Fingers(world, 64, threads=2).step(tips[:, 0], substeps=4_000_000)",
}


@pytest.mark.parametrize("call", LONG_CALLS)
def test_ctrl_c_interrupts(call):
    process = script(f"""
        import sys, time, numpy as np, palpate
        from conftest import dome, wander
        world = palpate.World.from_arrays(*dome(20))
        tips = np.repeat(wander(64, 1000), 60, axis=1)
        fields = ["force", "depth"]
        out = {{"force": np.zeros((64, 60_000, 3)), "depth": np.zeros((64, 60_000))}}
        print("ready", flush=True)
        try:
            while True:
                {LONG_CALLS[call]}
        except KeyboardInterrupt:
            print("interrupted", time.time(), flush=True)
        finger = palpate.Finger(world)
        finger.step(0, 0, 60)
        assert finger.step(0, 0, 12).state != "free"
    """)
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.3)
    sent = time.time()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
    word, when = out.split()
    assert word == "interrupted"
    assert float(when) - sent < 0.5


def test_a_build_ends_at_its_next_stage():
    arrays = dome(150)

    def seconds(after: float) -> float:
        """Of a build that a signal meets after so long."""
        signal.setitimer(signal.ITIMER_REAL, after)
        began = time.perf_counter()
        try:
            palpate.World.from_arrays(*arrays)
        except InterruptedError:
            pass
        signal.setitimer(signal.ITIMER_REAL, 0)
        return time.perf_counter() - began

    def handler(*_: object) -> None:
        raise InterruptedError

    before = signal.signal(signal.SIGALRM, handler)
    try:
        whole = min(seconds(1000.0) for _ in range(2))
        assert min(seconds(0.1 * whole) for _ in range(3)) < 0.7 * whole
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_process_ends_with_threads_at_work():
    """Daemon threads inside the engine when the interpreter goes away: nothing is torn down under them."""
    process = script("""
        import threading, time, palpate
        from conftest import dome, wander
        world = palpate.World.from_arrays(*dome(20))
        fingers = palpate.Fingers(world, 600, threads=2)
        tips = wander(600, 1)[:, 0]
        def work():
            while True:
                try:
                    fingers.step(tips, substeps=50)
                except RuntimeError:
                    pass
                world.rollout(tips[None])
        for _ in range(3):
            threading.Thread(target=work, daemon=True).start()
        time.sleep(0.3)
        print("end", flush=True)
    """)
    out, err = process.communicate(timeout=30)
    assert (process.returncode, out) == (0, "end\n"), err
