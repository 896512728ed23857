// PLY, text and binary in both byte orders: x, y, z of the element `vertex`, the index lists of the elements `face` and
// `tristrips`, and where they are asked for the colours and numbers of the vertices.
//
// Everything else in the file is passed over as its header declares it; other elements are told. The header's
// counts are never trusted: memory is taken for what the bytes that are left can hold.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "palpate/mesh/files/detail/byte_reader.h"
#include "palpate/mesh/files/detail/polygons.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/files/detail/text_reader.h"

namespace palpate::mesh {

namespace {

enum class Type : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

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
  std::uint64_t count = 0;  // as the header says; checkCount compares it with what the file can hold
  std::vector<Property> properties;
};

enum class Encoding : std::uint8_t { text, little, big };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

// --- header ---

Type readType(TextReader& text) {
  const auto word = text.word();
  const auto found = std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](const auto& t) { return t.name == word; });
  if (found == kTypeNames.end()) text.fail(fmt::format("'{}' is not a PLY type", shown(word)));
  return found->type;
}

Encoding readEncoding(TextReader& text) {
  const auto word = text.word();
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::little;
  if (word == "binary_big_endian") return Encoding::big;
  text.fail(fmt::format("'{}' is not a PLY format", shown(word)));
}

Property readProperty(TextReader& text) {
  Property property;
  property.is_list = text.restOfLine().starts_with("list ");
  if (property.is_list) {
    text.word();
    property.count_type = readType(text);
    if (property.count_type >= Type::f32) text.fail("the length of a list cannot be a fraction");
  }
  property.type = readType(text);
  property.name = text.word();
  return property;
}

Element readElement(TextReader& text) {
  constexpr long long kHighest = 1LL << 62;
  const auto name = text.word();
  return {name, static_cast<std::uint64_t>(text.whole(text.word(), "the number of elements", 0, kHighest)), {}};
}

/// Leaves the reader at the end of the line "end_header".
Header readHeader(TextReader& text) {
  Header header;
  if (text.word() != "ply") text.fail("not a PLY file: it does not start with 'ply'");
  while (text.nextLine()) {
    const auto keyword = text.word();
    if (keyword == "end_header") return header;
    if (keyword == "format") header.encoding = readEncoding(text);
    if (keyword == "element") header.elements.push_back(readElement(text));
    if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      header.elements.back().properties.push_back(readProperty(text));
    } else if (keyword != "format" && keyword != "element" && keyword != "comment" && keyword != "obj_info" &&
               !keyword.empty()) {
      text.fail(fmt::format("'{}' is not a keyword of a PLY header", shown(keyword)));
    }
  }
  text.fail("the file ends before 'end_header'");
}

// --- values ---

/// Values of a text file: one number a word.
class TextValues {
 public:
  static constexpr FilePlace kPlace = FilePlace::line;
  TextValues(TextReader& text, Encoding) : text_(text) {}

  double value(Type) {
    const auto word = text_.wordAnywhere();
    if (word.empty()) fail("the file ends before all its elements are there");
    return text_.number(word, "a value");
  }
  static std::size_t leastBytes(Type) { return 2; }
  std::size_t bytesLeft() const { return text_.bytesLeft() + 1; }
  std::size_t place() const { return text_.line(); }
  [[noreturn]] void fail(std::string_view cause) const { text_.fail(cause); }

 private:
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

/// Where a row of the vertices has its colour, and what full light is.
struct ColourColumns {
  std::array<std::size_t, 3> columns{};
  double full = 255.0;
};

struct ChannelColumns {
  std::vector<std::size_t> scalars;  ///< as many as there are in the channels
  std::optional<ColourColumns> colour;
};

double fullLightOf(Type type) {
  if (type == Type::f32 || type == Type::f64) return 1.0;
  return type == Type::u16 || type == Type::i16 ? 65535.0 : 255.0;
}

std::optional<std::size_t> scalarColumn(const Element& element, std::string_view name) {
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    if (element.properties[p].name == name && !element.properties[p].is_list) return p;
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
  colour.full = fullLightOf(element.properties[colour.columns[0]].type);
  return colour;
}

bool isNumberOfItsOwn(std::string_view name) {
  constexpr auto kOthers =
      std::to_array<std::string_view>({"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "diffuse_red",
                                       "diffuse_green", "diffuse_blue", "diffuse_alpha"});
  return std::find(kOthers.begin(), kOthers.end(), name) == kOthers.end();
}

/// Prepares the channels for these vertices.
ChannelColumns startChannels(const Element& element, VertexChannels& channels) {
  ChannelColumns columns;
  columns.colour = colourColumns(element, {"red", "green", "blue"});
  if (!columns.colour) columns.colour = colourColumns(element, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const Property& property = element.properties[p];
    const bool first_of_its_name = scalarColumn(element, property.name) == p;
    if (property.is_list || !isNumberOfItsOwn(property.name) || !first_of_its_name) continue;
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
    if (property.is_list || !isNumberOfItsOwn(property.name) || !first_of_its_name) continue;
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
      if (element.name == "vertex") {
        readVertices(element);
      } else {
        readOthers(element);
      }
    }
    polygons_.cut(mesh_, {file_.name, Values::kPlace, 0}, file_.options.keep_wrong_indices, file_.passed_over);
    if (channels_ != nullptr && vertex_elements_ > 1) *channels_ = {};  // they need not have the same properties
    return std::move(mesh_);
  }

