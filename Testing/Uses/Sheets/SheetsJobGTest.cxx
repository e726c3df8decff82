#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Sheets/SheetsCommand.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/RenderJob.h"
#include "voxelcore/Models/PlainSurface.h"
#include "voxelcore/Sheets/SheetsJob.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace voxelcore::testing
{
namespace
{

class SheetsJob : public JobFolder
{
protected:
  SheetsResult
  Sheets(const std::string & output, ParameterValues more = {}, const JobContext & context = {}) const
  {
    more.insert({ { "scan", At("a.nrrd") }, { "output", At(output) } });
    return RunSheetsJob(SheetsOptionsFrom(more), context);
  }

  /** Three walls 5 voxels thick that meet in a line. */
  void
  ThreeWalls() const
  {
    ImageGeometry geometry;
    geometry.size = { 64, 64, 40 };
    VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 64, 64, 40 } });
    for (std::int32_t z = 4; z < 36; ++z)
    {
      for (std::int32_t y = 0; y < 64; ++y)
      {
        for (std::int32_t x = 0; x < 64; ++x)
        {
          for (int k = 0; k < 3; ++k)
          {
            const double turn = 0.3 + k * 2 * std::acos(-1.0) / 3;
            const double along = (x - 31.5) * std::cos(turn) + (y - 31.5) * std::sin(turn);
            const double across = (y - 31.5) * std::cos(turn) - (x - 31.5) * std::sin(turn);
            if (along > 0 && along < 26 && std::abs(across) < 2.5)
            {
              shape.Insert(x, y, z);
            }
          }
        }
      }
    }
    const std::uint64_t voxels = shape.CountVoxels();
    WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "walls", voxels, CropToVoxels(shape) } });
  }
};

TEST_F(SheetsJob, TheFileIsReadAgainSheetBySheetAndDrawnInTheirColours)
{
  ThreeWalls();
  const SheetsResult result = Sheets("s.vtp");
  const auto         read = ReadSheetSurfaces(At("s.vtp"));
  ASSERT_TRUE(read);
  const SheetPart & part = result.model.parts.front();
  std::size_t       rods = 0;
  for (const CurveRecord & curve : part.sheets.curves)
  {
    rods += curve.isRod && curve.vertices.size() > 1 ? 1 : 0;
  }
  ASSERT_EQ(read->sheets.size(), part.sheets.sheets.size() + rods);
  std::size_t faces = 0;
  for (const SheetSurface & sheet : read->sheets)
  {
    faces += sheet.plain.surface.cells.FaceCount();
    EXPECT_EQ(sheet.thickness.size(), sheet.plain.surface.cells.vertexCount);
    EXPECT_TRUE(sheet.plain.hasRadius);
  }
  EXPECT_EQ(faces, part.sheets.sheetOfFace.size());
  EXPECT_FALSE(ReadSheetSurfaces(At("a.nrrd")));
  if (HasDisplay())
  {
    RenderJobOptions options;
    options.files = { At("s.vtp") };
    options.output = At("s.png");
    options.coloring = "SheetId";
    options.scan = At("a.nrrd");
    EXPECT_THROW(RunRenderJob(options), UsageError) << "sheets are drawn alone";
    Core("core.vtp");
    options.scan.reset();
    options.files = { At("core.vtp") };
    EXPECT_THROW(RunRenderJob(options), UsageError) << "no sheets";
    EXPECT_FALSE(Names().contains("s.png"));
  }
}

TEST_F(SheetsJob, RodsAreDrawnAsRodsAndNotAsSheets)
{
  Phantom("rod", "a.nrrd", "32");
  const SheetsResult result = Sheets("s.vtp");
  ASSERT_EQ(result.totals[0].sheets, 0U);
  ASSERT_EQ(result.totals[0].rods, 1U);
  RenderJobOptions options;
  options.files = { At("s.vtp") };
  options.output = At("s.png");
  options.coloring = "SheetId";
  options.labels = "sheet 1";
  EXPECT_THROW(RunRenderJob(options), InputError);
  if (HasDisplay())
  {
    options.labels = "rod 1";
    RunRenderJob(options);
    EXPECT_TRUE(Names().contains("s.png"));
  }
}

TEST_F(SheetsJob, ThreeWallsAreThreeSheetsAndASeam)
{
  ThreeWalls();
  const SheetsResult result = Sheets(
    "s.vtp",
    { { "voxels", At("v.nrrd") }, { "table", At("t.csv") }, { "graph", At("g.graphml") }, { "report", At("r.json") } });
  ASSERT_EQ(result.totals.size(), 1U);
  EXPECT_EQ(result.totals[0].sheets, 3U);
  EXPECT_EQ(result.totals[0].seams, 1U);
  EXPECT_EQ(result.totals[0].junctions, 0U);
  for (const SheetRecord & sheet : result.model.parts[0].sheets.sheets)
  {
    EXPECT_NEAR(sheet.thickness, 5, 0.5);
    EXPECT_GT(sheet.flatness, 0.95);
    EXPECT_EQ(sheet.neighbours.size(), 2U);
  }
  EXPECT_EQ(
    Names(),
    (std::set<
      std::string>{ "a.nrrd", "s.vtp", "v.nrrd", "t.csv", "t_seams.csv", "t_columns.json", "g.graphml", "r.json" }));
  const auto report = nlohmann::json::parse(Bytes("r.json"));
  EXPECT_EQ(report["sheets"][0]["sheets"], 3);
  // Every voxel of the label has the number of a sheet or rod, and the numbers add up to what tables say.
  const GreyVolume             volume = ReadGreyVolume(At("v.nrrd"), VoxelBox{ { 0, 0, 0 }, { 64, 64, 40 } });
  std::map<int, std::uint64_t> counts;
  for (const float value : volume.values)
  {
    counts[static_cast<int>(value)] += value > 0 ? 1 : 0;
  }
  const auto &  voxels = result.model.parts[0].voxels;
  std::uint64_t sum = 0;
  for (std::uint32_t sheet = 0; sheet < 3; ++sheet)
  {
    EXPECT_EQ(counts[static_cast<int>(sheet + 1)], voxels[sheet]);
    sum += voxels[sheet];
  }
  EXPECT_EQ(sum + result.totals[0].rodVoxels, result.report.labels[0].voxels);
}

