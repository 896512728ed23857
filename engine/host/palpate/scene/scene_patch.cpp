// Both scenes as rows of keys -> rows that differ -> changes of the text, by the places that the parser noted -> the
// new text, read once more: it counts only if it says what it should. Repeated tables ([[finger]]) are distinguished by
// what stayed the same, as in a comparison of two files.
//
// Based on: Hunt and McIlroy, "An algorithm for differential file comparison", 1976 (longest common subsequence). Cold
// path.
#include "palpate/scene/scene_writer.h"

#include <algorithm>
#include <map>

#include "palpate/base/error.h"
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

namespace fs = std::filesystem;
using Rows = std::vector<KeyRow>;

/// Thrown for a form that is not patched.
struct NotPatched {};

/// From the parser's lines and columns, which count letters, to bytes.
class Places {
 public:
  explicit Places(std::string_view text) : text_(text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') starts_.push_back(i + 1);
    }
  }

  std::size_t at(const TomlPlace& place) const {
    std::size_t byte = lineStart(place.line);
    for (std::size_t letters = place.column - 1; letters > 0 && byte < text_.size(); --letters) {
      ++byte;
      while (byte < text_.size() && (static_cast<unsigned char>(text_[byte]) & 0xc0) == 0x80) ++byte;
    }
    return byte;
  }
  std::size_t lineStart(std::size_t line) const {
    return line > starts_.size() ? text_.size() : starts_[line == 0 ? 0 : line - 1];
  }
  std::size_t lineEnd(std::size_t line) const { return lineStart(line + 1); }  ///< after its line break
  bool isBlank(std::size_t line) const {
    const std::string_view words = text_.substr(lineStart(line), lineEnd(line) - lineStart(line));
    return words.find_first_not_of(" \t\r\n") == std::string_view::npos;
  }
  bool isComment(std::size_t line) const {
    const std::string_view words = text_.substr(lineStart(line), lineEnd(line) - lineStart(line));
    const std::size_t first = words.find_first_not_of(" \t");
    return first != std::string_view::npos && words[first] == '#';
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_ = {0};
};

/// Last line of anything in it; a table's own place is its header's.
std::size_t findLastLine(const TomlNode& table) {
  std::size_t last = table.end().line;
  for (const auto& [key, place, node] : table.entries()) {
    if (node.isTable() && !node.isInline()) throw NotPatched{};
    last = std::max<std::size_t>(last, node.end().line);
  }
  return last;
}

std::vector<std::string> fallbackValues(const Rows& rows) {
  std::vector<std::string> values;
  for (const KeyRow& row : rows) values.push_back(row.fallback);
  return values;
}

/// For each of `is` the one of `was` that it was before, or -1: those that are equal first, as many as can be in order,
/// then the rest between them, pair by pair.
std::vector<int> partners(const std::vector<Rows>& was, const std::vector<Rows>& is) {
  const std::size_t n = was.size();
  const std::size_t m = is.size();
  if (n * m > 250'000) throw NotPatched{};
  std::vector<std::vector<std::string>> before;
  std::vector<std::vector<std::string>> now;
  for (const Rows& rows : was) before.push_back(fallbackValues(rows));
  for (const Rows& rows : is) now.push_back(fallbackValues(rows));
  std::vector<std::vector<std::size_t>> common(n + 1, std::vector<std::size_t>(m + 1, 0));
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = m; j-- > 0;) {
      common[i][j] = before[i] == now[j] ? 1 + common[i + 1][j + 1] : std::max(common[i + 1][j], common[i][j + 1]);
    }
  }
  std::vector<int> partner(m, -1);
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < n && j < m) {
    if (before[i] == now[j] || common[i + 1][j + 1] == common[i][j]) {
      partner[j++] = static_cast<int>(i++);
    } else {
      common[i + 1][j] >= common[i][j + 1] ? ++i : ++j;
    }
  }
  return partner;
}

class Patch {
 public:
  Patch(std::string_view text, const fs::path& file)
      : text_(text), places_(text), folder_(fs::absolute(file).parent_path()) {}

  void changeTop(const TomlNode& root, const Rows& was, const Rows& is) {
    for (std::size_t i = 0; i < is.size(); ++i) {
      if (was[i].fallback == is[i].fallback) continue;
      if (const TomlNode* node = root.get(is[i].key)) {
        changeValue(root, *node, is[i]);
      } else {
        insert(topEnd(root), formatRow(is[i]));
      }
    }
  }

  void changeTable(const TomlNode* table, const std::string& title, const Rows& was, const Rows& is) {
    std::string added;
    for (std::size_t i = 0; i < is.size(); ++i) {
      if (was[i].fallback == is[i].fallback) continue;
      const TomlNode* node = table == nullptr ? nullptr : table->get(is[i].key);
      if (node != nullptr) {
        changeValue(*table, *node, is[i]);
      } else {
        added += formatRow(is[i]);
      }
    }
    if (added.empty()) return;
    if (table == nullptr) return insert(text_.size(), "\n" + title + "\n" + added);
    if (table->isInline()) throw NotPatched{};
    insert(places_.lineEnd(findLastLine(*table)), added);
  }

