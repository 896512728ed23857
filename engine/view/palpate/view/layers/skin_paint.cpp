// Look, eye and touches -> the uniforms of the skin's programs, and the places whose colour a finger changes.
#include "palpate/view/layers/skin_paint.h"

#include <algorithm>
#include <string>
#include <vector>

#include "palpate/view/layers/skin_shader.h"
#include "palpate/view/made_skin.h"
#include "palpate/view/skin_tone.h"

namespace palpate::view {

namespace {

constexpr int kMapTexels = 1024;
constexpr std::size_t kMaxFingers = 8;  // as in the shader
/// Range in which a finger darkens the skin round it, in its radii; length of its shadow, in mm and in its radii, and
/// width (lightLeftByFingers() in the shader fades both to nothing).
constexpr float kShadeRadii = 4.0f;
constexpr float kLongestShadowMm = 220.0f;
constexpr float kShadowRadii = 15.0f;
constexpr float kWidthRadii = 1.5f;
constexpr float kWidening = 0.17f;
/// The rim of a mark, in its radii (blanched() in the shader).
constexpr float kMarkRadii = 2.3f;
/// Largest drag of a dent's skin, mm.
constexpr float kFarthestDragMm = 20.0f;

std::string vertexSource(std::string_view main) {
  return std::string(kSkinAttributes).append(kSkinOpacity).append(main);
}
std::string fragmentSource(std::string_view main) {
  return std::string(kSkinOpacity)
      .append("#ifdef TOUCHED\n")
      .append(kFingerShade)
      .append(kDentContours)
      .append("#endif\n")
      .append(main);
}

Program program(std::string_view name, std::string_view vertex, std::string_view fragment,
                std::string_view defines = {}) {
  return {name, std::string(defines).append(kSharedShader), vertexSource(vertex), fragmentSource(fragment)};
}

/// One variant per need: software GL runs both sides of a condition, and a loop at least once.
std::string shaderDefines(const SkinNeeds& needs, bool touched) {
  std::string defines;
  if (needs.pores) defines += "#define PORES\n";
  if (needs.picture) defines += "#define PICTURE\n";
  if (needs.colours) defines += "#define COLOURS\n";
  if (touched) defines += "#define TOUCHED\n";
  return defines;
}

void start(const Program& program, const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs = {}) {
  program.use();
  setViewpoint(program, viewpoint);
  const SkinTone tone = interpolateSkinTone(look.skin_tone);
  program.set("skin_colour", tone.colour);
  program.set("skin_blood", tone.blood);
  program.set("skin_scatter", tone.scatter);
  program.set("skin_sheen", tone.sheen);
  program.set("dent_contrast", static_cast<float>(look.dent_contrast));
  program.set("mm_per_point", viewpoint.pixels_per_point / viewpoint.pixels_per_radian);
  program.set("least_help_mm", static_cast<float>(kLeastHelpMm));
  program.set("full_help_mm", static_cast<float>(kFullHelpMm));
  program.set("skin_opacity", static_cast<float>(std::min(1.0, look.skin_opacity)));
  program.set("picture", 0);
  program.set("made_white", needs.made ? kMadeSkinWhite : 0.0f);
}

void uploadColourMap(GLuint texture, ColourMap map) {
  std::vector<ColourBytes> texels(kMapTexels);
  for (int i = 0; i < kMapTexels; ++i) texels[i] = bytesOf(colourOf(map, static_cast<double>(i) / (kMapTexels - 1)));
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, kMapTexels, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void setFingers(const Program& program, std::span<const ShadowCaster> casters) {
  casters = casters.first(std::min(kMaxFingers, casters.size()));
  std::array<Eigen::Vector4f, kMaxFingers> balls;
  std::array<Vec3f, kMaxFingers> tails;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const Vec3f& centre = casters[i].from;
    balls[i] = {centre.x(), centre.y(), centre.z(), casters[i].radius_mm};
    tails[i] = casters[i].to;
  }
  program.set("ball_count", static_cast<int>(casters.size()));
  program.set("ball", std::span<const Eigen::Vector4f>(balls).first(casters.size()));
  program.set("ball_tail", std::span<const Vec3f>(tails).first(casters.size()));
}

void setMarks(const Program& program, std::span<const PressMark> marks) {
  std::array<Eigen::Vector4f, kMaxMarks> places;
  std::array<float, kMaxMarks> strengths{};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Vec3f& place = marks[i].place;
    places[i] = {place.x(), place.y(), place.z(), marks[i].radius_mm};
    strengths[i] = marks[i].strength;
  }
  program.set("mark_count", static_cast<int>(marks.size()));
  program.set("mark", std::span<const Eigen::Vector4f>(places).first(marks.size()));
  program.set("mark_strength", std::span<const float>(strengths).first(marks.size()));
}

void setDents(const Program& program, std::span<const SkinDent> dents) {
  dents = dents.first(std::min(kMaxFingers, dents.size()));
  std::array<Eigen::Vector4f, kMaxFingers> places;
  std::array<Eigen::Vector4f, kMaxFingers> ways;
  for (std::size_t i = 0; i < dents.size(); ++i) {
    places[i] << dents[i].place, dents[i].share;
    ways[i] << dents[i].normal, dents[i].reach_mm;
  }
  program.set("dent_count", static_cast<int>(dents.size()));
  program.set("dent_at", std::span<const Eigen::Vector4f>(places).first(dents.size()));
  program.set("dent_way", std::span<const Eigen::Vector4f>(ways).first(dents.size()));
}

}  // namespace

