// JSON as a value: reports, records and messages are built as one, written from it and read into it. Only json.cpp
// includes the JSON library, whose templates would cost every other file seconds of compile time.
//
// A value is built with braces as the library's own type is: a list whose elements are all lists of two that start with
// a string is an object, every other list an array. One element that already is a Json is an exception: {value} copies
// it, and Json::array({value}) makes a list of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpate {

/// Thrown where a text is not JSON or a value is not of the requested type. Not a palpate::Error, since only the caller
/// knows where the text came from.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Members of an object stay in the order in which they were added. The methods have the names that the library's users
/// know.
// NOLINTBEGIN(readability-identifier-naming)
class Json {
 public:
  Json() noexcept = default;
  Json(std::nullptr_t) noexcept {}
  Json(bool value) noexcept : kind_(Kind::boolean) { value_.truth = value; }
  Json(int value) noexcept : Json(static_cast<long long>(value)) {}
  Json(long value) noexcept : Json(static_cast<long long>(value)) {}
  Json(long long value) noexcept : kind_(Kind::integer) { value_.integer = value; }
  Json(unsigned value) noexcept : Json(static_cast<unsigned long long>(value)) {}
  Json(unsigned long value) noexcept : Json(static_cast<unsigned long long>(value)) {}
  Json(unsigned long long value) noexcept : kind_(Kind::natural) { value_.natural = value; }
  Json(double value) noexcept : kind_(Kind::real) { value_.real = value; }
  Json(const char* text);
  Json(std::string_view text);
  Json(const std::string& text);
  Json(std::string&& text);
  Json(const void* pointer) = delete;  // it would be true
  Json(std::initializer_list<Json> list);
  template <class Value>
  Json(const std::vector<Value>& list) : Json(array()) {
    for (const auto& value : list) push_back(Json(value));
  }
  template <class Value, std::size_t N>
  Json(const std::array<Value, N>& list) : Json(array()) {
    for (const Value& value : list) push_back(Json(value));
  }

  Json(const Json& other);
  Json(Json&& other) noexcept : kind_(other.kind_), value_(other.value_) { other.kind_ = Kind::null; }
  /// Passed by value, because the other may be within this one.
  Json& operator=(Json other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(value_, other.value_);
    return *this;
  }
  ~Json() {
    if (kind_ >= Kind::text) release();
  }

  static Json array(std::initializer_list<Json> list = {});
  static Json object(std::initializer_list<Json> members = {});

  /// Throws JsonError where the text is not JSON, with the place in it.
  static Json parse(std::string_view text);
  /// is_discarded() where the text is not JSON.
  static Json tryParse(std::string_view text);

  bool is_null() const noexcept { return kind_ == Kind::null; }
  bool is_boolean() const noexcept { return kind_ == Kind::boolean; }
  bool is_number() const noexcept { return is_number_integer() || is_number_float(); }
  bool is_number_integer() const noexcept { return kind_ == Kind::integer || kind_ == Kind::natural; }
  bool is_number_unsigned() const noexcept { return kind_ == Kind::natural; }  ///< read without a sign
  bool is_number_float() const noexcept { return kind_ == Kind::real; }
  bool is_string() const noexcept { return kind_ == Kind::text; }
  bool is_array() const noexcept { return kind_ == Kind::array; }
  bool is_object() const noexcept { return kind_ == Kind::object; }
  bool is_discarded() const noexcept { return kind_ == Kind::discarded; }

  /// The value as bool, a number, std::string, or a vector of double or std::string. Numbers convert into each other
  /// without a check of their range. Throws JsonError for another type.
  template <class Value>
  Value get() const = delete;
  /// Throws JsonError where it is not a string.
  const std::string& text() const;

  /// Elements of an array or object; 0 for null, 1 for everything else.
  std::size_t size() const noexcept;
  bool empty() const noexcept { return size() == 0; }

