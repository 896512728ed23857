// Recursive descent into a flat list of nodes in the order of the text, each with the end of all it holds; values are
// decoded from the text on access.
#include "palpate/mesh/files/detail/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::mesh {

// --- escapes of strings ---

namespace {

/// A decoded escape, and how many characters of the text it takes.
struct Escape {
  char32_t letter;
  std::size_t length;
};

std::optional<char32_t> unitAt(std::string_view text) {
  unsigned value = 0;
  if (text.size() < 6 || !text.starts_with("\\u")) return std::nullopt;
  const char* end = text.data() + 6;
  if (std::from_chars(text.data() + 2, end, value, 16).ptr != end) return std::nullopt;
  return value;
}

/// Reads the escape at a backslash; empty where JSON has none. Letters beyond 16 bits are two units; an unpaired half
/// becomes U+FFFD.
std::optional<Escape> escapeAt(std::string_view text) {
  constexpr std::string_view kShort = "\"\\/bfnrt";
  constexpr std::string_view kMeant = "\"\\/\b\f\n\r\t";
  if (text.size() < 2) return std::nullopt;
  if (const auto found = kShort.find(text[1]); found != std::string_view::npos)
    return Escape{char32_t(kMeant[found]), 2};
  const auto first = unitAt(text);
  if (!first) return std::nullopt;
  if (*first < 0xd800 || *first > 0xdfff) return Escape{*first, 6};
  const auto second = unitAt(text.substr(6));
  const bool is_pair = *first < 0xdc00 && second && *second >= 0xdc00 && *second <= 0xdfff;
  if (!is_pair) return Escape{0xfffd, 6};
  return Escape{0x10000 + ((*first - 0xd800) << 10) + (*second - 0xdc00), 12};
}

/// The text of a string whose escapes are sound.
std::string unescaped(std::string_view raw) {
  std::string result;
  result.reserve(raw.size());
  while (!raw.empty()) {
    const std::size_t plain = std::min(raw.find('\\'), raw.size());
    result += raw.substr(0, plain);
    raw.remove_prefix(plain);
    if (raw.empty()) break;
    const Escape escape = escapeAt(raw).value();
    appendLetter(result, escape.letter);
    raw.remove_prefix(escape.length);
  }
  return result;
}

}  // namespace

// --- parsing ---

class JsonParser {
 public:
  explicit JsonParser(JsonDocument& document) : document_(document), text_(document.text_) {}

  void parse() {
    position_ = text_.size() - withoutByteOrderMark(text_).size();  // a reader may pass it over (section 8.1)
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
      } while (consumeIf(','));
    }
    expect(closing);
    closeNode(node, count);
  }

  bool consumeIf(char c) {
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
      if (text_[position_] == '\\' && !escapeAt(text_.substr(position_))) fail("not an escape of a JSON string");
      position_ += text_[position_] == '\\' ? 2 : 1;
    }
    if (position_ >= text_.size()) fail("the JSON text ends within a string");
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
    if (!isNumber(word) || !parseNumber(word)) fail("not a JSON value");
    return Kind::number;
  }

  /// parseNumber also accepts "inf", "nan", a plus sign, zeros in front and a bare point; JSON does not (section 6).
  static bool isNumber(std::string_view word) {
    if (word.starts_with('-')) word.remove_prefix(1);
    if (word.size() > 1 && word[0] == '0' && isDigit(word[1])) return false;
    if (!consumeDigits(word)) return false;
    if (word.starts_with('.') && (word.remove_prefix(1), !consumeDigits(word))) return false;
    if (word.empty()) return true;
    if (word[0] != 'e' && word[0] != 'E') return false;
    word.remove_prefix(1);
    if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
    return consumeDigits(word) && word.empty();
  }

  static bool isDigit(char c) { return c >= '0' && c <= '9'; }
  static bool consumeDigits(std::string_view& word) {
    const auto digits = std::find_if_not(word.begin(), word.end(), isDigit) - word.begin();
    word.remove_prefix(static_cast<std::size_t>(digits));
    return digits > 0;
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
    const std::string_view raw = JsonValue(document_, key).slice();
    const bool is_escaped = raw.find('\\') != std::string_view::npos;
    if (is_escaped ? unescaped(raw) == name : raw == name) return {document_, key + 1};
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
  return unescaped(slice());
}

void JsonValue::fail(std::string_view cause) const { document_->fail(node().position, cause); }

}  // namespace palpate::mesh
