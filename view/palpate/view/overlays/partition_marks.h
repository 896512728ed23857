// The dissertation's partition, drawn: leaves, splitting planes, and what the detecting box of a finger meets
// (Fig 3.6).
#pragma once

#include <memory>

#include "palpate/contact/finger_state.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/partition.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// A partition of the world's skin, and the edges of the detecting box.
struct ShownPartition {
  std::shared_ptr<const hdb::Partition> partition;
  Vec3 box_edges_mm = Vec3::Zero();
};

/// The one that fingers of this world touch through; built from the scene's settings when they do not.
ShownPartition partitionOf(const scene::World& world);

/// The cells of the leaves, blue.
void addLeafBoxes(const hdb::Partition& partition, Lines& lines);

/// Every splitting plane within its cell: square to x green, to y red, to z yellow; fainter level by level.
void addPlanes(const hdb::Partition& partition, Lines& lines, Patches& patches);

/// The box round the finger's proxy.
void addDetectingBox(const ShownPartition& shown, const contact::FingerOutput& contact, Lines& lines);

/// The triangles of all leaves that the box meets, green: what the haptic process works on.
void addHapticTriangles(const ShownPartition& shown, const scene::World& world, const DrawnSkin& skin,
                        const contact::FingerOutput& contact, Patches& patches);

}  // namespace palpate::view
