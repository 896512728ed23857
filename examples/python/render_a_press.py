"""A finger presses the back, seen from the side and coloured by the strain of its skin -> render_a_press.png"""

# %% Press 9 mm beside T9 and drag by 15 mm to the head; the skin follows.
import numpy as np

import palpate

body = palpate.World.trunk()
tips = body.tips("T9 right 30 mm", np.linspace(-2.0, 9.0, 1100))
finger = palpate.Finger(body, palpate.FingerSettings(radius_mm=8.0, tick_s=0.001))
for tip in [*tips, *(tips[-1] + np.linspace([0, 0, 0], [0, 15, 0], 500))]:
    touch = finger.step(tip)
skin = palpate.Skin(body, strain=True)
skin.apply(touch)

# %% No window and no display are needed.
camera = palpate.view.Camera(side="back", pitch_deg=-25, yaw_deg=20, zoom=3.5, look_at="T9 right 30 mm")
picture = palpate.view.render(body, skin, touch, camera=camera, colours="strain", show="contact", radius_mm=8.0)
palpate.view.save("render_a_press.png", picture)
