// A whole atlas to look at: a scene, a page and a picture of 116 labels, each within a minute. Processor time of all
// threads counts, which is the same on a busy machine, and on a free one no less than the time somebody waits.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <iterator>
#include <sys/resource.h>

namespace voxelcore::testing
{
namespace
{

constexpr double         kMinute = 60;
constexpr std::uintmax_t kLargestPage = 15'000'000;
constexpr std::size_t    kLabels = 116;

std::size_t
Count(const std::string & text, const std::string & word)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
  {
    ++count;
  }
  return count;
}

std::string
ReadAll(const std::filesystem::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

class HeavyAtlasDisplay : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    if (!std::filesystem::exists(m_Atlas))
    {
      GTEST_SKIP() << "mricron-data is not installed";
    }
  }

  static double
  ChildrensSeconds()
  {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  }

  double
  Seconds(const std::vector<std::string> & arguments, const char * what)
  {
    const double        before = ChildrensSeconds();
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    const double seconds = ChildrensSeconds() - before;
    std::cout << what << ": " << seconds << " s of processors, " << result.seconds << " s in all\n";
    return seconds;
  }

  TemporaryFolder             m_Folder;
  const std::filesystem::path m_Atlas = "/usr/share/mricron/templates/aal.nii.gz";
};

TEST_F(HeavyAtlasDisplay, TheSceneOf116LabelsTakesLessThanAMinute)
{
  const auto scene = m_Folder / "aal.mrml";
  EXPECT_LT(Seconds({ "core", m_Atlas, "-o", m_Folder / "aal.vtp", "--scene", scene, "-q" }, "scene"), kMinute);
  const std::string text = ReadAll(scene);
  EXPECT_EQ(Count(text, "<Model "), kLabels);
  EXPECT_EQ(Count(text, "<Segmentation "), 1U);
}

TEST_F(HeavyAtlasDisplay, ThePageOf116LabelsIsSmallAndTakesLessThanAMinute)
{
  const auto page = m_Folder / "aal.html";
  EXPECT_LT(Seconds({ "core", m_Atlas, "-o", m_Folder / "aal.vtp", "--with-skeleton", "--html", page, "-q" }, "page"),
            kMinute);
  std::cout << "page: " << std::filesystem::file_size(page) << " bytes\n";
  EXPECT_LT(std::filesystem::file_size(page), kLargestPage);
  const std::string text = ReadAll(page);
  for (const char * name : { "Precentral_L", "Hippocampus_R", "Vermis_10" }) // the first, one amid, the last
  {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST_F(HeavyAtlasDisplay, ThePageOf300LabelsIsSmallAndTakesLessThanTenSecondsOnTwoCores)
{
  const auto cells = m_Folder / "cells.nrrd";
  const auto page = m_Folder / "cells.html";
  ASSERT_EQ(RunProgram({ "phantom", "cells", "--size", "200", "--cells", "300", "-o", cells, "-q" }).code, 0);
  const double alone = Seconds({ "core", cells, "-o", m_Folder / "a.vtp", "-q" }, "core");
  const double both = Seconds({ "core", cells, "-o", m_Folder / "b.vtp", "--html", page, "-q" }, "core and page");
  EXPECT_LT(both - alone, 2 * 10);
  const std::uintmax_t size = std::filesystem::file_size(page);
  std::cout << "page: " << size << " bytes\n";
  EXPECT_LT(size, 20'000'000U);
  EXPECT_GE(Count(ReadAll(page), "\"name\":"), 300U);
}

TEST_F(HeavyAtlasDisplay, ThePictureOf116LabelsTakesLessThanAMinute)
{
  if (std::system("command -v Xvfb >/dev/null") != 0)
  {
    GTEST_SKIP() << "Xvfb is not installed";
  }
  const auto core = m_Folder / "aal.vtp";
  const auto picture = m_Folder / "aal.png";
  Seconds({ "core", m_Atlas, "-o", core, "-q" }, "core");
  EXPECT_LT(Seconds({ "render", core, "--scan", m_Atlas, "--color", "Label", "-o", picture, "-q" }, "picture"),
            kMinute);
  EXPECT_GT(std::filesystem::file_size(picture), 100'000U); // a picture of one colour has less
}

} // namespace
} // namespace voxelcore::testing
