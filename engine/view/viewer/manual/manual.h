// The documents of docs/, which are embedded in the program: their pages, links between them, and search by words.
// Nothing is read from the disk.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/view/layers/embedded_file.h"
#include "view/viewer/manual/markdown.h"

namespace palpate::viewer {

/// The embedded files, named by their place below docs/: "howto/class.md".
std::span<const view::EmbeddedFile> manualFiles();

/// Translates a page's title, its first heading in English; unchanged where the catalogues lack it.
std::string titleInLanguage(const std::string& title);
bool isKnownTitle(std::string_view title);

struct ManualPage {
  std::string file;
  std::string title;  ///< in English, as the page itself
  std::vector<Block> blocks;
};
/// All pages; parsed on first use.
std::span<const ManualPage> manualPages();
/// Null for an unknown name.
const ManualPage* manualPage(std::string_view file);

/// The page that lists the others.
inline constexpr const char* kManualContents = "README.md";

/// The target of a link.
struct ManualLink {
  const ManualPage* page = nullptr;  ///< null: not into the manual
  std::string anchor = {};           ///< for a heading; empty: the page's begin
};
ManualLink linkFrom(const ManualPage& page, std::string_view target);

/// The page's blocks with the titles in the language of the window: its own, and on the contents page those of all.
std::vector<Block> blocksInLanguage(const ManualPage& page);

struct ManualResult {
  const ManualPage* page;
  std::string heading;  ///< heading of the best part; empty: the page's begin
  std::string excerpt;  ///< words around the first match
  double score;
};
/// Pages with all the words (also as beginnings of longer ones), the best first: words in a title count most, then in
/// headings, then in the text.
std::vector<ManualResult> searchManual(std::string_view words, std::size_t most = 30);

}  // namespace palpate::viewer
