// The dissertation's haptic process as a source of contact: a finger that collides only with the triangles that the
// haptic detecting box (HDB) found around its proxy.
//
// The default finger (contact/finger.h) walks on the whole surface; this one sees a loose list of triangles, as the
// haptic toolkit of the dissertation was handed one, and has the weaknesses of that: a finger that moves farther than
// half an edge of the box before the box follows passes the skin unseen (E12). Its answer means the same as the default
// finger's.
#pragma once

#include "palpate/contact/finger.h"
#include "palpate/hdb/hdb_candidates.h"

namespace palpate::hdb {

/// One tick. In `state`, `centre` is the god object while it touches and `proxy` the skin's point under it; a state of
/// contact::step does not serve here. Radius 0 only; force shading and the too-deep search of the default finger do not
/// exist here. `lumps` as contact::step has it. noexcept, no allocation, no lock. Any thread, one at a time per state
/// and candidates.
contact::FingerOutput stepHdb(const contact::Surface& surface, const contact::FingerSettings& settings,
                              HdbCandidates& candidates, contact::FingerState& state, const Vec3& tip,
                              const contact::LumpPlaces* lumps = nullptr) noexcept;

}  // namespace palpate::hdb
