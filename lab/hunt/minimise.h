// A failing path made short, and its body small: the same fault in as few ticks and triangles as can be found.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lab/hunt/hunt_world.h"

namespace palpate::lab {

/// The tick at which a path first shows the fault that is looked for, or nothing.
using FirstFault = std::function<std::optional<std::size_t>(std::span<const Vec3>)>;

/// Ends at the fault, begins at the latest tick from which it still comes, loses what can be left out between. At most
/// about `most_ticks` ticks are tried. A path without the fault is returned as it is.
std::vector<Vec3> minimised(std::vector<Vec3> tips, const FirstFault& first_fault, std::size_t most_ticks = 400000);

/// The same for a fault of a new finger along the path. No motion gets longer than the longest was, and a finger that
/// is free and outside at the path's start is so at the new one's.
std::vector<Vec3> minimised(HuntWorld& world, const contact::FingerSettings& finger, std::vector<Vec3> tips,
                            Fault fault);

struct SmallCase {
  mesh::TriangleMesh mesh;
  std::vector<Vec3> tips;
};

/// The path made short on the body, or on the body with so few triangles as still show a fault of that kind along the
/// path. `mesh` unrepaired; what is returned may be a repaired and reduced one.
SmallCase minimised(const mesh::TriangleMesh& mesh, const contact::FingerSettings& finger,
                    const std::vector<Vec3>& tips, Fault fault);

}  // namespace palpate::lab
