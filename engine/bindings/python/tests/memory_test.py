"""Views: whose memory they are, that nobody writes it, that copies are whole, and that nothing is left behind."""

from __future__ import annotations

import gc
import resource
import sys
import threading
import time

import numpy as np
import pytest

import palpate
from conftest import dome, wander

WORLD_VIEWS = ("positions", "normals", "triangles", "stiffness", "source_vertex", "source_triangle", "built_vertex",
               "built_triangle")
SKIN_VIEWS = ("positions", "normals", "displacement", "strain")
TOUCH_VIEWS = ("force", "tip", "proxy", "anchor", "hold", "normal")


def own_world() -> palpate.World:
    return palpate.World.from_arrays(*dome(16))


def pressed(world: palpate.World) -> palpate.Touch:
    finger = palpate.Finger(world)
    finger.step(0, 0, 30)
    return finger.step(0, 0, 12)


def deeper_owner(array: np.ndarray) -> object:
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array.base


def test_every_view_keeps_its_owner():
    for make, names in ((own_world, WORLD_VIEWS), (lambda: palpate.Skin(own_world()), SKIN_VIEWS),
                        (lambda: pressed(own_world()), TOUCH_VIEWS)):
        for name in names:
            owner = make()
            view = getattr(owner, name)
            assert deeper_owner(view) is owner, name
            before = view.copy()
            part = view[1:][::-1]
            del owner, view
            gc.collect()
            [own_world() for _ in range(3)]  # memory that was freed would be written
            np.testing.assert_array_equal(part, before[1:][::-1], err_msg=name)


def test_the_last_view_lets_its_owner_go():
    world = own_world()
    before = sys.getrefcount(world)
    views = [getattr(world, name)[1:] for name in WORLD_VIEWS]
    assert sys.getrefcount(world) == before + len(views)
    del views
    assert sys.getrefcount(world) == before


def test_what_is_made_on_a_world_keeps_it():
    finger, fingers, skin = (make(own_world()) for make in (palpate.Finger, lambda w: palpate.Fingers(w, 2), palpate.Skin))
    gc.collect()
    finger.step(0, 0, 30)
    fingers.step([[0, 0, 30]] * 2)
    assert finger.step(0, 0, 12).state != "free"
    assert fingers.step([[0, 0, 12]] * 2)["depth"].all()
    skin.apply(finger.step(0, 0, 12))
    assert skin.moved_vertices > 0
    assert len(finger.world.positions) == len(skin.positions)


def test_no_view_can_be_written():
    world = own_world()
    skin, touch = palpate.Skin(world), pressed(world)
    landmarks = palpate.World.torso().landmarks.values()
    for view in [getattr(world, n) for n in WORLD_VIEWS] + [getattr(skin, n) for n in SKIN_VIEWS] + [
            getattr(touch, n) for n in TOUCH_VIEWS] + list(landmarks):
        assert not view.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 1
        with pytest.raises(ValueError):
            view.flags.writeable = True


def test_a_touch_is_a_snapshot():
    finger = palpate.Finger(own_world())
    touch = finger.step(0, 0, 14)
    before = touch.force.copy()
    finger.step(30, 0, 10)
    np.testing.assert_array_equal(touch.force, before)


def test_skin_follows_and_copies_stay():
    world = palpate.World.from_arrays(*dome(60))
    skin = palpate.Skin(world)
    live = skin.positions
    rest = skin.copy()
    np.testing.assert_allclose(rest["positions"], world.positions, atol=1e-4)
    skin.apply([pressed(world)])
    assert skin.moved_vertices > 10 and skin.status == 0
    np.testing.assert_array_equal(live, skin.copy()["positions"])
    moved = np.flatnonzero(np.abs(skin.displacement).sum(axis=1))
    assert np.abs(live - rest["positions"]).max() > 3.0
    assert np.abs(skin.strain).max() > 0
    inside = np.zeros(len(live), bool)
    for first, end in skin.changed:
        inside[first:end] = True
    assert inside[moved].all() and not inside.all()
    skin.apply([])
    np.testing.assert_array_equal(live, rest["positions"])
    assert not palpate.Skin(world, strain=False).strain.any()


def test_skin_takes_touches_and_nothing_else():
    world = own_world()
    skin = palpate.Skin(world, fingers=2)
    touch = pressed(world)
    skin.apply(touch)
    one = skin.copy()["positions"]
    skin.apply((touch,))
    np.testing.assert_array_equal(one, skin.positions)
    fingers = palpate.Fingers(world, 2)
    fingers.step([[0, 0, 30]] * 2)
    fingers.step([[0, 0, 12], [50, 0, 10]])
    skin.apply(fingers.touches())
    assert skin.moved_vertices > 10
    with pytest.raises(ValueError, match="3 are more than the 2"):
        skin.apply([touch] * 3)
    for wrong in (3, [touch, 3], "touch", None):
        with pytest.raises(TypeError, match="touches"):
            skin.apply(wrong)


def test_copies_beside_apply_are_whole():
    """numpy releases the lock while it copies; `copy` does not."""
    world = palpate.World.from_arrays(*dome(60))
    skin = palpate.Skin(world)
    states = []
    for depth in (4.0, 9.0):
        finger = palpate.Finger(world)
        finger.step(0, 0, 30)
        states.append([finger.step(0, 0, 20 - depth)])
    allowed = []
    for touches in states:
        skin.apply(touches)
        allowed.append({name: array.tobytes() for name, array in skin.copy().items()})
    assert allowed[0]["positions"] != allowed[1]["positions"]
    end = time.monotonic() + 2.0
    torn, copies, failed = 0, 0, []

    def alternate() -> None:
        try:
            while time.monotonic() < end:
                for touches in states:
                    skin.apply(touches)
        except RuntimeError as error:
            failed.append(error)

    thread = threading.Thread(target=alternate)
    thread.start()
    seen = set()
    while time.monotonic() < end:
        copy = {name: array.tobytes() for name, array in skin.copy().items()}
        copies += 1
        torn += copy not in allowed
        seen.add(copy["positions"] == allowed[0]["positions"])
    thread.join()
    assert copies > 50 and torn == 0 and not failed
    assert seen == {True, False}, "both states must have been met, or nothing was raced"


def test_memory_stays_flat():
    world = own_world()
    tips = wander(4, 50)

    def work() -> None:
        for _ in range(150):
            world.rollout(tips)
            fingers = palpate.Fingers(world, 4, threads=2)
            fingers.step(tips[:, 0], substeps=4)
            skin = palpate.Skin(world)
            skin.apply(fingers.touches())
            skin.copy()
            palpate.Finger(world).step([0, 0, 12]).force.sum()
            world.rebuilt("")
            for wrong in ("kind = 3", "[body]\nkind = 3"):
                with pytest.raises(palpate.Error):
                    palpate.World.parse(wrong)

    def peak_kb() -> int:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    work()
    before = peak_kb()
    for _ in range(4):
        work()
    assert peak_kb() - before < 6000, "kB more at the peak after four times as much of the same"


def test_out_saves_the_copies(dome_world):
    import tracemalloc

    tips = wander(4, 2000)
    out = dome_world.rollout(tips)
    tracemalloc.start()
    dome_world.rollout(tips, out=out)
    with_out = tracemalloc.get_traced_memory()[1]
    tracemalloc.reset_peak()
    dome_world.rollout(tips)
    without = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert with_out < 20_000 < 800_000 < without
