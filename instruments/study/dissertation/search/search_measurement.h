// The octree as a search: for the touch point of a tip, and for the vertices that a deformation moves, against ours and
// against an exhaustive search.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/vec.h"

namespace palpate::study {

struct SearchPlan {
  std::vector<std::size_t> backs;  ///< triangles of the built-in back
  std::vector<Index> thresholds;   ///< thresholds of the octree; the first is the printed one
  int places = 60;
  int runs = 20;
};
SearchPlan searchPlan(bool quick);

/// One octree on one model; means over the places.
struct SearchRow {
  std::string model;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  Index threshold = 0;
  // The nearest point of the skin for a tip below it.
  double touch_all_us = 0.0;     ///< every triangle tested
  double touch_octree_us = 0.0;  ///< the triangles of the leaves within reach
  double touch_ours_us = 0.0;    ///< the engine's triangle tree
  double touch_tested = 0.0;     ///< triangles that the octree's leaves hold
  int touch_wrong = 0;           ///< places where the octree's point is not as near as that of all triangles
  // The vertices of an ellipse of 60 x 45 mm.
  double region_all_us = 0.0;
  double region_octree_us = 0.0;
  double region_rings_us = 0.0;  ///< ours, vertex by vertex
  double region_vertices = 0.0;  ///< found by us: connected with the contact and facing it
  double region_stray = 0.0;     ///< found by the octree in addition: other sheets of the body
  int region_missed = 0;         ///< among ours, those that the octree did not find
};

struct SearchMeasurement {
  SearchPlan plan;
  std::vector<SearchRow> rows;  ///< by model, then by threshold
};
SearchMeasurement measureSearches(const SearchPlan& plan, const Progress& progress);

// Findings of the searches' measurement: sentences made of nothing but its numbers.

/// Paragraphs, most important first.
std::vector<std::string> searchFindings(const SearchMeasurement& found);

}  // namespace palpate::study
