// Strict: an unknown key, a value that is not a number or out of range, or a word too many make a message invalid.
#include "cli/serve/messages.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "palpate/base/json.h"
#include "palpate/contact/pressure_field.h"

namespace palpate::app::serving {

namespace {

/// Reads members of one object and remembers the first error.
class Members {
 public:
  Members(const Json& json, std::string& why) : json_(json), why_(why) {}

  bool only(std::initializer_list<std::string_view> names) {
    for (const auto& [name, value] : json_.items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) return fail("an unknown member");
    }
    return true;
  }
  double number(const char* name, double least, double most) {
    const auto member = json_.find(name);
    if (member == json_.end() || !member->is_number()) return fail(std::string(name) + " must be a number"), 0.0;
    const auto value = member->get<double>();
    if (!(value >= least && value <= most)) fail(std::string(name) + " is out of range");
    return value;
  }
  std::size_t count(const char* name, std::size_t most) {
    const auto member = json_.find(name);
    const bool whole = member != json_.end() && member->is_number_unsigned();
    if (!whole || member->get<std::uint64_t>() > most) return fail(std::string(name) + " is out of range"), 0;
    return member->get<std::size_t>();
  }
  bool truth(const char* name) {
    const auto member = json_.find(name);
    if (member == json_.end() || !member->is_boolean()) return fail(std::string(name) + " is not true or false");
    return member->get<bool>();
  }
  Vec3 place(const char* name) {
    const auto member = json_.find(name);
    Vec3 value = Vec3::Zero();
    if (member == json_.end() || !member->is_array() || member->size() != 3) {
      return fail(std::string(name) + " is not three numbers"), value;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Json& number = (*member)[axis];
      const double coordinate = number.is_number() ? number.get<double>() : 2.0 * kFarthestPlaceMm;
      if (!(std::abs(coordinate) <= kFarthestPlaceMm)) return fail(std::string(name) + " is out of range"), value;
      value[static_cast<Eigen::Index>(axis)] = coordinate;
    }
    return value;
  }
  bool has(const char* name) const { return json_.contains(name); }
  bool fail(const std::string& why) {
    if (why_.empty()) why_ = why;
    return false;
  }

 private:
  const Json& json_;
  std::string& why_;
};

constexpr std::size_t kMaxFingers = 64;

Request parsePoint(Members& members) {
  Point point;
  members.only({"type", "finger", "pressed", "place", "normal", "depth_mm", "force_n"});
  point.finger = members.count("finger", kMaxFingers);
  point.pressed = members.truth("pressed");
  point.place = members.place("place");
  point.normal = members.place("normal");
  if (members.has("force_n")) point.force_n = members.number("force_n", 0.0, kStrongestN);
  if (members.has("depth_mm") || !point.force_n) point.depth_mm = members.number("depth_mm", 0.0, kDeepestMm);
  const double length = point.normal.norm();
  if (!(length > 0.5 && length < 2.0)) members.fail("normal has no length");
  point.normal /= length > 0.0 ? length : 1.0;
  return point;
}

Request parseSay(const Json& json, Members& members) {
  members.only({"type", "text"});
  const auto text = json.find("text");
  if (text == json.end() || !text->is_string()) return members.fail("text must be text"), Say{};
  Say say{text->get<std::string>()};
  if (say.words.size() > kMaxWords) members.fail("text is too long");
  std::replace_if(
      say.words.begin(), say.words.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      ' ');
  return say;
}

Request parseListen(Members& members) {
  Listen listen;
  members.only({"type", "on", "pad", "pad_mm"});
  listen.on = members.truth("on");
  if (members.has("pad")) listen.pad = members.count("pad", contact::kMaxTaxels);
  if (members.has("pad_mm")) listen.pad_mm = members.number("pad_mm", 1.0, 100.0);
  if (listen.pad != 0 && listen.pad < contact::kMinTaxels) members.fail("pad is out of range");
  return listen;
}

}  // namespace

std::optional<Request> parseRequest(std::string_view message, std::string& why) {
  why.clear();
  if (message.size() > kMaxRequestBytes) return why = "too long", std::nullopt;
  const Json json = Json::tryParse(message);
  if (!json.is_object()) return why = "no JSON object", std::nullopt;
  const auto type = json.find("type");
  if (type == json.end() || !type->is_string()) return why = "type is missing", std::nullopt;
  const auto word = type->get<std::string>();
  Members members(json, why);
  Request request;
  if (word == "finger") {
    request = parsePoint(members);
  } else if (word == "lift") {
    members.only({"type", "finger"});
    request = Lift{members.count("finger", kMaxFingers)};
  } else if (word == "take" || word == "give") {
    members.only({"type"});
    request = word == "take" ? Request(Take{}) : Request(Give{});
  } else if (word == "pause") {
    members.only({"type", "on"});
    request = Pause{members.truth("on")};
  } else if (word == "touch") {
    request = parseListen(members);
  } else if (word == "message") {
    request = parseSay(json, members);
  } else {
    why = "an unknown type";
  }
  if (!why.empty()) return std::nullopt;
  return request;
}

}  // namespace palpate::app::serving
