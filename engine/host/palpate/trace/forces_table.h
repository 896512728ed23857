// Reads back what forces_csv.h wrote: where each finger was in every tick and what it felt.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"

namespace palpate::trace {

/// One row. Lengths in mm, forces in N.
struct ForcesRow {
  double time_s = 0.0;
  std::string_view finger;  ///< valid during the visit only
  Vec3 tip = Vec3::Zero();
  Vec3 anchor = Vec3::Zero();
  Vec3 force = Vec3::Zero();  ///< of the contact
  double depth_mm = 0.0;
  contact::Touch touch = contact::Touch::free;
  Vec3 device_force = Vec3::Zero();
  std::uint32_t contact_status = 0;  ///< contact::StatusBit
  std::uint32_t safety_status = 0;   ///< servo::SafetyBit
};

/// Calls `visit` for every row of the file, in its order. Throws Error (file:line: cause) for another header, a wrong
/// number of fields, a row that breaks off, a field that is not what its column holds, and for a table without rows.
/// A torn last row of an unfinished table is skipped.
void forEachForcesRow(const std::filesystem::path& file, const std::function<void(const ForcesRow&)>& visit);
/// The same from text; `name` stands for the file in messages.
void forEachForcesRow(std::string_view text, std::string_view name, const std::function<void(const ForcesRow&)>& visit);

/// One finger of a table; the three lists are equally long, one entry a tick.
struct RecordedFinger {
  std::string name;
  std::vector<double> time_s;
  std::vector<Vec3> tip;    ///< mm
  std::vector<Vec3> force;  ///< of the contact, N
};

/// In the order of their first rows. Throws Error (file:line: cause) for another header, a wrong number of fields, a
/// field that is not a finite number, time that does not increase for a finger, and for a table without rows.
/// A torn last row of an unfinished table is skipped.
std::vector<RecordedFinger> readForcesTable(const std::filesystem::path& file);
/// The same from text; `name` stands for the file in messages.
std::vector<RecordedFinger> parseForcesTable(std::string_view text, std::string_view name);

/// By its name: left by a recording that was not finished (forces.csv.partial).
bool isUnfinished(const std::filesystem::path& file);
/// By its name: *.csv, or such a table unfinished.
bool isForcesTable(const std::filesystem::path& file);

}  // namespace palpate::trace
