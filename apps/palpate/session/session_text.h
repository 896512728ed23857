// What a session holds, in words and as JSON: for info, sessions and replay.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "palpate/trace/session_reader.h"

namespace palpate::app {

/// By its first bytes: an SQLite file.
bool isSessionFile(const std::filesystem::path& file);

std::string sessionInfo(const std::filesystem::path& file);
nlohmann::ordered_json sessionInfoJson(const std::filesystem::path& file);

/// "12.3 s, index, middle; ended: done"
std::string sessionLine(const trace::SessionFacts& facts);
nlohmann::ordered_json factsJson(const trace::SessionFacts& facts);

}  // namespace palpate::app
