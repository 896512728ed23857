// Chapter 4: the half Gaussian and its array.
#include <fmt/format.h>

#include <cmath>

#include "dissertation/numbers/numbers_study.h"
#include "dissertation/profile/array_quality.h"
#include "palpate/base/gaussian.h"

namespace palpate::study {

namespace {

// A claim in words about ours.
NumberRow claimed(const std::string& what, const std::string& claim, double ours, bool holds,
                  const std::string& tolerance, const std::string& reason) {
  return {.where = "Figure 4.9",
          .what = what,
          .printed = claim,
          .ours = fmt::format("{:.4f} mm", ours),
          .verdict = holds ? Verdict::from_engine : Verdict::not_reproduced,
          .erratum = Erratum::none,
          .reason = reason,
          .tolerance = tolerance};
}

// 4.2.1 compares the arrays by eye: "(a) is significantly different from (b)", "(b) is not obviously different from
// (c)", "(c) is slightly better than (b)".
void addArrays(const PrintedNumbers& printed, Rows& rows) {
  constexpr double kVisible = 0.28;  // mm: a pixel of a life-size view on a 24 inch screen
  const auto [small, middle, large] = printed.array_sizes;
  const double error_small = worstArrayError(small, tissue::TableLookup::nearest);
  const double error_middle = worstArrayError(middle, tissue::TableLookup::nearest);
  const double error_large = worstArrayError(large, tissue::TableLookup::nearest);
  const std::string reason = "worst error of the nearest entry, 10 mm deep";
  const std::string pixel = fmt::format("{:g} mm, a pixel of a life-size view", kVisible);
  rows.push_back(claimed(fmt::format("array of {}", small), "significantly different", error_small,
                         error_small > kVisible, "more than " + pixel, reason));
  rows.push_back(claimed(fmt::format("array of {}", middle), "not obviously different", error_middle,
                         error_middle < kVisible, "less than " + pixel, reason));
  rows.push_back(claimed(fmt::format("array of {}", large), "slightly better", error_large, error_large < error_middle,
                         fmt::format("less than {}'s", middle),
                         fmt::format("{}; {} entries with linear lookup: {:.4f} mm", reason, middle,
                                     worstArrayError(middle, tissue::TableLookup::linear))));
}

}  // namespace

void addProfile(const PrintedNumbers& printed, Rows& rows) {
  // kGaussianRate is 1.4^2 / (2 sigma^2).
  const double variance = kGaussianCut * kGaussianCut / (2.0 * kGaussianRate);
  const double end = halfGaussian(1.0);
  rows.push_back(judged("4.2.1", "sigma^2", printed.gaussian_variance, variance, "1 / (2 pi) from y(0) = 1 in (4.2)"));
  rows.push_back(judged("4.2.1", "sigma", printed.gaussian_sigma, std::sqrt(variance), "its root"));
  rows.push_back(judged("4.2.1", "y(1.4)", printed.gaussian_end, end, "(4.2) at the cut"));
  rows.push_back(judged("4.2.1", "one over y(1.4), to one digit", printed.gaussian_end_part,
                        100.0 * std::round(0.01 / end), fmt::format("{:.1f}: \"around 1/500\"", 1.0 / end)));
  rows.push_back(judged("4.2.1, M[699]", "last entry of the array", printed.gaussian_end,
                        arrayProfile(printed.array_sizes[2], tissue::TableLookup::nearest).at(1.0 - 1e-12).value,
                        "(4.3) just inside the rim"));
  addArrays(printed, rows);
}

}  // namespace palpate::study
