// Written by hand: a page of JSON is no reason for a library of it.
#include "engine/body_words.h"

#include <fmt/format.h>

#include "palpate/body/places.h"

namespace palpate::web {

namespace {

/// Names may come from a stranger's file. Bytes that are no UTF-8 are left to who reads the text.
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

std::string bodyInWords(const scene::World& world) {
  std::string notes;
  for (const std::string& note : world.notes) notes += (notes.empty() ? "" : ",") + jsonText(note);
  std::string landmarks;
  for (const body::SkinLandmark& landmark : world.body->anatomy.landmarks) {
    landmarks +=
        fmt::format("{}{{\"name\":{},\"at\":{},\"normal\":{}}}", landmarks.empty() ? "" : ",",
                    jsonText(body::spokenName(landmark.name)), numbers(landmark.position), numbers(landmark.normal));
  }
  return fmt::format(R"({{"name":{},"closed":{},"bones":{},"notes":[{}],"landmarks":[{}]}})", jsonText(world.body->name),
                     world.body->closed, world.body->anatomy.bones.size(), notes, landmarks);
}

}  // namespace palpate::web
