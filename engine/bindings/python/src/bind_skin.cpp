// Skin: the deformed skin of a world, live views of it, and copies for other threads.
#include <fmt/format.h>

#include <algorithm>

#include "bindings.h"
#include "skin_handle.h"

namespace palpate::python {

namespace {

using Stream = std::span<const float>;

/// (V, 3) over three arrays at equal distances.
Float32Array pointsOver(const Stream& x, const Stream& y, const Stream& z, const py::object& self) {
  const py::ssize_t axis = (y.data() - x.data()) * static_cast<py::ssize_t>(sizeof(float));
  if (z.data() - y.data() != y.data() - x.data()) throw std::logic_error("the streams of a skin lie elsewhere");
  return arrayView(x.data(), {static_cast<py::ssize_t>(x.size()), 3}, {sizeof(float), axis}, self);
}

const deform::DeformedSurface& surfaceOf(const py::object& self) {
  return self.cast<const SkinHandle&>().skin().surface();
}

/// Places of a body far from the origin: a float of the body frame would be millimetres off.
py::array_t<double> placesOf(const deform::DeformedSurface& surface) {
  py::array_t<double> places({static_cast<py::ssize_t>(surface.vertices()), py::ssize_t{3}});
  double* to = places.mutable_data();
  for (Index v = 0; v < surface.vertices(); ++v) Eigen::Map<Vec3>{to + std::size_t{3}* v} = surface.placeAt(v);
  return places;
}

FloatingArray positionArray(const py::object& self) {
  const deform::DeformedSurface& surface = surfaceOf(self);
  if (!surface.origin().isZero(0.0)) return py::object(placesOf(surface));
  return py::object(pointsOver(surface.position(0), surface.position(1), surface.position(2), self));
}

/// Copied here and not by numpy, which lets other threads in while it copies; and all arrays are there before the first
/// is written, because making one may let them in too.
py::dict copied(SkinHandle& self) {
  const deform::DeformedSurface& surface = self.skin().surface();
  const auto vertices = static_cast<py::ssize_t>(surface.vertices());
  py::array_t<float> positions({vertices, py::ssize_t{3}});
  py::array_t<float> normals({vertices, py::ssize_t{3}});
  py::array_t<float> displacement({vertices, py::ssize_t{3}});
  py::array_t<float> strain(vertices);
  const bool is_far = !surface.origin().isZero(0.0);
  py::array_t<double> places({is_far ? vertices : py::ssize_t{0}, py::ssize_t{3}});
  double* to_places = places.mutable_data();
  float* to[] = {positions.mutable_data(), normals.mutable_data(), displacement.mutable_data()};
  float* to_strain = strain.mutable_data();
  {
    const Busy::Guard guard(self.busy(), "Skin");
    for (Index v = 0; v < surface.vertices(); ++v) {
      Eigen::Map<Vec3f>{to[0] + std::size_t{3}* v} = surface.positionAt(v);
      if (is_far) Eigen::Map<Vec3>{to_places + std::size_t{3}* v} = surface.placeAt(v);
      Eigen::Map<Vec3f>{to[1] + std::size_t{3}* v} = surface.normalAt(v);
      Eigen::Map<Vec3f>{to[2] + std::size_t{3}* v} = surface.displacementAt(v);
    }
    std::copy(surface.strain().begin(), surface.strain().end(), to_strain);
  }
  py::dict copy;
  copy["positions"] = surface.origin().isZero(0.0) ? py::object(std::move(positions)) : py::object(std::move(places));
  copy["normals"] = std::move(normals);
  copy["displacement"] = std::move(displacement);
  copy["strain"] = std::move(strain);
  return copy;
}

void apply(SkinHandle& self, const Touches& given, std::uint64_t tick) {
  const std::vector<contact::FingerOutput> touches = asTouches(given);
  if (touches.size() > self.fingers()) {
    throw py::value_error(fmt::format(
        "touches: {} are more than the {} that this Skin was made for; set fingers=", touches.size(), self.fingers()));
  }
  const Busy::Guard guard(self.busy(), "Skin");
  self.report = self.skin().follow(touches, tick);
}

IndexArray changedRanges(const SkinHandle& self) {
  const auto changed = self.skin().surface().changed();
  py::array_t<std::int64_t> ranges({static_cast<py::ssize_t>(changed.size()), py::ssize_t{2}});
  for (std::size_t i = 0; i < changed.size(); ++i) {
    ranges.mutable_at(static_cast<py::ssize_t>(i), 0) = changed[i].first;
    ranges.mutable_at(static_cast<py::ssize_t>(i), 1) = changed[i].end;
  }
  return {std::move(ranges)};
}

void bindTouching(py::class_<SkinHandle>& skin) {
  skin.def(
      py::init([](const WorldPointer& world, bool strain, std::size_t fingers) {
        if (fingers == 0) throw py::value_error("fingers: must be at least 1");
        return std::make_unique<SkinHandle>(world, strain, fingers);
      }),
      "Begins at rest. strain: also compute the strain; fingers: maximum number applied at once. Raises palpate.Error.",
      py::arg("world"), py::kw_only(), py::arg("strain") = true, py::arg("fingers") = 16);
  skin.def("apply", &apply,
           "Deforms the skin by these touches, whatever its state before; an empty list brings it to rest.\n\ntick: "
           "when they felt it, counted from the start of the run; matters on a body that breathes.\nThe interpreter's "
           "lock is kept. Raises TypeError for other things than touches, ValueError for more of them than there is "
           "room for, RuntimeError while another thread reads the skin (view.render).",
           py::arg("touches"), py::kw_only(), py::arg("tick") = 0);
  skin.def(
      "copy", [](SkinHandle& self) { return FeltDict(copied(self)); },
      "A dict of fresh arrays, whole even beside `apply` in another thread: positions, normals, displacement (V, 3) "
      "and "
      "strain (V,), float32; positions float64 of a body farther than 10 m from the origin. Raises RuntimeError while "
      "another thread reads the skin (view.render).");
}

/// The live views.
void bindArrays(py::class_<SkinHandle>& skin) {
  skin.def_property_readonly("positions", &positionArray,
                             "(V, 3) float32, mm; a live view, not contiguous (an axis after the other in memory). Of "
                             "a body farther than 10 m "
                             "from the origin, as in map coordinates, a fresh float64 array.");
  skin.def_property_readonly(
      "normals",
      [](const py::object& self) {
        const auto& surface = surfaceOf(self);
        return pointsOver(surface.normal(0), surface.normal(1), surface.normal(2), self);
      },
      "(V, 3) float32 unit normals; a live view.");
  skin.def_property_readonly(
      "displacement",
      [](const py::object& self) {
        const auto& surface = surfaceOf(self);
        return pointsOver(surface.displacement(0), surface.displacement(1), surface.displacement(2), self);
      },
      "(V, 3) float32, mm from rest, 0 where the skin does not move; a live view.");
  skin.def_property_readonly(
      "strain",
      [](const py::object& self) {
        const Stream strain = surfaceOf(self).strain();
        return Float32Array(arrayView(strain.data(), {static_cast<py::ssize_t>(strain.size())}, self));
      },
      "(V,) float32, 0.1 is 10 % longer, below 0 shorter; zeros without strain. A live view.");
}

/// What the last `apply` did.
void bindReport(py::class_<SkinHandle>& skin) {
  skin.def_property_readonly(
      "changed", &changedRanges,
      "(R, 2) int64: ranges of vertices, first and end, written by the last `apply`; a new array.");
  skin.def_property_readonly(
      "moved_vertices", [](const SkinHandle& self) { return self.report.moved_vertices; },
      "Number of vertices within reach of a finger in the last `apply`.");
  skin.def_property_readonly(
      "status", [](const SkinHandle& self) { return self.report.status; },
      "Bits of the last `apply`: 1 a contact that is not finite, 2 without triangle, 4 more than there is room for, 8 "
      "a "
      "region without area, 16 without a vertex (docs/explanation/deformation.md).");
}

}  // namespace

void bindSkin(py::module_& module) {
  py::class_<SkinHandle> skin(
      module, "Skin",
      "The skin of a world, deformed by fingers.\n\nIts arrays are live, read-only views: the next `apply` changes "
      "what they show. They are for the thread that applies; `copy` is for others and for later.");
  bindTouching(skin);
  bindArrays(skin);
  bindReport(skin);
  skin.def_property_readonly("world", &SkinHandle::world, "The world that the skin belongs to.");
}

}  // namespace palpate::python
