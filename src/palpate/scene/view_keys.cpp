// The table [view] of a scene file: how pictures look.
#include "palpate/scene/section_keys.h"

namespace palpate::scene {

namespace {

using S = ViewSettings;
Key<S> overlayList(std::string name, std::vector<Overlay> S::*member, std::string meaning) {
  const auto read = [=](S& s, const Entry& entry) {
    const toml::array* list = entry.node.as_array();
    if (list == nullptr) entry.fail("must be a list of names");
    for (const toml::node& node : *list) {
      (s.*member).push_back(readChoice<Overlay>({node, entry.file, entry.name}));
    }
  };
  const auto show = [=](const S& s) {
    std::vector<std::string> quoted;
    for (const Overlay overlay : s.*member) quoted.push_back(fmt::format("\"{}\"", wordFor(overlay)));
    return quoted.empty() ? std::string() : fmt::format("[{}]", fmt::join(quoted, ", "));
  };
  return {std::move(name), "list of " + choiceWords(wordList<Overlay>()), std::move(meaning), read, show};
}

/// A place that need not be given.
Key<S> place(std::string name, std::optional<Vec3> S::*member, std::string meaning) {
  const auto read = [=](S& s, const Entry& entry) {
    const std::vector<double> v = readPoint(entry, 3);
    s.*member = Vec3(v[0], v[1], v[2]);
  };
  const auto show = [=](const S& s) {
    const std::optional<Vec3>& v = s.*member;
    return v ? showNumbers({v->x(), v->y(), v->z()}) : std::string();
  };
  return {std::move(name), "three numbers", std::move(meaning), read, show};
}

}  // namespace

Section viewSection() {
  constexpr double kAround = 180.0;
  constexpr double kAlmostAbove = 89.0;
  constexpr double kFarthestMm = 1e5;
  std::vector<Key<S>> keys = {
      choice<S, StandardView>("side", &S::side, "From where one looks."),
      number<S>("yaw_deg", &S::yaw_deg, between(-kAround, kAround),
                "Turned from that side; positive sees more of the patient's right."),
      number<S>("pitch_deg", &S::pitch_deg, between(-kAlmostAbove, kAlmostAbove),
                "Turned from that side; positive looks from above."),
      number<S>("zoom", &S::zoom, between(0.01, 1000), "1 shows the whole body; larger is nearer."),
      place("look_at_mm", &S::look_at_mm, "Place in the middle of the picture; left out: the middle of the body."),
      choice<S, Shading>("shading", &S::shading, "Light at the vertices, or skin."),
      choice<S, Colouring>("colours", &S::colours, "What the colour of the skin says."),
      overlayList("show", &S::show, "What is drawn over the skin (docs/pictures.md)."),
      number<S>("opacity", &S::opacity, between(0, 1), "Of the skin; below 1 the bones show through."),
      choice<S, FingerShape>("finger", &S::finger, "What a finger looks like."),
      flag<S>("white_background", &S::white_background, "White paper instead of grey."),
      flag<S>("texture", &S::texture, "The picture that [body] texture names, on the skin."),
      flag<S>("detail", &S::detail, "Pores, where skin is seen from near by."),
      choice<S, StereoMode>("stereo", &S::stereo, "How two eyes share one picture."),
      number<S>("eye_distance_mm", &S::eye_distance_mm, between(0, 200), "Between the eyes; 0 is as good as mono."),
      number<S>("convergence_mm", &S::convergence_mm, between(0, kFarthestMm),
                "From the eyes to what appears in the plane of the screen; 0 is the middle of the picture."),
      flag<S>("swap_eyes", &S::swap_eyes, "For screens or glasses that are the other way round."),
      place("head_mm", &S::head_mm,
            "Where the head is before a real screen, from the screen's middle: right, up, towards the head (> 0)."),
      number<S>("screen_height_mm", &S::screen_height_mm, above(0, kFarthestMm),
                "With head_mm: height of that screen, which then shows the body at true size."),
  };
  const auto check = [](const S& view, const Entry& entry) {
    if (view.head_mm && !(view.head_mm->z() > 0.0)) {
      entry.fail("head_mm must be in front of the screen: third number > 0");
    }
  };
  return section<S>("view", "How pictures of it look.", &Scene::view, std::move(keys), check);
}

}  // namespace palpate::scene
