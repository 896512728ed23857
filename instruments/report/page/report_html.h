// The report as one HTML file that needs nothing else: pictures are inside it as data, the look is in it too.
//
// Well-formed (every element is closed, text is escaped), so that programs can read it; it opens without a network and
// prints on paper with a chapter a page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/study_page.h"

namespace palpate::study {

struct ReportHead {
  std::string title;
  std::string about;  ///< one paragraph
  std::string command;
  std::string machine;
  double seconds = 0.0;
};

/// The pictures are read from `folder`, where writePage() put them: of SVG and PNG the smaller one. Large ones are
/// drawn again with fewer pixels. Throws Error naming a picture that is not there.
std::string reportHtml(const ReportHead& head, const std::vector<StudyPage>& chapters,
                       const std::filesystem::path& folder);

/// Text as HTML: & < > and quotes escaped, `words in backticks` as code, **these** strong.
std::string htmlText(std::string_view text);

}  // namespace palpate::study
