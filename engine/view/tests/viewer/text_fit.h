// Texts that a frame of the window cuts off or writes over each other. Found in what is drawn: each letter is a
// rectangle with a place in the font's picture, so a text that no test names is found too.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "palpate/base/text.h"

namespace palpate::viewer {

/// A letter as it was drawn, points.
struct DrawnLetter {
  ImWchar code;
  ImVec2 low, high;
  bool cut;  ///< at its left or right; above and below is scrolling
};

/// The letter whose rectangle of the font's picture holds that of the quad; null for lines and pictures.
inline const ImFontGlyph* findGlyph(const ImDrawVert& low, const ImDrawVert& high) {
  constexpr float kSame = 1e-5f;  // of the font's picture: far less than a pixel
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts) {
    for (const ImFontGlyph& glyph : font->Glyphs) {
      if (glyph.Visible && low.uv.x >= glyph.U0 - kSame && high.uv.x <= glyph.U1 + kSame &&
          low.uv.y >= glyph.V0 - kSame && high.uv.y <= glyph.V1 + kSame && high.uv.x > low.uv.x) {
        return &glyph;
      }
    }
  }
  return nullptr;
}

inline bool cutBySide(const ImDrawVert& low, const ImDrawVert& high, const ImFontGlyph& glyph, const ImVec4& clip) {
  constexpr float kPart = 0.02f;  // of a letter's width
  const float width = glyph.U1 - glyph.U0;
  const bool by_cpu = low.uv.x > glyph.U0 + kPart * width || high.uv.x < glyph.U1 - kPart * width;
  const bool by_gpu = low.pos.x < clip.x - 0.5f || high.pos.x > clip.z + 0.5f;
  const bool is_seen = high.pos.y > clip.y && low.pos.y < clip.w;
  return is_seen && (by_cpu || by_gpu);
}

/// In the order of drawing, which within a text is that of reading.
inline std::vector<DrawnLetter> lettersOf(const ImDrawList& list) {
  constexpr unsigned kQuad = 6;  // corners of the two triangles of a letter
  std::vector<DrawnLetter> letters;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    for (unsigned i = 0; i + kQuad <= command.ElemCount;) {
      const ImDrawIdx* at = &list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
      const bool is_quad =
          at[1] == at[0] + 1 && at[2] == at[0] + 2 && at[3] == at[0] && at[4] == at[2] && at[5] == at[0] + 3;
      i += is_quad ? kQuad : kQuad / 2;
      if (!is_quad) continue;
      const ImDrawVert& low = list.VtxBuffer[static_cast<int>(command.VtxOffset + at[0])];
      const ImDrawVert& high = list.VtxBuffer[static_cast<int>(command.VtxOffset + at[2])];
      if (const ImFontGlyph* glyph = findGlyph(low, high)) {
        letters.push_back({static_cast<ImWchar>(glyph->Codepoint), low.pos, high.pos,
                           cutBySide(low, high, *glyph, command.ClipRect)});
      }
    }
  }
  return letters;
}

/// Letters that stand on one line one after the other.
struct DrawnText {
  std::string words;
  ImVec2 low, high;
  bool cut = false;
};

inline std::vector<DrawnText> collectDrawnTexts(const ImDrawList& list) {
  std::vector<DrawnText> texts;
  for (const DrawnLetter& letter : lettersOf(list)) {
    const float height = ImGui::GetFontSize();
    const bool goes_on =
        !texts.empty() && letter.low.x > texts.back().low.x && letter.low.x < texts.back().high.x + height &&
        letter.low.x > texts.back().high.x - 0.25f * height && letter.low.y < texts.back().high.y + 0.4f * height &&
        letter.high.y > texts.back().low.y - 0.4f * height;
    if (!goes_on) texts.push_back({{}, letter.low, letter.high, false});
    DrawnText& text = texts.back();
    if (goes_on && letter.low.x > text.high.x + 0.2f * height) text.words += ' ';
    char utf8[5] = {};
    ImTextCharToUtf8(utf8, letter.code);
    text.words += utf8;
    text.low = ImMin(text.low, letter.low);
    text.high = ImMax(text.high, letter.high);
    text.cut = text.cut || letter.cut;
  }
  return texts;
}

inline bool writtenOver(const DrawnText& a, const DrawnText& b) {
  const float across = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
  const float along = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
  constexpr float kTouch = 2.0f;                                   // points: letters lean over
  return across > kTouch && along > kTouch && a.words != b.words;  // the same words again: a text with a shadow
}

/// Of a window that neither shows a scroll bar nor room for all that is in it: what is below is never seen. A menu bar
/// stands above what its window counts as room.
inline bool hidesItsEnd(const std::string& name) {
  const ImGuiWindow* window = ImGui::FindWindowByName(name.c_str());
  constexpr float kTouch = 2.0f;  // points: room that letters leave below
  if (window == nullptr || (window->Flags & ImGuiWindowFlags_MenuBar) != 0) return false;
  return (window->Flags & ImGuiWindowFlags_NoScrollbar) != 0 && window->ScrollMax.y > kTouch;
}

struct TextsSeen {
  std::size_t texts = 0;
  std::set<std::string> faults;  ///< one line each: window, text and fault
};

/// Of the frame that was drawn last.
inline TextsSeen textsSeen() {
  TextsSeen seen;
  const ImDrawData* drawn = ImGui::GetDrawData();
  for (int i = 0; i < drawn->CmdListsCount; ++i) {
    const ImDrawList& list = *drawn->CmdLists[i];
    const std::string window = list._OwnerName == nullptr ? "picture" : list._OwnerName;
    const std::vector<DrawnText> texts = collectDrawnTexts(list);
    seen.texts += texts.size();
    if (hidesItsEnd(window)) seen.faults.insert(window + ": is too low for what is in it");
    for (std::size_t k = 0; k < texts.size(); ++k) {
      if (texts[k].cut) seen.faults.insert(window + ": \"" + texts[k].words + "\" is cut");
      for (std::size_t j = k + 1; j < texts.size(); ++j) {
        if (writtenOver(texts[k], texts[j]))
          seen.faults.insert(window + ": \"" + texts[k].words + "\" over \"" + texts[j].words + "\"");
      }
    }
  }
  return seen;
}

/// Fails for each fault of the frame that was drawn last. tools/check-translations counts the lines "overflow: ...".
inline void expectTextsFit(const std::string& language, const std::string& what) {
  constexpr std::size_t kFew = 3;  // fewer are on no screen: letters are no longer found
  const TextsSeen seen = textsSeen();
  EXPECT_GE(seen.texts, kFew) << what << ": letters are no longer found in what is drawn";
  for (const std::string& fault : seen.faults) {
    std::cout << "overflow: " << language << ", " << what << ", " << fault << "\n";
    ADD_FAILURE() << what << ": " << fault;
  }
}

}  // namespace palpate::viewer
