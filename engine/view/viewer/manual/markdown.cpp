#include "view/viewer/manual/markdown.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

constexpr std::string_view kFence = "```";

std::size_t indentWidth(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

/// Comments mark figures that a study writes; readers must not see them.
std::string withoutComments(std::string_view text) {
  std::string kept;
  for (std::size_t begin = text.find("<!--"); begin != std::string_view::npos; begin = text.find("<!--")) {
    kept += text.substr(0, begin);
    const std::size_t end = text.find("-->", begin);
    if (end == std::string_view::npos) return kept;
    text.remove_prefix(end + 3);
  }
  return kept.append(text);
}

struct Marked {
  Inline words;
  std::size_t length;  ///< length of the text with its marks
};

/// The text between two equal marks at its begin.
std::optional<Marked> between(std::string_view text, std::string_view mark, Inline::Kind kind) {
  if (!text.starts_with(mark)) return std::nullopt;
  const std::size_t end = text.find(mark, mark.size() + 1);
  if (end == std::string_view::npos || std::isspace(static_cast<unsigned char>(text[mark.size()])) != 0) return {};
  return Marked{{kind, std::string(text.substr(mark.size(), end - mark.size()))}, end + mark.size()};
}

/// "[words](target)"; for a picture its words only.
std::optional<Marked> linkAt(std::string_view text) {
  const bool picture = text.starts_with("![");
  if (!picture && !text.starts_with('[')) return std::nullopt;
  const std::size_t begin = picture ? 2 : 1;
  const std::size_t middle = text.find("](", begin);
  const std::size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
  if (end == std::string_view::npos) return std::nullopt;
  std::string words(text.substr(begin, middle - begin));
  std::erase(words, '`');
  if (picture) return Marked{{Inline::Kind::plain, "(picture: " + words + ")"}, end + 1};
  return Marked{{Inline::Kind::link, words, std::string(text.substr(middle + 2, end - middle - 2))}, end + 1};
}

std::optional<Marked> markedAt(std::string_view text) {
  if (auto code = between(text, "`", Inline::Kind::code)) return code;
  if (auto strong = between(text, "**", Inline::Kind::strong)) return strong;
  if (auto strong = between(text, "*", Inline::Kind::strong)) return strong;
  return linkAt(text);
}

Inlines parseInlines(std::string_view text) {
  Inlines words;
  std::string plain;
  const auto end_plain = [&] {
    if (!plain.empty()) words.push_back({Inline::Kind::plain, plain});
    plain.clear();
  };
  while (!text.empty()) {
    if (text.size() > 1 && text[0] == '\\' && std::ispunct(static_cast<unsigned char>(text[1])) != 0) {
      plain += text[1];
      text.remove_prefix(2);
    } else if (const auto marked = markedAt(text)) {
      end_plain();
      words.push_back(marked->words);
      text.remove_prefix(marked->length);
    } else {
      plain += text[0];
      text.remove_prefix(1);
    }
  }
  end_plain();
  return words;
}

std::vector<Inlines> splitCells(std::string_view row) {
  row = trimmed(row);
  row.remove_prefix(1);
  if (row.ends_with('|')) row.remove_suffix(1);
  std::vector<Inlines> cells;
  std::string cell;
  bool code = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == '`') code = !code;
    if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') {
      cell += row[++i];
    } else if (row[i] == '|' && !code) {
      cells.push_back(parseInlines(trimmed(std::exchange(cell, {}))));
    } else {
      cell += row[i];
    }
  }
  cells.push_back(parseInlines(trimmed(cell)));
  return cells;
}

/// "- " or "12. " and what follows.
struct ItemBegin {
  std::string marker;
  std::size_t length;
};
std::optional<ItemBegin> itemAt(std::string_view line) {
  if (line.starts_with("- ") || line.starts_with("* ")) return ItemBegin{"-", 2};
  const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
  if (digits == 0 || !line.substr(digits).starts_with(". ")) return std::nullopt;
  return ItemBegin{std::string(line.substr(0, digits + 1)), digits + 2};
}

