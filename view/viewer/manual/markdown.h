// The documents' Markdown as blocks that can be laid out: what docs/ uses of it, no more. Pure.
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
  std::string target = {};  ///< of a link
};
using Inlines = std::vector<Inline>;

struct Block {
  enum class Kind : std::uint8_t { heading, paragraph, item, code, table };
  Kind kind = Kind::paragraph;
  int level = 0;                                ///< of a heading from 1; of an item how deep it stands, from 0
  std::string marker = {};                      ///< of an item: "-" or "3."
  Inlines words = {};                           ///< of all but code and tables
  std::string text = {};                        ///< code as it stands
  std::vector<std::vector<Inlines>> rows = {};  ///< of a table; the first is its head
};

std::vector<Block> readMarkdown(std::string_view text);

/// Without marks: what a reader sees.
std::string plainText(const Inlines& words);
std::string plainText(const Block& block);

/// What links call a heading: lower case, spaces as hyphens, no punctuation.
std::string anchorOf(std::string_view heading);

}  // namespace palpate::viewer
