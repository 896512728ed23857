"""Tasks: what an episode asks for, what it pays, and when it ends. All for n environments at once."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from palpate._core import FingerSettings, World
from palpate.gym.bodies import Bodies, Floats, Range, Region, Whole
from palpate.gym.hands import CLEAR_MM, Flags, Hands, Moves, Presses, Scans
from palpate.gym.observing import Block, Singles

if TYPE_CHECKING:
    from palpate.gym.vector import Options, VectorEnv

__all__ = ["TASKS", "CountLumps", "ExploreTwoHands", "FindLump", "FindStiffest", "FollowForce", "ScanWithProbe", "Search", "Task",
           "make_task"]

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


class FollowForce(Task):
    """Press with a force that changes, while going along a line of length_mm over the skin: six forces an episode, drawn
    from force_n evenly by their logarithm.

    A step pays 1 less the force's relative error and less a tenth of the way to the line's point, mm, but not below 0; an
    episode ends where the force is over limit_n. Success, known with the last step: force within 10 % and place within 5
    mm in four of five steps, of which the first fifth of each force is not counted.
    """

    LEVELS = 6
    draws = LEVELS + 1
    observe = ("tip", "force", "depth", "goal")

    def __init__(self, force_n: Range = (0.5, 4.0), length_mm: float = 30.0, limit_n: float = 15.0) -> None:
        """Raises ValueError for forces that are not above 0, or not below the limit."""
        if not 0 < force_n[0] <= force_n[1] < limit_n or not length_mm >= 0:
            raise ValueError("force_n: must be above 0 and below limit_n, and length_mm at least 0")
        self.force_n, self.length_mm, self.limit_n = force_n, length_mm, limit_n

    def blocks(self) -> dict[str, Block]:
        """goal: the force, N, and the way to the line's point over reach_mm (3)."""
        return {"goal": Block(4, -np.inf, np.inf, self._write_goal)}

    def _write_goal(self, env: VectorEnv, out: Singles) -> None:
        out[:, 0] = self._level
        out[:, 1:] = (self._point - env.seen["tips"][:, 0]) / env.region.reach_mm

    def attach(self, env: VectorEnv) -> None:
        """Makes room."""
        super().attach(env)
        n = env.num_envs
        self._levels: Floats = np.ones((n, self.LEVELS))
        self._level: Floats = np.ones(n)
        self._start, self._way, self._normal, self._point = np.zeros((4, n, 3))
        self._right, self._counted = np.zeros((2, n), np.int64)

    def begin(self, which: Whole, draws: Floats) -> None:
        """Draws the forces and the line, which begins under the finger and turns back at the region's border."""
        env, (low, high) = self.env, self.force_n
        bodies = env.body[which]
        self._levels[which] = low * (high / low) ** draws[:, :self.LEVELS]
        angle = 2 * np.pi * draws[:, self.LEVELS]
        start = env.region.coordinates(bodies, env.hands.tips[which, 0])
        way = self.length_mm / env.region.reach_mm * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        end = np.where(np.abs(start + way) > 0.9, start - way, start + way)
        ends = [env.region.at(bodies, place)[0] for place in (start, end)]
        self._start[which], self._way[which] = ends[0], ends[1] - ends[0]
        self._normal[which] = env.region.normal[bodies]
        self._level[which], self._point[which] = self._levels[which, 0], ends[0]
        self._right[which] = self._counted[which] = 0

    def judge(self) -> Judgement:
        """infos: success, error_n of the force, away_mm from the line's point."""
        env = self.env
        felt, share = env.felt, env.steps / env.options.max_episode_steps
        at = np.minimum(share * self.LEVELS, self.LEVELS - 1e-9)
        number = at.astype(np.int64)
        self._level = np.take_along_axis(self._levels, number[:, None], axis=1)[:, 0]
        self._point = self._start + self._way * share[:, None]
        pressing = np.einsum("ij,ij->i", felt["force"][:, 0], felt["normal"][:, 0])
        error = np.abs(pressing - self._level)
        away = env.hands.tips[:, 0] - self._point
        away -= np.einsum("ij,ij->i", away, self._normal)[:, None] * self._normal
        away_mm = np.sqrt(np.einsum("ij,ij->i", away, away))
        settled = at - number > 0.2
        self._counted += settled
        self._right += settled & (error <= 0.1 * self._level) & (away_mm <= 5.0)
        over = pressing > self.limit_n
        rewards = np.maximum(1.0 - error / self._level - 0.1 * away_mm, 0.0)
        success = (env.steps >= env.options.max_episode_steps) & ~over & (self._right >= 0.8 * self._counted)
        return rewards, over, {"success": success, "error_n": error, "away_mm": away_mm}


