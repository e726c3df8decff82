#include "voxelcore/Corrections/CorrectionsExtension.h"
#include "voxelcore/Corrections/CorrectionsJob.h"

#include "Program/Jobs/JobFolder.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/Annotations.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

namespace fs = std::filesystem;

class CorrectionsJob : public JobFolder
{
protected:
  /** A trunk along x with two branches along y. */
  void
  Write(const std::string & name, double thicker = 0) const
  {
    ImageGeometry geometry;
    geometry.size = { 90, 60, 24 };
    geometry.spacing = { 0.5, 0.5, 0.5 };
    LabelShape label;
    label.value = 1;
    label.shape = CropToVoxels(ShapeWhere({ 90, 60, 24 }, [=](int x, int y, int z) {
      const auto tube = [&](double away, double radius) { return away < radius + thicker; };
      return (tube(std::hypot(y - 12.0, z - 12.0), 4.5) && x >= 4 && x < 86) ||
             (tube(std::hypot(x - 30.0, z - 12.0), 3.5) && y >= 12 && y < 44) ||
             (tube(std::hypot(x - 60.0, z - 12.0), 3.5) && y >= 12 && y < 50);
    }));
    label.voxels = label.shape.CountVoxels();
    WriteLabelVolume(At(name), geometry, { label });
  }
  SkeletonResult
  Run(const std::string & scan, const std::string & output, ParameterValues more = {}) const
  {
    more.insert({ { "scan", At(scan) }, { "output", At(output) }, { "annotations", "true" }, { "force", "true" } });
    return RunCorrectionsJob(CorrectionsOptionsFrom(more));
  }
  static std::vector<std::string>
  LeftOut(const SkeletonResult & result)
  {
    std::vector<std::string> told;
    std::copy_if(result.warnings.begin(),
                 result.warnings.end(),
                 std::back_inserter(told),
                 [](const std::string & warning) { return warning.find("is left out") != std::string::npos; });
    return told;
  }
  void
  Say(const std::string & name, const std::string & lines) const
  {
    std::ofstream(At(name)) << "branch,junction,x,y,z,edit,name\n" << lines;
  }
};

