// What a finger has to ask of a surface in each tick, recorded from a run of ours, so that other libraries can be timed
// on the very same questions.
//
// Point finger: where it touches, the nearest point of the skin to the tip, and whether the way from the old proxy to
// the new one is free (lifted off the skin, for both ends lie on it); in free space, whether the way of the tip is
// free. Sphere: the nearest point to its centre within its radius, and whether the way of the centre is free.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "bench/contact_run.h"

namespace palpate::bench {

struct ContactQuery {
  Vec3 point = Vec3::Zero();  ///< whose nearest point of the surface is wanted
  double reach = 0.0;         ///< within this distance; 0: not asked
  double bound = 0.0;         ///< <= reach: what the finger knows of the distance from its last tick
  Vec3 from = Vec3::Zero();   ///< a segment that may cross the surface, from either side
  Vec3 to = Vec3::Zero();
  Vec3 proxy = Vec3::Zero();  ///< where the finger was before this tick: the centre of a detecting box
};

struct ContactAnswer {
  double distance = std::numeric_limits<double>::infinity();  ///< of the nearest point; infinite: none, or not asked
  bool crosses = false;
};

/// One query a tick of the window, in the world's units. `finger` has real lengths.
std::vector<ContactQuery> contactQueries(const ContactWorld& world, const FingerRun& run,
                                         const contact::FingerSettings& finger, std::span<const double> time_s,
                                         const Window& window);

/// By our own tree, exactly: what the peers should say.
ContactAnswer exactAnswer(const partition::TriangleTree& tree, const ContactQuery& query);

}  // namespace palpate::bench
