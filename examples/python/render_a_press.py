"""A finger presses the back, seen from the side and coloured by the strain of its skin -> render_a_press.png"""

# %% A fingertip of 8 mm sinks 10 mm into the skin beside T9 and drags it by 15 mm to the head. Its tip is the ball's middle.
import numpy as np

import palpate

body = palpate.World.trunk()
tips = body.tips("T9 right 30 mm", np.linspace(-10.0, 2.0, 900))
finger = palpate.Finger(body, palpate.FingerSettings(radius_mm=8.0))
for tip in [*tips, *(tips[-1] + np.linspace([0, 0, 0], [0, 15, 0], 500))]:
    touch = finger.step(tip)
skin = palpate.Skin(body, strain=True)
skin.apply(touch)

# %% No window and no display are needed.
camera = palpate.view.Camera(side="back", pitch_deg=-20, yaw_deg=-30, zoom=4, look_at="T9 right 30 mm")
picture = palpate.view.render(body, skin, touch, camera=camera, colours="strain", show="contact", radius_mm=8.0)
palpate.view.save("render_a_press.png", picture)
