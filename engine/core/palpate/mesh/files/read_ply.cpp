// PLY, text and binary in both byte orders: x, y, z of the element `vertex`, the index lists of the elements `face` and
// `tristrips`, and on request the colours and numbers of the vertices.
//
// Everything else in the file is passed over as its header declares it; other elements are reported. The header's
// counts are never trusted: memory is bounded by the remaining bytes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/byte_reader.h"
#include "palpate/mesh/files/detail/polygons.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"

namespace palpate::mesh {

namespace {

enum class Type : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

enum class Encoding : std::uint8_t { text, little, big };

struct TypeName {
  std::string_view name;
  Type type;
};
/// Both families of names that are in use.
constexpr auto kTypeNames = std::to_array<TypeName>({{"char", Type::i8},
                                                     {"uchar", Type::u8},
                                                     {"short", Type::i16},
                                                     {"ushort", Type::u16},
                                                     {"int", Type::i32},
                                                     {"uint", Type::u32},
                                                     {"float", Type::f32},
                                                     {"double", Type::f64},
                                                     {"int8", Type::i8},
                                                     {"uint8", Type::u8},
                                                     {"int16", Type::i16},
                                                     {"uint16", Type::u16},
                                                     {"int32", Type::i32},
                                                     {"uint32", Type::u32},
                                                     {"float32", Type::f32},
                                                     {"float64", Type::f64}});

struct Property {
  std::string_view name;
  Type type = Type::f32;
  bool is_list = false;
  Type count_type = Type::u8;
};

struct Element {
  std::string_view name;
  std::uint64_t count = 0;  // from the header; checkCount compares it with the size of the file
  std::vector<Property> properties;
};

/// Blank bytes before the word "ply" that are skipped.
constexpr std::size_t kLongestBeginning = 64;

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

// --- header ---

/// In text the digits suffice, so an unknown type is a number.
Type readType(TextReader& text, std::string_view word, Encoding encoding) {
  const auto* found =
      std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](const auto& t) { return isWord(word, t.name); });
  if (found != kTypeNames.end()) return found->type;
  if (encoding == Encoding::text && !word.empty()) return Type::f64;
  text.fail(fmt::format("'{}' is not a PLY type", shown(word)));
}

Encoding readEncoding(TextReader& text) {
  const auto word = text.word();
  if (isWord(word, "ascii")) return Encoding::text;
  if (isWord(word, "binary_little_endian")) return Encoding::little;
  if (isWord(word, "binary_big_endian")) return Encoding::big;
  text.fail(fmt::format("'{}' is not a PLY format", shown(word)));
}

Property readProperty(TextReader& text, Encoding encoding) {
  Property property;
  auto type = text.word();
  property.is_list = isWord(type, "list");
  if (property.is_list) {
    property.count_type = readType(text, text.word(), encoding);
    if (property.count_type == Type::f32 || (property.count_type == Type::f64 && encoding != Encoding::text)) {
      text.fail("the length of a list cannot be a fraction");
    }
    type = text.word();
  }
  property.type = readType(text, type, encoding);
  property.name = text.word();
  return property;
}

Element readElement(TextReader& text) {
  constexpr long long kHighest = 1LL << 62;
  const auto name = text.word();
  return {name, static_cast<std::uint64_t>(text.whole(text.word(), "the number of elements", 0, kHighest)), {}};
}

/// Leaves the reader behind the word "end_header".
Header readHeader(TextReader& text, PassedOver& passed_over) {
  Header header;
  if (!isWord(text.wordAnywhere(), "ply")) text.fail("not a PLY file: it does not start with 'ply'");
  while (text.nextLine()) {
    const auto keyword = text.word();
    if (isWord(keyword, "end_header")) return header;
    if (isWord(keyword, "format")) {
      header.encoding = readEncoding(text);
    } else if (isWord(keyword, "element")) {
      header.elements.push_back(readElement(text));
    } else if (isWord(keyword, "property")) {
      if (header.elements.empty()) text.fail("a property before the first element");
      header.elements.back().properties.push_back(readProperty(text, header.encoding));
    } else if (!keyword.empty() && !isWord(keyword, "comment") && !isWord(keyword, "obj_info")) {
      passed_over.add(fmt::format("'{}' is not a keyword of a PLY header; the line is skipped", shown(keyword)),
                      text.line());
    }
  }
  text.fail("the file ends before 'end_header'");
}

