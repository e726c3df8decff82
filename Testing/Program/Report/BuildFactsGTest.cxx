#include "voxelcore/Report/BuildFacts.h"

#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Report/Sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{
namespace
{

TEST(BuildFacts, TheSourcesAreThoseOfTheModules)
{
  // Names and contents, without what is written for people and for CMake.
  const std::filesystem::path modules = VOXELCORE_MODULES;
  std::vector<std::string>    names;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(modules))
  {
    const std::string name = entry.path().lexically_relative(modules).string();
    const auto        holds = [&](const char * folder) { return name.find(folder) != std::string::npos; };
    if (entry.is_regular_file() && (holds("/include/") || holds("/inner/") || holds("/src/") || holds("/tables/") ||
                                    holds("/job/") || holds("/itk/")))
    {
      names.push_back(name);
    }
  }
  ASSERT_GT(names.size(), 300U);
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string & name : names)
  {
    all += FileSha256(modules / name) + " " + name + "\n";
  }
  EXPECT_EQ(SourceDigest(), TextSha256(all).substr(0, 16));
}

TEST(BuildFacts, TheVersionNamesThem)
{
  EXPECT_NE(VersionText().find("\nsources: " + SourceDigest() + "\n"), std::string::npos) << VersionText();
  EXPECT_EQ(SourceDigest().find_first_not_of("0123456789abcdef"), std::string::npos);
}

} // namespace
} // namespace voxelcore
