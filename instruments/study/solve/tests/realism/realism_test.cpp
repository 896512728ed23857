// The product's own run-time path against finite elements that somebody else solved: an independent prototype's presses
// (tests/data/golden/fem_profiles.json), whose tables are handed to the body.
#include "solve/realism/realism.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "palpate/elements/finger_solver.h"
#include "palpate/tissue/layered_library.h"
#include "support/places.h"

namespace palpate::lab {
namespace {

/// A table a stack, of the depths that the file has.
std::map<std::string, tissue::LayeredTable> makeTables(const FemCases& cases) {
  std::map<std::string, tissue::LayeredTable> tables;
  for (const FemCase& one : cases.cases) {
    tissue::LayeredTable& table = tables[one.name];
    table.stack = one.stack;
    table.radii_mm = cases.radii_mm;
    table.shapes.push_back(one.truth);
  }
  return tables;
}

TEST(Realism, TheSkinOverLayersIsThatOfFiniteElements) {
  const FemCases cases = readFemCases(support::testData() / "golden/fem_profiles.json");
  EXPECT_EQ(cases.left_out.size(), 4u) << "sticking";
  const auto tables = makeTables(cases);
  for (const FemCase& one : cases.cases) {
    const auto layered =
        std::make_shared<const tissue::LayeredTissue>(std::vector{tissue::nodeOf(tables.at(one.name))});
    const auto world = flatWorld(scene::TissueModel::layered, layered, layered->thickest(), 0.5);
    const PressError error = pressError(*world, one, cases.radii_mm);
    fmt::print("{} {} mm: normal {:.4f} vector {:.4f} worst {:.4f} force {:.3f} of {:.3f}: {:+.3f}\n", one.name,
               one.truth.depth_mm, error.shape.normal_rms, error.shape.vector_rms, error.shape.worst, error.force_n,
               one.truth.force_n, error.force_error);
    if (!isLayered(one.stack) || one.truth.depth_mm < 5.0) continue;
    EXPECT_LE(error.shape.normal_rms, 0.015) << one.name << " " << one.truth.depth_mm;
    EXPECT_LE(error.shape.vector_rms, 0.02) << one.name << " " << one.truth.depth_mm;
    EXPECT_LE(std::abs(error.force_error), 0.1) << one.name << " " << one.truth.depth_mm;
  }
}

/// Beside the spine, blended from the shipped stacks; the truth is solved here. `palpate tissue realism --radius` goes
/// over six places and five radii.
TEST(Realism, TheForceOnAFingerIsThatOfASphereOfItsRadius) {
  const auto layered = std::make_shared<const tissue::LayeredTissue>(tissue::libraryNodes(8.0));
  const tissue::LayerStack stack = tissue::libraryStack(35.0, tissue::libraryFatShare(35.0, 8.0));
  const auto world =
      flatWorld(scene::TissueModel::layered, layered, 35.0, layered->secantAt(35.0, tissue::kReferenceDepthMm));
  for (const double radius : {4.0, 12.0, 16.0}) {
    const elements::PressSolution truth = elements::solvePress(stack, elements::settingsOf(radius, {2.0, 5.0, 8.0}));
    ASSERT_EQ(truth.table.shapes.size(), 3u) << truth.stopped_by;
    for (const tissue::PressedShape& shape : truth.table.shapes) {
      const double felt = pressedForce(*world, radius, shape.depth_mm);
      EXPECT_NEAR(felt / shape.force_n, 1.0, 0.05) << radius << " mm at " << shape.depth_mm;
    }
  }
}

}  // namespace
}  // namespace palpate::lab
