// Bytes as text of 64 letters (RFC 4648, section 4): pictures inside pages, buffers inside glTF, rows inside messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palpate {

/// With padding, without line breaks.
std::string base64(std::string_view bytes);
/// Padding may be missing; empty for a letter outside the 64.
std::optional<std::string> bytesOfBase64(std::string_view text);

}  // namespace palpate