class Search(Task):
    """What searches for hidden places have in common: a step is a press of a fingertip, which costs `cost`.

    A body is drawn from `pool` torsos with round places that are change_percent stiffer, radius_mm wide, `count` of them
    (least, most), drawn by bodies_seed; an environment that is given bodies takes those. reference: what each press is
    held against: "model", the healthy body's force there; "other_side", that of the place across; "none". Without one
    the healthy body's own variation drowns what is hidden.
    """

    control = Presses
    observe = ("place", "reading")
    defaults = {"substeps": 50, "max_episode_steps": 60, "settings": FingerSettings(radius_mm=8.0)}

    def __init__(self, reference: str = "model", *, count: tuple[int, int] = (1, 1), change_percent: Range = (50.0, 50.0),
                 radius_mm: Range = (15.0, 15.0), pool: int = 64, bodies_seed: int = 0, cost: float = 0.01) -> None:
        """Raises ValueError for another reference, or counts that are none."""
        if reference not in ("model", "other_side", "none"):
            raise ValueError(f"reference: must be 'model', 'other_side' or 'none', not {reference!r}")
        if not 0 <= count[0] <= count[1] or pool < 1:
            raise ValueError("count: must be (least, most), and pool at least 1")
        self.reference, self.cost = reference, cost
        self._pool: dict[str, Any] = {"count": count, "change_percent": change_percent, "radius_mm": radius_mm, "pool": pool,
                                      "seed": bodies_seed}

    def bodies(self, options: Options) -> Bodies:
        """The pool."""
        world = torso()
        return Bodies.with_stiff_places(world, Region([world], options.around, options.reach_mm), **self._pool)

    def attach(self, env: VectorEnv) -> None:
        """Where what is hidden lies in each body, mm from the region's middle, seen along its normal."""
        super().attach(env)
        places = env.region.coordinates(np.arange(len(env.bodies)), env.bodies.hidden) * env.region.reach_mm
        self._hidden: Floats = np.where(np.isnan(places), np.inf, places)


class FindLump(Search):
    """Find what is hidden, by pressing. Three more numbers of an action say where it is believed to be, coordinates (a,
    b) of the region, and how sure: above 0.5 ends the episode, as found there; below -0.5 says that there is nothing.

    It pays 1 for what is right, within goal_mm of one, and -1 for what is not.
    """

    answers = 3

    def __init__(self, reference: str = "model", goal_mm: float = 5.0, **options: Any) -> None:
        """options: as Search. Raises ValueError."""
        super().__init__(reference, **options)
        if not goal_mm > 0:
            raise ValueError("goal_mm: must be above 0")
        self.goal_mm = goal_mm

    def judge(self) -> Judgement:
        """infos: success, error_mm of the belief, whether it is declared or not; inf where nothing is hidden."""
        env = self.env
        belief = np.clip(env.answers[:, :2], -1.0, 1.0) * env.region.reach_mm
        away = self._hidden[env.body] - belief[:, None]
        error = np.hypot(away[..., 0], away[..., 1]).min(axis=1)
        found, nothing = env.answers[:, 2] > 0.5, env.answers[:, 2] < -0.5
        right = np.where(found, error <= self.goal_mm, nothing & (env.bodies.counts[env.body] == 0))
        ended = found | nothing
        return np.where(ended, np.where(right, 1.0, -1.0), 0.0) - self.cost, ended, {"success": right, "error_mm": error}


