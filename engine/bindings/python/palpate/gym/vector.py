"""Many hands that palpate at once: gymnasium's vector environment over one call of the engine a step."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from palpate._core import FingerSettings, World
from palpate.gym.bodies import Bodies, Floats, Region, Whole
from palpate.gym.hands import Felt, Flags, Hands
from palpate.gym.observing import Observer
from palpate.gym.recording import Recorder
from palpate.gym.spaces import AutoresetMode, Box, VectorBase, batched
from palpate.gym.tasks import Task, make_task

__all__ = ["Options", "Streams", "VectorEnv"]

Seeds = Union[None, int, Sequence[int]]


@dataclasses.dataclass(frozen=True)
class Options:
    """What an environment is; each a keyword of VectorEnv and Env. None: as the task has it.

    bodies: a World, several, or Bodies: an episode draws one of them. around: middle of the region, by name or (3,) mm;
    reach_mm: half its width. observe: names of blocks (observing.py); as_dict: each by itself. substeps: ticks of a
    step, or of a press; max_step_mm: the way of a tip in a step, max_turn_deg: the turn of a tool; press_mm: how deep a
    press goes. settings: of every finger; threads: share a step. max_episode_steps: an episode is truncated after so
    many. autoreset_mode: when the next begins.

    force_noise: sd of what the device says of a force, as a share of it; place_noise_mm: of where it says it is, each
    axis; delay_steps: how many steps late it says so. Rewards are of the truth.

    pad_mm: side of a pressure pad. render_mode: None, or "rgb_array"; render_size: pixels. record: folder for the
    episodes of the environments `record_envs`, as recordings. first_stream: the number of the first environment's
    stream of random numbers, so that shares of a batch have the episodes of the whole.
    """

    bodies: Union[World, Sequence[World], Bodies, None] = None
    around: Union[str, ArrayLike] = "T9 right 30 mm"
    reach_mm: float = 40.0
    observe: Optional[Sequence[str]] = None
    as_dict: bool = False
    substeps: int = 10
    max_step_mm: float = 2.0
    max_turn_deg: float = 1.0
    press_mm: float = 6.0
    settings: Optional[FingerSettings] = None
    threads: int = 1
    max_episode_steps: int = 200
    autoreset_mode: AutoresetMode = AutoresetMode.NEXT_STEP
    force_noise: float = 0.0
    place_noise_mm: float = 0.0
    delay_steps: int = 0
    pad_mm: float = 16.0
    render_mode: Optional[str] = None
    render_size: tuple[int, int] = (320, 240)
    record: Union[None, str, os.PathLike[str]] = None
    record_envs: Sequence[int] = (0,)
    first_stream: int = 0

    def __post_init__(self) -> None:
        least = {"substeps": 1, "max_episode_steps": 1, "delay_steps": 0, "first_stream": 0, "force_noise": 0,
                 "place_noise_mm": 0}
        above = ("reach_mm", "max_step_mm", "max_turn_deg", "press_mm")
        for name in (*least, *above):
            value = getattr(self, name)
            if not (value > 0 if name in above else value >= least[name]):
                raise ValueError(f"{name}: must be {'above 0' if name in above else f'at least {least[name]}'}, not {value}")
        if self.render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode: must be None or 'rgb_array', not {self.render_mode!r}")
        object.__setattr__(self, "autoreset_mode", AutoresetMode(self.autoreset_mode))


class Streams:
    """Random numbers of each environment, drawn some calls ahead: a stream does not depend on its neighbours."""

    AHEAD = 32  # calls: one in so many asks each generator by itself

    def __init__(self, sequences: Sequence[np.random.SeedSequence], width: int, normal: bool = False) -> None:
        """width: numbers a call; normal: standard normal, otherwise uniform from 0 to 1."""
        self._generators = [np.random.Generator(np.random.PCG64(one)) for one in sequences]
        self._ahead: Floats = np.empty((len(sequences), self.AHEAD, width))
        self._used: Whole = np.full(len(sequences), self.AHEAD)
        self._normal = normal

    def draw(self, which: Whole) -> Floats:
        """The next numbers of these (k,): (k, width)."""
        for number in which[self._used[which] == self.AHEAD]:
            generator, shape = self._generators[number], self._ahead.shape[1:]
            self._ahead[number] = generator.standard_normal(shape) if self._normal else generator.random(shape)
            self._used[number] = 0
        drawn: Floats = self._ahead[which, self._used[which]]
        self._used[which] += 1
        return drawn


class VectorEnv(VectorBase):
    """num_envs environments, each with episodes of its own, in arrays; Options has its options, tasks.py the tasks,
    observing.py the blocks of observations.

    Actions (n, width) in -1 to 1; observations float32. Answers of `step` and `reset` are fresh arrays.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 30, "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, num_envs: int = 1, *, task: Union[str, Task] = "FindStiffest", **options: Any) -> None:
        """task: its name, or one; options: those of Options, and of the task where it is a name.

        Raises ValueError, TypeError for a name that is unknown, palpate.Error for a body or a place."""
        if num_envs < 1:
            raise ValueError("num_envs: must be at least 1")
        names = {field.name for field in dataclasses.fields(Options)}
        own = {name: value for name, value in options.items() if name not in names}
        self.task = make_task(task, own)
        given = {name: value for name, value in options.items() if name in names}
        self.options = Options(**{**self.task.defaults, **given})
        self.num_envs = num_envs
        self.render_mode = self.options.render_mode
        self.metadata = {**self.metadata, "autoreset_mode": self.options.autoreset_mode}
        bodies = self.options.bodies if self.options.bodies is not None else self.task.bodies(self.options)
        self.bodies = bodies if isinstance(bodies, Bodies) else Bodies(bodies)
        self.region = Region(self.bodies.worlds, self.options.around, self.options.reach_mm)
        self.every: Whole = np.arange(num_envs)
        self.body: Whole = np.zeros(num_envs, np.int64)  # of each environment, a number in bodies.worlds
        self.middles: Floats = self.region.middle[self.body][:, None]  # of the regions of these bodies, mm
        self.steps: Whole = np.zeros(num_envs, np.int64)  # of each episode
        self.episodes: Whole = np.zeros(num_envs, np.int64)  # begun since the seed
        self.seen: dict[str, Any] = {}
        self.answers: Floats = np.zeros((num_envs, self.task.answers))
        self._observer = Observer(self, self.options.observe if self.options.observe is not None else self.task.observe)
        self.hands: Hands = self.task.control(self, self._observer.fields())
        self.felt: Felt = self.hands.felt
        self.recorder = Recorder(self) if self.options.record is not None else None
        width = self.hands.width + self.task.answers
        self.single_action_space: Any = Box(-1.0, 1.0, (width,))
        self.single_observation_space: Any = self._observer.space
        self.action_space: Any = batched(self.single_action_space, num_envs)
        self.observation_space: Any = batched(self._observer.space, num_envs)
        self._prepared: Flags = np.zeros(num_envs, bool)  # whether the next episode's numbers are drawn
        self._draws: Floats = np.zeros((num_envs, 1 + self.hands.draws + self.task.draws))
        self._next_body = self.body.copy()
        self._ended: Optional[Flags] = None
        self._any_ended = False
        self._streams: Optional[Streams] = None
        self.seeds: Any = None  # of each environment its seed and the number of its stream
        self._noise: Optional[Streams] = None
        self.task.attach(self)
        self._observer.sense(None)
        self._observer.observe(None)  # what cannot be observed here is refused now

    def reset(self, *, seed: Seeds = None, options: Optional[dict[str, Any]] = None) -> tuple[Any, dict[str, Any]]:
        """All episodes begin; or those of options={"reset_mask": bool (n,)}.

        seed: one for all, of which environment i has SeedSequence(seed, spawn_key=(i,)), or one each; the same seed
        gives the same episodes. None goes on with the random numbers as they are. Raises ValueError."""
        mask = (options or {}).get("reset_mask")
        if mask is not None and (np.shape(mask) != (self.num_envs,) or np.asarray(mask).dtype != bool or not np.any(mask)):
            raise ValueError(f"reset_mask: must be ({self.num_envs},) of bool, with one at least that is True")
        if seed is not None or self._streams is None:
            self._seed(seed)
        if mask is None or self._ended is None:
            mask = np.ones(self.num_envs, bool)
            self._ended = mask.copy()
        return self._first(np.asarray(mask)), {}

    def step(self, actions: ArrayLike) -> tuple[Any, Floats, Flags, Flags, dict[str, Any]]:
        """Observations, rewards (n,), terminated (n,), truncated (n,), infos: `state` (n, hands), 0 free, 1 stick, 2
        slip, and the task's, each with its mask `_state` (n,).

        Next-step mode: where an episode ended, the action is not looked at, and the answer is the next one's first.
        Raises ValueError for actions of another shape or not finite, RuntimeError before the first reset, and in
        disabled mode where an episode has ended."""
        if self._ended is None:
            raise RuntimeError("call reset first")
        moves = np.asarray(actions, np.float64)
        width = self.hands.width + self.task.answers
        if moves.shape != (self.num_envs, width) or not np.isfinite(np.add.reduce(moves, axis=None)):
            raise ValueError(f"actions: expected finite numbers of shape ({self.num_envs}, {width})")
        begun = self._ended if self._any_ended else None
        if begun is not None and self.options.autoreset_mode == AutoresetMode.DISABLED:
            raise RuntimeError("an episode has ended: call reset with options={'reset_mask': ...}")
        self.hands.aim(moves[:, :self.hands.width])
        if self.task.answers:
            self.answers[:] = moves[:, self.hands.width:]
        if begun is not None:
            self._begin(begun)
        self.steps += 1
        if begun is not None:
            self.steps[begun] = 0
        self.hands.feel(None, begun)
        self._sense(None)
        rewards, terminated, infos = self.task.judge()
        if "state" in self.felt:
            infos["state"] = self.felt["state"].copy()
        if begun is not None:
            rewards[begun] = 0.0
            terminated &= ~begun
        truncated = self.steps >= self.options.max_episode_steps
        truncated &= ~terminated
        self._ended = terminated | truncated
        self._any_ended = bool(self._ended.any())
        known = np.ones(self.num_envs, bool) if begun is None else ~begun
        infos.update({"_" + name: known for name in infos})
        observed = self._observer.observe(begun)
        if self._any_ended and self.options.autoreset_mode == AutoresetMode.SAME_STEP:
            observed, infos = self._begin_in_the_same_step(observed, infos)
        return observed, rewards, terminated, truncated, infos

    def render(self) -> Optional[tuple[Any, ...]]:
        """A picture (H, W, 3) of uint8 of each environment, with its fingers; None without a render_mode."""
        if self.render_mode is None:
            return None
        from palpate import view

        touches: Any = self.hands.fingers.touches()
        each = getattr(self.hands.fingers, "pads", self.hands.hands)
        return tuple(view.render(self.bodies.worlds[self.body[number]], None, touches[number * each:(number + 1) * each],
                                 size=self.options.render_size, supersampling=1, labels=False, finger=self.hands.drawn,
                                 radius_mm=self.hands.settings.radius_mm or None,
                                 camera=view.Camera(look_at=self.region.middle[self.body[number]], zoom=4))
                     for number in range(self.num_envs))

    def close_extras(self, **kwargs: Any) -> None:
        """Ends the threads of its fingers, and completes recordings."""
        if self.recorder is not None:
            self.recorder.finish(self.every)
        self.hands.fingers.close()

    def _seed(self, seed: Seeds) -> None:
        if seed is None:
            seed = int(self.np_random.integers(2**62))
        elif np.ndim(seed) == 0:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed
        if np.ndim(seed) == 0:
            keys = [(seed, self.options.first_stream + number) for number in range(self.num_envs)]
        elif len(seed) == self.num_envs:  # type: ignore[arg-type]
            keys = [(int(one), 0) for one in seed]  # type: ignore[union-attr]
        else:
            raise ValueError(f"seed: expected one, or {self.num_envs}")
        # Of each environment its episodes and its noise, so that one does not depend on how much of the other is drawn.
        both = [np.random.SeedSequence(one, spawn_key=(number,)).spawn(2) for one, number in keys]
        self.seeds = keys
        self._streams = Streams([one for one, _ in both], self._draws.shape[1])
        self._prepared[:] = False
        noisy = self.options.force_noise > 0 or self.options.place_noise_mm > 0
        self._noise = Streams([one for _, one in both], 5 * self.hands.hands, normal=True) if noisy else None
        self.episodes[:] = 0

    def _begin(self, mask: Flags) -> None:
        """An episode is what its uniform numbers say: of the body, of the hands, of the task."""
        assert self._ended is not None
        which = np.flatnonzero(mask)
        if not self._prepared[which].all():
            self._prepare()
        if self.recorder is not None:
            self.recorder.finish(which)
        if len(self.bodies) > 1:
            self.body[which] = self._next_body[which]
            self.middles[which, 0] = self.region.middle[self.body[which]]
        self.steps[which] = 0
        self.episodes[which] += 1
        self._ended = self._ended & ~mask
        self._any_ended = bool(self._ended.any())
        self.hands.begin(which, mask)
        if self.recorder is not None:
            self.recorder.begin(which)
        self.task.begin(which, self._draws[which, 1 + self.hands.draws:])
        self._prepared[which] = False

    def _prepare(self) -> None:
        """The next episodes of all that have none ready: many at once, as a few would take nearly as long."""
        assert self._streams is not None
        which = np.flatnonzero(~self._prepared)
        self._draws[which] = self._streams.draw(which)
        bodies = np.minimum((self._draws[which, 0] * len(self.bodies)).astype(np.int64), len(self.bodies) - 1)
        self._next_body[which] = bodies
        self.hands.prepare(which, bodies, self._draws[which, 1:1 + self.hands.draws])
        self._prepared[which] = True

    def _sense(self, mask: Optional[Flags]) -> None:
        noise = None
        if self._noise is not None:
            which = self.every if mask is None else np.flatnonzero(mask)
            noise = np.zeros((self.num_envs, self.hands.hands, 5))
            noise[which] = self._noise.draw(which).reshape(len(which), -1, 5)
        self._observer.sense(noise)

    def _first(self, mask: Flags) -> Any:
        """Observations, of these the first of their episodes."""
        self._begin(mask)
        self.hands.feel(mask, mask)
        self._sense(mask)
        return self._observer.observe(mask, mask)

    def _begin_in_the_same_step(self, observed: Any, infos: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
        ended = self._ended
        assert ended is not None
        last = np.full(self.num_envs, None, object)
        for number in np.flatnonzero(ended):
            last[number] = ({name: array[number].copy() for name, array in observed.items()}
                            if isinstance(observed, dict) else observed[number].copy())
        final = {name: value & ended if name.startswith("_") else value.copy() for name, value in infos.items()}
        infos.update({name: value & ~ended for name, value in infos.items() if name.startswith("_")})
        infos.update(final_obs=last, _final_obs=ended, final_info=final, _final_info=ended.copy())
        return self._first(ended), infos
