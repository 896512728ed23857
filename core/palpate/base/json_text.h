// The one way in which JSON becomes text. It knows no JSON library: whoever writes JSON brings the value.
#pragma once

#include <string>

namespace palpate {

/// What nlohmann::json or its ordered kind writes as; `indent` < 0: one line. Bytes that are no UTF-8 - a file may be
/// called anything - become U+FFFD, where plain dump() throws.
template <class Json>
std::string jsonDump(const Json& json, int indent = -1, bool ascii_alone = false) {
  return json.dump(indent, ' ', ascii_alone, Json::error_handler_t::replace);
}

}  // namespace palpate
