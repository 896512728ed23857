// Whether findings say something: verdicts are looked for by their words.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::study {

inline testing::AssertionResult says(const std::vector<std::string>& findings, std::string_view words) {
  const bool found = std::any_of(findings.begin(), findings.end(),
                                 [&](const std::string& one) { return one.find(words) != std::string::npos; });
  if (found) return testing::AssertionSuccess() << "said: " << words;
  std::string all;
  for (const std::string& one : findings) all += "\n- " + one;
  return testing::AssertionFailure() << "not said: " << words << all;
}

}  // namespace palpate::study
