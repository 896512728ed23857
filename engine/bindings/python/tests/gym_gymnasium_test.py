"""palpate.gym beside gymnasium and without it: base classes, modes, spaces, and the registry.

Where gymnasium is not installed stand_in/gymnasium.py stands in for it, in a process of its own."""

from __future__ import annotations

import importlib.util
import os
import pathlib
import sys

import numpy as np
import pytest

from conftest import run

STAND_IN = str(pathlib.Path(__file__).parent / "stand_in")
INSTALLED = importlib.util.find_spec("gymnasium") is not None


def beside_gymnasium(text: str) -> str:
    """What a program prints that finds gymnasium, or what stands in for it."""
    paths = [*([] if INSTALLED else [STAND_IN]), os.environ.get("PYTHONPATH", "")]
    done = run("-c", "import numpy as np, gymnasium as gym, palpate.gym as pg\n" + text, env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_its_base_classes_modes_and_spaces_are_used():
    beside_gymnasium("""
assert pg.HAS_GYMNASIUM and pg.AutoresetMode is gym.vector.AutoresetMode
env = pg.VectorEnv(2)
assert isinstance(env, gym.vector.VectorEnv) and isinstance(pg.Env(), gym.Env)
for space in (env.single_observation_space, env.observation_space, env.action_space):
    assert isinstance(space, gym.spaces.Box)
assert isinstance(pg.VectorEnv(2, as_dict=True).observation_space, gym.spaces.Dict)
for mode in gym.vector.AutoresetMode:
    assert gym.vector.VectorWrapper(pg.VectorEnv(2, autoreset_mode=mode)).env.metadata["autoreset_mode"] is mode
""")


def test_every_task_is_registered_and_made():
    names = beside_gymnasium("""
for name in pg.TASKS:
    ids = [one for one in gym.registry if one.startswith(f"palpate/{name}-v")]
    assert len(ids) == 1, ids
    env = gym.make("palpate.gym:" + ids[0])
    observed, info = env.reset(seed=1)
    assert observed in env.observation_space and env.unwrapped.spec.id == ids[0]
    action = np.zeros(env.action_space.shape, np.float32)
    observed, reward, terminated, truncated, info = env.step(action)
    assert observed in env.observation_space and type(reward) is float and type(terminated) is bool is type(truncated)
    assert not any(key.startswith("_") for key in info) and "success" in info
    many = gym.make_vec(ids[0], num_envs=3, vectorization_mode="vector_entry_point", max_episode_steps=2)
    first, _ = many.reset(seed=1)
    assert first in many.observation_space and np.array_equal(first[0], env.reset(seed=1)[0])
    for _ in range(2):
        observed, rewards, terminated, truncated, infos = many.step(np.full(many.action_space.shape, -0.1, np.float32))
    assert observed in many.observation_space and truncated.all() and rewards.shape == (3,)
    env.close(), many.close()
    assert many.closed
print(*pg.TASKS)
""")
    from palpate.gym import TASKS

    assert names.split() == list(TASKS)


def test_a_vector_environment_is_seeded_as_gymnasium_seeds():
    beside_gymnasium("""
one, two = pg.Env(), pg.Env()
one.reset(seed=5), two.reset(seed=5)
assert one.np_random.bit_generator.state == two.np_random.bit_generator.state
assert np.array_equal(one.reset()[0], two.reset()[0])
two.reset(seed=6)
assert one.np_random.bit_generator.state != two.np_random.bit_generator.state
""")


@pytest.mark.skipif("gymnasium" in sys.modules or INSTALLED, reason="gymnasium is installed")
def test_without_it_the_own_spaces_do_what_its_do():
    from palpate.gym import HAS_GYMNASIUM, VectorEnv, register
    from palpate.gym.spaces import Box, Dict, Discrete, batched

    assert not HAS_GYMNASIUM and register() == []
    box = Box(np.array([-1.0, -np.inf, 0.0]), np.array([1.0, np.inf, np.inf]))
    assert box.shape == (3,) and box.dtype == np.float32 and not box.is_bounded() and Box(-1, 1, (2,)).is_bounded()
    assert not box.is_bounded("below") and Box(0, np.inf, (2,)).is_bounded("below")
    box.seed(3)
    drawn = [box.sample() for _ in range(200)]
    box.seed(3)
    assert np.array_equal(box.sample(), drawn[0]) and all(one in box for one in drawn)
    assert min(one[2] for one in drawn) >= 0 and 0.9 < max(one[1] for one in drawn) <= 1
    assert np.array([2.0, 0.0, 0.0]) not in box and np.zeros(2) not in box and np.array([0.0, 0.0, -1e-3]) not in box
    assert box == Box(box.low, box.high) != Box(box.low, box.high + 1)
    four = Discrete(4, seed=1, start=2)
    assert {int(four.sample()) for _ in range(99)} == {2, 3, 4, 5} and 1 not in four and 2.0 not in four and 5 in four
    both = Dict({"a": box, "b": Box(0, 1, (1,))})
    both.seed(2)
    one = both.sample()
    assert one in both and {"a": one["a"]} not in both and both["a"] is box
    assert batched(both, 5)["b"].shape == (5, 1) and both == Dict(both.spaces)
    env = VectorEnv(2)
    env.reset(seed=4)
    assert env.unwrapped is env and env.spec is None
    env.close()
    env.close()
    with pytest.raises(ValueError, match="closed"):
        env.step(np.zeros((2, 3)))
