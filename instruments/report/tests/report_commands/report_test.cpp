// `palpate recording report` from the outside: a page that a strict parser reads and that needs nothing else, numbers
// that agree with those counted from the exported table, and something to read of every recording that can be read at
// all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/kit/readable_text.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "palpate/trace/database.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/sample_block.h"
#include "report/recording/recording_report.h"
#include "support/mesh_zoo.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using nlohmann::json;
using support::CommandResult;
using support::contentOf;

/// Reads the page as XML, strictly, and says what is wrong with it: elements that run code or load something.
constexpr const char* kPageReader = R"py(
import sys, xml.etree.ElementTree as tree
page = tree.parse(sys.argv[1])
wrong = []
for element in page.iter():
    if element.tag in ("script", "link", "iframe", "object", "embed", "form", "base", "a"):
        wrong.append(element.tag)
    for name, value in element.attrib.items():
        if name.startswith("on") or name == "href" or (name == "src" and not value.startswith("data:image/")):
            wrong.append(name + "=" + value[:40])
    if element.tag == "img" and not element.attrib.get("alt"):
        wrong.append("img without alt")
print(";".join(wrong) if wrong else "good")
for element in page.iter():
    if element.tag in ("h1", "h2", "td", "li", "p", "th"):
        print(" ".join("".join(element.itertext()).split()))
)py";

