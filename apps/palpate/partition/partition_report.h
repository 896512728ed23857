// What `palpate partition` gives out: a report as a person reads it and as a script reads it, and coloured surfaces.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/palpate/partition/partition_query.h"
#include "palpate/hdb/statistics.h"

namespace palpate::app {

struct PartitionReport {
  std::string mesh;
  std::size_t triangles = 0;
  hdb::BuildSettings settings;
  hdb::PartitionStatistics statistics;
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
nlohmann::ordered_json jsonOf(const PartitionReport& report);

// As PLY files: partition_pictures.cpp.

/// Every entry - with the cut every piece - in the colour of its leaf; neighbours in the tree differ clearly. Throws
/// Error.
void writeLeafColours(const std::filesystem::path& file, const mesh::TriangleMesh& mesh,
                      const hdb::Partition& partition);

/// The mesh in grey, the triangles of the leaves in green (as Figures 3.8 and 3.9 have them), those that really meet
/// the box in orange; `exact` is ascending. Throws Error.
void writeSelection(const std::filesystem::path& file, const mesh::TriangleMesh& mesh, const hdb::Partition& partition,
                    const std::vector<Index>& leaves, const std::vector<Index>& exact);

}  // namespace palpate::app
