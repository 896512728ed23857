// What the dissertation says in numbers but its own numbers contradict, and what needs the author's computer, scan or
// subjects. These rows inform; they do not decide whether the study holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/hdb/haptic_box.h"
#include "palpate/maps/measured_data.h"
#include "study/measured/model_meshes.h"
#include "study/numbers/numbers_study.h"
#include "study/numbers/printed_numbers.h"

namespace palpate::study {

namespace {

NumberRow inconsistent(const std::string& where, const std::string& what, const std::string& printed,
                       const std::string& ours, Erratum erratum, const std::string& reason) {
  return {.where = where,
          .what = what,
          .printed = printed,
          .ours = ours,
          .verdict = Verdict::inconsistent,
          .erratum = erratum,
          .reason = reason};
}

NumberRow notComputable(const std::string& where, const std::string& what, const std::string& printed, Erratum erratum,
                        const std::string& reason) {
  return {.where = where,
          .what = what,
          .printed = printed,
          .ours = "",
          .verdict = Verdict::not_computable,
          .erratum = erratum,
          .reason = reason};
}

NumberRow gridRow() {
  constexpr double kArea = 350.0 * 400.0;  // mm^2, of the box seen from behind
  const double step = std::sqrt(2.0 * kArea / static_cast<double>(kBackTriangles));
  return inconsistent("2.1, 5.1", "grid of the back, mm", "5", fmt::format("{:.1f}", step), Erratum::none,
                      fmt::format("350 x 400 mm in 2962 triangles; 5 mm would need {:.0f}", 2.0 * kArea / 25.0));
}

// What the leaves that meet the HDB hold, over every vertex of the back as the proxy.
struct LeafShare {
  double mean = 0.0;
  double most = 0.0;
};

LeafShare leafShare(const mesh::TriangleMesh& mesh, const hdb::Partition& tree) {
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

void addBackRows(Rows& rows) {
  const mesh::TriangleMesh back = backModel();
  hdb::BuildSettings settings;
  settings.tree = hdb::TreeKind::Bsp;
  const hdb::Partition tree = hdb::buildPartition(back, settings);
  const LeafShare share = leafShare(back, tree);
  rows.push_back(inconsistent("3.3.1", "best threshold", "1024", fmt::format("{} leaves", tree.leaves.size()),
                              Erratum::E13_misprints,
                              "leaves of our back of 2962 triangles: too few for a tree to matter"));
  rows.push_back(inconsistent("3.3.4", "triangles rendered while touching", "1/3",
                              fmt::format("{:.2f} mean, {:.2f} most", share.mean, share.most), Erratum::E12_box_edges,
                              "our back, BSP tree, 1024, HDB 1/4; against r = 0.1 in the same section"));
  const Vec3 box = tree.bounds.sizes();
  const double quarter_edge = 0.25 * box.maxCoeff();
  rows.push_back(inconsistent("3.3.4", "HDB volume over the model's box", "0.1 to 0.02",
                              fmt::format("{:.4f} or {:.4f}", std::pow(quarter_edge, 3.0) / box.prod(), 1.0 / 64.0),
                              Erratum::E12_box_edges,
                              "a quarter of the longest edge, or of each edge: an order of magnitude only"));
}

std::string percentRange(const Gain& gain) {
  return fmt::format("{:+.0f} to {:+.0f} %", 100.0 * gain.least, 100.0 * gain.most);
}

void addGains(const PrintedNumbers& printed, Rows& rows) {
  const PrintedTimings& octree = printed.appendix_b;
  const PrintedTimings& bsp = printed.table_3_2;
  const std::string reason = "rates of Appendix B over Table 3.2 at equal triangle counts";
  rows.push_back(inconsistent("3.4.2", "octree faster than BSP, touched", "10 to 20 %",
                              percentRange(rateGain(octree.touched, bsp.touched)), Erratum::none,
                              reason + ": understated"));
  rows.push_back(inconsistent("3.4.2", "octree faster than BSP, untouched", "10 to 20 %",
                              percentRange(rateGain(octree.untouched, bsp.untouched)), Erratum::none,
                              reason + ": understated"));
  rows.push_back(inconsistent("3.4.2", "octree against BSP, drawing", "almost the same",
                              percentRange(rateGain(octree.drawing, bsp.drawing)), Erratum::none,
                              reason + ": mostly slower"));
}

// How far the means of "down" are from those of "up" (E31).
void addDown(Rows& rows) {
  for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
    const auto up = maps::plainMean(maps::measuredAt(maps::ForceDirection::up, point));
    const auto down = maps::plainMean(maps::measuredAt(maps::ForceDirection::down, point));
    rows.push_back(inconsistent(fmt::format("Appendix C, P{}", point), "down against up", "similar",
                                fmt::format("{:+.0f} %, {:+.0f} degree", 100.0 * (down.major_cm / up.major_cm - 1.0),
                                            down.direction_deg - up.direction_deg),
                                Erratum::E31_down_like_up, "major axis and direction; down has three subjects only"));
  }
}

void addUnknown(Rows& rows) {
  const std::string computer = "needs the computer, driver and haptic library of 2008";
  rows.push_back(notComputable("Table 3.1", "frames a second of five models", "198 to 6", Erratum::none, computer));
  rows.push_back(notComputable("Table 3.2, Appendix B", "milliseconds", "2.6 to 142.9", Erratum::none, computer));
  rows.push_back(inconsistent("3.3.3", "bunny without BSP, FPS", "28", "104", Erratum::none,
                              "Table 3.1 gives 104 for its 2915 triangles: another setup"));
  rows.push_back(
      notComputable("3.3.3", "FPS with 35 and 650 triangles of the bunny", "955 and 49", Erratum::none, computer));
  rows.push_back(notComputable("6.1", "average FPS of 20389 triangles", "26", Erratum::none, computer));
  rows.push_back(notComputable("2.1", "vertices of the back", "1588", Erratum::none, "the scan was not published"));
  rows.push_back(inconsistent("4.5, Appendix A", "triangles of the hand", "2814", "2818", Erratum::E13_misprints,
                              "Appendix A counts 2818 with the same 1418 vertices"));
  rows.push_back(notComputable("4.1", "largest displacement, normal and tangential, mm", "10 and 20", Erratum::none,
                               "measured on people; taken as (4.15) and (4.17)"));
  rows.push_back(
      notComputable("2.4", "coefficients of friction", "0.46 and 0.44", Erratum::none, "quoted; taken as they are"));
  rows.push_back(notComputable("Figure 5.11", "map of the half major axis", "colours only", Erratum::E33_unnamed_radii,
                               "basic circle, effect radius and places on the real back are never given"));
}

}  // namespace

void addStatements(const PrintedNumbers& printed, Rows& rows) {
  rows.push_back(gridRow());
  addBackRows(rows);
  addGains(printed, rows);
  addDown(rows);
  addUnknown(rows);
}

}  // namespace palpate::study
