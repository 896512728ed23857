// Help > Manual: every document is in it, what one searches is found, links lead on.
#include "view/viewer/manual/manual.h"

#include <algorithm>
#include <filesystem>

#include "palpate/base/language.h"
#include "stage.h"
#include "support/places.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

std::string firstFor(std::string_view words) {
  const std::vector<ManualResult> results = searchManual(words);
  return results.empty() ? std::string("nothing") : results.front().page->file;
}

TEST(Manual, TitlesAreInTheLanguageOfTheWindow) {
  useLanguage("de");
  EXPECT_EQ(plainText(blocksInLanguage(*manualPage("howto/class.md")).front()), "Eine Klasse im Netz durchführen");
  std::string contents;
  for (const Block& block : blocksInLanguage(*manualPage(kManualContents))) contents += plainText(block) + "\n";
  EXPECT_NE(contents.find("Einen Menschen messen: von Fotos"), std::string::npos);
  EXPECT_EQ(contents.find("Run a class over the network"), std::string::npos);
  EXPECT_EQ(firstFor("klasse durchführen"), "howto/class.md");
  useLanguage("en");
  EXPECT_EQ(plainText(blocksInLanguage(*manualPage("howto/class.md")).front()), "Run a class over the network");
}

TEST(Manual, HoldsEveryDocument) {
  const fs::path docs = support::sourceFolder() / "docs";
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(docs)) {
    if (entry.path().extension() != ".md") continue;
    ++count;
    const std::string name = fs::relative(entry.path(), docs).generic_string();
    const ManualPage* page = manualPage(name);
    ASSERT_NE(page, nullptr) << name;
    EXPECT_FALSE(page->blocks.empty()) << name;
    EXPECT_NE(page->title, page->file) << "its first heading";
    EXPECT_TRUE(isKnownTitle(page->title))
        << page->title << ": engine/view/viewer/manual/titles.cpp, for the catalogues";
  }
  EXPECT_EQ(count, manualPages().size());
  EXPECT_GT(count, 50u);
}

TEST(Manual, RanksTitlesBeforeHeadingsBeforeWords) {
  EXPECT_EQ(firstFor("run a class over the network"), "howto/class.md");
  EXPECT_EQ(firstFor("draw pictures"), "howto/pictures.md");
  EXPECT_EQ(firstFor("first touch"), "tutorials/first-touch.md");
  EXPECT_EQ(firstFor("scene files"), "reference/scene-files.md");
  EXPECT_EQ(firstFor("CLASS NETWORK"), "howto/class.md") << "in any case and order";
  EXPECT_EQ(firstFor("mosquit"), firstFor("mosquitto")) << "the begin of a word";
  for (std::size_t i = 0; i + 1 < searchManual("friction").size(); ++i) {
    EXPECT_GE(searchManual("friction")[i].score, searchManual("friction")[i + 1].score);
  }
}

TEST(Manual, FindsOnlyPagesThatHoldAllWords) {
  EXPECT_TRUE(searchManual("friction zzzyx").empty());
  EXPECT_TRUE(searchManual("  ").empty());
  EXPECT_LE(searchManual("the").size(), 30u);
  const std::vector<ManualResult> results = searchManual("espeak-ng");
  ASSERT_FALSE(results.empty());
  EXPECT_NE(results.front().excerpt.find("espeak-ng"), std::string::npos) << results.front().excerpt;
}

TEST(Manual, EveryLinkBetweenItsPagesLeadsToAPageAndItsHeading) {
  std::size_t links = 0;
  const auto check = [&](const ManualPage& page, const Inlines& words) {
    for (const Inline& part : words) {
      const bool inside = part.kind == Inline::Kind::link && part.target.find(".md") != std::string::npos &&
                          !part.target.starts_with("http") && part.target.find("../../") == std::string::npos;
      if (!inside) continue;
      const ManualLink link = linkFrom(page, part.target);
      if (link.page == nullptr) {
        // A file of the repository that is no document.
        EXPECT_NE(part.target.find("../"), std::string::npos) << page.file << " -> " << part.target;
        continue;
      }
      ++links;
      const auto is_it = [&](const Block& block) {
        return block.kind == Block::Kind::heading && headingAnchor(plainText(block.words)) == link.anchor;
      };
      EXPECT_TRUE(link.anchor.empty() || std::ranges::any_of(link.page->blocks, is_it))
          << page.file << " -> " << part.target;
    }
  };
  for (const ManualPage& page : manualPages()) {
    for (const Block& block : page.blocks) {
      check(page, block.words);
      for (const auto& row : block.rows) {
        for (const Inlines& cell : row) check(page, cell);
      }
    }
  }
  EXPECT_GT(links, 200u);
}

TEST(Manual, ReadsWhatDocumentsAreWrittenIn) {
  const auto blocks = readMarkdown(
      "# A *title*\n\nWords with `code`, **force** and\n[a link](x.md#y).<!--= 3 -->\n\n- one\n  goes on\n  - deeper\n"
      "2. second\n\n    ```\n    if (a | b)\n      c\n    ```\n\n| head | `a|b` |\n|---|---|\n| x | ![picture](p.png) "
      "|\n");
  ASSERT_EQ(blocks.size(), 7u);
  EXPECT_EQ(plainText(blocks[0]), "A title");
  EXPECT_EQ(plainText(blocks[1]), "Words with code, force and a link.");
  EXPECT_EQ(blocks[1].words[5].target, "x.md#y");
  EXPECT_EQ(plainText(blocks[2]), "one goes on");
  EXPECT_EQ(blocks[3].level, 1);
  EXPECT_EQ(blocks[4].marker, "2.");
  EXPECT_EQ(blocks[5].text, "if (a | b)\n  c");
  ASSERT_EQ(blocks[6].rows.size(), 2u);
  EXPECT_EQ(plainText(blocks[6].rows[0][1]), "a|b");
  EXPECT_EQ(plainText(blocks[6].rows[1][1]), "(picture: picture)");
  EXPECT_EQ(headingAnchor("In five minutes: `--fps`"), "in-five-minutes---fps");
}

TEST(Manual, IsSearchedReadAndClosedInTheWindow) {
  Stage stage;
  stage.click("menu/Help");
  stage.click("menu/Manual");
  stage.frame();
  for (const char letter : std::string("draw pictures")) {
    window::InputEvent event;
    event.kind = window::InputEvent::Kind::text;
    event.text = std::string(1, letter);
    stage.frame({event});
  }
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe)) << "the manual owns the keyboard";
  EXPECT_TRUE(widgetPlaces().contains("manual/result/0"));
  stage.click("manual/result/0");
  EXPECT_EQ(stage.state().manual.page, "howto/pictures.md");
  stage.click("manual/link/../reference/render.md");
  EXPECT_EQ(stage.state().manual.page, "reference/render.md");
  stage.click("manual/back");
  EXPECT_EQ(stage.state().manual.page, "howto/pictures.md");
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.state().state.shown.manual);
  EXPECT_FALSE(stage.viewer->pointer().pressed(0));
}

}  // namespace
}  // namespace palpate::viewer
