// Files by the pattern POINT_DRAG_N_part, or as listed -> hash -> kept or measured -> measured.toml.
#include "palpate/measure/person/person_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/toml_node.h"

namespace palpate::measure {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMeasuredBytes = std::size_t{16} << 20;
constexpr std::uint64_t kMaxPictureBytes = std::uint64_t{256} << 20;
constexpr std::array<std::string_view, 5> kPictureExtensions = {".jpg", ".jpeg", ".png", ".tif", ".tiff"};

// --- pictures

bool isPicture(const fs::path& file) {
  return std::ranges::find(kPictureExtensions, inSmallLetters(file.extension().string())) != kPictureExtensions.end();
}

/// Pictures by the name "press_part" in lower case: of the folder by their stem, but for our own overlays, and of a
/// folder that is called as a press, "before" and the like.
std::map<std::string, fs::path> picturesIn(const fs::path& folder) {
  constexpr std::array<std::string_view, 4> kParts = {"before", "before2", "after", "released"};
  std::map<std::string, fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string stem = inSmallLetters(entry.path().stem().string());
    if (isPicture(entry.path()) && !stem.ends_with("_overlay")) found.emplace(stem, entry.path());
    if (!entry.is_directory(error)) continue;
    for (const fs::directory_entry& inner : fs::directory_iterator(entry.path(), error)) {
      const std::string part = inSmallLetters(inner.path().stem().string());
      if (!isPicture(inner.path()) || std::ranges::find(kParts, part) == kParts.end()) continue;
      found.emplace(inSmallLetters(entry.path().filename().string()) + "_" + part, inner.path());
    }
  }
  if (error) throw Error::inFile(folder.string(), error.message());
  return found;
}

/// Takes its pictures out of `found`: the rest are strangers.
PressPictures extractPictures(const fs::path& folder, const Protocol& protocol, const std::string& press,
                              std::map<std::string, fs::path>& found) {
  const auto listed = std::ranges::find(protocol.pictures, press, &ListedPictures::press);
  const bool is_listed = listed != protocol.pictures.end();
  const auto place = [&](const char* part, const std::string& name) -> fs::path {
    if (is_listed && !name.empty()) {
      const fs::path file = folder / name;  // an absolute name stays one
      std::erase_if(found, [&](const auto& entry) { return entry.second == file; });
      return fs::exists(file) ? file : fs::path();
    }
    const auto by_pattern = found.extract(inSmallLetters(fmt::format("{}_{}", press, part)));
    return by_pattern.empty() ? fs::path() : by_pattern.mapped();
  };
  const ListedPictures none;
  const ListedPictures& names = is_listed ? *listed : none;
  return {place("before", names.before), place("before2", names.before2), place("after", names.after),
          place("released", names.released), names.contact_px};
}

std::vector<std::string> findMissingPictures(const std::string& press, const PressPictures& pictures) {
  std::vector<std::string> missing;
  if (pictures.before.empty()) missing.push_back(press + "_before");
  if (pictures.after.empty()) missing.push_back(press + "_after");
  return missing;
}

// --- changes

void addText(Hash& hash, std::string_view text) {
  for (const char c : text) hash.add(std::uint64_t{static_cast<unsigned char>(c)});
}

/// Eight bytes at a time: a picture is some megabytes.
void addFile(Hash& hash, const fs::path& file) {
  if (file.empty()) return hash.add(std::uint64_t{0});
  const std::string bytes = readFile(file, kMaxPictureBytes);
  hash.add(std::uint64_t{bytes.size()});
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t k = i; k < std::min(i + 8, bytes.size()); ++k) {
      word = (word << 8) | static_cast<unsigned char>(bytes[k]);
    }
    hash.add(word);
  }
}

