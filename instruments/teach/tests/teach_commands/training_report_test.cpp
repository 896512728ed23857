// `palpate train results report` of a record of training, from the outside: a page that a strict parser reads and that
// needs nothing else, for nobody, one and many; numbers that tools/check_report.py computes again from the exported
// tables; nobody's name.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "palpate/training/records/export.h"
#include "palpate/training/records/sqlite_sql.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"
#include "teach/report/training_figures.h"
#include "teach/tests/support/made_trainees.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::CommandResult;
using support::contentOf;
using training::SessionKind;

/// Reads the page as XML, strictly: says what in it runs code or loads something, then all its words, those of
/// pictures too.
constexpr const char* kTrainingPageReader = R"py(
import sys, xml.etree.ElementTree as tree
page = tree.parse(sys.argv[1])
wrong = []
for element in page.iter():
    if element.tag in ("link", "iframe", "object", "embed", "form", "base", "a"):
        wrong.append(element.tag)
    if element.tag == "script" and element.attrib.get("type") != "application/json":
        wrong.append("script")
    for name, value in element.attrib.items():
        if name.startswith("on") or name == "href" or (name == "src" and not value.startswith("data:image/")):
            wrong.append(name + "=" + value[:40])
    if element.tag == "img" and len(element.attrib.get("alt", "")) < 20:
        wrong.append("img without words")
print(";".join(wrong) if wrong else "good")
for element in page.iter():
    if element.tag in ("h1", "h2", "td", "li", "p", "th", "dd", "summary"):
        print(" ".join("".join(element.itertext()).split()))
)py";

