// The numbers of a struct by name, described once: checks, recordings, C and Python go by the same list.
//
//   constexpr std::array kFields = {field<Settings, &Settings::radius_mm>("radius_mm", {0.0, 1000.0}),
//                                   field<Settings, &Settings::inner, &Inner::share>("share")};
#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "palpate/base/number_range.h"

namespace palpate {

/// One number of a `Struct`; true and false are 1 and 0.
template <class Struct>
struct Field {
  std::string_view name;
  double (*get)(const Struct&) = nullptr;
  void (*set)(Struct&, double) = nullptr;
  NumberRange range = {};
  bool is_flag = false;
};

/// `Path`: pointers to members, from the struct to a number or flag in it.
template <class Struct, auto... Path>
constexpr Field<Struct> field(std::string_view name, NumberRange range = {}) {
  using Value = std::remove_cvref_t<decltype((std::declval<Struct&>().*....*Path))>;
  return {.name = name,
          .get = [](const Struct& from) { return static_cast<double>((from.*....*Path)); },
          .set =
              [](Struct& to, double value) {
                if constexpr (std::is_same_v<Value, bool>) {
                  (to.*....*Path) = value != 0.0;
                } else {
                  (to.*....*Path) = static_cast<Value>(value);
                }
              },
          .range = range,
          .is_flag = std::is_same_v<Value, bool>};
}

}  // namespace palpate
