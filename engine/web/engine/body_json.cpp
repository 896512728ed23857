#include "engine/body_json.h"

#include <fmt/format.h>

#include <string_view>

#include "palpate/body/places.h"

namespace palpate::web {

namespace {

/// Names may come from a user's file. Bytes that are not UTF-8 are left to the reader of the text.
std::string jsonText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string numbers(const Vec3& v) { return fmt::format("[{},{},{}]", v.x(), v.y(), v.z()); }

}  // namespace

std::string landmarksJson(const std::vector<body::SkinLandmark>& landmarks) {
  std::string words;
  for (const body::SkinLandmark& landmark : landmarks) {
    words +=
        fmt::format("{}{{\"name\":{},\"at\":{},\"normal\":{}}}", words.empty() ? "" : ",",
                    jsonText(body::spokenName(landmark.name)), numbers(landmark.position), numbers(landmark.normal));
  }
  return '[' + words + ']';
}

std::string bodyJson(const scene::World& world) {
  std::string notes;
  for (const std::string& note : world.notes) notes += (notes.empty() ? "" : ",") + jsonText(note);
  return fmt::format(R"({{"name":{},"closed":{},"bones":{},"notes":[{}],"landmarks":{}}})", jsonText(world.body->name),
                     world.body->closed, world.body->anatomy.bones.size(), notes,
                     landmarksJson(world.body->anatomy.landmarks));
}

}  // namespace palpate::web
