// Chooses the next change: the one whose answer is expected to be most informative about the threshold, whatever slope
// and lapse rate may be.
//
//   Posterior ─ MarginalPsi::best ─► place in the list of levels ─► Block::next
//
// The information is exact, I = h(p) - sum over T of w_T h(p_T), h in nat: slope and lapse are summed out before the
// logarithm is taken, so there are two logarithms for each T and level and none for the 1,708 cells of the grid.
// Based on: Prins, J. Vision 13(7):3, 2013 (nuisance parameters marginalised); Watson, J. Vision 17(3):10, 2017.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/training/posterior.h"

namespace palpate::training {

class MarginalPsi {
 public:
  /// For posteriors with the grid of `like`; `levels` are changes, at least one.
  MarginalPsi(const std::vector<double>& levels, const Posterior& like);

  /// The first of the most informative levels.
  std::size_t best(const Posterior& posterior) const;
  /// The first of the most informative levels about whether T is below `mark`, which an examination decides. Decides
  /// earlier, but learns less about T itself.
  std::size_t bestAtMark(const Posterior& posterior, double mark) const;
  /// Expected information of each level's answer about T, nat.
  std::vector<double> information(const Posterior& posterior) const;
  /// The same about whether T is below `mark`.
  std::vector<double> informationAtMark(const Posterior& posterior, double mark) const;

 private:
  /// The posterior without the lapse rate.
  struct Marginals {
    std::vector<double> weight;  ///< weight of each T
    std::vector<double> left;    ///< share of a weight (T, slope) that guess and lapses leave
  };
  Marginals computeMarginals(const Posterior& posterior) const;
  /// How likely this T and a right answer at this level are together.
  double rightWith(std::size_t level, std::size_t t, const Marginals& marginals) const;

  std::size_t levels_;
  std::size_t thresholds_;
  std::size_t slopes_;
  std::vector<double> lapses_;
  double guess_;
  std::vector<double> felt_;  ///< F of (level, threshold, slope)
};

}  // namespace palpate::training
