"""Pictures: they show the body, are those of `palpate render`, and survive threads, forks and interrupts in words."""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import palpate
from palpate.view import Camera, render, save

SCENE = '[body]\nkind = "torso"\n'


@pytest.fixture(scope="module")
def pressed(torso):
    finger = palpate.Finger(torso)
    for tip in torso.tips("T6 right 30 mm", np.linspace(-2.0, 8.0, 500)):
        touch = finger.step(tip)
    skin = palpate.Skin(torso, strain=True)
    skin.apply(touch)
    return skin, touch


def test_the_picture_shows_a_body_and_the_finger_on_it(torso, pressed):
    skin, touch = pressed
    rest = render(torso, labels=False)
    assert rest.shape == (480, 640, 3) and rest.dtype == np.uint8
    middle = rest[180:300, 280:360].reshape(-1, 3).astype(int).mean(axis=0)
    corner = rest[:20, :20].reshape(-1, 3).astype(int).mean(axis=0)
    assert np.abs(middle - corner).max() > 40  # skin, not background
    assert middle[0] > middle[2]  # and of the colour of skin
    near = Camera(look_at="T6 right 30 mm", zoom=5)
    alone = render(torso, camera=near, labels=False)
    # A ball: the drawn finger reaches far beside the place.
    touched = render(torso, skin, touch, camera=near, finger="ball", labels=False)
    moved = np.abs(alone.astype(int) - touched).max(axis=2) > 24
    assert 0.005 < moved.mean() < 0.5
    rows, columns = np.nonzero(moved)
    assert abs(rows.mean() - 240) < 80 and abs(columns.mean() - 320) < 80  # where it was pressed


def test_it_is_the_picture_of_the_command(command, tmp_path):
    (tmp_path / "scene.toml").write_text(SCENE)
    run = [command, "render", "scene.toml", "--size", "320x240", "--look-at", "T6", "--zoom", "3", "--show", "stiffness,contact"]
    subprocess.run([*run, "-o", "theirs.png"], cwd=tmp_path, check=True, capture_output=True)
    world = palpate.World.parse(SCENE)
    ours = render(world, size=(320, 240), camera=Camera(look_at="T6", zoom=3), colours="stiffness", show="contact")
    save(tmp_path / "ours.png", ours)
    assert (tmp_path / "ours.png").read_bytes() == (tmp_path / "theirs.png").read_bytes()


def test_a_skin_that_is_none_is_as_the_touches_leave_it(torso, pressed):
    skin, touch = pressed
    near = Camera(look_at="T6 right 30 mm", zoom=5)
    np.testing.assert_array_equal(render(torso, None, touch, camera=near), render(torso, skin, touch, camera=near))


def test_strain_bones_and_overlays_change_the_picture(torso, pressed):
    skin, touch = pressed
    near = Camera(look_at="T6 right 30 mm", zoom=4)
    plain = render(torso, skin, touch, camera=near, labels=False, size=(320, 240)).astype(int)
    seen = {
        "strain": render(torso, skin, touch, camera=near, labels=False, size=(320, 240), colours="strain"),
        "bones": render(torso, skin, touch, camera=near, labels=False, size=(320, 240), bones=True),
        "names": render(torso, skin, touch, camera=near, labels=False, size=(320, 240), show=["names", "wireframe"]),
        "labels": render(torso, skin, touch, camera=near, size=(320, 240), title="T6"),
    }
    for name, picture in seen.items():
        assert (np.abs(plain - picture).max(axis=2) > 16).mean() > 0.003, name


def test_the_lens_stands_in_a_corner_of_a_picture_that_has_room_for_it(torso, pressed):
    skin, touch = pressed
    near = Camera(look_at="T6 right 30 mm", zoom=4)
    without, large = (render(torso, skin, touch, camera=near, labels=False, size=(800, 600), lens=lens).astype(int)
                      for lens in (False, True))
    assert (np.abs(without - large).max(axis=2) > 16).mean() > 0.003


