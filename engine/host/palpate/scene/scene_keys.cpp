// The tables in one order, for reader, writer and documentation; a new table is one line here. Here too is [output],
// which is too small for a file.
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

Section outputSection() {
  using S = OutputSettings;
  std::vector<Key<S>> keys = {
      numbers<S>("surfaces_at_s", &S::surfaces_at_s, between(0, 1e6),
                 "Times at which the deformed skin is written, with displacement and strain."),
      flag<S>("forces", &S::forces, "Write forces.csv: every finger in every tick."),
  };
  return section<S>("output", "Files to write.", &Scene::output, std::move(keys));
}

}  // namespace

const std::vector<Key<Scene>>& topKeys() {
  using S = Scene;
  static const std::vector<Key<S>> keys = {
      text<S>("title", &S::title, "Title of the run in the report."),
      fidelityKey(),
      number<S>("seconds", &S::seconds, between(0, 10800),
                "Duration of the run; 0 is until the last finger has finished."),
      number<S>("ticks_per_s", &S::ticks_per_s, between(100, 10000), "Rate of the servo loop."),
  };
  return keys;
}

std::vector<KeyRow> topRows(const Scene& scene) { return describe("", topKeys(), scene); }

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      bodySection(),        breathingSection(), stiffnessSection(), dysfunctionSection(), lumpSection(),
      ellipsesSection(),    frictionSection(),  contactSection(),   partitionSection(),   tissueSection(),
      deformationSection(), profileSection(),   strainSection(),    outputSection(),      viewSection(),
      safetySection(),      fingerSection(),    deviceSection(),
  };
  return all;
}

}  // namespace palpate::scene
