// The documents' titles, for the catalogues; a test compares them with the first headings.
#include <algorithm>
#include <array>

#include "palpate/base/language.h"
#include "view/viewer/manual/manual.h"

namespace palpate::viewer {

namespace {

constexpr std::array kTitles = {toTranslate("The built-in bodies"),
                                toTranslate("The haptic finger"),
                                toTranslate("Credibility: why the figures of a release may be trusted"),
                                toTranslate("Deformation: how the skin follows the finger"),
                                toTranslate("Force laws"),
                                toTranslate("Lumps"),
                                toTranslate("Maps: which ellipse and which stiffness belong to which place"),
                                toTranslate("Measuring: from two photographs to the key ellipse"),
                                toTranslate("Partitions and the haptic detecting box"),
                                toTranslate("Beside other libraries"),
                                toTranslate("Rendering: from the deformed skin to pixels"),
                                toTranslate("Safety"),
                                toTranslate("The servo loop"),
                                toTranslate("Studies: the dissertation's questions, measured again"),
                                toTranslate("Layered tissue"),
                                toTranslate("Tools of several pads"),
                                toTranslate("Training methods: how thresholds are measured"),
                                toTranslate("Run a class over the network"),
                                toTranslate("Connect a haptic device"),
                                toTranslate("Palpate in another program"),
                                toTranslate("Examine with 18 lumps"),
                                toTranslate("Your first change"),
                                toTranslate("Fit bones and names to a scanned body"),
                                toTranslate("Follow a head before the screen"),
                                toTranslate("Hunt for faults"),
                                toTranslate("Use Palpate in another language, and translate it"),
                                toTranslate("Make a body"),
                                toTranslate("Measure a person: from photographs to a map that is felt"),
                                toTranslate("Build for Windows and for ARM64"),
                                toTranslate("Look at a partition, and feel through its box"),
                                toTranslate("Draw pictures"),
                                toTranslate("Write a device plugin"),
                                toTranslate("Record and replay"),
                                toTranslate("Make a release, and verify one"),
                                toTranslate("Show a body in browsers"),
                                toTranslate("Make a tissue table"),
                                toTranslate("Teach and examine with Palpate"),
                                toTranslate("Run the engine in a browser"),
                                toTranslate("Benchmarks"),
                                toTranslate("Palpate in C, C# and other languages"),
                                toTranslate("The protocol of a class"),
                                toTranslate("Forms of the deformation"),
                                toTranslate("Devices"),
                                toTranslate("The dissertation, section by section"),
                                toTranslate("The trunk in pictures"),
                                toTranslate("Maps: the files and the command"),
                                toTranslate("Meshes: loading, checking, repairing"),
                                toTranslate("Names of places"),
                                toTranslate("Palpate in Python"),
                                toTranslate("Lumps in figures"),
                                toTranslate("Recordings"),
                                toTranslate("A finger that another program moves"),
                                toTranslate("palpate render: what a picture shows"),
                                toTranslate("What the records hold"),
                                toTranslate("Scene files"),
                                toTranslate("Edges, threats and limits"),
                                toTranslate("The server: palpate serve"),
                                toTranslate("Palpating without a device: palpate simulate"),
                                toTranslate("Tissue tables"),
                                toTranslate("Training sessions"),
                                toTranslate("The viewer"),
                                toTranslate("A class in an hour"),
                                toTranslate("First touch"),
                                toTranslate("Hide a lump, find it, see it"),
                                toTranslate("Palpating real shapes"),
                                toTranslate("Documents of Palpate")};

}  // namespace

std::string titleInLanguage(const std::string& title) {
  const auto* known = std::ranges::find(kTitles, title, [](const char* one) { return std::string_view(one); });
  return known == kTitles.end() ? title : tr(*known);
}

std::vector<Block> blocksInLanguage(const ManualPage& page) {
  std::vector<Block> blocks = page.blocks;
  if (language().code == "en") return blocks;
  const auto title = std::ranges::find(blocks, Block::Kind::heading, &Block::kind);
  if (title != blocks.end()) title->words = {{.text = titleInLanguage(page.title)}};
  if (page.file != kManualContents) return blocks;
  for (Block& block : blocks) {
    for (Inline& words : block.words) {
      if (words.kind != Inline::Kind::link) continue;
      const ManualLink link = linkFrom(page, words.target);
      if (link.page != nullptr && link.anchor.empty()) words.text = titleInLanguage(link.page->title);
    }
  }
  return blocks;
}

bool isKnownTitle(std::string_view title) {
  return std::ranges::any_of(kTitles, [&](const char* one) { return one == title; });
}

}  // namespace palpate::viewer
