// What a control says when it is pointed at, for those whose row has no words of its own: menus, buttons, fields. A
// number says its range itself (widgets.h), a key of the scene file what the file's reference says, an item of the
// table of keys its sentence (keys.h).
#pragma once

#include <string_view>

namespace palpate::viewer {

/// By the control's path, as tests know it; empty where there is no row.
std::string_view controlWords(std::string_view path);

}  // namespace palpate::viewer
