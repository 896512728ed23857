// The key `fidelity` of a scene file: one word for all errata, or a table with an entry each.
#include "palpate/scene/detail/scene_keys.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

bool readsLiteral(const Entry& entry) { return readChoice<Reading>(entry) == Reading::literal; }

void readErratum(Fidelity& fidelity, const Entry& entry, std::string_view name) {
  const Erratum erratum = erratumNamed(name);
  if (erratum == Erratum::none) {
    entry.fail(fmt::format("is not an erratum; expected {} to {}, or \"all\"", nameOf(erratumOf(1)),
                           nameOf(erratumOf(kErrata))));
  }
  try {
    requireSwitchable(erratum);
  } catch (const Error& error) {
    throw Error::atLine(entry.file, entry.line(), error.cause());
  }
  fidelity.setLiteral(erratum, readsLiteral(entry));
}

Entry childEntry(const std::string& key, const TomlNode& node, const Entry& table) {
  return {node, table.file, fmt::format("{}.{}", table.name, oneLine(key))};
}

void readFidelity(Fidelity& fidelity, const Entry& entry) {
  const TomlNode* table = entry.node.table();
  if (table == nullptr) return fidelity.setAll(readsLiteral(entry));
  if (const TomlNode* all = table->get("all")) {
    fidelity.setAll(readsLiteral({*all, entry.file, entry.name + ".all"}));
  }
  for (const auto& [key, place, node] : table->entries()) {
    if (key != "all") readErratum(fidelity, childEntry(key, node, entry), key);
  }
}

/// "corrected", "literal" or { E14 = "literal", ... }.
std::string showFidelity(const Scene& scene) {
  const std::string words = wordsOf(scene.fidelity);
  if (!words.starts_with('E')) return inQuotes(words);
  std::string table;
  for (const ErratumText& text : errata()) {
    if (!scene.fidelity.literal(text.erratum)) continue;
    table += fmt::format("{}{} = \"{}\"", table.empty() ? "" : ", ", nameOf(text.erratum), wordFor(Reading::literal));
  }
  return "{ " + table + " }";
}

}  // namespace

Key<Scene> fidelityKey() {
  return {"fidelity",
          formatChoices(wordList<Reading>()) + ", or one word for each erratum: `fidelity.E14 = \"literal\"`",
          "The dissertation's formulae with their errata corrected, or as printed (docs/reference/dissertation.md).",
          [](Scene& scene, const Entry& entry) { readFidelity(scene.fidelity, entry); }, showFidelity};
}

}  // namespace palpate::scene
