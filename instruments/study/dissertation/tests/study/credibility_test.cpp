// The credibility file: each number is the one that its study gives alone, sentences follow the numbers, and a broken
// input is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "dissertation/credibility/checked_stack.h"
#include "dissertation/credibility/credibility.h"
#include "dissertation/interpolation/interpolation_findings.h"
#include "dissertation/numbers/numbers_study.h"
#include "dissertation/relaxation/relaxation_measurement.h"
#include "lab/hunt/hunt.h"
#include "palpate/base/text.h"
#include "solve/realism/lump_judge.h"
#include "solve/realism/realism_stacks.h"
#include "solve/realism/solver_checks.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::study {

namespace {

const CredibilityFile& quickFile() {
  static const CredibilityFile file = makeCredibility({.quick = true});
  return file;
}

nlohmann::json readBack() { return nlohmann::json::parse(toJson(quickFile())); }

/// The value of one number in the JSON text.
double valueIn(const nlohmann::json& file, const std::string& section, const std::string& evidence,
               const std::string& number) {
  for (const auto& one : file.at(section).at("evidence")) {
    if (one.at("name") == evidence) return one.at("numbers").at(number).at("value").get<double>();
  }
  throw std::runtime_error("no evidence " + evidence);
}

/// An object of the golden presses, every force of them so many times as large.
std::string withForcesTimes(double factor) {
  nlohmann::json json = nlohmann::json::parse(compiledData().fem_profiles);
  for (auto& one : json.at("cases")) {
    if (one.at("force_N").is_number()) one["force_N"] = factor * one.at("force_N").get<double>();
  }
  return json.dump();
}

}  // namespace

TEST(Credibility, EveryBarHoldsAndJsonHasTheSameNumbers) {
  EXPECT_TRUE(quickFile().holds()) << textOf(quickFile());
  const nlohmann::json json = readBack();
  EXPECT_TRUE(json.at("holds").get<bool>());
  std::size_t numbers = 0;
  for (const CredibilitySection& section : quickFile().sections) {
    for (const Evidence& evidence : section.evidence) {
      for (const CredibilityNumber& number : evidence.numbers) {
        EXPECT_EQ(valueIn(json, section.name, evidence.name, number.name), number.value);
        ++numbers;
      }
    }
  }
  EXPECT_GT(numbers, 80u);
}

TEST(Credibility, CountsArePrintedNumbersOfTheStudyOfNumbers) {
  const std::vector<NumberRow> rows = studyNumbers();
  const nlohmann::json json = readBack();
  EXPECT_EQ(valueIn(json, "code_verification", "numbers", "from_engine"), countRows(rows, Verdict::from_engine));
  EXPECT_EQ(valueIn(json, "code_verification", "numbers", "misprints"), countRows(rows, Verdict::misprint));
  EXPECT_EQ(valueIn(json, "code_verification", "numbers", "not_reproduced"), 0.0);
}

TEST(Credibility, TheHuntIsTheOneThatItsCommandNames) {
  const CredibilitySettings settings{.quick = true};
  lab::HuntPlan plan;
  plan.ticks = huntedTicks(settings);
  const lab::HuntResult alone = lab::hunt(plan);
  const nlohmann::json json = readBack();
  EXPECT_EQ(valueIn(json, "code_verification", "hunt", "ticks"), static_cast<double>(alone.ticks));
  EXPECT_EQ(valueIn(json, "code_verification", "hunt", "touching_ticks"), static_cast<double>(alone.touching_ticks));
  EXPECT_EQ(quickFile().evidence("hunt").command, "palpate study hunt --ticks 20000 --seed 1 --json");
}

TEST(Credibility, ErrorsAgainstTheIndependentSolverAreThoseOfRealism) {
  lab::FemCases cases = lab::parseFemCases(compiledData().fem_profiles, "fem_profiles.json");
  const std::string first = cases.cases.front().name;
  std::erase_if(cases.cases, [&](const lab::FemCase& one) { return one.name != first; });
  const lab::RealismFigures alone = lab::judgeRealism(lab::stacksOfCases(cases, {}));
  const lab::WorstErrors worst = alone.worst(&lab::JudgedPress::layered, lab::kJudgedFromMm);
  const Evidence& evidence = quickFile().evidence("fem_profiles");
  EXPECT_EQ(evidence.number("force_worst_percent"), 100.0 * worst.force_error);
  EXPECT_EQ(evidence.number("vector_worst_percent"), 100.0 * worst.vector_rms);
  EXPECT_EQ(evidence.number("drag_worst_percent"), 100.0 * alone.worstDrag(&lab::JudgedDrag::layered_rms));
  EXPECT_GE(evidence.number("force_count"), 2.0);
  EXPECT_LE(evidence.number("force_mean_percent"), evidence.number("force_p95_percent"));
}

TEST(Credibility, OtherNumbersAreThoseOfTheirStudies) {
  std::vector<TensorSet> sets = subjectSets(maps::ForceDirection::up);
  const auto down = subjectSets(maps::ForceDirection::down);
  sets.insert(sets.end(), down.begin(), down.end());
  const LeftOutErrors ellipses = leftOutErrors(sets, Interpolator::gri, kEffectRadius);
  EXPECT_EQ(quickFile().evidence("measured_ellipses").number("boundary_rms_mm"), ellipses.rms_mm);
  EXPECT_EQ(quickFile().evidence("measured_ellipses").number("boundary_worst_mm"), ellipses.most_mm);

  double worst = 0.0;
  for (const BeefLoss& loss : beefLosses(measureRelaxation(true, {}))) {
    worst = std::max(worst, 100.0 * std::abs(loss.lost - loss.recorded));
  }
  EXPECT_EQ(quickFile().evidence("relaxation").number("lost_force_worst_percent"), worst);

  EXPECT_EQ(quickFile().evidence("solver").number("hertz_force_error_percent"), 100.0 * lab::checkHertz().force_error);
  const lab::RefinedPress refined = lab::refinePress(checkedStack(), kCheckedDepthMm);
  EXPECT_EQ(quickFile().evidence("solver_mesh").number("grid_convergence_percent"), 100.0 * refined.grid_convergence);
}

