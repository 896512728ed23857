#include "palpate/training/trainee/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"

namespace palpate::training {

namespace {

/// A key of the text, the member for its number, and its range.
template <class Settings>
struct NumberKey {
  const char* name;
  double Settings::*value;
  NumberRange range;
};
using ObserverKey = NumberKey<ObserverSettings>;
const std::array kObserverKeys = {
    ObserverKey{"weber", &ObserverSettings::weber, {0.005, 1.0}},
    ObserverKey{"weber_end", &ObserverSettings::weber_end, {0.0, 1.0}},
    ObserverKey{"learning_blocks", &ObserverSettings::learning_blocks, {0.1, 1000.0}},
    ObserverKey{"lapse", &ObserverSettings::lapse, {0.0, 0.5}},
    // Harder than a device of 3.3 N holds, or shorter than a reflex, is not palpation.
    ObserverKey{"press_n", &ObserverSettings::press_n, {0.1, 3.0}},
    ObserverKey{"press_s", &ObserverSettings::press_s, {0.05, 5.0}},
};
using LumpKey = NumberKey<LumpTraineeSettings>;
const std::array kLumpKeys = {
    LumpKey{"pattern_weber", &LumpTraineeSettings::pattern_weber, {0.001, 10.0}},
    LumpKey{"force_weber", &LumpTraineeSettings::force_weber, {0.001, 10.0}},
    LumpKey{"spread", &LumpTraineeSettings::spread, {0.05, 20.0}},
    LumpKey{"false_alarms", &LumpTraineeSettings::false_alarms, {0.0, 0.9}},
    LumpKey{"press_n", &LumpTraineeSettings::press_n, {0.1, 3.0}},
    LumpKey{"press_s", &LumpTraineeSettings::press_s, {0.05, 5.0}},
};
constexpr const char* kLumpWords = "--trainee observer=lump,spread=3.4,...";
constexpr NumberRange kSitesRange{1.0, 40.0};
constexpr NumberRange kSeedRange{0.0, 9007199254740992.0};  // whole numbers that a double keeps

template <class Keys>
std::vector<std::string> keyNames(const Keys& keys, std::initializer_list<const char*> more) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.emplace_back(key.name);
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

/// "weber", "0.2" of "weber=0.2, lapse=0.02".
std::vector<std::pair<std::string_view, std::string_view>> parsePairs(std::string_view words) {
  std::vector<std::pair<std::string_view, std::string_view>> pairs;
  if (trimmed(words).empty()) return pairs;
  for (const std::string_view pair : split(words, ',')) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos) {
      throw Error(
          fmt::format("trainee: '{}' has no value; expected pairs such as weber=0.2,lapse=0.02", oneLine(pair)));
    }
    pairs.emplace_back(trimmed(pair.substr(0, equals)), trimmed(pair.substr(equals + 1)));
  }
  return pairs;
}

double observerNumber(std::string_view key, std::string_view word, const NumberRange& range, bool whole) {
  const auto value = parseNumber(word);
  if (!value) throw Error(fmt::format("trainee: {} = '{}' must be a number", key, oneLine(word)));
  if (!range.holds(*value)) throw Error(fmt::format("trainee: {} = {}", key, outOfRange(std::string(word), range)));
  if (whole && *value != std::floor(*value))
    throw Error(fmt::format("trainee: {} = {} must be a whole number", key, word));
  return *value;
}

void setObserverKey(ObserverSettings& settings, std::string_view key, std::string_view word) {
  if (key == "sites") {
    settings.sites = static_cast<int>(observerNumber(key, word, kSitesRange, true));
    return;
  }
  if (key == "seed") {
    settings.seed = static_cast<std::uint64_t>(observerNumber(key, word, kSeedRange, true));
    return;
  }
  const auto* const found =
      std::ranges::find_if(kObserverKeys, [&](const ObserverKey& known) { return known.name == key; });
  if (found == kObserverKeys.end()) {
    throw Error(unknownName("key", key, "--trainee weber=0.2,...", keyNames(kObserverKeys, {"sites", "seed"})));
  }
  settings.*(found->value) = observerNumber(key, word, found->range, false);
}

