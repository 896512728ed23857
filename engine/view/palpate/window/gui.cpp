// Events become the one state per frame that this ImGui wants; its text fields get keys by a map from our numbers.
// Letters are made in pixels and laid out in points.
// Data flow: InputEvent -> here -> the caller's panels -> triangles -> any framebuffer. 60 Hz.
#include "palpate/window/gui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/view/layers/drawing.h"

#include "palpate/view/layers/embedded_file.h"

// DejaVu Sans Mono, with the same licence as the DejaVu Sans of drawing.h.
PALPATE_EMBED(palpate_even_font, PALPATE_EVEN_FONT_FILE);  // NOLINT(readability-identifier-naming)

namespace palpate::window {

namespace {

constexpr float kTextPoints = 15.0f;
constexpr float kTitlePoints = 25.0f;
constexpr float kEvenPoints = 13.0f;

/// Neutral greys: a tinted frame would change how the colours of a map look.
void useDark(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  ImVec4* c = style.Colors;
  c[ImGuiCol_WindowBg] = {0.13f, 0.13f, 0.14f, 0.94f};
  c[ImGuiCol_PopupBg] = {0.11f, 0.11f, 0.12f, 0.98f};
  c[ImGuiCol_Text] = {0.92f, 0.92f, 0.92f, 1.0f};
  c[ImGuiCol_TextDisabled] = {0.64f, 0.64f, 0.65f, 1.0f};
  c[ImGuiCol_FrameBg] = {0.22f, 0.22f, 0.23f, 1.0f};
  c[ImGuiCol_FrameBgHovered] = {0.30f, 0.30f, 0.31f, 1.0f};
  c[ImGuiCol_FrameBgActive] = {0.36f, 0.36f, 0.37f, 1.0f};
  c[ImGuiCol_Header] = {0.24f, 0.24f, 0.25f, 1.0f};
  c[ImGuiCol_HeaderHovered] = {0.32f, 0.32f, 0.33f, 1.0f};
  c[ImGuiCol_HeaderActive] = {0.38f, 0.38f, 0.39f, 1.0f};
  c[ImGuiCol_Button] = {0.28f, 0.28f, 0.29f, 1.0f};
  c[ImGuiCol_ButtonHovered] = {0.38f, 0.38f, 0.39f, 1.0f};
  c[ImGuiCol_ButtonActive] = {0.45f, 0.45f, 0.46f, 1.0f};
  // Dark enough to read the number over it.
  c[ImGuiCol_SliderGrab] = {0.44f, 0.44f, 0.45f, 1.0f};
  c[ImGuiCol_SliderGrabActive] = {0.54f, 0.54f, 0.55f, 1.0f};
  c[ImGuiCol_CheckMark] = {0.95f, 0.72f, 0.36f, 1.0f};
  c[ImGuiCol_MenuBarBg] = {0.10f, 0.10f, 0.11f, 1.0f};
  c[ImGuiCol_TitleBgActive] = {0.18f, 0.18f, 0.19f, 1.0f};
  c[ImGuiCol_PlotHistogram] = {0.95f, 0.72f, 0.36f, 1.0f};
}

/// Grey text as readable as on the dark theme.
void useLight(ImGuiStyle& style) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_TextDisabled] = {0.36f, 0.36f, 0.37f, 1.0f};
  style.Colors[ImGuiCol_CheckMark] = {0.05f, 0.33f, 0.75f, 1.0f};
}

void useContrast(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  ImVec4* c = style.Colors;
  c[ImGuiCol_WindowBg] = c[ImGuiCol_PopupBg] = c[ImGuiCol_MenuBarBg] = {0.0f, 0.0f, 0.0f, 1.0f};
  c[ImGuiCol_Text] = {1.0f, 1.0f, 1.0f, 1.0f};
  c[ImGuiCol_TextDisabled] = {0.75f, 0.75f, 0.75f, 1.0f};
  c[ImGuiCol_Border] = {1.0f, 1.0f, 1.0f, 1.0f};
  c[ImGuiCol_FrameBg] = {0.0f, 0.0f, 0.0f, 1.0f};
  c[ImGuiCol_CheckMark] = {1.0f, 1.0f, 0.0f, 1.0f};
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = {0.0f, 0.35f, 0.85f, 1.0f};  // under a white number
  style.FrameBorderSize = 1.0f;
}

