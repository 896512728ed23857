"""A finger learns to search for a stiff place by feeling alone: cross-entropy method, numpy -> train_a_search_policy.png"""

# %% Two backs with a stiff place: one to learn on, one to be tested on, elsewhere.
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray

import palpate
from palpate.gym import VectorEnv

Numbers = NDArray[np.float64]
NAMES = ["depth (mm)", "speed", "turn when it gets softer (rad)", "memory", "wander (rad)"]
LOW, HIGH = np.array([0.5, 0.1, 0.0, 0.0, 0.0]), np.array([6.0, 1.0, 3.1, 0.98, 1.5])


def searched_back(place: str, num_envs: int) -> VectorEnv:
    world = palpate.World.parse(f"""
        [body]
        kind = "torso"
        [stiffness]
        source = "constant"
        [[dysfunction]]
        at = "{place}"
        radius_mm = 60
        change_percent = 150
        edge_softness = 1
        """)
    middle = world.place(place) + [18.0, -22.0, 0.0]  # the search does not begin where the stiff place is
    return VectorEnv(num_envs, bodies=world, around=middle, reach_mm=45.0, max_episode_steps=150)


# %% Five numbers a finger: press, go on while it gets stiffer, turn when it gets softer. No finger knows where it is.
def share_found(env: VectorEnv, policy: Numbers, seed: int) -> Numbers:
    """For each row of the policy (n, 5), one a finger: 1 where an episode found the place, a little more when early."""
    depth_mm, speed, turn, memory, wander = policy.T
    random = np.random.default_rng(seed)
    heading, before = random.uniform(0.0, 2 * np.pi, env.num_envs), np.zeros(env.num_envs)
    felt, _ = env.reset(seed=seed)
    score = np.zeros(env.num_envs)
    for step in range(env.options.max_episode_steps):
        touched = felt[:, 6] > 0.2
        stiff = np.where(touched, np.linalg.norm(felt[:, 3:6], axis=1) / np.maximum(felt[:, 6], 0.2), before)
        heading += np.where(stiff < before, turn, 0.0) + wander * random.standard_normal(env.num_envs)
        before = memory * before + (1 - memory) * stiff
        way = [speed * np.cos(heading), speed * np.sin(heading), np.clip(felt[:, 6] - depth_mm, -1.0, 1.0)]
        felt, _, found, _, _ = env.step(np.stack(way, axis=1))
        score[found & (score == 0.0)] = 1.0 + 0.2 * (1 - step / env.options.max_episode_steps)
    return score


# %% Cross-entropy: draw policies, keep the best fifth, draw around them.
POLICIES, EPISODES = 40, 16
training = searched_back("T9 right 32 mm", POLICIES * EPISODES)
random, mean, spread = np.random.default_rng(5), (LOW + HIGH) / 2, (HIGH - LOW) / 3
curve = []
for generation in range(12):
    policies = np.clip(mean + spread * random.standard_normal((POLICIES, 5)), LOW, HIGH)
    scores = share_found(training, np.repeat(policies, EPISODES, axis=0), generation).reshape(POLICIES, EPISODES)
    best = policies[np.argsort(scores.mean(axis=1))[-POLICIES // 5 :]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.01 * (HIGH - LOW)
    curve.append(100 * (scores > 0).mean())

# %% On a back that it has never felt, beside a hand that moves as it does but does not mind what it feels.
test = searched_back("T5 left 32 mm", 1000)
blind = mean.copy()
blind[2] = 0.0
trained, chance = (100 * (share_found(test, np.tile(policy, (1000, 1)), 99) > 0).mean() for policy in (mean, blind))
print(", ".join(f"{name} {value:.2f}" for name, value in zip(NAMES, mean)))
print(f"found in {test.options.max_episode_steps} steps: chance {chance:.0f} %, trained {trained:.0f} %")
plt.plot(curve, label="while learning")
plt.axhline(trained, color="k", ls="--", label="trained, on another back")
plt.axhline(chance, color="r", ls=":", label="moving without minding the force")
plt.xlabel("generation")
plt.ylabel("found the stiff place (%)")
plt.legend()
plt.savefig("train_a_search_policy.png")
