// How the force of a press that is held falls in time, and how the dent comes back afterwards: viscous skin.
//
//   instant law F = k h(d) ─ relax ─► F = k max(0, h(d) - sum g_i x_i) ─► friction ─► force; rest depth ─► deform
//
// A law F = k h(d) (tissue/force_law.h) is what the skin answers at once. Each term of Relaxation remembers an *eased
// depth* x_i, an effective depth like h, that follows what the skin holds: x_i' = (s - x_i) / t_i, with
// s = max(h(d), sum g_j x_j). So a press that is held pushes 1 - g as hard in the end, with g the sum of the shares; a
// finger that leaves faster than the skin follows is released at the depth sum g_i x_i, where the skin stays behind,
// and the skin recovers: s is then the skin's own depth and falls with t / (1 - g).
//
// It makes no energy. Let H be the integral of h and H* that of its inverse (its convex conjugate), and D the depth at
// which h(D) = s: that of the finger where it presses, that of the skin where it does not. What is stored is
//
//   V = k [ (1 - g) H(D) + sum g_i (H(D) + H*(x_i) - x_i D) ],  g < 1
//
// whose terms are not negative (Young's inequality: h does not decrease) and zero for skin at rest. While the finger
// presses, dV/dt = F dd/dt - k sum g_i (h(D) - x_i)(D - h^-1(x_i)) / t_i, and the two factors have one sign: what the
// hand puts in is stored or lost. While it does not, dV/dD = k (s - sum g_i x_i) = 0, and V falls by the same sum. That
// needs a law that does not decrease and nothing else, so it holds for every kind, with a soft toe (servo) as with
// force shading, and for two terms as for one.
//
// Sampled, s counts as constant over a tick, which makes the step exact and stable at any rate: an x_i goes part of the
// way to s and never beyond. What sampling a spring gives away is the observer's affair (servo/passivity.h), as ever.
//
// Moving contacts: the memory goes with the finger while it presses, though fresh skin would push a little harder.
// Forgetting it there would raise the force without work. A place stiffer or of another thickness changes k and h,
// which gives and takes as the law without time does. A finger that comes free leaves the memory at the place as a
// dent; when it lands again it feels of that dent what is under it, and forgets the rest. Where nothing presses the
// stored energy falls when all x_i shrink by one factor, so to forget is passive there: for one term under every law
// (dV/dx is k g (h^-1(x) - D), and x >= s), for two where h is a power of the depth (V is one of that factor).
//
// Based on: the standard linear solid; the energy argument is our own.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"
#include "palpate/tissue/force_law.h"

namespace palpate::contact {

/// A finger that lands farther than this from the dent it left feels nothing of it, mm: beyond, that press left the
/// skin as it was (deform::TissueSettings::normal_radius_mm).
inline constexpr double kDentReachMm = 13.0;

/// A tick's response after relaxation.
struct Relaxed {
  double rest_mm = 0.0;          ///< sum g_i x_i: the effective depth at which the skin would stay
  double change_mm = 0.0;        ///< how far that moved since the last tick, not less
  double share = 1.0;            ///< of the force at once that is left
  tissue::Response tissue = {};  ///< as the finger feels it
};

/// The response of a skin of this stiffness, relaxed, to a finger that presses at `place`; moves the memory on by a
/// tick. Relaxation must be on.
Relaxed relaxed(const FingerSettings& settings, const tissue::Response& instant, double stiffness_n_per_mm,
                const Vec3& place, SkinMemory& memory) noexcept;

/// A tick in which the finger is free: the dent that it left comes back. `left_at`: where the last press was.
void recover(const Surface& surface, const FingerSettings& settings, const SurfacePoint& left_at,
             SkinMemory& memory) noexcept;

/// Whether there is anything to forget.
inline bool remembers(const SkinMemory& memory) noexcept {
  return memory.dent.rest_mm > 0.0 || memory.under_mm[0] > 0.0 || memory.under_mm[1] > 0.0;
}

}  // namespace palpate::contact
