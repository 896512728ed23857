// What `palpate partition` prints: as a person reads it and as a script reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/palpate/partition_query.h"
#include "palpate/partition/statistics.h"

namespace palpate::app {

struct PartitionReport {
  std::string mesh;
  std::size_t triangles = 0;
  partition::BuildSettings settings;
  partition::PartitionStatistics statistics;
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

}  // namespace palpate::app
