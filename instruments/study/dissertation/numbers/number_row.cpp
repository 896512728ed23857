// A printed number is right when ours, rounded to as many digits, is it; misprints are a list of their own, found by
// place, quantity and number with the right number, so that none can excuse another row or another fault of ours.
#include "dissertation/numbers/number_row.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/fidelity.h"
#include "palpate/base/text.h"

namespace palpate::study {

namespace {

/// A printed number that is known to be wrong, with its erratum.
struct Misprint {
  std::string_view where;
  std::string_view what;
  std::string_view printed;
  std::string_view right;  ///< the correct number; ours must round to it
  Erratum erratum;
  std::string_view reason;
};

constexpr std::array kMisprints{
    Misprint{"Table 3.3, height 5", "w", "3.04", "3.05", Erratum::E13_misprints,
             "6/63 over 1/32 is 3.0476: cut off instead of rounded"},
    Misprint{"Table 3.3, height 9", "w", "5.01", "5.00", Erratum::E13_misprints, "10/1023 over 1/512 is 5.0049"},
    Misprint{"5.2.2, (5.10) at P1", "R for the levels 1, 0.26, 0.18", "112", "113", Erratum::E28_effect_radius,
             "112.92 was cut off; with the levels of any one effect radius Table 5.1 gives neither"},
    Misprint{"Figure 5.9, e = 400 as radius", "R(E1)", "115", "114", Erratum::E28_effect_radius,
             "115 and 112 need the radius 200: 400 is the diameter"},
    Misprint{"Figure 5.9, e = 400 as radius", "R(E2)", "112", "115", Erratum::E28_effect_radius,
             "115 and 112 need the radius 200: 400 is the diameter"},
};

// Ours may lie on the very edge of rounding and miss it by the last bit.
constexpr double kSlack = 1e-9;

double numberOf(std::string_view text) {
  const auto number = parseNumber(text);
  if (!number) throw Error(fmt::format("printed number '{}' must be a number", text));
  return *number;
}

const Misprint* findMisprint(const NumberRow& row, double ours) {
  for (const Misprint& misprint : kMisprints) {
    const bool is_here = misprint.where == row.where && misprint.what == row.what && misprint.printed == row.printed;
    if (is_here && agrees(misprint.right, ours)) return &misprint;
  }
  return nullptr;
}

// Two digits more than printed; a fraction in decimals.
std::string formatComputed(std::string_view printed, double ours) {
  constexpr int kMore = 2;
  const bool is_fraction = printed.find('/') != std::string_view::npos;
  return is_fraction ? fmt::format("{:.6g}", ours)
                     : fmt::format("{:.{}f}", ours, parsePrinted(printed).decimals + kMore);
}

std::string toleranceText(const PrintedNumber& printed) {
  return printed.tolerance > 0.0 ? fmt::format("{:g}", printed.tolerance) : "rounding of the computer";
}

}  // namespace

bool studyHolds(const std::vector<NumberRow>& rows) { return countRows(rows, Verdict::not_reproduced) == 0; }

int countRows(const std::vector<NumberRow>& rows, Verdict verdict) {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [&](const NumberRow& row) { return row.verdict == verdict; }));
}

PrintedNumber parsePrinted(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string_view::npos) return {numberOf(text.substr(0, slash)) / numberOf(text.substr(slash + 1))};
  const std::size_t point = text.find('.');
  const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(text.size() - point - 1);
  return {numberOf(text), 0.5 * std::pow(10.0, -decimals), decimals};
}

bool agrees(std::string_view printed, double ours) {
  const PrintedNumber number = parsePrinted(printed);
  return std::abs(ours - number.value) <= number.tolerance + kSlack * std::max(1.0, std::abs(number.value));
}

std::optional<double> offPercent(double printed, double ours) {
  if (printed == 0.0) return std::nullopt;
  return 100.0 * (ours / printed - 1.0);
}

NumberRow judged(std::string where, std::string what, const std::string& printed, double ours, std::string reason,
                 Source source) {
  const PrintedNumber number = parsePrinted(printed);
  NumberRow row{.where = std::move(where),
                .what = std::move(what),
                .printed = printed,
                .ours = formatComputed(printed, ours),
                .verdict = reproducedFrom(source),
                .erratum = Erratum::none,
                .reason = std::move(reason),
                .tolerance = toleranceText(number),
                .off_percent = offPercent(number.value, ours)};
  if (agrees(printed, ours)) return row;
  row.verdict = Verdict::not_reproduced;
  if (const Misprint* misprint = findMisprint(row, ours)) {
    row.verdict = Verdict::misprint;
    row.erratum = misprint->erratum;
    row.reason = misprint->reason;
  }
  return row;
}

}  // namespace palpate::study
