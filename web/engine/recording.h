// What the fingers felt, tick by tick, to be taken along as the table that `palpate` reads (trace/forces_csv.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "palpate/contact/finger_state.h"

namespace palpate::web {

/// Ticks of fingers that are kept: five minutes of one. The oldest go first.
inline constexpr std::size_t kMostRecorded = 300'000;

class Recording {
 public:
  void add(std::uint64_t tick, std::size_t finger, const contact::FingerOutput& felt);
  std::size_t size() const { return rows_.size(); }
  /// The whole table, header and all.
  std::string asForcesCsv() const;

 private:
  /// Of a FingerOutput what the table has: a third of its size.
  struct Row {
    std::uint64_t tick;
    Vec3 tip, proxy, anchor, force;
    double depth_mm;
    Index triangle;
    std::uint32_t status;
    std::uint8_t finger;
    contact::Touch touch;
  };
  std::deque<Row> rows_;
};

}  // namespace palpate::web
