"""Tasks: what an episode asks for, what it pays, and when it ends. All for n environments at once."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from palpate._core import World
from palpate.gym.bodies import Bodies, Floats, Region, Whole
from palpate.gym.hands import Flags, Hands, Moves
from palpate.gym.observing import Block

if TYPE_CHECKING:
    from palpate.gym.vector import Options, VectorEnv

__all__ = ["TASKS", "FindStiffest", "Task", "make_task"]

Judgement = tuple[Floats, Flags, dict[str, Any]]


@functools.lru_cache(maxsize=1)
def torso() -> World:
    """The body of tasks that are not given one; built once."""
    return World.torso()


class Task:
    """A task of your own is a class like this with `judge`, and what else it needs; `env` is the VectorEnv.

    Reads env.felt (n, hands, ...), env.body, env.steps, env.answers (n, answers); the hands are env.hands.
    """

    control: type[Hands] = Moves  # what an action does
    hands = 1  # of an environment
    draws = 0  # uniform numbers that an episode of the task needs
    answers = 0  # numbers of an action after those that move
    reference = "none"  # of presses
    observe: tuple[str, ...] = ("tip", "force", "depth")
    defaults: dict[str, Any] = {}  # options that are not those of Options
    env: VectorEnv

    def bodies(self, options: Options) -> Bodies:
        """Those of an environment that is given none."""
        return Bodies(torso())

    def blocks(self) -> dict[str, Block]:
        """Blocks of observations that are its own."""
        return {}

    def attach(self, env: VectorEnv) -> None:
        """The environment is there, before its first episode."""
        self.env = env

    def begin(self, which: Whole, draws: Floats) -> None:
        """Episodes begin in these environments (k,), as their uniform numbers (k, draws) say."""

    def judge(self) -> Judgement:
        """After a step: fresh arrays of rewards (n,), which ended (n,), and infos (n, ...), with `success` among them."""
        raise NotImplementedError


class FindStiffest(Task):
    """Find the stiffest place of the region by moving over it: the reward is how much stiffer the skin under the finger
    is than a step ago, N/mm, and 1 where it ends, with the finger on the skin at most goal_mm from the place."""

    def __init__(self, goal_mm: float = 8.0) -> None:
        """Raises ValueError for a goal that is not above 0."""
        if not goal_mm > 0:
            raise ValueError("goal_mm: must be above 0")
        self.goal_mm = goal_mm

    def prepare(self, worlds: Sequence[World], region: Region) -> None:
        """Looks for the place in each body. Raises ValueError for a region without vertices."""
        self.goals: Floats = np.empty((len(worlds), 3))
        self._stiffness: Floats = np.zeros((len(worlds), 1 + max(len(world.triangles) for world in worlds)))
        for number, world in enumerate(worlds):
            near = np.all(np.abs(world.positions[:, :2] - region.middle[number, :2]) < region.reach_mm, axis=1)
            candidates = np.flatnonzero(near & (world.normals @ region.normal[number] > 0.3))
            if len(candidates) == 0:
                raise ValueError("the region has no vertices; increase reach_mm")
            self.goals[number] = world.positions[candidates[np.argmax(world.stiffness[candidates])]]
            self._stiffness[number, :len(world.triangles)] = world.stiffness[world.triangles].mean(axis=1)  # triangle -1: free

    def attach(self, env: VectorEnv) -> None:
        """Raises as prepare."""
        super().attach(env)
        self.prepare(env.bodies.worlds, env.region)
        self._before: Floats = np.zeros(env.num_envs)

    def begin(self, which: Whole, draws: Floats) -> None:
        """The finger is in the air."""
        self._before[which] = 0.0

    def judge(self) -> Judgement:
        """infos: success, error_mm from the place."""
        felt = self.env.felt
        body: Any = self.env.body if len(self.goals) > 1 else 0
        now = self._stiffness[body, felt["triangle"][:, 0]]
        away = felt["proxy"][:, 0] - self.goals[body]
        error = np.sqrt(np.einsum("ij,ij->i", away, away))
        found = error < self.goal_mm
        found &= felt["depth"][:, 0] > 0
        rewards = now - self._before
        rewards += found
        self._before = now
        return rewards, found, {"success": found.copy(), "error_mm": error}


TASKS: dict[str, type[Task]] = {task.__name__: task for task in (FindStiffest,)}


def make_task(task: Any, options: Optional[dict[str, Any]] = None) -> Task:
    """The task of this name with these options, or the one that is given. Raises ValueError, TypeError."""
    if isinstance(task, str):
        if task not in TASKS:
            raise ValueError(f"task: must be one of {', '.join(TASKS)}, or a Task, not {task!r}")
        return TASKS[task](**(options or {}))
    if options:
        raise TypeError(f"unknown option: {', '.join(options)}")
    return task  # type: ignore[no-any-return]