void shape(ImGuiStyle& style) {
  style.WindowRounding = 4.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.ScrollbarSize = 12.0f;
  style.WindowBorderSize = 0.0f;
  style.ItemSpacing = {8.0f, 5.0f};
}

/// The keys that ImGui's text fields need.
void mapKeys(ImGuiIO& io) {
  const auto map = [&](ImGuiKey theirs, Key ours) { io.KeyMap[theirs] = static_cast<int>(ours); };
  map(ImGuiKey_Tab, Key::tab);
  map(ImGuiKey_LeftArrow, Key::left);
  map(ImGuiKey_RightArrow, Key::right);
  map(ImGuiKey_UpArrow, Key::up);
  map(ImGuiKey_DownArrow, Key::down);
  map(ImGuiKey_PageUp, Key::page_up);
  map(ImGuiKey_PageDown, Key::page_down);
  map(ImGuiKey_Home, Key::home);
  map(ImGuiKey_End, Key::end);
  map(ImGuiKey_Delete, Key::delete_key);
  map(ImGuiKey_Backspace, Key::backspace);
  map(ImGuiKey_Space, Key::space);
  map(ImGuiKey_Enter, Key::enter);
  map(ImGuiKey_KeyPadEnter, Key::pad_enter);
  map(ImGuiKey_Escape, Key::escape);
  for (const auto& [theirs, letter] :
       {std::pair{ImGuiKey_A, 'A'}, std::pair{ImGuiKey_C, 'C'}, std::pair{ImGuiKey_V, 'V'}, std::pair{ImGuiKey_X, 'X'},
        std::pair{ImGuiKey_Y, 'Y'}, std::pair{ImGuiKey_Z, 'Z'}}) {
    map(theirs, key(letter));
  }
}

/// The name of the window that a list draws.
std::string_view ownerName(const ImDrawList& list) { return list._OwnerName == nullptr ? "" : list._OwnerName; }

}  // namespace

struct Gui::Impl {
  ImGuiContext* context = nullptr;
  double scale = 0.0;
  bool large_letters = false;
  std::array<bool, kButtons> down{};

  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  void makeLetters(double pixels_per_point);
  void feed(std::span<const InputEvent> events);
  void feed(const InputEvent& event);
};

Gui::Impl::Impl() {
  context = ImGui::CreateContext();
  ImGui::SetCurrentContext(context);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  mapKeys(io);
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) {
    ImGui::DestroyContext(context);
    throw Error("cannot draw panels: the OpenGL functions cannot be loaded");
  }
}

Gui::Impl::~Impl() {
  ImGui::SetCurrentContext(context);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context);
}

