"""Lumps under the skin and the pressure under a fingertip: felt as the scene file's are, in the same bits."""

from __future__ import annotations

import numpy as np
import pytest

import palpate

PLACE = "T9 right 30 mm"
HARD = dict(at=PLACE, depth_mm=6, diameter_mm=10, stiffness_ratio=15)
SCENE = """
[body]
kind = "torso"
[[lump]]
at = "T9 right 30 mm"
depth_mm = 6
stiffness_ratio = 15
"""
TIP = palpate.FingerSettings(radius_mm=8)


@pytest.fixture(scope="module")
def lumpy() -> palpate.World:
    return palpate.World(lumps=[palpate.Lump(**HARD)], body="torso")


def press(world: palpate.World, depth_mm: float = 6.0, aside_mm: float = 0.0, ticks: int = 300) -> np.ndarray:
    """A path (1, ticks, 3) of a fingertip down to this depth, beside the lump towards the head."""
    tips = world.tips(PLACE, np.linspace(-12.0, depth_mm - 8.0, ticks))
    return (tips + [0.0, aside_mm, 0.0])[None]


def test_a_world_with_lumps_is_that_of_the_scene_file(lumpy):
    parsed = palpate.World.parse(SCENE)
    tips = press(parsed)
    felt, wanted = (world.rollout(tips, settings=TIP) for world in (lumpy, parsed))
    for name, values in wanted.items():
        np.testing.assert_array_equal(felt[name], values, err_msg=name)
    added = palpate.World.torso().with_lumps([palpate.Lump(**HARD)])
    np.testing.assert_array_equal(added.rollout(tips, settings=TIP)["force"], felt["force"])
    bare = added.with_lumps([])
    assert bare.lumps == [] and not bare.rollout(tips, settings=TIP, fields=["lump_force"])["lump_force"].any()


def test_a_world_tells_its_lumps(lumpy):
    (lump,) = lumpy.lumps
    assert lump["name"] == "lump1" and lump["depth_mm"] == 6 and lump["half_axes_mm"].tolist() == [5, 5, 5]
    np.testing.assert_allclose(lump["foot"], lumpy.place(PLACE), atol=1.0)
    assert lump["young_kpa"] == pytest.approx(15 * lump["layer_kpa"])
    assert set(lump["share"]) == {3.0, 5.0, 8.0} and lump["share"][3.0] > 0.02
    assert np.cross(lump["across"], lump["up"]) @ lump["axis"] == pytest.approx(1.0)


def test_the_force_of_a_lump_is_part_of_the_force(lumpy):
    felt = lumpy.rollout(press(lumpy), settings=TIP)
    bare = lumpy.with_lumps(None).rollout(press(lumpy), settings=TIP)
    np.testing.assert_allclose(felt["force"] - felt["lump_force"], bare["force"], atol=1e-9)
    assert felt["lump_share"][0, -1] > 0.02 and felt["lump"].max() == -1, "it does not move"
    normal = felt["normal"][0, -1]
    share = felt["lump_force"][0, -1] @ normal / ((felt["force"] - felt["lump_force"])[0, -1] @ normal)
    assert felt["lump_share"][0, -1] == pytest.approx(share, rel=0.05)
    finger = palpate.Finger(lumpy, TIP)
    for tip in press(lumpy)[0]:
        touch = finger.step(tip)
    for name, value in (("lump_force", touch.lump_force), ("lump_share", touch.lump_share), ("lump", touch.lump),
                        ("lump_moved", touch.lump_moved), ("radius", touch.radius_mm)):
        np.testing.assert_array_equal(felt[name][0, -1], value)


