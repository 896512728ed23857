// Many examples of one function of a text, as a table.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace palpate::support {

struct Example {
  std::string given, expected;
};

/// `function` makes of each given text what is expected.
template <class Function>
void expectEach(const Function& function, std::initializer_list<Example> examples) {
  for (const auto& [given, expected] : examples) EXPECT_EQ(function(given), expected) << "of " << given;
}

}  // namespace palpate::support
