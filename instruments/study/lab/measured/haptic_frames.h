// Cost of a frame of the haptic process on a model: in the dissertation's way (literal_process.h) and in ours.
#pragma once

#include <vector>

#include "lab/literal/mesh.h"
#include "lab/measured/model_meshes.h"
#include "palpate/base/skin_place.h"
#include "palpate/contact/surface.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::study {

/// The dissertation's choice: at most this many triangles a leaf (3.3.1: "proved as the best value in our experiments")
/// and a box whose edge is this share of the model's longest (3.3.3).
inline constexpr Index kPrintedThreshold = 1024;
inline constexpr double kPrintedBoxShare = 0.25;

/// The benchmark's back of a size, and where it is touched.
struct HapticModel {
  mesh::TriangleMesh mesh;
  bench::literal::Mesh literal;
  std::vector<SkinPlace> places;
  double longest_edge = 0.0;  ///< longest of its box, mm
};

HapticModel hapticModel(std::size_t triangles, int places);

/// The parts of a frame, us, and how many triangles it rendered.
struct FrameTimes {
  double triangles = 0.0;
  double find_us = 0.0;     ///< the leaves that the box meets
  double collide_us = 0.0;  ///< every triangle against the tip's way
  double force_us = 0.0;    ///< the nearest point of every triangle

  double untouchedMicroseconds() const { return find_us + collide_us; }
  double touchedMicroseconds() const { return find_us + collide_us + force_us; }
};

/// A frame at one place: the finger 5 mm deep, come from 1 mm above the skin. The fastest of `runs` runs counts, part
/// by part. Without a partition the whole model is rendered.
FrameTimes literalFrame(const HapticModel& model, const hdb::Partition* partition, double edge_mm,
                        const SkinPlace& place, int runs);

/// The mean over all places of the model.
FrameTimes meanLiteralFrame(const HapticModel& model, const hdb::Partition* partition, double edge_mm, int runs);

/// Ours, with a box: the triangles that it meets, exactly, written out one by one. Mean over the places.
struct ExactFrame {
  double triangles = 0.0;
  double find_us = 0.0;
};
ExactFrame meanExactFrame(const HapticModel& model, const hdb::Partition& partition, double edge_mm, int runs);

/// Ours, without a box: the mean time of a tick of the default finger on strokes at 200 mm/s, us.
double meanTickMicroseconds(const contact::Surface& surface, int runs);

/// The same stiffness everywhere.
contact::Surface contactSurface(const mesh::TriangleMesh& mesh);

}  // namespace palpate::study