def test_a_lump_is_made_like_a_table_of_a_scene():
    lump = palpate.Lump(at=PLACE, depth_mm=6, mobility_mm_per_n=5, name="node")
    assert eval(repr(lump), {"Lump": palpate.Lump}) == lump and hash(lump) == hash(eval(repr(lump), {"Lump": palpate.Lump}))
    assert lump.at == PLACE and lump.name == "node" and lump != palpate.Lump(at=PLACE)
    assert palpate.Lump(at=(3, 4)).at == palpate.Lump(at=[3.0, 4.0, 99.0]).at == (3.0, 4.0)
    assert palpate.Lump(at=PLACE, half_axes_mm=(6, 6, 3)).half_axes_mm.tolist() == [6, 6, 3]
    wrong = [({"diameter_mm": 1}, "diameter_mm = 1 is out of range: 2 to 40"), ({"edge": 2}, "edge"),
             ({"stiffness_ratio": 5, "young_kpa": 60}, "not both"), ({"young_kpa": -1}, "young_kpa"),
             ({"diameter_mm": 5, "half_axes_mm": (6, 6, 3)}, "not both"), ({"half_axes_mm": (6, 5, 3)}, "round"),
             ({"depth_mm": np.nan}, "depth_mm"), ({"mobility_mm_per_n": 0.01}, "mobility_mm_per_n")]
    for keys, words in wrong:
        with pytest.raises(palpate.Error, match=words):
            palpate.Lump(at=PLACE, **keys)
    with pytest.raises(TypeError):
        palpate.Lump(PLACE)
    with pytest.raises(ValueError, match="at"):
        palpate.Lump(at=[1.0])


def test_lumps_that_cannot_be_there_are_refused(lumpy, dome_world):
    for lumps, words in (([palpate.Lump(at=PLACE, depth_mm=0.5)], "depth_mm = 0.5 in .*out of range"),
                         ([palpate.Lump(at=PLACE, depth_mm=60)], "reaches the bone"),
                         ([palpate.Lump(at="T66")], "T6"),
                         ([palpate.Lump(**HARD), palpate.Lump(**HARD)], "overlap")):
        with pytest.raises(palpate.Error, match=words):
            lumpy.with_lumps(lumps)
    with pytest.raises(palpate.Error, match="layered tissue"):
        dome_world.with_lumps([palpate.Lump(at=(0, 0))])
    for wrong in (3, "lump", [1]):
        with pytest.raises(TypeError, match="palpate.Lump"):
            lumpy.with_lumps(wrong)
    with pytest.raises(ValueError, match="body"):
        palpate.World(body="head")


def test_pressures_add_up_to_what_was_felt(lumpy):
    felt = lumpy.rollout(press(lumpy, aside_mm=4.0), settings=TIP)
    for n in (2, 4, 8, 16):
        kpa = lumpy.pressure(felt, n)
        assert kpa.shape == (1, 300, n, n) and kpa.min() >= 0
        newton = kpa.sum(axis=(2, 3)) * (16.0 / n) ** 2 / 1000.0
        np.testing.assert_allclose(newton, (felt["force"] * felt["normal"]).sum(axis=2), rtol=1e-9, atol=1e-12)
        assert not kpa[felt["state"] == 0].any()
    shear = lumpy.pressure(felt, 4, 20.0, shear=True)
    assert shear.shape == (1, 300, 4, 4, 3)
    np.testing.assert_array_equal(shear[..., 0], lumpy.pressure(felt, 4, pad_mm=20.0))


def test_the_pattern_shows_on_which_side_the_lump_is(lumpy):
    """The first row is nearest to the head: beside the lump towards the head, the lump is at the last row."""
    bare = lumpy.with_lumps([])
    fields = ("force", "depth", "normal", "state", "tissue", "radius")
    for aside_mm in (5.0, -5.0):
        tips = press(lumpy, aside_mm=aside_mm)
        over = lumpy.pressure(lumpy.rollout(tips, settings=TIP))
        rows = (over - bare.pressure(bare.rollout(tips, settings=TIP, fields=fields)))[0, -1].sum(axis=1)
        assert (rows[3] > rows[0]) == (aside_mm > 0), rows


def test_a_pattern_is_the_same_however_it_is_asked_for(lumpy):
    tips = press(lumpy)
    rolled = lumpy.pressure(lumpy.rollout(tips, settings=TIP))
    finger, fingers = palpate.Finger(lumpy, TIP), palpate.Fingers(lumpy, 2, settings=TIP)
    for tick in range(tips.shape[1]):
        touch = finger.step(tips[0, tick])
        batch = fingers.step(np.repeat(tips[:, tick], 2, axis=0))
    assert touch.lump_share > 0
    np.testing.assert_array_equal(lumpy.pressure(touch), rolled[0, -1])
    np.testing.assert_array_equal(lumpy.pressure([touch, touch])[1], rolled[0, -1])
    np.testing.assert_array_equal(lumpy.pressure(fingers.touches()), lumpy.pressure(batch))
    assert lumpy.pressure(batch).shape == (2, 4, 4)


