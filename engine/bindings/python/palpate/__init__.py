"""Feel, see and measure touch on a soft body.

Lengths are millimetres, forces newtons, times seconds; x points to the patient's right seen from behind, y to the head, z
out of the back. docs/reference/python.md is the manual.
"""

from __future__ import annotations

def _is_in_the_main_interpreter() -> bool:
    for name in ("_interpreters", "_xxsubinterpreters"):  # from Python 3.13 on, before
        try:
            interpreters = __import__(name)
        except ImportError:
            continue
        return bool(interpreters.get_current() == interpreters.get_main())
    return True


if not _is_in_the_main_interpreter():  # pybind11 would wait there for a lock that is never given
    raise ImportError("palpate works only in the main interpreter of a process, not in a sub-interpreter")

from palpate._core import Error, Finger, Fingers, FingerSettings, Lump, Session, Skin, Tools, Touch, World, __version__, _world_of

TYPE_CHECKING = False  # typing itself takes two milliseconds to import
if TYPE_CHECKING:
    from typing import Any

    from palpate import devices as devices
    from palpate import env as env
    from palpate import fit as fit
    from palpate import gym as gym
    from palpate import measure as measure
    from palpate import notebook as notebook
    from palpate import sessions as sessions
    from palpate import tissue as tissue
    from palpate import view as view

__all__ = ["Error", "Finger", "FingerSettings", "Fingers", "Lump", "Session", "Skin", "Tools", "Touch", "World", "__version__"]

# Loaded when they are first asked for: `import palpate` is to cost nothing that is not used.
_LAZY = ("devices", "env", "fit", "gym", "measure", "notebook", "sessions", "tissue", "view")


def _unpickled_world(toml: str, mesh: Any, hash: str) -> World:
    """Pickles name a function of Python: one that is compiled belongs to no module of theirs."""
    return _world_of(toml, mesh, hash)


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        import importlib

        return importlib.import_module("palpate." + name)
    raise AttributeError(f"module 'palpate' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted([*globals(), *_LAZY])
