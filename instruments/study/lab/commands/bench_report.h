// Output that all `palpate study bench` commands share: percentiles, counts and the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/kit/options.h"
#include "lab/counters/statistics.h"
#include "lab/runs/contact_run.h"
#include "palpate/base/json.h"

namespace palpate::app {

/// {p50, p99, p99_9, max}
Json percentilesJson(const lab::Percentiles& p);

/// "p50 0.12  p99 0.34  p99.9 0.56  max 7.8 us"
std::string percentilesText(const lab::Percentiles& p, const char* unit = "us");

/// "not counted" where it could not be counted.
std::string countText(const std::optional<std::uint64_t>& count);

/// {cpu, cores, memory_gb, kernel, compiler, build, simd, palpate}
Json machineJson();

/// Prints the JSON object with the machine as its last key, or the text with the machine as its last line.
void printReport(Json json, const std::string& text, bool as_json);

// The subcommands of `palpate study bench` that measure the whole program rather than one room, and its regression
// guard.

// `bench` is the bench command.
void addBenchBaseline(Command& bench);  ///< no subcommand: `palpate study bench --baseline FILE`

}  // namespace palpate::app
