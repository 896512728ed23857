"""The tasks of palpate.gym: what they show, pay and end, played by simple policies and by ones that are wrong."""

from __future__ import annotations

import numpy as np
import pytest

import palpate
from conftest import dome
from palpate.gym import VectorEnv

PLACE = [0.0, 0.0, 20.0]


@pytest.fixture(scope="module")
def soft() -> palpate.World:
    """A dome with one stiffness, 0.4 N/mm."""
    vertices, faces = dome(40)
    return palpate.World.from_arrays(vertices, faces, stiffness=0.4)


def followed(env: VectorEnv, gain: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Along the line, with the depth that the force asks for: rewards (steps, n), terminated and success of the last."""
    observed, _ = env.reset(seed=2)
    rewards = []
    for _ in range(env.options.max_episode_steps):
        goal = observed[:, 7:]
        action = goal[:, 1:] * env.region.reach_mm / env.options.max_step_mm
        lacking = goal[:, 0] - np.linalg.norm(observed[:, 3:6], axis=1)
        action[:, 2] = np.where(observed[:, 6] > 0, -gain * lacking / 0.4 / env.options.max_step_mm, -0.5)
        observed, reward, terminated, truncated, infos = env.step(action)
        rewards.append(reward)
        if terminated.any():
            break
    return np.array(rewards), terminated, infos["success"]


def test_follow_force_pays_who_follows(soft):
    env = VectorEnv(8, task="FollowForce", bodies=soft, around=PLACE, max_episode_steps=300)
    rewards, terminated, success = followed(env, 0.8)
    assert success.all() and not terminated.any() and ((rewards >= 0) & (rewards <= 1)).all()
    assert rewards[60:].mean() > 0.85
    _, _, success = followed(env, 0.02)
    assert not success.any(), "too slow to follow"
    env.reset(seed=2)
    idle = [env.step(np.zeros((8, 3))) for _ in range(300)]
    assert not any(step[1].any() or step[4]["success"].any() for step in idle), "in the air there is nothing to gain"


def test_follow_force_shows_the_force_and_the_line(soft):
    env = VectorEnv(64, task="FollowForce", bodies=soft, around=PLACE, observe=("goal", "tip"), force_n=(0.5, 4.0))
    observed, _ = env.reset(seed=5)
    forces, points = [], []
    for _ in range(200):
        forces.append(observed[:, 0])
        points.append((observed[:, 1:4] + observed[:, 4:7]) * 40.0)
        observed = env.step(np.zeros((64, 3)))[0]
    forces, points = np.array(forces), np.array(points)
    assert forces.min() >= 0.5 and forces.max() <= 4.0 and 1.2 < np.exp(np.log(forces).mean()) < 1.7
    assert (np.diff(forces, axis=0) != 0).sum(axis=0).max() == 5, "six forces"
    length = np.linalg.norm(points[-1] - points[0], axis=1)
    np.testing.assert_allclose(length, 30.0 * 199 / 200, rtol=0.03)
    assert np.abs(points).max() < 40.0


def test_follow_force_ends_where_it_hurts(soft):
    env = VectorEnv(2, task="FollowForce", bodies=soft, around=PLACE, limit_n=5.0)
    env.reset(seed=1)
    for _ in range(40):
        _, _, terminated, _, infos = env.step(np.tile([0.0, 0.0, -1.0], (2, 1)))
        if terminated.any():
            break
    assert terminated.all() and (env.felt["force"][:, 0, 2] > 5.0).all() and not infos["success"].any()
    for wrong in ({"force_n": (0, 1)}, {"force_n": (2, 1)}, {"limit_n": 3.0}, {"length_mm": -1}):
        with pytest.raises(ValueError, match="force_n"):
            VectorEnv(2, task="FollowForce", bodies=soft, around=PLACE, **wrong)
