// Recursive descent into a flat list of nodes in the order of the text, each with the end of all it holds; values are
// read out of the text when they are asked for.
#include "palpate/mesh/files/detail/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::mesh {

// --- parsing ---

class JsonParser {
 public:
  explicit JsonParser(JsonDocument& document) : document_(document), text_(document.text_) {}

  void parse() {
    if (text_.size() >= std::numeric_limits<std::uint32_t>::max()) fail("more than 4 GiB of JSON");
    readValue(0);
    skipBlanks();
    if (position_ != text_.size()) fail("something follows the end of the JSON text");
  }

 private:
  using Kind = JsonDocument::Kind;
  /// glTF nests about ten deep; deeper text is an attack on the stack.
  static constexpr int kDeepest = 64;

  [[noreturn]] void fail(std::string_view cause) const { document_.fail(position_, cause); }

  void skipBlanks() {
    while (position_ < text_.size() && std::string_view(" \t\r\n").find(text_[position_]) != std::string_view::npos) {
      ++position_;
    }
  }

  char peek() {
    skipBlanks();
    if (position_ == text_.size()) fail("the JSON text ends too early");
    return text_[position_];
  }

  void expect(char c) {
    if (peek() != c) fail(fmt::format("'{}' is expected", c));
    ++position_;
  }

  std::size_t addNode(Kind kind) {
    document_.nodes_.push_back({kind, static_cast<std::uint32_t>(position_), 0, 0});
    return document_.nodes_.size() - 1;
  }
  void closeNode(std::size_t node, std::size_t size) {
    document_.nodes_[node].size = static_cast<std::uint32_t>(size);
    document_.nodes_[node].end = static_cast<std::uint32_t>(document_.nodes_.size());
  }

  void readValue(int depth) {
    if (depth > kDeepest) fail("JSON nested too deep");
    const char c = peek();
    if (c == '{') {
      readObject(depth);
    } else if (c == '[') {
      readArray(depth);
    } else if (c == '"') {
      readString();
    } else {
      readScalar();
    }
  }

  void readObject(int depth) {
    const std::size_t node = addNode(Kind::object);
    readList('}', node, [this, depth] {
      if (peek() != '"') fail("a name in quotes is expected");
      readString();
      expect(':');
      readValue(depth + 1);
    });
  }

  void readArray(int depth) {
    const std::size_t node = addNode(Kind::array);
    readList(']', node, [this, depth] { readValue(depth + 1); });
  }

  template <class ReadItem>
  void readList(char closing, std::size_t node, const ReadItem& read_item) {
    ++position_;
    std::size_t count = 0;
    if (peek() != closing) {
      do {
        read_item();
        ++count;
      } while (takeIf(','));
    }
    expect(closing);
    closeNode(node, count);
  }

  bool takeIf(char c) {
    if (peek() != c) return false;
    ++position_;
    return true;
  }

  void readString() {
    ++position_;
    const std::size_t node = addNode(Kind::string);
    const std::size_t start = position_;
    while (position_ < text_.size() && text_[position_] != '"') {
      if (static_cast<unsigned char>(text_[position_]) < ' ') fail("a control character within a string");
      position_ += text_[position_] == '\\' ? 2 : 1;
    }
    if (position_ >= text_.size()) {
      position_ = text_.size();
      fail("the JSON text ends within a string");
    }
    closeNode(node, position_ - start);
    ++position_;
  }

  void readScalar() {
    const auto end = std::min(text_.find_first_of(",]} \t\r\n", position_), text_.size());
    const auto word = text_.substr(position_, end - position_);
    const std::size_t node = addNode(kindOf(word));
    closeNode(node, word.size());
    position_ = end;
  }

  Kind kindOf(std::string_view word) const {
    if (word == "true" || word == "false") return Kind::boolean;
    if (word == "null") return Kind::null;
    // parseNumber also takes "inf", "nan" and a plus sign, JSON does not.
    const bool starts_as_number =
        !word.empty() && std::string_view("-0123456789").find(word[0]) != std::string_view::npos;
    if (!starts_as_number || !parseNumber(word)) fail("not a JSON value");
    return Kind::number;
  }

  JsonDocument& document_;
  std::string_view text_;
  std::size_t position_ = 0;
};

JsonDocument::JsonDocument(std::string_view text, const Place& place) : text_(text), place_(place) {
  JsonParser(*this).parse();
}

JsonValue JsonDocument::root() const { return {this, 0}; }

void JsonDocument::fail(std::size_t position, std::string_view cause) const {
  if (!place_.is_text) throw Error::atByte(place_.file, place_.offset + position, cause);
  const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  throw Error::atLine(place_.file, static_cast<std::size_t>(lines) + 1, cause);
}

// --- values ---

const JsonDocument::Node& JsonValue::node() const { return document_->nodes_[node_]; }

std::string_view JsonValue::slice() const { return document_->text_.substr(node().position, node().size); }

JsonValue JsonValue::operator[](std::string_view name) const {
  if (!*this) return {};
  if (node().kind != JsonDocument::Kind::object) fail("an object is expected");
  for (std::uint32_t key = node_ + 1; key < node().end; key = document_->nodes_[key + 1].end) {
    if (JsonValue(document_, key).slice() == name) return {document_, key + 1};
  }
  return {};
}

std::vector<JsonValue> JsonValue::items() const {
  if (!*this) return {};
  if (node().kind != JsonDocument::Kind::array) fail("an array is expected");
  std::vector<JsonValue> items;
  items.reserve(node().size);
  for (std::uint32_t item = node_ + 1; item < node().end; item = document_->nodes_[item].end) {
    items.push_back(JsonValue(document_, item));
  }
  return items;
}

double JsonValue::number() const {
  if (node().kind != JsonDocument::Kind::number) fail("a number is expected");
  return *parseNumber(slice());
}

std::size_t JsonValue::index(std::size_t below, std::string_view what) const {
  const double value = number();
  if (value >= 0.0 && value < static_cast<double>(below) && value == std::floor(value)) {
    return static_cast<std::size_t>(value);
  }
  if (below == 0) fail(fmt::format("{} {}, but there is none", what, value));
  fail(fmt::format("{} {} is not a whole number from 0 to {}", what, value, below - 1));
}

bool JsonValue::isTrue() const { return *this && slice() == "true"; }

std::string JsonValue::text() const {
  if (node().kind != JsonDocument::Kind::string) fail("a string is expected");
  std::string result;
  const auto raw = slice();
  for (std::size_t i = 0; i < raw.size(); ++i) {
    // File names and base64 need no other escapes than these three.
    const bool escaped = raw[i] == '\\';
    if (escaped && (++i == raw.size() || std::string_view("\"\\/").find(raw[i]) == std::string_view::npos)) {
      fail("an escape in this string is not understood");
    }
    result += raw[i];
  }
  return result;
}

void JsonValue::fail(std::string_view cause) const { document_->fail(node().position, cause); }

}  // namespace palpate::mesh
