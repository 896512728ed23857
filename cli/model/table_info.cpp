// The table is read as a replay reads it, so what is said here is what will be seen there.
#include "cli/model/table_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/trace/forces_table.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

std::vector<trace::RecordedFinger> fingersOf(const fs::path& file) {
  if (trace::isForcesTable(file)) return trace::readForcesTable(file);
  if (!fs::exists(file)) throw Error::inFile(file.string(), "no such file");
  throw Error::inFile(file.string(),
                      fmt::format("was not finished: the program ended while it wrote {}, which is as it was before; "
                                  "this part of it is of no use",
                                  file.stem().string()));
}

double peakForceN(const trace::RecordedFinger& finger) {
  double peak = 0.0;
  for (const Vec3& force : finger.force) peak = std::max(peak, force.norm());
  return peak;
}

}  // namespace

bool isTableOrUnfinished(const fs::path& file) { return trace::isForcesTable(file) || trace::isUnfinished(file); }

std::string tableInfo(const fs::path& file) {
  const std::vector<trace::RecordedFinger> fingers = fingersOf(file);
  std::string text = "table       of forces, recorded by palpate\n";
  if (trace::isUnfinished(file)) {
    text +=
        "unfinished  the recording could not be completed (a full disk, a killed program): a torn last row is left "
        "out\n";
  }
  for (const trace::RecordedFinger& finger : fingers) {
    text += fmt::format("finger      {}: {} rows, {:.3f} to {:.3f} s, peak {:.2f} N\n", finger.name,
                        finger.time_s.size(), finger.time_s.front(), finger.time_s.back(), peakForceN(finger));
  }
  return text + fmt::format("to see it   palpate run --replay {}\n", file.string());
}

nlohmann::ordered_json tableInfoJson(const fs::path& file) {
  nlohmann::ordered_json json = {{"file", file.string()}, {"kind", "forces"}, {"complete", !trace::isUnfinished(file)}};
  json["fingers"] = nlohmann::ordered_json::array();
  for (const trace::RecordedFinger& finger : fingersOf(file)) {
    json["fingers"].push_back({{"name", finger.name},
                               {"rows", finger.time_s.size()},
                               {"from_s", finger.time_s.front()},
                               {"to_s", finger.time_s.back()},
                               {"peak_force_n", peakForceN(finger)}});
  }
  return json;
}

}  // namespace palpate::app
