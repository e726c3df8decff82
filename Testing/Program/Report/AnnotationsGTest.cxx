#include "voxelcore/Report/Annotations.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

const std::string kKinds[]{ "branch", "junction" };

std::vector<AnnotationRow>
Rows()
{
  return { { "branch", "0", "0,", { 1.5, 2, 3.25 }, "join 1 2 3", "=aorta, \"left\"" },
           { "junction", "4", ",4", { -1, 0, 1e-3 }, "", "" },
           { "", "", ",", { 7, 8, 9 }, "path 1 2 3; 4 5 6", "the last" } };
}

TEST(Annotations, BothFormsGiveBackWhatWasSaid)
{
  const TemporaryFolder folder;
  WriteAnnotations(folder / "a.csv",
                   folder / "a.mrk.json",
                   "branch,junction,x,y,z,edit,name\n",
                   Rows(),
                   SpatialUnit::Millimetres);
  for (const char * file : { "a.csv", "a.mrk.json" })
  {
    const auto read = ReadAnnotations(folder / file, kKinds);
    ASSERT_EQ(read.size(), 3U) << file;
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(read[i].place, Rows()[i].place) << file;
      EXPECT_EQ(read[i].edit, Rows()[i].edit) << file;
    }
    EXPECT_EQ(read[0].number, 0U);
    EXPECT_EQ(read[0].name, "=aorta, \"left\"");
    EXPECT_EQ(read[1].name, "");
    EXPECT_EQ(read[2].name, "the last");
  }
  EXPECT_EQ(ReadAnnotations(folder / "a.csv", kKinds)[2].where, "line 4");
  EXPECT_EQ(ReadAnnotations(folder / "a.mrk.json", kKinds)[2].where, "point 3");
}

TEST(Annotations, SlicersOwnAxesAreTurned)
{
  const TemporaryFolder folder;
  WriteAnnotations(folder / "a.csv", folder / "a.mrk.json", "branch\n", Rows(), SpatialUnit::Millimetres);
  auto json = nlohmann::json::parse(ReadAll(folder / "a.mrk.json"));
  json["markups"][0]["coordinateSystem"] = "RAS";
  std::ofstream(folder / "b.mrk.json") << json.dump();
  EXPECT_EQ(ReadAnnotations(folder / "b.mrk.json", kKinds)[0].place, (Vector3{ -1.5, -2, 3.25 }));
}

TEST(Annotations, WhatCannotBeReadIsToldWithItsPlace)
{
  const TemporaryFolder folder;
  const auto            expect = [&](const std::string & name, const std::string & text, const std::string & told) {
    std::ofstream(folder / name) << text;
    try
    {
      ReadAnnotations(folder / name, kKinds);
      ADD_FAILURE() << text;
    }
    catch (const InputError & error)
    {
      EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
    }
  };
  expect("a.csv", "", "is empty; expected the columns branch");
  expect("a.csv", "x,y\n1,2\n", "has no columns branch and edit");
  expect("a.csv", "branch,x,y,z,edit\n0,1,2,3,\n1,1,nan,3,\n", "line 3: 'nan' is no coordinate");
  expect("a.csv", "branch,x,y,z,edit\none,1,2,3,\n", "line 2: 'one' is no number of a branch");
  expect("a.csv", "branch,edit,name\n0,," + std::string(300, 'n') + "\n", "a name is longer than 200 bytes");
  expect("a.json", "{", "is no point list of 3D Slicer");
  expect("a.json", R"({"markups": [{"controlPoints": [{"position": [1]}]}]})", "is no point list of 3D Slicer");
  EXPECT_THROW(ReadAnnotations(folder / "none.csv", kKinds), InputError);
}

} // namespace
} // namespace voxelcore::testing
