#include "RootsFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Shape/BodyFrame.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace voxelcore::testing
{
namespace
{

const std::set<std::string> kTables{ "annotations.csv", "annotations.mrk.json",
                                     "mask.nrrd",       "medial.vtp",
                                     "skeleton.vtp",    "roots.rsml",
                                     "roots.csv",       "levels.csv",
                                     "plant.csv",       "profile.csv",
                                     "columns.json",    "changes.txt",
                                     "report.json",     "page.html",
                                     "roots.swc",       "roots.graphml" };

using RootsJob = RootsFolder;

double
TrueLength(const PhantomOptions & options)
{
  const auto lines = RootCentreLines(options);
  double     length = 0;
  for (const CentreLinePoint & point : lines)
  {
    if (point.parent >= 0)
    {
      const auto & before = lines[static_cast<std::size_t>(point.parent)];
      double       squares = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        squares += std::pow((point.position[k] - before.position[k]) * options.spacing[k], 2);
      }
      length += std::sqrt(squares);
    }
  }
  return length;
}

TEST_F(RootsJob, AGreyScanGivesItsRootsWithoutAnyOption)
{
  const PhantomJobOptions phantom = Scan("a.nrrd");
  const RootsResult       result = Roots("a.nrrd", "out/");
  EXPECT_EQ(In("out"), kTables);
  EXPECT_EQ(UpText(result.model.roots.up), "z+");
  std::set<std::int32_t> branches;
  for (const CentreLinePoint & point : RootCentreLines(phantom.phantom))
  {
    branches.insert(point.branch);
  }
  EXPECT_EQ(result.model.roots.axes.size(), branches.size());
  const double length = TrueLength(phantom.phantom);
  // Roots are measured from the surface of their parents on.
  EXPECT_LT(result.model.traits.levels.back().totalLength, length);
  EXPECT_GT(result.model.traits.levels.back().totalLength, 0.85 * length);
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes.front().find("the one that 'voxelcore info' proposes"), std::string::npos);
  const auto threshold = result.report.parameters.reading.threshold;
  ASSERT_TRUE(threshold);
  EXPECT_NEAR(threshold->first, (kRootScanAir + kRootScanRoot) / 2.0, 0.05 * (kRootScanRoot - kRootScanAir));
}

TEST_F(RootsJob, HollowRootsAreFilledUnlessTheMaskIsTakenAsItIs)
{
  Scan("a.nrrd", 0.7);
  const RootsResult filled = Roots("a.nrrd", "out/");
  EXPECT_EQ(filled.report.labels.at(0).shape.betti[2], 0);
  const RootsResult hollow = Roots("a.nrrd", "raw/", { { "as-is", "true" } });
  EXPECT_GE(hollow.report.labels.at(0).shape.betti[1], filled.report.labels.at(0).shape.betti[1] + 3); // its holes
  EXPECT_FALSE(hollow.report.parameters.edits.AreAsked());
}

TEST_F(RootsJob, TouchingRootsAreToldApart)
{
  const PhantomJobOptions phantom = Scan("a.nrrd", 0, 3);
  const RootsResult       result = Roots("a.nrrd", "out/");
  const auto              contacts = RootContacts(phantom.phantom).size();
  ASSERT_GT(contacts, 1U);
  EXPECT_GE(result.model.traits.contacts, static_cast<std::int64_t>(contacts));
  EXPECT_EQ(result.report.labels.at(0).shape.betti, (std::array<std::int64_t, 3>{ 1, 0, 0 })) << "cut apart";
  ASSERT_TRUE(result.topology);
  EXPECT_GE(result.topology->before.betti[1], static_cast<std::int64_t>(contacts));
  EXPECT_TRUE(result.topology->asAsked);
  EXPECT_GE(result.topology->cuts, contacts);
  std::set<std::int32_t> branches;
  for (const CentreLinePoint & point : RootCentreLines(phantom.phantom))
  {
    branches.insert(point.branch);
  }
  EXPECT_NEAR(static_cast<double>(result.model.roots.axes.size()), static_cast<double>(branches.size()), 1);
}

