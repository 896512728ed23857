// Random embedded bodies with parts that are hard to feel: pockets, crevices, limbs, thin plates, horns, walls,
// tunnels.
//
// Each shape is a signed distance, a union of primitives with others cut out, whose zero surface is meshed: closed and
// manifold whatever the random numbers are, and free of self-intersections but for a few whose flat triangles at a
// sharp edge repair mends. About 50 to 250 mm long.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// Names of the shapes, in an order that stays.
std::vector<std::string> huntedShapeNames();

/// One of that shape, all its measures from `random`: 1,000 to 40,000 triangles. Throws Error for another name.
mesh::TriangleMesh huntedShape(std::string_view name, Random& random);

/// A distance, the half edge of the cube that holds it, and the lattice cell that its thinnest part needs.
struct HuntedForm {
  body::Field field;
  double reach_mm;
  double cell_mm;
};

struct NamedForm {
  const char* name;
  HuntedForm (*make)(Random& random);  ///< all its measures are random
};

inline constexpr std::size_t kHuntedForms = 26;
const std::array<NamedForm, kHuntedForms>& huntedForms();

}  // namespace palpate::lab
