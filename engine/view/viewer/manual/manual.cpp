#include "view/viewer/manual/manual.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "palpate/base/path_text.h"
#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

constexpr double kTitleScore = 100.0;
constexpr double kHeadingScore = 20.0;
constexpr double kBodyScore = 1.0;
constexpr std::size_t kMaxCounted = 10;  ///< largest count of a word in one part of a page
constexpr std::size_t kExcerpt = 150;    ///< letters

std::string inLowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

ManualPage readPage(const view::EmbeddedFile& file) {
  ManualPage page{std::string(file.name), std::string(file.name), readMarkdown(file.bytes)};
  const auto heading = std::find_if(page.blocks.begin(), page.blocks.end(),
                                    [](const Block& block) { return block.kind == Block::Kind::heading; });
  if (heading != page.blocks.end()) page.title = plainText(heading->words);
  return page;
}

/// The text under one heading.
struct Part {
  std::string heading = {};
  std::string text = {};
  std::string lower_heading = {};
  std::string lower_text = {};
};
struct Indexed {
  const ManualPage* page;
  std::string lower_title;
  std::vector<Part> parts;  ///< the first is the page's begin
};

Indexed indexOf(const ManualPage& page) {
  Indexed indexed{&page, inLowerCase(page.title), {Part{}}};
  for (const Block& block : page.blocks) {
    if (block.kind == Block::Kind::heading) {
      if (block.level > 1) indexed.parts.push_back({plainText(block.words), {}, {}, {}});
      continue;
    }
    indexed.parts.back().text += plainText(block) + " ";
  }
  for (Part& part : indexed.parts) {
    part.lower_heading = inLowerCase(part.heading);
    part.lower_text = inLowerCase(part.text);
  }
  return indexed;
}

const std::vector<Indexed>& manualIndex() {
  static const std::vector<Indexed> index = [] {
    std::vector<Indexed> pages;
    for (const ManualPage& page : manualPages()) pages.push_back(indexOf(page));
    return pages;
  }();
  return index;
}

/// First occurrence of the word in the text from `from` on; npos: none. Not in the middle of another word.
std::size_t findWord(std::string_view text, std::string_view word, std::size_t from = 0) {
  for (std::size_t at = text.find(word, from); at != std::string_view::npos; at = text.find(word, at + 1)) {
    if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) return at;
  }
  return std::string_view::npos;
}

double countWord(std::string_view text, std::string_view word) {
  std::size_t count = 0;
  for (std::size_t at = findWord(text, word); at != std::string_view::npos && count < kMaxCounted;
       at = findWord(text, word, at + 1)) {
    ++count;
  }
  return static_cast<double>(count);
}

using SoughtWords = std::vector<std::string>;

double scoreMatch(const Part& part, const SoughtWords& words) {
  double score = 0.0;
  for (const std::string& word : words) {
    if (findWord(part.lower_heading, word) != std::string_view::npos) score += kHeadingScore;
    score += kBodyScore * countWord(part.lower_text, word);
  }
  return score;
}

/// Compares in English and in the language of the window.
bool titleHolds(const Indexed& page, const std::string& word) {
  constexpr std::size_t kNowhere = std::string_view::npos;
  return findWord(page.lower_title, word) != kNowhere ||
         findWord(inLowerCase(titleInLanguage(page.page->title)), word) != kNowhere;
}

bool pageHolds(const Indexed& page, const std::string& word) {
  constexpr std::size_t kNowhere = std::string_view::npos;
  if (titleHolds(page, word)) return true;
  return std::any_of(page.parts.begin(), page.parts.end(), [&](const Part& part) {
    return findWord(part.lower_heading, word) != kNowhere || findWord(part.lower_text, word) != kNowhere;
  });
}

std::string makeExcerpt(const Part& part, const SoughtWords& words) {
  std::size_t first = std::string::npos;
  for (const std::string& word : words) first = std::min(first, findWord(part.lower_text, word));
  if (first == std::string::npos) first = 0;
  std::size_t begin = first > kExcerpt / 3 ? part.text.rfind(' ', first - kExcerpt / 3) : 0;
  begin = begin == std::string::npos ? 0 : begin;
  std::string excerpt = part.text.substr(begin, kExcerpt);
  if (const std::size_t end = excerpt.rfind(' '); end != std::string::npos) excerpt.resize(end);
  std::replace(excerpt.begin(), excerpt.end(), '\n', ' ');
  return (begin > 0 ? "... " : "") + std::string(trimmed(excerpt));
}

std::optional<ManualResult> searchPage(const Indexed& page, const SoughtWords& words) {
  if (!std::all_of(words.begin(), words.end(), [&](const auto& word) { return pageHolds(page, word); })) return {};
  ManualResult result{page.page, {}, {}, 0.0};
  const Part* best = nullptr;
  double best_score = -1.0;
  for (const Part& part : page.parts) {
    const double score = scoreMatch(part, words);
    result.score += score;
    if (score > best_score) {
      best = &part;
      best_score = score;
    }
  }
  for (const std::string& word : words) {
    if (titleHolds(page, word)) result.score += kTitleScore;
  }
  result.heading = best->heading;
  result.excerpt = makeExcerpt(*best, words);
  return result;
}

}  // namespace

std::span<const ManualPage> manualPages() {
  static const std::vector<ManualPage> pages = [] {
    std::vector<ManualPage> read;
    for (const view::EmbeddedFile& file : manualFiles()) read.push_back(readPage(file));
    return read;
  }();
  return pages;
}

const ManualPage* manualPage(std::string_view file) {
  const std::span<const ManualPage> pages = manualPages();
  const auto page = std::find_if(pages.begin(), pages.end(), [&](const ManualPage& p) { return p.file == file; });
  return page == pages.end() ? nullptr : &*page;
}

ManualLink linkFrom(const ManualPage& page, std::string_view target) {
  const std::size_t hash = std::min(target.find('#'), target.size());
  ManualLink link{&page, std::string(hash < target.size() ? target.substr(hash + 1) : std::string_view())};
  if (hash == 0) return link;
  const auto folder = pathOf(page.file).parent_path();
  link.page = manualPage((folder / pathOf(std::string(target.substr(0, hash)))).lexically_normal().generic_string());
  return link;
}

std::vector<ManualResult> searchManual(std::string_view words, std::size_t most) {
  SoughtWords sought;
  const std::string lower = inLowerCase(words);
  for (const std::string_view word : split(lower, ' ')) {
    if (!trimmed(word).empty()) sought.emplace_back(trimmed(word));
  }
  std::vector<ManualResult> results;
  if (sought.empty()) return results;
  for (const Indexed& page : manualIndex()) {
    if (auto result = searchPage(page, sought)) results.push_back(*std::move(result));
  }
  std::stable_sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (results.size() > most) results.erase(results.begin() + static_cast<std::ptrdiff_t>(most), results.end());
  return results;
}

}  // namespace palpate::viewer
