// Any bytes as a scene file: settings or one Error, nothing else.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    palpate::scene::parse({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const palpate::Error& error) {
    // A message is one line, whatever the file holds.
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