// --- values ---

/// Values of a text file: one number per word, one row of an element per line. A row never takes a value of the next
/// line; extra words on a line are passed over and reported: else one wrong count would shift all that follows.
class TextValues {
 public:
  static constexpr FilePlace kPlace = FilePlace::line;
  TextValues(TextReader& text, Encoding) : text_(text) {}

  void startRow() {
    if (!text_.nextFilledLine()) fail("the file ends before all its elements are there");
  }
  double value(Type) { return text_.number(next(), "a value"); }
  /// An unused value: it may be anything.
  double anyValue(Type) { return numberOrNone(next()); }
  void endRow(PassedOver& passed_over) {
    if (!text_.word().empty()) {
      passed_over.add("the row has more values than the header declares; they are skipped", text_.line());
    }
  }
  /// Rows of an unused element.
  bool passOverRows(std::uint64_t count) {
    for (std::uint64_t row = 0; row < count; ++row) startRow();
    return true;
  }
  void end(PassedOver& passed_over) {
    while (text_.nextFilledLine()) {
      passed_over.add("a line after the last row declared by the header is skipped", text_.line());
    }
  }

  static std::size_t leastBytes(Type) { return 2; }
  std::size_t bytesLeft() const { return text_.bytesLeft() + 1; }
  std::size_t place() const { return text_.line(); }
  [[noreturn]] void fail(std::string_view cause) const { text_.fail(cause); }

 private:
  std::string_view next() {
    const auto word = text_.word();
    if (word.empty()) fail("the row has fewer values than the header names");
    return word;
  }

  TextReader& text_;
};

class BinaryValues {
 public:
  static constexpr FilePlace kPlace = FilePlace::byte;
  BinaryValues(ByteReader bytes, Encoding encoding)
      : bytes_(bytes), order_(encoding == Encoding::big ? std::endian::big : std::endian::little) {}

  double value(Type type) {
    switch (type) {
      case Type::i8:
        return bytes_.number<std::int8_t>(order_);
      case Type::u8:
        return bytes_.number<std::uint8_t>(order_);
      case Type::i16:
        return bytes_.number<std::int16_t>(order_);
      case Type::u16:
        return bytes_.number<std::uint16_t>(order_);
      case Type::i32:
        return bytes_.number<std::int32_t>(order_);
      case Type::u32:
        return bytes_.number<std::uint32_t>(order_);
      case Type::f32:
        return bytes_.number<float>(order_);
      case Type::f64:
        return bytes_.number<double>(order_);
    }
    return 0.0;
  }
  void startRow() {}
  double anyValue(Type type) { return value(type); }
  void endRow(PassedOver&) {}
  /// Their bytes must be counted.
  static bool passOverRows(std::uint64_t) { return false; }
  void end(PassedOver& passed_over) {
    if (bytes_.bytesLeft() == 0) return;
    passed_over.add("bytes after the last row declared by the header are skipped", bytes_.position(), FilePlace::byte);
  }

  static std::size_t leastBytes(Type type) {
    constexpr std::array<std::size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
  }
  std::size_t bytesLeft() const { return bytes_.bytesLeft(); }
  std::size_t place() const { return bytes_.position(); }
  [[noreturn]] void fail(std::string_view cause) const { bytes_.fail(cause); }

 private:
  ByteReader bytes_;
  std::endian order_;
};

// --- what else a vertex has ---