TEST_F(RootsJob, LoopsStayWhereTheyAreAskedFor)
{
  Scan("a.nrrd", 0, 3);
  const auto loops = [](const RootsResult & result) { return result.report.labels.at(0).shape.betti[1]; };
  const auto all = loops(Roots("a.nrrd", "all/", { { "keep-loops", "true" } }));
  ASSERT_GT(all, 1);
  EXPECT_EQ(loops(Roots("a.nrrd", "one/", { { "loops", "1" } })), 1);
  const RootsResult tooMany = Roots("a.nrrd", "kernel/", { { "kernel", "19000" }, { "threshold", "18500:inf" } });
  EXPECT_FALSE(tooMany.topology->asAsked) << "nearly all is kernel";
  EXPECT_NE(tooMany.topology->reason.find("never cut"), std::string::npos);
  EXPECT_NE(tooMany.warnings.at(0).find("not what was asked"), std::string::npos);
}

TEST_F(RootsJob, CutsAndFillsAreListedAndTheListMakesTheSameMask)
{
  Scan("a.nrrd", 0.7, 3);
  const RootsResult result = Roots("a.nrrd", "out/");
  ASSERT_TRUE(result.topology);
  const auto json = nlohmann::json::parse(Bytes("out/report.json")).at("roots").at("topology");
  EXPECT_EQ(json.at("after"), (nlohmann::json{ 1, 0, 0 }));
  EXPECT_EQ(json.at("changes").size(), result.topology->parts.size());
  std::uint64_t voxels = 0;
  for (const auto & change : json.at("changes"))
  {
    EXPECT_GT(change.at("cost"), 0);
    voxels += change.at("voxels").get<std::uint64_t>();
  }
  EXPECT_EQ(voxels, result.topology->voxelsAdded + result.topology->voxelsRemoved);
  const auto & levels = json.at("levels");
  EXPECT_LT(levels.at("neighborhood"), levels.at("shape"));
  EXPECT_LT(levels.at("shape"), levels.at("kernel"));
  for (const RootsChange & change : result.topology->parts)
  {
    EXPECT_TRUE(change.isFill ? change.darkest >= result.topology->levels->neighbourhood
                              : change.brightest < result.topology->levels->kernel);
  }
  const std::string page = Bytes("out/page.html");
  EXPECT_NE(page.find("<h2>Cuts and fills</h2>"), std::string::npos);
  EXPECT_NE(page.find("type=\"range\""), std::string::npos);
  const auto report = nlohmann::json::parse(Bytes("out/report.json"));
  EXPECT_GE(report.at("parameters").at("change_voxels").size(), result.topology->changes.size()) << "with clefts";
  Roots("a.nrrd", "again/", { { "change-voxels", At("out/changes.txt") } });
  EXPECT_EQ(Bytes("again/mask.nrrd"), Bytes("out/mask.nrrd"));
}

/** Values moved: axis k of the new grid is axis `order[k]` of the old, turned round where `mirrored`, in a border. */
void
Moved(const RootScan &                  scan,
      const std::array<std::int32_t, 3> size,
      const std::array<int, 3> &        order,
      const std::array<bool, 3> &       mirrored,
      std::int32_t                      border,
      const std::filesystem::path &     path)
{
  ImageGeometry geometry;
  for (std::size_t k = 0; k < 3; ++k)
  {
    geometry.size[k] = size[static_cast<std::size_t>(order[k])] + 2 * border;
  }
  std::vector<std::uint16_t> values;
  for (std::int32_t z = -border; z < geometry.size[2] - border; ++z)
  {
    for (std::int32_t y = -border; y < geometry.size[1] - border; ++y)
    {
      for (std::int32_t x = -border; x < geometry.size[0] - border; ++x)
      {
        const std::array<std::int32_t, 3> to{ x, y, z };
        std::array<std::int32_t, 3>       from{};
        bool                              isIn = true;
        for (std::size_t k = 0; k < 3; ++k)
        {
          const auto axis = static_cast<std::size_t>(order[k]);
          from[axis] = mirrored[k] ? size[axis] - 1 - to[k] : to[k];
          isIn = isIn && to[k] >= 0 && to[k] < size[axis];
        }
        const auto at = [&] {
          return (static_cast<std::size_t>(from[2]) * static_cast<std::size_t>(size[1]) +
                  static_cast<std::size_t>(from[1])) *
                   static_cast<std::size_t>(size[0]) +
                 static_cast<std::size_t>(from[0]);
        };
        values.push_back(isIn ? scan.values[at()] : kRootScanAir);
      }
    }
  }
  WriteGreyVolume(path, geometry, values, false);
}

