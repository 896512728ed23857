"""What is felt is the same to the bit, whichever way it is asked for: step, rollout, Fingers, and the command."""

from __future__ import annotations

import csv
import subprocess

import numpy as np
import pytest

import palpate
from conftest import dome, landed, wander

SCENE = """
seconds = 0.6
[body]
kind = "torso"
[friction]
static = 0.6
dynamic = 0.3
[tissue]
relaxation = 0.15
[[finger]]
name = "point"
at = "T6 right 30 mm"
script = [ { do = "press", depth_mm = 7, seconds = 0.2 }, { do = "drag", by_mm = [0, 25], seconds = 0.3 }, { do = "lift", seconds = 0.1 } ]
[[finger]]
name = "ball"
radius_mm = 8
at = "T9 left 30 mm"
script = [ { do = "press", depth_mm = 5, seconds = 0.2 }, { do = "circle", radius_mm = 9, seconds = 0.4 } ]
"""
STATES = {"free": 0, "stick": 1, "slip": 2}


@pytest.fixture(scope="module")
def simulated(command, tmp_path_factory):
    """The world of SCENE, and of each of its fingers what `palpate simulate` wrote: tips, forces, depths, states."""
    folder = tmp_path_factory.mktemp("simulated")
    (folder / "scene.toml").write_text(SCENE)
    subprocess.run([command, "simulate", "scene.toml", "--no-pictures", "--no-plot", "--out", "out"], cwd=folder, check=True,
                   capture_output=True)
    rows: dict[str, list[dict[str, str]]] = {}
    with open(folder / "out" / "forces.csv", newline="") as file:
        for row in csv.DictReader(file):
            rows.setdefault(row["finger"], []).append(row)

    def column(finger, *names):
        return np.array([[float(row[name]) for name in names] for row in rows[finger]])

    felt = [
        {
            "tip": column(finger, "tip_x_mm", "tip_y_mm", "tip_z_mm"),
            "force": column(finger, "force_x_n", "force_y_n", "force_z_n"),
            "depth": column(finger, "depth_mm")[:, 0],
            "state": np.array([STATES[row["state"]] for row in rows[finger]]),
            "triangle": np.array([int(row["triangle"]) for row in rows[finger]]),
        }
        for finger in rows
    ]
    return palpate.World.load(folder / "scene.toml"), felt


def test_the_simulation_touches_sticks_and_slips(simulated):
    _, felt = simulated
    assert len(felt) == 2
    assert {0, 1, 2} <= set(felt[0]["state"].tolist())


@pytest.mark.parametrize("threads", [1, 2])
def test_rollout_feels_what_the_command_wrote(simulated, threads):
    world, felt = simulated
    ticks = min(len(finger["tip"]) for finger in felt)
    rolled = world.rollout(np.stack([finger["tip"][:ticks] for finger in felt]), threads=threads)
    for i, finger in enumerate(felt):
        for name in ("force", "depth", "state", "triangle"):
            np.testing.assert_array_equal(rolled[name][i], finger[name][:ticks], err_msg=name)


def test_step_feels_what_the_command_wrote(simulated):
    world, felt = simulated
    for settings, finger in zip(world.finger_settings(2), felt):
        stepped = palpate.Finger(world, settings)
        forces = np.array([stepped.step(tip).force for tip in finger["tip"]])
        np.testing.assert_array_equal(forces, finger["force"])


def test_a_batch_feels_what_the_command_wrote(simulated):
    world, felt = simulated
    fingers = palpate.Fingers(world, 2)
    for tick in range(min(len(finger["tip"]) for finger in felt)):
        now = fingers.step([finger["tip"][tick] for finger in felt])
        np.testing.assert_array_equal(now["force"], [finger["force"][tick] for finger in felt])


def test_threads_do_not_change_what_is_felt(dome_world):
    tips = wander(64, 300)
    assert tips.shape[0] * tips.shape[1] > 3 * 2500, "or no second thread would be woken"
    one, two = dome_world.rollout(tips), dome_world.rollout(tips, threads=2)
    assert np.count_nonzero(one["state"]) > 1000
    for name, values in one.items():
        np.testing.assert_array_equal(values, two[name])


