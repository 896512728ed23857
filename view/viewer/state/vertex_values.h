// What the body's own file brings for its vertices, as the window shows it: which number colours the skin, and what the
// vertex has that was clicked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/lines.h"
#include "palpate/view/look.h"

namespace palpate::viewer {

/// All that is known of one vertex of the skin.
struct VertexReading {
  Index vertex = 0;              ///< of the skin, as in pictures and PLY files of the deformed skin
  std::optional<Index> in_file;  ///< of the mesh file, from 0
  Vec3 place = Vec3::Zero();     ///< at rest, mm
  double stiffness_n_per_mm = 0.0;
  std::string where;  ///< as an examiner says the place that was clicked; empty on a body without names
  std::optional<double> bone_depth_mm;
  std::string bone;  ///< the nearest one; empty without bones
  struct Scalar {
    std::string name;
    double value = 0.0;
  };
  std::vector<Scalar> scalars;  ///< in the order of the file
};

/// Of the vertex nearest to a place on the skin at rest.
VertexReading readVertex(const scene::World& world, const Vec3& place);

/// A cross on it, where the skin is now.
view::Lines vertexMark(const VertexReading& reading, const scene::World& world, const deform::DeformedSurface& surface);

/// Of a world that is shown for the first time: the look keeps its scalar if the world has it, else takes the first.
/// What to tell the user; empty when the file brings nothing.
std::string useChannelsOf(const scene::World& world, view::Look& look);

}  // namespace palpate::viewer
