"""One environment: a vector environment of one, without the axis of environments."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from palpate.gym.spaces import AutoresetMode, EnvBase
from palpate.gym.tasks import Task
from palpate.gym.vector import VectorEnv

__all__ = ["Env"]


def _only(values: Any) -> Any:
    if isinstance(values, dict):
        return {name: _only(value) for name, value in values.items() if not name.startswith("_")}
    return values[0]


class Env(EnvBase):
    """One hand; episodes are those of the first environment of a VectorEnv with the same seed."""

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 30}

    def __init__(self, *, task: Union[str, Task] = "FindStiffest", **options: Any) -> None:
        """As VectorEnv."""
        self._many = VectorEnv(1, task=task, **{**options, "autoreset_mode": AutoresetMode.DISABLED})
        self.task, self.options, self.render_mode = self._many.task, self._many.options, self._many.render_mode
        self.action_space = self._many.single_action_space
        self.observation_space = self._many.single_observation_space

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> tuple[Any, dict[str, Any]]:
        """The next episode begins; with a seed the first one of it."""
        super().reset(seed=seed)
        if seed is None and self._many.seeds is None:
            seed = int(self.np_random.integers(2**62))
        observed, infos = self._many.reset(seed=seed)
        return _only(observed), _only(infos)

    def step(self, action: ArrayLike) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Observation, reward, terminated, truncated, info. Raises as VectorEnv.step, also after the end of an episode."""
        observed, rewards, terminated, truncated, infos = self._many.step(np.asarray(action, np.float64)[None])
        return _only(observed), float(rewards[0]), bool(terminated[0]), bool(truncated[0]), _only(infos)

    def render(self) -> Any:
        """A picture (H, W, 3) of uint8, or None without a render_mode."""
        pictures = self._many.render()
        return None if pictures is None else pictures[0]

    def close(self) -> None:
        """Ends its threads, and completes a recording."""
        self._many.close()