class CountLumps(Search):
    """Say how many places are hidden, 0 to 3 or what `count` says, after presses. One more number of an action: below 0
    goes on, from 0 to 1 it ends the episode with an answer, in equal parts for 0 to the most.

    It pays 1 for the right number, otherwise minus the error over the most.
    """

    answers = 1

    def __init__(self, reference: str = "model", *, count: tuple[int, int] = (0, 3), **options: Any) -> None:
        """options: as Search. Raises ValueError."""
        super().__init__(reference, count=count, **options)
        self.most = max(1, count[1])

    def judge(self) -> Judgement:
        """infos: success, error of the answer, 0 before."""
        env = self.env
        given = env.answers[:, 0]
        ended = given >= 0
        answer = np.minimum(given * (self.most + 1), self.most).astype(np.int64)
        error = np.where(ended, np.abs(answer - env.bodies.counts[env.body]), 0)
        right = ended & (error == 0)
        return np.where(ended, right - error / self.most, 0.0) - self.cost, ended, {"success": right, "error": error}


class ScanWithProbe(Task):
    """Take a linear ultrasound head along the spine at a force: from the region's lower part to its upper one, across the
    middle line, flat on the skin, with force_n, one drawn an episode.

    What is gained of the way pays, in all 1, times how near the force is (1 less its relative error), the share of the
    head on the skin, and how near its middle is to the line (1 less a tenth of the distance, mm). An episode ends at the
    upper end, as a success where at least success_share was paid, and where the force is over limit_n.
    """

    control = Scans
    draws = 1
    observe = ("tip", "turned", "force", "moment", "touching", "goal")
    defaults = {"around": "T9", "reach_mm": 60.0, "substeps": 1, "max_step_mm": 0.5, "max_episode_steps": 1000,
                "settings": FingerSettings(radius_mm=3.0)}
    END = 0.7  # coordinate b where the way ends; it begins at the other sign of it

    def __init__(self, force_n: Range = (2.0, 6.0), success_share: float = 0.7, limit_n: float = 30.0) -> None:
        """Raises ValueError for forces that are not above 0, or not below the limit."""
        if not 0 < force_n[0] <= force_n[1] < limit_n:
            raise ValueError("force_n: must be above 0 and below limit_n")
        self.force_n, self.success_share, self.limit_n = force_n, success_share, limit_n

    def blocks(self) -> dict[str, Block]:
        """goal: the force, N, how far the head is from the line over reach_mm, and the share of the way that is left."""
        return {"goal": Block(3, -np.inf, np.inf, self._write_goal)}

    def _write_goal(self, env: VectorEnv, out: Singles) -> None:
        out[:, 0] = self._force
        out[:, 1:] = self._at * [1.0, -0.5 / self.END] + [0.0, 0.5]

    def attach(self, env: VectorEnv) -> None:
        """Makes room."""
        super().attach(env)
        self._force: Floats = np.ones(env.num_envs)
        self._at: Floats = np.zeros((env.num_envs, 2))
        self._farthest, self._paid = np.zeros((2, env.num_envs))

    def begin(self, which: Whole, draws: Floats) -> None:
        """Draws the force, and puts the head over the lower end."""
        env = self.env
        hands: Any = env.hands
        low, high = self.force_n
        self._force[which] = low + (high - low) * draws[:, 0]
        bodies = env.body[which]
        begun = env.region.coordinates(bodies, hands.tips[which, 0])
        lower = begun * [0.4, 0.0] - [0.0, self.END]
        points, normals = env.region.at(bodies, lower)
        hands.tips[which, 0] = points + CLEAR_MM * normals
        hands.turned[which] = hands.flat(bodies, normals)
        self._at[which], self._farthest[which], self._paid[which] = lower, -self.END, 0.0

    def judge(self) -> Judgement:
        """infos: success, error_n of the force, paid in all."""
        env, felt = self.env, self.env.felt
        self._at = env.region.coordinates(env.body, env.hands.tips[:, 0])
        pressing = np.einsum("ij,ij->i", felt["force"][:, 0], felt["turned"][:, 0, :, 2])
        error = np.abs(pressing - self._force)
        near = np.maximum(1.0 - error / self._force, 0.0)
        near *= np.maximum(1.0 - 0.1 * env.region.reach_mm * np.abs(self._at[:, 0]), 0.0)
        near *= felt["touching"][:, 0]
        reached = np.clip(self._at[:, 1], self._farthest, self.END)
        rewards = (reached - self._farthest) / (2 * self.END) * near
        self._farthest = reached
        self._paid += rewards
        over = pressing > self.limit_n
        rewards[over] -= 1.0
        ended = reached >= self.END
        success = ended & ~over & (self._paid >= self.success_share)
        return rewards, ended | over, {"success": success, "error_n": error, "paid": self._paid.copy()}