/// Line by line; a block ends where another begins.
class MarkdownReader {
 public:
  void addLine(std::string_view line) {
    if (in_code_) return addCodeLine(line);
    const std::size_t indent = indentWidth(line);
    const std::string_view words = trimmed(line);
    if (words.starts_with(kFence)) {
      endBlock();
      in_code_ = true;
      code_indent_ = indent;
      blocks_.push_back({.kind = Block::Kind::code});
    } else if (words.empty() || words == "---") {
      endBlock();
    } else if (words.starts_with('#') && indent == 0) {
      addHeading(words);
    } else if (words.starts_with('|')) {
      addRow(words);
    } else if (const auto item = itemAt(words)) {
      endBlock();
      under_way_ = Block{.kind = Block::Kind::item, .level = static_cast<int>(indent / 2), .marker = item->marker};
      text_ = words.substr(item->length);
    } else {
      if (!under_way_) under_way_ = Block{.level = static_cast<int>(indent / 2)};
      text_ += (text_.empty() ? "" : " ") + std::string(words.starts_with("> ") ? words.substr(2) : words);
    }
  }
  std::vector<Block> finish() {
    endBlock();
    return std::move(blocks_);
  }

 private:
  void endBlock() {
    in_table_ = false;
    if (!under_way_) return;
    under_way_->words = parseInlines(text_);
    if (!under_way_->words.empty()) blocks_.push_back(*std::move(under_way_));
    under_way_.reset();
    text_.clear();
  }
  void addCodeLine(std::string_view line) {
    if (trimmed(line).starts_with(kFence)) {
      in_code_ = false;
      return;
    }
    std::string& text = blocks_.back().text;
    if (!text.empty()) text += '\n';
    text += line.substr(std::min(indentWidth(line), code_indent_));
  }
  void addHeading(std::string_view words) {
    endBlock();
    const std::size_t level = std::min(words.find_first_not_of('#'), words.size());
    blocks_.push_back({.kind = Block::Kind::heading,
                       .level = static_cast<int>(level),
                       .words = parseInlines(trimmed(words.substr(level)))});
  }
  void addRow(std::string_view words) {
    if (!in_table_) {
      endBlock();
      in_table_ = true;
      blocks_.push_back({.kind = Block::Kind::table});
    }
    if (words.find_first_not_of("|-: ") != std::string_view::npos) blocks_.back().rows.push_back(splitCells(words));
  }

  std::vector<Block> blocks_;
  std::optional<Block> under_way_;
  std::string text_;
  bool in_code_ = false;
  bool in_table_ = false;
  std::size_t code_indent_ = 0;
};

}  // namespace

std::vector<Block> readMarkdown(std::string_view text) {
  const std::string seen = withoutComments(text);
  MarkdownReader reader;
  // Not `split`, which would remove the spaces at the begin of a line.
  for (std::size_t begin = 0; begin < seen.size();) {
    const std::size_t end = std::min(seen.find('\n', begin), seen.size());
    reader.addLine(std::string_view(seen).substr(begin, end - begin));
    begin = end + 1;
  }
  return reader.finish();
}

std::string plainText(const Inlines& words) {
  std::string text;
  for (const Inline& part : words) text += part.text;
  return text;
}

std::string plainText(const Block& block) {
  if (block.kind == Block::Kind::code) return block.text;
  std::string text = plainText(block.words);
  for (const auto& row : block.rows) {
    for (const Inlines& cell : row) {
      if (!text.empty()) text += ' ';
      text += plainText(cell);
    }
  }
  return text;
}

std::string headingAnchor(std::string_view heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalnum(c) != 0 || letter == '-' || letter == '_') anchor += static_cast<char>(std::tolower(c));
    if (letter == ' ') anchor += '-';
  }
  return anchor;
}

}  // namespace palpate::viewer