def test_substeps_go_in_a_straight_line(dome_world):
    tips, substeps = wander(300, 40)[:, ::10], 20
    fingers = palpate.Fingers(dome_world, len(tips), threads=2)
    got = [fingers.step(tips[:, tick], substeps=substeps)["force"] for tick in range(tips.shape[1])]
    share = (np.arange(1, substeps + 1) / substeps)[None, :, None]
    path = [np.repeat(tips[:, :1], substeps, axis=1)]
    for tick in range(1, tips.shape[1]):
        way = tips[:, tick - 1, None] + (tips[:, tick] - tips[:, tick - 1])[:, None] * share
        way[:, -1] = tips[:, tick]
        path.append(way)
    rolled = dome_world.rollout(np.concatenate(path, axis=1))["force"][:, substeps - 1 :: substeps]
    np.testing.assert_array_equal(np.stack(got, axis=1), rolled)
    assert np.count_nonzero(rolled) > 100


def test_step_takes_arrays_lists_tuples_and_numbers(dome_world):
    tip = [3.0, 4.0, 17.5]
    given = [
        (np.array(tip),),
        (tip,),
        (tuple(tip),),
        tuple(tip),
        (np.array([[9.0, *tip], [1.0, 1.0, 1.0, 1.0]])[0, 1:],),
        (np.array([tip, tip]).T[:, 0],),
        (np.array(tip, dtype=">f8"),),
        (np.array(tip, dtype=np.float32),),
        ([np.float64(x) for x in tip],),
        (np.array([3, 4, 17.5], dtype=object).astype(float),),
    ]
    forces = [tuple(landed(dome_world).step(*one).force) for one in given]
    assert forces[0][2] > 0.1
    assert set(forces) == {forces[0]}
    assert landed(dome_world).step(3, 4, 17).depth_mm == landed(dome_world).step([3, 4, 17]).depth_mm > 0
    finger = palpate.Finger(dome_world)
    for wrong in [((1.0, 2.0),), ([1.0, 2.0, 3.0, 4.0],), (np.zeros((1, 3)),), (np.zeros(2),)]:
        with pytest.raises(ValueError, match="tip: expected three numbers"):
            finger.step(*wrong)
    for wrong in [(), (1.0, 2.0), ("abc",), (None,), (["a", "b", "c"],), (1.0, 2.0, "z")]:
        with pytest.raises((TypeError, ValueError)):
            finger.step(*wrong)
    with pytest.raises(TypeError):
        palpate.Finger.step([1, 2, 3])
    with pytest.raises(TypeError):
        palpate.Finger.step("no finger", [1, 2, 3])


def test_a_tip_that_is_not_finite_is_lost(dome_world):
    finger = landed(dome_world)
    finger.step(0, 0, 17)
    before = finger.step(0, 0, 17)
    assert before.force.any()
    for wrong in (np.nan, np.inf, 1e200):
        lost = finger.step(wrong, 0, 17)
        assert lost.status == 1 and not lost.force.any() and lost.state == "free"
    after = finger.step(0, 0, 17)
    np.testing.assert_array_equal(after.force, before.force)
    rolled = dome_world.rollout(np.full((1, 3, 3), np.nan))
    assert np.all(rolled["status"] == 1) and not rolled["force"].any()
    fingers = palpate.Fingers(dome_world, 2)
    assert fingers.step([[np.nan, 0, 0], [0, 0, 30]], substeps=5)["status"].tolist() == [1, 0]
    fingers.step([[0, 0, 30], [np.nan, 0, 0]], substeps=5)
    assert fingers.step([[0, 0, 17], [0, 0, 17]], substeps=5)["depth"].min() > 0


def test_lift_and_reset(dome_world):
    finger = landed(dome_world)
    pressed = finger.step(0, 0, 16)
    assert pressed.state != "free"
    assert finger.step(60, 60, 0).state != "free", "it is dragged there under the skin"
    finger.lift()
    assert finger.step(60, 60, 0).state == "free", "it begins there, under the sheet"
    finger.reset()
    finger.step(0, 0, 60)
    np.testing.assert_array_equal(finger.step(0, 0, 16).force, pressed.force)
    fingers = palpate.Fingers(dome_world, 3)
    for forget in (fingers.reset, fingers.lift):
        fingers.step([[0, 0, 60]] * 3)
        assert fingers.step([[0, 0, 16]] * 3)["depth"].all()
        forget(np.array([True, False, True]))
        assert (fingers.step([[5, 0, 16]] * 3, substeps=3)["state"] != 0).tolist() == [False, True, False]
        forget()
        assert not fingers.step([[5, 0, 16]] * 3)["state"].any()
    for wrong in ([True], np.zeros(3), "abc"):
        with pytest.raises(ValueError, match="mask"):
            fingers.reset(wrong)