class ExploreTwoHands(Task):
    """Feel all of a region with two fingers: a step pays 1/64 for each of its 8 x 8 cells that a finger presses at least
    depth_mm deep for the first time, and costs as much where the fingers are nearer than they are wide, apart_mm.

    It ends as a success with goal_share of the cells, and with -1 where a force is over limit_n.
    """

    CELLS = 8  # a side
    hands = 2
    observe = ("tip", "force", "depth", "felt")

    def __init__(self, depth_mm: float = 2.0, goal_share: float = 0.9, apart_mm: float = 16.0, limit_n: float = 15.0) -> None:
        """Raises ValueError for a share that is not above 0, or above 1."""
        if not 0 < goal_share <= 1:
            raise ValueError("goal_share: must be above 0, at most 1")
        self.depth_mm, self.goal_share, self.apart_mm, self.limit_n = depth_mm, goal_share, apart_mm, limit_n

    def blocks(self) -> dict[str, Block]:
        """felt: of each cell whether it was felt, row by row along (a, b)."""
        return {"felt": Block(self.CELLS**2, 0.0, 1.0, self._write_cells)}

    def _write_cells(self, env: VectorEnv, out: Singles) -> None:
        out[:] = self._cells

    def attach(self, env: VectorEnv) -> None:
        """Makes room."""
        super().attach(env)
        self._cells: Flags = np.zeros((env.num_envs, self.CELLS**2), bool)

    def begin(self, which: Whole, draws: Floats) -> None:
        """Nothing is felt yet."""
        self._cells[which] = False

    def judge(self) -> Judgement:
        """infos: success, share of the cells."""
        env, felt, cells = self.env, self.env.felt, self.CELLS
        at = np.floor((env.region.coordinates(env.body, felt["proxy"]) + 1.0) * (0.5 * cells)).astype(np.int64)
        pressed = (felt["depth"] >= self.depth_mm) & ((at >= 0) & (at < cells)).all(axis=2)
        before = self._cells.sum(axis=1)
        for hand in range(self.hands):
            which = np.flatnonzero(pressed[:, hand])
            self._cells[which, at[which, hand, 0] * cells + at[which, hand, 1]] = True
        now = self._cells.sum(axis=1)
        tips = env.hands.tips
        near = ((tips[:, 0] - tips[:, 1]) ** 2).sum(axis=1) < self.apart_mm**2
        over = (np.square(felt["force"]).sum(axis=2) > self.limit_n**2).any(axis=1)
        share = now / cells**2
        success = (share >= self.goal_share) & ~over
        rewards = np.where(over, -1.0, (now - before - near) / cells**2)
        return rewards, success | over, {"success": success, "share": share}


TASKS: dict[str, type[Task]] = {task.__name__: task for task in (
    FindStiffest, FollowForce, FindLump, CountLumps, ScanWithProbe, ExploreTwoHands)}


def make_task(task: Any, options: Optional[dict[str, Any]] = None) -> Task:
    """The task of this name with these options, or the one that is given. Raises ValueError, TypeError."""
    if isinstance(task, str):
        if task not in TASKS:
            raise ValueError(f"task: must be one of {', '.join(TASKS)}, or a Task, not {task!r}")
        return TASKS[task](**(options or {}))
    if options:
        raise TypeError(f"unknown option: {', '.join(options)}")
    return task  # type: ignore[no-any-return]
