// PALPATE_DOUBLE -> DoubleControl.
#include <cstdlib>
#include <cstring>
#include <string>

#include "host/tests/device/doubles/double_control.h"

namespace palpate::doubles {

namespace {

/// The number behind "name=" in the text, or what it was.
int numberIn(const char* text, const char* name, int standard) {
  const char* at = std::strstr(text, (std::string(name) + "=").c_str());
  return at == nullptr ? standard : std::atoi(at + std::strlen(name) + 1);
}

}  // namespace

void readSettings(DoubleControl& control) {
  const char* text = std::getenv("PALPATE_DOUBLE");
  if (text == nullptr) return;
  control.count = numberIn(text, "count", control.count);
  control.refusal = static_cast<unsigned>(numberIn(text, "refusal", 0));
  control.major = numberIn(text, "major", control.major);
  control.slow_us = numberIn(text, "slow_us", 0);
}

}  // namespace palpate::doubles