TEST_F(RootsJob, TurnedMirroredAndPaddedItIsTheSamePlantUnlessRootsTouch)
{
  PhantomJobOptions phantom = Scan("a.nrrd");
  phantom.phantom.detail = 1.2; // of thinner roots mending depends on the order of voxels
  phantom.scan->root = phantom.phantom;
  const RootScan scan = MakeRootScan(*phantom.scan);
  const auto &   size = phantom.phantom.size;
  Moved(scan, size, { 0, 1, 2 }, { false, false, false }, 0, At("plain.nrrd"));
  Moved(scan, size, { 1, 2, 0 }, { false, true, false }, 0, At("turned.nrrd"));
  Moved(scan, size, { 0, 1, 2 }, { true, false, false }, 0, At("mirrored.nrrd"));
  Moved(scan, size, { 0, 1, 2 }, { false, false, false }, 7, At("padded.nrrd"));
  const RootsResult plain = Roots("plain.nrrd", "plain/", { { "threshold", "20000:inf" } });
  const auto        levels = [](const RootsResult & result) {
    std::vector<std::int64_t> counts;
    for (const RootLevelRecord & level : result.model.traits.levels)
    {
      counts.push_back(level.count);
    }
    return counts;
  };
  for (const std::string name : { "turned", "mirrored", "padded" })
  {
    const RootsResult moved = Roots(name + ".nrrd", name + "/", { { "threshold", "20000:inf" } });
    EXPECT_EQ(UpText(moved.model.roots.up), name == "turned" ? "y-" : "z+") << name;
    EXPECT_EQ(moved.report.labels.at(0).shape.betti, plain.report.labels.at(0).shape.betti) << name;
    EXPECT_EQ(levels(moved), levels(plain)) << name;
    EXPECT_NEAR(moved.model.traits.levels.back().totalLength,
                plain.model.traits.levels.back().totalLength,
                0.005 * plain.model.traits.levels.back().totalLength)
      << name;
    EXPECT_EQ(moved.model.traits.contacts, plain.model.traits.contacts) << name;
  }
}

TEST_F(RootsJob, TheReportHoldsTheContactsAndWhichWayIsUp)
{
  Scan("a.nrrd", 0, 3);
  const RootsResult result = Roots("a.nrrd", "out/", { { "up", "z+" } });
  const auto        report = nlohmann::json::parse(Bytes("out/report.json"));
  EXPECT_EQ(report.at("roots").at("up"), "z+");
  EXPECT_FALSE(report.at("roots").at("up_found"));
  EXPECT_EQ(report.at("roots").at("axes"), result.model.roots.axes.size());
  EXPECT_EQ(report.at("roots").at("contacts").size(), result.model.roots.meetings.size());
  EXPECT_TRUE(report.at("labels").at(0).at("certificate").at("passed"));
  const auto columns = nlohmann::json::parse(Bytes("out/columns.json"));
  for (const char * table : { "roots", "levels", "plant", "profile" })
  {
    const std::string text = Bytes(std::string("out/") + table + ".csv");
    std::string       head = text.substr(0, text.find('\n')) + ",";
    for (std::size_t from = 0; from < head.size();)
    {
      const std::size_t comma = head.find(',', from);
      const std::string column = head.substr(from, comma - from);
      EXPECT_TRUE(column == "scan" || columns.at(table).contains(column)) << table << " " << column;
      from = comma + 1;
    }
  }
}

TEST_F(RootsJob, PiecesThatAreLeftOutAreWarnedOfAndLoosePiecesAreMarked)
{
  // How wide gaps are depends on the threshold.
  const ParameterValues halfway{ { "threshold", "20000:inf" } };
  PhantomJobOptions     phantom = Scan("whole.nrrd");
  const RootsResult     whole = Roots("whole.nrrd", "whole/", halfway);
  EXPECT_TRUE(whole.warnings.empty());
  phantom.scan->breaks = 4;
  phantom.output = At("torn.nrrd");
  RunPhantomJob(phantom);
  const RootsResult mended = Roots("torn.nrrd", "mended/", halfway);
  EXPECT_TRUE(mended.warnings.empty());
  EXPECT_GT(mended.report.labels.at(0).edits->torn->componentsJoined, 0U);
  EXPECT_EQ(mended.model.roots.axes.size(), whole.model.roots.axes.size());
  EXPECT_NEAR(mended.model.traits.levels.back().totalLength / whole.model.traits.levels.back().totalLength, 1, 0.02);
  // As where pieces lie too far apart.
  const RootsResult torn = Roots("torn.nrrd", "torn/", halfway, 0);
  ASSERT_EQ(torn.warnings.size(), 1U);
  EXPECT_NE(torn.warnings[0].find("are left out"), std::string::npos);
  const RootsResult joined = Roots("torn.nrrd", "joined/", { { "min-voxels", "20" } }, 0);
  EXPECT_TRUE(joined.warnings.empty());
  ASSERT_TRUE(joined.topology);
  EXPECT_GT(joined.topology->before.betti[0], 1);
  EXPECT_EQ(joined.topology->after.betti[0], 1) << "a break of a voxel is filled";
  const RootsResult kept = Roots("torn.nrrd", "kept/", { { "min-voxels", "20" }, { "keep-loops", "true" } }, 0);
  EXPECT_TRUE(kept.warnings.empty());
  EXPECT_TRUE(std::any_of(kept.model.roots.axes.begin(), kept.model.roots.axes.end(), [](const RootAxis & axis) {
    return axis.loose;
  }));
}

