// A law read backwards and forwards again is what it was.
#include "palpate/tissue/force_law.h"

#include <gtest/gtest.h>

#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_tissue.h"

namespace palpate::tissue {
namespace {

TEST(LawInverse, FindsTheDepthOfEveryLaw) {
  ForceLaw layered{.kind = ForceLaw::Kind::layered};
  layered.layers = LayeredTissue(libraryNodes(8.0)).forceRows();
  ForceLaw table{.kind = ForceLaw::Kind::table};
  table.table.rows = 2;
  table.table.depth_mm = {3.0, 8.0};
  table.table.effective_mm = {1.0, 9.0};
  for (const ForceLaw& law : {ForceLaw{}, ForceLaw{.kind = ForceLaw::Kind::power},
                              ForceLaw{.kind = ForceLaw::Kind::stiffening}, table, layered}) {
    for (const double tissue_mm : {6.0, 23.0, 80.0}) {
      for (const double depth : {0.003, 0.4, 2.0, 7.9, 15.0, 30.0}) {
        const double effective = normalForce(law, 1.0, depth, tissue_mm);
        EXPECT_NEAR(depthOf(law, effective, tissue_mm), depth, 1e-9 * (1.0 + depth))
            << static_cast<int>(law.kind) << " " << tissue_mm;
      }
    }
  }
}

TEST(LawInverse, FindsNoDepthForNothingAndAnEndForWhatIsNeverReached) {
  EXPECT_EQ(depthOf({}, 0.0), 0.0);
  EXPECT_EQ(depthOf({}, -1.0), 0.0);
  ForceLaw flat{.kind = ForceLaw::Kind::table};
  flat.table.rows = 2;
  flat.table.depth_mm = {3.0, 8.0};
  flat.table.effective_mm = {1.0, 1.0};
  EXPECT_EQ(depthOf(flat, 9.0), 1000.0);
}

}  // namespace
}  // namespace palpate::tissue
