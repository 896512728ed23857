"""Tools of several pads: each pad is a finger, a wrench is what they add up to, and the mask and worlds of Fingers."""

from __future__ import annotations

import numpy as np
import pytest

import palpate
from conftest import dome
from palpate import Tools

PLAIN = palpate.FingerSettings(mu_static=0.46, mu_dynamic=0.44)


def rotations(vectors: np.ndarray) -> np.ndarray:
    """Rotations (n, 3, 3) about vectors (n, 3), whose lengths are the angles, rad, by a power series."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    skew = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    turned = term = np.tile(np.eye(3), (len(vectors), 1, 1))
    for k in range(1, 20):
        term = term @ skew / k
        turned = turned + term
    return turned


def way(n: int, ticks: int) -> tuple[np.ndarray, np.ndarray]:
    """Poses (ticks, n, ...) of heads that come down on the dome, slide and tilt."""
    random, time = np.random.default_rng(1), np.linspace(0, 1, ticks)[:, None, None]
    start = np.concatenate([random.uniform(-15, 15, (n, 2)), np.full((n, 1), 30.0)], axis=1)
    positions = start + time * np.concatenate([random.uniform(-10, 10, (n, 2)), np.full((n, 1), -16.0)], axis=1)
    turns = random.uniform(-0.1, 0.1, (n, 3))
    return positions, np.array([rotations(turns * share) for share in time[:, 0, 0]])


def test_a_head_feels_what_its_pads_feel_as_fingers(dome_world):
    tools = Tools(dome_world, 3, tool="head", settings=PLAIN)
    assert len(tools) == 3 and tools.pads == 33
    x, y = np.meshgrid(np.linspace(-27, 27, 11), np.linspace(-4.5, 4.5, 3))
    positions, turned = way(3, 60)
    fingers = palpate.Fingers(dome_world, 99, settings=PLAIN.replace(radius_mm=3.0))
    for position, rotation in zip(positions, turned):
        felt = tools.step(position, rotation)
    touches = tools.touches()
    assert len(touches) == 99 and (felt["touching"] > 5).all() and (felt["force"][:, 2] > 1).all()
    tips = np.array([touch.tip for touch in touches]).reshape(3, 33, 3)
    offsets = np.einsum("nji,npj->npi", turned[-1], tips - positions[-1][:, None])
    np.testing.assert_allclose(np.sort(offsets[0, :, 0]), np.sort(x.ravel()), atol=1e-9)
    for position, rotation in zip(positions, turned):
        alone = fingers.step((position[:, None] + np.einsum("nij,npj->npi", rotation, offsets)).reshape(-1, 3))
    np.testing.assert_allclose(alone["force"], [touch.force for touch in touches], atol=1e-6)
    share = 1.9 / 33
    forces = alone["force"].reshape(3, 33, 3) * share
    np.testing.assert_allclose(felt["force"], forces.sum(axis=1), rtol=0.05)
    moment = np.cross(tips - positions[-1][:, None], forces).sum(axis=1)
    np.testing.assert_allclose(felt["moment"], moment, rtol=0.05, atol=1.0)
    np.testing.assert_allclose(felt["depth"], alone["depth"].reshape(3, 33).max(axis=1), atol=1e-9)
    np.testing.assert_array_equal(felt["touching"], (alone["state"].reshape(3, 33) != 0).sum(axis=1))


def test_substeps_go_straight_and_turn_about_one_axis(dome_world):
    one, many = Tools(dome_world, 1, settings=PLAIN), Tools(dome_world, 1, settings=PLAIN)
    turn = np.array([[0.05, -0.08, 0.2]])
    one.step([[0, 0, 30]], np.eye(3)[None]), many.step([[0, 0, 30]], np.eye(3)[None])
    for k in range(1, 21):
        felt = one.step([[0.2 * k, 0, 30 - 0.7 * k]], rotations(turn * k / 20))
    wanted = many.step([[4.0, 0, 16.0]], rotations(turn), substeps=20)
    np.testing.assert_allclose(wanted["force"], felt["force"], rtol=1e-9)
    np.testing.assert_allclose(wanted["moment"], felt["moment"], rtol=1e-9)


def test_tools_are_shared_among_worlds_and_masked(dome_world):
    vertices, faces = dome()
    hard = palpate.World.from_arrays(vertices, faces, stiffness=2.0)
    tools, threaded = Tools([dome_world, hard], 2, settings=PLAIN), Tools([dome_world, hard], 2, settings=PLAIN, threads=2)
    positions, turned = way(1, 40)
    for batch in (tools, threaded):
        batch.reset(None, np.array([0, 1]))
    for position, rotation in zip(np.repeat(positions, 2, axis=1), np.repeat(turned, 2, axis=1)):
        felt, other = (batch.step(position, rotation) for batch in (tools, threaded))
    assert felt["force"][1, 2] > 3 * felt["force"][0, 2] > 0
    for name in felt:
        np.testing.assert_array_equal(felt[name], other[name])
    before = {name: array.copy() for name, array in felt.items()}
    tools.step(np.repeat(positions[-1] - 1, 2, axis=0), np.repeat(turned[-1], 2, axis=0), out=felt, mask=np.array([True, False]))
    assert felt["depth"][0] > before["depth"][0] and felt["depth"][1] == before["depth"][1]
    tools.reset(np.array([True, False]))
    felt = tools.step(np.repeat(positions[-1], 2, axis=0), np.repeat(turned[-1], 2, axis=0))
    assert felt["touching"][0] == 0 < felt["touching"][1], "it begins there, under the skin"


def test_nonsense_is_refused(dome_world):
    with pytest.raises(ValueError, match="did you mean 'head'"):
        Tools(dome_world, 1, tool="heed")
    with Tools(dome_world, 2) as tools:
        eye = np.tile(np.eye(3), (2, 1, 1))
        for wrong in (2 * eye, -eye, np.full((2, 3, 3), np.nan)):
            with pytest.raises(ValueError, match="rotation"):
                tools.step(np.zeros((2, 3)), wrong)
        for positions, turned, words in ((np.zeros((1, 3)), eye, "positions"), (np.zeros((2, 3)), eye[:1], "rotations"),
                                         ([[np.nan, 0, 0]] * 2, eye, "finite")):
            with pytest.raises(ValueError, match=words):
                tools.step(positions, turned)
        with pytest.raises(ValueError, match="out: array 'force' is missing"):
            tools.step(np.zeros((2, 3)), eye, out={})
        with pytest.raises(ValueError, match="mask"):
            tools.step(np.zeros((2, 3)), eye, mask=np.ones(2, bool))
        with pytest.raises(ValueError, match="substeps"):
            tools.step(np.zeros((2, 3)), eye, substeps=0)
    with pytest.raises(ValueError, match="closed"):
        tools.step(np.zeros((2, 3)), eye)
