// The documents of docs/, which are part of the program: their pages, links between them, and search by words. Nothing
// is read from the disk.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/view/layers/embedded_file.h"
#include "view/viewer/manual/markdown.h"

namespace palpate::viewer {

/// As they were built in, named by their place below docs/: "howto/class.md".
std::span<const view::EmbeddedFile> manualFiles();

/// Of a page, by its first heading in English; as it is where the catalogues do not know it.
std::string titleInLanguage(const std::string& title);
bool isKnownTitle(std::string_view title);

struct ManualPage {
  std::string file;
  std::string title;  ///< in English, as the page itself
  std::vector<Block> blocks;
};
/// All of them; read when they are first asked for.
std::span<const ManualPage> manualPages();
/// Null for a name that is no page.
const ManualPage* manualPage(std::string_view file);

/// The page that lists the others.
inline constexpr const char* kManualContents = "README.md";

/// Where a link leads.
struct ManualLink {
  const ManualPage* page = nullptr;  ///< null: not into the manual
  std::string anchor = {};           ///< of the heading; empty: the page's begin
};
ManualLink linkFrom(const ManualPage& page, std::string_view target);

/// The page's blocks with the titles in the language of the window: its own, and on the contents those of the pages.
std::vector<Block> blocksInLanguage(const ManualPage& page);

struct ManualResult {
  const ManualPage* page;
  std::string heading;  ///< of the part that fits best; empty: the page's begin
  std::string excerpt;  ///< words around the first that was sought
  double score;
};
/// Pages that hold all the words (also as beginnings of longer ones), the best first: words in a title count most, then
/// in headings, then in the text.
std::vector<ManualResult> searchManual(std::string_view words, std::size_t most = 30);

}  // namespace palpate::viewer
