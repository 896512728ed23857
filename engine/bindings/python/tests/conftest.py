"""What the tests of the Python package share: bodies that are built once, and paths over them."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import palpate

SOURCE = pathlib.Path(__file__).resolve().parents[4]
STAGE = pathlib.Path(palpate.__file__).resolve().parents[1]
EXAMPLES = [file.stem for file in sorted((SOURCE / "examples" / "python").glob("*.py"))]


def run(*arguments: str, **options) -> subprocess.CompletedProcess:
    """Runs this interpreter with these arguments."""
    return subprocess.run([sys.executable, *arguments], capture_output=True, text=True, **options)


def dome(cells: int = 40, half_mm: float = 100.0, height_mm: float = 20.0) -> tuple[np.ndarray, np.ndarray]:
    """An open dome over the plane z = 0: vertices (V, 3) and faces (F, 3), outside up."""
    axis = np.linspace(-half_mm, half_mm, cells + 1)
    x, y = np.meshgrid(axis, axis)
    z = height_mm * (1 - (x**2 + y**2) / (2 * half_mm**2))
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    lower = np.stack([corner, corner + 1, corner + cells + 2], axis=1)
    upper = np.stack([corner, corner + cells + 2, corner + cells + 1], axis=1)
    return vertices, np.concatenate([lower, upper])


def wander(fingers: int, ticks: int, seed: int = 1, half_mm: float = 60.0) -> np.ndarray:
    """Paths (fingers, ticks, 3) that press, drag and lift over the dome."""
    random = np.random.default_rng(seed)
    time = np.linspace(0, 1, ticks)
    start = random.uniform(-half_mm, half_mm, (fingers, 1, 2))
    way = random.uniform(-20, 20, (fingers, 1, 2))
    depth = random.uniform(4, 10, (fingers, 1)) * np.sin(np.pi * time) ** 0.5 - 1
    xy = start + way * time[None, :, None]
    z = 20 * (1 - (xy**2).sum(axis=2) / (2 * 100.0**2)) - depth
    return np.concatenate([xy, z[..., None]], axis=2)


def landed(world: palpate.World, settings: palpate.FingerSettings | None = None) -> palpate.Finger:
    """A finger that has been over the dome: what it crosses from now on, it crosses from outside."""
    finger = palpate.Finger(world, settings)
    finger.step(0.0, 0.0, 60.0)
    return finger


@pytest.fixture(scope="session")
def torso() -> palpate.World:
    return palpate.World.torso()


@pytest.fixture(scope="session")
def dome_world() -> palpate.World:
    vertices, faces = dome()
    return palpate.World.from_arrays(vertices, faces)


@pytest.fixture(scope="session")
def command() -> str:
    """The built command `palpate`."""
    file = os.environ.get("PALPATE_COMMAND", "")
    if not pathlib.Path(file).is_file():
        pytest.skip("the command palpate is not built")
    return file


@pytest.fixture(scope="session")
def run_example(tmp_path_factory):
    """Runs an example in a folder of its own and returns what it printed and its picture; each runs once."""
    answers: dict[str, tuple[str, bytes]] = {}

    def run(name: str) -> tuple[str, bytes]:
        if name not in answers:
            folder = tmp_path_factory.mktemp(name)
            environment = {**os.environ, "MPLBACKEND": "Agg"}
            script = SOURCE / "examples" / "python" / f"{name}.py"
            done = subprocess.run([sys.executable, script], cwd=folder, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
            answers[name] = done.stdout, (folder / f"{name}.png").read_bytes()
        return answers[name]

    return run


def expect_picture(run, name: str) -> str:
    """Expects that an example makes a picture and has its cells; returns its text."""
    _, picture = run(name)
    assert picture[:8] == b"\x89PNG\r\n\x1a\n" and len(picture) > 5000
    text = (SOURCE / "examples" / "python" / f"{name}.py").read_text()
    assert text.count("# %%") >= 2
    return text
