// `palpate body info` on what is no mesh: a recorded table of forces, and a file that was not finished.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace palpate::app {

/// By its name: a table, or a file left unfinished.
bool isTableOrUnfinished(const std::filesystem::path& file);

/// In words, or as JSON. Throws Error for a table that cannot be read.
std::string tableInfo(const std::filesystem::path& file);
nlohmann::ordered_json tableInfoJson(const std::filesystem::path& file);

}  // namespace palpate::app
