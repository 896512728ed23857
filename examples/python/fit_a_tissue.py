"""From a measured curve to a tissue that can be felt -> fit_a_tissue.png"""

# %% A noisy press of an unknown phantom: F = 0.8 N/mm 8 mm (depth / 8 mm)^1.63, 4 % noise.
import matplotlib.pyplot as plt
import numpy as np

import palpate

depth = np.linspace(0.2, 10.0, 60)
measured = 0.8 * 8.0 * (depth / 8.0) ** 1.63 * (1.0 + 0.04 * np.random.default_rng(6).standard_normal(60))

# %% Which law, how stiff, how sure.
fits = palpate.fit.force(depth, measured)
best = next(fit for fit in fits if fit.form == "power")
print(f"k = {best.secant.value:.3f} N/mm, exponent = {best.numbers['exponent'].value:.3f}")

# %% The same law under a finger: pressed on a body, it gives the measured forces back.
body = palpate.World.torso().rebuilt(f"""
[body]
kind = "torso"
[tissue]
force_law = "power"
exponent = {best.numbers["exponent"].value}
[stiffness]
source = "constant"
constant_n_per_mm = {best.secant.value}
""")
way = body.tips("T6 right 40 mm", [-1.0, *depth])  # a finger comes from outside
felt = np.linalg.norm(body.rollout(way[None])["force"][0, 1:], axis=1)
print(f"felt and fitted differ by {np.abs(felt - best.force(depth)).max():.4f} N at most")
plt.plot(depth, measured, ".", label="measured")
for fit in fits:
    plt.plot(depth, fit.force(depth), label=f"{fit.form}, unseen rows missed by {100 * fit.unseen_rms:.1f} %")
plt.plot(depth, felt, "k--", label="felt on the body")
plt.xlabel("depth (mm)")
plt.ylabel("force (N)")
plt.legend()
plt.savefig("fit_a_tissue.png")
