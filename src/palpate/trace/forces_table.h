// Reads back what forces_csv.h wrote: where each finger was in every tick and what it felt.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::trace {

/// One finger of a table; the three lists are equally long, one entry a tick.
struct RecordedFinger {
  std::string name;
  std::vector<double> time_s;
  std::vector<Vec3> tip;    ///< mm
  std::vector<Vec3> force;  ///< of the contact, N
};

/// In the order of their first rows. Throws Error (file:line: cause) for another header, a wrong number of fields, a
/// field that is no finite number, time that does not increase for a finger, and for a table without rows.
/// Of an unfinished table a torn last row is left out.
std::vector<RecordedFinger> readForcesTable(const std::filesystem::path& file);
/// The same from text; `name` stands for the file in messages.
std::vector<RecordedFinger> parseForcesTable(std::string_view text, std::string_view name);

/// By its name: left by a recording that was not finished (forces.csv.partial).
bool isUnfinished(const std::filesystem::path& file);
/// By its name: *.csv, or such a table unfinished.
bool isForcesTable(const std::filesystem::path& file);

}  // namespace palpate::trace