class ReportCommand : public testing::Test {
 protected:
  void SetUp() override {
    saveDome(20.0);
    // Two contacts: a press in place, a light glide.
    write("path.csv",
          "t_s,x_mm,y_mm,z_mm\n0,0,0,30\n0.3,0,0,15\n1.0,0,0,15\n1.2,0,0,30\n1.5,0,0,19\n1.6,0,0,19\n2.0,30,0,18.2\n"
          "2.2,30,0,30\n");
    write("air.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,60\n0.5,10,0,60\n");
  }
  void saveDome(double top_mm, const Vec2& corner = {-100.0, -100.0}) const {
    mesh::save(folder_ / "dome.obj", zoo::dome(corner, 10.0, top_mm));
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CommandResult palpate(const std::string& arguments) const { return support::runPalpate(arguments, folder_.path()); }
  void record(const std::string& fingers = "--trajectory path.csv --trajectory path.csv") const {
    const CommandResult result = palpate("simulate dome.obj " + fingers + " --radius-mm 4 --no-pictures --session");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::filesystem::rename(folder_ / "results/run.session", folder_ / "run.session");
  }
  void change(const std::string& sql) const {
    trace::Database(folder_ / "run.session", trace::Database::Mode::write).run(sql);
  }
  json numbers(const std::string& arguments = "run.session") const {
    const CommandResult result = palpate("recording report --json " + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  /// The words of a page that is as it should be.
  std::string wordsOf(const std::string& page) const {
    write("read.py", kPageReader);
    const CommandResult read = support::runProgram("/usr/bin/env", "python3 read.py " + page, folder_.path());
    EXPECT_EQ(read.out.substr(0, read.out.find('\n')), "good") << read.err;
    EXPECT_EQ(contentOf(folder_ / page).find("://"), std::string::npos) << "works without a network";
    return read.out;
  }
  std::string report(const std::string& arguments = "run.session") const {
    const CommandResult result = palpate("recording report " + arguments + " -o page.html");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return wordsOf("page.html");
  }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

  support::TemporaryFolder folder_;
};

TEST_F(ReportCommand, WritesOnePageThatNeedsNothingElse) {
  record();
  const CommandResult result = palpate("recording report run.session");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(has(result.out, "run.session -> run.html")) << result.out;
  const std::string words = wordsOf("run.html");
  for (const char* wanted : {"Recording run.session", "Over time", "How often", "Search and palpation", "On the body",
                             "Contacts", "Safety", "The loop and its record", "What the terms mean", "peak force (N)",
                             "share of the back that was touched", "Emergency stops: 0."}) {
    EXPECT_TRUE(has(words, wanted)) << wanted;
  }
  const std::string page = contentOf(folder_ / "run.html");
  for (const char* figure : {"course", "distributions", "body"}) {
    EXPECT_TRUE(has(page, "<figure id=\"" + std::string(figure) + "\">")) << figure;
  }
}

// --- numbers ---

struct CountedFinger {
  std::vector<double> forces;  ///< in contact
  std::vector<double> depths;
  std::vector<std::pair<double, double>> contacts;  ///< begin and last tick, s
  std::size_t rows = 0;
};

/// From the exported table, by means that the report does not use.
std::map<std::string, CountedFinger> countedIn(const std::filesystem::path& table) {
  std::map<std::string, CountedFinger> fingers;
  trace::forEachForcesRow(table, [&](const trace::ForcesRow& row) {
    CountedFinger& finger = fingers[std::string(row.finger)];
    ++finger.rows;
    if (row.touch == contact::Touch::free) return;
    finger.forces.push_back(row.force.norm());
    finger.depths.push_back(row.depth_mm);
    if (finger.contacts.empty() || row.time_s - finger.contacts.back().second > 0.0215) {
      finger.contacts.emplace_back(row.time_s, row.time_s);
    }
    finger.contacts.back().second = row.time_s;
  });
  for (auto& [name, finger] : fingers) {
    std::sort(finger.forces.begin(), finger.forces.end());
    std::sort(finger.depths.begin(), finger.depths.end());
  }
  return fingers;
}

double meanValue(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void expectSizes(const json& sizes, const std::vector<double>& sorted) {
  const std::size_t count = sorted.size();
  EXPECT_EQ(sizes["ticks"], count);
  EXPECT_NEAR(sizes["mean"].get<double>(), meanValue(sorted), 1e-9);
  EXPECT_NEAR(sizes["max"].get<double>(), sorted.back(), 1e-12);
  EXPECT_NEAR(sizes["median"].get<double>(), sorted[count / 2], 0.01 + sorted[count / 2 + 1] - sorted[count / 2 - 1]);
  EXPECT_NEAR(sizes["p95"].get<double>(), sorted[count * 95 / 100], 0.02);
}

TEST_F(ReportCommand, SpeaksTheLanguageThatIsAskedFor) {
  record();
  const std::string german = report("run.session --language de");
  for (const char* wanted : {"Aufzeichnung run.session", "Kontakte", "Suchen und Palpieren", "Not-Halte: 0."}) {
    EXPECT_TRUE(has(german, wanted)) << wanted;
  }
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<html lang=\"de\">"));
  EXPECT_TRUE(has(german, "dauert 2,2 s")) << "a decimal comma";
  EXPECT_TRUE(has(report("run.session --language es"), "Paradas de emergencia: 0."));
  json spoken = numbers("run.session --language de");
  json english = numbers();
  EXPECT_NE(spoken["sentences"], english["sentences"]);
  for (json* object : {&spoken, &english}) object->erase("sentences");
  EXPECT_TRUE(spoken == english) << "what machines read has no language";
  const CommandResult wrong = palpate("recording report run.session --language fr");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(has(wrong.err, "en|de|es")) << wrong.err;
}

TEST_F(ReportCommand, ItsNumbersAreThoseOfTheExportedTable) {
  record();
  ASSERT_EQ(palpate("recording export run.session --csv all.csv").exit_code, 0);
  const json all = numbers();
  const auto counted = countedIn(folder_ / "all.csv");
  ASSERT_EQ(all["fingers"].size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    const json& finger = all["fingers"][f];
    const CountedFinger& expected = counted.at(finger["name"]);
    EXPECT_EQ(finger["ticks"], expected.rows);
    EXPECT_EQ(finger["touching_ticks"], expected.forces.size());
    expectSizes(finger["force_n"], expected.forces);
    expectSizes(finger["depth_mm"], expected.depths);
    ASSERT_EQ(expected.contacts.size(), 2u);
    EXPECT_EQ(finger["contacts"], 2);
    double phases = 0.0;
    for (const json& phase : finger["phases"]) phases += phase["seconds"].get<double>();
    EXPECT_NEAR(phases, static_cast<double>(expected.rows) / 1000.0, 1e-9);
    EXPECT_GT(finger["phases"]["palpation"]["seconds"], 0.5) << "0.7 s of pressing 5 mm deep";
    EXPECT_GT(finger["phases"]["search"]["seconds"], 0.3) << "0.4 s of gliding at 75 mm/s";
  }
  std::vector<std::pair<double, double>> listed;
  for (const json& contact : all["contacts"]) {
    if (contact["finger"] != 0) continue;
    const double begin = contact["begin_s"];
    listed.emplace_back(begin, begin + contact["seconds"].get<double>() - 0.001);
  }
  const auto& expected = counted.at(all["fingers"][0]["name"]).contacts;
  ASSERT_EQ(listed.size(), expected.size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    EXPECT_NEAR(listed[i].first, expected[i].first, 1e-9);
    EXPECT_NEAR(listed[i].second, expected[i].second, 1e-9);
  }
  EXPECT_NEAR(all["contacts"].back()["path_mm"].get<double>(), 30.0, 3.0) << "the glide of the second contact";
  EXPECT_EQ(all["ticks"]["missing"], 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.html")) << "--json alone writes no page";
}

TEST_F(ReportCommand, TheTouchedAreaIsThatOfTheFingersWay) {
  record("--trajectory path.csv");
  const json coverage = numbers()["coverage"];
  // A disc of 4 mm radius that glided 30 mm: 30 * 8 + 16 pi; the dome's slope adds little.
  EXPECT_NEAR(coverage["touched_back_mm2"].get<double>(), 290.0, 40.0);
  EXPECT_NEAR(coverage["back_mm2"].get<double>(), 40000.0, 1500.0) << "200 mm square, hardly curved";
  EXPECT_NEAR(coverage["touched_back_share"].get<double>(), 290.0 / 40000.0, 0.0015);
}

TEST_F(ReportCommand, PlacesOfABodyWithNamesAreSaidInWords) {
  write("torso.toml",
        "[body]\nkind = \"torso\"\ntriangles = 8163\n\n[[finger]]\nname = \"index\"\nat = \"T6 right 20 mm\"\n"
        "script = [{ do = \"press\", depth_mm = 5, seconds = 0.2 }]\n");
  ASSERT_EQ(palpate("simulate torso.toml --no-pictures --session").exit_code, 0);
  std::filesystem::rename(folder_ / "results/run.session", folder_ / "run.session");
  const std::string where = numbers()["contacts"][0]["peak_where"];
  EXPECT_EQ(where.substr(0, 7), "T6, 20 ") << where;
  EXPECT_TRUE(has(report(), where));
  std::filesystem::remove_all(folder_ / "results");
  record("--trajectory path.csv");
  EXPECT_FALSE(numbers()["contacts"][0].contains("peak_where")) << "a mesh has no names";
}

TEST_F(ReportCommand, APartOfIt) {
  record("--trajectory path.csv");
  const json part = numbers("run.session --from 1.25 --to 2.2");
  EXPECT_EQ(part["fingers"][0]["contacts"], 1);
  EXPECT_EQ(part["ticks"]["recorded"], 951);
  EXPECT_NEAR(part["contacts"][0]["begin_s"].get<double>(), 1.364, 0.003)
      << "from 30 to 19 mm within 0.3 s: at 24 mm a sphere of 4 mm stands on the top of 20 mm";
  EXPECT_TRUE(has(report("run.session --from 1.25 --to 2.2"), "this report is of 1.25 s to 2.20 s"));
  EXPECT_EQ(palpate("recording report run.session --from 99").exit_code, 2);
}

// --- what a stranger's recording may hold ---

TEST_F(ReportCommand, HostileWordsStayWords) {
  record();
  change("UPDATE session SET notes = '</td><script>alert(1)</script> & \"q\" `a **b` c** ' || char(1) || char(27)");
  change(
      "UPDATE session SET tags = CAST(X'41ff42c0af43eda080' AS TEXT), ended_by = '<b>', software = ']]>', "
      "machine = '<!--'");
  change("UPDATE fingers SET name = '<img src=x onerror=alert(1)>', device = '&amp;' WHERE id = 0");
  change(
      "INSERT INTO events(tick, finger, kind, text) VALUES (700, 0, 'mark', '<script>here</script>'), "
      "(800, 9000, '<kind>', 'of no finger'), (5, NULL, 'mark', '" +
      std::string(3000, 'x') + "')");
  change("UPDATE worlds SET body = '<svg onload=alert(1)>'");
  const std::string words = report();
  EXPECT_TRUE(has(words, "<script>alert(1)</script> & \"q\" `a **b` c**")) << "as it was written";
  EXPECT_TRUE(has(words, "<img src=x onerror=alert(1)>"));
  EXPECT_TRUE(has(words, "<script>here</script>"));
  EXPECT_EQ(palpate("recording report --json run.session").exit_code, 0) << "JSON of what is not UTF-8";
}

TEST_F(ReportCommand, OfNoContact) {
  record("--trajectory air.csv");
  const std::string words = report();
  EXPECT_TRUE(has(words, "touched nothing"));
  EXPECT_TRUE(has(words, "No finger touched the skin."));
  EXPECT_FALSE(has(contentOf(folder_ / "page.html"), "<figure id=\"body\">"));
  EXPECT_EQ(numbers()["contact_count"], 0);
}

TEST_F(ReportCommand, OfNoTick) {
  record();
  change("DELETE FROM blocks");
  EXPECT_TRUE(has(report(), "there is not a single tick"));
  EXPECT_EQ(numbers()["ticks"]["recorded"], 0);
}

TEST_F(ReportCommand, OfOneThatHasNoEnd) {
  record();
  std::filesystem::rename(folder_ / "run.session", folder_ / "run.session.partial");
  trace::Database(folder_ / "run.session.partial", trace::Database::Mode::write)
      .run("UPDATE session SET ended_utc = NULL, ended_by = NULL");
  ASSERT_EQ(palpate("recording report run.session.partial").exit_code, 0);
  EXPECT_TRUE(has(wordsOf("run.html"), "no end: it is being written, or its program was killed"));
}

TEST_F(ReportCommand, MissingTicksBitsAndDroppedSamplesAreTold) {
  record("--trajectory path.csv");
  change("DELETE FROM blocks WHERE part = 4");
  change("UPDATE session SET dropped = 12");
  const json all = numbers();
  EXPECT_EQ(all["ticks"]["missing"], 150);
  EXPECT_NEAR(all["ticks"]["longest_gap_s"].get<double>(), 0.15, 1e-9);
  EXPECT_EQ(all["fingers"][0]["contacts"], 3) << "the gap parts the first one";
  const std::string words = report();
  EXPECT_TRUE(has(words, "150 of 2,201 ticks are missing (6.8 %), in 1 gap; the longest gap is 150 ms"));
  EXPECT_TRUE(has(words, "12 samples were dropped"));
}

TEST_F(ReportCommand, ADamagedBlockIsNamedAndLeavesNoPage) {
  record();
  change("UPDATE blocks SET crc32 = crc32 + 1 WHERE id = 3");
  const CommandResult result = palpate("recording report run.session");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(has(result.err, "block 3")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.html"));
}

/// Samples of any bits, in a world that no scene builds.
class ReportOfAnyBits : public ReportCommand {};

TEST_F(ReportOfAnyBits, IsAPage) {
  Random random(41);
  {
    trace::RecordingWriter writer(folder_ / "run.session",
                                  {.started_utc = "", .software = "", .machine = "", .notes = {}, .tags = {}},
                                  {{"", ""}});
    writer.add(trace::RecordingWorld{"no scene", "/nowhere", "body", 7, 1, {{"radius_mm = 1e300", ""}}});
    std::uint64_t tick = 0;
    for (int i = 0; i < 1200; ++i) {
      trace::Sample sample;
      for (const trace::SampleColumn& column : trace::sampleColumns()) {
        const std::uint64_t bits = (random.below(1u << 31) << 33) ^ random.below(1u << 31);
        column.set(sample, column.name == "touch" ? bits % 3 : bits);
      }
      if (i % 2 == 0) sample.contact.proxy = {random.uniform(-1e6, 1e6), random.uniform(0.0, 5.0), 1.0};
      if (i % 3 == 0) sample.world = 0;
      sample.finger = 0;
      sample.tick = tick += i == 600 ? std::uint64_t{1} << 55 : 1 + random.below(40);
      writer.add(sample);
    }
    writer.finish("done");
  }
  for (const char* rate : {"1000.0", "1e-300", "1e300"}) {
    change(std::string("UPDATE session SET ticks_per_s = ") + rate);
    const CommandResult result = palpate("recording report run.session -o wild.html");
    ASSERT_EQ(result.exit_code, 0) << rate << ": " << result.err;
    wordsOf("wild.html");
    EXPECT_EQ(palpate("recording report run.session --json").exit_code, 0);
  }
}

// --- the body ---

TEST_F(ReportCommand, WithoutItsBodyThereIsAPlanAndTheReason) {
  record();
  std::filesystem::create_directory(folder_ / "moved");
  std::filesystem::rename(folder_ / "dome.obj", folder_ / "moved/dome.obj");
  const std::string words = report();
  EXPECT_TRUE(has(words, "The body cannot be built: ")) << words;
  EXPECT_TRUE(has(words, "dome.obj"));
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<figure id=\"plan\">"));
  EXPECT_FALSE(has(report("run.session --folder moved"), "cannot be built"));
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<figure id=\"body\">"));
}

