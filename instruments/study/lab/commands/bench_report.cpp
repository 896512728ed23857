#include "lab/commands/bench_report.h"

#include <fmt/format.h>

#include "cli/kit/json.h"
#include "cli/kit/readable_text.h"
#include "lab/counters/machine.h"

namespace palpate::app {

Json machineJson() {
  const lab::Machine m = lab::thisMachine();
  return {{"cpu", m.cpu},           {"cores", m.cores}, {"memory_gb", m.memory_gb}, {"kernel", m.kernel},
          {"compiler", m.compiler}, {"build", m.build}, {"simd", m.simd},           {"palpate", m.palpate}};
}

void printReport(Json json, const std::string& text, bool as_json) {
  json["machine"] = machineJson();
  if (as_json) return fmt::print("{}", jsonText(json));
  printReadable(text + "measured on " + lab::describeMachine(lab::thisMachine()) + "\n");
}

}  // namespace palpate::app
