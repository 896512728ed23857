"""Environments in which hands learn to palpate, in gymnasium's terms; numpy is all that is needed.

    env = palpate.gym.VectorEnv(1024, task="FindStiffest", around="T9 right 30 mm")
    observations, infos = env.reset(seed=1)
    observations, rewards, terminated, truncated, infos = env.step(actions)

    gymnasium.make("palpate.gym:palpate/FindStiffest-v0")       # where gymnasium is installed; make_vec as well

How it is put together: a VectorEnv (vector.py) has arrays over all environments and no loop over them in a step. An
action goes to its hands (hands.py), which ask the engine once; a task (tasks.py) judges what was felt; an observer
(observing.py) writes blocks chosen by name, with a device's noise and delay. Bodies (bodies.py) are pools of worlds that
episodes draw from. An episode is a function of a few uniform numbers, from a stream of its environment. Env (single.py)
is a VectorEnv of one.
"""

from __future__ import annotations

from typing import Any

from palpate.gym.bodies import Bodies, Region
from palpate.gym.observing import Block
from palpate.gym.single import Env
from palpate.gym.spaces import HAS_GYMNASIUM, AutoresetMode
from palpate.gym.tasks import TASKS, Task
from palpate.gym.vector import Options, VectorEnv

__all__ = ["AutoresetMode", "Block", "Bodies", "Env", "HAS_GYMNASIUM", "Options", "Region", "TASKS", "Task", "VectorEnv",
           "register"]

# Of each task; raised whenever a reward, a space or a default changes.
VERSIONS = {"FindStiffest": 0, "FollowForce": 0, "FindLump": 0, "CountLumps": 0, "ScanWithProbe": 0,
            "ExploreTwoHands": 0}


def register() -> list[str]:
    """Tells gymnasium of every task, as palpate/NAME-v0, and returns the names; done on import, [] without gymnasium."""
    if not HAS_GYMNASIUM:
        return []
    import gymnasium  # type: ignore[import]

    names = []
    for name, task in TASKS.items():
        names.append(f"palpate/{name}-v{VERSIONS[name]}")
        steps: Any = task.defaults.get("max_episode_steps", Options.max_episode_steps)
        if names[-1] not in gymnasium.registry:
            gymnasium.register(names[-1], entry_point="palpate.gym.single:Env", vector_entry_point="palpate.gym.vector:VectorEnv",
                               max_episode_steps=steps, kwargs={"task": name})
    return names


register()
