// Recognises pictures other than JPEG, PNG and TIFF by their first bytes, so that the message can name them.
#include <algorithm>
#include <array>
#include <string_view>

#include "palpate/measure/pictures/picture_header.h"

namespace palpate::measure {

namespace {

struct Signature {
  std::size_t at;
  std::string_view bytes;
  std::string_view words;
};

constexpr std::array kSignatures = {
    Signature{8, "CR\x02", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{0, "FUJIFILMCCD-RAW", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{0, "IIRO", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{0, "IIRS", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{0, "IIU", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{4, "ftypcrx", "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF"},
    Signature{4, "ftypavi", "is an AVIF picture; save it as JPEG, PNG or TIFF"},
    Signature{4, "ftyphe", "is a HEIC picture; save it as JPEG, PNG or TIFF (phones: camera format 'most compatible')"},
    Signature{4, "ftypmif1",
              "is a HEIC picture; save it as JPEG, PNG or TIFF (phones: camera format 'most compatible')"},
    Signature{4, "ftypmsf1", "is an animated HEIC sequence; save one picture of it as JPEG, PNG or TIFF"},
    Signature{4, "ftyp", "is a film; save single pictures of it as JPEG, PNG or TIFF"},
    Signature{0, "BM", "is a BMP picture; save it as JPEG, PNG or TIFF"},
    Signature{0, "%PDF", "is a PDF document; save its picture as JPEG, PNG or TIFF"},
    Signature{0, std::string_view("\0\0\0\x0cjP", 6), "is a JPEG 2000 picture; save it as JPEG, PNG or TIFF"},
    Signature{0, "\xff\x4f\xff\x51", "is a JPEG 2000 picture; save it as JPEG, PNG or TIFF"},
    Signature{0, "II+", "is a BigTIFF file; save it as an ordinary TIFF, JPEG or PNG"},
    Signature{0, std::string_view("MM\0+", 4), "is a BigTIFF file; save it as an ordinary TIFF, JPEG or PNG"},
};

std::string_view gifOrWebp(std::string_view bytes) {
  if (bytes.starts_with("GIF8")) {
    // Its film is announced by this extension; a still picture has none.
    return bytes.find("NETSCAPE2.0") != std::string_view::npos
               ? "is an animated GIF; save one picture of it as JPEG, PNG or TIFF"
               : "is a GIF, which has too few colours; save the photograph itself as JPEG, PNG or TIFF";
  }
  if (bytes.starts_with("RIFF") && bytes.substr(std::min<std::size_t>(8, bytes.size())).starts_with("WEBP")) {
    constexpr std::size_t kFlagsAt = 20;  // offset in the chunk VP8X
    const bool is_animated = bytes.size() > kFlagsAt && bytes.substr(12, 4) == "VP8X" && (bytes[kFlagsAt] & 0x02) != 0;
    return is_animated ? "is an animated WebP; save one picture of it as JPEG, PNG or TIFF"
                       : "is a WebP picture; save it as JPEG, PNG or TIFF";
  }
  return {};
}

}  // namespace

std::string_view foreignPicture(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  if (const std::string_view words = gifOrWebp(bytes); !words.empty()) return words;
  for (const Signature& signature : kSignatures) {
    if (bytes.size() > signature.at && bytes.substr(signature.at).starts_with(signature.bytes)) return signature.words;
  }
  const std::string_view start = bytes.substr(0, 512);
  const bool is_text = std::none_of(start.begin(), start.end(), [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte < 0x09 || (byte > 0x0d && byte < 0x20);
  });
  return is_text ? "is text, not a picture, despite its name; expected a JPEG, PNG or TIFF"
                 : "is not a JPEG, PNG or TIFF";
}

}  // namespace palpate::measure
