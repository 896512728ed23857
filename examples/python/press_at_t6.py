"""Loads a scan and presses it at T6: python press_at_t6.py [SCAN.obj] -> press_at_t6.png"""

# %% A scan: a mesh of your own, or the back that is built in, written as an OBJ file.
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import palpate

back = palpate.World.torso()
if len(sys.argv) < 2:
    rows = [f"v {x} {y} {z}" for x, y, z in back.positions] + [f"f {a} {b} {c}" for a, b, c in back.triangles + 1]
    Path("scan.obj").write_text("\n".join(rows))
scan = palpate.World.from_file(sys.argv[1] if len(sys.argv) > 1 else "scan.obj", stiffness=0.5)

# %% T6 has no name on a scan: its place, in mm, is where the built-in back has it. From 2 mm over the skin to 12 mm under.
depth = np.linspace(-2.0, 12.0, 1400)
felt = scan.rollout(scan.tips(back.place("T6"), depth)[None])  # one finger, 1400 ticks

# %%
plt.plot(depth, np.linalg.norm(felt["force"][0], axis=1))
plt.xlabel("depth (mm)")
plt.ylabel("force (N)")
plt.title("pressed at T6")
plt.savefig("press_at_t6.png")
