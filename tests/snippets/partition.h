// What docs/howto/partition.md takes for given.
#pragma once

#include "palpate/engine/servo_thread.h"
#include "palpate/engine/world_builder.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/hdb/hdb_finger.h"
#include "palpate/hdb/partition.h"

namespace palpate::snippet {
extern const mesh::TriangleMesh mesh;
extern const Vec3 proxy;
void collide(Index triangle);
extern const contact::Surface surface;
extern const contact::FingerSettings settings;
extern const Vec3 tip;
extern engine::WorldBuilder builder;
extern const scene::Scene scene_with_other_partition;
extern const std::shared_ptr<const scene::World> world;
extern const std::optional<engine::BuildResult> result;
extern const std::vector<contact::FingerSettings> fingers;
extern engine::ServoThread servo;
}  // namespace palpate::snippet
