"""Worlds and settings go to other processes: pickled, read again once a process, and refused where they would differ."""

from __future__ import annotations

import copy
import pathlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

import palpate
from conftest import dome, wander


def read_elsewhere(data: bytes, expression: str) -> str:
    """In a fresh interpreter, `world` being what was pickled."""
    text = f"import pickle, sys; world = pickle.loads(sys.stdin.buffer.read()); print({expression})"
    path = str(pathlib.Path(palpate.__file__).resolve().parents[1])
    done = subprocess.run([sys.executable, "-c", f"import sys; sys.path.insert(0, {path!r}); {text}"], input=data, capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout.decode().strip()


def test_a_world_of_arrays_feels_the_same_in_another_process():
    vertices, faces = dome(20)
    world = palpate.World.from_arrays(vertices, faces, stiffness=np.linspace(0.3, 0.9, len(vertices)))
    tips = wander(1, 100)[0].tolist()
    here = world.rollout(np.array([tips]))["force"].sum()
    there = read_elsewhere(pickle.dumps(world), f"float(world.rollout(__import__('numpy').array([{tips}]))['force'].sum())")
    assert float(there) == here


@pytest.mark.parametrize("make", [
    palpate.World.torso,
    lambda: palpate.World.torso(triangles=4500),
    lambda: palpate.World(body="torso", triangles=4999),
    lambda: palpate.World.torso().rebuilt("[stiffness]\nsource = 'constant'\nconstant_n_per_mm = 0.8\n"),
    lambda: palpate.World(body="trunk", triangles=12000, lumps=[palpate.Lump(at="T9 right 30 mm", depth_mm=6)]),
    lambda: palpate.World.from_arrays(*dome(20)).rebuilt("[stiffness]\nsource = 'constant'\nconstant_n_per_mm = 0.8\n"),
])
def test_whatever_made_it_the_hash_is_kept(make):
    world = make()
    again = pickle.loads(pickle.dumps(world))
    assert np.array_equal(again.positions, world.positions) and np.array_equal(again.stiffness, world.stiffness)
    assert [lump["name"] for lump in again.lumps] == [lump["name"] for lump in world.lumps]


@pytest.mark.parametrize("make", [
    lambda: palpate.World.torso(triangles=4499),
    lambda: palpate.World(body="torso", triangles=4499),
    lambda: palpate.World.torso(triangles=4_000_001),
    lambda: palpate.World(body="torso", triangles=4_000_001),
    lambda: palpate.World.trunk(triangles=4_000_002),
    lambda: palpate.World.trunk(triangles=83_163),
])
def test_what_no_text_could_ask_for_is_not_made_either(make):
    with pytest.raises(palpate.Error, match="triangles|even number"):
        make()


def test_it_is_built_once_a_process():
    data = pickle.dumps(palpate.World.from_arrays(*dome(20)))
    assert pickle.loads(data) is pickle.loads(data)


def test_who_became_whom_is_known_again():
    world = palpate.World.from_arrays(*dome(20))
    assert np.array_equal(pickle.loads(pickle.dumps(world)).source_vertex, world.source_vertex)


def test_the_same_skin_given_in_another_order_keeps_its_own_maps():
    vertices, faces = dome(20)
    last = len(vertices) - 1
    worlds = [palpate.World.from_arrays(vertices, faces), palpate.World.from_arrays(vertices[::-1], last - faces)]
    read = [pickle.loads(pickle.dumps(world)) for world in worlds]
    for world, again in zip(worlds, read):
        assert np.array_equal(again.source_vertex, world.source_vertex)
    assert not np.array_equal(worlds[0].source_vertex, worlds[1].source_vertex)


def test_a_file_that_has_changed_is_told(tmp_path):
    vertices, faces = dome(20)
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + ["f {} {} {}".format(*(face + 1)) for face in faces]
    (tmp_path / "dome.obj").write_text("\n".join(lines))
    (tmp_path / "scene.toml").write_text('[body]\nkind = "mesh"\nfile = "dome.obj"\n')
    data = pickle.dumps(palpate.World.load(tmp_path / "scene.toml"))
    assert read_elsewhere(data, "len(world.triangles)") == str(len(faces))
    (tmp_path / "dome.obj").write_text("\n".join(lines).replace("v 0.0 0.0 20.0", "v 0.0 0.0 21.0"))
    with pytest.raises(AssertionError, match="differs from the pickled one"):
        read_elsewhere(data, "world")


def test_bytes_that_are_no_world_are_refused():
    rebuild, (toml, mesh, known) = palpate.World.from_arrays(*dome(20)).__reduce__()
    with pytest.raises(palpate.Error, match="not a valid pickle of a World"):
        rebuild(toml, (mesh[0], b"\xff" * len(mesh[1]), *mesh[2:]), "0" * 16)
    with pytest.raises(palpate.Error, match="not a valid pickle of a World"):
        rebuild(toml, (mesh[0][:-1], *mesh[1:]), "0" * 16)


def test_settings_and_lumps():
    settings = palpate.FingerSettings(radius_mm=8.1, mu_static=0.7, mu_dynamic=0.1 + 0.2, force_shading=False)
    assert pickle.loads(pickle.dumps(settings)) == settings and copy.copy(settings) is settings
    for lump in (palpate.Lump(at=(10.0, 20.5), half_axes_mm=(5, 5, 4), young_kpa=80.0, name="node"), palpate.Lump(at="T6")):
        assert pickle.loads(pickle.dumps(lump)) == lump and copy.deepcopy(lump) is lump


def test_a_copy_of_a_world_is_itself():
    world = palpate.World.from_arrays(*dome(20))
    assert copy.copy(world) is world and copy.deepcopy({"w": [world]})["w"][0] is world