def test_a_mobile_lump_moves_and_is_back_after_a_reset():
    world = palpate.World(lumps=[palpate.Lump(**HARD, mobility_mm_per_n=20)], body="torso")
    finger = palpate.Finger(world, TIP)
    tips = press(world, depth_mm=8.0, aside_mm=4.0)[0]
    first = [finger.step(tip) for tip in tips]
    assert np.linalg.norm(first[-1].lump_moved) > 0.01 and first[-1].lump == 0
    finger.lift()
    moved = finger.step(tips[-1])
    finger.reset()
    again = [finger.step(tip) for tip in tips]
    assert all(np.array_equal(one.force, other.force) for one, other in zip(first, again))
    np.testing.assert_array_equal(world.pressure(again[-1]), world.pressure(first[-1]))
    assert moved.status == again[0].status


def test_a_body_that_breathes_needs_to_know_when():
    world = palpate.World.parse(SCENE.replace("torso", "trunk") + "[breathing]\non = true\n")
    felt = world.rollout(press(world), settings=TIP)
    kpa = world.pressure(felt)
    np.testing.assert_array_equal(world.pressure(felt, tick=np.arange(300)), kpa)
    now = {name: values[:, -1] for name, values in felt.items()}
    with pytest.raises(ValueError, match="breathes"):
        world.pressure(now)
    np.testing.assert_array_equal(world.pressure(now, tick=299), kpa[:, -1])


def test_nonsense_is_refused(lumpy, dome_world):
    felt = lumpy.rollout(press(lumpy, ticks=20), settings=TIP)
    for options, words in (({"n": 1}, "pad = 1 is out of range: 2 to 16"), ({"n": 17}, "2 to 16"),
                           ({"pad_mm": 0.5}, "1 to 100"), ({"pad_mm": np.nan}, "1 to 100")):
        with pytest.raises(palpate.Error, match=words):
            lumpy.pressure(felt, **options)
    with pytest.raises(ValueError, match="has no 'tip'"):
        lumpy.pressure({name: values for name, values in felt.items() if name != "tip"})
    with pytest.raises(ValueError, match="the shape of"):
        lumpy.pressure({**felt, "force": felt["force"][:, 1:]})
    with pytest.raises(TypeError, match="Touch"):
        lumpy.pressure([1, 2])
    with pytest.raises(palpate.Error, match="layered tissue"):
        dome_world.pressure(palpate.Finger(dome_world).step(0, 0, 60))
    broken = {**felt, "force": np.full_like(felt["force"], np.nan)}
    assert not lumpy.pressure(broken).any(), "what is not finite has no pattern"


def test_an_environment_observes_pressures(lumpy):
    options = dict(around=PLACE, reach_mm=20.0, settings=TIP)
    plain, wide = (palpate.env.VectorEnv(lumpy, 3, observe=word, **options) for word in ("touch", "pressure4"))
    down = np.tile([0.0, 0.0, -1.0], (3, 1))
    one, two = plain.reset(seed=4)[0], wide.reset(seed=4)[0]
    for _ in range(8):
        np.testing.assert_array_equal(one, two[:, :7])
        one, two = plain.step(down)[0], wide.step(down)[0]
    assert two.shape == (3, 23) == wide.observation_space.shape and two.dtype == np.float32
    assert wide.observation_space.contains(two) and two[:, 7:].max() > 1.0
    np.testing.assert_allclose(two[:, 7:].sum(axis=1) * 0.016, np.linalg.norm(two[:, 3:6], axis=1), rtol=0.2)
    for wrong in ("pressure1", "pressure17", "pressure", "pressure-4", "force", "pressure4x4"):
        with pytest.raises(ValueError, match="observe"):
            palpate.env.VectorEnv(lumpy, 3, observe=wrong, **options)
