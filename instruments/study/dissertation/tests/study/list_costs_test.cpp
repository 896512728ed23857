#include "dissertation/hdb/hdb_measurement.h"

#include <gtest/gtest.h>

namespace palpate::study {

namespace {

TEST(ListCosts, FeelTheSameAndTestLessFromListToList) {
  const ListCosts costs = measureLists({.models = {8163}, .strokes = 3, .runs = 1});
  ASSERT_EQ(costs.rows.size(), 4u);
  for (const ListRow& row : costs.rows) EXPECT_TRUE(row.same) << static_cast<int>(row.query);
  const std::size_t model = costs.models.front();
  const ListRow& leaves = *findListRow(costs, model, hdb::HdbQuery::leaves);
  const ListRow& exact = *findListRow(costs, model, hdb::HdbQuery::triangles);
  const ListRow& coherent = *findListRow(costs, model, hdb::HdbQuery::coherent);
  const ListRow& linked = *findListRow(costs, model, hdb::HdbQuery::linked);
  EXPECT_DOUBLE_EQ(linked.listed, exact.listed);  // no margin
  EXPECT_GT(coherent.listed, exact.listed);
  EXPECT_GT(leaves.listed, exact.listed);
  EXPECT_LT(linked.tested, 0.2 * exact.tested);
  EXPECT_GT(linked.moved, 0.0);
  EXPECT_LT(linked.bytes, exact.bytes);
  EXPECT_LT(coherent.asked, 0.2);
  EXPECT_EQ(findListRow(costs, 5, hdb::HdbQuery::linked), nullptr);
}

}  // namespace
}  // namespace palpate::study
