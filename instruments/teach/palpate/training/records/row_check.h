// Whether a value is what its column may hold (FieldRule); the same for rows of our own and for those of a network.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/training/records/row_fields.h"

namespace palpate::training {

// Throw Error: "trial: 'change' is 7, not within 0 to 1".
void checkField(std::string_view kind, std::string_view name, const std::string& value, const FieldRule& rule);
void checkField(std::string_view kind, std::string_view name, double value, const FieldRule& rule);

inline void checkField(std::string_view kind, std::string_view name, const std::optional<double>& value,
                       const FieldRule& rule) {
  if (value) checkField(kind, name, *value, rule);
}
template <class Value>
void checkField(std::string_view kind, std::string_view name, const Value& value, const FieldRule& rule) {
  if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
    if (rule.form != FieldRule::Form::seed) checkField(kind, name, static_cast<double>(value), rule);
  }
}

bool isUuid(std::string_view text);
/// SHA-256 as 64 lower-case hex digits.
bool isHash(std::string_view text);

/// Every field of a row. Throws Error for the first that is wrong.
template <class R>
void checkRow(std::string_view kind, const R& row) {
  eachField([kind](const char* name, const auto& value, const FieldRule& rule) { checkField(kind, name, value, rule); },
            row);
  if constexpr (std::is_same_v<R, TrialRow>) {
    for (const SiteVisit& visit : row.visits) checkRow("visit", visit);
  }
}

}  // namespace palpate::training
