// How a simulated trainee decides: it feels each site's change with noise and names the one that felt stiffest; now and
// then it does not care (lapse), and it may leave sites out.
//
//   felt stiffness ratios ─ changeFromRatio + noise of its threshold ─► the largest ─► answer
//
// Its d' grows with the declared change, so its psychometric function is the ideal observer's, with T = weber among
// twelve sites (psychometric.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/lumps/lump_observer.h"
#include "palpate/training/stimulus.h"

namespace palpate::training {

struct ObserverSettings {
  /// Its threshold T among twelve sites, as a declared change; learns towards `weber_end` with `learning_blocks`.
  double weber = 0.2;
  double weber_end = 0.0;  ///< 0: does not learn
  double learning_blocks = 3.0;
  double lapse = 0.02;
  int sites = 12;  ///< sites searched in each trial, drawn again in each
  std::uint64_t seed = 1;
  // How it presses.
  double press_n = 1.5;
  double press_s = 0.5;
  /// Meaning of the change in `weber`: the protocol's.
  ChangeMeaning meaning = ChangeMeaning::compliance;
};

/// d' at which an ideal observer among twelve places is right, corrected for guesses, half of the time: the root of
/// F(d') = 1/2 with P = integral of phi(x - d') Phi(x)^11.
inline constexpr double kDPrimeAtThreshold = 1.697;

/// "weber=0.2,lapse=0.02,sites=12": keys as above. Throws Error naming the key, with the nearest.
ObserverSettings observerNamed(std::string_view words);
/// The same settings as words that observerNamed understands, for records.
std::string formatObserver(const ObserverSettings& settings);

/// A simulated trainee of lump sessions (lump_trainee.h); LumpObserver says how plainly it has to feel each lump.
struct LumpTraineeSettings : lumps::LumpObserver {
  double false_alarms = 0.05;  ///< names a place in a body for nothing
  double press_n = 3.0;
  double press_s = 0.5;
  std::uint64_t seed = 1;
};

/// True if the words contain observer=lump.
bool isLumpTrainee(std::string_view words);
/// "observer=lump,pattern_weber=0.036,force_weber=0.08,spread=3.4,field=true". Throws Error naming the key.
LumpTraineeSettings lumpTraineeNamed(std::string_view words);
std::string formatLumpTrainee(const LumpTraineeSettings& settings);

/// The threshold before the block number `block` (from 0).
double weberNow(const ObserverSettings& settings, int block);

/// The sites that it searches in this trial, by number, in rising order: all, or as many as it cares for.
std::vector<int> sitesSearched(const ObserverSettings& settings, int all_sites, Random& random);

/// Picks among the sites that were felt: each has a felt stiffness ratio (1: base). A lapse names any of them; without
/// any it guesses among all. Its lapses make answers wrong at the rate Psychometric::lapse.
int decide(std::span<const int> felt_sites, std::span<const double> felt_ratio, const ObserverSettings& settings,
           int block, int all_sites, Random& random);

}  // namespace palpate::training
