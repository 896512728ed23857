// The dissertation's statements in words or ranges, compared with its own numbers and our models, and those that need
// the author's computer, scan or subjects. A statement that does not hold informs; it does not decide whether the study
// holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dissertation/numbers/numbers_study.h"
#include "dissertation/numbers/printed_numbers.h"
#include "lab/measured/model_meshes.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/maps/measured_data.h"

namespace palpate::study {

namespace {

/// A statement of the text that is not a single number, and our result.
struct Statement {
  std::string where;
  std::string what;
  std::string printed;
  std::string ours;
  std::string tolerance;  ///< condition of the statement
  Source source = Source::printed;
  Erratum erratum = Erratum::none;
  std::string reason;
};

NumberRow statementRow(Statement statement, bool holds) {
  return {.where = std::move(statement.where),
          .what = std::move(statement.what),
          .printed = std::move(statement.printed),
          .ours = std::move(statement.ours),
          .verdict = holds ? reproducedFrom(statement.source) : Verdict::inconsistent,
          .erratum = holds ? Erratum::none : statement.erratum,
          .reason = std::move(statement.reason),
          .tolerance = std::move(statement.tolerance)};
}

NumberRow notComputable(const std::string& where, const std::string& what, const std::string& printed, Erratum erratum,
                        const std::string& reason) {
  return {.where = where,
          .what = what,
          .printed = printed,
          .ours = "",
          .verdict = Verdict::not_computable,
          .erratum = erratum,
          .reason = reason,
          .tolerance = ""};
}

NumberRow gridRow(const PrintedNumbers& printed) {
  constexpr double kArea = 350.0 * 400.0;  // mm^2, of the box seen from behind
  const double step = std::sqrt(2.0 * kArea / static_cast<double>(kBackTriangles));
  return statementRow({.where = "2.1, 5.1",
                       .what = "grid of the back, mm",
                       .printed = printed.back_grid_mm,
                       .ours = fmt::format("{:.1f}", step),
                       .tolerance = "rounding",
                       .reason = fmt::format("350 x 400 mm in {} triangles; 5 mm would need {:.0f}", kBackTriangles,
                                             2.0 * kArea / 25.0)},
                      agrees(printed.back_grid_mm, step));
}

// Contents of the leaves that meet the HDB, over every vertex of the back as the proxy.
struct LeafShare {
  double mean = 0.0;
  double most = 0.0;
};

LeafShare measureLeafShare(const mesh::TriangleMesh& mesh, const hdb::Partition& tree) {
  const Vec3 edges = hdb::hdbEdges(tree.bounds);
  hdb::LeafHits hits;
  hits.prepareFor(tree);
  LeafShare share;
  for (const Vec3& proxy : mesh.positions) {
    hdb::findLeaves(tree, hdb::hapticBox(proxy, edges), hits);
    const double part =
        static_cast<double>(hdb::entriesIn(tree, hits.leaves)) / static_cast<double>(mesh.triangles.size());
    share.mean += part / static_cast<double>(mesh.positions.size());
    share.most = std::max(share.most, part);
  }
  return share;
}

void addBackRows(const PrintedNumbers& printed, Rows& rows) {
  const mesh::TriangleMesh back = backModel();
  hdb::BuildSettings settings;
  settings.tree = hdb::TreeKind::Bsp;
  const hdb::Partition tree = hdb::buildPartition(back, settings);
  const double most_leaves = parsePrinted(printed.largest_share_of_leaves).value;
  const double fewest = std::round(1.0 / most_leaves);
  rows.push_back(statementRow(
      {.where = "3.3.1",
       .what = "best threshold",
       .printed = "1024",
       .ours = fmt::format("{} leaves", tree.leaves.size()),
       .tolerance = fmt::format("{:.0f} leaves: one of them is r = {} of all", fewest, printed.largest_share_of_leaves),
       .source = Source::engine,
       .erratum = Erratum::E13_misprints,
       .reason = fmt::format("leaves of our back of {} triangles", kBackTriangles)},
      static_cast<double>(tree.leaves.size()) >= fewest));
  const LeafShare share = measureLeafShare(back, tree);
  rows.push_back(
      statementRow({.where = "3.3.4",
                    .what = "triangles rendered while touching",
                    .printed = "1/3",
                    .ours = fmt::format("{:.2f} mean, {:.2f} most", share.mean, share.most),
                    .tolerance = fmt::format("the r = {} of the same section", printed.largest_share_of_leaves),
                    .source = Source::engine,
                    .erratum = Erratum::E12_box_edges,
                    .reason = "our back, BSP tree, 1024, HDB 1/4"},
                   share.most <= most_leaves));
  const Vec3 box = tree.bounds.sizes();
  const double of_longest_edge = std::pow(0.25 * box.maxCoeff(), 3.0) / box.prod();
  constexpr double kOfEachEdge = 1.0 / 64.0;
  constexpr double kMin = 0.02;
  constexpr double kMax = 0.1;
  rows.push_back(statementRow({.where = "3.3.4",
                               .what = "HDB volume over the model's box",
                               .printed = "0.1 to 0.02",
                               .ours = fmt::format("{:.4f} or {:.4f}", of_longest_edge, kOfEachEdge),
                               .tolerance = fmt::format("{} to {}", kMin, kMax),
                               .source = Source::engine,
                               .erratum = Erratum::E12_box_edges,
                               .reason = "a quarter of the longest edge, or of each edge"},
                              of_longest_edge <= kMax && kOfEachEdge >= kMin));
}

std::string percentRange(const Gain& gain) {
  return fmt::format("{:+.0f} to {:+.0f} %", 100.0 * gain.least, 100.0 * gain.most);
}

bool within(const Gain& gain, double least, double most) { return gain.least >= least && gain.most <= most; }

void addGain(const std::string& what, const std::string& printed, const Gain& gain, double least, double most,
             Rows& rows) {
  rows.push_back(statementRow({.where = "3.4.2",
                               .what = what,
                               .printed = printed,
                               .ours = percentRange(gain),
                               .tolerance = fmt::format("{:+.0f} to {:+.0f} %", 100.0 * least, 100.0 * most),
                               .reason = "rates of Appendix B over Table 3.2 at equal triangle counts"},
                              within(gain, least, most)));
}

void addGains(const PrintedNumbers& printed, Rows& rows) {
  const PrintedTimings& octree = printed.appendix_b;
  const PrintedTimings& bsp = printed.table_3_2;
  const std::string claim = "10 to 20 %";
  addGain("octree faster than BSP, touched", claim, rateGain(octree.touched, bsp.touched), 0.1, 0.2, rows);
  addGain("octree faster than BSP, untouched", claim, rateGain(octree.untouched, bsp.untouched), 0.1, 0.2, rows);
  addGain("octree against BSP, drawing", "almost the same", rateGain(octree.drawing, bsp.drawing), -0.1, 0.1, rows);
}

// How far the means of "down" are from those of "up" (E31).
void addDown(Rows& rows) {
  constexpr double kSimilarPercent = 10.0;
  constexpr double kSimilarDeg = 10.0;
  for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
    const auto up = maps::plainMean(maps::measuredAt(maps::ForceDirection::up, point));
    const auto down = maps::plainMean(maps::measuredAt(maps::ForceDirection::down, point));
    const double larger = 100.0 * (down.major_cm / up.major_cm - 1.0);
    const double turned = down.direction_deg - up.direction_deg;
    rows.push_back(statementRow({.where = fmt::format("Appendix C, P{}", point),
                                 .what = "down against up",
                                 .printed = "similar",
                                 .ours = fmt::format("{:+.0f} %, {:+.0f} degree", larger, turned),
                                 .tolerance = fmt::format("{:g} % and {:g} degree", kSimilarPercent, kSimilarDeg),
                                 .erratum = Erratum::E31_down_like_up,
                                 .reason = "major axis and direction; down has three subjects only"},
                                std::abs(larger) <= kSimilarPercent && std::abs(turned) <= kSimilarDeg));
  }
}

// Two places of the text about the same thing.
void addTwice(const std::string& where, const std::string& what, const std::string& here, double there, Erratum erratum,
              const std::string& reason, Rows& rows) {
  rows.push_back(statementRow({.where = where,
                               .what = what,
                               .printed = here,
                               .ours = fmt::format("{:g}", there),
                               .tolerance = "the same number",
                               .erratum = erratum,
                               .reason = reason},
                              agrees(here, there)));
}

void addUnknown(const PrintedNumbers& printed, Rows& rows) {
  const std::string computer = "needs the computer, driver and haptic library of 2008";
  rows.push_back(notComputable("Table 3.1", "frames a second of five models", "198 to 6", Erratum::none, computer));
  rows.push_back(notComputable("Table 3.2, Appendix B", "milliseconds", "2.6 to 142.9", Erratum::none, computer));
  addTwice("3.3.3", "bunny without BSP, FPS", printed.bunny_fps, printed.table_3_1.front().haptic_fps, Erratum::none,
           "Table 3.1, for its 2915 triangles", rows);
  rows.push_back(
      notComputable("3.3.3", "FPS with 35 and 650 triangles of the bunny", "955 and 49", Erratum::none, computer));
  rows.push_back(notComputable("6.1", "average FPS of 20389 triangles", "26", Erratum::none, computer));
  rows.push_back(notComputable("2.1", "vertices of the back", "1588", Erratum::none, "the scan was not published"));
  addTwice("4.5, Appendix A", "triangles of the hand", printed.hand_triangles, printed.hand_triangles_appendix_a,
           Erratum::E13_misprints, "Appendix A, with the same 1418 vertices", rows);
  rows.push_back(notComputable("4.1", "largest displacement, normal and tangential, mm", "10 and 20", Erratum::none,
                               "measured on people; taken as (4.15) and (4.17)"));
  rows.push_back(
      notComputable("2.4", "coefficients of friction", "0.46 and 0.44", Erratum::none, "quoted; taken as they are"));
  rows.push_back(notComputable("Figure 5.11", "map of the half major axis", "colours only", Erratum::E33_unnamed_radii,
                               "basic circle, effect radius and places on the real back are never given"));
}

}  // namespace

void addStatements(const PrintedNumbers& printed, Rows& rows) {
  rows.push_back(gridRow(printed));
  addBackRows(printed, rows);
  addGains(printed, rows);
  addDown(rows);
  addUnknown(printed, rows);
}

}  // namespace palpate::study
