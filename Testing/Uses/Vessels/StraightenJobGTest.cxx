#include "Program/Jobs/JobFolder.h"

#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Vessels/StraightenCommand.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Report/CsvText.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <numeric>
#include <omp.h>
#include <random>

namespace voxelcore::testing
{
namespace
{

/** A ring, labels as they come from `phantom`, with its skeleton; and a scan of the same grid whose values are linear
 *  in place. */
class StraightenJob : public JobFolder
{
protected:
  StraightenJob()
  {
    RunPhantomJob(PhantomOptionsFrom(
      { { "kind", "torus" }, { "size", "40" }, { "spacing", "0.8,0.8,0.8" }, { "output", At("ring.nrrd") } }));
    RunSkeletonJob(SkeletonOptionsFrom({ { "scan", At("ring.nrrd") }, { "output", At("ring.vtp") } }));
    ring = ReadGreyVolume(At("ring.nrrd"), { { 0, 0, 0 }, { 40, 40, 40 } });
    std::vector<std::uint16_t> values;
    for (int i = 0; i < 40 * 40 * 40; ++i)
    {
      values.push_back(static_cast<std::uint16_t>(1000 + 7 * (i % 40) + 11 * (i / 40 % 40) + 13 * (i / 1600)));
    }
    WriteGreyVolume(At("grey.nrrd"), ring.geometry, values);
  }

  static ParameterValues
  With(ParameterValues values, const ParameterValues & more)
  {
    for (const auto & [name, value] : more)
    {
      values[name] = value;
    }
    return values;
  }
  StraightenResult
  Run(const std::string & scan, const std::string & output, const ParameterValues & more = {}) const
  {
    ParameterValues values{ { "scan", At(scan) }, { "skeleton", At("ring.vtp") }, { "output", At(output) } };
    if (!more.contains("from"))
    {
      values["branch"] = "0";
    }
    return RunStraightenJob(StraightenOptionsFrom(With(values, more)));
  }
  GreyVolume
  Read(const std::string & name, const ImageGeometry & geometry) const
  {
    VoxelBox box;
    for (std::size_t k = 0; k < 3; ++k)
    {
      box.size[k] = static_cast<std::int32_t>(geometry.size[k]);
    }
    return ReadGreyVolume(At(name), box);
  }
  /** Rows of a table by the names of columns. */
  std::vector<std::map<std::string, double>>
  Table(const std::string & name) const
  {
    const auto                                 rows = ParseCsv(Bytes(name), name);
    std::vector<std::map<std::string, double>> table;
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
      table.emplace_back();
      for (std::size_t k = 0; k < rows[0].fields.size(); ++k)
      {
        const std::string & field = rows[row].fields.at(k);
        table.back()[rows[0].fields[k]] = field.empty() ? std::nan("") : std::stod(field);
      }
    }
    return table;
  }
  double
  LinearAt(const Vector3 & place) const
  {
    const Vector3 lattice = PhysicalToLattice(ring.geometry, place);
    return 1000 + 7 * (lattice[0] - .5) + 11 * (lattice[1] - .5) + 13 * (lattice[2] - .5);
  }

  GreyVolume ring;
};

Vector3
Of(const std::map<std::string, double> & row, const std::string & name)
{
  const std::string joined = name.empty() ? "" : name + "_";
  return { row.at(joined + "x"), row.at(joined + "y"), row.at(joined + "z") };
}

} // namespace

TEST_F(StraightenJob, LabelsStayLabelsAndTheRingsVolumeIsThatOfTheTube)
{
  const StraightenResult result = Run("ring.nrrd", "tube.nrrd");
  EXPECT_FALSE(result.isLinear);
  const GreyVolume tube = Read("tube.nrrd", result.geometry);
  EXPECT_EQ(tube.geometry.spacing, (Vector3{ .8, .8, .8 }));
  EXPECT_EQ(tube.geometry.origin[2], 0);
  EXPECT_NEAR(tube.geometry.origin[0], -.8 * static_cast<double>(tube.geometry.size[0] / 2), 1e-9);
  EXPECT_NE(Bytes("tube.nrrd").find("type: uint"), std::string::npos);
  double in = 0;
  for (const float value : tube.values)
  {
    EXPECT_TRUE(value == 0 || value == 1);
    in += value;
  }
  // Pappus: a tube has the volume of its section times the length of its axis, bent or not.
  const double voxels = std::accumulate(ring.values.begin(), ring.values.end(), 0.0);
  const double planes = static_cast<double>(tube.geometry.size[2]) * .8;
  EXPECT_NEAR(in / planes * result.length / voxels, 1, .02);
}

TEST_F(StraightenJob, GreyValuesAreThoseOfThePlacesThatTheTableGives)
{
  const StraightenResult result =
    Run("grey.nrrd", "tube.nrrd", { { "spacing", "0.5,0.7,0.9" }, { "width", "4mm" }, { "table", At("planes.csv") } });
  EXPECT_TRUE(result.isLinear);
  EXPECT_EQ(result.geometry.size[0], 17);
  EXPECT_EQ(result.geometry.size[1], 13);
  const GreyVolume tube = Read("tube.nrrd", result.geometry);
  const auto       planes = Table("planes.csv");
  ASSERT_EQ(static_cast<std::int64_t>(planes.size()), result.geometry.size[2]);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(planes.size()); ++k)
  {
    const auto & plane = planes[static_cast<std::size_t>(k)];
    EXPECT_NEAR(plane.at("arc_length"), .9 * k, 1e-9);
    for (std::int32_t b = 0; b < 13; ++b)
    {
      for (std::int32_t a = 0; a < 17; ++a)
      {
        const Vector3 place =
          AddScaled(AddScaled(Of(plane, ""), .5 * (a - 8), Of(plane, "across")), .7 * (b - 6), Of(plane, "up"));
        EXPECT_NEAR(*(tube.Row(0, b, k) + a), LinearAt(place), 2e-3);
      }
    }
  }
}

