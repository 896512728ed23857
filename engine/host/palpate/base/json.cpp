// The only file that includes nlohmann-json. The library reads and writes the text; errors that are thrown here have
// the words that it would use.
#include "palpate/base/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace palpate {

/// The elements of an array, or the members of an object, which alone has `names`, one per value.
struct Json::Children {
  std::vector<std::string> names{};
  std::vector<Json> values{};
};

namespace {

using Library = nlohmann::ordered_json;

[[noreturn]] void failOfType(int number, const std::string& cause) {
  throw JsonError("[json.exception.type_error." + std::to_string(number) + "] " + cause);
}

[[noreturn]] void failOfRange(int number, const std::string& cause) {
  throw JsonError("[json.exception.out_of_range." + std::to_string(number) + "] " + cause);
}

[[noreturn]] void refuseUse(int number, const char* use, const Json& json) {
  failOfType(number, std::string("cannot use ") + use + " with " + json.type_name());
}

[[noreturn]] void refuseType(const char* type, const Json& json) {
  failOfType(302, std::string("type must be ") + type + ", but is " + json.type_name());
}

/// Builds the value while the library reads the text. Without recursion, since a text may be nested as deep as it is
/// long.
class JsonBuilder {
 public:
  Json releaseRoot() { return std::move(root_); }
  const std::string& error() const { return error_; }

  // NOLINTBEGIN(readability-identifier-naming): the names that the library calls
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string& /*text*/) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Library::binary_t& /*value*/) { return false; }  // not in text
  bool start_object(std::size_t /*size*/) { return open(Json::object()); }
  bool key(std::string& name) {
    member_ = &(*open_.back())[name];  // the last value counts if a name comes twice
    return true;
  }
  bool end_object() { return close(); }
  bool start_array(std::size_t /*size*/) { return open(Json::array()); }
  bool end_array() { return close(); }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/, const nlohmann::detail::exception& error) {
    error_ = error.what();
    return false;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  bool add(Json value) {
    place(std::move(value));
    return true;
  }
  bool open(Json value) {
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }
  Json& place(Json&& value) {
    if (open_.empty()) return root_ = std::move(value);
    if (open_.back()->is_object()) return *member_ = std::move(value);
    open_.back()->push_back(std::move(value));
    return open_.back()->back();
  }

  Json root_;
  std::vector<Json*> open_;  ///< one within the other; none of them grows but the last
  Json* member_ = nullptr;
  std::string error_;
};

Library inLibrary(const Json& json) {
  if (json.is_object()) {
    Library object = Library::object();
    // Filled as a plain list: the library would look through it for every name, which are different already.
    Library::object_t::Container& members = object.get_ref<Library::object_t&>();
    members.reserve(json.size());
    for (const auto& [name, value] : json.items()) members.emplace_back(name, inLibrary(value));
    return object;
  }
  if (json.is_array()) {
    Library array = Library::array();
    array.get_ref<Library::array_t&>().reserve(json.size());
    for (const Json& value : json) array.push_back(inLibrary(value));
    return array;
  }
  if (json.is_string()) return json.text();
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_float()) return json.get<double>();
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  return json.is_discarded() ? Library(Library::value_t::discarded) : Library(nullptr);
}

}  // namespace

Json::Json(const char* text) : Json(std::string(text)) {}
Json::Json(std::string_view text) : Json(std::string(text)) {}
Json::Json(const std::string& text) : Json(std::string(text)) {}
Json::Json(std::string&& text) {
  value_.text = new std::string(std::move(text));
  kind_ = Kind::text;
}

Json::Json(std::initializer_list<Json> list)
    : Json(std::all_of(list.begin(), list.end(), [](const Json& one) { return one.isPair(); }) ? object(list)
                                                                                               : array(list)) {}

Json::Json(const Json& other) : value_(other.value_) {
  if (other.kind_ == Kind::text) value_.text = new std::string(*other.value_.text);
  if (other.kind_ > Kind::text) value_.children = new Children(*other.value_.children);
  kind_ = other.kind_;
}

/// Level by level: a value may be nested deeper than the stack allows calls.
void Json::release() noexcept {
  if (kind_ == Kind::text) {
    delete value_.text;
  } else {
    std::vector<Json> open = std::move(value_.children->values);
    delete value_.children;
    while (!open.empty()) {
      const Json last = std::move(open.back());
      open.pop_back();
      if (last.kind_ <= Kind::text) continue;
      std::vector<Json>& values = last.value_.children->values;
      std::move(values.begin(), values.end(), std::back_inserter(open));
      values.clear();
    }
  }
  kind_ = Kind::null;
}

Json Json::array(std::initializer_list<Json> list) {
  Json json;
  json.value_.children = new Children{{}, list};
  json.kind_ = Kind::array;
  return json;
}

Json Json::object(std::initializer_list<Json> members) {
  Json json;
  json.value_.children = new Children;
  json.kind_ = Kind::object;
  for (const Json& member : members) {
    if (!member.isPair()) failOfType(301, "cannot create object from initializer list");
    if (!json.contains(member[0].text())) json.addMember(member[0].text(), Json(member[1]));
  }
  return json;
}

Json Json::parse(std::string_view text) {
  JsonBuilder builder;
  if (!Library::sax_parse(text, &builder)) throw JsonError(builder.error());
  return builder.releaseRoot();
}

Json Json::tryParse(std::string_view text) {
  JsonBuilder builder;
  if (Library::sax_parse(text, &builder)) return builder.releaseRoot();
  Json json;
  json.kind_ = Kind::discarded;
  return json;
}

template <>
bool Json::get<bool>() const {
  if (!is_boolean()) refuseType("boolean", *this);
  return value_.truth;
}

