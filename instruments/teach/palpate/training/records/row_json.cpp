// Each row's fields (row_fields.h) as members of one JSON object; a trial has its visits in it.
#include "palpate/training/records/row_json.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/records/row_fields.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/sha256.h"

namespace palpate::training {

namespace {

struct FieldsToJson {
  Json& object;
  void operator()(const char* name, const std::string& value, const FieldRule& /*rule*/) const { object[name] = value; }
  void operator()(const char* name, std::uint64_t value, const FieldRule& rule) const {
    if (rule.form == FieldRule::Form::seed) {
      object[name] = std::to_string(value);
    } else {
      object[name] = value;
    }
  }
  void operator()(const char* name, const std::optional<double>& value, const FieldRule& /*rule*/) const {
    object[name] = value ? Json(*value) : Json(nullptr);
  }
  template <class Value>
  void operator()(const char* name, const Value& value, const FieldRule& /*rule*/) const {
    if constexpr (std::is_enum_v<Value>) {
      object[name] = wordFor(value);
    } else {
      object[name] = value;
    }
  }
};

template <class R>
Json toJsonObject(const R& row) {
  Json object = Json::object();
  eachField(FieldsToJson{object}, row);
  if constexpr (std::same_as<R, TrialRow>) {
    Json visits = Json::array();
    for (const SiteVisit& visit : row.visits) visits.push_back(toJsonObject(visit));
    object["visits"] = std::move(visits);
  }
  return object;
}

/// Fills a row from an object of a sender.
class FieldsFromJson {
 public:
  FieldsFromJson(const Json& object, std::string_view kind) : object_(object), kind_(kind) {}

  template <class Value>
  void operator()(const char* name, Value& value, const FieldRule& rule) {
    const auto found = object_.find(name);
    if (found == object_.end()) {
      if (rule.isOptional()) return;
      refuse(name, "is missing");
    }
    ++used_;
    read(name, *found, value, rule);
    checkField(kind_, name, value, rule);
  }
  /// Another member than its fields.
  void allowMember(const char* name) { used_ += object_.contains(name) ? 1 : 0; }
  void refuseOthers() const {
    if (used_ != object_.size()) throw Error(fmt::format("{}: has unknown members", kind_));
  }

 private:
  [[noreturn]] void refuse(const char* name, std::string_view why) const {
    throw Error(fmt::format("{}: '{}' {}", kind_, name, why));
  }
  void read(const char* name, const Json& from, std::string& value, const FieldRule& /*rule*/) const {
    if (!from.is_string()) refuse(name, "must be text");
    value = from.get<std::string>();
  }
  void read(const char* name, const Json& from, bool& value, const FieldRule& /*rule*/) const {
    if (!from.is_boolean()) refuse(name, "is neither true nor false");
    value = from.get<bool>();
  }
  void read(const char* name, const Json& from, double& value, const FieldRule& /*rule*/) const {
    if (!from.is_number()) refuse(name, "must be a number");
    value = from.get<double>();
  }
  void read(const char* name, const Json& from, std::optional<double>& value, const FieldRule& rule) const {
    if (from.is_null()) {
      value.reset();
      return;
    }
    read(name, from, value.emplace(), rule);
  }
  void read(const char* name, const Json& from, std::uint64_t& value, const FieldRule& rule) const {
    if (rule.form != FieldRule::Form::seed) {
      value = static_cast<std::uint64_t>(whole(name, from, rule));
      return;
    }
    if (!from.is_string()) refuse(name, "must be text");
    const auto& digits = from.text();
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) refuse(name, "must be a number of 64 bits");
  }
  template <class Value>
  void read(const char* name, const Json& from, Value& value, const FieldRule& rule) const {
    if constexpr (std::is_enum_v<Value>) {
      const auto named = from.is_string() ? valueNamed<Value>(from.text()) : std::nullopt;
      if (!named) refuse(name, "is not one of its words");
      value = *named;
    } else {
      value = static_cast<Value>(whole(name, from, rule));
    }
  }
  /// Checks the value before it is narrowed.
  std::int64_t whole(const char* name, const Json& from, const FieldRule& rule) const {
    if (!from.is_number_integer()) refuse(name, "must be a whole number");
    const bool in_range = from.is_number_unsigned() ? static_cast<double>(from.get<std::uint64_t>()) <= rule.high
                                                    : static_cast<double>(from.get<std::int64_t>()) >= rule.low;
    if (!in_range) {
      refuse(name, fmt::format("is {}, not within {} to {}", jsonDump(from), rule.low, rule.high));
    }
    return from.get<std::int64_t>();
  }

