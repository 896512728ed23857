// `palpate study errata`: what each erratum changes on a scene, in numbers.
//
// The scene runs corrected and once more for every other reading, with that reading alone; forces, proxies and deformed
// skins are compared tick by tick and picture by picture. The text on partitions matters only where a finger touches
// through one, so the scene runs with contact.source = "surface" and through both trees.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/scene.h"
#include "report/page/study_page.h"

namespace palpate::study {

/// Motions and forces of the fingers in one run, without comparison.
struct RunLook {
  double touching_percent = 0.0;  ///< among the ticks of all fingers
  double peak_force_n = 0.0;
  double drag_mm = 0.0;  ///< the longest that a finger pulls the skin along, after f_adj and the cap
};

struct ErratumEffect {
  scene::ErratumText text;
  std::string reading;    ///< options that were set, as in a scene file; empty: nothing to switch, nothing measured
  std::string body;       ///< measured body
  std::string tissue;     ///< tissue of that body and its force law, in words; with the reading
  std::string base;       ///< "surface", "bsp" or "octree": what the fingers collide with
  std::string active;     ///< options that were active on both sides, as in a scene file
  std::string inert;      ///< errata of the reading that cannot act under these options; empty: none
  RunLook look;           ///< the run with the reading
  double force_n = 0.0;   ///< largest difference of a finger's force
  double proxy_mm = 0.0;  ///< largest difference of a proxy
  std::size_t lost_ticks = 0;  ///< ticks of a finger that touches in one of the two runs only
  /// Largest share of the triangles in the detecting box that its leaves lack at any picture; 0 without a partition.
  double missed_percent = 0.0;
  double skin_mm = 0.0;         ///< largest difference of a vertex
  double skin_rms_mm = 0.0;     ///< over all vertices that move in one of the two, all pictures together
  double strain_percent = 0.0;  ///< largest difference
  double moved_ratio = 1.0;     ///< moved vertices of this reading over those of the corrected one

  bool isMeasured() const { return !reading.empty(); }
  bool changesNothing() const {
    return force_n == 0.0 && proxy_mm == 0.0 && missed_percent == 0.0 && skin_mm == 0.0 && strain_percent == 0.0;
  }
};

/// Ways to measure a scene: the whole skin, or the detecting box over either tree. In this order each list below that
/// has one row for each.
struct ErrataEffects {
  std::vector<ErratumEffect> corrected;    ///< the runs to compare with, each with itself
  std::vector<ErratumEffect> all_literal;  ///< every switch of fidelity together
  std::vector<ErratumEffect> errata;       ///< E1 first, each alone under the options where it can act
};

/// Takes a few seconds a row. Errata of the partition are measured with the contact source "hdb" (and point fingers) on
/// both sides, in the tree they are about. Throws Error for a scene that cannot be built.
ErrataEffects studyErrata(const scene::Scene& scene, const Progress& progress = {});

// The study of the errata as text, JSON, Markdown and CSV.

/// The corrected runs, all switches together, then a row an erratum, as all reports show it.
TextTable tableOf(const ErrataEffects& effects);
/// Meaning of its columns.
std::string errataLegend();

/// Lists the printed form, the engine's and the switch between them, a Markdown row per erratum.
std::string errataList();

std::string errataText(const ErrataEffects& effects);
/// One object of three lists: "corrected" and "all_literal" with an object for each contact source and tree, "errata"
/// with one for each erratum.
std::string errataJson(const ErrataEffects& effects);
/// errata.md, errata.csv and errata.json. Throws Error naming the file.
void writeErrata(const ErrataEffects& effects, const std::filesystem::path& folder);

}  // namespace palpate::study
