// What the commands of sessions share: what a session holds, in words and as JSON, and --from, --to.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "palpate/trace/session_reader.h"

namespace palpate::app {

/// Seconds of a session.
struct TimeSpan {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
};
void addTimeSpan(CLI::App& command, TimeSpan& span);
/// Throws Error where it ends before it begins.
trace::TickSpan ticksOf(const TimeSpan& span, double ticks_per_s);

/// By its name, or by its first bytes: an SQLite file.
bool isSessionFile(const std::filesystem::path& file);

std::string sessionInfo(const std::filesystem::path& file);
nlohmann::ordered_json sessionInfoJson(const std::filesystem::path& file);

/// "12.3 s, index, middle; ended: done"
std::string sessionLine(const trace::SessionFacts& facts);
nlohmann::ordered_json factsJson(const trace::SessionFacts& facts);

}  // namespace palpate::app
