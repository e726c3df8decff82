#pragma once
// A test that runs the program in a folder of its own.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace voxelcore::testing
{

class CommandFixture : public ::testing::Test
{
protected:
  /** Runs a command that must succeed and say nothing on stderr but what it sees in a mask; returns stdout. */
  static std::string
  Run(const std::vector<std::string> & arguments)
  {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(WithoutDiagnoses(result.error), "");
    return result.output;
  }
  std::string
  Path(const std::string & name) const
  {
    return m_Folder / name;
  }
  nlohmann::json
  Report(const std::string & name) const
  {
    return nlohmann::json::parse(ReadAll(m_Folder / name));
  }

  TemporaryFolder m_Folder;
};

} // namespace voxelcore::testing
