"""A thousand presses find the map of stiffness, dysfunction and all -> map_by_thousand_palpations.png"""

# %% A back with a stiff place that nobody sees, and a thousand places on it.
import matplotlib.pyplot as plt
import numpy as np

import palpate

body = palpate.World.parse("""
[body]
kind = "torso"
[[dysfunction]]
at = "T9 right 32 mm"
radius_mm = 25
change_percent = 60
""")
x, y, _ = body.positions.T
inner = np.flatnonzero((abs(x) < 120) & (y > -250) & (y < 160))  # the sheet ends beyond
chosen = np.random.default_rng(1).choice(inner, 1000, replace=False)
places, up = body.positions[chosen], body.normals[chosen]

# %% Each is pressed 8 mm deep, straight in, in half a second; force over depth there is what the map means.
depth = np.linspace(-1.0, 8.0, 500)
felt = body.rollout(places[:, None] - depth[:, None] * up[:, None], fields=("force", "depth"))
stiffness = np.linalg.norm(felt["force"][:, -1], axis=1) / felt["depth"][:, -1]

# %%
r = np.corrcoef(stiffness, body.stiffness[chosen])[0, 1]
print(f"1,000 palpations, r = {r:.4f}")
plt.scatter(places[:, 0], places[:, 1], c=stiffness, s=12)
plt.colorbar(label="stiffness (N/mm)")
plt.axis("equal")
plt.title(f"found by 1,000 palpations, r = {r:.4f}")
plt.savefig("map_by_thousand_palpations.png")