void Gui::Impl::makeLetters(double pixels_per_point) {
  if (pixels_per_point == scale) return;
  scale = pixels_per_point;
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  const auto file = view::embeddedFont();
  io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(file.data()), static_cast<int>(file.size()),
                                 kTextPoints * static_cast<float>(scale), &config, view::fontRanges());
  // Latin 1, dashes, arrows, lines of boxes, and the triangles that end them.
  static constexpr ImWchar kEvenRanges[] = {0x0020, 0x00FF, 0x2013, 0x2014, 0x2026, 0x2026, 0x2190, 0x2193, 0x2212,
                                            0x2212, 0x2500, 0x257F, 0x25BA, 0x25BA, 0x25C4, 0x25C4, 0};
  io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(palpate_even_font_begin),
                                 static_cast<int>(palpate_even_font_end - palpate_even_font_begin),
                                 kEvenPoints * static_cast<float>(scale), &config, kEvenRanges);
  if (large_letters) {
    io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(file.data()), static_cast<int>(file.size()),
                                   kTitlePoints * static_cast<float>(scale), &config, view::fontRanges());
  }
  io.Fonts->Build();
  io.FontGlobalScale = 1.0f / static_cast<float>(scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::Impl::feed(std::span<const InputEvent> events) {
  for (const InputEvent& event : events) feed(event);
  std::copy(down.begin(), down.end(), ImGui::GetIO().MouseDown);
}

void Gui::Impl::feed(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  ImGuiIO& io = ImGui::GetIO();
  const bool has_place = event.kind == Kind::move || event.kind == Kind::button || event.kind == Kind::scroll;
  if (has_place) io.MousePos = {static_cast<float>(event.at.x() / scale), static_cast<float>(event.at.y() / scale)};
  if (event.kind == Kind::button) down[static_cast<std::size_t>(event.button)] = event.down;
  if (event.kind == Kind::scroll) io.MouseWheel += static_cast<float>(event.notches);
  if (event.kind == Kind::text) io.AddInputCharactersUTF8(event.text.c_str());
  if (event.kind == Kind::key) {
    const auto code = static_cast<std::size_t>(event.key);
    if (code < std::size(io.KeysDown)) io.KeysDown[code] = event.down;
    io.KeyCtrl = event.modifiers.ctrl;
    io.KeyShift = event.modifiers.shift;
  }
  if (event.kind == Kind::focus && !event.down) {
    down.fill(false);
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    io.KeyCtrl = io.KeyShift = false;
  }
}

Gui::Gui() : impl_(std::make_unique<Impl>()) { setTheme(Theme::dark); }
Gui::~Gui() = default;

void Gui::begin(const Vec2& size_points, double scale, double elapsed_s, std::span<const InputEvent> events) {
  ImGui::SetCurrentContext(impl_->context);
  impl_->makeLetters(scale);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size_points.x()), static_cast<float>(size_points.y())};
  io.DeltaTime = static_cast<float>(std::max(elapsed_s, 1e-4));
  impl_->feed(events);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Gui::end() {
  ImGui::SetCurrentContext(impl_->context);
  ImGui::Render();
}

void Gui::present(int width, int height, Choice choice) const {
  ImGuiContext* before = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(impl_->context);
  ImDrawData data = *ImGui::GetDrawData();
  std::vector<ImDrawList*> chosen;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    if (choice == nullptr || choice(ownerName(*data.CmdLists[i]))) chosen.push_back(data.CmdLists[i]);
  }
  data.CmdLists = chosen.data();
  data.CmdListsCount = static_cast<int>(chosen.size());
  data.FramebufferScale = {static_cast<float>(width) / data.DisplaySize.x,
                           static_cast<float>(height) / data.DisplaySize.y};
  ImGui_ImplOpenGL3_RenderDrawData(&data);
  ImGui::SetCurrentContext(before);
}

bool Gui::leavesOut(Choice choice) const {
  ImGui::SetCurrentContext(impl_->context);
  const ImDrawData& data = *ImGui::GetDrawData();
  return std::any_of(data.CmdLists, data.CmdLists + data.CmdListsCount,
                     [&](const ImDrawList* list) { return !choice(ownerName(*list)); });
}

void Gui::setTheme(Theme theme) {
  ImGui::SetCurrentContext(impl_->context);
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();  // themes start from the same shapes
  shape(style);
  if (theme == Theme::dark) useDark(style);
  if (theme == Theme::light) useLight(style);
  if (theme == Theme::contrast) useContrast(style);
}

ImFont* evenFont() { return ImGui::GetIO().Fonts->Fonts[1]; }

void Gui::useLargeLetters() {
  impl_->large_letters = true;
  impl_->scale = 0.0;
}

bool Gui::wantsMouse() const {
  ImGui::SetCurrentContext(impl_->context);
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsText() const {
  ImGui::SetCurrentContext(impl_->context);
  return ImGui::GetIO().WantTextInput;
}

}  // namespace palpate::window
