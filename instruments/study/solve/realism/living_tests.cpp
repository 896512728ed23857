#include "solve/realism/living_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "solve/realism/living_limbs.h"

namespace palpate::lab {

namespace {

constexpr std::uint64_t kMaxLivingBytes = 16u << 20u;
constexpr NumberRange kPeople{0.0, 1e6};
constexpr NumberRange kCoverMm{4.0, 200.0};
constexpr NumberRange kSkinMm{0.1, 10.0};
constexpr NumberRange kFatMm{0.0, 200.0};
constexpr NumberRange kPressureSlope{1e-6, 1.0};  // MPa/mm

enum Column : std::size_t { person, site, cover, skin, fat, stiffness, columns };
constexpr std::array<std::string_view, columns> kColumnNames = {"SubID", "Location", "Thickness",
                                                                "Skin",  "Fat",      "Total_Stiff"};

struct Header {
  std::array<std::size_t, columns> at{};
  std::size_t fields = 0;
};

Header headerFrom(const CsvRow& row) {
  Header header{.at = {}, .fields = row.fields.size()};
  for (std::size_t c = 0; c < columns; ++c) {
    const auto found = std::ranges::find(row.fields, kColumnNames[c]);
    if (found == row.fields.end()) {
      throw Error::atLine(row.file, row.line, fmt::format("the header has no column {}", kColumnNames[c]));
    }
    header.at[c] = static_cast<std::size_t>(found - row.fields.begin());
  }
  return header;
}

LivingTest testFrom(const CsvRow& row, const Header& header) {
  const auto number = [&](Column column, const NumberRange& range) {
    return csvNumber(row, header.at[column], kColumnNames[column], range);
  };
  LivingTest test;
  const double id = number(person, kPeople);
  if (id != std::floor(id)) throw Error::atLine(row.file, row.line, "SubID must be a whole number");
  test.person = static_cast<int>(id);
  test.site = std::string(row.fields[header.at[site]]);
  if (siteNamed(test.site) == nullptr) {
    throw Error::atLine(
        row.file, row.line,
        fmt::format("Location is '{}'; expected one of {}", row.fields[header.at[site]].substr(0, 20), siteCodes()));
  }
  test.cover_mm = number(cover, kCoverMm);
  test.skin_mm = number(skin, kSkinMm);
  test.fat_mm = number(fat, kFatMm);
  if (test.skin_mm + test.fat_mm >= test.cover_mm) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("Skin and Fat ({:g} mm) must be thinner than Thickness ({:g} mm)",
                                    test.skin_mm + test.fat_mm, test.cover_mm));
  }
  test.n_per_mm = kProbeAreaMm2 * number(stiffness, kPressureSlope);
  return test;
}

}  // namespace

LivingTests readLivingTests(const std::filesystem::path& list_or_folder) {
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(list_or_folder, ignored);
  const std::filesystem::path file = folder ? list_or_folder / kLivingList : list_or_folder;
  const std::string text = readFile(file, kMaxLivingBytes);
  LivingTests result;
  Header header;
  forEachCsvRow(text, file.string(), [&](const CsvRow& row) {
    if (header.fields == 0) {
      header = headerFrom(row);
      return;
    }
    if (row.fields.size() != header.fields) {
      throw Error::atLine(row.file, row.line,
                          fmt::format("found {} fields; expected {}", row.fields.size(), header.fields));
    }
    const bool measured = !row.fields[header.at[cover]].empty() && !row.fields[header.at[stiffness]].empty();
    if (measured) {
      result.tests.push_back(testFrom(row, header));
    } else {
      ++result.left_out;
    }
  });
  if (result.tests.empty()) throw Error::inFile(file.string(), "has no rows with Thickness and Total_Stiff");
  return result;
}

}  // namespace palpate::lab