def test_pictures_may_be_asked_for_from_any_thread_and_are_the_same(torso, dome_world):
    wanted = {id(world): render(world, size=(160, 120)) for world in (torso, dome_world)}
    wrong = []

    def draw(world):
        for _ in range(5):
            if not np.array_equal(render(world, size=(160, 120)), wanted[id(world)]):
                wrong.append(world)

    threads = [threading.Thread(target=draw, args=(world,)) for world in (torso, dome_world) * 3]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_the_skin_may_change_while_it_is_drawn(torso):
    """Each picture is of the skin as it was, whole, however much another thread applies."""
    skin = palpate.Skin(torso)
    finger = palpate.Finger(torso)
    touches = [finger.step(tip) for tip in torso.tips("T6 right 30 mm", np.linspace(-2.0, 8.0, 300))]
    end = threading.Event()

    def press():
        while not end.is_set():
            for touch in touches[::10]:
                try:
                    skin.apply(touch)
                except RuntimeError as error:
                    assert "in use" in str(error)

    thread = threading.Thread(target=press)
    thread.start()
    for _ in range(10):
        try:
            assert render(torso, skin, size=(160, 120)).any()
        except RuntimeError as error:
            assert "in use" in str(error)
    end.set()
    thread.join()


def test_a_forked_process_is_told_and_a_fresh_one_draws(tmp_path):
    """The child of one that has drawn gets words; one that was forked before draws."""
    script = tmp_path / "forks.py"
    script.write_text(
        """
import os, palpate
world = palpate.World.parse('[body]\\nkind = "torso"\\n')
early = os.fork()
if early == 0:
    os._exit(0 if palpate.view.render(world, size=(64, 48)).any() else 3)
assert os.waitpid(early, 0)[1] == 0, "a child of a process that has not drawn"
palpate.view.render(world, size=(64, 48))
late = os.fork()
if late == 0:
    try:
        palpate.view.render(world, size=(64, 48))
    except RuntimeError as error:
        assert "spawn" in str(error), error
        import sys
        sys.exit(7)  # and its end ends
    os._exit(4)
assert os.waitstatus_to_exitcode(os.waitpid(late, 0)[1]) == 7
assert palpate.view.render(world, size=(64, 48)).any()
"""
    )
    subprocess.run([sys.executable, script], check=True, timeout=120, env=os.environ)


def test_ctrl_c_ends_the_wait_for_a_picture(torso):
    render(torso, size=(64, 48))
    threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            render(torso, size=(640, 480))
    assert time.monotonic() - begun < 20.0
    assert render(torso, size=(64, 48)).any()  # and the next one is drawn


def test_a_world_that_breathes_or_lacks_a_scalar_says_so(torso):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        render(torso, size=(64, 48))
    with pytest.warns(UserWarning):
        render(torso, size=(64, 48), stereo="quad-buffer")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"size": (0, 100)}, "width"),
        ({"size": (100, 99999)}, "height"),
        ({"supersampling": 9}, "supersampling"),
        ({"colours": "strian"}, "strain"),
        ({"show": ["nams"]}, "names"),
        ({"opacity": 2.0}, "opacity"),
        ({"camera": Camera(side="behind")}, "side"),
        ({"camera": Camera(look_at="T66")}, "did you mean .T6"),
        ({"camera": Camera(zoom=0.0)}, "zoom"),
    ],
)
def test_options_that_make_no_sense_are_named(torso, options, words):
    with pytest.raises(ValueError, match=words):
        render(torso, **options)


def test_a_skin_of_another_world_is_refused(torso, dome_world):
    with pytest.raises(ValueError, match="another world"):
        render(torso, palpate.Skin(dome_world))
    with pytest.raises(TypeError, match="skin"):
        render(torso, np.zeros(3))
    with pytest.raises(TypeError, match="touches"):
        render(torso, None, [1, 2, 3])


def test_saving_says_what_is_wrong(tmp_path):
    with pytest.raises(ValueError, match="uint8"):
        save(tmp_path / "a.png", np.zeros((4, 4, 3)))
    with pytest.raises(palpate.Error):
        save(pathlib.Path("/dev/null/at/all.png"), np.zeros((4, 4, 3), np.uint8))
