#include "palpate/tissue/fitting/profile_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/tissue/fitting/table_columns.h"

namespace palpate::tissue {

namespace {

constexpr std::uint64_t kMaxSkinBytes = 64'000'000;
constexpr std::size_t kMaxDepths = 200;
constexpr NumberRange kSkinDepths{0.0, 500.0, true};
constexpr NumberRange kSkinRadii{0.0, 10'000.0};
constexpr NumberRange kMotions{-500.0, 500.0};

struct SkinPlace {
  double radius = 0.0;
  double down = 0.0;
  double outward = 0.0;
};

class ProfileReader {
 public:
  void addRow(const CsvRow& row) {
    if (!fields_) return readHeader(row);
    checkFields(row, *fields_);
    const double depth = csvNumber(row, depth_, "depth_mm", kSkinDepths);
    if (!places_.contains(depth) && places_.size() == kMaxDepths) {
      throw Error::atLine(row.file, row.line, fmt::format("too many depths; expected at most {}", kMaxDepths));
    }
    places_[depth].push_back({csvNumber(row, radius_, "r_mm", kSkinRadii), csvNumber(row, down_, "down_mm", kMotions),
                              outward_ ? csvNumber(row, *outward_, "outward_mm", kMotions) : 0.0});
  }

  std::vector<SkinProfile> profiles() const {
    std::vector<SkinProfile> profiles;
    for (auto [depth, places] : places_) {
      std::ranges::stable_sort(places, {}, &SkinPlace::radius);
      SkinProfile& profile = profiles.emplace_back();
      profile.depth_mm = depth;
      for (const SkinPlace& place : places) {
        profile.radius_mm.push_back(place.radius);
        profile.down_mm.push_back(place.down);
        if (outward_) profile.outward_mm.push_back(place.outward);
      }
    }
    return profiles;
  }

 private:
  void readHeader(const CsvRow& row) {
    depth_ = neededColumn(row, "depth_mm");
    radius_ = neededColumn(row, "r_mm");
    down_ = neededColumn(row, "down_mm");
    outward_ = columnOf(row, "outward_mm");
    fields_ = row.fields.size();
  }

  std::optional<std::size_t> fields_;
  std::size_t depth_ = 0;
  std::size_t radius_ = 0;
  std::size_t down_ = 0;
  std::optional<std::size_t> outward_;
  std::map<double, std::vector<SkinPlace>> places_;
};

}  // namespace

std::vector<SkinProfile> parseSkinProfiles(std::string_view text, std::string_view name) {
  ProfileReader reader;
  forEachCsvRow(text, name, [&](const CsvRow& row) { reader.addRow(row); });
  std::vector<SkinProfile> profiles = reader.profiles();
  if (profiles.empty()) throw Error::inFile(name, "has no rows; expected depth_mm,r_mm,down_mm");
  return profiles;
}

std::vector<SkinProfile> readSkinProfiles(const std::filesystem::path& file) {
  return parseSkinProfiles(readFile(file, kMaxSkinBytes), file.string());
}

}  // namespace palpate::tissue