void setLumpKey(LumpTraineeSettings& settings, std::string_view key, std::string_view word) {
  if (key == "observer") {
    if (word != "lump") throw Error(fmt::format("trainee: observer = '{}' must be lump", oneLine(word)));
  } else if (key == "field") {
    if (word != "true" && word != "false") {
      throw Error(fmt::format("trainee: field = '{}' must be true or false", oneLine(word)));
    }
    settings.field = word == "true";
  } else if (key == "seed") {
    settings.seed = static_cast<std::uint64_t>(observerNumber(key, word, kSeedRange, true));
  } else {
    const auto* const found = std::ranges::find_if(kLumpKeys, [&](const LumpKey& known) { return known.name == key; });
    if (found == kLumpKeys.end()) {
      throw Error(unknownName("key", key, kLumpWords, keyNames(kLumpKeys, {"observer", "field", "seed"})));
    }
    settings.*(found->value) = observerNumber(key, word, found->range, false);
  }
}

}  // namespace

ObserverSettings observerNamed(std::string_view words) {
  ObserverSettings settings;
  for (const auto& [key, word] : parsePairs(words)) setObserverKey(settings, key, word);
  return settings;
}

bool isLumpTrainee(std::string_view words) {
  return std::ranges::any_of(parsePairs(words), [](const auto& pair) { return pair.first == "observer"; });
}

LumpTraineeSettings lumpTraineeNamed(std::string_view words) {
  LumpTraineeSettings settings;
  for (const auto& [key, word] : parsePairs(words)) setLumpKey(settings, key, word);
  return settings;
}

std::string formatLumpTrainee(const LumpTraineeSettings& settings) {
  std::string words = "observer=lump,";
  for (const LumpKey& key : kLumpKeys) words += fmt::format("{}={},", key.name, settings.*(key.value));
  return words + fmt::format("field={},seed={}", settings.field, settings.seed);
}

std::string formatObserver(const ObserverSettings& settings) {
  std::string words;
  for (const ObserverKey& key : kObserverKeys) words += fmt::format("{}={},", key.name, settings.*(key.value));
  return words + fmt::format("sites={},seed={}", settings.sites, settings.seed);
}

double weberNow(const ObserverSettings& settings, int block) {
  if (!(settings.weber_end > 0.0)) return settings.weber;
  return settings.weber_end + (settings.weber - settings.weber_end) * std::exp(-block / settings.learning_blocks);
}

std::vector<int> sitesSearched(const ObserverSettings& settings, int all_sites, Random& random) {
  std::vector<int> numbers(static_cast<std::size_t>(all_sites));
  std::iota(numbers.begin(), numbers.end(), 1);
  if (settings.sites >= all_sites) return numbers;
  // The first of a shuffle (Fisher and Yates).
  const auto wanted = static_cast<std::size_t>(settings.sites);
  for (std::size_t i = 0; i < wanted; ++i) std::swap(numbers[i], numbers[i + random.below(numbers.size() - i)]);
  numbers.resize(wanted);
  std::ranges::sort(numbers);
  return numbers;
}

int decide(std::span<const int> felt_sites, std::span<const double> felt_ratio, const ObserverSettings& settings,
           int block, int all_sites, Random& random) {
  if (felt_sites.empty()) return 1 + static_cast<int>(random.below(static_cast<std::uint64_t>(all_sites)));
  const double noise = weberNow(settings, block) / kDPrimeAtThreshold;
  std::size_t stiffest = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < felt_sites.size(); ++i) {
    const double percept = changeFromRatio(felt_ratio[i], settings.meaning) + noise * random.normal();
    if (i > 0 && percept <= most) continue;
    stiffest = i;
    most = percept;
  }
  // A lapse is right by chance; so that it is *wrong* with the stated rate, it comes a little more often.
  const auto places = static_cast<double>(felt_sites.size());
  const double lapse = places > 1.0 ? settings.lapse * places / (places - 1.0) : 0.0;
  const bool lapses = random.uniform() < lapse;
  const std::size_t any = random.below(felt_sites.size());
  return felt_sites[lapses ? any : stiffest];
}

}  // namespace palpate::training
