// A protocol as a TOML file: read key by key, written with explanations. Changes are in per cent there.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"
#include "palpate/scene/detail/toml_table.h"
#include "palpate/training/protocol.h"
#include "palpate/training/sha256.h"

namespace palpate::training {

namespace {

using scene::TomlList;
using scene::TomlNode;
using scene::TomlTable;

constexpr std::size_t kMaxProtocolBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestProtocolId = 32;
constexpr int kMaxTrials = 1000;

struct NamedSession {
  const char* table;
  SessionSettings Protocol::*settings;
  const char* what;
};
constexpr std::array kSessions = {
    NamedSession{"practice", &Protocol::practice, "feedback after each answer; the true site can be felt"},
    NamedSession{"mastery", &Protocol::mastery, "three of four right leads to the next level"},
    NamedSession{"pre_test", &Protocol::pre_test, "measures the threshold; no feedback"},
    NamedSession{"post_test", &Protocol::post_test, "the same afterwards"},
    NamedSession{"exam", &Protocol::exam, "pass, not yet or repeat"},
    NamedSession{"retention", &Protocol::retention, "the same a week later"},
};

/// Reads a number that is in per cent in the file and a share inside.
void readPercent(const TomlTable& table, const char* key, double& share, const NumberRange& percent) {
  double value = 100.0 * share;
  table.read(key, value, percent);
  if (table.node(key) != nullptr) share = value / 100.0;
}

template <class Value>
void readWord(const TomlTable& table, const char* key, Value& value) {
  std::string word(wordFor(value));
  table.read(key, word);
  const auto named = valueNamed<Value>(word);
  if (!named) table.fail(*table.node(key), unknownName(key, word, "a protocol", wordList<Value>()));
  value = *named;
}

void readLevels(const TomlTable& table, BlockSettings& block) {
  const TomlNode* node = table.node("levels_percent");
  if (node == nullptr) return;
  const TomlList* list = node->list();
  if (list == nullptr) table.fail(*node, "levels_percent must be a list of numbers");
  block.levels.clear();
  for (const TomlNode& one : *list) {
    const auto percent = one.number();
    if (!percent || !(*percent > 0.0 && *percent <= 100.0)) {
      table.fail(one, "a level is a number above 0 and at most 100");
    }
    block.levels.push_back(*percent / 100.0);
  }
  std::ranges::sort(block.levels);
}

SessionSettings sessionFrom(const TomlNode& keys, std::string_view file, std::string_view name,
                            SessionSettings settings) {
  const TomlTable table(
      keys, file, fmt::format("[{}]", name),
      {"method", "meaning", "levels_percent", "start_percent", "draw", "warm_up", "easy", "easy_share_percent", "least",
       "most", "half_width", "mark_percent", "sure_percent", "feedback", "limit_s", "all_sites", "natural_stiffness"});
  BlockSettings& block = settings.block;
  readWord(table, "method", block.method);
  readWord(table, "meaning", block.meaning);
  readLevels(table, block);
  readPercent(table, "start_percent", block.start, {0.0, 100.0, true});
  readWord(table, "draw", block.draw);
  table.read("warm_up", block.warm_up, {0, kMaxTrials});
  table.read("easy", block.easy, {0, kMaxTrials});
  readPercent(table, "easy_share_percent", block.easy_share, {0.0, 50.0});
  table.read("least", block.stop.least, {1, kMaxTrials});
  table.read("most", block.stop.most, {1, kMaxTrials});
  table.read("half_width", block.stop.half_width, {0.0, 3.0});
  readPercent(table, "mark_percent", block.stop.mark, {0.0, 100.0});
  readPercent(table, "sure_percent", block.stop.sure, {50.0, 99.99});
  table.read("feedback", settings.feedback);
  table.read("limit_s", settings.limit_s, {0.0, 3600.0});
  table.read("all_sites", settings.all_sites);
  table.read("natural_stiffness", settings.natural_stiffness);
  try {
    static_cast<void>(Block(block, 1));
  } catch (const Error& error) {
    table.fail(error.what());
  }
  return settings;
}

std::vector<std::string> sitesFrom(const TomlTable& table) {
  std::vector<std::string> sites;
  const TomlNode* node = table.node("sites");
  if (node == nullptr) return sites;
  const TomlList* list = node->list();
  if (list == nullptr)
    table.fail(*node, "sites must be a list of places such as [\"T6 left 30 mm\", \"T6 right 30 mm\"]");
  for (const TomlNode& one : *list) {
    const auto words = one.text();
    if (!words || words->empty()) table.fail(one, "a site is a place in words, such as \"T6 left 30 mm\"");
    sites.push_back(*words);
  }
  if (sites.size() == 1) table.fail(*node, "one site alone leaves nothing to choose");
  return sites;
}

const TomlNode* tableNamed(const TomlNode& root, const char* name, std::string_view file) {
  const TomlNode* node = root.get(name);
  if (node == nullptr) return nullptr;
  if (!node->isTable()) {
    throw Error::atLine(file, node->line(), fmt::format("{0} must be a table, written as [{0}]", name));
  }
  return node;
}

void readHidden(const TomlNode& root, std::string_view file, HiddenPlace& hidden) {
  const TomlNode* keys = tableNamed(root, "hidden", file);
  if (keys == nullptr) return;
  const TomlTable table(*keys, file, "[hidden]", {"radius_mm", "edge_softness", "depth_mm", "bony_displacement_mm"});
  table.read("radius_mm", hidden.radius_mm, {5.0, 100.0});
  table.read("edge_softness", hidden.edge_softness, {0.0, 1.0});
  table.read("depth_mm", hidden.depth_mm, {0.0, 50.0});
  table.read("bony_displacement_mm", hidden.bony_displacement_mm, {-15.0, 15.0});
}

void readExploration(const TomlNode& root, std::string_view file, ExplorationSettings& exploration) {
  const TomlNode* keys = tableNamed(root, "exploration", file);
  if (keys == nullptr) return;
  const TomlTable table(*keys, file, "[exploration]", {"force_n", "dwell_s", "radius_mm"});
  table.read("force_n", exploration.force_n, {0.05, 10.0});
  table.read("dwell_s", exploration.dwell_s, {0.0, 10.0});
  table.read("radius_mm", exploration.radius_mm, {5.0, 50.0});
}

// --- lumps

/// As in scene files, but a diameter is that of a node and not of an organ, and lumps are harder than tissue.
constexpr NumberRange kLumpDiameters{2.0, 25.0};
constexpr NumberRange kLumpDepths{2.5, 40.0};
constexpr NumberRange kLumpRatios{1.2, 1000.0};
constexpr int kMaxBodies = 200;

void readGrades(const TomlTable& table, const char* key, lumps::Grades& grades, const NumberRange& range) {
  const TomlNode* node = table.node(key);
  if (node == nullptr) return;
  const TomlList* list = node->list();
  if (list == nullptr || list->size() != grades.size()) table.fail(*node, fmt::format("{} must be three numbers", key));
  for (std::size_t i = 0; i < grades.size(); ++i) {
    const TomlNode& one = (*list)[i];
    const auto number = one.number();
    if (!number) table.fail(one, fmt::format("{} must be three numbers", key));
    if (!range.holds(*number)) {
      table.fail(one, fmt::format("{} = {}", key, outOfRange(fmt::format("{:g}", *number), range)));
    }
    if (i > 0 && *number <= grades[i - 1]) table.fail(one, fmt::format("{}: each is larger than the one before", key));
    grades[i] = *number;
  }
}

std::optional<lumps::LumpTask> readLumpTask(const TomlNode& root, std::string_view file) {
  const TomlNode* keys = tableNamed(root, "lump", file);
  if (keys == nullptr) return std::nullopt;
  lumps::LumpTask task;
  const TomlTable table(*keys, file, "[lump]",
                        {"diameters_mm", "depths_mm", "ratios", "mobile_share", "mobility_mm_per_n", "empty_share",
                         "bodies", "start_cue", "pad_shown", "mark_share", "most_false"});
  readGrades(table, "diameters_mm", task.diameters_mm, kLumpDiameters);
  readGrades(table, "depths_mm", task.depths_mm, kLumpDepths);
  readGrades(table, "ratios", task.ratios, kLumpRatios);
  table.read("mobile_share", task.mobile_share, {0.0, 1.0});
  table.read("mobility_mm_per_n", task.mobility_mm_per_n, {0.1, 100.0});
  table.read("empty_share", task.empty_share, {0.0, 0.9});
  table.read("bodies", task.bodies, {1, kMaxBodies});
  table.read("start_cue", task.start_cue, {0.1, 1000.0});
  table.read("pad_shown", task.pad_shown);
  table.read("mark_share", task.mark_share, {0.0, 1.0});
  table.read("most_false", task.most_false, {0, kMaxTrials});
  return task;
}

Protocol protocolFrom(const TomlNode& root, std::string_view file) {
  Protocol protocol = builtInProtocol();
  std::vector<std::string> keys = {
      "id",     "version",     "title", "sites", "base_n_per_mm", "break_after_min", "least_days_to_retention",
      "hidden", "exploration", "lump"};
  for (const NamedSession& one : kSessions) keys.emplace_back(one.table);
  const TomlTable table(root, file, "a protocol", keys);
  table.read("id", protocol.id);
  const bool plain = std::ranges::all_of(
      protocol.id, [](unsigned char letter) { return std::isalnum(letter) != 0 || letter == '-' || letter == '_'; });
  if (!plain || protocol.id.empty() || protocol.id.size() > kLongestProtocolId) {
    table.fail("id is a word of letters, digits, - and _: '" + oneLine(protocol.id) + "'");
  }
  table.read("version", protocol.version, {1, 1e6});
  table.read("title", protocol.title);
  protocol.sites = sitesFrom(table);
  table.read("base_n_per_mm", protocol.base_n_per_mm, {0.02, 2.0});
  table.read("break_after_min", protocol.break_after_min, {0.0, 240.0});
  table.read("least_days_to_retention", protocol.least_days_to_retention, {0.0, 365.0});
  readHidden(root, file, protocol.hidden);
  readExploration(root, file, protocol.exploration);
  protocol.lump = readLumpTask(root, file);
  const int choices = protocol.sites.empty() ? 12 : static_cast<int>(protocol.sites.size());
  for (const NamedSession& one : kSessions) {
    SessionSettings& settings = protocol.*one.settings;
    settings.block.choices = choices;
    if (const TomlNode* session = tableNamed(root, one.table, file)) {
      settings = sessionFrom(*session, file, one.table, settings);
    }
  }
  return protocol;
}

// --- written

/// 15 digits: the same number is read back, and 28 stays "28".
std::string number(double value) {
  const std::string text = fmt::format("{:.15g}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string levelsText(const std::vector<double>& levels) {
  std::vector<std::string> words;
  for (const double level : levels) words.push_back(number(100.0 * level));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

std::string sessionText(const NamedSession& named, const SessionSettings& settings) {
  const BlockSettings& block = settings.block;
  std::string text = fmt::format("\n[{}]  # {}\n", named.table, named.what);
  const auto line = [&text](std::string_view key, std::string_view value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  line("method", fmt::format("\"{}\"", wordFor(block.method)));
  line("meaning", fmt::format("\"{}\"", wordFor(block.meaning)));
  if (!block.levels.empty()) line("levels_percent", levelsText(block.levels));
  line("start_percent", number(100.0 * block.start));
  line("draw", fmt::format("\"{}\"", wordFor(block.draw)));
  line("warm_up", std::to_string(block.warm_up));
  line("easy", std::to_string(block.easy));
  line("easy_share_percent", number(100.0 * block.easy_share));
  line("least", std::to_string(block.stop.least));
  line("most", std::to_string(block.stop.most));
  line("half_width", number(block.stop.half_width));
  line("mark_percent", number(100.0 * block.stop.mark));
  line("sure_percent", number(100.0 * block.stop.sure));
  line("feedback", settings.feedback ? "true" : "false");
  line("limit_s", number(settings.limit_s));
  line("all_sites", settings.all_sites ? "true" : "false");
  line("natural_stiffness", settings.natural_stiffness ? "true" : "false");
  return text;
}

std::string gradesText(const lumps::Grades& grades) {
  return fmt::format("[{}, {}, {}]", number(grades[0]), number(grades[1]), number(grades[2]));
}

std::string lumpText(const lumps::LumpTask& task) {
  return fmt::format(
      "\n[lump]  # what sittings with lumps hide; each list: small, middle, large\n"
      "diameters_mm = {}\ndepths_mm = {}  # of the tops under the skin\nratios = {}  # of stiffness, over the layer\n"
      "mobile_share = {}  # of lumps, the others are fixed\nmobility_mm_per_n = {}\n"
      "empty_share = {}  # of the bodies of practice\nbodies = {}  # of a sitting of practice\n"
      "start_cue = {}  # C, how plain the first lump of practice is; 1 is found half the time\n"
      "pad_shown = {}  # the pressures under the finger, in practice\n"
      "mark_share = {}  # of the {} lumps of an examination, to pass\n"
      "most_false = {}  # false alarms, to pass\n",
      gradesText(task.diameters_mm), gradesText(task.depths_mm), gradesText(task.ratios), number(task.mobile_share),
      number(task.mobility_mm_per_n), number(task.empty_share), task.bodies, number(task.start_cue),
      task.pad_shown ? "true" : "false", number(task.mark_share), lumps::kExamLumps, task.most_false);
}

std::string inQuotes(std::string_view text) {
  std::string safe = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') safe += '\\';
    safe += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
  }
  return safe + '"';
}

}  // namespace

Protocol parseProtocol(std::string_view text, std::string_view file) {
  if (text.size() > kMaxProtocolBytes) throw Error::inFile(file, "is too large for a protocol; at most 1 MiB");
  return protocolFrom(scene::parseToml(text, file), file);
}

Protocol protocolNamed(const std::string& name_or_file) {
  if (name_or_file.empty() || name_or_file == "vhb") return builtInProtocol();
  if (name_or_file == "lumps") return builtInLumpProtocol();
  return parseProtocol(readFile(name_or_file, kMaxProtocolBytes), name_or_file);
}

std::string protocolText(const Protocol& protocol) {
  std::vector<std::string> sites;
  for (const std::string& words : protocol.sites) sites.push_back(inQuotes(words));
  std::string text = fmt::format(
      "# What is trained and tested (palpate train --protocol FILE). Changes are in per cent of what `meaning` says.\n"
      "id = {}\nversion = {}  # another number whenever anything below is changed\ntitle = {}\n"
      "sites = [{}]  # places in words; none: the twelve, six levels on both sides\n"
      "base_n_per_mm = {}  # of the even tissue that tests are made on\n"
      "break_after_min = {}\nleast_days_to_retention = {}\n",
      inQuotes(protocol.id), protocol.version, inQuotes(protocol.title), fmt::join(sites, ", "),
      number(protocol.base_n_per_mm), number(protocol.break_after_min), number(protocol.least_days_to_retention));
  text += fmt::format(
      "\n[hidden]  # the place that is to be found\nradius_mm = {}\nedge_softness = {}  # share over which it fades\n"
      "depth_mm = {}  # what lies deep is felt less\nbony_displacement_mm = {}  # bone that stands nearer to the "
      "skin\n",
      number(protocol.hidden.radius_mm), number(protocol.hidden.edge_softness), number(protocol.hidden.depth_mm),
      number(protocol.hidden.bony_displacement_mm));
  text += fmt::format("\n[exploration]  # a site counts as felt\nforce_n = {}\ndwell_s = {}\nradius_mm = {}\n",
                      number(protocol.exploration.force_n), number(protocol.exploration.dwell_s),
                      number(protocol.exploration.radius_mm));
  // Protocols without lumps keep the text, and with it the hash, that they always had.
  if (protocol.lump) text += lumpText(*protocol.lump);
  for (const NamedSession& one : kSessions) text += sessionText(one, protocol.*one.settings);
  return text;
}

std::string protocolSha256(const Protocol& protocol) { return sha256Hex(protocolText(protocol)); }

}  // namespace palpate::training
