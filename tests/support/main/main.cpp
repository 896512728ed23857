// The main of every test program. PALPATE_INSTALL is installHost, or installHostEnvironment for the tests of rooms
// before the one that has installHost.
#include <gtest/gtest.h>

#include "palpate/base/host_environment.h"
#include "palpate/scene/host.h"

int main(int argc, char** argv) {
  palpate::PALPATE_INSTALL();  // first: some parameters of tests are read from files
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
