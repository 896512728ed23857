// Output of `palpate study partition`: one detecting box on a partition, checked by brute force, a report for people
// and for scripts, and coloured surfaces.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lab/counters/statistics.h"
#include "lab/runs/partition_statistics.h"
#include "palpate/base/json.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/literal_traversal.h"
#include "report/charts/figure.h"

namespace palpate::app {

// One box, for --box: partition_query.cpp.

/// Search for leaves: as the engine does, by the sphere within the box (tested properly), or as printed.
struct LeafSearch {
  bool sphere = false;
  std::optional<hdb::LiteralTraversal> literal;

  friend bool operator==(const LeafSearch&, const LeafSearch&) = default;

  bool bySphere() const { return sphere || literal == hdb::LiteralTraversal::SphereCorners; }
};

struct PartitionQuery {
  hdb::LeafHits leaves;
  std::size_t rendered = 0;            ///< entries of the leaves: what the dissertation's haptic process draws
  std::size_t rendered_triangles = 0;  ///< different ones
  std::vector<Index> exact;            ///< triangles whose box meets the detecting box, ascending
  std::size_t must = 0;                ///< triangles that the leaves must have, by brute force
  std::size_t missed = 0;              ///< those not in any leaf found
  lab::Percentiles leaves_us;
  lab::Percentiles exact_us;
};

/// With a sphere `must` counts the triangles whose box reaches into it.
PartitionQuery askPartition(const mesh::TriangleMesh& mesh, const hdb::Partition& partition, const Box3& box,
                            const LeafSearch& search);

// The report: partition_report.cpp.

struct PartitionReport {
  std::string mesh;
  std::size_t triangles = 0;
  hdb::BuildSettings settings;
  bench::PartitionStatistics statistics;
  double build_seconds = 0.0;
  std::optional<std::size_t> lost;  ///< by the printed octree rule (E6)

  struct Box {
    Vec3 centre_mm = Vec3::Zero();
    Vec3 edges_mm = Vec3::Zero();
    std::string traversal;
    PartitionQuery query;
  };
  std::optional<Box> box;
};

std::string textOf(const PartitionReport& report);
Json toJson(const PartitionReport& report);

// Picture: partition_figure.cpp.

/// Where a partition is looked at from.
struct PartitionSight {
  Vec3 towards_viewer = Vec3(0.5, 0.35, 1.0);  ///< from behind, a little from above and the patient's right
  Vec3 up = Vec3::UnitY();
};

/// The body with each leaf in a colour of its own and the leaves' boxes round them; with a box, a second panel shows
/// it, its leaves in green and its exact triangles in orange.
figures::Figure partitionFigure(const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                                const PartitionReport& report, const PartitionSight& sight = {});

/// Whether the name is a picture's, .svg or else .png. Throws Error for another.
bool isSvgPicture(const std::filesystem::path& file);

// PLY files: partition_pictures.cpp.

/// Colour of the leaf with this number; neighbours in the list differ clearly.
std::array<std::uint8_t, 3> leafColour(std::size_t number);

/// Every entry - with the cut every piece - in the colour of its leaf; neighbours in the tree differ clearly. Throws
/// Error.
void writeLeafColours(const std::filesystem::path& file, const mesh::TriangleMesh& mesh,
                      const hdb::Partition& partition);

/// The mesh in grey, the triangles of the leaves in green (as Figures 3.8 and 3.9 have them), those that really meet
/// the box in orange; `exact` is ascending. Throws Error.
void writeSelection(const std::filesystem::path& file, const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                    const std::vector<Index>& leaves, const std::vector<Index>& exact);

}  // namespace palpate::app
