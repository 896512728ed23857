// Text of findings -> its paragraphs and their parts.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "palpate/base/error.h"
#include "report/page/findings_text.h"

namespace palpate::study {

namespace {

constexpr std::array<std::string_view, 6> kFormats{"counted", "rounded", "percent", "fixed", "short", "as"};

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class FindingsReader {
 public:
  explicit FindingsReader(const FindingsFile& file) : file_(file), rest_(file.text) {}

  std::vector<FindingsParagraph> all() {
    std::vector<FindingsParagraph> paragraphs;
    while (!rest_.empty() && rest_.front() != '[') next();
    while (!rest_.empty()) {
      FindingsParagraph paragraph{.line = line_, .name = heading()};
      const auto same = [&](const FindingsParagraph& other) { return other.name == paragraph.name; };
      if (std::any_of(paragraphs.begin(), paragraphs.end(), same)) fail("a name that is there twice");
      paragraph.parts = text(false);
      paragraphs.push_back(std::move(paragraph));
    }
    return paragraphs;
  }

 private:
  FindingsFile file_;
  std::string_view rest_;
  std::size_t line_ = 1;

  [[noreturn]] void fail(const std::string& cause) const { throw Error::atLine(file_.path, line_, cause); }

  char next() {
    const char c = rest_.front();
    rest_.remove_prefix(1);
    if (c == '\n') ++line_;
    return c;
  }

  bool skipSpace() {
    const bool some = !rest_.empty() && isSpace(rest_.front());
    while (!rest_.empty() && isSpace(rest_.front())) next();
    return some;
  }

  bool takes(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  void needs(std::string_view token) {
    if (!takes(token)) fail(fmt::format("expected `{}`", token));
  }

  std::string name() {
    std::string name;
    while (!rest_.empty() && isOfName(rest_.front())) name += next();
    if (name.empty()) fail("expected a name");
    return name;
  }

  std::string heading() {
    needs("[");
    std::string title = name();
    needs("]");
    skipSpace();
    return title;
  }

  /// Up to the next heading or the end, or past the closing quotation mark.
  std::vector<FindingsPart> text(bool quoted) {
    std::vector<FindingsPart> parts;
    std::string words;
    const auto end_words = [&] {
      if (!words.empty()) parts.push_back({.line = line_, .text = std::exchange(words, {})});
    };
    for (std::size_t begun = line_;; begun = line_) {
      const bool space = skipSpace();
      if (!quoted && (rest_.empty() || (line_ > begun && rest_.front() == '['))) break;
      if (rest_.empty()) fail("a text without its closing quotation mark");
      if (space) words += ' ';
      if (quoted && takes("\"")) break;
      if (takes("{")) {
        end_words();
        parts.push_back(part());
      } else if (rest_.front() == '}') {
        fail("a `}` that closes nothing");
      } else {
        if (quoted && rest_.starts_with("\\\"")) next();
        words += next();
      }
    }
    end_words();
    return parts;
  }

  std::vector<FindingsPart> quotedText() {
    needs("\"");
    return text(true);
  }

  FindingsPart part() {
    FindingsPart part{.line = line_, .name = name()};
    if (takes("|")) readFormat(part);
    skipSpace();
    if (part.format.empty() && takes("?")) {
      readChoice(part);
    } else if (takes("\"")) {
      const std::vector<FindingsPart> between = text(true);
      if (between.size() != 1 || !between.front().name.empty()) fail("expected words between the values of a list");
      part.between = between.front().text;
    }
    skipSpace();
    needs("}");
    return part;
  }

  void readFormat(FindingsPart& part) {
    part.format = name();
    if (std::find(kFormats.begin(), kFormats.end(), part.format) == kFormats.end()) {
      fail(fmt::format("`{}` must be one of {}", part.format, fmt::join(kFormats, ", ")));
    }
    skipSpace();
    if (part.format == "as") {
      part.paragraph = name();
    } else if (!rest_.empty() && rest_.front() >= '1' && rest_.front() <= '9') {
      part.digits = next() - '0';
    }
  }

  void readChoice(FindingsPart& part) {
    skipSpace();
    if (rest_.starts_with('"')) {
      part.words = {"yes", "no"};
      part.texts.push_back(quotedText());
      skipSpace();
      const bool other = takes(":");
      skipSpace();
      part.texts.push_back(other ? quotedText() : std::vector<FindingsPart>{});
      return;
    }
    do {
      part.words.push_back(name());
      skipSpace();
      part.texts.push_back(quotedText());
      skipSpace();
    } while (!rest_.starts_with('}'));
  }
};

}  // namespace

std::vector<FindingsParagraph> readFindings(const FindingsFile& file) { return FindingsReader(file).all(); }

}  // namespace palpate::study