  const Json& object_;
  std::string_view kind_;
  std::size_t used_ = 0;
};

template <class R>
R rowOfObject(std::string_view kind, const Json& object) {
  if (!object.is_object()) throw Error(fmt::format("{}: must be a JSON object", kind));
  R row;
  FieldsFromJson fields(object, kind);
  eachField(fields, row);
  if constexpr (std::same_as<R, TrialRow>) {
    fields.allowMember("visits");
    const auto visits = object.find("visits");
    if (visits == object.end() || !visits->is_array()) throw Error("trial: 'visits' must be a list");
    for (const Json& visit : *visits) row.visits.push_back(rowOfObject<SiteVisit>("visit", visit));
  }
  fields.refuseOthers();
  return row;
}

/// Before it is parsed: a text can be made so that parsing it takes all memory there is.
Json parsedRow(std::string_view kind, std::string_view text) {
  if (text.size() > kLongestRowJson) {
    throw Error(fmt::format("{}: {} bytes, more than {}", oneLine(kind), text.size(), kLongestRowJson));
  }
  Json object = Json::tryParse(text);
  if (object.is_discarded()) throw Error(fmt::format("{}: is not JSON", oneLine(kind)));
  return object;
}

template <std::size_t I = 0>
AnyRow rowOfKind(std::string_view kind, std::string_view text) {
  if constexpr (I == std::variant_size_v<AnyRow>) {
    throw Error(fmt::format("'{}' is not a kind of row", oneLine(kind)));
  } else {
    using R = std::variant_alternative_t<I, AnyRow>;
    if (kindOf(AnyRow(std::in_place_index<I>)) != kind) return rowOfKind<I + 1>(kind, text);
    return rowOfObject<R>(kind, parsedRow(kind, text));
  }
}

}  // namespace

AnyRow anyRow(const Row& row) {
  return std::visit([](const auto& held) { return AnyRow(held); }, row);
}

std::string_view kindOf(const AnyRow& row) {
  constexpr std::array<std::string_view, std::variant_size_v<AnyRow>> kKinds = {
      "station", "class", "trainee", "protocol", "session", "block", "trial", "event", "delete"};
  return kKinds[row.index()];
}

std::string rowId(const AnyRow& row) {
  if (const auto* protocol = std::get_if<ProtocolRow>(&row)) {
    return fmt::format("{}@{}", protocol->id, protocol->version);
  }
  if (const auto* deletion = std::get_if<DeletionRow>(&row)) return deletion->trainee_sha256;
  return std::visit(
      [](const auto& held) -> std::string {
        if constexpr (requires { held.id; }) {
          return held.id;
        } else {
          return {};
        }
      },
      row);
}

std::string rowJson(const AnyRow& row) {
  const Json object = std::visit([](const auto& held) { return toJsonObject(held); }, row);
  return jsonDump(object);
}

std::string rowJson(const Row& row) { return rowJson(anyRow(row)); }

AnyRow rowFromJson(std::string_view kind, std::string_view text) { return rowOfKind(kind, text); }

Uuid outboxKey(const AnyRow& row) {
  if (std::holds_alternative<TrialRow>(row) || std::holds_alternative<EventRow>(row)) return rowId(row);
  return uuidOfText(fmt::format("{}\n{}", kindOf(row), rowJson(row)));
}

std::string deletedMark(std::string_view id) { return sha256Hex(fmt::format("palpate deleted\n{}", id)); }

}  // namespace palpate::training
