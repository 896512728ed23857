"""What an environment observes: blocks by name, with a device's noise and delay."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import NDArray

from palpate.gym.bodies import Floats
from palpate.gym.hands import FELT, PRESSED, Flags, Presses, Scans
from palpate.gym.spaces import AutoresetMode, Box, Dict

if TYPE_CHECKING:
    from palpate.gym.vector import VectorEnv

__all__ = ["Block", "Observer", "block_named"]

Singles = NDArray[np.float32]


@dataclass(frozen=True)
class Block:
    """Numbers of an observation: how many, their bounds, and who writes them, for all environments, into (n, width)."""

    width: int
    low: float
    high: float
    write: Callable[[VectorEnv, Singles], Any]


def _tip(env: VectorEnv, out: Singles) -> None:
    away = env.seen["tips"] - env.middles
    away *= 1.0 / env.region.reach_mm
    out[:] = away.reshape(out.shape)


def _felt(name: str) -> Callable[[VectorEnv, Singles], None]:
    """Writes what the engine answered by this name."""
    def write(env: VectorEnv, out: Singles) -> None:
        out[:] = env.felt[name].reshape(out.shape)

    return write


def _seen(name: str) -> Callable[[VectorEnv, Singles], None]:
    """Writes what the device says by this name."""
    def write(env: VectorEnv, out: Singles) -> None:
        out[:] = env.seen[name].reshape(out.shape)

    return write


def _moment(env: VectorEnv, out: Singles) -> None:
    arm = env.felt["proxy"] - env.seen["tips"]
    out[:] = np.cross(arm, env.seen["force"]).reshape(out.shape)


def _friction(env: VectorEnv, out: Singles) -> None:
    force, normal = env.seen["force"], env.felt["normal"]
    pressing = (force * normal).sum(axis=2)
    sideways = np.linalg.norm(force - pressing[..., None] * normal, axis=2)
    np.divide(sideways, pressing, out=out, where=pressing > 1e-9, casting="same_kind")
    out[pressing <= 1e-9] = 0.0


def _contact(env: VectorEnv, out: Singles) -> None:
    out.reshape(*env.felt["state"].shape, 3)[:] = env.felt["state"][..., None] == np.arange(3)


def _time(env: VectorEnv, out: Singles) -> None:
    np.divide(env.steps[:, None], env.options.max_episode_steps, out=out, casting="same_kind")


def _pressure(taxels: int) -> Callable[[VectorEnv, Singles], None]:
    def write(env: VectorEnv, out: Singles) -> None:
        for number in np.unique(env.body):  # a pattern is of a world
            mine = env.body == number
            felt = {name: array[mine].reshape((-1,) + array.shape[2:]) for name, array in env.felt.items()}
            tick = np.repeat(env.hands.ticks()[mine], env.hands.hands)
            pattern = env.bodies.worlds[number].pressure(felt, taxels, env.options.pad_mm, tick=tick)
            out[mine] = pattern.reshape(int(mine.sum()), -1)

    return write


def _known(env: VectorEnv) -> dict[str, Block]:
    """Those of every task, as far as its hands have them."""
    hands, control, free = env.task.hands, env.task.control, np.inf
    known = {
        "force": Block(3 * hands, -free, free, _seen("force")),  # N
        "depth": Block(hands, 0.0, free, _felt("depth")),  # mm
        "time": Block(1, 0.0, 1.0, _time),  # share of the episode that is over
    }
    if not issubclass(control, Scans):
        known["normal"] = Block(3 * hands, -1.0, 1.0, _felt("normal"))  # of the skin, out of it; 0 when free
        known["friction"] = Block(hands, 0.0, free, _friction)  # sideways over normal force
        known["contact"] = Block(3 * hands, 0.0, 1.0, _contact)  # 1 for one of free, stick, slip
    if issubclass(control, Presses):
        known["place"] = Block(2, -1.0, 1.0, _seen("places"))  # of the last press, coordinates of the region
        known["reading"] = Block(2, -free, free, _seen("readings"))  # normal force, N, and that of the reference or 0
    else:
        moment = _felt("moment") if issubclass(control, Scans) else _moment
        known["tip"] = Block(3 * hands, -1.0, 1.0, _tip)  # from the region's middle, over reach_mm
        known["moment"] = Block(3 * hands, -free, free, moment)  # N mm, about the tip
    if issubclass(control, Scans):
        known["turned"] = Block(9, -1.0, 1.0, _felt("turned"))  # from the head's frame to the body's, row by row
        known["touching"] = Block(1, 0.0, 1.0, _felt("touching"))  # share of the head's pads
    return known


def block_named(name: str, env: VectorEnv) -> Block:
    """One of the task's, or of those above, or "pressure2" to "pressure16": a pad of so many squared, kPa."""
    own = env.task.blocks()
    if name in own:
        return own[name]
    known = _known(env)
    if name in known:
        return known[name]
    number = name[len("pressure"):] if name.startswith("pressure") else ""
    if number.isascii() and number.isdigit() and not issubclass(env.task.control, Scans) and 2 <= int(number) <= 16:
        return Block(env.task.hands * int(number) ** 2, 0.0, np.inf, _pressure(int(number)))
    raise ValueError(f"observe: must be any of {', '.join([*own, *known])}, or 'pressure2' to 'pressure16', not {name!r}")


