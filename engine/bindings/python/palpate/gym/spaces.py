"""Spaces and base classes: gymnasium's own where it imports, and otherwise small ones of the same shape.

Wrappers and trainers ask by `isinstance` for gymnasium's classes, so an own one is handed out only where there are none.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["AutoresetMode", "Box", "Dict", "Discrete", "EnvBase", "HAS_GYMNASIUM", "Space", "VectorBase", "batched"]


class AutoresetMode(enum.Enum):
    """When an episode that has ended begins anew: in the next step, in the same, or when `reset` is told to."""

    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class Space:
    """What can be observed or done: shape, dtype, sample, contains, seed."""

    def __init__(self, shape: Optional[tuple[int, ...]], dtype: Any, seed: Any = None) -> None:
        self.shape = shape
        self.dtype = None if dtype is None else np.dtype(dtype)
        self.seed(seed)

    def seed(self, seed: Any = None) -> Any:
        """Begins the numbers of `sample` anew."""
        self._random = np.random.default_rng(seed)
        return seed

    def __contains__(self, x: Any) -> bool:
        return bool(getattr(self, "contains")(x))


class Box(Space):
    """Numbers between bounds: low and high, one number or an array of the shape."""

    def __init__(self, low: ArrayLike, high: ArrayLike, shape: Optional[tuple[int, ...]] = None, dtype: Any = np.float32,
                 seed: Any = None) -> None:
        shape = np.broadcast_shapes(np.shape(low), np.shape(high)) if shape is None else tuple(shape)
        super().__init__(shape, dtype, seed)
        self.low = np.array(np.broadcast_to(np.asarray(low, self.dtype), shape))
        self.high = np.array(np.broadcast_to(np.asarray(high, self.dtype), shape))

    def is_bounded(self, manner: str = "both") -> bool:
        """Whether all numbers have a bound: "below", "above" or "both"."""
        below, above = bool(np.isfinite(self.low).all()), bool(np.isfinite(self.high).all())
        return {"below": below, "above": above, "both": below and above}[manner]

    def sample(self, mask: None = None) -> NDArray[Any]:
        """Uniformly drawn; where a bound is missing, from an interval of 2 beside the other one, or beside 0."""
        below, above = np.isfinite(self.low), np.isfinite(self.high)
        low = np.where(below, self.low, np.where(above, self.high, 1.0) - 2.0)
        high = np.where(above, self.high, low + 2.0)
        return self._random.uniform(low, high).astype(self.dtype)

    def contains(self, x: Any) -> bool:
        """Whether the shape is right and all numbers are within the bounds."""
        array = np.asarray(x)
        return array.shape == self.shape and bool(np.all((array >= self.low) & (array <= self.high)))

    def __eq__(self, other: object) -> bool:
        return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self) -> str:
        return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


class Discrete(Space):
    """A whole number from start to start + n - 1."""

    def __init__(self, n: int, seed: Any = None, start: int = 0) -> None:
        super().__init__((), np.int64, seed)
        self.n, self.start = n, start

    def sample(self, mask: None = None) -> np.int64:
        """Drawn with equal chances."""
        return np.int64(self._random.integers(self.start, self.start + self.n))

    def contains(self, x: Any) -> bool:
        """Whether x is a whole number in the range."""
        return np.ndim(x) == 0 and np.asarray(x).dtype.kind in "iu" and self.start <= int(x) < self.start + self.n

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Discrete) and (self.n, self.start) == (other.n, other.start)


class Dict(Space):
    """Several spaces by name."""

    def __init__(self, spaces: Mapping[str, Any], seed: Any = None) -> None:
        self.spaces = dict(spaces)
        super().__init__(None, None, seed)

    def seed(self, seed: Any = None) -> Any:
        """Begins the numbers of all its spaces anew, each with one of its own."""
        children: Any = np.random.SeedSequence(seed).generate_state(len(self.spaces)) if self.spaces else []
        for space, child in zip(self.spaces.values(), children):
            space.seed(int(child))
        return seed

    def sample(self, mask: None = None) -> dict[str, Any]:
        """One of each."""
        return {name: space.sample() for name, space in self.spaces.items()}

    def contains(self, x: Any) -> bool:
        """Whether x is a dict with exactly these names, each of its space."""
        return isinstance(x, dict) and x.keys() == self.spaces.keys() and all(
            space.contains(x[name]) for name, space in self.spaces.items())

    def __getitem__(self, name: str) -> Any:
        return self.spaces[name]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Dict) and self.spaces == other.spaces


class EnvBase:
    """One environment, as gymnasium.Env: what the environments here use of it."""

    metadata: dict[str, Any] = {}
    render_mode: Optional[str] = None
    spec: Any = None
    action_space: Any
    observation_space: Any
    _np_random: Optional[np.random.Generator] = None
    _np_random_seed: Any = None

    @property
    def np_random(self) -> np.random.Generator:
        """A generator of random numbers, begun anew by `reset(seed=...)`."""
        if self._np_random is None:
            EnvBase.reset(self, seed=np.random.SeedSequence().entropy)
        assert self._np_random is not None
        return self._np_random

    @property
    def unwrapped(self) -> Any:
        """The environment itself."""
        return self

    def reset(self, *, seed: Any = None, options: Optional[dict[str, Any]] = None) -> Any:
        """Begins the random numbers anew where a seed is given."""
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed


class VectorBase(EnvBase):
    """Many environments, as gymnasium.vector.VectorEnv."""

    num_envs: int
    closed = False
    single_action_space: Any
    single_observation_space: Any

    def close(self, **kwargs: Any) -> None:
        """Ends what it has begun, once."""
        if not self.closed:
            self.close_extras(**kwargs)
            self.closed = True

    def close_extras(self, **kwargs: Any) -> None:
        """What there is to end."""


HAS_GYMNASIUM = False
if not TYPE_CHECKING:  # a type checker reads the small ones, which have the same shape
    try:
        import gymnasium
        from gymnasium.spaces import Box, Dict, Discrete, Space  # noqa: F811
        from gymnasium.vector import AutoresetMode  # noqa: F811

        EnvBase, VectorBase, HAS_GYMNASIUM = gymnasium.Env, gymnasium.vector.VectorEnv, True
    except ImportError:  # none, or one before 1.1, whose modes are words
        pass


def batched(space: Any, n: int) -> Any:
    """The space of n of them side by side: what a vector environment observes or does."""
    if isinstance(space, Dict):
        return Dict({name: batched(one, n) for name, one in space.spaces.items()})
    low, high = (np.repeat(np.asarray(bound)[None], n, axis=0) for bound in (space.low, space.high))
    return Box(low, high, dtype=space.dtype.type)
