// The documents' Markdown as blocks that can be laid out: the part of it that docs/ uses, no more. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::viewer {

/// Words of one kind within a block.
struct Inline {
  enum class Kind : std::uint8_t { plain, strong, code, link };
  Kind kind = Kind::plain;
  std::string text;
  std::string target = {};  ///< for a link
};
using Inlines = std::vector<Inline>;

struct Block {
  enum class Kind : std::uint8_t { heading, paragraph, item, code, table };
  Kind kind = Kind::paragraph;
  int level = 0;                                ///< level of a heading from 1; nesting of an item from 0
  std::string marker = {};                      ///< for an item: "-" or "3."
  Inlines words = {};                           ///< for all but code and tables
  std::string text = {};                        ///< code, unchanged
  std::vector<std::vector<Inlines>> rows = {};  ///< for a table; the first is its head
};

std::vector<Block> readMarkdown(std::string_view text);

/// The text without marks, as a reader sees it.
std::string plainText(const Inlines& words);
std::string plainText(const Block& block);

/// The name of a heading in links: lower case, spaces as hyphens, no punctuation.
std::string headingAnchor(std::string_view heading);

}  // namespace palpate::viewer
