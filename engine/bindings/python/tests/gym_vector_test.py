"""palpate.gym: episodes, their seeds and their ends in all three modes, what is observed, noise, delay, and recordings."""

from __future__ import annotations

import json

import numpy as np
import pytest

import palpate
from conftest import dome
from palpate.gym import AutoresetMode, Bodies, Env, Region, Task, VectorEnv

PLACE = [0.0, 0.0, 20.0]
DOWN = [0.0, 0.0, -1.0]


@pytest.fixture(scope="module")
def hidden() -> palpate.World:
    """A dome with one stiff place."""
    vertices, faces = dome(40)
    distance = np.linalg.norm(vertices[:, :2] - [15.0, -10.0], axis=1)
    return palpate.World.from_arrays(vertices, faces, stiffness=0.4 + 0.8 * np.exp(-((distance / 12) ** 2)))


def make(world: palpate.World | Bodies, n: int = 16, **options) -> VectorEnv:
    return VectorEnv(n, bodies=world, around=PLACE, **options)


def played(env: VectorEnv, steps: int, seed: int | list[int] | None = 5, first: int = 0, of: int | None = None) -> list[np.ndarray]:
    """Observations of so many steps; the actions are those of environments first ... of a batch of `of`."""
    seen = [env.reset(seed=seed)[0]]
    random = np.random.default_rng(0)
    for _ in range(steps):
        action = random.uniform(-1, 1, (of or env.num_envs, 3)) + [0, 0, -0.3]
        seen.append(env.step(action[first:first + env.num_envs])[0])
    return seen


def same(one: list[np.ndarray], other: list[np.ndarray]) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other))


def test_arrays_have_the_shapes_of_their_spaces(hidden):
    env = make(hidden, 5)
    observed, infos = env.reset(seed=3)
    assert observed.shape == (5, 7) == env.observation_space.shape and observed.dtype == np.float32
    assert env.observation_space.contains(observed) and infos == {}
    action = env.action_space.sample()
    assert action.shape == (5, 3) and env.single_action_space.shape == (3,)
    observed, rewards, terminated, truncated, infos = env.step(action)
    assert rewards.shape == terminated.shape == truncated.shape == (5,) and terminated.dtype == truncated.dtype == bool
    for name in ("success", "error_mm", "state"):
        assert len(infos[name]) == 5 and infos["_" + name].all()


def test_a_small_region_holds_what_begins_in_it(hidden):
    env = make(hidden, 32, reach_mm=12.0, settings=palpate.FingerSettings(radius_mm=8))
    assert env.observation_space.contains(env.reset(seed=1)[0])


def test_a_stream_is_that_of_its_environment_however_they_are_shared(hidden):
    whole = played(make(hidden, 8, max_episode_steps=4, force_noise=0.1), 70, seed=9)
    for first in (0, 4):
        part = make(hidden, 4, max_episode_steps=4, force_noise=0.1, first_stream=first)
        assert same(played(part, 70, seed=9, first=first, of=8), [one[first:first + 4] for one in whole])
    assert not same(whole, played(make(hidden, 8, max_episode_steps=4, force_noise=0.1), 70, seed=10))


def test_a_list_of_seeds_gives_each_its_own(hidden):
    one, two = make(hidden, 2).reset(seed=[7, 7])[0]
    np.testing.assert_array_equal(one, two)
    np.testing.assert_array_equal(make(hidden, 1).reset(seed=7)[0][0], one)
    with pytest.raises(ValueError, match="seed"):
        make(hidden, 2).reset(seed=[1, 2, 3])