class Observer:
    """Writes the observations of all environments."""

    def __init__(self, env: VectorEnv, names: Sequence[str]) -> None:
        """Raises ValueError for a name that is unknown or given twice."""
        if isinstance(names, str) or not names or len(set(names)) != len(names):
            raise ValueError("observe: expected different names of blocks, at least one")
        self.env = env
        self.blocks = {name: block_named(name, env) for name in names}
        self.slices: dict[str, slice] = {}
        self.width = 0  # numbers of an observation
        for name, block in self.blocks.items():
            self.slices[name] = slice(self.width, self.width + block.width)
            self.width += block.width
        spaces = {name: Box(block.low, block.high, (block.width,)) for name, block in self.blocks.items()}
        low, high = (np.concatenate([getattr(space, end) for space in spaces.values()]) for end in ("low", "high"))
        self.space: Any = Dict(spaces) if env.options.as_dict else Box(low, high)
        self._late: Optional[Singles] = None
        if env.options.delay_steps:
            self._late = np.zeros((env.options.delay_steps + 1, env.num_envs, self.width), np.float32)
        self._at = 0
        self._last: Singles = np.zeros((env.num_envs, self.width), np.float32)
        self._keeps = env.options.autoreset_mode != AutoresetMode.NEXT_STEP  # what was observed is asked for again

    def fields(self) -> tuple[str, ...]:
        """What the engine is asked for."""
        return PRESSED if any(name.startswith("pressure") for name in self.slices) else FELT

    def sense(self, noise: Optional[Floats]) -> None:
        """Fills env.seen, what the device says, from what is true. noise: standard normal numbers (n, hands, 5)."""
        env, options, hands = self.env, self.env.options, self.env.hands
        env.seen = seen = hands.sensed()
        if noise is None:
            return
        gain = 1.0 + options.force_noise * noise[..., 3:4]
        seen["force"] = seen["force"] * gain
        if "tips" in seen:
            seen["tips"] = seen["tips"] + options.place_noise_mm * noise[..., :3]
        else:
            seen["places"] = seen["places"] + options.place_noise_mm / env.region.reach_mm * noise[:, 0, :2]
            gains = np.concatenate([gain[:, 0], 1.0 + options.force_noise * noise[:, 0, 4:]], axis=1)
            gains[:, 1:] **= env.task.reference == "other_side"  # felt, too; a model is not
            seen["readings"] = seen["readings"] * gains

    def observe(self, begun: Optional[Flags], only: Optional[Flags] = None) -> Any:
        """Observations (n, width), or a dict of their blocks. begun: those whose episodes begin with it; only: those
        for whom something is new, the others have what they had; None: a step has passed for all."""
        out = np.empty((self.env.num_envs, self.width), np.float32)
        for name, block in self.blocks.items():
            block.write(self.env, out[:, self.slices[name]])
        if self.env.options.place_noise_mm > 0:
            for part in (self.slices[name] for name in ("tip", "place") if name in self.slices):
                np.clip(out[:, part], -1.0, 1.0, out=out[:, part])
        if only is not None:
            out[~only] = self._last[~only]
        if self._late is not None:
            out = self._delayed(out, begun, only is None)
        self._last = out.copy() if self._keeps else out
        return {name: out[:, part] for name, part in self.slices.items()} if self.env.options.as_dict else out

    def _delayed(self, out: Singles, begun: Optional[Flags], fresh: bool) -> Singles:
        """Those of delay_steps ago; an episode's first ones until then."""
        late = self._late
        assert late is not None
        if fresh:
            self._at = (self._at + 1) % len(late)
            late[self._at] = out
        if begun is not None:
            late[:, begun] = out[begun]
        oldest: Singles = late[(self._at + 1) % len(late)].copy()
        return oldest
