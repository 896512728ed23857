// Findings as prose: one text file per study, NAME_findings.txt, filled from the values that the study computed.
//
// The file is next to NAME_findings.cpp, which computes the values and decides the verdicts, and is compiled in
// (palpate_embed_findings in cmake/PalpateRooms.cmake). Its grammar is all there is:
//
//   words without [ in them    what the file is; before the first paragraph only
//   [name]                     on a line of its own: the paragraph of one finding; a line break in it is a space
//   {x}                        the value x: a text as it is, a number in full
//   {x|counted}                41,582; so {x|rounded} or {x|rounded 3} (digits), {x|percent} of a share, {x|fixed} or
//                              {x|fixed 2} (decimals), {x|short} or {x|short 1} (printf's %g)
//   {x|percent " to "}         of a list: each value, and these words between two of them (without words: ", ")
//   {x|as name}                the paragraph `name` filled with x, an object of values, or with each of a list of them
//   {x ? "text" : "text"}      the first text when x is true, not 0, not an empty list, else the second; `: "text"`
//                              may be left out, then there is none
//   {x ? word "text" word "text"}   the text of the word that x is
//
// Texts of a choice are written by the same grammar; \" is a quotation mark in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/json.h"
#include "report/page/study_page.h"

namespace palpate::study {

using FindingValues = Json;

/// A text as compiled in.
struct FindingsFile {
  std::string_view path;  ///< in the repository, for messages
  std::string_view text;
};

/// The findings in the order of the file. `values` has a member for each paragraph: the object of its values, a list of
/// such objects for several findings, null for none. Paragraphs without values, which are always printed, and those
/// that only `as` names have no member. Throws Error naming file and line for text that cannot be parsed, for names
/// that are not those of the values, and for words that a choice does not have.
std::vector<std::string> formatFindings(const FindingsFile& file, const FindingValues& values);

// The contents of a file, for tests that go through all of it.

struct FindingsPart {
  std::size_t line = 0;  ///< counted from 1
  std::string name{};    ///< name of a value; empty: `text` as it is
  std::string text{};
  std::string format{};                            ///< rounded, counted and so on; empty: unchanged
  int digits = 0;                                  ///< digits of the format; 0: none given
  std::string paragraph{};                         ///< paragraph named by `as`
  std::string between = ", ";                      ///< separator of a list
  std::vector<std::string> words{};                ///< words of a choice: yes and no, or its own
  std::vector<std::vector<FindingsPart>> texts{};  ///< one per word
};

struct FindingsParagraph {
  std::size_t line = 0;
  std::string name;
  std::vector<FindingsPart> parts{};
};

/// Throws Error naming file and line.
std::vector<FindingsParagraph> readFindings(const FindingsFile& file);

}  // namespace palpate::study
