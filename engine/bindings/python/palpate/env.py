"""Many simulated hands that search a body at once, as a gymnasium-style vector environment without the dependency.

    env = palpate.env.VectorEnv(palpate.World.torso(), 1024, around="T9 right 30 mm")
    observations, infos = env.reset(seed=1)
    observations, rewards, terminated, truncated, infos = env.step(actions)

An episode that has ended begins anew in the next step (gymnasium's next-step autoreset): that step's action is not
looked at, its reward is 0. All arrays that are answered are fresh.
"""

from __future__ import annotations

from typing import Any, Optional, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palpate._core import Fingers, FingerSettings, World

__all__ = ["Box", "Stiffest", "Task", "VectorEnv"]

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Felt = dict[str, NDArray[Any]]


_FELT = ("force", "depth", "proxy", "triangle", "state")
_PRESSED = (*_FELT, "normal", "tip", "tissue", "radius", "lump_force", "lump", "lump_moved")


def _taxels(observe: str) -> int:
    """Taxels along a side of the observed pad; 0 for none."""
    if observe == "touch":
        return 0
    number = observe.removeprefix("pressure")
    if number == observe or not number.isascii() or not number.isdigit() or not 2 <= int(number) <= 16:
        raise ValueError(f"observe: must be 'touch', or 'pressure2' to 'pressure16', not {observe!r}")
    return int(number)


class Box:
    """Numbers between bounds, like gymnasium.spaces.Box: low, high, shape, dtype, sample, contains."""

    def __init__(self, low: ArrayLike, high: ArrayLike, shape: tuple[int, ...], seed: Optional[int] = None) -> None:
        """low and high: one number or an array of this shape."""
        self.shape = shape
        self.dtype = np.dtype(np.float32)
        self.low = np.broadcast_to(np.asarray(low, np.float32), shape)
        self.high = np.broadcast_to(np.asarray(high, np.float32), shape)
        self._random = np.random.default_rng(seed)

    def sample(self) -> NDArray[np.float32]:
        """Uniformly drawn numbers of this shape."""
        return self._random.uniform(self.low, self.high).astype(np.float32)

    def contains(self, numbers: ArrayLike) -> bool:
        """Whether the shape is right and all numbers are within the bounds."""
        array = np.asarray(numbers)
        return array.shape == self.shape and bool(np.all((array >= self.low) & (array <= self.high)))


class Task(Protocol):
    """Rewards, and the end of an episode."""

    def reset(self, mask: Flags) -> None:
        """Begins the episodes whose flag (n,) is set."""

    def judge(self, tips: Floats, felt: Felt) -> tuple[Floats, Flags]:
        """After a step: tips (n, 3), mm, and their contact (force, depth, triangle) -> rewards (n,), ended (n,)."""


class Stiffest:
    """Find the stiffest place of a region: the reward is how much stiffer the skin under the finger is than a step ago,
    N/mm, and 1 where an episode ends, with the finger on the skin at most `goal_mm` from the place."""

    def __init__(self, world: World, around: ArrayLike, reach_mm: float, goal_mm: float = 8.0) -> None:
        """around: middle of the region (3,), mm; reach_mm: half its width."""
        near = np.all(np.abs(world.positions[:, :2] - np.asarray(around)[:2]) < reach_mm, axis=1)
        same_side = world.normals @ world.normal_at(around) > 0.3
        candidates = np.flatnonzero(near & same_side)
        if len(candidates) == 0:
            raise ValueError("the region has no vertices; increase reach_mm")
        self.goal: Floats = world.positions[candidates[np.argmax(world.stiffness[candidates])]]
        self.goal_mm = goal_mm
        self._stiffness: Floats = np.append(world.stiffness[world.triangles].mean(axis=1), 0.0)  # -1: free
        self._before: Optional[Floats] = None

    def reset(self, mask: Flags) -> None:
        """Begins the episodes whose flag (n,) is set."""
        if self._before is None or len(self._before) != len(mask):
            self._before = np.zeros(len(mask))
        self._before[mask] = 0.0

    def judge(self, tips: Floats, felt: Felt) -> tuple[Floats, Flags]:
        """Rewards (n,), and which have found it (n,)."""
        now = self._stiffness[felt["triangle"]]
        before = self._before if self._before is not None else np.zeros_like(now)
        found = (felt["depth"] > 0) & (((felt["proxy"] - self.goal) ** 2).sum(axis=1) < self.goal_mm**2)
        self._before = now
        return now - before + found, found


