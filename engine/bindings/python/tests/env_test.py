"""palpate.env, the old name of palpate.gym: its words still do what they did."""

from __future__ import annotations

import numpy as np
import pytest

import palpate
from conftest import dome, run


@pytest.fixture(scope="module")
def hidden() -> palpate.World:
    """A dome with one stiff place."""
    vertices, faces = dome(40)
    distance = np.linalg.norm(vertices[:, :2] - [15.0, -10.0], axis=1)
    return palpate.World.from_arrays(vertices, faces, stiffness=0.4 + 0.8 * np.exp(-((distance / 12) ** 2)))


def make(world: palpate.World, n: int = 16, **options) -> palpate.env.VectorEnv:
    return palpate.env.VectorEnv(world, n, around=[0.0, 0.0, 20.0], **options)


def test_it_says_that_it_is_deprecated():
    text = "import warnings; warnings.simplefilter('error'); import palpate.gym; import palpate.env"
    assert "palpate.env is deprecated: use palpate.gym" in run("-c", text).stderr


def test_the_shape_of_gymnasium(hidden):
    env = make(hidden, 5)
    observations, infos = env.reset(seed=3)
    assert env.num_envs == 5 and infos == {}
    assert observations.shape == (5, 7) == env.observation_space.shape and observations.dtype == np.float32
    assert env.observation_space.contains(observations)
    action = env.action_space.sample()
    assert action.shape == (5, 3) and env.action_space.contains(action) and not env.action_space.contains(action * 9)
    observations, rewards, terminated, truncated, infos = env.step(action)
    assert rewards.shape == terminated.shape == truncated.shape == infos["state"].shape == (5,)
    assert terminated.dtype == truncated.dtype == bool
    assert env.single_action_space.shape == (3,) and env.metadata["autoreset_mode"] == palpate.gym.AutoresetMode.NEXT_STEP
    env.close()


def test_the_same_seed_gives_the_same_episodes(hidden):
    def run(seed: int) -> list[np.ndarray]:
        env, random = make(hidden, max_steps=7), np.random.default_rng(0)
        seen = [env.reset(seed=seed)[0]]
        for _ in range(20):
            seen.append(np.concatenate([env.step(random.uniform(-1, 1, (16, 3)))[0].ravel()]))
        return seen

    assert all(np.array_equal(a, b) for a, b in zip(run(5), run(5)))
    assert not np.array_equal(run(5)[0], run(6)[0])


def test_an_episode_begins_anew_in_the_next_step(hidden):
    env = make(hidden, 4, max_steps=3)
    first, _ = env.reset(seed=1)
    down = np.tile([0.0, 0.0, -1.0], (4, 1))
    for step in range(3):
        last, _, terminated, truncated, _ = env.step(down)
        assert not terminated.any() and (truncated == (step == 2)).all()
    kept = last.copy()
    begun, rewards, terminated, truncated, _ = env.step(down)
    assert not rewards.any() and not terminated.any() and not truncated.any()
    np.testing.assert_array_equal(last, kept)  # the final observation is still the user's
    assert (begun[:, 2] > last[:, 2]).all(), "over the skin again: the action was not looked at"
    again = env.step(down)[0]
    np.testing.assert_allclose((begun - again)[:, 2], 2.0 / 40.0, rtol=1e-3)


def test_only_those_that_ended_begin_anew(hidden):
    env = make(hidden, 3, max_steps=50)
    env.reset(seed=1)
    env.hands.tips[0] = env.task.goal + [0, 0, 1.0]  # one is brought to the goal
    _, rewards, terminated, _, _ = env.step(np.tile([0.0, 0.0, -1.0], (3, 1)))
    assert terminated.tolist() == [True, False, False] and rewards[0] > 1.0
    before = env.hands.tips.copy()
    env.step(np.zeros((3, 3)))
    assert (env.hands.tips[1:] == before[1:]).all() and not (env.hands.tips[0] == before[0]).all()


def test_who_climbs_finds(hidden):
    """A policy by hand: down to the skin, then towards the goal; all must be told that they found it."""
    env = make(hidden, 32, max_steps=100)
    observations, _ = env.reset(seed=2)
    assert np.linalg.norm(env.task.goal[:2] - [15, -10]) < 6
    found = np.zeros(32, bool)
    total = np.zeros(32)
    for _ in range(90):
        tips = observations[:, :3] * env.reach_mm + env.around
        action = (env.task.goal - tips) / env.max_step_mm
        action[:, 2] = np.where(observations[:, 6] < 4.0, -0.5, 0.3)
        observations, rewards, terminated, truncated, _ = env.step(action)
        total += np.where(found, 0, rewards)
        found |= terminated
    assert found.all()
    assert (total > 1.0).all(), "1 for the find, and what the skin became stiffer"
    still = make(hidden, 32, max_steps=100)
    still.reset(seed=2)
    assert not any(still.step(np.zeros((32, 3)))[2].any() for _ in range(50)), "nobody finds by standing still"


def test_a_task_of_ones_own(hidden):
    class Press:
        def reset(self, mask):
            self.begun = int(mask.sum())

        def judge(self, tips, felt):
            return felt["force"][:, 2], felt["depth"] > 5

    task = Press()
    env = make(hidden, 4, task=task)
    env.reset()
    assert task.begun == 4
    ended = np.zeros(4, bool)
    for _ in range(14):
        _, rewards, terminated, _, _ = env.step(np.tile([0, 0, -1.0], (4, 1)))
        ended |= terminated
    assert ended.all()


def test_nonsense_is_refused(hidden):
    env = make(hidden, 2)
    with pytest.raises(RuntimeError, match="reset"):
        env.step(np.zeros((2, 3)))
    env.reset()
    for wrong in (np.zeros((3, 3)), np.zeros(6), np.full((2, 3), np.nan)):
        with pytest.raises(ValueError, match="actions"):
            env.step(wrong)
    for wrong in ({"substeps": 0}, {"max_steps": 0}, {"reach_mm": 0}):
        with pytest.raises(ValueError):
            make(hidden, 2, **wrong)
    with pytest.raises(ValueError, match="no vertices"):
        palpate.env.VectorEnv(hidden, 2, around=[1.0, 1.0, 20.0], reach_mm=0.01)
    with pytest.raises(palpate.Error):
        palpate.env.VectorEnv(hidden, 2, around="T6")