TEST(Credibility, AForceThatIsWrongBreaksItsBar) {
  const std::string wrong = withForcesTimes(1.2);
  CredibilitySettings settings{.quick = true};
  settings.data.fem_profiles = wrong;
  const CredibilitySection section = validate(settings);
  EXPECT_FALSE(section.holds());
  const auto evidence = std::ranges::find(section.evidence, "fem_profiles", &Evidence::name);
  ASSERT_NE(evidence, section.evidence.end());
  EXPECT_NEAR(evidence->number("force_mean_percent"), 100.0 * (1.0 - 1.0 / 1.2), 1.0);
  EXPECT_NE(formatFinding(*evidence).find("BEYOND a bar"), std::string::npos);

  CredibilityFile file = quickFile();
  file.sections.at(2) = section;
  EXPECT_FALSE(nlohmann::json::parse(toJson(file)).at("holds").get<bool>());
  EXPECT_NE(textOf(file).find("a bar is BROKEN"), std::string::npos);
  EXPECT_NE(toHtml(file).find("A bar is BROKEN"), std::string::npos);
}

TEST(Credibility, AKeptBitThatIsOtherwiseIsSeen) {
  std::string kept(compiledData().kept_bits);
  const std::size_t at = kept.find("\"forces\": \"") + 11;
  kept[at] = kept[at] == '0' ? '1' : '0';
  CredibilitySettings settings{.quick = true};
  settings.data.kept_bits = kept;
  const CredibilitySection section = verifyCode(settings);
  EXPECT_FALSE(section.holds());
  EXPECT_EQ(section.evidence.at(1).number("scenes_differ"), 1.0);
  EXPECT_NE(formatFinding(section.evidence.at(1)).find("DIFFER from what was kept"), std::string::npos);
}

TEST(Credibility, NamesWhatIsNotComputed) {
  const nlohmann::json json = readBack();
  std::vector<std::string> limits;
  for (const auto& limit : json.at("limits")) limits.push_back(limit.at("name"));
  for (const char* missing : {"learners", "living_backs", "living_limbs", "lumps", "use error"}) {
    EXPECT_NE(std::ranges::find(limits, missing), limits.end()) << missing;
  }
  EXPECT_EQ(json.at("factors").size(), 13u);
  for (const auto& factor : json.at("factors")) {
    for (const std::string name : factor.at("evidence")) EXPECT_NO_THROW(quickFile().evidence(name));
  }
}

TEST(Credibility, SpreadIsDrawnFromTheSeedAndInOrder) {
  const Evidence& spread = quickFile().evidence("force_spread");
  EXPECT_LT(spread.number("force_p5_n"), spread.number("force_median_n"));
  EXPECT_LT(spread.number("force_median_n"), spread.number("force_p95_n"));
  EXPECT_LT(spread.number("force_p5_n"), spread.number("known_moduli_force_p5_n"));
  const Evidence& each = quickFile().evidence("force_by_input");
  EXPECT_LT(each.number("force_n_muscle_modulus_low"), each.number("force_n_muscle_modulus_high"));
  EXPECT_GT(each.number("force_n_thickness_low"), each.number("force_n_thickness_high")) << "bone is nearer";
  EXPECT_LT(each.number("force_n_finger_radius_low"), each.number("force_n_finger_radius_high"));
  const CredibilitySection again = propagateSpread({.quick = true});
  EXPECT_EQ(again.evidence.front().number("force_p95_n"), spread.number("force_p95_n"));
  const CredibilitySection other = propagateSpread({.seed = 2, .quick = true});
  EXPECT_NE(other.evidence.front().number("force_p95_n"), spread.number("force_p95_n"));
}

TEST(Credibility, RiskIsTheMeanOfInfluenceAndConsequenceRoundedUp) {
  using enum RiskLevel;
  const auto risk = [](RiskLevel influence, RiskLevel consequence) {
    return ContextOfUse{.influence = influence, .consequence = consequence}.risk();
  };
  EXPECT_EQ(risk(low, low), low);
  EXPECT_EQ(risk(medium, low), medium);
  EXPECT_EQ(risk(low, high), medium);
  EXPECT_EQ(risk(medium, high), high);
}

TEST(Credibility, OneHtmlFileHasEverySentence) {
  const support::TemporaryFolder folder;
  writeCredibility(quickFile(), folder / "credibility.html");
  writeCredibility(quickFile(), folder / "credibility.json");
  const std::string html = readFile(folder / "credibility.html", 1U << 24U);
  EXPECT_NE(html.find("Calculation verification"), std::string::npos);
  EXPECT_NE(html.find("Model risk is <strong>medium</strong>"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "needs no network";
  EXPECT_EQ(readFile(folder / "credibility.json", 1U << 24U), toJson(quickFile()));
  EXPECT_NE(support::thrownMessage([&] {
              writeCredibility(quickFile(), folder / "credibility.txt");
            }).find("must end in .html or .json"),
            std::string::npos);
}

}  // namespace palpate::study
