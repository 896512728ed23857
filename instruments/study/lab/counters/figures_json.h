// Measured figures as JSON.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>

#include "lab/counters/statistics.h"
#include "lab/counters/thread_counts.h"
#include "palpate/base/json.h"

namespace palpate::lab {

/// {p50, p99, p99_9, max}
inline Json percentilesJson(const Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p99_9", p.p99_9}, {"max", p.max}};
}

/// null: it could not be counted.
inline Json countJson(const std::optional<std::uint64_t>& count) { return count ? Json(*count) : Json(nullptr); }

/// Adds allocations, locks and page_faults.
inline void addCounts(Json& json, const ThreadCounts& counts) {
  json["allocations"] = countJson(counts.allocations);
  json["locks"] = countJson(counts.locks);
  json["page_faults"] = countJson(counts.page_faults);
}

/// 16 digits; a number of JSON holds 15.
inline std::string hashText(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace palpate::lab