def test_without_a_seed_the_random_numbers_go_on(hidden):
    env = make(hidden, 2, max_episode_steps=1)
    first, second = env.reset(seed=1)[0], env.reset()[0]
    assert not np.array_equal(first, second)
    env.reset(seed=1)
    env.step(np.zeros((2, 3)))
    np.testing.assert_array_equal(env.step(np.zeros((2, 3)))[0], second)
    env = make(hidden, 2, autoreset_mode="Disabled")
    for _ in range(2):  # also where the next episode of one is prepared
        np.testing.assert_array_equal(env.reset(seed=1)[0], first)
        env.reset(options={"reset_mask": np.array([True, False])})


def test_next_step_mode_begins_in_the_step_after(hidden):
    env = make(hidden, 3, max_episode_steps=3)
    env.reset(seed=1)
    down = np.tile(DOWN, (3, 1))
    for step in range(3):
        last, _, terminated, truncated, _ = env.step(down)
        assert not terminated.any() and (truncated == (step == 2)).all()
    kept = last.copy()
    begun, rewards, terminated, truncated, infos = env.step(down)
    assert not rewards.any() and not terminated.any() and not truncated.any() and not infos["_success"].any()
    np.testing.assert_array_equal(last, kept)
    np.testing.assert_allclose((begun - env.step(down)[0])[:, 2], 2.0 / 40.0, rtol=1e-3)


def test_same_step_mode_tells_the_end_beside_the_beginning(hidden):
    """The same episodes as in next-step mode, without the step between."""
    then, at_once = make(hidden, 3, max_episode_steps=3), make(hidden, 3, max_episode_steps=3, autoreset_mode="SameStep")
    then.reset(seed=1), at_once.reset(seed=1)
    down = np.tile(DOWN, (3, 1))
    for step in range(3):
        last = then.step(down)
        observed, rewards, _, truncated, infos = at_once.step(down)
    first = then.step(down)[0]
    np.testing.assert_array_equal(observed, first)
    np.testing.assert_array_equal(rewards, last[1])
    assert truncated.all() and infos["_final_obs"].all() and not infos["_success"].any()
    np.testing.assert_array_equal(np.stack(infos["final_obs"]), last[0])
    np.testing.assert_array_equal(infos["final_info"]["error_mm"], last[4]["error_mm"])
    assert infos["final_info"]["_error_mm"].all() and at_once.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP
    np.testing.assert_array_equal(at_once.step(down)[0], then.step(down)[0])


@pytest.mark.parametrize("delay", (0, 1))
def test_same_step_mode_leaves_the_others_alone(hidden, delay):
    """One of two ends; the other, whose skin relaxes, feels what it feels with nobody beside it."""
    relaxing = palpate.FingerSettings(relaxation_share=0.5, relaxation_time_s=0.1)

    def run(ends: bool) -> list[np.ndarray]:
        env = make(hidden, 2, autoreset_mode="SameStep", force_noise=0.1, delay_steps=delay, settings=relaxing, goal_mm=1.0)
        seen = [env.reset(seed=4)[0][1]]
        for step in range(20):
            if ends and step == 15:
                env.hands.fingers.reset(np.array([True, False]))
                env.hands.tips[0, 0] = env.task.goals[0] + [0, 0, 1.5]
            observed, _, terminated, _, infos = env.step(np.tile([0, 0, -0.5], (2, 1)))
            assert terminated.tolist() == [ends and step == 16, False]
            assert ("final_obs" in infos) == terminated.any() and (not terminated.any() or infos["final_obs"][1] is None)
            seen.append(observed[1])
        assert np.linalg.norm(seen[-1][3:6]) > 0.5
        return seen

    assert same(run(True), run(False))


