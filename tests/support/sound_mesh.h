// What every body that is touched must be.
#pragma once

#include <gtest/gtest.h>

#include "palpate/mesh/validate.h"

namespace palpate::support {

/// Closed, in one piece, fit to be touched and nowhere through itself. Returns what was found, for more to be asked.
inline mesh::ValidationReport expectOnePiece(const mesh::TriangleMesh& mesh) {
  mesh::ValidationReport report = mesh::validate(mesh);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.fit()) << (report.fit() ? "" : mesh::describe(report).front());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.self_intersections.count, 0u);
  return report;
}

}  // namespace palpate::support
