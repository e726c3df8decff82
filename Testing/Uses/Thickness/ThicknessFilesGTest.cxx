#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Thickness/ThicknessFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

std::vector<std::string>
Lines(const std::string & text)
{
  std::vector<std::string> lines;
  std::istringstream       stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

ThicknessRecord
Record()
{
  ThicknessRecord record;
  record.label = 4;
  record.name = "bone, trabecular";
  record.voxelVolume = 0.5;
  record.numbers = SummarizeThickness({ 1, 2, 3, 4 }, 1);
  record.inner = SummarizeThickness({ 1, 2 }, 1);
  record.borderVoxels = 2;
  return record;
}

TEST(ThicknessFiles, HaveARowPerRecordWithAllColumns)
{
  const TemporaryFolder folder;
  ThicknessRecord       second = Record();
  second.isSeparation = true;
  second.inner = {};
  second.meanLower = 1.5;
  second.meanUpper = 1.75;
  WriteThicknessCsv(folder.Path() / "a.csv", { Record(), second });
  const auto lines = Lines(ReadAll(folder.Path() / "a.csv"));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1], "4,\"bone, trabecular\",0,thickness,4,2,2.5,1.118034,1,1,1,2,3,4,4,2,1.5,0.5,,");
  EXPECT_EQ(lines[2], "4,\"bone, trabecular\",0,separation,4,2,2.5,1.118034,1,1,1,2,3,4,4,2,,,1.5,1.75");
  // The quoted name holds one comma.
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), std::count(lines[1].begin(), lines[1].end(), ',') - 1);
}

TEST(ThicknessFiles, HistogramsHaveARowPerBin)
{
  const TemporaryFolder folder;
  WriteThicknessHistogramCsv(folder.Path() / "a.csv", { Record() });
  const auto lines = Lines(ReadAll(folder.Path() / "a.csv"));
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[1], "4,\"bone, trabecular\",0,thickness,0,1,0,0");
  EXPECT_EQ(lines[5], "4,\"bone, trabecular\",0,thickness,4,5,1,0.25");
}

TEST(ThicknessFiles, TheDictionaryNamesEveryColumnInItsUnit)
{
  const TemporaryFolder folder;
  WriteThicknessCsv(folder.Path() / "a.csv", {});
  WriteThicknessHistogramCsv(folder.Path() / "b.csv", {});
  const auto columns = nlohmann::json::parse(ThicknessColumnsJson(SpatialUnit::Voxels));
  for (const auto & [file, part] : { std::pair("a.csv", "thickness"), std::pair("b.csv", "histogram") })
  {
    std::istringstream head(Lines(ReadAll(folder.Path() / file)).front());
    std::size_t        count = 0;
    for (std::string name; std::getline(head, name, ','); ++count)
    {
      EXPECT_TRUE(columns[part].contains(name)) << name;
      EXPECT_FALSE(columns[part][name]["Description"].get<std::string>().empty()) << name;
    }
    EXPECT_EQ(columns[part].size(), count);
  }
  EXPECT_EQ(columns["thickness"]["mean"]["Units"], "vox");
}

} // namespace
} // namespace voxelcore::testing
