// ImGui's draw lists in a context of its own, current only while a page is begun, ended or shown. One atlas has the
// letters of all three sizes at the scale of the page; the assembler embeds the font's file in the program.
#include "palpate/view/layers/drawing.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <array>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/view/layers/embedded_file.h"

PALPATE_EMBED(palpate_font, PALPATE_FONT_FILE);  // NOLINT(readability-identifier-naming); CMake finds the file

namespace palpate::view {

std::span<const unsigned char> embeddedFont() { return {palpate_font_begin, palpate_font_end}; }

const std::uint16_t* fontRanges() {
  // Latin 1; dashes and minus; arrows; the Greek capital delta.
  static constexpr std::uint16_t kRanges[] = {0x0020, 0x00FF, 0x2013, 0x2014, 0x2026, 0x2026, 0x2190,
                                              0x2193, 0x2212, 0x2212, 0x0394, 0x0394, 0};
  return kRanges;
}

namespace {

/// Heights of the lines of text, points. The order is that of TextSize.
constexpr std::array<float, 3> kTextPoints = {12.0f, 14.0f, 18.0f};

ImVec2 at(const Vec2f& v) { return {v.x(), v.y()}; }

ImU32 packed(const Ink& ink) {
  return IM_COL32(ink.colour[0], ink.colour[1], ink.colour[2], std::lround(255.0 * ink.opacity));
}

const char* textEnd(std::string_view words) { return words.data() + words.size(); }

/// Makes a context current for as long as it lives.
class Inside {
 public:
  explicit Inside(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(context); }
  ~Inside() { ImGui::SetCurrentContext(before_); }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  ImGuiContext* before_;
};

}  // namespace

struct Drawing::Impl {
  ImGuiContext* context = nullptr;
  ImDrawList* list = nullptr;
  std::array<ImFont*, kTextPoints.size()> fonts{};
  double scale = 0.0;

  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  void makeLetters(double pixels_per_point);
  ImFont* font(TextSize size) const { return fonts[static_cast<std::size_t>(size)]; }
};

Drawing::Impl::Impl() {
  const Inside inside(ImGui::GetCurrentContext());  // making a context may make it current
  context = ImGui::CreateContext();
  ImGui::SetCurrentContext(context);
  ImGui::GetIO().IniFilename = nullptr;
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext(context);
    throw Error("cannot draw text: the OpenGL functions cannot be loaded");
  }
}

Drawing::Impl::~Impl() {
  const Inside inside(context);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context);
}

void Drawing::Impl::makeLetters(double pixels_per_point) {
  if (pixels_per_point == scale) return;
  scale = pixels_per_point;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  const auto file = embeddedFont();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  for (std::size_t i = 0; i < fonts.size(); ++i) {
    // The atlas only reads the file, although its parameter could own it.
    fonts[i] = atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(file.data()), static_cast<int>(file.size()),
                                          kTextPoints[i] * static_cast<float>(scale), &config, fontRanges());
  }
  atlas.Build();
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

Drawing::Drawing() : impl_(std::make_unique<Impl>()) {}
Drawing::~Drawing() = default;

void Drawing::begin(const Vec2f& size, double scale) {
  const Inside inside(impl_->context);
  size_ = size;
  impl_->makeLetters(scale);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = at(size);
  io.DeltaTime = 1.0f / 60.0f;  // nothing here moves by itself
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  impl_->list = ImGui::GetBackgroundDrawList();
  // Edges are softened over a pixel, not over a point.
  impl_->list->_FringeScale = 1.0f / static_cast<float>(scale);
}

void Drawing::end() {
  const Inside inside(impl_->context);
  ImGui::Render();
  impl_->list = nullptr;
}

void Drawing::present(int width, int height) const { present(width, height, Vec2f::Zero(), size_); }

void Drawing::present(int width, int height, const Vec2f& corner, const Vec2f& whole) const {
  const Inside inside(impl_->context);
  ImDrawData& data = *ImGui::GetDrawData();
  data.DisplayPos = at(-corner);
  data.DisplaySize = at(whole);
  data.FramebufferScale = {static_cast<float>(width) / whole.x(), static_cast<float>(height) / whole.y()};
  ImGui_ImplOpenGL3_RenderDrawData(&data);
}

void Drawing::line(const Vec2f& from, const Vec2f& to, const Ink& ink, float thickness) {
  impl_->list->AddLine(at(from), at(to), packed(ink), thickness);
}

void Drawing::curve(std::span<const Vec2f> points, const Ink& ink, float thickness) {
  static_assert(sizeof(Vec2f) == sizeof(ImVec2));
  impl_->list->AddPolyline(reinterpret_cast<const ImVec2*>(points.data()), static_cast<int>(points.size()), packed(ink),
                           ImDrawFlags_None, thickness);
}

void Drawing::box(const Vec2f& corner, const Vec2f& opposite, const Ink& ink, float rounding) {
  impl_->list->AddRectFilled(at(corner), at(opposite), packed(ink), rounding);
}

void Drawing::frame(const Vec2f& corner, const Vec2f& opposite, const Ink& ink, float rounding) {
  impl_->list->AddRect(at(corner), at(opposite), packed(ink), rounding);
}

void Drawing::triangle(const Vec2f& a, const Vec2f& b, const Vec2f& c, const Ink& ink) {
  impl_->list->AddTriangleFilled(at(a), at(b), at(c), packed(ink));
}

void Drawing::convex(std::span<const Vec2f> points, const Ink& ink) {
  if (points.size() < 3) return;
  impl_->list->AddConvexPolyFilled(reinterpret_cast<const ImVec2*>(points.data()), static_cast<int>(points.size()),
                                   packed(ink));
}

void Drawing::disc(const Vec2f& middle, float radius, const Ink& ink) {
  impl_->list->AddCircleFilled(at(middle), radius, packed(ink));
}

void Drawing::ring(const Vec2f& middle, float radius, const Ink& ink, float thickness) {
  impl_->list->AddCircle(at(middle), radius, packed(ink), 0, thickness);
}

void Drawing::text(const Vec2f& place, std::string_view words, const Ink& ink, Align align, TextSize size) {
  const float width = measure(words, size).x();
  const float left = align == Align::left ? 0.0f : align == Align::centre ? 0.5f * width : width;
  // Letters start on whole points: those of a supersampled picture are then reduced alike.
  const ImVec2 start{std::round(place.x() - left), std::round(place.y())};
  impl_->list->AddText(impl_->font(size), kTextPoints[static_cast<std::size_t>(size)], start, packed(ink), words.data(),
                       textEnd(words));
}

Vec2f Drawing::measure(std::string_view words, TextSize size) const {
  const float points = kTextPoints[static_cast<std::size_t>(size)];
  const ImVec2 extent = impl_->font(size)->CalcTextSizeA(points, INFINITY, 0.0f, words.data(), textEnd(words));
  return {extent.x, extent.y};
}

}  // namespace palpate::view
