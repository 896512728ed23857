// A small strict JSON reader for glTF that knows the place of every value and bounds its memory by the text.
//
// Own rather than nlohmann-json, with which the host reads messages, or cgltf and tinygltf, which use such readers: a
// user's mesh file needs a limit of nesting, the place of each mistake, and flat storage (16 bytes a value) read
// without a copy; and the core, which a web page carries, depends on no JSON
// values or one Error (tests/fuzz). Of two members with one name the first counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::mesh {

class JsonValue;

class JsonDocument {
 public:
  /// Place of the text in its file, for messages: `offset` bytes after the start of a binary file, or the file is text
  /// itself and lines are named.
  struct Place {
    std::string_view file;
    bool is_text = true;
    std::size_t offset = 0;
  };
  /// Reads it all. The text must outlive the document and be shorter than 4 GiB. Throws Error with the place.
  JsonDocument(std::string_view text, const Place& place);

  JsonValue root() const;
  /// Throws Error at a byte of the text.
  [[noreturn]] void fail(std::size_t position, std::string_view cause) const;

 private:
  friend class JsonValue;
  friend class JsonParser;

  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };
  /// An array is followed by its values, an object by its keys and values in turn.
  struct Node {
    Kind kind;
    std::uint32_t position;  // its first byte in the text
    std::uint32_t size;      // bytes of text of a scalar (a string's without its quotes); values in an array or object
    std::uint32_t end;       // the node after it and its contents
  };

  std::string_view text_;
  Place place_;
  std::vector<Node> nodes_;
};

/// One value of a document, or null (a missing member). Small, copied freely, valid as long as its document.
class JsonValue {
 public:
  JsonValue() = default;
  explicit operator bool() const { return document_ != nullptr; }

  /// The member of this object with that name; null when it is missing or this is null. Fails unless this is an object.
  JsonValue operator[](std::string_view name) const;
  /// The values of this array; empty for null. Fails unless this is an array.
  std::vector<JsonValue> items() const;

  double number() const;
  /// A whole number within [0, below).
  std::size_t index(std::size_t below, std::string_view what) const;
  std::size_t indexOr(std::size_t fallback, std::size_t below, std::string_view what) const {
    return *this ? index(below, what) : fallback;
  }
  bool isTrue() const;
  std::string text() const;

  /// Throws Error at this value.
  [[noreturn]] void fail(std::string_view cause) const;

 private:
  friend class JsonDocument;
  JsonValue(const JsonDocument* document, std::uint32_t node) : document_(document), node_(node) {}
  const JsonDocument::Node& node() const;
  std::string_view slice() const;

  const JsonDocument* document_ = nullptr;
  std::uint32_t node_ = 0;
};

}  // namespace palpate::mesh
