#pragma once
// Tests that every engine of this build has to pass.

#include "voxelcore/Delaunay/DelaunayCells.h"

#include <gtest/gtest.h>

#include <string>

namespace voxelcore::testing
{

/** The parameter is the engine; skipped where the build lacks it. */
class WithEngine : public ::testing::TestWithParam<Engine>
{
protected:
  void
  SetUp() override
  {
    if (!HasEngine(GetParam()))
    {
      GTEST_SKIP() << "this build lacks the engine";
    }
  }
};

inline auto
AllEngines()
{
  return ::testing::Values(Engine::Lattice, Engine::TetGen);
}

inline std::string
EngineName(const ::testing::TestParamInfo<Engine> & engine)
{
  return engine.param == Engine::Lattice ? "Lattice" : "TetGen";
}

} // namespace voxelcore::testing
