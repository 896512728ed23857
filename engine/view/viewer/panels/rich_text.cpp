#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "palpate/base/text.h"
#include "palpate/window/gui.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kIndent = 20.0f;  ///< for a list, points

ImU32 linkInk() { return isLightTheme() ? IM_COL32(20, 80, 190, 255) : IM_COL32(130, 180, 255, 255); }
ImU32 strongInk() { return isLightTheme() ? IM_COL32(0, 0, 0, 255) : IM_COL32(255, 225, 170, 255); }

ImU32 inlineInk(Inline::Kind kind) {
  if (kind == Inline::Kind::link) return linkInk();
  return kind == Inline::Kind::strong ? strongInk() : ImGui::GetColorU32(ImGuiCol_Text);
}

/// Text from the cursor to the right end of the available width.
class Flow {
 public:
  Flow() : start_(ImGui::GetCursorScreenPos()), width_(std::max(40.0f, ImGui::GetContentRegionAvail().x)) {}

  void add(const Inline& words) {
    ImFont* font = words.kind == Inline::Kind::code ? window::evenFont() : ImGui::GetFont();
    bool first = true;
    for (const std::string_view word : split(words.text, ' ')) {
      if (!std::exchange(first, false)) space_ = true;
      if (!word.empty()) addWord(words, word, font);
    }
  }
  /// Takes up the room; returns the clicked link.
  std::string finish() {
    ImGui::Dummy({width_, y_ + lineHeight()});
    return clicked_;
  }

 private:
  static float lineHeight() { return ImGui::GetFontSize() + 3.0f; }

  void addWord(const Inline& words, std::string_view word, ImFont* font) {
    const float size = ImGui::GetFontSize();
    const char* end = word.data() + word.size();
    const ImVec2 extent = font->CalcTextSizeA(size, FLT_MAX, 0.0f, word.data(), end);
    if (space_ && x_ > 0.0f) x_ += ImGui::CalcTextSize(" ").x;
    if (x_ > 0.0f && x_ + extent.x > width_ && (space_ || extent.x > width_)) newLine();
    space_ = false;
    const ImVec2 at(start_.x + x_, start_.y + y_);
    const ImVec2 high(at.x + extent.x, at.y + lineHeight());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (words.kind == Inline::Kind::code) list.AddRectFilled(at, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 2.0f);
    if (words.kind == Inline::Kind::link) link(words, at, high);
    list.AddText(font, size, at, inlineInk(words.kind), word.data(), end);
    x_ += extent.x;
  }
  void newLine() {
    x_ = 0.0f;
    y_ += lineHeight();
  }
  void link(const Inline& words, const ImVec2& low, const ImVec2& high) {
    widgetPlaces()["manual/link/" + words.target] = {low.x, low.y, high.x, high.y};
    if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect(low, high)) return;
    ImGui::GetWindowDrawList()->AddLine({low.x, high.y - 2.0f}, {high.x, high.y - 2.0f}, linkInk());
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) clicked_ = words.target;
  }

  ImVec2 start_;
  float width_;
  float x_ = 0.0f;
  float y_ = 0.0f;
  bool space_ = false;  // before the next word
  std::string clicked_;
};

std::string drawInlines(const Inlines& words) {
  Flow flow;
  for (const Inline& part : words) flow.add(part);
  return flow.finish();
}

std::string headingBlock(const Block& block, const std::string& to_anchor) {
  constexpr std::array<float, 4> kScales = {1.5f, 1.25f, 1.1f, 1.0f};
  ImGui::Spacing();
  if (!to_anchor.empty() && headingAnchor(plainText(block.words)) == to_anchor) ImGui::SetScrollHereY(0.0f);
  ImGui::SetWindowFontScale(kScales.at(static_cast<std::size_t>(std::clamp(block.level, 1, 4) - 1)));
  const std::string clicked = drawInlines(block.words);
  ImGui::SetWindowFontScale(1.0f);
  if (block.level <= 2) ImGui::Separator();
  return clicked;
}

/// Fits its longest line; scrolls where there is less room.
void codeBlock(const Block& block, int number) {
  const auto lines = static_cast<float>(1 + std::count(block.text.begin(), block.text.end(), '\n'));
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushFont(window::evenFont());
  const bool wide =
      ImGui::CalcTextSize(block.text.c_str()).x + 2.0f * style.WindowPadding.x > ImGui::GetContentRegionAvail().x;
  const float height =
      lines * ImGui::GetTextLineHeight() + 2.0f * style.WindowPadding.y + (wide ? style.ScrollbarSize : 0.0f);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, 0.0f});
  if (ImGui::BeginChild(fmt::format("code{}", number).c_str(), {0.0f, height}, true,
                        ImGuiWindowFlags_HorizontalScrollbar | (wide ? 0 : ImGuiWindowFlags_NoScrollWithMouse))) {
    ImGui::TextUnformatted(block.text.c_str(), block.text.c_str() + block.text.size());
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

/// Widths follow the columns' contents, none much narrower than another.
void setUpColumns(const Block& table, std::size_t columns) {
  for (std::size_t column = 0; column < columns; ++column) {
    std::size_t longest = 6;
    for (const auto& row : table.rows) {
      if (column < row.size()) longest = std::max(longest, plainText(row[column]).size());
    }
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch,
                            static_cast<float>(std::min<std::size_t>(longest, 60)));
  }
}

std::string tableBlock(const Block& block, int number) {
  std::size_t columns = 1;
  for (const auto& row : block.rows) columns = std::max(columns, row.size());
  std::string clicked;
  constexpr auto kLines = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable(fmt::format("table{}", number).c_str(), static_cast<int>(columns), kLines)) return clicked;
  setUpColumns(block, columns);
  for (const auto& row : block.rows) {
    ImGui::TableNextRow();
    for (const Inlines& cell : row) {
      ImGui::TableNextColumn();
      if (std::string target = drawInlines(cell); !target.empty()) clicked = std::move(target);
    }
  }
  ImGui::EndTable();
  return clicked;
}

std::string itemBlock(const Block& block) {
  const float indent = kIndent * static_cast<float>(block.level);
  ImGui::Indent(indent + 1.0f);
  ImGui::TextUnformatted(block.marker == "-" ? "\xC2\xB7" : block.marker.c_str());  // a middle dot
  ImGui::SameLine(0.0f, 8.0f);
  const std::string clicked = drawInlines(block.words);
  ImGui::Unindent(indent + 1.0f);
  return clicked;
}

std::string paragraphBlock(const Block& block) {
  const float indent = kIndent * static_cast<float>(block.level) + 1.0f;
  ImGui::Indent(indent);
  const std::string clicked = drawInlines(block.words);
  ImGui::Unindent(indent);
  ImGui::Spacing();
  return clicked;
}

std::string drawBlock(const Block& block, int number, const std::string& to_anchor) {
  switch (block.kind) {
    case Block::Kind::heading:
      return headingBlock(block, to_anchor);
    case Block::Kind::code:
      codeBlock(block, number);
      return {};
    case Block::Kind::table:
      return tableBlock(block, number);
    case Block::Kind::item:
      return itemBlock(block);
    default:
      return paragraphBlock(block);
  }
}

}  // namespace

std::string drawBlocks(const std::vector<Block>& blocks, const std::string& to_anchor) {
  std::string clicked;
  int number = 0;
  for (const Block& block : blocks) {
    if (std::string target = drawBlock(block, number++, to_anchor); !target.empty()) clicked = std::move(target);
  }
  return clicked;
}

}  // namespace palpate::viewer
