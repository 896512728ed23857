// The parts of C++20's library that Debian's emscripten lacks: its clang 14 has libc++ 13. Included before every file
// of the web build, and of no other; with a newer emscripten it adds nothing.
//
// These names belong to the library, so this is for one known version of it, and lives here instead of in the engine.
#pragma once

#include <version>

#if defined(__EMSCRIPTEN__) && defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace std {  // NOLINT(cert-dcl58-cpp): see above

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>) constexpr To
    bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

/// Decimal numbers as the standard has them, by musl's strtod: nearest double, no locale. Input that strtod accepts
/// beyond the standard (leading blanks, a plus, hexadecimal) is refused before the call.
template <class Real>
requires(is_same_v<Real, double> || is_same_v<Real, float>) from_chars_result
    from_chars(const char* first, const char* last, Real& value) {
  const char* digits = first;
  if (digits != last && *digits == '-') ++digits;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (digits == last || (!is_digit(*digits) && *digits != '.' && !is_letter(*digits)))
    return {first, errc::invalid_argument};
  // The standard reads the 0 of "0x1p3".
  const bool hexadecimal = last - digits >= 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
  const string copy(first, hexadecimal ? digits + 1 : last);
  char* end = nullptr;
  errno = 0;
  const Real read = is_same_v<Real, float> ? static_cast<Real>(strtof(copy.c_str(), &end))
                                           : static_cast<Real>(strtod(copy.c_str(), &end));
  if (end == copy.c_str()) return {first, errc::invalid_argument};
  const char* stop = first + (end - copy.c_str());
  // Too large, or so small that nothing is left of it; what is merely not normal is a number.
  if (errno == ERANGE && (isinf(read) || read == Real{0})) return {stop, errc::result_out_of_range};
  value = read;
  return {stop, errc{}};
}

/// The algorithms that the engine uses, on ranges with a begin() and an end(); nothing dangles, nothing is lazy.
namespace ranges {

struct identity_projection {
  template <class T>
  constexpr T&& operator()(T&& value) const noexcept {
    return std::forward<T>(value);
  }
};
struct less_of_any {
  template <class A, class B>
  constexpr bool operator()(const A& a, const B& b) const {
    return a < b;
  }
};

template <class A, class B>
constexpr bool equal(const A& a, const B& b) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class A, class B>
constexpr auto mismatch(A&& a, B&& b) {
  const auto [first, second] = std::mismatch(std::begin(a), std::end(a), std::begin(b), std::end(b));
  struct Places {
    decltype(std::begin(a)) in1;
    decltype(std::begin(b)) in2;
  };
  return Places{first, second};
}
template <class R, class Predicate>
constexpr bool all_of(const R& range, Predicate holds) {
  for (auto&& value : range) {
    if (!std::invoke(holds, value)) return false;
  }
  return true;
}
template <class R, class Predicate>
constexpr bool any_of(const R& range, Predicate holds) {
  for (auto&& value : range) {
    if (std::invoke(holds, value)) return true;
  }
  return false;
}
template <class R, class T, class Projection = identity_projection>
constexpr auto find(R&& range, const T& wanted, Projection of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& value) { return std::invoke(of, value) == wanted; });
}
template <class R, class Predicate>
constexpr auto find_if(R&& range, Predicate holds) {
  return std::find_if(std::begin(range), std::end(range), [&](auto&& value) { return std::invoke(holds, value); });
}
template <class R, class Less = less_of_any, class Projection = identity_projection>
constexpr auto min_element(R&& range, Less less = {}, Projection of = {}) {
  return std::min_element(std::begin(range), std::end(range),
                          [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class Less = less_of_any, class Projection = identity_projection>
constexpr auto max_element(R&& range, Less less = {}, Projection of = {}) {
  return std::max_element(std::begin(range), std::end(range),
                          [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class T, class Less = less_of_any, class Projection = identity_projection>
constexpr auto upper_bound(R&& range, const T& bound, Less less = {}, Projection of = {}) {
  return std::upper_bound(std::begin(range), std::end(range), bound,
                          [&](const T& a, auto&& b) { return less(a, std::invoke(of, b)); });
}
template <class R, class Less = less_of_any, class Projection = identity_projection>
void sort(R&& range, Less less = {}, Projection of = {}) {
  std::sort(std::begin(range), std::end(range),
            [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class T>
constexpr void replace(R&& range, const T& old_value, const T& new_value) {
  std::replace(std::begin(range), std::end(range), old_value, new_value);
}
template <class R, class Out>
constexpr void copy(const R& range, Out out) {
  std::copy(std::begin(range), std::end(range), out);
}
template <class R, class Out, class F>
constexpr void transform(R&& range, Out out, F change) {
  std::transform(std::begin(range), std::end(range), out, change);
}
template <class A, class B, class Out, class F>
requires requires(const B& b) { std::begin(b); }
constexpr void transform(const A& a, const B& b, Out out, F change) {
  std::transform(std::begin(a), std::end(a), std::begin(b), out, change);
}

}  // namespace ranges

}  // namespace std

#endif
