// A TOML text as a tree of values with their places. toml_node.cpp alone includes the parser, whose templates are slow
// to compile, and hands it no text that would exhaust it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpate::scene {

// No file that people write comes near these. A level of nesting costs the parser a frame of its stack.

inline constexpr std::size_t kMaxTomlBytes = std::size_t{16} << 20;
/// Brackets within brackets.
inline constexpr std::size_t kMaxTomlNesting = 16;
/// Parts of `a.b.c`, in a key or in the header of a table.
inline constexpr std::size_t kMaxTomlKeyParts = 16;
/// Tables with those that the parts of a key make.
inline constexpr std::size_t kMaxTomlTables = 100'000;

/// Limit of a parser's message, which may quote the file, with its ends of line.
inline constexpr std::size_t kMaxParseMessage = 300;

/// Counted from 1; a column counts letters.
struct TomlPlace {
  std::uint32_t line = 0, column = 0;
};

struct TomlEntry;
class TomlNode;
using TomlList = std::vector<TomlNode>;

class TomlNode {
 public:
  enum class Kind { text, flag, whole, fraction, date, list, table };

  TomlNode();  ///< an empty table
  TomlNode(Kind kind, TomlPlace begin, TomlPlace end);

  Kind kind() const { return kind_; }
  bool isNumber() const { return kind_ == Kind::whole || kind_ == Kind::fraction; }
  bool isTable() const { return kind_ == Kind::table; }
  /// A table in braces, of one line.
  bool isInline() const { return is_inline_; }
  /// Written with two brackets, or a list of tables only.
  bool isListOfTables() const;

  /// From the first letter to after the last one. A table with a header is where its header is.
  TomlPlace begin() const { return begin_; }
  TomlPlace end() const { return end_; }
  std::size_t line() const { return begin_.line; }

  // The value; nothing where it is of another kind.

  std::optional<std::string> text() const;
  /// A whole number too, if a double holds it.
  std::optional<double> number() const;
  /// A number without a fraction, or a flag as 0 or 1.
  std::optional<std::int64_t> whole() const;
  /// A whole number too: all but 0 are true.
  std::optional<bool> flag() const;
  /// The values of a list; null for anything else.
  const TomlList* list() const { return kind_ == Kind::list ? &items_ : nullptr; }
  /// This, if it is a table.
  const TomlNode* table() const { return isTable() ? this : nullptr; }

  // For a table; anything else has no entries.

  /// Null if the key is missing.
  const TomlNode* get(std::string_view key) const;
  /// In alphabetical order.
  const std::vector<TomlEntry>& entries() const { return entries_; }

 private:
  friend struct TomlReader;

  Kind kind_ = Kind::table;
  bool is_inline_ = false;
  TomlPlace begin_, end_;
  std::variant<std::monostate, std::string, bool, std::int64_t, double> value_;
  TomlList items_;
  std::vector<TomlEntry> entries_;
};

struct TomlEntry {
  std::string key;
  TomlPlace place;  ///< place of the key
  TomlNode node;
};

// Here, where what a list of entries needs of them is known.
inline TomlNode::TomlNode() = default;
inline TomlNode::TomlNode(Kind kind, TomlPlace begin, TomlPlace end) : kind_(kind), begin_(begin), end_(end) {}

/// The table of the whole text. `file` is how the text is called in errors. Throws Error with the line where it is not
/// TOML, or is nested or split beyond the limits above.
TomlNode parseToml(std::string_view text, std::string_view file);

}  // namespace palpate::scene
