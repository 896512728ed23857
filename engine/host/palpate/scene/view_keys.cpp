// The table [view] of a scene file: how pictures look.
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

using V = ViewSettings;
Key<V> overlayList(std::string name, std::vector<Overlay> V::*member, std::string meaning) {
  const auto read = [=](V& s, const Entry& entry) {
    const TomlList* list = entry.node.list();
    if (list == nullptr) entry.fail("must be a list of names");
    for (const TomlNode& node : *list) {
      (s.*member).push_back(readChoice<Overlay>({node, entry.file, entry.name}));
    }
  };
  const auto show = [=](const V& s) {
    std::vector<std::string> quoted;
    for (const Overlay overlay : s.*member) quoted.push_back(fmt::format("\"{}\"", wordFor(overlay)));
    return quoted.empty() ? std::string() : fmt::format("[{}]", fmt::join(quoted, ", "));
  };
  return {std::move(name), "list of " + formatChoices(wordList<Overlay>()), std::move(meaning), read, show};
}

constexpr double kFarthestMm = 1e5;
constexpr Range kPlaces = between(-kFarthestMm, kFarthestMm);

/// Whatever a file counts in.
constexpr Range kScalars = between(-1e9, 1e9);

/// Two rising numbers that need not be given.
Key<V> range(std::string name, std::optional<Vec2> V::*member, std::string meaning) {
  const auto read = [=](V& s, const Entry& entry) {
    const std::vector<double> v = readPoint(entry, 2, kScalars);
    if (!(v[0] < v[1])) entry.fail("must be two increasing numbers");
    s.*member = Vec2(v[0], v[1]);
  };
  const auto show = [=](const V& s) {
    const std::optional<Vec2>& v = s.*member;
    return v ? showNumbers({v->x(), v->y()}) : std::string();
  };
  return {std::move(name), "two numbers" + rangeSuffix(kScalars), std::move(meaning), read, show};
}

std::vector<Key<V>> cameraKeys() {
  constexpr double kAround = 180.0;
  constexpr double kAlmostAbove = 89.0;
  return {
      choice<V, StandardView>("side", &V::side, "Side to look from; table: from beside a lying body, on its left."),
      number<V>("yaw_deg", &V::yaw_deg, between(-kAround, kAround),
                "Rotation from that side; positive shows more of the patient's right."),
      number<V>("pitch_deg", &V::pitch_deg, between(-kAlmostAbove, kAlmostAbove),
                "Elevation from that side; positive looks from above."),
      number<V>("zoom", &V::zoom, between(0.01, 1000), "1 shows the whole body; larger is nearer."),
      place<V>("look_at_mm", &V::look_at_mm, kPlaces,
               "Place in the middle of the picture (default: the middle of the body)."),
      number<V>("distance_mm", &V::distance_mm, between(0, kFarthestMm),
                "Distance of the eye from that place; 0 is the distance at which zoom 1 shows the whole body."),
  };
}

std::vector<Key<V>> lookKeys() {
  return {
      choice<V, Shading>("shading", &V::shading, "Light at the vertices, or skin."),
      choice<V, Colouring>("colours", &V::colours, "Quantity shown by the colour of the skin."),
      text<V>("scalar", &V::scalar,
              "With colours = \"scalar\": which number of the body's PLY file; empty: the first."),
      choice<V, ColourMap>("scalar_map", &V::scalar_map, "Colour map of that value."),
      range("scalar_range", &V::scalar_range,
            "Values at the two ends of its colour map (default: its minimum and maximum)."),
      range("stiffness_range_n_per_mm", &V::stiffness_range_n_per_mm,
            "Ends of the colours of colours = \"stiffness\" (default: the body's softest and stiffest place)."),
      range("ellipse_range_mm", &V::ellipse_range_mm,
            "Ends of the colours of colours = \"ellipse-map\", half major axes (default: the body's)."),
      overlayList("show", &V::show, "Overlays drawn over the skin (docs/howto/pictures.md)."),
      number<V>("opacity", &V::opacity, between(0, 1), "Opacity of the skin; below 1 the bones show through."),
      number<V>(
          "skin_tone", &V::skin_tone, between(1, 6),
          "Tone of the skin, from very light to very dark, roughly the Fitzpatrick types; fractions interpolate."),
      number<V>("dent_contrast", &V::dent_contrast, between(0, 5),
                "Shading of dents: 0 is none, 1 is natural in close views and stronger where the dent is small in the "
                "picture, with contours at 0.5, 2.5, 4.5 ... mm; above 1 exaggerates both, and the picture says so."),
      choice<V, FingerShape>(
          "finger", &V::finger,
          "Shape of the fingers: auto draws fingers, and in the window hands if they are drawn fast enough."),
      flag<V>("lens", &V::lens, "Close-up from beside the finger in a corner of the picture."),
      flag<V>("white_background", &V::white_background, "White background instead of grey."),
      flag<V>("texture", &V::texture,
              "Show the picture named by [body] texture, or the colours of a PLY file, on the skin."),
      flag<V>("detail", &V::detail, "Show skin lines in close views."),
  };
}

std::vector<Key<V>> eyeKeys() {
  return {
      choice<V, StereoMode>("stereo", &V::stereo, "Stereo mode: how one picture holds the views of both eyes."),
      number<V>("eye_distance_mm", &V::eye_distance_mm, between(0, 200),
                "Distance between the eyes; 0 is the same as mono."),
      number<V>("convergence_mm", &V::convergence_mm, between(0, kFarthestMm),
                "Distance from the eyes to the plane of the screen; 0 is the distance of the picture's middle."),
      flag<V>("swap_eyes", &V::swap_eyes, "Swap the eyes, for screens or glasses that are the other way round."),
      place<V>("head_mm", &V::head_mm, kPlaces,
               "Position of the head in front of a real screen, from the screen's middle: right, up, towards the head "
               "(> 0)."),
      number<V>("screen_height_mm", &V::screen_height_mm, above(0, kFarthestMm),
                "With head_mm: height of that screen, which then shows the body at true size."),
  };
}

}  // namespace

Section viewSection() {
  std::vector<Key<V>> keys = cameraKeys();
  for (const std::vector<Key<V>>& more : {lookKeys(), eyeKeys()}) keys.insert(keys.end(), more.begin(), more.end());
  const auto check = [](const V& view, const Entry& entry) {
    if (view.head_mm && !(view.head_mm->z() > 0.0)) {
      entry.fail("head_mm must be in front of the screen: third number > 0");
    }
  };
  return section<V>("view", "Appearance of pictures and of the window.", &Scene::view, std::move(keys), check);
}

}  // namespace palpate::scene