bool hasWords(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Adds the trainees of these numbers; the pseudonym of the last, none for number 0.
training::Uuid addTrainees(const fs::path& records, int first, int last, const support::MadeCourse& course) {
  training::Store store(records, training::Store::Open::create_too);
  support::MadeTrainees made(store);
  training::Uuid trainee;
  for (int i = std::max(first, 1); i <= last; ++i) trainee = made.add(static_cast<std::uint64_t>(i), course);
  return trainee;
}

/// Where the records are that several tests copy; removed when the program ends.
struct KeptRecords {
  fs::path path = fs::temp_directory_path() / ("palpate_training_report_" + std::to_string(getpid()));

  KeptRecords() = default;
  ~KeptRecords() { fs::remove_all(path); }
  KeptRecords(const KeptRecords&) = delete;
  KeptRecords& operator=(const KeptRecords&) = delete;
  fs::path recordsFile(int trainees) const { return path / (std::to_string(trainees) + ".results"); }
};

class TrainingReport : public testing::Test {
 protected:
  static const KeptRecords& kept() {
    static const KeptRecords records;
    return records;
  }
  CommandResult palpate(const std::string& arguments) const { return support::runPalpate(arguments, folder_.path()); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::filesystem::path records() const { return folder_ / "class.results"; }

  /// So many trainees with a course of this kind; the pseudonym of the last.
  training::Uuid make(int trainees, const support::MadeCourse& course) const {
    return addTrainees(records(), 1, trainees, course);
  }

  /// As above, with the usual course. Each trainee is simulated once for all tests: the records of one number of
  /// trainees are those of one fewer, copied, and one more.
  training::Uuid make(int trainees) const {
    static std::map<int, training::Uuid> last_of;
    if (!last_of.contains(trainees)) {
      fs::create_directories(kept().path);
      for (int i = 0; i <= trainees; ++i) {
        if (last_of.contains(i)) continue;
        if (i > 0) fs::copy_file(kept().recordsFile(i - 1), kept().recordsFile(i));
        last_of[i] = addTrainees(kept().recordsFile(i), i, i, {});
      }
    }
    fs::copy_file(kept().recordsFile(trainees), records(), fs::copy_options::overwrite_existing);
    return last_of.at(trainees);
  }

  /// The words of a page that is as it should be.
  std::string wordsOf(const std::string& arguments) const {
    const CommandResult result = palpate("train results report class.results -o page.html " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    write("read.py", kTrainingPageReader);
    const CommandResult read = support::runProgram("/usr/bin/env", "python3 read.py page.html", folder_.path());
    EXPECT_EQ(read.out.substr(0, read.out.find('\n')), "good") << read.err;
    const std::string page = contentOf(folder_ / "page.html");
    EXPECT_EQ(page.find("://"), std::string::npos) << "works without a network";
    EXPECT_EQ(page.find("Muster"), std::string::npos) << "what somebody typed stays in the record";
    return read.out;
  }

  json numbers(const std::string& arguments = "") const {
    const CommandResult result = palpate("train results report class.results --json " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }

  void exportTables() const {
    training::SqliteSql sql(records(), trace::Database::Mode::read);
    training::RowTables rows(sql);
    std::filesystem::create_directories(folder_ / "tables");
    for (const training::ExportedFile& file : training::csvFiles(rows)) write("tables/" + file.name, file.text);
  }

  CommandResult check(const std::string& report) const {
    return support::runProgram(
        "/usr/bin/env",
        "python3 '" + (support::sourceFolder() / "tools/check_report.py").string() + "' " + report + " tables",
        folder_.path());
  }

  support::TemporaryFolder folder_;
};

class TrainingReportOfAClass : public TrainingReport {};

TEST_F(TrainingReport, NobodyIsAPageTooThatSaysSo) {
  make(0);
  const std::string words = wordsOf("");
  EXPECT_TRUE(hasWords(words, "No trainee has any record here yet."));
  EXPECT_TRUE(hasWords(words, "do not show skill on patients"));
}

TEST_F(TrainingReport, SpeaksTheLanguageThatIsAskedFor) {
  const training::Uuid trainee = make(1);
  const std::string german = wordsOf("--language de");
  for (const char* wanted : {"Trainingsbericht", "Kleinste sichere Änderung: etwa", "Erster Test (Vortest)",
                             "Lernkurve", "Richtige Antworten", "größte Kraft (N)", "Datenqualität"}) {
    EXPECT_TRUE(hasWords(german, wanted)) << wanted;
  }
  EXPECT_TRUE(hasWords(wordsOf("--language es"), "Menor cambio fiable: alrededor del"));
  json spoken = numbers("--language de");
  json english = numbers();
  EXPECT_NE(spoken["sentences"], english["sentences"]);
  for (json* object : {&spoken, &english}) object->erase("sentences");
  EXPECT_TRUE(spoken == english) << "what machines read has no language";
  const CommandResult summary =
      palpate("train results trainee " + trainee.substr(0, 8) + " class.results --language de");
  EXPECT_NE(summary.out.find("Durchgänge, seit"), std::string::npos) << summary.out << summary.err;
}

TEST_F(TrainingReport, OneTraineeIsToldEverythingInWords) {
  support::MadeCourse course;
  course.kinds.push_back(SessionKind::exam);
  const training::Uuid trainee = make(1, course);
  const std::string words = wordsOf("");
  for (const std::string& wanted : {"Training report: trainee " + trainee.substr(0, 8),
                                    std::string("Smallest reliable change: about"),
                                    std::string("First test (pre-test)"),
                                    std::string("Learning curve"),
                                    std::string("Fitted function"),
                                    std::string("Right answers"),
                                    std::string("corrected for chance"),
                                    std::string("What was felt"),
                                    std::string("greatest force (N)"),
                                    std::string("Force and speed"),
                                    std::string("mean force while searching (N)"),
                                    std::string("Time for a trial"),
                                    std::string("Which sites were confused"),
                                    std::string("Data quality"),
                                    std::string("easy trials (lapse check)"),
                                    std::string("simulated hand, soft thimble"),
                                    std::string("SHA-256 of its settings"),
                                    std::string("right half of the time (version 1)"),
                                    std::string("do not show skill on patients"),
                                    std::string("on the diagonal"),
                                    std::string("Least often felt: site")}) {
    EXPECT_TRUE(hasWords(words, wanted)) << wanted;
  }
  const std::string page = contentOf(folder_ / "page.html");
  for (const char* figure : {"curve", "fit", "accuracy", "coverage_tests", "coverage_practice", "handling", "seconds",
                             "answers_tests", "answers_practice"}) {
    EXPECT_TRUE(hasWords(page, "<figure id=\"" + std::string(figure) + "\">")) << figure;
  }
}

TEST_F(TrainingReport, AClassIsToldTogetherAndEachByPseudonym) {
  const training::Uuid last = make(6);
  const std::string words = wordsOf("");
  EXPECT_TRUE(hasWords(words, "Training report: class"));
  EXPECT_TRUE(hasWords(words, "6 trainees."));
  EXPECT_TRUE(hasWords(words, "From first to last test, 5 trainees")) << "one test looks like a burst of inattention";
  EXPECT_TRUE(hasWords(words, "Every trainee"));
  EXPECT_TRUE(hasWords(words, last.substr(0, 8)));
  EXPECT_FALSE(hasWords(words, last)) << "nor longer than it must be";
}

TEST_F(TrainingReportOfAClass, EveryNumberIsComputedAgainFromTheExportedTables) {
  support::MadeCourse course;
  course.kinds = {SessionKind::pre_test, SessionKind::mastery, SessionKind::practice, SessionKind::post_test,
                  SessionKind::exam};
  const training::Uuid trainee = make(5, course);
  exportTables();
  for (const std::string& whose : {std::string("--class"), "--trainee " + trainee.substr(0, 8)}) {
    ASSERT_EQ(palpate("train results report class.results -o page.html " + whose).exit_code, 0);
    const CommandResult checked = check("page.html");
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    EXPECT_TRUE(hasWords(checked.out, " 0 differ")) << checked.out;
  }
}

TEST_F(TrainingReport, ANumberThatIsNotThatOfTheTablesIsFound) {
  make(1);
  exportTables();
  json report = numbers();
  report["trainees"][0]["points"][0]["threshold"]["median"] =
      report["trainees"][0]["points"][0]["threshold"]["median"].get<double>() + 1e-5;
  write("spoilt.json", report.dump());
  EXPECT_EQ(check("spoilt.json").exit_code, 1);
  report = numbers();
  report["trainees"][0]["tests"]["invented"] = 4;
  write("spoilt.json", report.dump());
  EXPECT_EQ(check("spoilt.json").exit_code, 1) << "a number that nobody computes";
}

TEST_F(TrainingReport, APageHoldsTheNumbersThatJsonPrints) {
  make(2);
  wordsOf("--class");
  const std::string page = contentOf(folder_ / "page.html");
  const std::string begin = "<script type=\"application/json\" id=\"numbers\">";
  const std::size_t from = page.find(begin) + begin.size();
  EXPECT_EQ(json::parse(page.substr(from, page.find("</script>", from) - from)), numbers("--class"));
}

TEST_F(TrainingReport, ATraineeIsFoundByCodeOrPseudonymAndCalledByTheCodeOnlyIfItWasTyped) {
  const training::Uuid trainee = make(3);
  const std::string code = training::makeTraineeCode(3);
  EXPECT_TRUE(hasWords(wordsOf("--trainee " + code), "Training report: trainee " + code));
  EXPECT_EQ(numbers("--trainee " + code)["trainees"][0]["trainee"], trainee.substr(0, 8));
  const std::string by_pseudonym = wordsOf("--trainee " + trainee.substr(0, 8));
  EXPECT_TRUE(hasWords(by_pseudonym, "Training report: trainee " + trainee.substr(0, 8)));
  EXPECT_EQ(contentOf(folder_ / "page.html").find(code), std::string::npos);
  const CommandResult unknown = palpate("train results report class.results --trainee 00000000");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(hasWords(unknown.err, "has no trainee '00000000'")) << unknown.err;
}

TEST_F(TrainingReport, ATraineeSeesOthersQuartilesOnlyWhereFiveStandBehindThem) {
  const std::string code = training::makeTraineeCode(1);
  make(4);
  EXPECT_TRUE(numbers("--trainee " + code)["others"].empty());
  make(5);
  const json others = numbers("--trainee " + code)["others"];
  ASSERT_EQ(others.size(), 5u);
  EXPECT_EQ(others[0]["medians"]["count"], 5);
}

TEST_F(TrainingReport, WhatIsNoRecordIsRefusedInOneLine) {
  write("broken.results", "SQLite format 3, but not really a database at all");
  write("run.session", "no session");
  for (const char* arguments :
       {"train results report broken.results", "train results report missing.results",
        "train results report run.session --class", "train results report class.results --class --trainee X"}) {
    make(0);
    const CommandResult result = palpate(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST_F(TrainingReport, NoTextOfAPictureCoversAnother) {
  make(6);
  const app::TrainingReport report =
      app::trainingReport({.file = records(), .trainee = {}, .only_class = {}, .whole_class = true}, {});
  const training::TrialStatistics& tests = report.statistics.all.tests;
  const training::TrialStatistics& practice = report.statistics.all.practice;
  std::vector<app::TrainingPicture> pictures = {
      app::classCurvePicture(report.statistics), app::collapsedPicture(report.statistics.all.collapsed),
      app::accuracyPicture(tests, practice),     app::handlingPicture(tests, practice),
      app::secondsPicture(tests, practice),      app::answersPicture(tests, "tests")};
  const auto& trainee = report.statistics.trainees.front();
  pictures.push_back(app::fitPicture({&trainee.points.front(), &trainee.points.back()}));
  for (const app::TrainingPicture& picture : pictures) {
    const std::vector<figures::DrawnText> texts = figures::collectDrawnTexts(picture.figure);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      for (std::size_t j = i + 1; j < texts.size(); ++j) {
        const figures::DrawnText& a = texts[i];
        const figures::DrawnText& b = texts[j];
        const bool apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
        EXPECT_TRUE(apart) << picture.id << ": " << a.text << " covers " << b.text;
      }
    }
  }
}

}  // namespace
}  // namespace palpate
