// What docs/howto/embedding.md takes for given.
#pragma once

#include "palpate/deform/deformer.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/engine/live_simulator.h"
#include "palpate/engine/recorder.h"
#include "palpate/maps/ellipse_map.h"

namespace palpate::snippet {
extern const Vec3 tip;
extern const std::vector<float> xyz;
extern const std::vector<int> corners;
extern const std::vector<double> stiffness_per_vertex;
extern const scene::Scene scene;
extern const std::shared_ptr<const scene::World> world, other_world;
extern engine::LiveSimulator simulator;
extern const mesh::TriangleMesh mesh;
extern const contact::FingerOutput finger_output;
extern const maps::EllipseMap ellipse_map;
extern const deform::TissueSettings tissue;
extern deform::Deformer deformer;
extern deform::DeformedSurface surface;
template <class... Parts>
void upload(const Parts&... parts);
}  // namespace palpate::snippet