std::vector<Influence> collectInfluences(const SkinTouch& touch, const Lights& lights) {
  std::vector<Influence> influences;
  for (const ShadowCaster& caster : touch.casters) {
    influences.push_back({caster.from, caster.to, kShadeRadii * caster.radius_mm});
    const float length = std::min(kLongestShadowMm, kShadowRadii * caster.radius_mm);
    const float width = kWidthRadii * caster.radius_mm + kWidening * length;
    for (const Vec3f& end : {caster.from, caster.to, Vec3f(0.5f * (caster.from + caster.to))}) {
      influences.push_back({end, end - length * lights.key, width});
    }
  }
  for (const PressMark& mark : touch.marks)
    influences.push_back({mark.place, mark.place, kMarkRadii * mark.radius_mm + kFarthestDragMm});
  for (const SkinDent& dent : touch.dents)
    if (dent.share > 0.0f) influences.push_back({dent.place, dent.place, 1.3f * dent.reach_mm + kFarthestDragMm});
  return influences;
}

SkinPaint::SkinPaint()
    : field_(program("field", kFieldVertex, kFieldFragment)), depth_(program("depth", kDepthVertex, kDepthFragment)) {}

void SkinPaint::useDepth(const Viewpoint& viewpoint) const {
  depth_.use();
  setViewpoint(depth_, viewpoint);
}

const Program& SkinPaint::gouraudProgram(const SkinNeeds& needs, bool touched) {
  std::optional<Program>& variant = gouraud_[(touched ? 1 : 0) + (needs.picture ? 2 : 0) + (needs.colours ? 4 : 0)];
  if (!variant) variant.emplace(program("gouraud", kGouraudVertex, kGouraudFragment, shaderDefines(needs, touched)));
  return *variant;
}

void SkinPaint::showMap(ColourMap map) {
  if (shown_map_ != map) uploadColourMap(colour_map_.get(), map);
  shown_map_ = map;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, colour_map_.get());
}

void SkinPaint::useField(const Look& look, const Viewpoint& viewpoint) {
  start(field_, look, viewpoint);
  showMap(look.colourMap());
  const ColourRange& range = look.range();
  const double width = range.high - range.low;
  field_.set("low", static_cast<float>(range.low));
  field_.set("per_unit", static_cast<float>(width != 0.0 ? 1.0 / width : 0.0));
  field_.set("strain_percent", look.colouring == Colouring::strain ? 1.0f : 0.0f);
  field_.set("texels", static_cast<float>(kMapTexels));
  field_.set("no_value", Vec3f(Vec3f::Constant(static_cast<float>(kNoColour.red))));
  field_.set("colour_map", 0);
}

const Program& SkinPaint::skinProgram(const SkinNeeds& needs, bool touched) {
  std::optional<Program>& variant =
      skin_[(needs.pores ? 1 : 0) + (touched ? 2 : 0) + (needs.picture ? 4 : 0) + (needs.colours ? 8 : 0)];
  if (!variant) variant.emplace(program("skin", kSkinVertex, kSkinFragment, shaderDefines(needs, touched)));
  return *variant;
}

const Program& SkinPaint::programFor(Shading shading, const SkinNeeds& needs, bool touched) {
  return shading == Shading::gouraud ? gouraudProgram(needs, touched) : skinProgram(needs, touched);
}

void SkinPaint::use(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs) {
  start(programFor(look.shading, needs, false), look, viewpoint, needs);
}

void SkinPaint::useTouched(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs,
                           const SkinTouch& touch) {
  const Program& program = programFor(look.shading, needs, true);
  start(program, look, viewpoint, needs);
  program.set("pixels_a_point", viewpoint.pixels_per_point);
  setFingers(program, touch.casters);
  setMarks(program, touch.marks);
  setDents(program, touch.dents);
}

}  // namespace palpate::view
