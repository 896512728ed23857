#include "lab/counters/machine.h"

#include <gtest/gtest.h>

namespace palpate::lab {
namespace {

TEST(Machine, KnowsWhatItRunsOnAndWhatBuiltIt) {
  const lab::Machine machine = lab::thisMachine();
  EXPECT_FALSE(machine.cpu.empty());
  EXPECT_GE(machine.cores, 1u);
  EXPECT_TRUE(machine.compiler.starts_with("gcc ") || machine.compiler.starts_with("clang ")) << machine.compiler;
  EXPECT_NE(machine.build.find("-ffp-contract=off"), std::string::npos) << machine.build;
  EXPECT_NE(machine.simd, "Unknown");
  EXPECT_EQ(machine.palpate.find_first_not_of("0123456789."), std::string::npos) << machine.palpate;
}

TEST(Machine, IsOneLineThatHoldsEveryPart) {
  const lab::Machine machine = lab::thisMachine();
  const std::string line = lab::describeMachine(machine);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  for (const std::string* part : {&machine.cpu, &machine.kernel, &machine.compiler, &machine.build, &machine.simd}) {
    EXPECT_NE(line.find(*part), std::string::npos) << *part;
  }
}

}  // namespace
}  // namespace palpate::lab
