// Any bytes as a row that came over a network, of each kind: a row that is written and read again as it was, or one
// Error in one line.
#include <cstddef>
#include <cstdint>
#include <string>

#include "palpate/base/error.h"
#include "palpate/training/records/row_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::training;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* kind :
       {"station", "class", "trainee", "protocol", "session", "block", "trial", "event", "delete", "nothing"}) {
    try {
      const AnyRow row = rowFromJson(kind, text);
      const std::string again = rowJson(row);
      if (kindOf(row) != kind || again.find('\n') != std::string::npos) __builtin_trap();
      if (rowJson(rowFromJson(kind, again)) != again || outboxKey(row).size() != 36) __builtin_trap();
    } catch (const palpate::Error& error) {
      if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
  }
  return 0;
}
