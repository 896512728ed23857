// The result of a study: one page of findings, with its tables and figures as data.
//
// A study computes a StudyPage and writes nothing; the page is then written as Markdown, CSV, PNG and SVG (writePage)
// or becomes a chapter of a report. Numbers in findings come from the run and decide the verdict: findings are
// functions of the measurement in files of their own, and a test breaks their numbers
// (instruments/study/dissertation/tests/study/*_verdicts_test.cpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "report/charts/figure.h"

namespace palpate::study {

// A table of words as people read it on a terminal, in Markdown and in CSV.

struct TextTable {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;  ///< one cell per heading in each
};

/// Columns padded to equal width, the last one ragged.
std::string plainText(const TextTable& table);
std::string toMarkdown(const TextTable& table);
/// Every cell in quotes.
std::string toCsv(const TextTable& table);

struct StudySettings {
  bool quick = false;  ///< smaller models, fewer repetitions: below 3 s, for tests; its times mean little
  Progress progress{};
  std::optional<std::uint64_t> seed{};  ///< for a study that draws its cases (Study::draws)
  std::optional<std::size_t> cases{};   ///< how many it draws
  bool map = false;                     ///< for a study that has one (Study::maps): that alone
  std::string family{};                 ///< for a study that has several (Study::families): that alone; empty: the rest
};

struct StudyFigure {
  std::string stem;     ///< file name without extension, for example "hdb_punctures"
  std::string caption;  ///< one or two sentences: what is seen
  figures::Figure figure;
};

struct StudyTable {
  std::string stem;   ///< file name without extension
  std::string title;  ///< a sentence above the table
  TextTable table;
  bool shown = true;  ///< false: long, so a CSV file only
  /// The rows are in the JSON object under this name too, an object each by the headings; cells that are numbers as
  /// numbers. Empty: they are not.
  std::string key{};
};

struct StudyPage {
  std::string name{};  ///< name of the Markdown file; empty: the subcommand's
  std::string title;
  std::string question;               ///< one paragraph
  std::vector<std::string> findings;  ///< paragraphs, most important first
  std::vector<std::string> method;    ///< how it was measured and what replaces what, in paragraphs
  std::vector<StudyTable> tables;
  std::vector<StudyFigure> figures;
  std::vector<std::pair<std::string, double>> numbers;  ///< the main results by name, with the unit in it, for programs
  /// The JSON object has them next to `study` too, not only in `numbers`; there "a.b" is the member b of an object a.
  bool numbers_on_top = false;
  /// The same for lists of words. Where `figures` is an object by now, the names of files are its member `files`.
  std::vector<std::pair<std::string, std::vector<std::string>>> words{};
  std::string command{};  ///< command that makes this page again
  std::string machine{};  ///< machine of the run
  double seconds = 0.0;   ///< duration of the run
};

/// Findings, figures (as PNG in the same folder), tables, method, command and machine.
std::string toMarkdown(const StudyPage& page);

/// study, title, findings, numbers, figures and tables (names of files), command, machine, seconds. One JSON object.
std::string toJson(const StudyPage& page);

/// The findings as people read them on a terminal, wrapped.
std::string textOf(const StudyPage& page);

/// DIR/<name>.md, and for every figure PNG, SVG and its curves as CSV, for every table CSV. The folder is made when
/// missing. Throws Error naming a file that cannot be written.
void writePage(const StudyPage& page, const std::filesystem::path& folder, const Progress& progress = {});

/// Makes a folder and its parents where they are missing. Throws Error naming it.
void makeFolder(const std::filesystem::path& folder);

// ---- writing numbers into findings and tables

/// 41582 as "41,582".
std::string counted(double number);
/// To `digits` significant digits, never with an exponent: 0.01234 -> "0.012", 1234 -> "1200" for 2.
std::string rounded(double number, int digits = 2);
/// 0.1234 -> "12 %", 0.0123 -> "1.2 %".
std::string percent(double share);

/// The least and the most of some positive numbers.
struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;  ///< ratios and sizes are positive
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  operator Json() const { return {least, most}; }  ///< among the values of a finding: {x|rounded " to "}
};

/// A study that writes a page: its name, its help and how it is run. instruments/study/dissertation/studies.cpp lists
/// them; `palpate study NAME`, `study all` and the report find them there.
struct Study {
  std::string name;  ///< name of the subcommand
  std::string what;  ///< its help, one line
  std::function<StudyPage(const StudySettings& settings)> run;
  bool draws = false;                   ///< draws its cases from a seed: it takes --seed and --cases
  bool maps = false;                    ///< it has a map of its own that takes minutes: it takes --map
  std::vector<std::string> families{};  ///< families of cases that --family may select
  std::size_t family_cases = 0;         ///< cases of a family where --cases is not given
};

}  // namespace palpate::study
