// `palpate study credibility`: why the figures of this release may be trusted, and where they may not, in the shape of
// ASME V&V 40.
//
//   verifyCode, verifyCalculation ─┐
//   validate                       ├─► CredibilityFile ─► JSON, HTML, text
//   propagateSpread                ┘
//
// Every number comes from a study of this run; sentences are templates that these numbers fill
// (credibility_findings.txt). Facts that a run does not compute are listed under limits.
// Based on: ASME V&V 40-2018, "Assessing credibility of computational modeling through verification and validation:
// application to medical devices".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/words.h"
#include "report/page/study_page.h"

namespace palpate::study {

struct CredibilityNumber {
  std::string name;             ///< with the unit in it where it has one
  double value = 0.0;           ///< finite
  std::string unit;             ///< "N", "mm", "%"; empty: a count or a ratio
  std::optional<double> bar{};  ///< the most that is allowed; none: the number informs
  bool holds() const { return !bar || value <= *bar; }
};

/// Evidence of one study for or against the model.
struct Evidence {
  std::string name;     ///< name of its paragraph in credibility_findings.txt
  std::string title;    ///< a few words
  std::string against;  ///< reference that it is compared with
  std::string command;  ///< gives the same numbers alone; empty: this study only
  std::vector<CredibilityNumber> numbers;

  /// Throws Error for a name that it does not have.
  double number(std::string_view name_of) const;
  bool holds() const;
};

struct CredibilitySection {
  std::string name;   ///< "code_verification"
  std::string title;  ///< "Code verification"
  std::vector<Evidence> evidence;
  bool holds() const;
};

enum class RiskLevel : std::uint8_t { low, medium, high };

/// Use of the model: the user's to say, the defaults are the product's purpose.
struct ContextOfUse {
  std::string question =
      "Are the force under a finger and the dent that is seen close enough to those of layered tissue over bone to "
      "teach and examine palpation?";
  std::string context =
      "Force and skin under one fingertip, pressed and dragged at 1 kHz, shown to people who learn or examine "
      "palpation. No patient is examined or treated by it.";
  RiskLevel influence = RiskLevel::medium;  ///< influence of the model on the decision, among other evidence
  RiskLevel consequence = RiskLevel::low;   ///< severity of a wrong decision
  /// The mean of influence and consequence, rounded up.
  RiskLevel risk() const;
};

/// Files of tests/data, compiled in so that the command works from any folder.
struct CredibilityData {
  std::string_view fem_profiles;  ///< tests/data/golden/fem_profiles.json
  std::string_view lumps;         ///< tests/data/golden/lumps.json
  std::string_view kept_bits;     ///< tests/platforms/kept.jsonl
};
CredibilityData compiledData();

struct CredibilitySettings {
  ContextOfUse use = {};
  std::uint64_t seed = 1;          ///< for the hunt and the drawn inputs
  bool quick = false;              ///< fewer ticks, draws and solved stacks: for tests, not for its numbers
  std::filesystem::path living{};  ///< list of presses on living limbs, or its folder (lab::readLivingTests);
                                   ///< empty: none
  CredibilityData data = compiledData();
  Progress progress = {};
};

/// The finger's ticks that are hunted over.
std::size_t huntedTicks(const CredibilitySettings& settings);

CredibilitySection verifyCode(const CredibilitySettings& settings);
CredibilitySection verifyCalculation(const CredibilitySettings& settings);
/// Throws Error naming the data set that cannot be read.
CredibilitySection validate(const CredibilitySettings& settings);
CredibilitySection propagateSpread(const CredibilitySettings& settings);

/// One of the thirteen credibility factors of the standard, and this file's evidence for it.
struct CredibilityFactor {
  std::string name;
  std::vector<std::string> evidence;  ///< names; none: not covered
};

/// A claim that is not made: a name for programs, a sentence for people.
struct CredibilityLimit {
  std::string name;
  std::string sentence;
};

struct CredibilityFile {
  ContextOfUse use{};
  std::uint64_t seed = 1;
  bool quick = false;
  std::vector<CredibilitySection> sections{};  ///< in the order of the standard
  std::vector<CredibilityFactor> factors{};
  std::vector<CredibilityLimit> limits{};
  std::string release{};  ///< version of this project
  std::string command{};
  std::string machine{};
  double seconds = 0.0;

  /// No number is beyond its bar.
  bool holds() const;
  /// Throws Error for a name that there is not.
  const Evidence& evidence(std::string_view name) const;
};

/// Runs everything: about a minute on two cores. Throws Error as the studies do.
CredibilityFile makeCredibility(const CredibilitySettings& settings);

/// From the sections alone: which factors they cover, and what is missing.
std::vector<CredibilityFactor> collectFactors(const std::vector<CredibilitySection>& sections);
std::vector<CredibilityLimit> collectLimits(const std::vector<CredibilitySection>& sections,
                                            const std::vector<CredibilityFactor>& factors);

/// The sentence of a piece of evidence, filled by its numbers.
std::string formatFinding(const Evidence& evidence);

// Text for a terminal, JSON for programs, one HTML file for people.

std::string textOf(const CredibilityFile& file);
std::string toJson(const CredibilityFile& file);
std::string toHtml(const CredibilityFile& file);

/// .html or .json, by the name. Throws Error for another, and naming a file that cannot be written.
void writeCredibility(const CredibilityFile& credibility, const std::filesystem::path& file);

}  // namespace palpate::study

namespace palpate {

template <>
struct WordsOf<study::RiskLevel> {
  using R = study::RiskLevel;
  static constexpr std::array kAll = {Word{"low", R::low}, Word{"medium", R::medium}, Word{"high", R::high}};
};

}  // namespace palpate
