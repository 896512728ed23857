// Databases of older versions, as text in tests/data/training/records, and the rows that they must hold once they have
// come forward.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/text.h"
#include "support/places.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::training::old_rows {

inline std::string text(const std::string& name) {
  return readFile(support::testData() / "training/records" / name, 1u << 20);
}

/// Version 1 knew nothing of the forces of searching and palpating, nor of lumps.
inline std::vector<AnyRow> expected() {
  std::vector<AnyRow> rows = samples::history(2, 2, 6).rows;
  for (AnyRow& row : rows) {
    auto* trial = std::get_if<TrialRow>(&row);
    if (trial == nullptr) continue;
    trial->search_force_n = trial->palpate_force_n = 0.0;
    trial->lumps.clear();
  }
  return rows;
}

}  // namespace palpate::training::old_rows