template <class Number>
Number Json::number() const {
  if (kind_ == Kind::integer) return static_cast<Number>(value_.integer);
  if (kind_ == Kind::natural) return static_cast<Number>(value_.natural);
  if (kind_ == Kind::real) return static_cast<Number>(value_.real);
  refuseType("number", *this);
}

template <>
int Json::get<int>() const {
  return number<int>();
}
template <>
long Json::get<long>() const {
  return number<long>();
}
template <>
long long Json::get<long long>() const {
  return number<long long>();
}
template <>
unsigned Json::get<unsigned>() const {
  return number<unsigned>();
}
template <>
unsigned long Json::get<unsigned long>() const {
  return number<unsigned long>();
}
template <>
unsigned long long Json::get<unsigned long long>() const {
  return number<unsigned long long>();
}
template <>
double Json::get<double>() const {
  return number<double>();
}
template <>
std::string Json::get<std::string>() const {
  return text();
}
template <>
std::vector<double> Json::get<std::vector<double>>() const {
  if (!is_array()) refuseType("array", *this);
  std::vector<double> list;
  for (const Json& value : *this) list.push_back(value.get<double>());
  return list;
}
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const {
  if (!is_array()) refuseType("array", *this);
  std::vector<std::string> list;
  for (const Json& value : *this) list.push_back(value.text());
  return list;
}

const std::string& Json::text() const {
  if (!is_string()) refuseType("string", *this);
  return *value_.text;
}

std::size_t Json::size() const noexcept {
  if (kind_ > Kind::text) return value_.children->values.size();
  return is_null() ? 0 : 1;
}

const Json& Json::at(std::string_view name) const {
  if (!is_object()) refuseUse(304, "at()", *this);
  const Json* member = memberNamed(name);
  if (member == nullptr) failOfRange(403, "key '" + std::string(name) + "' not found");
  return *member;
}

const Json& Json::at(std::size_t index) const {
  if (!is_array()) refuseUse(304, "at()", *this);
  if (index >= size()) failOfRange(401, "array index " + std::to_string(index) + " is out of range");
  return value_.children->values[index];
}

Json& Json::at(std::string_view name) { return const_cast<Json&>(std::as_const(*this).at(name)); }
Json& Json::at(std::size_t index) { return const_cast<Json&>(std::as_const(*this).at(index)); }

Json& Json::operator[](std::string_view name) {
  if (is_null()) *this = object();
  if (!is_object()) refuseUse(305, "operator[] with a string argument", *this);
  if (const Json* member = memberNamed(name)) return const_cast<Json&>(*member);
  addMember(name, {});
  return value_.children->values.back();
}

const Json* Json::find(std::string_view name) const noexcept {
  const Json* member = memberNamed(name);
  return member != nullptr ? member : end();
}

Json Json::value(std::string_view name, const Json& otherwise) const {
  if (!is_object()) refuseUse(306, "value()", *this);
  const Json* member = memberNamed(name);
  return member != nullptr ? *member : otherwise;
}

double Json::value(std::string_view name, double otherwise) const { return value(name, Json(otherwise)).get<double>(); }

std::string Json::value(std::string_view name, const std::string& otherwise) const {
  return value(name, Json(otherwise)).text();
}

std::string Json::value(std::string_view name, const char* otherwise) const {
  return value(name, Json(otherwise)).text();
}

void Json::push_back(Json value) {
  if (is_null()) *this = array();
  if (!is_array()) refuseUse(308, "push_back()", *this);
  value_.children->values.push_back(std::move(value));
}

void Json::push_back(std::initializer_list<Json> list) {
  if (is_object() && list.size() == 2 && list.begin()->is_string()) {
    if (!contains(list.begin()->text())) addMember(list.begin()->text(), Json(list.begin()[1]));
  } else {
    push_back(Json(list));
  }
}

void Json::update(const Json& members) {
  if (is_null()) *this = object();
  if (!is_object()) refuseUse(312, "update()", *this);
  if (!members.is_object()) refuseUse(312, "update()", members);
  for (const auto& [name, value] : members.items()) (*this)[name] = value;
}

const Json* Json::begin() const noexcept {
  if (kind_ > Kind::text) return value_.children->values.data();
  return is_null() ? nullptr : this;
}

Json::Items::Iterator& Json::Items::Iterator::operator++() {
  ++name_;
  ++value_;
  return *this;
}

Json::Items Json::items() const {
  if (is_null()) return {nullptr, *this};
  if (!is_object()) refuseUse(305, "items()", *this);
  return {value_.children->names.data(), *this};
}

const char* Json::type_name() const noexcept {
  switch (kind_) {
    case Kind::null:
      return "null";
    case Kind::discarded:
      return "discarded";
    case Kind::boolean:
      return "boolean";
    case Kind::text:
      return "string";
    case Kind::array:
      return "array";
    case Kind::object:
      return "object";
    default:
      return "number";
  }
}

void Json::addMember(std::string_view name, Json&& value) {
  value_.children->names.emplace_back(name);
  value_.children->values.push_back(std::move(value));
}

const Json* Json::memberNamed(std::string_view name) const noexcept {
  if (!is_object()) return nullptr;
  const std::vector<std::string>& names = value_.children->names;
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &value_.children->values[static_cast<std::size_t>(found - names.begin())];
}

bool Json::isPair() const noexcept { return is_array() && size() == 2 && value_.children->values[0].is_string(); }

std::string jsonDump(const Json& json, int indent, bool ascii_alone) {
  return inLibrary(json).dump(indent, ' ', ascii_alone, Library::error_handler_t::replace);
}

}  // namespace palpate