def test_disabled_mode_waits_for_a_mask(hidden):
    env = make(hidden, 3, max_episode_steps=50, autoreset_mode=AutoresetMode.DISABLED)
    before = env.reset(seed=1)[0]
    env.hands.tips[0] = env.task.goals[0] + [0, 0, 1.0]
    down = np.tile(DOWN, (3, 1))
    last, rewards, terminated, _, infos = env.step(down)
    assert terminated.tolist() == [True, False, False] == infos["success"].tolist() and rewards[0] > 1.0
    with pytest.raises(RuntimeError, match="reset_mask"):
        env.step(down)
    begun, _ = env.reset(options={"reset_mask": np.array([True, False, False])})
    np.testing.assert_array_equal(begun[1:], last[1:])
    assert not np.array_equal(begun[0], last[0]) and not np.array_equal(begun[0], before[0])
    np.testing.assert_allclose(env.step(down)[0][1:, 2] - last[1:, 2], -2.0 / 40.0, rtol=1e-3)
    for wrong in (np.zeros(3, bool), np.ones(2, bool), np.ones(3)):
        with pytest.raises(ValueError, match="reset_mask"):
            env.reset(options={"reset_mask": wrong})


def test_one_environment_is_the_first_of_many(hidden):
    many, one = make(hidden, 3, max_episode_steps=6), Env(bodies=hidden, around=PLACE, max_episode_steps=6)
    first, _ = many.reset(seed=2)
    np.testing.assert_array_equal(one.reset(seed=2)[0], first[0])
    for step in range(6):
        observed, rewards, _, truncated, infos = many.step(np.tile([0.2, 0.1, -1.0], (3, 1)))
        alone = one.step([0.2, 0.1, -1.0])
        np.testing.assert_array_equal(alone[0], observed[0])
        assert alone[1:4] == (rewards[0], False, step == 5) and alone[4]["error_mm"] == infos["error_mm"][0]
    with pytest.raises(RuntimeError, match="ended"):
        one.step(DOWN)
    np.testing.assert_array_equal(one.reset()[0], many.step(np.zeros((3, 3)))[0][0])
    assert one.action_space.shape == (3,) and one.observation_space.contains(one.reset()[0])


def test_who_climbs_finds(hidden):
    """A policy by hand: down to the skin, then towards the goal; all must be told that they found it, and nobody else."""
    env = make(hidden, 32, max_episode_steps=100)
    observed, _ = env.reset(seed=2)
    assert np.linalg.norm(env.task.goals[0, :2] - [15, -10]) < 6
    found, total = np.zeros(32, bool), np.zeros(32)
    for _ in range(90):
        action = (env.task.goals[0] - (observed[:, :3] * 40.0 + env.middles[:, 0])) / 2.0
        action[:, 2] = np.where(observed[:, 6] < 4.0, -0.5, 0.3)
        observed, rewards, terminated, _, infos = env.step(action)
        total += np.where(found, 0, rewards)
        found |= terminated
    assert found.all() and (total > 1.0).all(), "1 for the find, and what the skin became stiffer"
    still = make(hidden, 32, max_episode_steps=100)
    still.reset(seed=2)
    assert not any(still.step(np.zeros((32, 3)))[2].any() for _ in range(50)), "nobody finds by standing still"


def test_blocks_are_chosen_by_name_and_say_what_was_felt(hidden):
    names = ("force", "tip", "moment", "depth", "normal", "friction", "contact", "time")
    flat, apart = (make(hidden, 4, observe=names, as_dict=apart, goal_mm=0.01) for apart in (False, True))
    assert set(apart.single_observation_space.spaces) == set(names)
    flat.reset(seed=1), apart.reset(seed=1)
    for _ in range(8):
        action = np.tile([0.3, 0.0, -1.0], (4, 1))
        one, two = flat.step(action)[0], apart.step(action)[0]
    np.testing.assert_array_equal(one, np.concatenate([two[name] for name in names], axis=1))
    assert apart.observation_space.contains(two) and flat.observation_space.contains(one)
    felt, tips = apart.felt, apart.hands.tips[:, 0]
    assert (felt["depth"] > 1).all()
    np.testing.assert_allclose(two["force"], felt["force"][:, 0], rtol=1e-6)
    np.testing.assert_allclose(two["moment"], np.cross(felt["proxy"][:, 0] - tips, felt["force"][:, 0]), rtol=1e-4, atol=1e-6)
    pressing = (felt["force"] * felt["normal"])[:, 0].sum(axis=1)
    sideways = np.linalg.norm(felt["force"][:, 0] - pressing[:, None] * felt["normal"][:, 0], axis=1)
    np.testing.assert_allclose(two["friction"][:, 0], sideways / pressing, rtol=1e-5)
    assert (two["contact"].sum(axis=1) == 1).all() and (two["contact"].argmax(axis=1) == felt["state"][:, 0]).all()
    np.testing.assert_allclose(two["time"], 8 / 200)
    for wrong in ("forces", "pressure1", "pressure17", "pressure", "pressure-4", "pressure4x4", "place", "reading"):
        with pytest.raises(ValueError, match="observe"):
            make(hidden, 2, observe=("tip", wrong))
    for wrong in ("tip", (), ("tip", "tip")):
        with pytest.raises(ValueError, match="observe"):
            make(hidden, 2, observe=wrong)


