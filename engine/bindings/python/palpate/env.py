"""The old name of palpate.gym; deprecated. What moved is there; this keeps the words of before for the code that has them.

    palpate.env.VectorEnv(world, 1024, around=...)  ->  palpate.gym.VectorEnv(1024, bodies=world, around=...)
"""

from __future__ import annotations

import warnings
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palpate._core import FingerSettings, World
from palpate.gym.bodies import Region
from palpate.gym.hands import Flags
from palpate.gym.spaces import Box
from palpate.gym.tasks import FindStiffest, Judgement, Task
from palpate.gym.vector import VectorEnv as GymVectorEnv

__all__ = ["Box", "Stiffest", "Task", "VectorEnv"]

Floats = NDArray[np.float64]
warnings.warn("palpate.env is deprecated: use palpate.gym", DeprecationWarning, stacklevel=2)


class Stiffest(FindStiffest):
    """palpate.gym's FindStiffest, made for a place of one world."""

    def __init__(self, world: World, around: ArrayLike, reach_mm: float, goal_mm: float = 8.0) -> None:
        """around: middle of the region (3,), mm; reach_mm: half its width."""
        super().__init__(goal_mm)
        self.prepare([world], Region([world], around, reach_mm))

    @property
    def goal(self) -> Floats:
        """The place (3,), mm."""
        place: Floats = self.goals[0]
        return place


class _Judged(Task):
    """A task of before, with reset(mask) and judge(tips, felt), in palpate.gym."""

    def __init__(self, task: Any) -> None:
        self.task = task

    def begin(self, which: Any, draws: Floats) -> None:
        self.task.reset(np.isin(self.env.every, which))

    def judge(self) -> Judgement:
        felt = {name: values[:, 0] for name, values in self.env.felt.items()}
        rewards, ended = self.task.judge(self.env.hands.tips[:, 0], felt)
        return np.array(rewards, float), np.array(ended, bool), {}


class VectorEnv(GymVectorEnv):
    """palpate.gym.VectorEnv by its old parameters. observe: "touch", or "pressureN" with an N x N pad."""

    def __init__(self, world: World, num_envs: int, *, around: str | ArrayLike = "T6", reach_mm: float = 40.0,
                 substeps: int = 10, max_step_mm: float = 2.0, max_steps: int = 200,
                 settings: Optional[FingerSettings] = None, task: Any = None, threads: int = 1,
                 observe: str = "touch", pad_mm: float = 16.0) -> None:
        """Raises as palpate.gym.VectorEnv."""
        if observe != "touch" and not observe.startswith("pressure"):
            raise ValueError(f"observe: must be 'touch', or 'pressure2' to 'pressure16', not {observe!r}")
        blocks = ("tip", "force", "depth") if observe == "touch" else ("tip", "force", "depth", observe)
        self.world, self.max_steps, self.reach_mm, self.max_step_mm = world, max_steps, reach_mm, max_step_mm
        if task is None:
            task = Stiffest(world, world.place(around), reach_mm)
        super().__init__(num_envs, task=_Judged(task) if hasattr(task, "reset") else task, bodies=world, around=around,
                         reach_mm=reach_mm, substeps=substeps, max_step_mm=max_step_mm, max_episode_steps=max_steps,
                         settings=settings, threads=threads, observe=blocks, pad_mm=pad_mm)
        self.around: Floats = self.region.middle[0]
        self.normal: Floats = self.region.normal[0]

    def step(self, actions: ArrayLike) -> tuple[Any, Floats, Flags, Flags, dict[str, Any]]:
        """As palpate.gym.VectorEnv.step; infos have `state` (n,) of the one hand."""
        observed, rewards, terminated, truncated, infos = super().step(actions)
        infos["state"] = infos["state"][:, 0]
        return observed, rewards, terminated, truncated, infos