/// Columns of the colour in a row of the vertices, and the value of full light.
struct ColourColumns {
  std::array<std::size_t, 3> columns{};
  double full = 255.0;
};

struct ChannelColumns {
  std::vector<std::size_t> scalars;  ///< one per scalar channel
  std::optional<ColourColumns> colour;
};

double fullIntensity(Type type) {
  if (type == Type::f32 || type == Type::f64) return 1.0;
  return type == Type::u16 || type == Type::i16 ? 65535.0 : 255.0;
}

std::optional<std::size_t> scalarColumn(const Element& element, std::string_view name) {
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const std::string_view own = element.properties[p].name;
    if ((own == name || isWord(own, name)) && !element.properties[p].is_list) return p;
  }
  return std::nullopt;
}

std::optional<ColourColumns> colourColumns(const Element& element, const std::array<std::string_view, 3>& names) {
  ColourColumns colour;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto column = scalarColumn(element, names[c]);
    if (!column) return std::nullopt;
    colour.columns[c] = *column;
  }
  colour.full = fullIntensity(element.properties[colour.columns[0]].type);
  return colour;
}

bool isExtraScalar(std::string_view name) {
  constexpr auto kOthers =
      std::to_array<std::string_view>({"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "diffuse_red",
                                       "diffuse_green", "diffuse_blue", "diffuse_alpha"});
  return std::none_of(kOthers.begin(), kOthers.end(), [name](auto other) { return isWord(name, other); });
}

/// Prepares the channels for these vertices.
ChannelColumns startChannels(const Element& element, VertexChannels& channels) {
  ChannelColumns columns;
  columns.colour = colourColumns(element, {"red", "green", "blue"});
  if (!columns.colour) columns.colour = colourColumns(element, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const Property& property = element.properties[p];
    const bool first_of_its_name = scalarColumn(element, property.name) == p;
    if (property.is_list || !isExtraScalar(property.name) || !first_of_its_name) continue;
    if (channels.scalars.size() == kMaxVertexScalars) break;
    columns.scalars.push_back(p);
    channels.scalars.push_back({std::string(property.name), {}});
  }
  return columns;
}

void addChannels(const std::vector<double>& row, const ChannelColumns& columns, VertexChannels& channels) {
  for (std::size_t i = 0; i < columns.scalars.size(); ++i) {
    channels.scalars[i].values.push_back(static_cast<float>(row[columns.scalars[i]]));
  }
  if (!columns.colour) return;
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double light = row[columns.colour->columns[c]] / columns.colour->full;
    colour[c] = light > 0.0 ? static_cast<std::uint8_t>(std::lround(std::min(light, 1.0) * 255.0)) : std::uint8_t{0};
  }
  channels.colours.push_back(colour);
}

/// The columns of a face's numbers, a row of the channels each.
std::vector<std::size_t> startFaceScalars(const Element& element, VertexChannels& channels) {
  std::vector<std::size_t> columns;
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const Property& property = element.properties[p];
    const bool first_of_its_name = scalarColumn(element, property.name) == p;
    if (property.is_list || !isExtraScalar(property.name) || !first_of_its_name) continue;
    if (channels.of_faces.size() == kMaxVertexScalars) break;
    columns.push_back(p);
    channels.of_faces.push_back({std::string(property.name), std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()});
  }
  return columns;
}

void addFaceScalars(const std::vector<double>& row, const std::vector<std::size_t>& columns, VertexChannels& channels) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double value = row[columns[i]];
    if (!std::isfinite(value)) continue;
    channels.of_faces[i].least = std::min(channels.of_faces[i].least, value);
    channels.of_faces[i].most = std::max(channels.of_faces[i].most, value);
  }
}

// --- body ---

template <class Values>
class BodyReader {
 public:
  BodyReader(Values values, const MeshFile& file, VertexChannels* channels)
      : values_(values), file_(file), channels_(channels) {}

