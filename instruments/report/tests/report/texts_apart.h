// A figure that can be read: no text covers another.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "report/charts/figure.h"

namespace palpate::study {

inline void expectTextsApart(const figures::Figure& figure, const std::string& name) {
  const auto texts = figures::collectDrawnTexts(figure);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t j = i + 1; j < texts.size(); ++j) {
      const auto& a = texts[i];
      const auto& b = texts[j];
      const bool apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
      EXPECT_TRUE(apart) << name << ": " << a.text << " covers " << b.text;
    }
  }
}

}  // namespace palpate::study
