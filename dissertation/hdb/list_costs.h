// The four ways to keep what may be touched, on the same strokes: what each list holds, tests, takes and costs.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/hdb/hdb_candidates.h"

namespace palpate::study {

/// One way to keep the list on one model. All counts are means over the ticks of the strokes.
struct ListRow {
  std::size_t model = 0;  ///< triangles
  hdb::HdbQuery query = hdb::HdbQuery::leaves;
  double listed = 0.0;
  double asked = 0.0;   ///< share of the ticks in which the partition was asked or the list moved
  double moved = 0.0;   ///< boxes tested to make the linked list follow
  double tested = 0.0;  ///< boxes tested to find what is near the finger
  double tick_us = 0.0;
  double make_us = 0.0;  ///< the list's room and first state, once per finger
  double bytes = 0.0;    ///< of a finger's list
  bool same = false;     ///< every force and proxy is the default finger's, to the bit
};

struct ListCosts {
  std::vector<ListRow> rows;
  std::vector<std::size_t> models;
  std::vector<double> default_us;  ///< a tick of the default finger, per model
  std::vector<double> build_us;    ///< the partition that all of them share, per model
};

struct ListPlan {
  std::vector<std::size_t> models{2962, 41582, 200000};
  int strokes = 12;
  int runs = 3;
};

ListCosts measureLists(const ListPlan& plan);

/// The row of that model and way; null where there is none.
const ListRow* rowOf(const ListCosts& costs, std::size_t model, hdb::HdbQuery query);

}  // namespace palpate::study