TEST_F(ReportCommand, ARecordingThatCarriesItsBodyNeedsNoOther) {
  record();
  ASSERT_EQ(palpate("recording bundle run.session -o bundle.session").exit_code, 0);
  std::filesystem::remove(folder_ / "dome.obj");
  EXPECT_FALSE(has(report("bundle.session"), "cannot be built"));
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<figure id=\"body\">"));
}

TEST_F(ReportCommand, AnotherBodyIsNotPaintedOn) {
  record();
  saveDome(60.0);
  EXPECT_TRUE(has(report(), "are not on its skin"));
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<figure id=\"plan\">"));
  mesh::save(folder_ / "dome.obj", zoo::grid(8, 100.0));
  EXPECT_TRUE(has(report(), "it has 128 triangles instead of 800"));
  saveDome(20.2);
  const std::string words = report();
  EXPECT_TRUE(has(words, "not bit-identical to the recorded ones"));
  EXPECT_TRUE(has(contentOf(folder_ / "page.html"), "<figure id=\"body\">"));
}

// --- where it is written ---

TEST_F(ReportCommand, ReplacesItsOwnPageAndNothingElse) {
  record("--trajectory path.csv");
  ASSERT_EQ(palpate("recording report run.session").exit_code, 0);
  EXPECT_EQ(palpate("recording report run.session").exit_code, 0) << "an earlier report";
  write("run.html", "<html>mine</html>");
  const CommandResult foreign = palpate("recording report run.session");
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_TRUE(has(foreign.err, "exists already and is not a report")) << foreign.err;
  EXPECT_EQ(contentOf(folder_ / "run.html"), "<html>mine</html>");
  EXPECT_EQ(palpate("recording report run.session -o run.html").exit_code, 0) << "somebody named it";
  const std::string recording = contentOf(folder_ / "run.session");
  EXPECT_EQ(palpate("recording report run.session -o run.session").exit_code, 2);
  EXPECT_EQ(contentOf(folder_ / "run.session"), recording);
}

