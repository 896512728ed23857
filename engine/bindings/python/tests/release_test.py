"""What is checked before a release: the types of the whole package, by mypy, and a wheel."""

from __future__ import annotations

import os
import pathlib
import subprocess
import zipfile

import pytest

from conftest import SOURCE, STAGE, run


def mypy(*files: str, cwd: pathlib.Path) -> subprocess.CompletedProcess:
    environment = dict(os.environ, MYPYPATH=str(SOURCE / "engine/bindings/python"))
    return run("-m", "mypy", "--strict", "--config-file", str(SOURCE / "engine/bindings/python/tests/mypy.ini"), "--no-error-summary", "--cache-dir", str(STAGE / ".mypy_cache"), *files, cwd=cwd,
               env=environment)


def test_the_package_is_typed():
    result = mypy("-p", "palpate", cwd=SOURCE / "engine/bindings/python")
    assert result.returncode == 0, result.stdout
    assert (SOURCE / "engine/bindings/python/palpate/py.typed").exists()


RIGHT = """
import numpy as np
import palpate

world = palpate.World.from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], stiffness=np.ones(3), repair=False)
finger = palpate.Finger(world, palpate.FingerSettings(radius_mm=8))
touch = finger.step(world.place("T6")) if len(world.positions) else finger.step(0.0, 1.0, 2.0)
force: float = float(touch.force[2]) + touch.depth_mm
felt = world.rollout(np.zeros((1, 9, 3)), settings=[finger.settings], fields=("force",), threads=2)
skin = palpate.Skin(world, strain=False)
skin.apply([touch])
env = palpate.gym.VectorEnv(8, bodies=world, around="T6")
observations, infos = env.reset(seed=1)
try:
    palpate.World.load("back.toml")
except palpate.Error as error:
    print(error.file, error.line, error.cause.upper(), observations.shape, felt["force"].sum(), force)
"""
WRONG = {
    "finger.stepp([1, 2, 3])": '"Finger" has no attribute "stepp"',
    "palpate.FingerSettings(radius=8)": 'Unexpected keyword argument "radius"',
    "palpate.FingerSettings(8)": "Too many positional arguments",
    "world.rollout(None, threads='two')": 'Argument "threads" to "rollout" of "World" has incompatible type',
    "touch.force = 3": "is read-only",
    "palpate.World.torso().rebuilt(7)": 'Argument 1 to "rebuilt" of "World" has incompatible type',
    "skin.apply(3)": 'Argument 1 to "apply" of "Skin" has incompatible type',
}


def test_mypy_accepts_what_is_right_and_finds_what_is_wrong(tmp_path):
    (tmp_path / "right.py").write_text(RIGHT)
    result = mypy("right.py", cwd=tmp_path)
    assert result.returncode == 0, result.stdout
    first = RIGHT.count("\n") + 1
    (tmp_path / "wrong.py").write_text(RIGHT + "\n".join(WRONG) + "\n")
    result = mypy("wrong.py", cwd=tmp_path)
    assert result.returncode == 1
    for line, expected in enumerate(WRONG.values(), first):
        assert any(f"wrong.py:{line}:" in row and expected in row for row in result.stdout.splitlines()), result.stdout


def test_stubtest():
    allowlist = SOURCE / "engine/bindings/python/tests/stubtest_allowlist.txt"
    environment = dict(os.environ, MYPYPATH=str(STAGE))
    result = run("-m", "mypy.stubtest", "palpate._core", "--allowlist", str(allowlist), "--mypy-config-file", str(SOURCE / "engine/bindings/python/tests/mypy.ini"), env=environment,
                 cwd=STAGE)
    assert result.returncode == 0, result.stdout[-4000:]


def test_examples_are_typed():
    examples = sorted(str(file) for file in (SOURCE / "examples/python").glob("*.py"))
    if not examples:
        pytest.skip("there are no examples yet")
    result = mypy(*examples, cwd=SOURCE)
    assert result.returncode == 0, result.stdout


def test_a_wheel_holds_everything(tmp_path):
    """Made of what the build has staged; building one from nothing is in docs/reference/python.md."""
    environment = dict(os.environ, PALPATE_STAGED=str(STAGE))
    result = run("setup.py", "-q", "build", "-b", str(tmp_path / "build"), "egg_info", "-e", str(tmp_path), "bdist_wheel", "-d",
                 str(tmp_path), cwd=SOURCE / "engine/bindings/python", env=environment)
    if "invalid command 'bdist_wheel'" in result.stderr:
        pytest.skip("wheel is not installed")
    assert result.returncode == 0, result.stderr
    (wheel,) = tmp_path.glob("*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    staged = {str(file.relative_to(STAGE)) for file in (STAGE / "palpate").rglob("*") if file.suffix in (".py", ".pyi", ".so", ".typed")}
    assert {f"palpate/{name}" for name in ("__init__.py", "gym/__init__.py", "py.typed", "_core.pyi")} <= staged
    assert staged <= names, staged - names
    assert "none-any" not in wheel.name, "it holds compiled code"
    run("-m", "zipfile", "-e", str(wheel), str(tmp_path / "unpacked"), check=True)
    used = run("-c", "import palpate; print(palpate.__file__)", cwd=tmp_path / "unpacked", check=True,
               env={key: value for key, value in os.environ.items() if key != "PYTHONPATH"})
    assert used.stdout.startswith(str(tmp_path / "unpacked"))
