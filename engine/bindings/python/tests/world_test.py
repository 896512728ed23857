"""Worlds: how they are made, what is refused and in which words, who became whom, and places by name."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import palpate
from conftest import dome, landed


def test_text_names_file_and_line_of_what_is_wrong():
    with pytest.raises(palpate.Error) as caught:
        palpate.World.parse('title = "x"\n[body]\nkind = "torsoo"\n', "back.toml")
    error = caught.value
    assert isinstance(error, ValueError)
    assert (error.file, error.line) == ("back.toml", 3)
    assert "torsoo" in error.cause
    assert str(error) == f"{error.file}:{error.line}: {error.cause}"


def test_a_missing_file_is_an_error_with_its_name(tmp_path):
    with pytest.raises(palpate.Error) as caught:
        palpate.World.load(tmp_path / "none.toml")
    assert caught.value.file == str(tmp_path / "none.toml")
    assert caught.value.line is None
    with pytest.raises(palpate.Error, match="none.stl"):
        palpate.World.from_file(tmp_path / "none.stl")


def test_an_error_made_by_hand_has_no_place():
    error = palpate.Error("words")
    assert (error.file, error.line, error.cause) == (None, None, "")


@pytest.mark.parametrize("kind", [np.int64, np.int32, np.int16, np.uint32, np.uint64])
def test_faces_of_any_whole_kind(kind):
    vertices, faces = dome(8)
    world = palpate.World.from_arrays(vertices, faces.astype(kind))
    assert len(world.triangles) == len(faces)


@pytest.mark.parametrize("wrong", [-1, 4_294_967_295, 81, 2**40])
def test_the_first_wrong_face_is_named(wrong):
    vertices, faces = dome(8)
    faces = faces.astype(np.int64)
    faces[17, 1] = wrong
    faces[40, 0] = -7
    with pytest.raises(palpate.Error, match=f"corner 1 of triangle 17 is vertex {wrong}, but there are only 81 vertices"):
        palpate.World.from_arrays(vertices, faces)


def test_what_is_no_mesh_is_refused():
    vertices, faces = dome(8)
    with pytest.raises(TypeError, match="faces: expected integers"):
        palpate.World.from_arrays(vertices, faces.astype(float))
    with pytest.raises(ValueError, match=r"faces: must be \(F, 3\)"):
        palpate.World.from_arrays(vertices, faces.ravel())
    with pytest.raises(ValueError, match="vertices"):
        palpate.World.from_arrays(vertices[:, :2], faces)
    with pytest.raises(TypeError, match="vertices: expected numbers"):
        palpate.World.from_arrays([["a", "b", "c"]], faces)
    with pytest.raises(TypeError, match="vertices: expected numbers"):
        palpate.World.from_arrays(vertices.astype(complex), faces)
    vertices[5, 2] = np.nan
    with pytest.raises(palpate.Error, match="z of vertex 5 is not finite"):
        palpate.World.from_arrays(vertices, faces)


def test_without_repair_a_mesh_with_faults_is_refused():
    vertices, faces = dome(8)
    twice = np.concatenate([faces, faces[:1]])
    assert len(palpate.World.from_arrays(vertices, twice).triangles) == len(faces)
    with pytest.raises(palpate.Error, match="repair is off"):
        palpate.World.from_arrays(vertices, twice, repair=False)
    assert len(palpate.World.from_arrays(vertices, faces, repair=False).triangles) == len(faces)


def test_stiffness_of_one_number_and_of_each_vertex():
    vertices, faces = dome(12)
    assert np.all(palpate.World.from_arrays(vertices, faces, stiffness=0.75).stiffness == 0.75)
    each = np.linspace(0.2, 1.5, len(vertices))
    world = palpate.World.from_arrays(vertices, faces, stiffness=each)
    np.testing.assert_array_equal(world.stiffness, each[world.source_vertex])
    with pytest.raises(palpate.Error, match="stiffness values for"):
        palpate.World.from_arrays(vertices, faces, stiffness=each[:-1])
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(ValueError):
            palpate.World.from_arrays(vertices, faces, stiffness=wrong)


def test_maps_lead_back_to_what_was_given():
    vertices, faces = dome(12)
    seam = np.concatenate([vertices, vertices[:5]])  # five of them twice
    faces = faces.copy()
    faces[0] = np.where(faces[0] < 5, faces[0] + len(vertices), faces[0])
    world = palpate.World.from_arrays(seam, faces)
    assert len(world.positions) == len(vertices)
    assert not np.array_equal(world.positions, vertices), "the order must have changed, or nothing is tested"
    np.testing.assert_array_equal(world.positions, seam[world.source_vertex])
    np.testing.assert_array_equal(seam[world.source_vertex[world.built_vertex]], seam)
    # Every triangle has the corners, at their places, of the given one that it says it is.
    for built, given in enumerate(world.source_triangle):
        ours = {tuple(p) for p in world.positions[world.triangles[built]]}
        assert ours == {tuple(p) for p in seam[faces[given]]}
    np.testing.assert_array_equal(world.source_triangle[world.built_triangle], np.arange(len(faces)))


def test_what_mending_drops_has_no_place():
    vertices, faces = dome(8)
    alone = np.concatenate([vertices, [[0.0, 0.0, 500.0]]])
    world = palpate.World.from_arrays(alone, np.concatenate([faces, faces[3:4]]))
    assert world.built_vertex[-1] == -1
    assert world.built_triangle.shape == (len(faces) + 1,)
    assert any("repaired" in note for note in world.notes)


def test_the_skin_of_a_body_in_map_coordinates_is_where_the_body_is():
    vertices, faces = dome(12)

    def pressed(offset):
        world = palpate.World.from_arrays(vertices + offset, faces)
        skin = palpate.Skin(world)
        np.testing.assert_allclose(skin.positions, world.positions, atol=1e-3)
        finger = palpate.Finger(world)
        for height in np.linspace(22.0, 15.0, 200):
            touch = finger.step(offset + [3.1, 2.3, height])  # within a triangle: on a vertex rounding would choose another
        skin.apply([touch])
        np.testing.assert_allclose(skin.positions, world.positions + skin.displacement, atol=1e-3)
        np.testing.assert_array_equal(skin.copy()["positions"], skin.positions)
        return skin.displacement[world.built_vertex]

    nearby = pressed(np.zeros(3))
    assert np.abs(nearby).max() > 3.0
    np.testing.assert_allclose(pressed(np.array([4e8, 4.08e9, 0.0])), nearby, atol=1e-2)


def test_a_world_without_a_given_mesh_has_no_maps(torso):
    with pytest.raises(palpate.Error, match="no index maps"):
        _ = torso.source_vertex


def test_a_file_with_scale_and_stiffness(tmp_path):
    vertices, faces = dome(8)
    file = tmp_path / "dome.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in vertices / 10] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    file.write_text("\n".join(lines))
    world = palpate.World.from_file(file, scale=10.0, stiffness=np.full(len(vertices), 0.7))
    np.testing.assert_allclose(world.positions, vertices[world.source_vertex], atol=1e-4)
    assert np.all(world.stiffness == 0.7)
    file.write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(palpate.Error) as caught:
        palpate.World.from_file(file)
    assert caught.value.file == str(file)


def test_a_file_s_world_says_what_was_left_out_of_it(tmp_path):
    vertices, faces = dome(8)
    file = tmp_path / "dome.obj"
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1] + ["l 1 2", "l 2 3"]
    file.write_text("\n".join(lines))
    world = palpate.World.from_file(file)
    assert world.notes[0] == f"{file}: left out: lines (2)"
    for other in (pickle.loads(pickle.dumps(world)), world.rebuilt('[tissue]\nforce_law = "linear"\n')):
        assert other.notes[0] == world.notes[0]


def test_rebuilt_keeps_the_body_and_changes_the_law(dome_world):
    other = dome_world.rebuilt('[tissue]\nforce_law = "linear"\n[stiffness]\nsource = "constant"\nconstant_n_per_mm = 1.25\n')
    np.testing.assert_array_equal(other.positions, dome_world.positions)
    np.testing.assert_array_equal(other.source_vertex, dome_world.source_vertex)
    assert np.all(other.stiffness == 1.25)
    force = landed(other).step([0, 0, 18])
    assert force.depth_mm > 1
    assert np.linalg.norm(force.force) == pytest.approx(1.25 * force.depth_mm, rel=1e-3)
    with pytest.raises(palpate.Error) as caught:
        dome_world.rebuilt("[tissue]\nforce_law = 3\n", "law.toml")
    assert (caught.value.file, caught.value.line) == ("law.toml", 2)


def test_places_by_name(torso):
    spine = torso.place("T6")
    assert np.linalg.norm(spine - torso.landmarks["spinous_T6"]) < 2.0
    right = torso.place("T6 right 30 mm")
    assert right[0] - spine[0] == pytest.approx(30.0, abs=1.0)
    assert right[1] == pytest.approx(spine[1], abs=1.0)
    np.testing.assert_allclose(torso.place(spine), spine, atol=1e-9)
    assert np.linalg.norm(torso.normal_at("T6")) == pytest.approx(1.0)
    assert torso.normal_at("T6") @ torso.landmark_normals["spinous_T6"] > 0.9
    assert torso.words(right).startswith("T6")
    assert "T6" in torso.place_names
    triangle = torso.triangle_at("T6")
    assert torso.stiffness_at("T6") == pytest.approx(torso.stiffness[torso.triangles[triangle]].mean(), rel=0.2)
    with pytest.raises(palpate.Error, match="T6"):
        torso.place("T66")
    with pytest.raises(ValueError, match="three numbers"):
        torso.place([1.0, 2.0])
    with pytest.raises(ValueError, match="finite"):
        torso.place([np.nan, 0, 0])


def test_a_path_along_the_normal_presses(torso):
    tips = torso.tips("T6 right 30 mm", [-2.0, 0.0, 4.0])
    assert tips.shape == (3, 3)
    felt = palpate.Finger(torso)
    assert [felt.step(tip).state != "free" for tip in tips][-1]
    assert palpate.Finger(torso).step(tips[0]).state == "free"


def test_ellipses(torso):
    spine = torso.place("T6")
    both = torso.ellipses([spine[:2], spine[:2] + 50])
    assert both.shape == (2, 3)
    np.testing.assert_array_equal(torso.ellipses("T6"), both[:1])
    np.testing.assert_array_equal(torso.ellipses(["T6", "T6"])[1], both[0])
    assert np.all(both[:, 0] >= both[:, 1]) and np.all(both[:, 1] > 0)
    assert np.all((both[:, 2] >= 0) & (both[:, 2] < np.pi))
    with pytest.raises(ValueError, match="xy"):
        torso.ellipses([1.0, 2.0, 3.0])


def test_shapes_of_what_a_world_shows(torso):
    count = len(torso.positions)
    assert torso.positions.shape == torso.normals.shape == (count, 3)
    assert torso.stiffness.shape == (count,)
    assert torso.triangles.dtype == np.int32 and torso.triangles.max() == count - 1
    np.testing.assert_allclose(np.linalg.norm(torso.normals, axis=1), 1.0, atol=1e-9)
    assert not torso.closed and isinstance(torso.notes, list)
    assert len(palpate.World.trunk(triangles=12000).triangles) > 1000
    with pytest.raises(palpate.Error):
        palpate.World.torso(triangles=10)