  void changeList(const TomlList* list, const Section& section, const std::vector<Rows>& was,
                  const std::vector<Rows>& is) {
    const std::vector<int> partner = partners(was, is);
    std::size_t end = text_.size();  // place of the next new table
    if (list != nullptr && !list->empty()) end = headerStart(tableAt(*list, 0));
    std::vector<bool> stays(was.size(), false);
    for (std::size_t j = 0; j < is.size(); ++j) {
      if (partner[j] < 0) {
        if (list != nullptr && !list->empty() && tableAt(*list, 0).isInline()) throw NotPatched{};
        insert(end, "\n" + section.title + "\n" + linesOf(is[j], section.describe(), folder_));
        continue;
      }
      const auto i = static_cast<std::size_t>(partner[j]);
      stays[i] = true;
      const TomlNode& table = tableAt(*list, i);
      changeTable(&table, section.title, was[i], is[j]);
      end = places_.lineEnd(findLastLine(table));
    }
    for (std::size_t i = 0; i < was.size(); ++i) {
      if (!stays[i]) removeTable(tableAt(*list, i));
    }
  }

  std::string applied() const {
    std::string changed;
    std::size_t at = 0;
    for (const auto& [place, change] : changes_) {
      if (place.first < at) throw NotPatched{};
      changed += text_.substr(at, place.first - at);
      if (!change.empty() && change.back() == '\n' && !changed.empty() && changed.back() != '\n') changed += '\n';
      changed += change;
      at = place.second;
    }
    return changed += text_.substr(at);
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;  ///< bytes from, to

  static const TomlNode& tableAt(const TomlList& list, std::size_t i) {
    if (i >= list.size() || !list[i].isTable()) throw NotPatched{};
    return list[i];
  }

  std::string formatRow(const KeyRow& row) const {
    return row.fallback.empty() ? std::string() : row.key + " = " + valueIn(folder_, row) + "\n";
  }
  std::size_t headerStart(const TomlNode& table) const { return places_.lineStart(table.line()); }

  void insert(std::size_t at, const std::string& words) { changes_[{at, at}] += words; }
  void replace(std::size_t from, std::size_t to, std::string words) { changes_[{from, to}] = std::move(words); }
  void removeLines(std::size_t first, std::size_t last) {
    replace(places_.lineStart(first), places_.lineEnd(last), {});
  }

  void changeValue(const TomlNode& table, const TomlNode& node, const KeyRow& row) {
    if (row.fallback.empty()) {
      if (table.isInline()) throw NotPatched{};
      return removeLines(node.line(), node.end().line);
    }
    replace(places_.at(node.begin()), places_.at(node.end()), valueIn(folder_, row));
  }

  /// The header and its keys, with the blank line before it; comments on lines of their own stay.
  void removeTable(const TomlNode& table) {
    if (table.isInline()) throw NotPatched{};
    const std::size_t header = table.line();
    const bool blank = header > 1 && places_.isBlank(header - 1);
    removeLines(blank ? header - 1 : header, header);
    for (const auto& [key, place, node] : table.entries()) removeLines(place.line, node.end().line);
  }

  /// After the last key before the first table; without one, before the first table and its own comment.
  std::size_t topEnd(const TomlNode& root) const {
    std::size_t last = 0;
    std::size_t first_table = std::string::npos;
    for (const auto& [key, place, node] : root.entries()) {
      const bool header = (node.isTable() && !node.isInline()) || node.isListOfTables();
      if (header) {
        first_table = std::min<std::size_t>(first_table, node.line());
      } else {
        last = std::max<std::size_t>(last, node.end().line);
      }
    }
    if (last > 0) return places_.lineEnd(last);
    if (first_table == std::string::npos) return text_.size();
    std::size_t line = first_table;
    while (line > 1 && places_.isComment(line - 1)) --line;
    return places_.lineStart(line > 1 ? line : first_table);
  }

  std::string_view text_;
  Places places_;
  fs::path folder_;
  std::map<Place, std::string> changes_;
};

std::string patched(std::string_view text, const Scene& scene, const fs::path& file) {
  const TomlNode root = parseToml(text, file.string());
  const Scene was = parse(text, file.string());
  Patch patch(text, file);
  patch.changeTop(root, topRows(was), topRows(scene));
  for (const Section& section : sections()) {
    const std::vector<Rows> before = section.values(was);
    const std::vector<Rows> now = section.values(scene);
    const TomlNode* node = root.get(section.name);
    if (section.title.starts_with("[[")) {
      patch.changeList(node == nullptr ? nullptr : node->list(), section, before, now);
    } else {
      patch.changeTable(node == nullptr ? nullptr : node->table(), section.title, before.front(), now.front());
    }
  }
  return patch.applied();
}

}  // namespace

std::optional<std::string> patchedScene(std::string_view text, const Scene& scene, const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  try {
    std::string changed = patched(text, scene, file);
    if (sceneAsToml(parse(changed, file.string()), folder) == sceneAsToml(scene, folder)) return changed;
  } catch (const NotPatched&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace palpate::scene
