// What the tests of the contact bars share: worlds of benchmark meshes, and the switch for the long matrix.
//
// The normal suite covers every bar up to 200,000 triangles and the whole matrix of radii and scales on one mesh;
// PALPATE_HEAVY=1 (tools/test-heavy) adds the other sizes, to 4,000,000.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "lab/judges/invariant_check.h"
#include "lab/runs/contact_run.h"
#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "support/counted.h"

namespace palpate::bars {

inline bool heavy() {
  const char* value = std::getenv("PALPATE_HEAVY");
  return value != nullptr && std::string(value) == "1";
}

/// A point, and spheres up to a fingertip.
inline std::vector<double> radiiMm() { return {0.0, 0.5, 5.0, 8.0}; }

/// Real friction 0.46 / 0.44, k_t = k_n, shading off: the setting of every bar.
inline contact::FingerSettings makeBarFinger(double radius_mm) {
  contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  return finger;
}

inline bench::ContactWorld makeBarWorld(const std::string& mesh, double scale = 1.0) {
  return bench::buildContactWorld(lab::workloadMesh(mesh), scale);
}

/// Runs a benchmark path by name.
inline bench::ContactFigures measure(bench::ContactWorld& world, const std::string& path, double radius_mm = 0.0,
                                     const bench::Window& window = {}) {
  return bench::measureContact(world, lab::workloadPath(path), makeBarFinger(radius_mm), window);
}

/// Letters and digits only, as GoogleTest wants its names.
inline std::string testName(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return text;
}

}  // namespace palpate::bars
