// One pass over the text that knows strings, comments, brackets and keys. Up to the first fault of the text it splits
// it as the parser does, and the parser does not go on after it.
#include "palpate/scene/detail/toml_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "palpate/base/error.h"
#include "palpate/scene/detail/toml_node.h"

namespace palpate::scene {

namespace {

class LimitScan {
 public:
  LimitScan(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') return skipString(c);
    ++at_;
    switch (c) {
      case '#':
        at_ = std::min(text_.find('\n', at_), text_.size());
        break;
      case '\n':
        ++line_;
        dots_ = 0;
        line_begins_ = true;
        return;
      case '[':
      case '{':
        open(c);
        break;
      case ']':
      case '}':
        if (nesting_ > 0) --nesting_;
        if (in_header_) endKey();
        in_header_ = false;
        dots_ = 0;
        break;
      case '.':
        if (++dots_ >= kMaxTomlKeyParts) fail(fmt::format("a key has more than {} parts", kMaxTomlKeyParts));
        break;
      case '=':
        endKey();
        break;
      case ',':
        dots_ = 0;
        break;
      default:
        break;
    }
    if (c != ' ' && c != '\t' && c != '\r') line_begins_ = false;
  }

  void open(char bracket) {
    const bool begins_header = nesting_ == 0 && line_begins_;
    if (begins_header || bracket == '{') addTables(1);
    if (begins_header) in_header_ = true;
    if (++nesting_ > kMaxTomlNesting) fail(fmt::format("is nested more than {} levels deep", kMaxTomlNesting));
    dots_ = 0;
  }

  /// Each part but the last is a table.
  void endKey() {
    addTables(dots_);
    dots_ = 0;
  }

  void addTables(std::size_t count) {
    tables_ += count;
    if (tables_ > kMaxTomlTables) fail(fmt::format("has more than {} tables", kMaxTomlTables));
  }

  /// To after its end. An escape hides a quote in "..." alone; three quotes begin a string of several lines, which may
  /// end with two quotes of its own before the three.
  void skipString(char quote) {
    line_begins_ = false;
    const bool is_long = text_.substr(at_, 3) == std::string(3, quote);
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n' && !is_long) return;  // the parser's to refuse
      if (c == '\n') ++line_;
      if (c == '\\' && quote == '"') {
        at_ += at_ + 1 < text_.size() && text_[at_ + 1] != '\n' ? 2 : 1;
        continue;
      }
      if (c != quote) {
        ++at_;
        continue;
      }
      const std::size_t run = std::min(text_.find_first_not_of(quote, at_), text_.size()) - at_;
      if (!is_long || run >= 3) {
        at_ += is_long ? std::min<std::size_t>(run, 5) : 1;
        return;
      }
      at_ += run;
    }
  }

  [[noreturn]] void fail(const std::string& cause) const { throw Error::atLine(file_, line_, cause); }

  std::string_view text_;
  std::string_view file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t nesting_ = 0;
  std::size_t dots_ = 0;  ///< in the key, or in the number
  std::size_t tables_ = 0;
  bool line_begins_ = true;
  bool in_header_ = false;
};

}  // namespace

void requireBoundedToml(std::string_view text, std::string_view file) {
  if (text.size() > kMaxTomlBytes) {
    throw Error::inFile(file, fmt::format("is larger than {} MiB", kMaxTomlBytes >> 20));
  }
  LimitScan(text, file).run();
}

}  // namespace palpate::scene
