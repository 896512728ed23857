"""The package as such: what an import costs, that everything bound has text and type, and that its stubs say so."""

from __future__ import annotations

import importlib
import inspect
import os
import re

import pytest

import palpate
from conftest import SOURCE, STAGE, run

MODULES = [file.name.partition(".")[0] for file in sorted((STAGE / "palpate").glob("_*.so"))]


def test_import_is_cheap_and_brings_nothing():
    text = "import sys; before = set(sys.modules); import palpate; print(*(set(sys.modules) - before))"
    brought = set(run("-c", text, check=True).stdout.split())
    heavy = {"numpy", "matplotlib", "gymnasium", "palpate.env", "palpate.gym", "palpate.view", "palpate.measure", "palpate._view", "palpate._measure"}
    assert "palpate._core" in brought and not heavy & brought


def test_import_loads_no_library_for_foreign_meshes():
    maps = run("-c", "import palpate; print(open('/proc/self/maps').read())", check=True).stdout
    assert "/_core." in maps and "assimp" not in maps and "draco" not in maps


def test_a_sub_interpreter_is_told_that_it_cannot_have_it():
    text = ("import importlib\n"
            "for name in ('_interpreters', '_xxsubinterpreters'):\n"
            "    try: interpreters = importlib.import_module(name); break\n"
            "    except ImportError: pass\n"
            "import sys, palpate\n"
            "words = f'import sys; sys.path[:] = {sys.path!r}\\n'\n"
            "for module in ('palpate', 'palpate._core', 'palpate.view'):\n"
            "    words += f'try: import {module}\\nexcept ImportError as error: print(error, flush=True)\\n'\n"
            "interpreters.run_string(interpreters.create(), words)\n"
            "print(palpate.World.torso().name)\n")
    told = run("-c", text, check=True, timeout=60).stdout.splitlines()
    assert told[:3] == ["palpate works only in the main interpreter of a process, not in a sub-interpreter"] * 3
    assert len(told) == 4, "and who had it goes on"


def classes():
    for name in MODULES:
        for member, value in vars(importlib.import_module("palpate." + name)).items():
            if inspect.isclass(value) and not issubclass(value, BaseException):
                yield pytest.param(value, id=f"{name}.{member}")


@pytest.mark.parametrize("made", classes())
def test_an_object_without_its_init_is_refused_wherever_it_is_used(made):
    """In a process of its own: it ended there."""
    text = f"""
import importlib, inspect
made = importlib.import_module({made.__module__!r}).{made.__qualname__}
empty, used = made.__new__(made), 0
for name, value in inspect.getmembers(made):
    if name in ("__class__", "__new__", "__init__", "__del__") or isinstance(inspect.getattr_static(made, name), staticmethod):
        continue
    if getattr(object, name, None) is value or getattr(type(made).__base__, name, None) is value:
        continue
    try:
        use = getattr(empty, name)
        use = use() if callable(use) else use
    except (TypeError, RuntimeError) as error:
        used += "__init__() was not called" in str(error) or "non-held" in str(error)
        continue
    if not name.startswith("__") or name == "__repr__":
        raise SystemExit(f"{{name}} gave {{use!r}}")
try:
    repr(empty)
except TypeError as error:
    used += 1
print(used)
"""
    done = run("-c", text, timeout=60)
    assert done.returncode == 0, (done.returncode, done.stdout, done.stderr)
    assert int(done.stdout) > 0, "nothing asked for what is in it"


def test_a_world_can_be_made_without_numpy():
    text = ("import sys, palpate; w = palpate.World.torso(); f = palpate.Finger(w); t = f.lift(); "
            "print('numpy' in sys.modules, w.words is None)")
    assert run("-c", text, check=True).stdout.split()[0] == "False"


@pytest.mark.skipif(not os.environ.get("PALPATE_HEAVY"), reason="judges by the clock; set PALPATE_HEAVY=1")
def test_import_time():
    """Twice what it should take, for a loaded machine; tools/bench-python measures it."""
    text = "import time; a = time.perf_counter(); import palpate; print((time.perf_counter() - a) * 1000)"
    assert min(float(run("-c", text, check=True).stdout) for _ in range(7)) <= 40.0


def test_submodules_are_found_by_their_name():
    assert "gym" in dir(palpate) and palpate.gym.VectorEnv
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
    for file in sorted((STAGE / "palpate").rglob("*.py")):
        if file.name.startswith("_"):
            continue
        module = importlib.import_module(".".join(file.relative_to(STAGE).with_suffix("").parts))
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
