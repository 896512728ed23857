// One mesher for every form: on a lattice of random place and size, evened out or made coarser at random.
// Data flow: name and random numbers -> hunted_forms.cpp -> body::meshZeroSurface -> here -> hunted_bodies.h.
#include "lab/workloads/hunted_shapes.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"
#include "palpate/mesh/repair.h"

namespace palpate::lab {
namespace {

/// Checks after repair, which mends triangles without height.
bool piercesItself(const mesh::TriangleMesh& mesh) { return mesh::repair(mesh).self_intersecting; }

/// The lattice's own surface. Where a sharp edge runs along a plane of the lattice its triangles can lose their height
/// and fold over: then the lattice is moved.
mesh::TriangleMesh latticeSurface(const HuntedForm& shape, double cell, Random& random) {
  constexpr int kTries = 5;
  for (int i = 0;; ++i) {
    const Vec3 off = cell * random.uniform3();
    mesh::TriangleMesh mesh = body::meshZeroSurface(shape.field, {.low = Vec3::Constant(-shape.reach_mm) - off,
                                                                  .high = Vec3::Constant(shape.reach_mm + cell),
                                                                  .cell_mm = cell,
                                                                  .steepest = 2.5});
    if (i == kTries || !piercesItself(mesh)) return mesh;
  }
}

/// Meshed, and then left as the lattice made it, evened out, or made coarser where it is flat. The last two may fold at
/// a sharp edge: then the first is taken.
mesh::TriangleMesh finished(const HuntedForm& shape, Random& random) {
  const mesh::TriangleMesh plain = latticeSurface(shape, shape.cell_mm * random.uniform(1.15, 1.8), random);
  const auto triangles = static_cast<double>(plain.triangles.size());
  mesh::TriangleMesh mesh = plain;
  switch (random.below(3)) {
    case 0:
      return plain;
    case 1:
      body::relaxOnSurface(mesh, shape.field, 2);
      break;
    default:
      mesh =
          mesh::decimate(std::move(mesh), 2 * static_cast<std::size_t>(random.uniform(0.1, 0.5) * triangles / 2) + 500);
  }
  return piercesItself(mesh) ? plain : mesh;
}

}  // namespace

std::vector<std::string> huntedShapeNames() {
  std::vector<std::string> names;
  for (const NamedForm& shape : huntedForms()) names.emplace_back(shape.name);
  return names;
}

mesh::TriangleMesh huntedShape(std::string_view name, Random& random) {
  const auto& forms = huntedForms();
  const auto* const found =
      std::find_if(forms.begin(), forms.end(), [&](const NamedForm& form) { return name == form.name; });
  if (found == forms.end()) throw Error(fmt::format("unknown hunted shape '{}'", name));
  return finished(found->make(random), random);
}

}  // namespace palpate::lab