def test_fingers_are_shared_among_worlds(dome_world):
    vertices, faces = dome()
    hard = palpate.World.from_arrays(vertices, faces, stiffness=2.0)
    shared, alone = palpate.Fingers([dome_world, hard], 3), [palpate.Fingers(world, 1) for world in (dome_world, hard)]
    assert shared.world is dome_world and shared.worlds == [dome_world, hard]
    shared.reset(np.array([False, True, True]), np.array([1, 1, 0]))
    path = np.linspace([0, 0, 30.0], [8.0, 4.0, 14.0], 30)
    for tip in path:
        felt = shared.step(np.tile(tip, (3, 1)), substeps=2)
        one, other = (fingers.step(tip[None], substeps=2) for fingers in alone)
        for name in felt:
            np.testing.assert_array_equal(felt[name], np.concatenate([one[name], other[name], one[name]]))
    assert felt["force"][1, 2] > 3 * felt["force"][0, 2]
    shared.reset()
    assert (shared.step(np.tile(path[-1], (3, 1)))["state"] == 0).all(), "each begins again in the world that it is in"
    for wrong in ([0, 1], [0.0, 1.0, 0.0], [0, 2, 0], [0, -1, 0], "abc"):
        with pytest.raises(ValueError, match="worlds"):
            shared.reset(None, wrong)
    for wrong in (3, [dome_world, 3], "torso"):
        with pytest.raises(TypeError, match="world"):
            palpate.Fingers(wrong, 3)
    with pytest.raises(ValueError, match="world"):
        palpate.Fingers([], 3)


def test_fingers_outside_the_mask_stand_still(dome_world):
    some, all_of_them = palpate.Fingers(dome_world, 3), palpate.Fingers(dome_world, 3)
    out = some.step([[0, 0, 30]] * 3)
    all_of_them.step([[0, 0, 30]] * 3)
    for _ in range(4):
        some.step([[3, 0, 10]] * 3, substeps=50, out=out, mask=np.array([True, False, False]))
    assert out["depth"].tolist()[1:] == [0, 0] and out["depth"][0] > 5
    felt = some.step([[3, 0, 16]] * 3, substeps=50, out=out, mask=np.array([False, True, True]))
    wanted = all_of_them.step([[3, 0, 16]] * 3, substeps=50)
    for name in wanted:
        np.testing.assert_array_equal(felt[name][1:], wanted[name][1:])
    for options in ({"mask": np.ones(3, bool)}, {"mask": np.ones(2, bool), "out": out}, {"mask": np.ones(3), "out": out}):
        with pytest.raises(ValueError, match="mask"):
            some.step([[0, 0, 30]] * 3, **options)


def test_a_touch_says_all_that_was_felt(dome_world):
    finger = landed(dome_world)
    touch = finger.step(10, 0, 16)
    rolled = dome_world.rollout([[[0, 0, 60], [10, 0, 16]]], fields=["force", "depth", "proxy", "anchor", "normal", "triangle", "state",
                                                         "status", "tip", "hold", "tissue", "rest", "anchor_triangle"])
    for name in ("force", "proxy", "anchor", "normal", "tip", "hold"):
        np.testing.assert_array_equal(rolled[name][0, 1], getattr(touch, name))
        assert rolled[name].shape == (1, 2, 3)
    numbers = (touch.depth_mm, touch.triangle, STATES[touch.state], touch.status, touch.tissue_mm, touch.rest_mm,
               touch.anchor_triangle)
    names = ("depth", "triangle", "state", "status", "tissue", "rest", "anchor_triangle")
    assert numbers == tuple(rolled[name][0, 1] for name in names)
    assert touch.depth_mm == pytest.approx(np.linalg.norm(touch.tip - touch.proxy), rel=1e-6)
    assert "stick" in repr(touch)
    free = finger.step(0, 0, 100)
    assert (free.state, free.triangle, free.depth_mm) == ("free", -1, 0.0)
    np.testing.assert_array_equal(free.proxy, free.tip)


