#include "lab/commands/bench_report.h"

#include <fmt/format.h>

#include "lab/counters/machine.h"
#include "palpate/base/json.h"

namespace palpate::app {

Json percentilesJson(const lab::Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p99_9", p.p99_9}, {"max", p.max}};
}

std::string percentilesText(const lab::Percentiles& p, const char* unit) {
  return fmt::format("p50 {:.2f}  p99 {:.2f}  p99.9 {:.2f}  max {:.1f} {}", p.p50, p.p99, p.p99_9, p.max, unit);
}

std::string countText(const std::optional<std::uint64_t>& count) {
  return count ? fmt::to_string(*count) : "not counted";
}

Json machineJson() {
  const lab::Machine m = lab::thisMachine();
  return {{"cpu", m.cpu},           {"cores", m.cores}, {"memory_gb", m.memory_gb}, {"kernel", m.kernel},
          {"compiler", m.compiler}, {"build", m.build}, {"simd", m.simd},           {"palpate", m.palpate}};
}

void printReport(Json json, const std::string& text, bool as_json) {
  json["machine"] = machineJson();
  fmt::print("{}\n", as_json ? jsonDump(json, 2) : text + "measured on " + lab::describeMachine(lab::thisMachine()));
}

}  // namespace palpate::app