  /// These throw JsonError for a missing element or member.
  const Json& at(std::string_view name) const;
  const Json& at(std::size_t index) const;
  Json& at(std::string_view name);
  Json& at(std::size_t index);
  const Json& at(int index) const { return at(static_cast<std::size_t>(index)); }
  Json& at(int index) { return at(static_cast<std::size_t>(index)); }
  const Json& operator[](std::string_view name) const { return at(name); }
  const Json& operator[](std::size_t index) const { return at(index); }
  const Json& operator[](int index) const { return at(index); }
  /// A member that is missing is added as null; null becomes an object. Throws JsonError for every other type.
  Json& operator[](std::string_view name);
  Json& operator[](std::size_t index) { return at(index); }
  Json& operator[](int index) { return at(index); }

  bool contains(std::string_view name) const noexcept { return memberNamed(name) != nullptr; }
  /// end() if it is not an object or lacks the member.
  const Json* find(std::string_view name) const noexcept;

  /// The member, or `otherwise` if it is missing. Throws JsonError if this is not an object, or if the member has
  /// another type than `otherwise`.
  Json value(std::string_view name, const Json& otherwise) const;
  double value(std::string_view name, double otherwise) const;
  std::string value(std::string_view name, const std::string& otherwise) const;
  std::string value(std::string_view name, const char* otherwise) const;

  /// Null becomes an array. Throws JsonError for every other type.
  void push_back(Json value);
  /// A list as one element; of an object {"name", value} as one member.
  void push_back(std::initializer_list<Json> list);
  /// Sets every member of another object. Throws JsonError where either is not an object.
  void update(const Json& members);

  /// Elements of an array, values of an object; everything else but null is its own one element.
  const Json* begin() const noexcept;
  const Json* end() const noexcept { return begin() + size(); }
  Json* begin() noexcept { return const_cast<Json*>(std::as_const(*this).begin()); }
  Json* end() noexcept { return begin() + size(); }
  const Json& front() const { return at(std::size_t{0}); }
  const Json& back() const { return at(size() - 1); }
  Json& back() { return at(size() - 1); }

  struct Item {
    const std::string& name;
    const Json& value;
  };
  class Items {
   public:
    class Iterator {
     public:
      Iterator(const std::string* name, const Json* value) : name_(name), value_(value) {}
      Item operator*() const { return {*name_, *value_}; }
      Iterator& operator++();
      bool operator!=(const Iterator& other) const { return value_ != other.value_; }

     private:
      const std::string* name_;
      const Json* value_;
    };
    Items(const std::string* names, const Json& object) : names_(names), object_(object) {}
    Iterator begin() const { return {names_, object_.begin()}; }
    Iterator end() const { return {nullptr, object_.end()}; }

   private:
    const std::string* names_;
    const Json& object_;
  };
  /// `for (const auto& [name, value] : json.items())`. Throws JsonError where it is neither an object nor null.
  Items items() const;

  /// "number", "object": as errors name the type.
  const char* type_name() const noexcept;

 private:
  /// Kinds that own memory come last: text and more.
  enum class Kind : std::uint8_t { null, discarded, boolean, integer, natural, real, text, array, object };
  struct Children;
  union Value {
    bool truth;
    std::int64_t integer;
    std::uint64_t natural;
    double real;
    std::string* text;
    Children* children;
  };

  void release() noexcept;
  void addMember(std::string_view name, Json&& value);
  const Json* memberNamed(std::string_view name) const noexcept;
  bool isPair() const noexcept;
  template <class Number>
  Number number() const;

  Kind kind_ = Kind::null;
  Value value_{};
};
// NOLINTEND(readability-identifier-naming)

template <>
bool Json::get<bool>() const;
template <>
int Json::get<int>() const;
template <>
long Json::get<long>() const;
template <>
long long Json::get<long long>() const;
template <>
unsigned Json::get<unsigned>() const;
template <>
unsigned long Json::get<unsigned long>() const;
template <>
unsigned long long Json::get<unsigned long long>() const;
template <>
double Json::get<double>() const;
template <>
std::string Json::get<std::string>() const;
template <>
std::vector<double> Json::get<std::vector<double>>() const;
template <>
std::vector<std::string> Json::get<std::vector<std::string>>() const;

/// Writes JSON as text, on one line if `indent` < 0, and with `ascii_alone` other characters as \u escapes. Bytes that
/// are not UTF-8 (a file may be called anything) become U+FFFD, and numbers that are not finite become null.
std::string jsonDump(const Json& json, int indent = -1, bool ascii_alone = false);

}  // namespace palpate