  TriangleMesh read(const Header& header) {
    for (const Element& element : header.elements) {
      checkCount(element);
      if (isWord(element.name, "vertex")) {
        readVertices(element);
      } else {
        readOthers(element);
      }
    }
    values_.end(file_.passed_over);
    polygons_.cut(mesh_, {file_.name, Values::kPlace, 0}, file_.options.keep_wrong_indices, file_.passed_over);
    if (channels_ != nullptr && vertex_elements_ > 1) *channels_ = {};  // they need not have the same properties
    return std::move(mesh_);
  }

 private:
  /// An element takes at least these bytes, so a false header is found before anything is read.
  void checkCount(const Element& element) const {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += Values::leastBytes(p.is_list ? p.count_type : p.type);
    if (least == 0 || element.count <= values_.bytesLeft() / least) return;
    values_.fail(fmt::format("the header declares {} of '{}', but the file has at most {}", element.count,
                             shown(element.name), values_.bytesLeft() / least));
  }

  void readVertices(const Element& element) {
    std::array<std::size_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = columnOf(element, std::string_view("xyz").substr(axis, 1));
    if (element.count >= kNoIndex) values_.fail("too many vertices for 32-bit indices");
    mesh_.positions.reserve(static_cast<std::size_t>(element.count));
    std::vector<double> row(element.properties.size());
    const bool wanted = channels_ != nullptr && vertex_elements_++ == 0;
    const ChannelColumns columns = wanted ? startChannels(element, *channels_) : ChannelColumns();
    for (std::size_t v = 0; v < element.count; ++v) {
      values_.startRow();
      for (std::size_t p = 0; p < row.size(); ++p) {
        const bool is_place = std::find(place.begin(), place.end(), p) != place.end();
        row[p] = is_place ? values_.value(element.properties[p].type) : readOrPassOver(element.properties[p]);
      }
      values_.endRow(file_.passed_over);
      mesh_.positions.emplace_back(row[place[0]], row[place[1]], row[place[2]]);
      if (wanted) addChannels(row, columns, *channels_);
      reportProgress(v);
    }
  }

  std::size_t columnOf(const Element& element, std::string_view name) const {
    if (const auto column = scalarColumn(element, name)) return *column;
    values_.fail(fmt::format("the vertices have no '{}'", name));
  }

  void readOthers(const Element& element) {
    if (element.properties.empty()) return;
    const bool are_faces = isWord(element.name, "face");
    const bool are_strips = isWord(element.name, "tristrips");
    const bool bring_surface = are_faces || are_strips;
    if (!bring_surface && element.count > 0) {
      file_.passed_over.leaveOut(fmt::format("elements '{}'", shown(element.name)),
                                 static_cast<std::size_t>(element.count));
    }
    if (!bring_surface && values_.passOverRows(element.count)) return;
    if (bring_surface && element.count > 0 &&
        std::none_of(element.properties.begin(), element.properties.end(), isIndexList)) {
      values_.fail(fmt::format("'{}' has no list 'vertex_indices'", shown(element.name)));
    }
    const bool wanted = are_faces && channels_ != nullptr && channels_->of_faces.empty();
    const auto columns = wanted ? startFaceScalars(element, *channels_) : std::vector<std::size_t>();
    std::vector<double> values(element.properties.size());
    for (std::size_t row = 0; row < element.count; ++row) {
      values_.startRow();
      for (std::size_t p = 0; p < values.size(); ++p) {
        const Property& property = element.properties[p];
        if (are_faces && isIndexList(property)) {
          readPolygon(property);
        } else if (are_strips && isIndexList(property)) {
          readStrips(property);
        } else {
          values[p] = readOrPassOver(property);
        }
      }
      values_.endRow(file_.passed_over);
      if (!columns.empty()) addFaceScalars(values, columns, *channels_);
      reportProgress(row);
    }
  }

