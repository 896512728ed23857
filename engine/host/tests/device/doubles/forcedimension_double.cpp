// A double of Force Dimension's libdhd over two simulated devices. With PALPATE_DOUBLE_IS_OLD it lacks what old
// libraries lack. Asking for a position twice within one turn of the control is "too soon", as with the real one.
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <thread>

#include "host/tests/device/doubles/double_control.h"

using palpate::doubles::DoubleControl;
using palpate::doubles::DoubleDevice;

namespace {

constexpr double kExchangeS = 0.0005;
constexpr double kUnitM = 1.0;

DoubleControl& control() {
  static DoubleControl* const only = [] {
    auto* made = new DoubleControl;
    palpate::doubles::readSettings(*made);
    made->count = made->count.load();
    return made;
  }();
  return *only;
}

bool exists(int index) {
  return index >= 0 && index < control().count && control().devices[static_cast<std::size_t>(index)].connected;
}
DoubleDevice& at(char id) { return control().devices[static_cast<unsigned char>(id)]; }

/// N, whether its motors were on or not.
std::array<double, 3>& told(char id) {
  static std::array<std::array<double, 3>, 2> forces{};
  return forces.at(static_cast<unsigned char>(id));
}

void countIfStray(char id) {
  if (!at(id).open) ++control().stray_calls;
}

/// An exchange with a device that may have gone, or be slow.
bool answers(char id) {
  countIfStray(id);
  if (control().slow_us > 0) std::this_thread::sleep_for(std::chrono::microseconds(control().slow_us));
  return exists(id) && at(id).open && at(id).error == 0;
}

}  // namespace

extern "C" {

DoubleControl* palpateDouble() { return &control(); }

int dhdGetDeviceCount() {
  int count = 0;
  for (int index = 0; index < 2; ++index) count += exists(index) ? 1 : 0;
  return count;
}

int dhdOpenID(char index) {
  if (control().refusal != 0 || !exists(index)) return -1;
  at(index).open = true;
  at(index).forces_on = false;
  return index;
}

int dhdClose(char id) {
  countIfStray(id);
  at(id).open = false;
  at(id).forces_on = false;
  for (auto& force : at(id).force) force = 0.0;
  return 0;
}

int dhdEnableForce(unsigned char on, char id) {
  countIfStray(id);
  DoubleDevice& self = at(id);
  self.forces_on = on != 0;
  // A motor that is switched on has the force that it was last told.
  for (std::size_t axis = 0; axis < 3; ++axis) self.force[axis] = self.forces_on ? told(id)[axis] : 0.0;
  return 0;
}

int dhdGetPosition(double* x, double* y, double* z, char id) {
  if (!answers(id)) return -1;
  DoubleDevice& self = at(id);
  self.frames = self.frames + 1;
  *x = self.place[0];
  *y = self.place[1];
  *z = self.gives_no_number ? std::numeric_limits<double>::quiet_NaN() : self.place[2].load();
  return control().stands ? 1 : 0;
}

int dhdSetForce(double x, double y, double z, char id) {
  if (!answers(id)) return -1;
  DoubleDevice& self = at(id);
  told(id) = {x, y, z};
  for (std::size_t axis = 0; axis < 3; ++axis) self.force[axis] = self.forces_on ? told(id)[axis] : 0.0;
  palpate::doubles::move(self, kExchangeS, kUnitM);
  return x * x + y * y + z * z > 144.0 ? 2 : 0;
}

#ifndef PALPATE_DOUBLE_IS_OLD
int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  if (!answers(id)) return -1;
  *x = at(id).speed[0];
  *y = at(id).speed[1];
  *z = at(id).speed[2];
  return 0;
}
unsigned dhdGetButtonMask(char id) { return at(id).buttons; }
int dhdGetSystemType(char) { return 33; }
const char* dhdGetSystemName(char) { return "omega.3"; }
void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = control().major;
  *minor = 17;
  *release = 6;
  *revision = 0;
}
#endif
const char* dhdErrorGetLastStr() { return control().refusal != 0 ? "no permission" : "communication error"; }

}  // extern "C"
