"""The first touch from Python: what touch.c does, the same bits."""
import numpy as np
import palpate

world = palpate.World.torso()
point, normal = world.place("T6 right 30 mm"), world.normal_at("T6 right 30 mm")
tick = np.arange(1000)
deep_mm = np.where(tick < 500, tick * 0.03125 - 8.0, 7.625)
tips = point + (8.0 - deep_mm)[:, None] * normal
tips[500:, 1] += 0.03125 * (tick[500:] - 500)
force = world.rollout(tips[None], settings=palpate.FingerSettings(radius_mm=8.0), fields=["force"])["force"][0]

hash_ = 14695981039346656037  # FNV-1a
for byte in force.astype("<f8").tobytes():
    hash_ = ((hash_ ^ byte) * 1099511628211) % 2**64
print(f"at most {max(force[:, 2].max(), 0.0):.2f} N; hash of 1000 forces {hash_:016x}")
