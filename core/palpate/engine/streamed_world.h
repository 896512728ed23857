// A world and its fingers as contact_stream.h sends them.
#pragma once

#include <span>
#include <string>

#include "palpate/engine/contact_stream.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::engine {

/// The skin with what the breath makes of it. Cold.
std::string encodedSkinOf(const scene::World& world);

/// The forms that LivingSkin has for so many fingers, strain included.
std::string encodedFormsOf(const scene::World& world, std::size_t fingers);

/// A frame with room for so many fingers and their dents.
StreamedFrame frameFor(std::size_t fingers);

/// What these samples of one tick make of the skin; `frame` comes from frameFor. No allocation.
void fillFrame(const scene::World& world, std::span<const trace::Sample> samples, StreamedFrame& frame) noexcept;

}  // namespace palpate::engine