/// Hash of the pictures and of all that the measurement depends on.
std::string hashOf(const Protocol& protocol, const PlannedPress& planned, const PressPictures& pictures) {
  Hash hash;
  addFile(hash, pictures.before);
  addFile(hash, pictures.before2);
  addFile(hash, pictures.after);
  hash.add(protocol.spacing_mm);
  hash.add(protocol.drift_mm);
  hash.add(static_cast<std::uint64_t>(protocol.head));
  hash.add(std::uint64_t{protocol.partial ? 1U : 0U});
  hash.add(planned.place_mm.x());
  hash.add(planned.place_mm.y());
  addText(hash, planned.point);
  if (pictures.contact_px) {
    hash.add(pictures.contact_px->x());
    hash.add(pictures.contact_px->y());
  }
  return fmt::format("{:016x}", hash.value());
}

// --- measured.toml

struct Kept {
  std::string hash;
  PressOutcome outcome;
  Decision decision = Decision::none;
};
using KeptPresses = std::map<std::string, Kept, std::less<>>;

constexpr std::array<std::string_view, 3> kDecisionWords = {"", "accept", "repeat"};

std::vector<std::string> linesOf(const scene::TomlNode& table, const char* key) {
  std::vector<std::string> lines;
  const scene::TomlNode* node = table.get(key);
  if (node == nullptr || node->list() == nullptr) return lines;
  for (const scene::TomlNode& line : *node->list()) lines.push_back(line.text().value_or(""));
  return lines;
}

/// Empty where it is missing or no text.
std::string textOf(const scene::TomlNode& table, const char* key) {
  const scene::TomlNode* node = table.get(key);
  return node == nullptr ? std::string() : node->text().value_or("");
}

KeptPresses readKept(const fs::path& file) {
  KeptPresses kept;
  if (!fs::exists(file)) return kept;
  const std::string text = readFile(file, kMaxMeasuredBytes);
  scene::TomlNode root;
  try {
    root = scene::parseToml(text, file.string());
  } catch (const Error& error) {
    throw Error::atLine(file.string(), error.line(),
                        "is not a record of measurements; delete it to measure everything again");
  }
  const scene::TomlNode* presses = root.get("press");
  if (presses == nullptr || presses->list() == nullptr) return kept;
  for (const scene::TomlNode& table : *presses->list()) {
    if (!table.isTable()) continue;
    Kept one{.hash = textOf(table, "hash"), .outcome = {}};
    if (const scene::TomlNode* accepted = table.get("accepted"))
      one.outcome.accepted = accepted->flag().value_or(false);
    one.outcome.row = textOf(table, "row");
    one.outcome.refusals = linesOf(table, "refusals");
    one.outcome.warnings = linesOf(table, "warnings");
    if (const scene::TomlNode* drift = table.get("null_drift_mm")) one.outcome.null_drift_mm = drift->number();
    const auto word = std::ranges::find(kDecisionWords, textOf(table, "decision"));
    if (word != kDecisionWords.end()) one.decision = static_cast<Decision>(word - kDecisionWords.begin());
    kept.insert_or_assign(textOf(table, "name"), std::move(one));
  }
  return kept;
}

