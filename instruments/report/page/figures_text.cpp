#include "report/page/figures_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::study {

namespace {

bool hasParts(const Json& value) { return value.is_object() || value.is_array(); }

bool fitsALine(const Json& value) {
  return !hasParts(value) || value.contains("skipped") || std::none_of(value.begin(), value.end(), hasParts);
}

std::string lineOf(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  if (value.is_string()) return value.text();
  if (!hasParts(value)) return jsonDump(value);
  if (value.contains("skipped")) return value["skipped"].text();
  if (value.empty()) return "none";
  std::string line;
  const auto add = [&](const std::string& part) { line += (line.empty() ? "" : ", ") + part; };
  if (value.is_object()) {
    for (const auto& [name, one] : value.items()) add(name + " " + lineOf(one));
  } else {
    for (const Json& one : value) add(lineOf(one));
  }
  return line;
}

void addLines(const Json& figures, const std::string& indent, std::string& text) {
  for (const auto& [name, value] : figures.items()) {
    text += indent + name + ":";
    if (fitsALine(value)) {
      text += " " + lineOf(value) + "\n";
      continue;
    }
    text += "\n";
    if (value.is_object()) {
      addLines(value, indent + "  ", text);
    } else {
      for (const Json& one : value) text += indent + "  " + lineOf(one) + "\n";
    }
  }
}

}  // namespace

std::string figuresText(const Json& figures) {
  std::string text;
  addLines(figures, "", text);
  return text;
}

}  // namespace palpate::study