def test_settings_are_checked_when_made(dome_world):
    settings = palpate.FingerSettings(radius_mm=8, mu_static=0.5, mu_dynamic=0.25, force_shading=False)
    assert eval(repr(settings), {"FingerSettings": palpate.FingerSettings}) == settings
    assert repr(palpate.FingerSettings()) == "FingerSettings()"
    assert settings.replace(radius_mm=4).radius_mm == 4 and settings.radius_mm == 8
    assert hash(settings) == hash(settings.replace()) and settings != settings.replace(tick_s=0.002)
    for wrong in ({"mu_dynamic": 0.9}, {"radius_mm": -1}, {"radius_mm": 1e9}, {"tick_s": 0}, {"relaxation_share": 0.95}):
        with pytest.raises(palpate.Error):
            palpate.FingerSettings(**wrong)
        with pytest.raises(palpate.Error):
            palpate.FingerSettings().replace(**wrong)
    for wrong in ({"radius": 1}, {"radius_mm": "8"}):
        with pytest.raises((TypeError, RuntimeError)):
            palpate.FingerSettings(**wrong)
    with pytest.raises(TypeError):
        palpate.FingerSettings(8)
    with pytest.raises(AttributeError):
        settings.radius_mm = 3
    assert palpate.Finger(dome_world, settings).settings == settings
    box = dome_world.rebuilt('[contact]\nsource = "hdb"\n')
    with pytest.raises(palpate.Error, match="radius_mm must be 0"):
        palpate.Finger(box, settings)
    assert landed(dome_world, settings).step(0, 0, 27).state != "free"
    assert landed(dome_world).step(0, 0, 27).state == "free"


def test_settings_of_many_fingers(dome_world):
    tips = wander(3, 50)
    ball = palpate.FingerSettings(radius_mm=6)
    mixed = [palpate.FingerSettings(), ball, palpate.FingerSettings(mu_static=0, mu_dynamic=0)]
    together = dome_world.rollout(tips, settings=mixed)["force"]
    for i, settings in enumerate(mixed):
        np.testing.assert_array_equal(together[i], dome_world.rollout(tips[i : i + 1], settings=settings)["force"][0])
    with pytest.raises(ValueError, match="2 given for 3"):
        dome_world.rollout(tips, settings=mixed[:2])
    for wrong in (8, "ball", [1, 2, 3]):
        with pytest.raises((TypeError, RuntimeError)):
            dome_world.rollout(tips, settings=wrong)


def test_fields_and_out(dome_world):
    tips = wander(4, 30)
    assert list(dome_world.rollout(tips)) == ["force", "depth", "proxy", "anchor", "normal", "triangle", "state", "status"]
    two = dome_world.rollout(tips, fields=("force", "depth"))
    assert {name: array.shape for name, array in two.items()} == {"force": (4, 30, 3), "depth": (4, 30)}
    kept = {"force": np.full((4, 30, 3), 7.0), "triangle": np.zeros((4, 30), np.int32)}
    arrays = dict(kept)
    assert dome_world.rollout(tips, out=kept) is kept
    assert all(kept[name] is array for name, array in arrays.items())
    np.testing.assert_array_equal(kept["force"], two["force"])
    only = {"force": np.full((4, 30, 3), 7.0), "depth": np.full((4, 30), 7.0)}
    dome_world.rollout(tips, out=only, fields=["depth"])
    assert np.all(only["force"] == 7.0) and np.array_equal(only["depth"], two["depth"])
    strided = np.zeros((4, 30, 6))[:, :, ::2]
    locked = np.zeros((4, 30, 3))
    locked.flags.writeable = False
    for wrong in (np.zeros((4, 30)), np.zeros((4, 30, 3), np.float32), strided, locked, [[[0, 0, 0]]], None):
        with pytest.raises(ValueError, match="out"):
            dome_world.rollout(tips, out={"force": wrong}) if wrong is not None else dome_world.rollout(
                tips, out={}, fields=["force"])
    assert dome_world.rollout(tips, fields=["lump_moved"])["lump_moved"].shape == (4, 30, 2)
    with pytest.raises(ValueError, match="'forces' is unknown; expected any of force, depth"):
        dome_world.rollout(tips, fields=["forces"])
    with pytest.raises(TypeError, match="fields"):
        dome_world.rollout(tips, fields="force")
    with pytest.raises(ValueError, match=r"tips\[None\]"):
        dome_world.rollout(tips[0])
    with pytest.raises(ValueError, match="threads"):
        dome_world.rollout(tips, threads=0)
    assert dome_world.rollout(np.zeros((0, 5, 3)))["force"].shape == (0, 5, 3)
    assert dome_world.rollout(np.zeros((2, 0, 3)))["force"].shape == (2, 0, 3)


def test_answers_are_fresh(dome_world):
    fingers = palpate.Fingers(dome_world, 2)
    fingers.step([[0, 0, 60]] * 2)
    first = fingers.step([[0, 0, 16]] * 2)["force"]
    kept = first.copy()
    second = fingers.step([[0, 0, 10]] * 2)["force"]
    np.testing.assert_array_equal(first, kept)
    assert not np.shares_memory(first, second) and not np.array_equal(first, second)