/// A TOML string of one line.
std::string tomlString(std::string_view text) {
  std::string out = "\"";
  for (const char c : oneLine(text, 4000)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string tomlList(const std::vector<std::string>& lines) {
  std::string out = "[";
  for (const std::string& line : lines) out += fmt::format("{}{}", out.size() > 1 ? ", " : "", tomlString(line));
  return out + "]";
}

void writeKept(const fs::path& file, const KeptPresses& kept) {
  std::string text = "# What each press gave, and what was decided: written by palpate measure session.\n";
  for (const auto& [name, one] : kept) {
    text += fmt::format("\n[[press]]\nname = {}\nhash = \"{}\"\naccepted = {}\ndecision = \"{}\"\nrow = {}\n",
                        tomlString(name), one.hash, one.outcome.accepted,
                        kDecisionWords.at(static_cast<std::size_t>(one.decision)), tomlString(one.outcome.row));
    if (one.outcome.null_drift_mm) text += fmt::format("null_drift_mm = {:.6f}\n", *one.outcome.null_drift_mm);
    text +=
        fmt::format("refusals = {}\nwarnings = {}\n", tomlList(one.outcome.refusals), tomlList(one.outcome.warnings));
  }
  writeFile(file, text);
}

// --- the walk

void decide(KeptPresses& kept, const std::vector<WalkedPress>& presses, const std::vector<std::string>& names,
            Decision decision) {
  for (const std::string& name : names) {
    std::vector<std::string> known;
    for (const WalkedPress& press : presses) known.push_back(press.planned.name);
    if (std::ranges::find(known, name) == known.end()) throw Error(unknownName("press", name, "", known));
    const auto found = kept.find(name);
    const bool current = std::ranges::any_of(
        presses, [&](const WalkedPress& press) { return press.planned.name == name && press.outcome.has_value(); });
    if (found == kept.end() || !current)
      throw Error(fmt::format("{} was not measured; its pictures are missing", name));
    if (decision == Decision::accept && found->second.outcome.row.empty()) {
      throw Error(fmt::format("{} gave no ellipse that could be accepted; repeat it", name));
    }
    found->second.decision = decision;
  }
}

}  // namespace

bool WalkedPress::counts() const {
  if (!outcome || outcome->row.empty() || decision == Decision::repeat) return false;
  return outcome->accepted || decision == Decision::accept;
}

std::vector<PointProgress> PersonWalk::progress() const {
  std::vector<PointProgress> all;
  for (const ProtocolPoint& point : protocol.points) {
    for (const ProtocolDrag& drag : protocol.drags) {
      PointProgress one{point.name, drag.word, 0, protocol.enough};
      for (const WalkedPress& press : presses) {
        const bool mine = press.planned.point == point.name && press.planned.drag_deg == drag.degrees;
        one.counting += mine && press.counts() ? 1 : 0;
      }
      all.push_back(std::move(one));
    }
  }
  return all;
}

bool PersonWalk::complete() const {
  return std::ranges::all_of(progress(), [](const PointProgress& one) { return one.counting >= one.enough; });
}

PersonWalk walkPerson(const fs::path& folder, const MeasurePress& measure_press, const WalkDecisions& decisions,
                      const Progress& progress) {
  PersonWalk walk{.folder = folder, .protocol = readProtocol(folder / kProtocolFile), .presses = {}};
  const fs::path record = folder / kMeasuredFile;
  KeptPresses kept = readKept(record);
  std::map<std::string, fs::path> found = picturesIn(folder);
  const std::vector<PlannedPress> planned = plannedPresses(walk.protocol);
  for (const PlannedPress& press : planned) {
    report(progress, press.name, static_cast<double>(walk.presses.size()) / static_cast<double>(planned.size()));
    WalkedPress walked{.planned = press, .pictures = extractPictures(folder, walk.protocol, press.name, found)};
    walked.missing = findMissingPictures(press.name, walked.pictures);
    if (walked.missing.empty()) {
      const std::string hash = hashOf(walk.protocol, press, walked.pictures);
      const auto known = kept.find(press.name);
      walked.fresh = known == kept.end() || known->second.hash != hash;
      if (walked.fresh) {
        kept.insert_or_assign(press.name, Kept{hash, measure_press(walk.protocol, press, walked.pictures, progress)});
        writeKept(record, kept);
      }
      walked.outcome = kept.at(press.name).outcome;
    }
    walk.presses.push_back(std::move(walked));
  }
  for (const auto& [stem, file] : found) walk.strangers.push_back(file.filename().string());
  decide(kept, walk.presses, decisions.accept, Decision::accept);
  decide(kept, walk.presses, decisions.repeat, Decision::repeat);
  if (!decisions.accept.empty() || !decisions.repeat.empty()) writeKept(record, kept);
  for (WalkedPress& press : walk.presses) {
    if (press.outcome) press.decision = kept.at(press.planned.name).decision;
  }
  return walk;
}

}  // namespace palpate::measure
