// Work that must not disturb what draws or touches.
#pragma once

namespace palpate {

/// Whatever draws or touches goes before the calling thread from now on: its nice value becomes `nice`, 1 to 19.
/// Nothing happens where a thread has no priority of its own and the whole process would be slowed (all but Linux).
void lowerPriority(int nice);

}  // namespace palpate
