// Scene files as text, for the tests of their keys.
#pragma once

#include <string>

#include "palpate/scene/scene_file.h"
#include "support/error_message.h"

namespace palpate::scene {

/// The smallest scene: everything else has a default.
inline const std::string kFinger = "[[finger]]\nname = \"index\"\nscript = [{ do = \"press\" }]\n";

/// What is said of a scene that cannot be read; "no error" of one that can.
inline std::string messageFor(const std::string& toml) {
  return support::thrownMessage([&] { parse(toml, "s.toml"); });
}
/// The same of a scene with that finger.
inline std::string messageWithFinger(const std::string& toml) { return messageFor(toml + kFinger); }

}  // namespace palpate::scene
