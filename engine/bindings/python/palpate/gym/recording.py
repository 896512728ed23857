"""Episodes as ordinary recordings (docs/reference/recordings.md), which replay to the bit."""

from __future__ import annotations

import json
import pathlib
from typing import TYPE_CHECKING, Optional

import numpy as np

from palpate._core import Fingers, Loop
from palpate.gym.bodies import Floats, Whole
from palpate.gym.hands import Flags

if TYPE_CHECKING:
    from palpate.gym.vector import VectorEnv

__all__ = ["Recorder"]


class Recorder:
    """Keeps the ways of some environments' hands, and when an episode is over takes them through a servo loop that records.

    A file an episode, TASK-STREAM-EPISODE.session; its notes say in JSON where it came from. A reference is not recorded.
    """

    def __init__(self, env: VectorEnv) -> None:
        """Raises ValueError for an environment that there is not, and for a tool of pads, which recordings do not know."""
        self.env = env
        if not isinstance(env.hands.fingers, Fingers):
            raise ValueError("record: a recording has fingers, and no tools of several pads")
        self.folder = pathlib.Path(env.options.record or ".")
        self.folder.mkdir(parents=True, exist_ok=True)
        if not all(0 <= number < env.num_envs for number in env.options.record_envs):
            raise ValueError(f"record_envs: must be from 0 to {env.num_envs - 1}")
        self._ways: dict[int, list[tuple[Optional[Floats], int]]] = {}

    def begin(self, which: Whole) -> None:
        """Their episodes have begun."""
        for number in self.env.options.record_envs:
            if number in which:
                self._ways[number] = []

    def move(self, tips: Optional[Floats], ticks: int, mask: Optional[Flags]) -> None:
        """The hands (n, hands, 3) are sent to these tips in so many ticks; None: lifted, their next tips may be anywhere."""
        for number, ways in self._ways.items():
            if mask is None or mask[number]:
                ways.append((None if tips is None else tips[number].copy(), ticks))

    def finish(self, which: Whole) -> None:
        """Writes the episodes of these environments that were recorded. Raises palpate.Error."""
        for number in [one for one in self._ways if one in which]:
            ways = self._ways.pop(number)
            if ways:
                self._write(number, ways)

    def _write(self, number: int, ways: list[tuple[Optional[Floats], int]]) -> None:
        env = self.env
        seed, stream = env.seeds[number]
        name, episode = type(env.task).__name__, int(env.episodes[number])
        notes = {"task": name, "seed": str(seed), "stream": stream, "episode": episode, "steps": int(env.steps[number]),
                 "body": int(env.body[number]), "substeps": env.options.substeps}
        world = env.bodies.worlds[env.body[number]]
        with Loop(world, fingers=env.hands.hands, settings=env.hands.settings,
                  session=self.folder / f"{name}-{stream:05d}-{episode:06d}.session", notes=json.dumps(notes)) as loop:
            before: Optional[Floats] = None
            for tips, ticks in ways:
                if tips is None:
                    for finger in range(env.hands.hands):
                        loop.lift(finger)
                    before = None
                    continue
                start = tips if before is None else before
                for tick in range(1, ticks + 1):
                    loop.tick(tips if tick == ticks else start + (tips - start) * np.float64(tick / ticks))
                before = tips
