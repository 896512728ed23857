// Vertex data of the body's own file as the window shows it: the number that colours the skin, and the values of the
// clicked vertex.
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

/// Data of one vertex of the skin.
struct VertexReading {
  Index vertex = 0;              ///< index in the skin, as in pictures and PLY files of the deformed skin
  std::optional<Index> in_file;  ///< index in the mesh file, from 0
  Vec3 place = Vec3::Zero();     ///< at rest, mm
  double stiffness_n_per_mm = 0.0;
  std::string where;  ///< the clicked place in an examiner's terms; empty on a body without names
  std::optional<double> bone_depth_mm;
  std::string bone;  ///< the nearest one; empty without bones
  struct Scalar {
    std::string name;
    double value = 0.0;
  };
  std::vector<Scalar> scalars;  ///< in the order of the file
};

/// The data of the vertex nearest to a place on the skin at rest.
VertexReading readVertex(const scene::World& world, const Vec3& place);

/// A cross on it, at the present skin.
view::Lines vertexMark(const VertexReading& reading, const scene::World& world, const deform::DeformedSurface& surface);

/// Call for a world that is shown for the first time: the look keeps its scalar if the world has it, else gets the
/// first. Returns a message to the user; empty when the file has no data.
std::string adoptChannels(const scene::World& world, view::Look& look);

}  // namespace palpate::viewer