TEST_F(CorrectionsJob, WithoutEditsTheTreeIsThatOfSkeletonAndHasARowForEachBranchAndJunction)
{
  Write("a.nrrd");
  Run("a.nrrd", "t.vtp");
  RunSkeletonJob(SkeletonOptionsFrom({ { "scan", At("a.nrrd") }, { "output", At("plain.vtp") } }));
  EXPECT_EQ(Bytes("t.vtp"), Bytes("plain.vtp"));
  const std::string table = Bytes("t_annotations.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 5 + 2);
  EXPECT_EQ(Names(),
            (std::set<std::string>{ "a.nrrd",
                                    "plain.vtp",
                                    "t.vtp",
                                    "t_annotations.csv",
                                    "t_annotations.mrk.json",
                                    "t_annotations_columns.json" }));
}

TEST_F(CorrectionsJob, EditsLastWhicheverFileTheyAreReadFrom)
{
  Write("a.nrrd");
  Say("edits.csv",
      ",,15,12,6,remove,\n" // the first branch
      ",,30,18,6,cut,\n"    // the second
      ",,2,6,6,root,\n"     // the trunk's begin
      ",,40.0000123,6,6,path 42 12 6; 43 20 6 radius 1,artery\n"
      ",,1e6,-1e300,6,remove,far away\n");
  const auto edited = Run("a.nrrd", "e.vtp", { { "edits", At("edits.csv") } });
  ASSERT_EQ(LeftOut(edited).size(), 1U);
  EXPECT_NE(LeftOut(edited)[0].find("line 6: 'remove' is left out: no branch passes there"), std::string::npos);
  EXPECT_EQ(ReadSkeletonVtp(At("e.vtp")).parts.at(0).names.size(),
            edited.report.labels.at(0).skeleton->numbers.branches);
  EXPECT_EQ(ranges::count(ReadSkeletonVtp(At("e.vtp")).parts.at(0).names, "artery"), 1);
  const auto & record = edited.report.labels.at(0);
  EXPECT_EQ(record.shape.betti, (std::array<std::int64_t, 3>{ 2, 0, 0 }));
  EXPECT_EQ(record.skeleton->topology, record.shape);
  EXPECT_EQ(record.skeleton->numbers.components, 2);
  for (const char * again : { "e_annotations.csv", "e_annotations.mrk.json" })
  {
    Run("a.nrrd", "f.vtp", { { "edits", At(again) } });
    EXPECT_EQ(Bytes("f.vtp"), Bytes("e.vtp")) << again;
    EXPECT_EQ(Bytes("f_annotations.csv"), Bytes("e_annotations.csv")) << again;
    EXPECT_EQ(Bytes("f_annotations.mrk.json"), Bytes("e_annotations.mrk.json")) << again;
  }
}

TEST_F(CorrectionsJob, InAFolderFilesHaveTheScansName)
{
  Write("a.nrrd");
  Say("edits.csv", ",,30,18,6,cut,\n");
  Run("a.nrrd", "e.vtp", { { "edits", At("edits.csv") } });
  Run("a.nrrd", "new/folder/", { { "edits", At("edits.csv") } });
  EXPECT_EQ(Bytes("new/folder/a_skeleton.vtp"), Bytes("e.vtp"));
  EXPECT_EQ(Bytes("new/folder/a_skeleton_annotations.csv"), Bytes("e_annotations.csv"));
}

TEST_F(CorrectionsJob, AnEditThatNamesAnotherLabelIsPassedOver)
{
  Write("a.nrrd");
  std::ofstream(At("edits.csv")) << "label,branch,x,y,z,edit,name\n1,,30,18,6,cut,\n2,,15,12,6,remove,\n";
  const auto edited = Run("a.nrrd", "e.vtp", { { "edits", At("edits.csv") } });
  EXPECT_EQ(edited.report.labels.at(0).shape.betti, (std::array<std::int64_t, 3>{ 2, 0, 0 }));
  EXPECT_TRUE(LeftOut(edited).empty());
  EXPECT_EQ(ranges::count(edited.notes, "1 edit of another label is passed over"), 1);
  EXPECT_EQ(Bytes("e_annotations.csv").find("remove"), std::string::npos);
  std::ofstream(At("bad.csv")) << "label,branch,x,y,z,edit,name\nleft,,30,18,6,cut,\n";
  EXPECT_THROW(Run("a.nrrd", "f.vtp", { { "edits", At("bad.csv") } }), InputError);
}

TEST_F(CorrectionsJob, WhatIsRecordedGivesTheSameBody)
{
  Write("a.nrrd");
  Say("edits.csv", ",,30,18,6,cut,\n");
  Run("a.nrrd", "e.vtp", { { "edits", At("edits.csv") } });
  // --edits is no part of what is recorded: the voxels are.
  const SkeletonModel edited = ReadSkeletonVtp(At("e.vtp"));
  SkeletonOptions     options = SkeletonOptionsFrom({ { "scan", At("a.nrrd") }, { "output", At("g.vtp") } });
  options.edits.change = ParseProvenance(edited.provenance, "e.vtp").parameters.edits.change;
  RunSkeletonJob(options);
  EXPECT_EQ(Bytes("g.vtp"), Bytes("e.vtp"));
}

TEST_F(CorrectionsJob, ALoopThatIsRealIsNotCut)
{
  ImageGeometry geometry;
  geometry.size = { 90, 60, 24 };
  geometry.spacing = { 0.5, 0.5, 0.5 };
  LabelShape label;
  label.value = 1;
  const auto ring = [](int x, int y, int z, double at, double radius) {
    return std::hypot(std::hypot(x - at, y - 30.0) - 18, z - 12.0) < radius;
  };
  label.shape = CropToVoxels(
    ShapeWhere({ 90, 60, 24 }, [&](int x, int y, int z) { return ring(x, y, z, 24, 4.5) || ring(x, y, z, 64, 3.5); }));
  label.voxels = label.shape.CountVoxels();
  WriteLabelVolume(At("rings.nrrd"), geometry, { label });
  const ParameterValues cutting{ { "cut-loops", "true" } };
  EXPECT_EQ(Run("rings.nrrd", "cut.vtp", cutting).report.labels.at(0).skeleton->numbers.cycles, 0);
  Say("edits.csv", ",,3,15,6,loop,left ring\n,,32,24,6,loop,\n");
  const auto edited = Run("rings.nrrd", "real.vtp", { { "cut-loops", "true" }, { "edits", At("edits.csv") } });
  EXPECT_EQ(edited.report.labels.at(0).skeleton->numbers.cycles, 2);
  EXPECT_TRUE(LeftOut(edited).empty());
  EXPECT_EQ(edited.report.labels.at(0).skeleton->topology.betti, (std::array<std::int64_t, 3>{ 1, 2, 0 }));
  Say("one.csv", ",,3,15,6,loop,\n");
  const auto one = Run("rings.nrrd", "one.vtp", { { "cut-loops", "true" }, { "edits", At("one.csv") } });
  EXPECT_EQ(one.report.labels.at(0).skeleton->numbers.cycles, 1);
  EXPECT_EQ(nlohmann::json::parse(ReadSkeletonVtp(At("one.vtp")).provenance).at("skeleton").at("real_loops").size(),
            1U);
  Run("rings.nrrd", "two.vtp", { { "cut-loops", "true" }, { "edits", At("one_annotations.csv") } });
  EXPECT_EQ(Bytes("two.vtp"), Bytes("one.vtp"));
}

// Files of edits with bytes changed, left out or doubled: each is read, or refused with a line.
TEST_F(CorrectionsJob, DamagedFilesOfEditsAreReadOrRefused)
{
  Write("a.nrrd");
  Say("edits.csv", ",,30,18,6,cut,\"a, b\"\n0,,40,6,6,path 42 12 6; 43 20 6 radius 1,artery\n");
  Run("a.nrrd", "t.vtp", { { "edits", At("edits.csv") } });
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937      random(seed);
  const std::string kinds[]{ "branch", "junction" };
  std::size_t       read = 0;
  for (const char * name : { "t_annotations.csv", "t_annotations.mrk.json" })
  {
    const std::string whole = Bytes(name);
    const std::string damaged = At("damaged" + fs::path(name).extension().string());
    for (int i = 0; i < 300; ++i)
    {
      std::string bytes = whole;
      for (int change = 1 + static_cast<int>(random() % 3); change > 0 && !bytes.empty(); --change)
      {
        const std::size_t at = random() % bytes.size();
        switch (random() % 3)
        {
          case 0:
            bytes[at] = static_cast<char>(random() % 256);
            break;
          case 1:
            bytes.erase(at, 1 + random() % 40);
            break;
          default:
            bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 40));
        }
      }
      std::ofstream(damaged, std::ios::binary) << bytes;
      try
      {
        for (const Annotation & one : ReadAnnotations(damaged, kinds))
        {
          ParseTreeEdit(one.edit);
        }
        ++read;
      }
      catch (const InputError &)
      {}
      catch (const UsageError &)
      {}
    }
  }
  EXPECT_GT(read, 0U);
}

