// What the documents quote is what docs/quoted/store.json holds: tools/quote-studies fills both from commands.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/places.h"

namespace {

namespace fs = std::filesystem;

const fs::path kSources = palpate::support::sourceFolder();
constexpr std::string_view kBegin = "<!--=";
constexpr std::string_view kBeginEnd = "-->";
constexpr std::string_view kEnd = "<!--=-->";

struct Quote {
  std::string name;
  std::string text;
};

std::string contentOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// What stands between <!--=NAME--> and <!--=-->. An unclosed quote has the name "?".
std::vector<Quote> quotesOf(const std::string& page) {
  std::vector<Quote> quotes;
  for (std::size_t at = page.find(kBegin); at != std::string::npos; at = page.find(kBegin, at)) {
    const std::size_t name = at + kBegin.size();
    const std::size_t text = page.find(kBeginEnd, name);
    const std::size_t end = page.find(kEnd, name);
    if (text == std::string::npos || end == std::string::npos || end < text) return {{"?", page.substr(at, 80)}};
    const std::size_t begin = text + kBeginEnd.size();
    quotes.push_back({page.substr(name, text - name), page.substr(begin, end - begin)});
    at = end + kEnd.size();
  }
  return quotes;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files = {kSources / "README.md", kSources / "packaging/paper/paper.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kSources / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  return files;
}

}  // namespace

TEST(Quotes, EveryFigureThatADocumentQuotesIsTheStores) {
  const auto store = nlohmann::json::parse(contentOf(kSources / "docs/quoted/store.json"));
  ASSERT_GE(store.size(), 40u);
  std::set<std::string> quoted;
  for (const fs::path& file : documents()) {
    for (const Quote& quote : quotesOf(contentOf(file))) {
      ASSERT_TRUE(store.contains(quote.name)) << file << " quotes " << quote.name << ", which no command fills";
      EXPECT_EQ(quote.text, store[quote.name]["text"])
          << quote.name << " in " << file << ": run tools/quote-studies --documents";
      quoted.insert(quote.name);
    }
  }
  for (const auto& [name, figure] : store.items()) {
    EXPECT_TRUE(quoted.contains(name)) << name << " is in the store and quoted nowhere";
  }
}

TEST(Quotes, AQuoteThatIsNotClosedIsSeen) {
  EXPECT_EQ(quotesOf("of <!--=a.b-->12<!--=--> and <!--=c-->3<!--=-->").size(), 2u);
  EXPECT_EQ(quotesOf("of <!--=a.b-->12<!--=--> and <!--=c-->3").front().name, "?");
}
