"""How force grows with depth at three places of the trunk, whose tissue is layered -> force_curve.png"""

# %% Places by the names that examiners use; one finger each, from 2 mm over the skin to 10 mm under it.
import matplotlib.pyplot as plt
import numpy as np

import palpate

body = palpate.World.trunk()
places = ["T6", "T6 right 35 mm", "left PSIS"]
depth = np.linspace(-2.0, 10.0, 1200)

# %%
felt = body.rollout(np.stack([body.tips(place, depth) for place in places]), fields=("force", "tissue"))
for place, force, tissue in zip(places, felt["force"], felt["tissue"]):
    plt.plot(depth, np.linalg.norm(force, axis=1), label=f"{place}: {tissue.max():.0f} mm over the bone")
plt.xlabel("depth (mm)")
plt.ylabel("force (N)")
plt.legend()
plt.savefig("force_curve.png")