TEST_F(CorrectionsJob, EditsHoldForAThickerBodyAndWhatNoLongerFitsIsTold)
{
  Write("a.nrrd");
  Write("b.nrrd", 0.6);
  Run("a.nrrd", "t.vtp");
  // Fill in the rows of two branches, and a place where there is none.
  std::istringstream lines(Bytes("t_annotations.csv"));
  std::string        text;
  int                row = 0;
  for (std::string line; std::getline(lines, line); ++row)
  {
    line.resize(line.size() - (row == 1 || row == 2 ? 2 : 0));
    text += line + (row == 1 ? ",cut," : row == 2 ? ",,second" : "") + "\n";
  }
  std::ofstream(At("edits.csv")) << text << ",,5,25,6,remove,\n";
  const auto on = [&](const char * scan) { return Run(scan, "e.vtp", { { "edits", At("edits.csv") } }); };
  for (const char * scan : { "a.nrrd", "b.nrrd" })
  {
    const auto edited = on(scan);
    const auto left = LeftOut(edited);
    ASSERT_EQ(left.size(), 1U) << scan;
    EXPECT_NE(left[0].find("'remove' is left out: no branch passes there"), std::string::npos);
    EXPECT_EQ(edited.report.labels.at(0).shape.betti[0], 2) << scan;
    EXPECT_NE(edited.notes.back().find("2 of 3 edits done"), std::string::npos) << edited.notes.back();
  }
}

TEST_F(CorrectionsJob, WhatCannotBeDoneIsRefusedBeforeAnythingIsWritten)
{
  Write("a.nrrd");
  const auto expect = [&](const std::string & why, ParameterValues more) {
    const std::set<std::string> before = Names();
    try
    {
      Run("a.nrrd", "refused.vtp", std::move(more));
      ADD_FAILURE() << why;
    }
    catch (const std::exception & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
    EXPECT_EQ(Names(), before);
  };
  Say("bad.csv", ",,1,2,3,cutt,\n");
  Say("nowhere.csv", "0,,,,,cut,\n");
  expect("line 2: 'cutt' is no edit; expected cut", { { "edits", At("bad.csv") } });
  expect("line 2: has no place", { { "edits", At("nowhere.csv") } });
  Say("inf.csv", ",,1,inf,3,cut,\n");
  expect("line 2: 'inf' is no coordinate", { { "edits", At("inf.csv") } });
  Say("damaged.csv", ",,1,2,3,\"cut,\n");
  expect("damaged.csv", { { "edits", At("damaged.csv") } });
  Say("name.csv", ",,1,2,3,,\"a\nb\"\n");
  expect("line 2: a name holds a line end", { { "edits", At("name.csv") } });
  std::string many;
  for (int i = 0; i <= 10000; ++i)
  {
    many += ",,1,2,3,cut,\n";
  }
  Say("many.csv", many);
  expect("line 10002: there are more than 10000 edits", { { "edits", At("many.csv") } });
  expect("cannot read this file", { { "edits", At("none.csv") } });
  expect("written as .vtp", { { "output", At("refused.csv") } });
  expect("leave out --network", { { "network", "true" } });
}

} // namespace
} // namespace voxelcore::testing
