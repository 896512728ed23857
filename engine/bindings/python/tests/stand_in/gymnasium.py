"""Stands in for gymnasium 1.x in the tests where it is not installed: its base classes, modes, spaces, registry and the
checks that its wrappers make, as its source (1.4.0) has them. Nothing of palpate but the tests imports it."""

from __future__ import annotations

import enum
import importlib
import sys
import types

import numpy as np

__version__ = "1.4.0"
registry: dict = {}


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class Space:
    def __init__(self, shape=None, dtype=None, seed=None):
        self._shape, self.dtype = shape, None if dtype is None else np.dtype(dtype)
        self._np_random = np.random.default_rng(seed)

    @property
    def shape(self):
        return self._shape

    def seed(self, seed=None):
        self._np_random = np.random.default_rng(seed)

    def __contains__(self, x):
        return self.contains(x)


class Box(Space):
    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        shape = tuple(shape) if shape is not None else np.shape(low) or np.shape(high)
        super().__init__(shape, dtype, seed)
        self.low, self.high = (np.full(shape, end, dtype) if np.ndim(end) == 0 else np.asarray(end, dtype) for end in (low, high))
        assert self.low.shape == shape == self.high.shape

    def sample(self):
        return self._np_random.uniform(np.maximum(self.low, -1e3), np.minimum(self.high, 1e3)).astype(self.dtype)

    def contains(self, x):
        return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self.shape and np.all(x >= self.low) and np.all(x <= self.high))


class Dict(Space):
    def __init__(self, spaces):
        super().__init__()
        self.spaces = dict(spaces)

    def contains(self, x):
        return isinstance(x, dict) and x.keys() == self.spaces.keys() and all(x[name] in space for name, space in self.spaces.items())


class Discrete(Space):
    def __init__(self, n, seed=None, start=0):
        super().__init__((), np.int64, seed)
        self.n, self.start = n, start


class _Random:
    metadata: dict = {}
    render_mode = spec = _np_random = _np_random_seed = None

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random, self._np_random_seed = np.random.default_rng(seed), seed

    @property
    def np_random(self):
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    @property
    def unwrapped(self):
        return self


class Env(_Random):
    def close(self):
        pass


class VectorEnv(_Random):
    closed = False

    def close(self, **kwargs):
        if not self.closed:
            self.close_extras(**kwargs)
            self.closed = True


class VectorWrapper(VectorEnv):
    def __init__(self, env):
        if not isinstance(env, VectorEnv):
            raise TypeError(f"Expected env to be a `gymnasium.vector.VectorEnv` but got {type(env)}")
        if not isinstance(env.metadata["autoreset_mode"], AutoresetMode):
            raise TypeError("Expected env.metadata['autoreset_mode'] to be an AutoresetMode")
        self.env = env


def register(id, entry_point=None, *, vector_entry_point=None, max_episode_steps=None, kwargs=None):
    registry[id] = types.SimpleNamespace(id=id, entry_point=entry_point, vector_entry_point=vector_entry_point,
                                         max_episode_steps=max_episode_steps, kwargs=dict(kwargs or {}))


def _loaded(words):
    module, _, name = words.partition(":")
    return getattr(importlib.import_module(module), name)


def make(id, **kwargs):
    module, _, name = id.rpartition(":")
    if module:
        importlib.import_module(module)
    env = _loaded(registry[name].entry_point)(**{**registry[name].kwargs, **kwargs})
    env.unwrapped.spec = registry[name]
    return env


def make_vec(id, num_envs=1, vectorization_mode=None, **kwargs):
    spec = registry[id]
    kwargs = {"max_episode_steps": spec.max_episode_steps, **spec.kwargs, **kwargs}
    env = _loaded(spec.vector_entry_point)(num_envs=num_envs, **kwargs)
    env.unwrapped.spec = spec
    return env


for _name, _words in (("spaces", ("Space", "Box", "Dict", "Discrete")), ("vector", ("AutoresetMode", "VectorEnv", "VectorWrapper"))):
    _module = types.ModuleType("gymnasium." + _name)
    for _word in _words:
        setattr(_module, _word, globals()[_word])
    globals()[_name] = sys.modules["gymnasium." + _name] = _module