 private:
  /// An element takes at least these bytes, so a header that lies is found before anything is read.
  void checkCount(const Element& element) const {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += Values::leastBytes(p.is_list ? p.count_type : p.type);
    if (least == 0 || element.count <= values_.bytesLeft() / least) return;
    values_.fail(fmt::format("the header promises {} of '{}', the file holds {} at most", element.count,
                             shown(element.name), values_.bytesLeft() / least));
  }

  void readVertices(const Element& element) {
    std::array<std::size_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = columnOf(element, std::string_view("xyz").substr(axis, 1));
    if (element.count >= kNoIndex) values_.fail("more vertices than 32-bit indices can name");
    mesh_.positions.reserve(static_cast<std::size_t>(element.count));
    std::vector<double> row(element.properties.size());
    const bool wanted = channels_ != nullptr && vertex_elements_++ == 0;
    const ChannelColumns columns = wanted ? startChannels(element, *channels_) : ChannelColumns();
    for (std::size_t v = 0; v < element.count; ++v) {
      for (std::size_t p = 0; p < row.size(); ++p) row[p] = readOrPassOver(element.properties[p]);
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
    const bool are_faces = element.name == "face";
    const bool are_strips = element.name == "tristrips";
    const auto& all = element.properties;
    const bool have_indices = std::any_of(all.begin(), all.end(), isIndexList);
    if (element.count > 0 && !((are_faces || are_strips) && have_indices)) {
      file_.passed_over.leaveOut(
          fmt::format("elements '{}'{}", shown(element.name), are_faces ? " without vertex_indices" : ""),
          static_cast<std::size_t>(element.count));
    }
    const bool wanted = are_faces && channels_ != nullptr && channels_->of_faces.empty();
    const auto columns = wanted ? startFaceScalars(element, *channels_) : std::vector<std::size_t>();
    std::vector<double> values(element.properties.size());
    for (std::size_t row = 0; row < element.count; ++row) {
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
      if (!columns.empty()) addFaceScalars(values, columns, *channels_);
      reportProgress(row);
    }
  }

  static bool isIndexList(const Property& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  static Index cornerOf(double index) {
    const bool possible = index >= 0.0 && index < kNoIndex && index == std::floor(index);
    return possible ? static_cast<Index>(index) : kNoIndex;
  }

  void readPolygon(const Property& property) {
    const std::size_t place = values_.place();
    const std::size_t count = readLength(property);
    for (std::size_t i = 0; i < count; ++i) polygons_.addCorner(cornerOf(values_.value(property.type)));
    polygons_.close(place);
  }

  /// Strips of triangles, each winding the other way than the one before; -1 begins a new strip.
  void readStrips(const Property& property) {
    const std::size_t place = values_.place();
    const std::size_t count = readLength(property);
    std::array<Index, 2> last{};
    std::size_t corners = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double index = values_.value(property.type);
      if (index == -1.0) {
        corners = 0;
        continue;
      }
      const Index corner = cornerOf(index);
      if (corners >= 2) {
        const std::size_t turned = corners % 2;
        for (const Index v : {last[turned], last[1 - turned], corner}) polygons_.addCorner(v);
        polygons_.close(place);
      }
      last = {last[1], corner};
      ++corners;
    }
  }

  /// The value of a scalar; 0 for a list.
  double readOrPassOver(const Property& property) {
    if (!property.is_list) return values_.value(property.type);
    const std::size_t count = readLength(property);
    for (std::size_t i = 0; i < count; ++i) values_.value(property.type);
    return 0.0;
  }

  std::size_t readLength(const Property& property) {
    const double length = values_.value(property.count_type);
    const auto most = values_.bytesLeft() / Values::leastBytes(property.type);
    if (length >= 0.0 && length <= static_cast<double>(most)) return static_cast<std::size_t>(length);
    values_.fail(fmt::format("a list of {} values, the file holds {} more at most", length, most));
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

TriangleMesh readPly(const MeshFile& file, VertexChannels* channels) {
  TextReader text(file.bytes, file.name, file.progress);
  const Header header = readHeader(text);
  text.nextLine();
  if (header.encoding == Encoding::text)
    return BodyReader(TextValues(text, header.encoding), file, channels).read(header);
  ByteReader bytes(file.bytes, file.name, text.position());
  return BodyReader(BinaryValues(bytes, header.encoding), file, channels).read(header);
}

}  // namespace palpate::mesh
