// The tables [friction], [contact], [partition], [tissue] and [safety] of a scene file: how the body is felt.
#include "palpate/scene/detail/scene_keys.h"
#include "palpate/scene/words.h"
#include "palpate/tissue/published.h"

namespace palpate::scene {

namespace {

std::vector<std::string> frictionNames() {
  std::vector<std::string> names;
  for (const tissue::FrictionPreset& preset : tissue::frictionPresets()) names.emplace_back(preset.name);
  return names;
}

/// The name of two coefficients and nothing else: a change of one of them clears it.
Key<contact::FingerSettings> skinKey() {
  using S = contact::FingerSettings;
  const auto read = [](S& friction, const Entry& entry) {
    const std::string name = readWord(entry, frictionNames());
    const auto preset = std::ranges::find(tissue::frictionPresets(), name, &tissue::FrictionPreset::name);
    friction.mu_static = preset->still;
    friction.mu_dynamic = preset->slipping;
  };
  const auto show = [](const S& friction) -> std::string {
    for (const tissue::FrictionPreset& preset : tissue::frictionPresets()) {
      const bool same = preset.still == friction.mu_static && preset.slipping == friction.mu_dynamic;
      if (same) return inQuotes(preset.name);
    }
    return {};
  };
  return {.name = "skin",
          .takes = formatChoices(frictionNames()),
          .meaning =
              "Both coefficients by skin condition: dry is 0.46 and 0.44, oiled 0.2 and 0.2 (sources: "
              "docs/reference/tissue-tables.md); static or dynamic, if set, takes precedence.",
          .read = read,
          .show = show,
          .form = {KeyForm::Kind::choice, 0.0, 0.0, frictionNames()},
          .first = true};
}

}  // namespace

Section frictionSection() {
  using S = contact::FingerSettings;
  std::vector<Key<S>> keys = {
      skinKey(),
      number<S>("static", &S::mu_static, between(0, 5),
                "Friction coefficient up to which the skin sticks to the finger."),
      number<S>("dynamic", &S::mu_dynamic, between(0, 5),
                "Friction coefficient while the finger slips; at most static."),
      number<S>("stiffness_ratio", &S::stiffness_ratio, above(0, 100),
                "Tangential divided by normal stiffness. Tissue has 0.6 to 1.1; with 0.23 half-Gaussian tissue follows "
                "20 mm at 10 mm depth, as in the dissertation (E2)."),
  };
  return section<S>("friction", "How the skin holds the finger.", way(&Scene::contact, &ContactSettings::finger),
                    std::move(keys), [](const S& friction, const Entry& entry) {
                      if (friction.mu_dynamic > friction.mu_static) entry.fail("dynamic must not be above static");
                    });
}

Section contactSection() {
  using S = ContactSettings;
  using F = contact::FingerSettings;
  const auto finger = [](auto F::*member) { return way(&S::finger, member); };
  std::vector<Key<S>> keys = {
      choice<S, ContactSource>("source", &S::source,
                               "What a finger collides with: the whole skin, or only the triangles near the proxy "
                               "found by the [partition], as in the dissertation (docs/explanation/contact.md)."),
      choice<S, HapticSurface>("haptic_surface", &S::haptic_surface,
                               "How the haptic surface reacts to a press (dissertation, 2.3): it stays; it yields by "
                               "force divided by stiffness, which halves the stiffness and the depth of the skin; or "
                               "it yields with doubled stiffness, which restores the force."),
      number<S>("max_depth_mm", finger(&F::max_depth_mm), above(0, kLongestMm),
                "Maximum depth that is felt; a tip outside the body and farther than this from its proxy is released."),
      number<S>(
          "catch_up_mm_per_s", finger(&F::catch_up_mm_per_s), above(0, 1e6),
          "The proxy moves at most twice as far as the tip, plus this speed; limits jumps of the force at ridges."),
      flag<S>("force_shading", finger(&F::force_shading), "Smooth the force over coarse triangles."),
  };
  return section<S>("contact", "How the finger meets the surface.", &Scene::contact, std::move(keys));
}

Section partitionSection() {
  using S = PartitionSettings;
  using B = hdb::BuildSettings;
  const auto build = [](auto B::*member) { return way(&S::build, member); };
  std::vector<Key<S>> keys = {
      choice<S, hdb::TreeKind>("tree", build(&B::tree), "How space is partitioned."),
      choice<S, hdb::Assignment>("assign", build(&B::assignment),
                                 "A triangle that crosses a plane is cut (A), assigned to both sides (B), or to the "
                                 "side with most of it (C)."),
      count<S, Index>("threshold", build(&B::threshold), 1, 100'000'000, "Maximum number of triangles in a leaf."),
      number<S>("hdb_fraction", &S::hdb_fraction, above(0, 100),
                "Edge of the haptic detecting box as a fraction of the longest edge of the body."),
      number<S>("hdb_edge_mm", &S::hdb_edge_mm, between(0, kLongestMm), "Edge of that box; 0 uses hdb_fraction."),
      choice<S, hdb::HdbQuery>(
          "query", &S::query,
          "Candidate triangles: all in the leaves that the box touches, those that it touches itself, a list of these "
          "rebuilt only when the box leaves it, or a linked list that follows the box."),
      choice<S, std::optional<hdb::LiteralTraversal>>(
          "traversal", &S::traversal,
          "How the leaves are found: completely, or as printed, with gaps; with \"tight\", fidelity can still select a "
          "printed variant (E4, E5, E10)."),
      number<S>("refresh_s", &S::refresh_s, between(0, 60),
                "Interval at which the box follows the proxy; 0 is every tick."),
  };
  return section<S>("partition", "Where a finger of the contact source \"hdb\" finds its triangles.", &Scene::partition,
                    std::move(keys));
}

namespace {

std::vector<Key<TissueSettings>> relaxationKeys() {
  using S = TissueSettings;
  using R = contact::Relaxation;
  const auto term = [](auto R::*member) { return way(&S::relaxation, member); };
  return {
      number<S>("relaxation", term(&R::share), between(0, contact::kMaxRelaxation),
                "Fraction by which the force of a held press decays (docs/explanation/force-laws.md); 0 is none, 0.15 "
                "is plausible for living limbs."),
      number<S>("relaxation_s", term(&R::time_s), between(0.01, 1000),
                "Relaxation: time constant (63 % of that decay)."),
      number<S>("relaxation_2", term(&R::share_2), between(0, contact::kMaxRelaxation),
                "Relaxation: a second fraction with its own time constant; both together at most 0.9."),
      number<S>("relaxation_2_s", term(&R::time_2_s), between(0.01, 1000),
                "Relaxation: time constant of the second fraction."),
  };
}

}  // namespace

Section tissueSection() {
  using S = TissueSettings;
  using L = tissue::ForceLaw;
  const auto law = [](auto L::*member) { return way(&S::force_law, member); };
  std::vector<Key<S>> keys = {
      choice<S, L::Kind>("force_law", law(&L::kind),
                         "Normal force by depth (docs/explanation/force-laws.md): stiffness times depth; a power of "
                         "the depth; a stiffness that grows along a Gaussian; a measured table; or the local layers, "
                         "linear where there are none. All agree with the stiffness map at reference_depth_mm."),
      number<S>("exponent", law(&L::exponent), between(1, 3),
                "Power law: exponent of the depth; layered tissue has 1.5 to 1.8."),
      number<S>("reference_depth_mm", law(&L::reference_depth_mm), above(0, 1000),
                "Depth at which every law gives the same force as the linear one, and to which the stiffness map "
                "refers. Layers: 8."),
      number<S>("stiffening_ratio", law(&L::stiffening_ratio), above(0, 100),
                "Stiffening law: stiffness at depth divided by that of a light touch."),
      number<S>("stiffening_depth_mm", law(&L::stiffening_depth_mm), above(0, 1000),
                "Stiffening law: depth at which that stiffness is reached."),
      file<S>("force_table", &S::force_table,
              "Table law: file of rows depth_mm,force_n; scaled to agree with the map."),
      number<S>("fat_mm", &S::fat_mm, between(0, 60),
                "Layered tissue: fat between skin and muscle; 0 derives it from the body mass index (4 mm at 18, 8 at "
                "22, 15 at 30), less where there is no room."),
      file<S>("layer_table", &S::layer_table,
              "Layered tissue: one layer table for the whole body, from palpate tissue solve or palpate tissue fit "
              "profile (default: the library's tables by thickness)."),
      flag<S>("by_finger_radius", &S::by_finger_radius,
              "Layered law: a larger finger meets a larger force (radius 1 to 24 mm, clamped beyond); false: every "
              "finger feels what one of 8 mm does."),
      number<S>("point_radius_mm", &S::point_radius_mm, between(1, 24),
                "Layered law: radius assumed for a finger of radius 0."),
      flag<S>("narrow_bone", &S::narrow_bone,
              "Layered law: narrow bone, such as a spinous process or a rib, pushes back less than wide bone; false "
              "treats all bone as wide."),
  };
  const std::vector<Key<S>> relaxation = relaxationKeys();
  keys.insert(keys.end(), relaxation.begin(), relaxation.end());
  keys.push_back(choice<S, LumpForce>("lumps", &S::lumps,
                                      "Force of a [[lump]]: from the field of a press without it, or corrected on its "
                                      "axis by solving the lump itself (a few seconds each)."));
  return section<S>(
      "tissue", "How force grows with depth, and falls with time.", &Scene::tissue, std::move(keys),
      [](const S& tissue, const Entry& entry) {
        if (!(tissue.relaxation.share + tissue.relaxation.share_2 <= contact::kMaxRelaxation)) {
          entry.fail(fmt::format("relaxation and relaxation_2 together must be at most {}", contact::kMaxRelaxation));
        }
        const bool wants_table = tissue.force_law.kind == L::Kind::table;
        if (wants_table && tissue.force_table.empty()) entry.fail("law \"table\" requires a force_table");
        if (!wants_table && !tissue.force_table.empty()) {
          entry.fail("has a force_table but its force_law is not \"table\"");
        }
      });
}

Section safetySection() {
  using S = SafetySettings;
  std::vector<Key<S>> keys = {
      choice<S, DeviceModel>("device", &S::device,
                             "Device whose limits apply when no device is open; an open device has its own."),
      number<S>("nominal_force_n", &S::nominal_force_n, between(0, 100),
                "Maximum force sent to the device, at most the device's own limit; 0 uses that limit (3.3 for an "
                "unknown device)."),
      number<S>("stiffness_cap_n_per_mm", &S::stiffness_cap_n_per_mm, between(0, 100),
                "Maximum stiffness felt anywhere, at most what the device, delay_ticks and ticks_per_s allow; 0 uses "
                "that. The whole body is softened by one factor, and above 1 N slopes are limited. Only "
                "--unsafe-stiffness allows more."),
      number<S>("delay_ticks", &S::delay_ticks, between(0, 6),
                "Delay from sampling the pose to the force taking effect, including the amplifier's lag; at least that "
                "of the open device."),
      number<S>("device_damping_n_s_per_mm", &S::device_damping_n_s_per_mm, between(0, 1),
                "Damping measured on this device; 0 uses the default for its type."),
      number<S>("device_friction_n", &S::device_friction_n, between(0, 100),
                "Friction measured on this device; 0 uses the default for its type."),
      flag<S>("passivity", &S::passivity,
              "Remove the energy that the sampled loop adds to the skin's own law. Always on while a device is open."),
      flag<S>("soft_contact", &S::soft_contact,
              "Softens the start of the force law for a fast first touch. Always on while a device is open."),
      choice<S, StartRule>("start", &S::start,
                           "If the tip is inside at the start or after a fault: no force until it has been outside "
                           "once, or a force that grows over ramp_s."),
      number<S>("ramp_s", &S::ramp_s, between(0, 60), "With start = \"ramp\": time over which the force grows."),
      number<S>("max_age_ticks", &S::max_age_ticks, between(0, 1000), "A pose older than this is a fault: no force."),
      number<S>("max_jump_mm", &S::max_jump_mm, above(0, 1e6),
                "A tip that moves farther than this in a tick, and faster than max_tip_speed_mm_per_s, is a fault: no "
                "force."),
      number<S>("max_tip_speed_mm_per_s", &S::max_tip_speed_mm_per_s, above(0, 1e9), "See max_jump_mm."),
      number<S>("max_force_rate_n_per_ms", &S::max_force_rate_n_per_ms, above(0, 1e6),
                "A force that grows faster than this is a fault: no force."),
      number<S>("slew_per_motion", &S::slew_per_motion, between(0, 1000), "No effect; will be removed in version 0.4."),
      number<S>("slew_mm", &S::slew_mm, above(0, 1000), "No effect; will be removed in version 0.4."),
      number<S>("passivity_allowance_n_mm", &S::passivity_allowance_n_mm, between(0, 1e6),
                "No effect; will be removed in version 0.4."),
  };
  return section<S>("safety",
                    "Limits on what a device may do to a hand; never changes the contact force in forces.csv.",
                    &Scene::safety, std::move(keys));
}

}  // namespace palpate::scene
