"""The tasks of palpate.gym: what they show, pay and end, played by simple policies and by ones that are wrong."""

from __future__ import annotations

import numpy as np
import pytest

import palpate
from conftest import dome
from palpate.gym import Bodies, Region, VectorEnv
from palpate.gym.hands import rotations

PLACE = [0.0, 0.0, 20.0]
SEARCH = {"around": "T9 right 30 mm", "reach_mm": 40.0}


@pytest.fixture(scope="module")
def soft() -> palpate.World:
    """A dome with one stiffness, 0.4 N/mm."""
    vertices, faces = dome(40)
    return palpate.World.from_arrays(vertices, faces, stiffness=0.4)


@pytest.fixture(scope="module")
def region(torso) -> Region:
    return Region([torso], SEARCH["around"], SEARCH["reach_mm"])


@pytest.fixture(scope="module")
def stiff(torso, region) -> Bodies:
    return Bodies.with_stiff_places(torso, region, pool=6, seed=3)


def followed(env: VectorEnv, gain: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Along the line, with the depth that the force asks for: rewards (steps, n), terminated and success of the last."""
    observed, _ = env.reset(seed=2)
    rewards = []
    for _ in range(env.options.max_episode_steps):
        goal = observed[:, 7:]
        action = goal[:, 1:] * env.region.reach_mm / env.options.max_step_mm
        lacking = goal[:, 0] - np.linalg.norm(observed[:, 3:6], axis=1)
        action[:, 2] = np.where(observed[:, 6] > 0, -gain * lacking / 0.4 / env.options.max_step_mm, -0.5)
        observed, reward, terminated, truncated, infos = env.step(action)
        rewards.append(reward)
        if terminated.any():
            break
    return np.array(rewards), terminated, infos["success"]


def test_follow_force_pays_who_follows(soft):
    env = VectorEnv(8, task="FollowForce", bodies=soft, around=PLACE, max_episode_steps=300)
    rewards, terminated, success = followed(env, 0.8)
    assert success.all() and not terminated.any() and ((rewards >= 0) & (rewards <= 1)).all()
    assert rewards[60:].mean() > 0.85
    _, _, success = followed(env, 0.02)
    assert not success.any(), "too slow to follow"
    env.reset(seed=2)
    idle = [env.step(np.zeros((8, 3))) for _ in range(300)]
    assert not any(step[1].any() or step[4]["success"].any() for step in idle), "in the air there is nothing to gain"


def test_follow_force_shows_the_force_and_the_line(soft):
    env = VectorEnv(64, task="FollowForce", bodies=soft, around=PLACE, observe=("goal", "tip"), force_n=(0.5, 4.0))
    observed, _ = env.reset(seed=5)
    forces, points = [], []
    for _ in range(200):
        forces.append(observed[:, 0])
        points.append((observed[:, 1:4] + observed[:, 4:7]) * 40.0)
        observed = env.step(np.zeros((64, 3)))[0]
    forces, points = np.array(forces), np.array(points)
    assert forces.min() >= 0.5 and forces.max() <= 4.0 and 1.2 < np.exp(np.log(forces).mean()) < 1.7
    assert (np.diff(forces, axis=0) != 0).sum(axis=0).max() == 5, "six forces"
    length = np.linalg.norm(points[-1] - points[0], axis=1)
    np.testing.assert_allclose(length, 30.0 * 199 / 200, rtol=0.03)
    assert np.abs(points).max() < 40.0


def test_follow_force_ends_where_it_hurts(soft):
    env = VectorEnv(2, task="FollowForce", bodies=soft, around=PLACE, limit_n=5.0)
    env.reset(seed=1)
    for _ in range(40):
        _, _, terminated, _, infos = env.step(np.tile([0.0, 0.0, -1.0], (2, 1)))
        if terminated.any():
            break
    assert terminated.all() and (env.felt["force"][:, 0, 2] > 5.0).all() and not infos["success"].any()
    for wrong in ({"force_n": (0, 1)}, {"force_n": (2, 1)}, {"limit_n": 3.0}, {"length_mm": -1}):
        with pytest.raises(ValueError, match="force_n"):
            VectorEnv(2, task="FollowForce", bodies=soft, around=PLACE, **wrong)


def grid(cells: int) -> np.ndarray:
    axis = np.linspace(-0.9, 0.9, cells)
    return np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)


def pressed(env: VectorEnv, places: np.ndarray) -> np.ndarray:
    """Readings (places, n, 2) of each environment, force and reference."""
    env.reset(seed=1)
    readings = []
    for place in places:
        action = np.zeros((env.num_envs, env.single_action_space.shape[0]))
        action[:, :2] = place
        if env.task.answers == 1:
            action[:, 2] = -1.0
        readings.append(env.step(action)[0][:, -2:])
    return np.array(readings)


def test_find_lump_who_compares_with_the_model_finds(stiff):
    env = VectorEnv(12, task="FindLump", bodies=stiff, max_episode_steps=400, **SEARCH)
    places = grid(17)
    readings = pressed(env, places)
    ratio = readings[..., 0] / readings[..., 1] - 1
    assert np.abs(np.median(ratio)) < 0.01 and (ratio.max(axis=0) > 0.2).all()
    believed = places[ratio.argmax(axis=0)]
    action = np.concatenate([believed, believed, np.ones((12, 1))], axis=1)
    unsure = env.step(action * [1, 1, 1, 1, 0.4])
    assert not unsure[2].any() and not unsure[4]["success"].any() and np.allclose(unsure[1], -0.01)
    _, rewards, terminated, _, infos = env.step(action)
    assert terminated.all()
    np.testing.assert_array_equal(infos["success"], infos["error_mm"] <= 5.0)
    np.testing.assert_allclose(rewards, np.where(infos["success"], 0.99, -1.01))
    assert infos["success"].mean() > 0.5 and (infos["error_mm"] < 9.0).all()
    _, rewards, terminated, _, infos = env.step(action)
    assert not rewards.any() and not terminated.any() and not infos["_success"].any(), "the next episode has begun"
    for away_mm in (4.9, 5.1):
        action[:, 2:4] = env.region.coordinates(env.body, env.bodies.hidden[env.body, 0]) + [away_mm / 40.0, 0.0]
        _, rewards, terminated, _, infos = env.step(action)
        np.testing.assert_allclose(infos["error_mm"], away_mm, atol=1e-9)
        np.testing.assert_allclose(rewards, 0.99 if away_mm < 5 else -1.01)
        env.step(action)


def test_a_press_is_that_of_a_finger_in_that_body_and_its_reference(torso, stiff):
    for reference in ("model", "other_side", "none"):
        env = VectorEnv(5, task="FindLump", bodies=stiff, reference=reference, **SEARCH)
        env.reset(seed=2)
        places = np.random.default_rng(3).uniform(-0.8, 0.8, (5, 2))
        for place in (-places, places):  # the second begins over the skin again
            observed, *_ = env.step(np.concatenate([place, np.zeros((5, 3))], axis=1))
        tip = palpate.FingerSettings(radius_mm=8)
        for number in range(5):
            world = stiff.worlds[env.body[number]]
            beside = {"model": stiff.all[-1], "other_side": world, "none": None}[reference]
            region = env.region.mirrored() if reference == "other_side" else env.region
            for body, where, column in ((world, env.region, 2), (beside, region, 3)):
                if body is None:
                    assert observed[number, column] == 0
                    continue
                (point,), (normal,) = where.at(np.array([env.body[number]]), places[number:number + 1])
                path = [point + 10 * normal] + [point + (10 - 8 * k / 50) * normal for k in range(1, 51)]
                force = body.rollout(np.array(path)[None], settings=tip, fields=["force"])["force"][0, -1] @ normal
                np.testing.assert_allclose(observed[number, column], force, rtol=1e-6)


def test_a_press_does_not_remember_the_last_one(soft):
    """Skin that relaxes has had the time to come back."""
    env = VectorEnv(1, task="FindLump", bodies=soft, around=PLACE, reference="none",
                    settings=palpate.FingerSettings(radius_mm=8, relaxation_share=0.5, relaxation_time_s=0.05))
    env.reset(seed=1)
    first, second = (env.step([[0.5, 0.1, 0, 0, 0]])[0] for _ in range(2))
    np.testing.assert_array_equal(first, second)
    assert first[0, 2] > 0.5


def test_pressures_of_a_press_on_a_body_that_breathes_are_of_its_last_tick():
    world = palpate.World.parse('''
        body = { kind = "trunk", triangles = 20000 }
        breathing = { on = true }
        lump = [{ at = "T9 right 30 mm", depth_mm = 5, diameter_mm = 12, stiffness_ratio = 20 }]
        ''')  # where it lies under the finger depends on the breath
    env = VectorEnv(2, bodies=world, task="FindLump", reference="none", observe=("pressure4",))
    env.reset(seed=1)
    for _ in range(30):
        observed = env.step(np.tile([0.1, 0.1, 0, 0, 0], (2, 1)))[0]
    kpa = [world.pressure(touch, 4, 16.0, tick=51 * 30 - 1).ravel() for touch in env.hands.fingers.touches()]
    np.testing.assert_array_equal(observed, np.array(kpa, np.float32))
    assert observed.max() > 1.0


def test_noise_and_bodies_without_anything(torso, region):
    bodies = Bodies.with_stiff_places(torso, region, pool=8, count=(0, 2), seed=1)
    assert set(bodies.counts) == {0, 1, 2}
    env = VectorEnv(40, task="FindLump", bodies=bodies, force_noise=0.03, place_noise_mm=1.0, **SEARCH)
    env.reset(seed=1)
    readings = np.array([env.step(np.zeros((40, 5)))[0] for _ in range(50)])
    np.testing.assert_allclose((readings[..., 2] / readings[..., 2].mean(axis=0)).std(), 0.03, rtol=0.1)
    assert not np.ptp(readings[..., 3], axis=0).any(), "a model has no noise"
    np.testing.assert_allclose(readings[..., :2].std(), 1.0 / 40.0, rtol=0.1)
    empty = bodies.counts[env.body] == 0
    _, rewards, terminated, _, infos = env.step(np.tile([0, 0, 0, 0, -1.0], (40, 1)))
    assert terminated.all() and (infos["success"] == empty).all() and np.isinf(infos["error_mm"][empty]).all()
    np.testing.assert_allclose(rewards, np.where(empty, 0.99, -1.01))


def test_count_lumps_pays_the_right_number(torso, region):
    bodies = Bodies.with_stiff_places(torso, region, pool=12, count=(0, 3), seed=2)
    env = VectorEnv(30, task="CountLumps", bodies=bodies, **SEARCH)
    env.reset(seed=1)
    counts = bodies.counts[env.body]
    assert set(counts) == {0, 1, 2, 3}
    on = env.step(np.tile([0.1, 0.1, -0.01], (30, 1)))
    assert not on[2].any() and np.allclose(on[1], -0.01) and not on[4]["success"].any()
    said = np.arange(30) % 4
    _, rewards, terminated, _, infos = env.step(np.concatenate([np.zeros((30, 2)), (said[:, None] + 0.5) / 4], axis=1))
    assert terminated.all() and (infos["success"] == (said == counts)).all()
    np.testing.assert_allclose(rewards, np.where(said == counts, 1.0, -np.abs(said - counts) / 3) - 0.01)
    assert pressed(env, grid(2)).shape == (4, 30, 2)


def test_bodies_of_a_pool_do_not_depend_on_its_size(torso, region):
    few, many = (Bodies.with_stiff_places(torso, region, pool=pool, count=(1, 3), seed=4) for pool in (3, 7))
    np.testing.assert_array_equal(few.hidden[:3, :2], many.hidden[:3, :2])
    places = many.hidden[many.counts == 3]
    apart = [np.linalg.norm(one[i] - one[j]) for one in places for i in range(3) for j in range(i)]
    assert len(places) and min(apart) > 30.0 and np.abs(region.coordinates(np.zeros(len(places), int), places)).max() <= 0.91
    for number in range(3):
        np.testing.assert_array_equal(few.worlds[number].stiffness, many.worlds[number].stiffness)
    with pytest.raises(ValueError, match="no room"):
        Bodies.with_stiff_places(torso, region, pool=1, count=(30, 30))


def test_lumps_of_layered_tissue_are_hidden_too(torso, region):
    bodies = Bodies.with_lumps(torso, region, pool=2, count=(1, 2), seed=1)
    for world, hidden, count in zip(bodies.worlds, bodies.hidden, bodies.counts):
        assert len(world.lumps) == count
        for lump, place in zip(world.lumps, hidden):
            np.testing.assert_allclose(lump["foot"], place, atol=0.5)
    env = VectorEnv(2, task="FindLump", bodies=bodies, **SEARCH)
    env.reset(seed=1)
    at = env.region.coordinates(env.body, bodies.hidden[env.body, :1])[:, 0]
    observed = env.step(np.concatenate([at, np.zeros((2, 3))], axis=1))[0]
    assert (observed[:, 2] > 1.03 * observed[:, 3]).all()


def test_what_cannot_be_searched_is_refused(torso, region, soft):
    with pytest.raises(ValueError, match="reference"):
        VectorEnv(2, task="FindLump", bodies=torso, reference="healthy")
    with pytest.raises(ValueError, match="healthy ones"):
        VectorEnv(2, task="FindLump", bodies=torso)
    assert VectorEnv(2, task="FindLump", bodies=torso, reference="none")
    with pytest.raises(ValueError, match="goal_mm"):
        VectorEnv(2, task="FindLump", bodies=torso, goal_mm=0)
    with pytest.raises(ValueError, match="count"):
        VectorEnv(2, task="CountLumps", count=(3, 1))
    side = Region([palpate.World.from_arrays([[0, -1, -1], [0, 1, -1], [0, 0, 1]], [[0, 1, 2]], repair=False)], [0, 0, 0], 1.0)
    with pytest.raises(ValueError, match="face z"):
        Bodies.with_stiff_places(torso, side, pool=1)


def test_explore_two_hands_pays_for_new_cells(soft):
    env = VectorEnv(4, task="ExploreTwoHands", bodies=soft, around=PLACE, max_episode_steps=1000, apart_mm=5.0)
    observed, _ = env.reset(seed=3)
    assert env.single_action_space.shape == (6,) and env.single_observation_space.shape == (6 + 6 + 2 + 64,)
    rows = np.linspace(-35, 35, 8)
    # Each hand mows its half: down the first column, up the next, 5 mm under the top of the dome.
    left = np.array([[x, y] for k, x in enumerate(rows[:4]) for y in (rows if k % 2 else rows[::-1])])
    at, total, done = np.zeros((4, 2), int), np.zeros(4), np.zeros(4, bool)
    for _ in range(900):
        tips = env.hands.tips
        goal = np.stack([left[at[:, 0]], left[at[:, 1]] * [-1, 1]], axis=1)
        skin = 20 * (1 - (tips[..., :2] ** 2).sum(axis=2) / (2 * 100.0**2))
        way = np.concatenate([goal - tips[..., :2], (skin - 5.0 - tips[..., 2])[..., None]], axis=2)
        at += (np.abs(way) < 1.0).all(axis=2) & (at < len(left) - 1)
        _, rewards, terminated, _, infos = env.step((way / 2.0).reshape(4, 6))
        total += np.where(done, 0, rewards)
        np.testing.assert_allclose(total[~done], infos["share"][~done])
        done |= terminated
        assert (infos["success"] == terminated).all()
        if done.all():
            break
    assert done.all() and (total >= 0.9).all()


def test_explore_two_hands_costs_what_would_hurt_or_collide(soft):
    env = VectorEnv(2, task="ExploreTwoHands", bodies=soft, around=PLACE, limit_n=5.0)
    env.reset(seed=1)
    assert (env.hands.tips[:, 0, 0] < env.hands.tips[:, 1, 0]).all()
    env.hands.tips[0, 1] = env.hands.tips[0, 0] + [15.0, 0, 0]
    env.hands.tips[1, 1] = env.hands.tips[1, 0] + [17.0, 0, 0]
    np.testing.assert_allclose(env.step(np.zeros((2, 6)))[1], [-1 / 64, 0.0])
    down = np.tile([0, 0, -1.0, 0, 0, 0], (2, 1))
    for _ in range(30):
        _, rewards, terminated, _, infos = env.step(down)
        if terminated.any():
            break
    assert terminated.all() and (rewards == -1).all() and not infos["success"].any()
    with pytest.raises(ValueError, match="goal_share"):
        VectorEnv(2, task="ExploreTwoHands", bodies=soft, around=PLACE, goal_share=1.5)


def scanned(env: VectorEnv, tilt: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """With the force that is asked for along the line, giving way to moments where the head does not stay tilted: what
    was paid, which ended, which as a success."""
    observed, _ = env.reset(seed=2)
    env.hands.turned[:] = env.hands.turned @ rotations(np.array([[0.0, tilt, 0.0]]))
    total, done, success = np.zeros(4), np.zeros(4, bool), np.zeros(4, bool)
    for _ in range(1000):
        goal, force, moment = observed[:, -3:], observed[:, 12:15], observed[:, 15:18]
        turned = env.hands.turned
        pressing = np.einsum("ni,ni->n", force, turned[:, :, 2])
        action = np.zeros((4, 6))
        action[:, 0] = -goal[:, 1] * 60.0 / 0.5
        action[:, 1] = np.where(pressing > 0.7 * goal[:, 0], 0.3, 0.0)
        action[:, 2] = (pressing - goal[:, 0]) * 0.3
        if not tilt:
            action[:, 3:5] = 0.01 * np.einsum("nij,ni->nj", turned, moment)[:, :2]
        observed, rewards, terminated, _, infos = env.step(action)
        gained = np.maximum(goal[:, 2] - observed[:, -1], 0.0)
        assert (rewards <= gained * observed[:, -4] + 1e-6).all(), "the share of the way times that of the head on the skin"
        total += np.where(done, 0, rewards)
        success |= infos["success"] & ~done
        done |= terminated
        if done.all():
            break
    return total, done, success


def test_scan_with_probe_pays_the_way_at_the_force(torso):
    env = VectorEnv(4, task="ScanWithProbe", bodies=torso)
    assert env.single_action_space.shape == (6,) and env.single_observation_space.shape == (3 + 9 + 3 + 3 + 1 + 3,)
    total, done, success = scanned(env, 0.0)
    assert done.all() and success.all() and (total > 0.7).all() and (total <= 1).all()
    tilted, done, success = scanned(VectorEnv(4, task="ScanWithProbe", bodies=torso, force_n=(0.5, 1.0)), 0.7)
    assert done.all() and not success.any() and (0 < tilted).all() and (tilted < 0.7).all()


def test_scan_with_probe_pays_nothing_in_the_air_and_ends_where_it_hurts(torso):
    env = VectorEnv(2, task="ScanWithProbe", bodies=torso, observe=("turned", "touching", "goal"), limit_n=8.0)
    observed, _ = env.reset(seed=1)
    turned = observed[:, :9].reshape(2, 3, 3)
    np.testing.assert_allclose(turned @ turned.transpose(0, 2, 1), np.tile(np.eye(3), (2, 1, 1)), atol=1e-5)
    assert (turned[:, 2, 2] > 0.9).all() and (observed[:, 9] == 0).all()
    np.testing.assert_allclose(observed[:, -1], 1.0, atol=0.02)
    paid = sum(env.step(np.tile([0, 1.0, 0.3, 0, 0, 0], (2, 1)))[1] for _ in range(60))
    assert not paid.any()
    env.reset(seed=1)
    for _ in range(120):
        _, rewards, terminated, _, infos = env.step(np.tile([0, 0, -1.0, 0, 0, 0], (2, 1)))
        if terminated.any():
            break
    assert terminated.any() and (rewards[terminated] < -0.9).all() and not infos["success"].any()
    with pytest.raises(ValueError, match="force_n"):
        VectorEnv(1, task="ScanWithProbe", bodies=torso, force_n=(0, 3))
    with pytest.raises(ValueError, match="record"):
        VectorEnv(1, task="ScanWithProbe", bodies=torso, record="nowhere")
    for wrong in ("contact", "normal", "pressure4"):
        with pytest.raises(ValueError, match="observe"):
            VectorEnv(1, task="ScanWithProbe", bodies=torso, observe=(wrong,))
