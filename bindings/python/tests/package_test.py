"""The package as such: what an import costs, that everything bound has text and type, and that stubs are checked."""

from __future__ import annotations

import importlib
import inspect
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest

import palpate
from conftest import SOURCE

STAGE = pathlib.Path(palpate.__file__).resolve().parents[1]
MODULES = [file.name.partition(".")[0] for file in sorted((STAGE / "palpate").glob("_*.so"))]


def run(*arguments: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, *arguments], capture_output=True, text=True, **options)


def test_import_is_cheap_and_brings_nothing():
    text = "import sys; before = set(sys.modules); import palpate; print(*(set(sys.modules) - before))"
    brought = set(run("-c", text, check=True).stdout.split())
    heavy = {"numpy", "matplotlib", "gymnasium", "palpate.env", "palpate.view", "palpate.measure", "palpate._view", "palpate._measure"}
    assert "palpate._core" in brought and not heavy & brought


def test_import_loads_no_library_for_foreign_meshes():
    maps = run("-c", "import palpate; print(open('/proc/self/maps').read())", check=True).stdout
    assert "/_core." in maps and "assimp" not in maps and "draco" not in maps


def test_a_world_can_be_made_without_numpy():
    text = ("import sys, palpate; w = palpate.World.torso(triangles=8000); f = palpate.Finger(w); t = f.lift(); "
            "print('numpy' in sys.modules, w.words is None)")
    assert run("-c", text, check=True).stdout.split()[0] == "False"


@pytest.mark.skipif(not os.environ.get("PALPATE_HEAVY"), reason="judges by the clock; set PALPATE_HEAVY=1")
def test_import_time():
    """Twice what it should take, for a loaded machine; tools/bench-python measures it."""
    text = "import time; a = time.perf_counter(); import palpate; print((time.perf_counter() - a) * 1000)"
    assert min(float(run("-c", text, check=True).stdout) for _ in range(7)) <= 40.0


def test_submodules_are_found_by_their_name():
    assert "env" in dir(palpate) and palpate.env.VectorEnv
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        palpate.nothing


def bound_names():
    for name in MODULES:
        module = importlib.import_module("palpate." + name)
        yield f"{name}", module
        for member, value in vars(module).items():
            if member.startswith("__"):
                continue
            yield f"{name}.{member}", value
            if not inspect.isclass(value):
                continue
            for inner, bound in vars(value).items():
                if inner in ("__module__", "__doc__", "__new__") or inner.startswith("_pybind11"):
                    continue
                if callable(bound) or isinstance(bound, property):
                    yield f"{name}.{member}.{inner}", bound.__func__ if isinstance(bound, staticmethod) else bound


def text_of(value) -> str:
    """What it says besides the signature."""
    doc = inspect.getdoc(value) or ""
    if "Overloaded function." in doc:
        parts = re.split(r"^\d+\. ", doc, flags=re.M)[1:]
        return min((part.partition("\n")[2].strip() for part in parts), key=len)
    return doc.partition("\n")[2] if re.match(r"\w+\(", doc) else doc


# Those of an enumeration, and what needs no words.
USUAL = ("__repr__", "__int__", "__index__", "__setstate__", "__getstate__", "__ne__", "__str__")


def test_every_bound_name_has_text_and_type():
    names = list(bound_names())
    assert len(names) > 90
    silent, untyped = [], []
    for name, value in names:
        if name.rpartition(".")[2] in USUAL or (name.endswith("__init__") and "->" not in (value.__doc__ or "")):
            continue
        if not text_of(value).strip():
            silent.append(name)
        signature = (inspect.getdoc(value.fget if isinstance(value, property) else value) or "").partition("\n")[0]
        if re.search(r"(?<![\w.])(handle|array|buffer|py::\w+|[\w:]+::\w+)(?![\w\[.])", signature):
            untyped.append(f"{name}: {signature}")
    assert not silent
    assert not untyped, "names of C++ in a signature: its type was bound later than the name"


def test_python_files_have_text():
    for file in sorted((STAGE / "palpate").glob("*.py")):
        if file.name == "__init__.py" or file.name.startswith("_"):
            continue
        module = importlib.import_module("palpate." + file.stem)
        for name, value in vars(module).items():
            if name.startswith("_") or getattr(value, "__module__", None) != module.__name__:
                continue
            assert inspect.getdoc(value), f"{file.name}: {name}"
            if inspect.isclass(value):
                for inner, bound in vars(value).items():
                    if inspect.isfunction(bound) and not inner.startswith("_"):
                        assert inspect.getdoc(bound), f"{file.name}: {name}.{inner}"


def test_stubs_are_those_of_the_docstrings():
    result = run(str(SOURCE / "tools/python-stubs"), "--check", "--stage", str(STAGE))
    assert result.returncode == 0, result.stderr


def mypy(*files: str, cwd: pathlib.Path) -> subprocess.CompletedProcess:
    environment = dict(os.environ, MYPYPATH=str(SOURCE / "bindings/python"))
    return run("-m", "mypy", "--strict", "--config-file", str(SOURCE / "bindings/python/tests/mypy.ini"), "--no-error-summary", "--cache-dir", str(STAGE / ".mypy_cache"), *files, cwd=cwd,
               env=environment)


def test_the_package_is_typed():
    result = mypy("-p", "palpate", cwd=SOURCE / "bindings/python")
    assert result.returncode == 0, result.stdout
    assert (SOURCE / "bindings/python/palpate/py.typed").exists()


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
env = palpate.env.VectorEnv(world, 8, around="T6")
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
    allowlist = SOURCE / "bindings/python/tests/stubtest_allowlist.txt"
    environment = dict(os.environ, MYPYPATH=str(STAGE))
    result = run("-m", "mypy.stubtest", "palpate._core", "--allowlist", str(allowlist), "--mypy-config-file", str(SOURCE / "bindings/python/tests/mypy.ini"), env=environment,
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
                 str(tmp_path), cwd=SOURCE / "bindings/python", env=environment)
    if "invalid command 'bdist_wheel'" in result.stderr:
        pytest.skip("wheel is not installed")
    assert result.returncode == 0, result.stderr
    (wheel,) = tmp_path.glob("*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    staged = {f"palpate/{file.name}" for file in (STAGE / "palpate").iterdir() if file.suffix in (".py", ".pyi", ".so", ".typed")}
    assert {f"palpate/{name}" for name in ("__init__.py", "env.py", "py.typed", "_core.pyi")} <= staged
    assert staged <= names, staged - names
    assert "none-any" not in wheel.name, "it holds compiled code"
    run("-m", "zipfile", "-e", str(wheel), str(tmp_path / "unpacked"), check=True)
    used = run("-c", "import palpate; print(palpate.__file__)", cwd=tmp_path / "unpacked", check=True,
               env={key: value for key, value in os.environ.items() if key != "PYTHONPATH"})
    assert used.stdout.startswith(str(tmp_path / "unpacked"))
