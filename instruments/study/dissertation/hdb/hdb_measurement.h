// The study of the detecting box: its cost for every size, and when a finger gets through.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lab/measured/haptic_frames.h"
#include "palpate/hdb/hdb_candidates.h"
#include "report/page/study_page.h"

namespace palpate::study {

// The four ways to keep what may be touched, on the same strokes: what each list holds, tests, takes and costs.

/// One way to keep the list on one model. All counts are means over the ticks of the strokes.
struct ListRow {
  std::size_t model = 0;  ///< triangles
  hdb::HdbQuery query = hdb::HdbQuery::leaves;
  double listed = 0.0;
  double asked = 0.0;   ///< share of the ticks in which the partition was asked or the list moved
  double moved = 0.0;   ///< boxes tested to make the linked list follow
  double tested = 0.0;  ///< boxes tested to find triangles near the finger
  double tick_us = 0.0;
  double make_us = 0.0;  ///< the list's room and first state, once per finger
  double bytes = 0.0;    ///< memory of a finger's list
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

/// The row of that model and way; null if it was not measured.
const ListRow* findListRow(const ListCosts& costs, std::size_t model, hdb::HdbQuery query);

inline constexpr double kTenth = 0.1;  ///< the dissertation's example of a box that is too small

struct HdbPlan {
  std::size_t triangles = 41582;
  int places = 40;  ///< where costs are measured
  int runs = 3;
  int strokes = 40;  ///< strokes per speed
  std::vector<double> shares{1.0 / 16, 1.0 / 12, 1.0 / 10, 1.0 / 8, 1.0 / 6,
                             1.0 / 4,  1.0 / 3,  1.0 / 2,  3.0 / 4, 1.0};  ///< box edge over the model's longest edge
  std::vector<double> edges_mm{2, 4, 6, 8, 12, 16, 20, 25, 33, 40, 50, 66, 100, 200};  ///< edges for the punctures
  std::vector<double> speeds_mm_s{100, 200, 500, 1000, 2000};
  std::vector<int> delays_ticks{10, 20, 50};
  std::vector<double> depths_mm{1, 2, 4, 8, 12, 20};             ///< depths for the margins
  std::vector<double> margin_shares{0.0, 0.25, 0.5, 0.75, 1.0};  ///< margin over depth
  std::size_t fine_triangles = 200000;                           ///< size of the model that E12's rule is tried on
  ListPlan lists{};
};

HdbPlan hdbPlan(bool quick);

inline double metresPerSecond(double mm_s) { return 1e-3 * mm_s; }

/// One size of box.
struct HdbSizeRow {
  double share = 0.0;
  double edge_mm = 0.0;
  double bsp_triangles = 0.0;  ///< triangles of the leaves that it meets
  double octree_triangles = 0.0;
  double exact_triangles = 0.0;
  double bsp_us = 0.0;  ///< a frame of the dissertation's haptic process, touched
  double octree_us = 0.0;
  double exact_us = 0.0;  ///< our exact query
};

/// One size of box, speed and delay.
struct PunctureRow {
  double edge_mm = 0.0;
  double speed_mm_s = 0.0;
  int delay_ticks = 0;
  bool leaves = false;     ///< all triangles of the leaves that the box meets, not only those that it meets itself
  double punctured = 0.0;  ///< share of the strokes
  double triangles = 0.0;  ///< in the list while touching

  /// Half the edge over the way of the finger until the box follows.
  double lead() const { return 0.5 * edge_mm / (speed_mm_s * 1e-3 * delay_ticks); }
};

/// One margin of the box beyond the way of the finger, over all speeds and delays.
struct MarginRow {
  double depth_mm = 0.0;
  double share = 0.0;      ///< margin over depth
  double punctured = 0.0;  ///< share of the strokes
};

struct HdbMeasurement {
  HdbPlan plan;
  double longest_edge = 0.0;  ///< longest edge of the model, mm
  double depth_mm = 0.0;      ///< depth of the strokes
  double tick_us = 0.0;       ///< tick of the default finger
  std::vector<HdbSizeRow> sizes{};
  std::vector<PunctureRow> punctures{};       ///< delay 10 ticks, all edges, triangles of the box
  std::vector<PunctureRow> leaf_punctures{};  ///< the same with the octree's leaves
  std::vector<PunctureRow> leads{};           ///< all delays, edges chosen by their lead
  std::vector<MarginRow> margins{};           ///< edge = 2 (speed x delay + margin)
  std::vector<PunctureRow> recommended{};     ///< all delays, edges by hdb::leastHdbEdge, strokes never seen before
  double fine_triangle_edge = 0.0;            ///< the longest edge of any triangle of the fine model, mm
  std::vector<PunctureRow> fine_e12{};        ///< the same on the fine model with E12's rule: the longest triangle edge
  std::vector<PunctureRow> fine_recommended{};  ///< and with ours: the depth
  double else_if_punctured = 0.0;  ///< with the printed traversal (E4), no delay: the least over kElseIfShares
  ListCosts lists{};               ///< the ways to keep what may be touched (6.2, item 4)
};

/// Sizes of box that the printed traversal is tried with, over the model's longest edge.
inline constexpr double kElseIfShares[] = {1.0 / 16.0, 1.0 / 4.0, 1.0};

/// The fastest finger, mm/s, for which a box of this edge is large enough by hdb::leastHdbEdge, our rule in place of
/// 1/4 (E12); 0 when it is for none.
double safeSpeed(double edge_mm, double delay_s, double depth_mm);

/// The row of the dissertation's size, or of the nearest one.
const HdbSizeRow& quarterRow(const HdbMeasurement& found);

HdbMeasurement measureHdbSizes(const HdbPlan& plan, const Progress& progress);

/// Figures of the measurement (hdb_figures.cpp).
std::vector<StudyFigure> hdbFigures(const HdbMeasurement& found);

// Findings from the strokes and the costs about the detecting box: sentences made of nothing but the measurement.

/// Paragraphs, most important first.
std::vector<std::string> hdbFindings(const HdbMeasurement& found);

/// The largest and the smallest share of punctured strokes among the rows of these leads; 0 and 1 without rows.
double mostPunctured(const std::vector<PunctureRow>& rows, double from_lead = 0.0, double to_lead = 1e9);
double leastPunctured(const std::vector<PunctureRow>& rows, double to_lead);

/// The row of that speed and delay, or of the nearest one.
const PunctureRow& rowAt(const std::vector<PunctureRow>& rows, double speed_mm_s, int delay_ticks);

/// The smallest margin over depth that held all strokes of every depth; infinite where none did.
double safeMargin(const HdbMeasurement& found);

}  // namespace palpate::study