TEST_F(RootsJob, APrefixBeginsTheNamesOfAllFilesAndNothingElseDiffers)
{
  Scan("a.nrrd");
  Roots("a.nrrd", "out/");
  Roots("a.nrrd", "named/", { { "prefix", "maize-3_" } });
  std::set<std::string> names;
  for (const std::string & name : kTables)
  {
    names.insert("maize-3_" + name);
  }
  EXPECT_EQ(In("named"), names);
  EXPECT_EQ(Bytes("named/maize-3_roots.csv"), Bytes("out/roots.csv"));
  for (const char * wrong : { "a/b", ".hidden", "a b", "\"" })
  {
    EXPECT_THROW(Roots("a.nrrd", "wrong/", { { "prefix", wrong } }), UsageError) << wrong;
  }
}

TEST_F(RootsJob, TheMedialSurfaceOfATornRootIsRecheckedAgainstTheScan)
{
  PhantomJobOptions options = Scan("root.nrrd");
  options.scan->breaks = 3;
  options.output = At("torn.nrrd");
  RunPhantomJob(options);
  Roots("torn.nrrd", "torn/");
  const auto provenance = ReadModel(At("torn/medial.vtp")).provenance;
  EXPECT_NE(provenance.find("join_torn"), std::string::npos);
  VerifyOptions verify;
  verify.scan = At("torn.nrrd");
  verify.core = At("torn/medial.vtp");
  EXPECT_TRUE(RunVerifyJob(verify).passed);
}

TEST_F(RootsJob, UpsideDownItIsTheSamePlant)
{
  Scan("a.nrrd");
  const RootsResult upright = Roots("a.nrrd", "out/");
  const RootsResult wrong = Roots("a.nrrd", "wrong/", { { "up", "z-" } });
  EXPECT_EQ(wrong.model.roots.up, (Vector3{ 0, 0, -1 }));
  EXPECT_LT(wrong.model.traits.roots[0].tipDepth, wrong.model.traits.depth + 1e-9);
  const auto & places = upright.model.graph.positions;
  ASSERT_EQ(places.size(), wrong.model.graph.positions.size());
  double sum = 0;
  for (std::size_t point = 0; point < places.size(); ++point)
  {
    // Run through the other way, thin roots are put in their middles by half a slice at most.
    const double away = Distance(places[point], wrong.model.graph.positions[point]);
    EXPECT_LE(away, 0.5 + 1e-9);
    sum += away;
  }
  EXPECT_LT(sum / static_cast<double>(places.size()), 0.02);
}

TEST_F(RootsJob, NothingIsWrittenWhereSomethingIsInTheWay)
{
  Scan("a.nrrd");
  Roots("a.nrrd", "out/");
  const std::string before = Bytes("out/roots.csv");
  EXPECT_THROW(Roots("a.nrrd", "out/"), OutputError);
  Roots("a.nrrd", "out/", { { "force", "true" } });
  EXPECT_EQ(Bytes("out/roots.csv"), before);
  EXPECT_THROW(Roots("none.nrrd", "other/"), InputError);
  EXPECT_FALSE(std::filesystem::exists(At("other")));
  Phantom("cells", "cells.nrrd");
  EXPECT_THROW(Roots("cells.nrrd", "other/"), UsageError);
  EXPECT_FALSE(std::filesystem::exists(At("other")));
}

TEST_F(RootsJob, DirectionsAreWordsForTheAxes)
{
  EXPECT_FALSE(ParseUp("auto"));
  for (const char * text : { "x+", "x-", "y+", "y-", "z+", "z-" })
  {
    EXPECT_EQ(UpText(*ParseUp(text)), text);
  }
  EXPECT_THROW(ParseUp("z"), UsageError);
}

