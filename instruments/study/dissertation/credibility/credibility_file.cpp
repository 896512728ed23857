// Puts the sections together: which factors of the standard they cover, what is missing, and whether all bars hold.
#include "dissertation/credibility/credibility.h"

#include <algorithm>
#include <array>
#include <span>

#include "dissertation_findings_texts.h"
#include "lab/counters/machine.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"

namespace palpate::study {

namespace {

struct FactorOfStandard {
  std::string_view name;
  std::span<const std::string_view> evidence;
};

constexpr std::array<std::string_view, 3> kQuality = {"numbers", "kept_bits", "hunt"};
constexpr std::array<std::string_view, 2> kCodeVerification = {"solver", "hunt"};
constexpr std::array<std::string_view, 3> kDiscretisation = {"solver_mesh", "tick_length", "facets"};
constexpr std::array<std::string_view, 2> kSolverError = {"solver", "servo"};
constexpr std::array<std::string_view, 2> kModelForm = {"fem_profiles", "lumps"};
constexpr std::array<std::string_view, 2> kModelInputs = {"force_spread", "force_by_input"};
constexpr std::array<std::string_view, 4> kTestSamples = {"measured_ellipses", "living_limbs", "relaxation",
                                                          "found_lumps"};
constexpr std::array<std::string_view, 1> kConditions = {"living_limbs"};
constexpr std::array<std::string_view, 3> kEquivalence = {"fem_profiles", "lumps", "living_limbs"};
constexpr std::array<std::string_view, 5> kComparison = {"fem_profiles", "lumps", "measured_ellipses", "relaxation",
                                                         "found_lumps"};
constexpr std::array<std::string_view, 2> kQuantities = {"fem_profiles", "lumps"};

/// The thirteen of the standard. Use errors and how near the validation is to the context of use are nothing that a run
/// computes.
constexpr std::array kFactors = {FactorOfStandard{"software quality assurance", kQuality},
                                 FactorOfStandard{"numerical code verification", kCodeVerification},
                                 FactorOfStandard{"discretization error", kDiscretisation},
                                 FactorOfStandard{"numerical solver error", kSolverError},
                                 FactorOfStandard{"use error", {}},
                                 FactorOfStandard{"model form", kModelForm},
                                 FactorOfStandard{"model inputs", kModelInputs},
                                 FactorOfStandard{"comparator: test samples", kTestSamples},
                                 FactorOfStandard{"comparator: test conditions", kConditions},
                                 FactorOfStandard{"equivalency of input parameters", kEquivalence},
                                 FactorOfStandard{"output comparison", kComparison},
                                 FactorOfStandard{"relevance of the quantities of interest", kQuantities},
                                 FactorOfStandard{"relevance of the validation to the context of use", {}}};

/// Evidence that no run of this project computes.
std::vector<CredibilityLimit> alwaysMissing() {
  return {
      {"living_backs", "Force on a living back is not compared: no open recording of one was found."},
      {"learners", "Whether people who train with it palpate better is not evaluated."},
      {"haptic_devices", "Forces are those that are sent to a device; what a device makes of them is not measured."},
      {"uneven_bone",
       "How regions follow bones and folds is compared with finite elements in tests of the release, not in this "
       "run (docs/explanation/deformation.md)."},
      {"other_platforms", "Other compilers, processors and systems are compared by `tools/check-platforms`."},
      {"tissue_model",
       "Layers are flat, isotropic and bonded; fibres, tension of the skin and blood flow are not in the model."}};
}

/// A piece of evidence that a run may leave out, and the sentence where it does.
struct OptionalEvidence {
  std::string_view evidence;
  std::string_view sentence;
};
constexpr std::array kOptional = {
    OptionalEvidence{"living_limbs",
                     "Presses on living limbs are not compared: their list is not shipped (`--living DIR` reads it)."},
    OptionalEvidence{"found_lumps", "Lumps that people find are not compared in this run."},
    OptionalEvidence{"lumps", "Lumps of an independent solver are not compared in this run."}};

const Evidence* findEvidence(const std::vector<CredibilitySection>& sections, std::string_view name) {
  for (const CredibilitySection& section : sections) {
    const auto found = std::ranges::find(section.evidence, name, &Evidence::name);
    if (found != section.evidence.end()) return &*found;
  }
  return nullptr;
}

void addUsed(const FindingValues& all, const std::vector<FindingsPart>& parts, FindingValues& used) {
  for (const FindingsPart& part : parts) {
    if (all.contains(part.name)) used[part.name] = all[part.name];
    for (const std::vector<FindingsPart>& text : part.texts) addUsed(all, text, used);
  }
}

/// A paragraph uses some of the numbers; formatFindings accepts no others.
FindingValues selectUsed(const FindingValues& all, const std::vector<FindingsPart>& parts) {
  FindingValues used = FindingValues::object();
  addUsed(all, parts, used);
  return used;
}

constexpr std::uint64_t kUsualSeed = 1;  // seed in CredibilitySettings

std::string formatCommand(const CredibilitySettings& settings) {
  std::string command = "palpate study credibility";
  if (settings.quick) command += " --quick";
  if (settings.seed != kUsualSeed) command += " --seed " + std::to_string(settings.seed);
  if (!settings.living.empty()) command += " --living DIR";
  return command + " -o credibility.html";
}

}  // namespace

double Evidence::number(std::string_view name_of) const {
  const auto found = std::ranges::find(numbers, name_of, &CredibilityNumber::name);
  if (found == numbers.end()) throw Error("study credibility: " + name + " has no number " + std::string(name_of));
  return found->value;
}

bool Evidence::holds() const { return std::ranges::all_of(numbers, &CredibilityNumber::holds); }

bool CredibilitySection::holds() const { return std::ranges::all_of(evidence, &Evidence::holds); }

bool CredibilityFile::holds() const { return std::ranges::all_of(sections, &CredibilitySection::holds); }

const Evidence& CredibilityFile::evidence(std::string_view name) const {
  if (const Evidence* found = findEvidence(sections, name)) return *found;
  throw Error("study credibility: unknown evidence " + std::string(name));
}

RiskLevel ContextOfUse::risk() const {
  return static_cast<RiskLevel>((static_cast<int>(influence) + static_cast<int>(consequence) + 1) / 2);
}

std::vector<CredibilityFactor> collectFactors(const std::vector<CredibilitySection>& sections) {
  std::vector<CredibilityFactor> factors;
  for (const FactorOfStandard& of_standard : kFactors) {
    CredibilityFactor& factor = factors.emplace_back(CredibilityFactor{std::string(of_standard.name), {}});
    for (const std::string_view name : of_standard.evidence) {
      if (findEvidence(sections, name) != nullptr) factor.evidence.emplace_back(name);
    }
  }
  return factors;
}

std::vector<CredibilityLimit> collectLimits(const std::vector<CredibilitySection>& sections,
                                            const std::vector<CredibilityFactor>& factors) {
  std::vector<CredibilityLimit> limits = alwaysMissing();
  for (const OptionalEvidence& optional : kOptional) {
    if (findEvidence(sections, optional.evidence) == nullptr) {
      limits.push_back({std::string(optional.evidence), std::string(optional.sentence)});
    }
  }
  for (const CredibilityFactor& factor : factors) {
    if (factor.evidence.empty()) limits.push_back({factor.name, "No evidence of this run covers this factor."});
  }
  return limits;
}

std::string formatFinding(const Evidence& evidence) {
  FindingValues values = {{"holds", evidence.holds()}};
  for (const CredibilityNumber& number : evidence.numbers) values[number.name] = number.value;
  values["order_seen"] = values.contains("observed_order");
  if (!values.contains("observed_order")) values["observed_order"] = 0.0;  // for the branch that is not taken
  FindingValues paragraphs;
  for (const FindingsParagraph& paragraph : readFindings(texts::credibility_findings)) {
    paragraphs[paragraph.name] =
        paragraph.name == evidence.name ? selectUsed(values, paragraph.parts) : FindingValues();
  }
  return formatFindings(texts::credibility_findings, paragraphs).front();
}

CredibilityFile makeCredibility(const CredibilitySettings& settings) {
  const auto start = Clock::now();
  CredibilityFile file{.use = settings.use, .seed = settings.seed, .quick = settings.quick};
  file.sections = {verifyCode(settings), verifyCalculation(settings), validate(settings), propagateSpread(settings)};
  file.factors = collectFactors(file.sections);
  file.limits = collectLimits(file.sections, file.factors);
  const lab::Machine machine = lab::thisMachine();
  file.release = machine.palpate;
  file.machine = lab::describeMachine(machine);
  file.command = formatCommand(settings);
  file.seconds = secondsSince(start);
  return file;
}

}  // namespace palpate::study