def test_pressures_are_those_of_the_world(torso):
    env = VectorEnv(3, bodies=torso, reach_mm=20.0, observe=("pressure4", "force"), settings=palpate.FingerSettings(radius_mm=8))
    env.reset(seed=4)
    for _ in range(8):
        observed = env.step(np.tile(DOWN, (3, 1)))[0]
    np.testing.assert_allclose(observed[:, :16].sum(axis=1) * 0.016, np.linalg.norm(observed[:, 16:], axis=1), rtol=0.2)


def test_noise_is_of_the_device_and_rewards_are_of_the_truth(hidden):
    plain, noisy = (make(hidden, 400, goal_mm=0.01, **noise) for noise in ({}, {"force_noise": 0.03, "place_noise_mm": 1.0}))
    plain.reset(seed=1), noisy.reset(seed=1)
    for _ in range(9):
        true, rewards, *_ = plain.step(np.tile(DOWN, (400, 1)))
        said, same_rewards, *_ = noisy.step(np.tile(DOWN, (400, 1)))
        np.testing.assert_array_equal(rewards, same_rewards)
    np.testing.assert_array_equal(plain.felt["force"], noisy.felt["force"])
    assert abs((said[:, :3] - true[:, :3]).std() * 40.0 - 1.0) < 0.1
    gain = np.linalg.norm(said[:, 3:6], axis=1) / np.linalg.norm(true[:, 3:6], axis=1)
    assert abs(gain.std() - 0.03) < 0.004 and abs(gain.mean() - 1.0) < 0.005


def test_a_late_device_says_what_was(hidden):
    prompt, late = make(hidden, 3, max_episode_steps=8), make(hidden, 3, max_episode_steps=8, delay_steps=3)
    now, then = played(prompt, 20), played(late, 20)
    for step in range(20):
        since = step % 9  # eight steps, and the one that begins anew
        np.testing.assert_array_equal(then[step], now[step - min(3, since)])


def test_bodies_are_drawn_from_a_pool(hidden):
    vertices, faces = dome(40)
    soft, hard = (palpate.World.from_arrays(vertices, faces, stiffness=k) for k in (0.2, 1.0))
    env = make(Bodies([soft, hard]), 64, max_episode_steps=8, goal_mm=0.01)
    env.reset(seed=3)
    first = env.body.copy()
    for _ in range(8):
        observed = env.step(np.tile(DOWN, (64, 1)))[0]
    per_mm = np.linalg.norm(observed[:, 3:6], axis=1) / observed[:, 6]
    np.testing.assert_allclose(per_mm, np.where(first == 0, 0.2, 1.0), rtol=0.01)
    assert 16 < first.sum() < 48
    env.step(np.zeros((64, 3)))
    assert not np.array_equal(env.body, first), "the next episode draws again"