  static bool isIndexList(const Property& property) {
    return property.is_list && (isWord(property.name, "vertex_indices") || isWord(property.name, "vertex_index"));
  }

  Index readIndex(const Property& property) {
    const double index = values_.value(property.type);
    const bool possible = index >= 0.0 && index < kNoIndex && index == std::floor(index);
    return possible ? static_cast<Index>(index) : kNoIndex;
  }

  void readPolygon(const Property& property) {
    const std::size_t place = values_.place();
    const std::size_t count = readLength(property);
    for (std::size_t i = 0; i < count; ++i) polygons_.addCorner(readIndex(property));
    polygons_.close(place);
  }

  /// Each vertex makes a triangle with the two before it, every second one turned; -1 begins another strip. So VRIP
  /// and Stanford's scans have it.
  void readStrips(const Property& property) {
    const std::size_t place = values_.place();
    const std::size_t count = readLength(property);
    std::array<Index, 2> before{};
    std::size_t length = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Index vertex = readIndex(property);
      if (vertex == kNoIndex) {
        length = 0;
        continue;
      }
      if (length >= 2 && vertex != before[0] && vertex != before[1] && before[0] != before[1]) {
        const bool turned = length % 2 == 1;
        for (const Index corner : {before[turned ? 1 : 0], before[turned ? 0 : 1], vertex}) polygons_.addCorner(corner);
        polygons_.close(place);
      }
      before = {before[1], vertex};
      ++length;
    }
  }

  /// The value of a scalar; 0 for a list.
  double readOrPassOver(const Property& property) {
    if (!property.is_list) return values_.anyValue(property.type);
    const std::size_t count = readLength(property);
    for (std::size_t i = 0; i < count; ++i) values_.anyValue(property.type);
    return 0.0;
  }

  std::size_t readLength(const Property& property) {
    const double length = values_.value(property.count_type);
    const auto most = values_.bytesLeft() / Values::leastBytes(property.type);
    if (length >= 0.0 && length <= static_cast<double>(most)) return static_cast<std::size_t>(length);
    values_.fail(fmt::format("a list of {} values, but the file has at most {} more", length, most));
  }

  void reportProgress(std::size_t row) {
    constexpr std::size_t kRowsPerReport = std::size_t{1} << 17;
    if (row % kRowsPerReport != 0) return;
    report(file_.progress, "reading", 1.0 - static_cast<double>(values_.bytesLeft()) / file_.bytes.size());
  }

  Values values_;
  const MeshFile& file_;
  VertexChannels* channels_;
  std::size_t vertex_elements_ = 0;
  TriangleMesh mesh_;
  PolygonList polygons_;
};

}  // namespace

bool beginsAsPly(std::string_view bytes) {
  const std::string_view text = trimmed(withoutByteOrderMark(bytes).substr(0, kLongestBeginning));
  return isWord(text.substr(0, 3), "ply") && std::string_view(" \t\r\n").find(text.substr(3, 1)) != std::string::npos;
}

TriangleMesh readPly(const MeshFile& file, VertexChannels* channels) {
  TextReader text(file.bytes, file.name, file.progress);
  const Header header = readHeader(text, file.passed_over);
  if (header.encoding == Encoding::text)
    return BodyReader(TextValues(text, header.encoding), file, channels).read(header);
  // Where lines end in CR alone, the first byte of the rows may be that of a LF.
  const std::size_t first_end = file.bytes.find_first_of("\r\n");
  const bool by_cr = file.bytes[first_end] == '\r' && file.bytes.substr(first_end + 1, 1) != "\n";
  std::size_t start = file.bytes.find(by_cr ? '\r' : '\n', text.position());
  start = start == std::string_view::npos ? file.bytes.size() : start + 1;
  return BodyReader(BinaryValues(ByteReader(file.bytes, file.name, start), header.encoding), file, channels)
      .read(header);
}

}  // namespace palpate::mesh