class VectorEnv:
    """Fingers that search the skin around a place: each action moves a tip, each observation is its contact.

    Actions (n, 3) in -1 to 1: the way of the tip in this step, over max_step_mm, along x, y and z. Observations (n, 7)
    float32: the tip from the middle of the region over reach_mm (3), the force, N (3), the depth, mm (1). With
    observe="pressure4" (2 to 16) the 4 x 4 pressures of a pad on the fingertip follow, kPa, row by row (World.pressure):
    (n, 23). A tip stays within reach_mm of the middle, each axis for itself. An episode is truncated after max_steps.
    """

    metadata: dict[str, Any] = {"autoreset_mode": "next_step", "render_modes": []}
    render_mode = None

    def __init__(self, world: World, num_envs: int, *, around: str | ArrayLike = "T6", reach_mm: float = 40.0,
                 substeps: int = 10, max_step_mm: float = 2.0, max_steps: int = 200,
                 settings: Optional[FingerSettings] = None, task: Optional[Task] = None, threads: int = 1,
                 observe: str = "touch", pad_mm: float = 16.0) -> None:
        """around: the middle of the region, by name or (3,), mm; substeps: ticks a step; task: None for Stiffest.

        observe: "touch", or "pressureN" with an N x N pad of sides of pad_mm, which needs layered tissue."""
        if substeps < 1 or max_steps < 1:
            raise ValueError("substeps and max_steps: must be at least 1")
        if not reach_mm > 0 or not max_step_mm > 0:
            raise ValueError("reach_mm and max_step_mm: must be above 0")
        self.world = world
        self.num_envs = num_envs
        self.taxels, self.pad_mm = _taxels(observe), pad_mm
        self._clock = np.zeros(num_envs, np.int64)
        self.around = world.place(around)
        self.normal = world.normal_at(around)
        self.reach_mm, self.substeps, self.max_step_mm, self.max_steps = reach_mm, substeps, max_step_mm, max_steps
        self.task: Task = task if task is not None else Stiffest(world, self.around, reach_mm)
        self._fingers = Fingers(world, num_envs, settings=settings, threads=threads)
        self._random = np.random.default_rng()
        self._tips = np.zeros((num_envs, 3))
        self._steps = np.zeros(num_envs, np.int64)
        self._ended: Optional[Flags] = None
        pad = self.taxels**2
        low = np.array([-1, -1, -1, -np.inf, -np.inf, -np.inf, *np.zeros(1 + pad)], np.float32)
        high = np.array([1, 1, 1, *np.full(4 + pad, np.inf)], np.float32)
        self.single_action_space = Box(-1, 1, (3,))
        self.single_observation_space = Box(low, high, (7 + pad,))
        self.action_space = Box(-1, 1, (num_envs, 3))
        self.observation_space = Box(low, high, (num_envs, 7 + pad))
        if pad:
            self._pressure(self._fingers.step(np.full((num_envs, 3), np.nan), fields=_PRESSED))  # refused now, not later
            self._fingers.reset()

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """All episodes begin: each finger over the skin, at a place drawn from the middle half of the region.

        seed: the same seed gives the same episodes; None continues the current sequence."""
        if seed is not None:
            self._random = np.random.default_rng(seed)
        self._ended = np.zeros(self.num_envs, bool)
        self._begin(np.ones(self.num_envs, bool))
        return self._observed(self._feel()), {}

    def step(self, actions: ArrayLike
             ) -> tuple[NDArray[np.float32], Floats, Flags, Flags, dict[str, Any]]:
        """Observations (n, 7) or wider, rewards (n,), terminated (n,), truncated (n,), infos: `state` (n,), 0 free, 1 stick, 2 slip.

        Raises ValueError for actions of another shape or not finite, RuntimeError before the first reset."""
        if self._ended is None:
            raise RuntimeError("call reset first")
        moves = np.asarray(actions, np.float64)
        if moves.shape != (self.num_envs, 3) or not np.isfinite(moves).all():
            raise ValueError(f"actions: expected finite numbers of shape ({self.num_envs}, 3)")
        begins = self._ended
        self._tips += np.clip(moves, -1, 1) * self.max_step_mm
        np.clip(self._tips, self.around - self.reach_mm, self.around + self.reach_mm, out=self._tips)
        self._steps += 1
        if begins.any():
            self._begin(begins)
        felt = self._feel()
        rewards, terminated = self.task.judge(self._tips, felt)
        rewards = np.where(begins, 0.0, rewards)
        terminated = terminated & ~begins
        truncated = (self._steps >= self.max_steps) & ~terminated
        self._ended = terminated | truncated
        return self._observed(felt), rewards, terminated, truncated, {"state": felt["state"]}

    def close(self) -> None:
        """Ends the threads of its fingers."""
        self._fingers.close()

    def _begin(self, mask: Flags) -> None:
        count = int(mask.sum())
        shift = self._random.uniform(-0.5, 0.5, (count, 3)) * self.reach_mm
        shift -= (shift @ self.normal)[:, None] * self.normal
        self._tips[mask] = self.around + shift + self.normal * min(10.0, self.reach_mm)
        self._steps[mask] = 0
        self._fingers.reset(mask)
        self._clock[mask] = -1
        self.task.reset(mask)

    def _feel(self) -> Felt:
        self._clock += self.substeps  # of each finger's last tick
        return self._fingers.step(self._tips, substeps=self.substeps, fields=_PRESSED if self.taxels else _FELT)

    def _pressure(self, felt: Felt) -> Floats:
        pressed = self.world.pressure(felt, self.taxels, self.pad_mm, tick=np.maximum(self._clock, 0))
        return pressed.reshape(self.num_envs, -1)

    def _observed(self, felt: Felt) -> NDArray[np.float32]:
        observed = np.empty((self.num_envs, 7 + self.taxels**2), np.float32)
        observed[:, :3] = (self._tips - self.around) / self.reach_mm
        observed[:, 3:6] = felt["force"]
        observed[:, 6] = felt["depth"]
        if self.taxels:
            observed[:, 7:] = self._pressure(felt)
        return observed