def test_bodies_may_differ_in_place_and_shape():
    """One dome lies 30 mm beside the other and is half as high: each has its own region."""
    vertices, faces = dome(20)
    worlds = [palpate.World.from_arrays((vertices * [1, 1, height] + [aside, 0, 0]), faces) for height, aside in ((1, 0), (0.5, 30))]
    env = make(Bodies(worlds), 16, reach_mm=15.0, goal_mm=0.01)
    observed, _ = env.reset(seed=1)
    assert set(env.body) == {0, 1} and env.observation_space.contains(observed)
    for body, world in enumerate(worlds):
        middle = world.place(PLACE)
        np.testing.assert_allclose(env.middles[env.body == body, 0], np.tile(middle, (sum(env.body == body), 1)))
        tips = env.hands.tips[env.body == body, 0]
        assert np.abs(tips - middle).max() <= 15.0
        np.testing.assert_allclose([np.linalg.norm(world.place(tip) - tip) for tip in tips], 10.0, atol=0.2)


def test_pressures_of_a_body_that_breathes_are_of_their_tick():
    world = palpate.World.parse('''
        body = { kind = "trunk", triangles = 20000 }
        breathing = { on = true }
        lump = [{ at = "T9 right 30 mm", depth_mm = 5, diameter_mm = 12, stiffness_ratio = 20 }]
        ''')  # where it lies under the finger depends on the breath
    env = VectorEnv(2, bodies=world, observe=("pressure4",), settings=palpate.FingerSettings(radius_mm=8), reach_mm=20.0)
    env.reset(seed=1)
    for _ in range(30):
        observed = env.step(np.tile(DOWN, (2, 1)))[0]
    kpa = [world.pressure(touch, 4, 16.0, tick=10 * 31 - 1).ravel() for touch in env.hands.fingers.touches()]
    np.testing.assert_array_equal(observed, np.array(kpa, np.float32))
    assert observed.max() > 1.0


def test_a_scene_with_ranges_is_a_pool():
    scene = '[body]\nkind = "torso"\ntriangles = 5000\n[stiffness]\nsource = "constant"\nconstant_n_per_mm = {k}\n'
    bodies = Bodies.drawn(scene, {"k": (0.2, 0.9)}, pool=3, seed=1)
    per_mm = [world.stiffness.mean() for world in bodies.worlds]
    assert len(set(per_mm)) == 3 and all(0.2 <= one <= 0.9 for one in per_mm)
    again = Bodies.drawn(scene, {"k": (0.2, 0.9)}, pool=2, seed=1)
    assert [world.stiffness.mean() for world in again.worlds] == per_mm[:2]
    with pytest.raises(ValueError, match="bodies"):
        Bodies([])


def test_the_chart_lies_on_the_skin(torso):
    region = Region([torso], "T9 right 30 mm", 40.0)
    places = np.random.default_rng(1).uniform(-1, 1, (200, 2))
    points, normals = region.at(np.zeros(200, int), places)
    away = [np.linalg.norm(torso.place(point) - point) for point in points]
    assert max(away) < 0.3 and np.mean(away) < 0.03
    np.testing.assert_allclose(region.coordinates(np.zeros(200, int), points), places, atol=0.01)
    other = region.mirrored().at(np.zeros(200, int), places)[0]
    np.testing.assert_allclose(other, points * [-1, 1, 1], atol=6.0)  # the torso is nearly as symmetric
    assert max(np.linalg.norm(torso.place(point) - point) for point in other) < 0.3


