// Any bytes as a table of layered tissue: one that keeps its own rules and is the same when written and read again, or
// one Error that names the file.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/tissue/layered_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::tissue;
  LayeredTable table;
  try {
    table = parseLayeredTable({reinterpret_cast<const char*>(data), size}, "fuzz.json");
  } catch (const palpate::Error& error) {
    const std::string_view said = error.what();
    if (!said.starts_with("fuzz.json") || said.find('\n') != std::string_view::npos) __builtin_trap();
    return 0;
  }
  check(table);
  const std::string written = layeredTableText(table);
  if (layeredTableText(parseLayeredTable(written, "again")) != written) __builtin_trap();
  return 0;
}
