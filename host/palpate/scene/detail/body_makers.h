// What makes built-in bodies, named by what is in its sources: a body of other makers is another body.
#pragma once

#include <string_view>

namespace palpate::scene {

/// One line. The build writes it (cmake/body_makers.cmake).
std::string_view bodyMakers();

}  // namespace palpate::scene