TEST_F(SheetsJob, VoxelsOfAnUnrefinedLabelBelongToTheSheetOfTheirWall)
{
  ThreeWalls();
  for (const char * tolerance : { "1.2diag", "0.5diag" })
  {
    SCOPED_TRACE(tolerance);
    const std::string        name = std::string("v") + tolerance + ".nrrd";
    const SheetsResult       result = Sheets(std::string("s") + tolerance + ".vtp",
                                       { { "voxels", At(name) }, { "refine", "off" }, { "tolerance", tolerance } });
    const std::vector<float> numbers = ReadGreyVolume(At(name), VoxelBox{ { 0, 0, 0 }, { 64, 64, 40 } }).values;
    EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count_if(numbers, [](float one) { return one > 0; })),
              result.report.labels[0].voxels);
    std::set<float> ofWalls;
    for (int k = 0; k < 3; ++k)
    {
      // In the middle of the wall, from beyond the balls of the seam to its rim.
      const double    turn = 0.3 + k * 2 * std::acos(-1.0) / 3;
      std::set<float> found;
      for (double along = 8; along < 22; along += 0.5)
      {
        const auto x = static_cast<std::size_t>(std::lround(31.5 + along * std::cos(turn)));
        const auto y = static_cast<std::size_t>(std::lround(31.5 + along * std::sin(turn)));
        found.insert(numbers[(std::size_t{ 20 } * 64 + y) * 64 + x]);
      }
      ASSERT_EQ(found.size(), 1U) << "wall " << k;
      ofWalls.insert(*found.begin());
    }
    EXPECT_EQ(ofWalls.size(), 3U);
  }
}

TEST_F(SheetsJob, ACoresFileGivesTheSheetsOfItsScan)
{
  ThreeWalls();
  Core("core.vtp", { { "refine", "labels" } });
  const SheetsResult from = Sheets("s.vtp", { { "scan", At("core.vtp") } });
  const SheetsResult direct = Sheets("d.vtp");
  EXPECT_EQ(from.totals[0].sheets, direct.totals[0].sheets);
  EXPECT_EQ(from.totals[0].area, direct.totals[0].area);
  EXPECT_TRUE(from.model.parts[0].voxels.empty());
  EXPECT_THROW(Sheets("x.vtp", { { "scan", At("core.vtp") }, { "voxels", At("v.nrrd") } }), UsageError);
}

TEST_F(SheetsJob, ACoresFileRefusesOptionsOfScans)
{
  ThreeWalls();
  Core("core.vtp", { { "refine", "labels" } });
  for (const auto & [option, value] : ParameterValues{ { "labels", "1" },
                                                       { "binary", "true" },
                                                       { "tolerance", "2diag" },
                                                       { "refine", "off" },
                                                       { "median", "3" },
                                                       { "spacing", "1,1,2" } })
  {
    try
    {
      Sheets("s.vtp", { { "scan", At("core.vtp") }, { option, value } });
      ADD_FAILURE() << option << " is passed over";
    }
    catch (const UsageError & error)
    {
      EXPECT_NE(std::string(error.what()).find("the scan to 'voxelcore sheets'"), std::string::npos) << error.what();
    }
  }
  EXPECT_FALSE(Names().contains("s.vtp"));
}

TEST_F(SheetsJob, NamesThatCannotBeHadAreFoundBeforeAnythingIsComputed)
{
  ThreeWalls();
  for (const std::string name : { "t_seams.csv", "t_columns.json" })
  {
    std::ofstream(At(name)) << "mine";
    double came = 0;
    EXPECT_THROW(Sheets("s.vtp", { { "table", At("t.csv") } }, Noting(came)), OutputError) << name;
    EXPECT_EQ(came, 0) << name;
    EXPECT_EQ(Bytes(name), "mine");
    std::filesystem::remove(At(name));
  }
  EXPECT_THROW(Sheets("s.vtp", { { "table", At("t.csv") }, { "report", At("t_columns.json") } }), UsageError);
}

TEST_F(SheetsJob, RefusesWhatMakesNoSenseAndLeavesNothingWhenStopped)
{
  ThreeWalls();
  EXPECT_THROW(Sheets("s.nrrd"), UsageError);
  EXPECT_THROW(Sheets("s.vtp", { { "sliver", "wide" } }), UsageError);
  EXPECT_THROW(Sheets("s.vtp", { { "graph", At("g.xml") } }), UsageError);
  EXPECT_THROW(Sheets("s.vtp", { { "labels", "9" } }), InputError);
  for (const int calls : { 1, 10 })
  {
    EXPECT_THROW(Sheets("s.vtp", {}, StoppingAfter(calls)), Cancelled);
  }
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd" }));
}

} // namespace
} // namespace voxelcore::testing
