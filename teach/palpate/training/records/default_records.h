// Where the records lie when nobody says where.
#pragma once

#include <filesystem>

namespace palpate::training {

/// $XDG_DATA_HOME/palpate/palpate.results, or ~/.local/share/palpate/palpate.results. Throws Error without a home.
std::filesystem::path defaultRecords();

}  // namespace palpate::training