TEST_F(RootsJob, WhatTheUserAsksForOfTheCleaningTakesPrecedence)
{
  ShapeEditOptions edits;
  CleanForRoots(edits);
  EXPECT_TRUE(edits.mend && edits.fillCavities);
  EXPECT_EQ(*edits.largest, 1U);
  ShapeEditOptions own;
  own.minVoxels = 100;
  CleanForRoots(own);
  EXPECT_FALSE(own.largest);
  Scan("a.nrrd", 0.7);
  EXPECT_EQ(Roots("a.nrrd", "out/").report.parameters.edits.fillHollows->text, "2.5vox");
  EXPECT_EQ(Roots("a.nrrd", "wide/", { { "fill-hollows", "3vox" } }).report.parameters.edits.fillHollows->text, "3vox");
  const auto closed = Roots("a.nrrd", "closed/", { { "close", "4vox" } }).report.parameters.edits;
  EXPECT_FALSE(closed.fillHollows);
  EXPECT_TRUE(closed.close);
}

TEST_F(RootsJob, TheLengthOfTheSkeletonIsOnRootsOrListed)
{
  Scan("a.nrrd", 0, 3);
  const RootsResult   result = Roots("a.nrrd", "out/");
  const RootBalance & balance = result.model.traits.balance;
  EXPECT_GT(balance.skeleton, 0);
  EXPECT_NEAR(balance.Missing(), 0, 1e-9 * balance.skeleton);
  EXPECT_LT(balance.bridges, 0.01 * balance.skeleton);
  const auto json = nlohmann::json::parse(Bytes("out/report.json")).at("roots").at("balance");
  EXPECT_NEAR(json.at("skeleton").get<double>(), balance.skeleton, 1e-4 * balance.skeleton);
  EXPECT_NEAR(json.at("bulges").get<double>(), balance.bulges, 1e-4 * balance.skeleton);
  EXPECT_NE(RootsText(result).find("within their parents"), std::string::npos);
}

TEST_F(RootsJob, AStemThatIsThinnerThanItsLateralsIsWarnedOf)
{
  Scan("a.nrrd");
  const auto warns = [](const RootsResult & result) {
    return std::ranges::any_of(result.warnings, [](const std::string & warning) {
      return warning.find("the stem is") != std::string::npos && warning.find("--stem X,Y,Z") != std::string::npos;
    });
  };
  const RootsResult right = Roots("a.nrrd", "out/");
  EXPECT_FALSE(warns(right));
  const RootAxis & thin = right.model.roots.axes.back();
  std::string      place;
  for (const double x : right.model.graph.positions[thin.points.back()])
  {
    place += (place.empty() ? "" : ",") + std::to_string(x);
  }
  EXPECT_TRUE(warns(Roots("a.nrrd", "thin/", { { "stem", place } })));
  EXPECT_THROW(Roots("a.nrrd", "no/", { { "stem", "1,2" } }), UsageError);
}

// Where in the grid a plant lies is nothing to its roots (BodyFrame.h).
TEST_F(RootsJob, APlantElsewhereInTheGridHasTheSameRoots)
{
  PhantomJobOptions phantom = Scan("grey.nrrd", 0, 3);
  phantom.scan.reset();
  phantom.output = At("a.nrrd");
  RunPhantomJob(phantom);
  LabelMap                          volume = ReadLabelVolume(At("a.nrrd"), {});
  const std::array<std::int32_t, 3> by{ 5, 71, 12 };
  for (std::size_t k = 0; k < 3; ++k)
  {
    volume.geometry.size[k] += by[k] + 3;
    volume.geometry.origin[k] -= by[k] * volume.geometry.spacing[k];
  }
  LabelShape moved = volume.labels.at(0);
  auto       lower = moved.shape.Box().lower;
  for (std::size_t k = 0; k < 3; ++k)
  {
    lower[k] += by[k];
  }
  moved.shape = MovedTo(lower, moved.shape);
  WriteLabelVolume(At("b.nrrd"), volume.geometry, { moved });
  const RootsResult here = Roots("a.nrrd", "a/");
  const RootsResult there = Roots("b.nrrd", "b/");
  ASSERT_TRUE(here.topology) << "roots touch";
  EXPECT_EQ(here.model.graph.positions, there.model.graph.positions);
  for (const char * file : { "roots.csv", "levels.csv", "roots.swc" })
  {
    const auto rows = [&](const std::string & folder) {
      const std::string text = Bytes(folder + file);
      return text.substr(text.find("\n", text.rfind("\n#") == std::string::npos ? 0 : text.rfind("\n#") + 1));
    };
    EXPECT_EQ(rows("a/"), rows("b/")) << file;
  }
}

} // namespace
} // namespace voxelcore::testing