TEST(ReadableText, KeepsUtf8AndReplacesWhatIsNone) {
  using app::readableText;
  const std::string good = "a\tb\nü ° ≤ 😀";
  EXPECT_EQ(readableText(good), good);
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(readableText("a\x01\x1b\x7f\r"), "a" + mark + mark + mark + mark);
  EXPECT_EQ(readableText("\xff"), mark);
  EXPECT_EQ(readableText("\xc0\xaf"), mark + mark) << "overlong";
  EXPECT_EQ(readableText("\xed\xa0\x80"), mark + mark + mark) << "a surrogate";
  EXPECT_EQ(readableText("\xe2\x82"), mark + mark) << "torn off";
  EXPECT_EQ(readableText("\xf4\x90\x80\x80"), mark + mark + mark + mark) << "beyond U+10FFFF";
  EXPECT_EQ(readableText("\xef\xbf\xbe"), mark + mark + mark);
}

TEST(DurationWords, AreRoundAndHaveUnits) {
  EXPECT_EQ(app::formatDuration(0.25), "0.250 s");
  EXPECT_EQ(app::formatDuration(62.34), "62.3 s");
  EXPECT_EQ(app::formatDuration(179.9), "3 min 00 s");
  EXPECT_EQ(app::formatDuration(3725.4), "1 h 02 min 05 s");
}

}  // namespace
}  // namespace palpate
