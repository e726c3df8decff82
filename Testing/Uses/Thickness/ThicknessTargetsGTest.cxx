// Where maps, tables and pages of thickness cannot go is found before anything is measured.

#include "ThicknessFolder.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace voxelcore::testing
{
namespace
{

class ThicknessTargets : public ThicknessFolder
{};

TEST_F(ThicknessTargets, NamesThatCannotBeHadAreFoundBeforeAnythingIsMeasured)
{
  TwoLabels();
  constexpr double      read = 0.08; // of the job's progress
  const ParameterValues all{ { "table", At("t.csv") }, { "bounds", "true" }, { "separation", "box" } };
  for (const std::string name : { "t_histogram.csv",
                                  "t_columns.json",
                                  "map_lower.nrrd",
                                  "map_upper.nrrd",
                                  "map_separation.nrrd",
                                  "maps/a_label-2_thickness_upper.nrrd",
                                  "maps/a_separation.nrrd" })
  {
    std::filesystem::create_directory(At("maps"));
    std::ofstream(At(name)) << "mine";
    double came = 0;
    EXPECT_THROW(Thickness(name.starts_with("maps") ? "maps/" : "map.nrrd", all, Noting(came)), OutputError) << name;
    EXPECT_LT(came, read) << name;
    EXPECT_EQ(Bytes(name), "mine");
    std::filesystem::remove(At(name));
  }
  double came = 0;
  EXPECT_THROW(Thickness("m.nrrd", { { "report", At("t_columns.json") }, { "table", At("t.csv") } }, Noting(came)),
               UsageError);
  EXPECT_THROW(Thickness("m.nrrd", { { "surface", At("s.vtp") }, { "medial", At("s.vtp") } }, Noting(came)),
               UsageError);
  EXPECT_THROW(Thickness("m.nrrd", { { "report", At("m_lower.nrrd") }, { "bounds", "true" } }, Noting(came)),
               UsageError);
  EXPECT_EQ(came, 0);
}

TEST_F(ThicknessTargets, AHeadersVoxelsAreFoundBeforeAnythingIsMeasured)
{
  TwoLabels();
  std::ofstream(At("map.zraw")) << "mine";
  double came = 0;
  EXPECT_THROW(Thickness("map.mhd", {}, Noting(came)), OutputError);
  EXPECT_EQ(came, 0);
  EXPECT_EQ(Bytes("map.zraw"), "mine");
}

TEST_F(ThicknessTargets, WhatTiffLeavesOutOfThePlaceIsTold)
{
  TwoLabels();
  EXPECT_TRUE(Thickness("map.tif").notes.empty()) << "there is nothing to leave out";
  VoxelShape    cube(VoxelBox{ { 2, 2, 2 }, { 1, 1, 1 } });
  ImageGeometry geometry;
  cube.Insert(2, 2, 2);
  geometry.size = { 6, 6, 6 };
  geometry.origin = { 10, 0, 0 };
  WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "cube", 1, std::move(cube) } });
  const ThicknessResult result = Thickness("map.tif", { { "force", "true" } });
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes[0].find("map.tif: TIFF holds no origin"), std::string::npos);
  EXPECT_TRUE(Thickness("map.nii.gz").notes.empty());
}

TEST_F(ThicknessTargets, AFormatThatCannotHoldTheMapIsRefusedByItsNameBeforeAnythingIsMeasured)
{
  VoxelShape square(VoxelBox{ { 2, 2, 0 }, { 4, 4, 1 } });
  for (std::int32_t i = 0; i < 16; ++i)
  {
    square.Insert(2 + i % 4, 2 + i / 4, 0);
  }
  ImageGeometry geometry;
  geometry.size = { 8, 8, 1 };
  WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "square", 16, std::move(square) } });
  double came = 0;
  try
  {
    Thickness("map.tif", {}, Noting(came));
    ADD_FAILURE() << "one page is no volume";
  }
  catch (const UsageError & error)
  {
    EXPECT_TRUE(std::string(error.what()).starts_with(At("map.tif") + ": ")) << error.what();
  }
  EXPECT_LT(came, 0.08);
}

} // namespace
} // namespace voxelcore::testing