TEST_F(StraightenJob, PointsAreMappedBothWays)
{
  std::ofstream(At("in.csv")) << "name,across,up,arc_length\np,1,-2,10.25\nq,0,0,20\nr,50,0,5\n";
  Run("grey.nrrd", "tube.nrrd", { { "points", At("in.csv") }, { "mapped", At("there.csv") } });
  const auto there = Table("there.csv");
  ASSERT_EQ(there.size(), 3U);
  EXPECT_EQ(there[0].at("in_volume"), 1);
  EXPECT_EQ(there[2].at("in_volume"), 0);
  std::ofstream places(At("places.csv"));
  places << "x,y,z\n";
  places.precision(12);
  for (const auto & row : there)
  {
    places << row.at("x") << "," << row.at("y") << "," << row.at("z") << "\n";
  }
  places.close();
  Run("grey.nrrd", "again.nrrd", { { "points", At("places.csv") }, { "mapped", At("back.csv") } });
  const auto back = Table("back.csv");
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    for (const char * name : { "across", "up", "arc_length", "x", "y", "z" })
    {
      EXPECT_NEAR(back[i].at(name), there[i].at(name), 1e-6) << name;
    }
  }
  EXPECT_NEAR(there[0].at("arc_length"), 10.25, 1e-9);
}

TEST_F(StraightenJob, ATableOfPointsSaysOnceWhereTheyAre)
{
  std::ofstream(At("both.csv")) << "x,y,z,across,up,arc_length\n1,2,3,4,5,6\n";
  std::ofstream(At("bad.csv")) << "x,y,z\n1,2,\n";
  const auto message = [&](const char * name) {
    try
    {
      Run("grey.nrrd", "tube.nrrd", { { "points", At(name) }, { "mapped", At("m.csv") } });
    }
    catch (const InputError & error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("both.csv").find("arc_length"), std::string::npos);
  EXPECT_NE(message("bad.csv").find("line 2"), std::string::npos);
  EXPECT_FALSE(Names().contains("tube.nrrd"));
}

TEST_F(StraightenJob, TheWayBetweenPointsIsPartOfTheRing)
{
  // A quarter of the ring.
  const auto all = Run("grey.nrrd", "all.nrrd", { { "table", At("planes.csv") } });
  const auto planes = Table("planes.csv");
  const auto text = [&](std::size_t i) {
    const Vector3 place = Of(planes[i], "");
    return std::to_string(place[0]) + "," + std::to_string(place[1]) + "," + std::to_string(place[2]);
  };
  const auto part =
    Run("grey.nrrd", "part.nrrd", { { "from", text(planes.size() / 4) }, { "to", text(planes.size() / 2) } });
  EXPECT_NEAR(part.length, planes[planes.size() / 2].at("arc_length") - planes[planes.size() / 4].at("arc_length"), .3);
  EXPECT_LT(part.length, .3 * all.length);
}

TEST_F(StraightenJob, GivesTheSameForEveryNumberOfThreads)
{
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  Run("grey.nrrd", "one.nrrd");
  omp_set_num_threads(3);
  Run("grey.nrrd", "three.nrrd");
  omp_set_num_threads(threads);
  EXPECT_EQ(Bytes("one.nrrd"), Bytes("three.nrrd"));
}

TEST_F(StraightenJob, RefusesWhatHasNoSense)
{
  const auto usage = [&](const ParameterValues & more) {
    try
    {
      Run("grey.nrrd", "tube.nrrd", more);
    }
    catch (const UsageError & error)
    {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(usage({ { "branch", "7" } }).find("no branch 7"), std::string::npos);
  EXPECT_NE(usage({ { "branch", "-1" } }).find("--branch"), std::string::npos);
  EXPECT_NE(usage({ { "from", "1,2,3" } }).find("--to"), std::string::npos);
  EXPECT_NE(usage({ { "from", "1,2,3;4,5,6" }, { "to", "1,2,3" } }).find("one point"), std::string::npos);
  EXPECT_NE(usage({ { "width", "5%" } }).find("--width"), std::string::npos);
  EXPECT_NE(usage({ { "spacing", "1e-6" } }).find("--spacing"), std::string::npos);
  EXPECT_NE(usage({ { "points", At("ring.vtp") } }).find("--mapped"), std::string::npos);
  EXPECT_NE(usage({ { "label", "x" } }).find("--label"), std::string::npos);
  EXPECT_THROW(Run("grey.nrrd", "x.nrrd", { { "label", "9" } }), InputError);
  EXPECT_THROW(Run("grey.nrrd", "ring.nrrd", {}), OutputError) << "is there";
  EXPECT_THROW(Run("grey.nrrd", "grey.nrrd", { { "force", "true" } }), OutputError) << "the scan itself";
  ImageGeometry away = ring.geometry;
  away.origin[0] += 1000;
  WriteGreyVolume(At("away.nrrd"), away, std::vector<std::uint16_t>(64000, 1));
  EXPECT_THROW(Run("away.nrrd", "y.nrrd"), InputError);
}

} // namespace voxelcore::testing