def test_episodes_are_recordings_that_replay_to_the_bit(torso, tmp_path):
    env = VectorEnv(3, bodies=torso, max_episode_steps=6, record=tmp_path, record_envs=(1,), settings=palpate.FingerSettings(radius_mm=8))
    env.reset(seed=8)
    forces = []
    for _ in range(9):
        env.step(np.tile([0.2, 0.1, -1.0], (3, 1)))
        forces.append(env.felt["force"][1, 0].copy())
    env.close()
    files = sorted(tmp_path.iterdir())
    assert [file.name for file in files] == ["FindStiffest-00001-000001.session", "FindStiffest-00001-000002.session"]
    with palpate.Session(files[0]) as run:
        notes = json.loads(run.header["notes"])
        assert (notes["seed"], notes["stream"], notes["episode"], notes["steps"]) == ("8", 1, 1, 6)
        recorded = run.samples(["force"])["force"]
        assert len(recorded) == 70, "ten ticks at the beginning, and of each step"
        np.testing.assert_array_equal(recorded[19::10], forces[:6])
        assert run.replay().identical
    with palpate.Session(files[1]) as run:
        np.testing.assert_array_equal(run.samples(["force"])["force"][9::10], forces[6:])


def test_arrays_go_to_torch_and_jax_without_a_copy(hidden):
    observed, _ = make(hidden, 4).reset(seed=1)
    taken = np.from_dlpack(observed)
    assert np.shares_memory(taken, observed) and observed.flags.c_contiguous


def test_a_picture_of_each(torso):
    env = VectorEnv(2, bodies=torso, render_mode="rgb_array", render_size=(64, 48))
    env.reset(seed=1)
    try:
        pictures = env.render()
    except ImportError:
        pytest.skip("palpate.view is not built")
    assert len(pictures) == 2 and pictures[0].shape == (48, 64, 3) and pictures[0].std() > 5
    assert VectorEnv(1, bodies=torso).render() is None


def test_a_head_is_drawn_as_the_spheres_that_it_is_made_of(torso):
    view = pytest.importorskip("palpate.view")
    env = VectorEnv(1, task="ScanWithProbe", bodies=torso, render_mode="rgb_array", render_size=(64, 48))
    env.reset(seed=1)
    camera = view.Camera(look_at=env.region.middle[0], zoom=4)
    spheres = view.render(torso, None, env.hands.fingers.touches(), size=(64, 48), supersampling=1, labels=False, camera=camera,
                          finger="ball", radius_mm=3.0)
    np.testing.assert_array_equal(env.render()[0], spheres)


def test_a_task_of_ones_own(hidden):
    class Press(Task):
        draws = 1

        def begin(self, which, draws):
            self.wanted = draws[:, 0] + 4.0

        def judge(self):
            depth = self.env.felt["depth"][:, 0]
            return self.env.felt["force"][:, 0, 2].copy(), depth > self.wanted, {"success": depth > self.wanted}

    env = make(hidden, 4, task=Press())
    env.reset(seed=1)
    assert (4.0 <= env.task.wanted).all() and len(set(env.task.wanted)) == 4
    assert any(env.step(np.tile(DOWN, (4, 1)))[2].all() for _ in range(14))


def test_nonsense_is_refused(hidden):
    env = make(hidden, 2)
    with pytest.raises(RuntimeError, match="reset"):
        env.step(np.zeros((2, 3)))
    env.reset()
    for wrong in (np.zeros((3, 3)), np.zeros(6), np.full((2, 3), np.nan)):
        with pytest.raises(ValueError, match="actions"):
            env.step(wrong)
    for wrong in ({"substeps": 0}, {"max_episode_steps": 0}, {"reach_mm": 0}, {"delay_steps": -1}, {"force_noise": np.nan},
                  {"render_mode": "human"}, {"autoreset_mode": "next_step"}, {"task": "FindNothing"}, {"record_envs": [2], "record": "."}):
        with pytest.raises(ValueError):
            make(hidden, 2, **wrong)
    with pytest.raises(TypeError, match="goal"):
        make(hidden, 2, goal=3)
    with pytest.raises(ValueError, match="no vertices"):
        VectorEnv(2, bodies=hidden, around=[1.0, 1.0, 20.0], reach_mm=0.01)
    with pytest.raises(palpate.Error):
        VectorEnv(2, bodies=hidden, around="T6")
