// A finger of the HDB source moved by hand in a test, beside finger_track.h.
#pragma once

#include <memory>

#include "core/tests/contact/finger_track.h"
#include "palpate/hdb/hdb_finger.h"

namespace palpate::hdb {

using namespace contact;  // NOLINT(google-build-using-namespace): tests of a finger read as those of contact do

inline std::shared_ptr<const hdb::Partition> buildTestPartition(const mesh::TriangleMesh& mesh,
                                                                const hdb::BuildSettings& settings = {}) {
  return std::make_shared<const hdb::Partition>(hdb::buildPartition(mesh::repair(mesh).mesh, settings));
}

/// A box that holds any of the test's bodies.
inline HdbSettings cubeSettings(double edge_mm, HdbQuery query = HdbQuery::triangles) {
  HdbSettings settings;
  settings.edges_mm = Vec3::Constant(edge_mm);
  settings.query = query;
  return settings;
}

/// A mesh with its surface and partition.
struct HdbBody {
  explicit HdbBody(const mesh::TriangleMesh& mesh, const HdbSettings& hdb = cubeSettings(1000.0),
                   const hdb::BuildSettings& build = {})
      : surface(surfaceOf(mesh)), hdb_surface(makeHdbSurface(surface, buildTestPartition(mesh, build), hdb)) {}
  Surface surface;
  std::shared_ptr<const HdbSurface> hdb_surface;
};

/// One finger and its memory.
class HdbTrack {
 public:
  explicit HdbTrack(const HdbBody& body, FingerSettings settings = {})
      : surface_(body.surface), settings_(settings), candidates_(body.hdb_surface) {}

  FingerOutput to(const Vec3& tip) { return stepHdb(surface_, settings_, candidates_, state_, tip); }

  /// Straight from the last tip to `end` in steps of at most `step_mm`; the last output.
  FingerOutput slide(const Vec3& end, double step_mm) { return slideFrom(state_.tip, end, step_mm, *this); }

  const FingerState& state() const { return state_; }
  const HdbCandidates& candidates() const { return candidates_; }

 private:
  const Surface& surface_;
  FingerSettings settings_;
  HdbCandidates candidates_;
  FingerState state_;
};

}  // namespace palpate::hdb
