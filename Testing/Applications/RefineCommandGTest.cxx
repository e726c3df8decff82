// Refined cores as a user makes them: nearer to the truth, checked by verify, and refused where they make no sense.

#include "CommandFixture.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include "voxelcore/Models/MedialModel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

// An ellipsoid, turned; its axis lies in the plane through its middle across its shortest axis.
constexpr Vector3                kSemi{ 17, 12, 8 };
constexpr Vector3                kCentre{ 19.3, 18.6, 18.1 };
constexpr std::array<Vector3, 3> kAxes{ { { 0.64, 0.48, 0.6 }, { -0.6, 0.8, 0 }, { -0.48, -0.36, 0.8 } } };

double
AddScaled(const Vector3 & place, std::size_t axis)
{
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    sum += (place[k] - kCentre[k]) * kAxes[axis][k];
  }
  return sum;
}

/** How much of a voxel lies in the ellipsoid, by 4^3 places in it: what a scanner sees. */
double
PartInside(const Vector3 & centre, double slice)
{
  constexpr int places = 4;
  int           inside = 0;
  for (int i = 0; i < places * places * places; ++i)
  {
    const auto    offset = [](int at) { return (at + 0.5) / places - 0.5; };
    const Vector3 place{ centre[0] + offset(i % places),
                         centre[1] + offset(i / places % places),
                         centre[2] + slice * offset(i / places / places) };
    inside +=
      std::hypot(AddScaled(place, 0) / kSemi[0], AddScaled(place, 1) / kSemi[1], AddScaled(place, 2) / kSemi[2]) <= 1;
  }
  return static_cast<double>(inside) / (places * places * places);
}

class RefineCommand : public CommandFixture
{
protected:
  /** Writes grey.nrrd, float, 0 outside and 1000 inside, and labels.nrrd, what is 500 at least. */
  void
  WriteEllipsoid(double slice) const
  {
    const std::array<std::size_t, 3> size{ 39, 38, static_cast<std::size_t>(37 / slice) };
    TestScan                         labels(size);
    labels.spacing = { 1, 1, slice };
    std::string bytes;
    for (std::size_t z = 0; z < size[2]; ++z)
    {
      for (std::size_t y = 0; y < size[1]; ++y)
      {
        for (std::size_t x = 0; x < size[0]; ++x)
        {
          const Vector3 place{ static_cast<double>(x), static_cast<double>(y), slice * static_cast<double>(z) };
          const auto    value = static_cast<float>(1000 * PartInside(place, slice));
          labels.At(x, y, z) = value >= 500 ? 7 : 0;
          std::array<char, sizeof(value)> raw;
          std::memcpy(raw.data(), &value, sizeof(value));
          bytes.append(raw.data(), raw.size());
        }
      }
    }
    WriteNrrd(m_Folder / "labels.nrrd", labels);
    std::ostringstream header;
    header << "type: float\nendian: little\ndimension: 3\nsizes: " << size[0] << ' ' << size[1] << ' ' << size[2]
           << "\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0," << slice
           << ")\nspace origin: (-5,6.5,7)\n";
    WriteNrrd(m_Folder / "grey.nrrd", header.str(), bytes);
  }

  /** The same as a mesh, where the voxels are. */
  void
  WriteMesh() const
  {
    constexpr int      around = 96;
    constexpr int      down = 48;
    std::ostringstream points;
    std::ostringstream faces;
    points.precision(17);
    for (int j = 0; j <= down; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const double  polar = M_PI * j / down;
        const double  azimuth = 2 * M_PI * i / around;
        const Vector3 own{ kSemi[0] * std::sin(polar) * std::cos(azimuth),
                           kSemi[1] * std::sin(polar) * std::sin(azimuth),
                           j == down ? -kSemi[2] : kSemi[2] * std::cos(polar) };
        for (std::size_t k = 0; k < 3; ++k)
        {
          const bool pole = j == 0 || j == down;
          points << kCentre[k] + (pole ? 0 : own[0] * kAxes[0][k] + own[1] * kAxes[1][k]) + own[2] * kAxes[2][k] << ' ';
        }
        points << '\n';
        const int next = (i + 1) % around;
        if (j < down)
        {
          faces << "4 " << j * around + i << ' ' << (j + 1) * around + i << ' ' << (j + 1) * around + next << ' '
                << j * around + next << '\n';
        }
      }
    }
    WriteAll(m_Folder / "mesh.off",
             "OFF\n" + std::to_string(around * (down + 1)) + " " + std::to_string(around * down) + " 0\n" +
               points.str() + faces.str());
  }

  /** Mean distance of a core's vertices from the plane of the axis, mm. */
  double
  MeanHeight(const std::string & name, const Vector3 & origin) const
  {
    const ModelPart part = ReadModel(m_Folder / name).parts.at(0);
    double          sum = 0;
    for (const Vector3 & p : part.core.positions)
    {
      sum += std::abs(AddScaled({ p[0] - origin[0], p[1] - origin[1], p[2] - origin[2] }, 2));
    }
    return sum / static_cast<double>(part.core.positions.size());
  }

  void
  ExpectVerified(const std::string & input, const std::string & core) const
  {
    const std::string text = Run({ "verify", Path(input), Path(core) });
    EXPECT_NE(text.find(" checks, all passed"), std::string::npos) << text;
  }

  static constexpr Vector3 kOrigin{ -5, 6.5, 7 };
};

TEST_F(RefineCommand, LabelsAndGreyValuesBringACoreNearerToTheAxisOnThickSlicesToo)
{
  for (const double slice : { 1.0, 2.0 })
  {
    WriteEllipsoid(slice);
    const auto core = [&](const std::string & name, std::vector<std::string> options) {
      std::vector<std::string> all{ "core", Path("labels.nrrd"), "--lambda", "3mm", "-o", Path(name), "--force" };
      all.insert(all.end(), options.begin(), options.end());
      Run(all);
      return MeanHeight(name, kOrigin);
    };
    const double raw = core("raw.vtp", {});
    const double labels = core("l.vtp", { "--refine", "labels", "--report", Path("l.json") });
    const double grey = core("g.vtp", { "--refine", "grey", "--grey", Path("grey.nrrd"), "--grey-range", "500:inf" });
    EXPECT_LT(labels, (slice == 1 ? 0.5 : 0.75) * raw) << "slices of " << slice;
    EXPECT_LT(grey, (slice == 1 ? 0.2 : 0.5) * raw) << "slices of " << slice;
    ExpectVerified("labels.nrrd", "l.vtp");
    ExpectVerified("labels.nrrd", "g.vtp");
    const Json report = Report("l.json");
    const Json pruned = report["labels"][0]["pruned"][0];
    EXPECT_EQ(report["parameters"]["refine"], "labels");
    EXPECT_GT(pruned["mean_displacement_vox"].get<double>(), 0.01);
    EXPECT_LE(pruned["max_displacement_vox"].get<double>(), 1);
    const auto margins = ReadModel(m_Folder / "l.vtp").parts.at(0).radiusMargin;
    EXPECT_EQ(pruned["max_radius_margin_mm"].get<double>(), *std::max_element(margins.begin(), margins.end()));
    EXPECT_TRUE(ReadModel(m_Folder / "g.vtp").parts.at(0).radiusMargin.empty()) << "grey values tell";
    EXPECT_EQ(pruned["betti"], report["labels"][0]["shape"]["betti"]);
    EXPECT_EQ(ReadModel(m_Folder / "l.vtp").refined, "labels");
    EXPECT_EQ(ReadModel(m_Folder / "raw.vtp").refined, "");
    EXPECT_EQ(UnpackedVtp(ReadAll(m_Folder / "raw.vtp")).find("Refined"), std::string::npos);
    // The grey scan by itself gives the same shape, and so the same places.
    Run({ "core",
          Path("grey.nrrd"),
          "--threshold",
          "500:inf",
          "--refine",
          "grey",
          "--lambda",
          "3mm",
          "-o",
          Path("t.vtp"),
          "--force" });
    EXPECT_EQ(ReadModel(m_Folder / "t.vtp").parts[0].core.positions,
              ReadModel(m_Folder / "g.vtp").parts[0].core.positions);
    ExpectVerified("grey.nrrd", "t.vtp");
  }
}

TEST_F(RefineCommand, WhatToleranceLeavesIsRefinedWithItsPromiseAndVerified)
{
  WriteEllipsoid(1);
  const std::vector<std::string> core{ "core", Path("labels.nrrd"), "--with-skeleton" };
  const auto                     made = [&](const std::string & name, std::vector<std::string> options) {
    options.insert(options.begin(), core.begin(), core.end());
    options.insert(options.end(), { "-o", Path(name + ".vtp"), "--report", Path(name + ".json") });
    Run(options);
    ExpectVerified("labels.nrrd", name + ".vtp");
    return Report(name + ".json")["labels"][0];
  };
  const Json raw = made("raw", { "--refine", "off" });
  const Json refined = made("refined", { "--refine", "labels" });
  EXPECT_LT(MeanHeight("refined.vtp", kOrigin), 0.5 * MeanHeight("raw.vtp", kOrigin));
  const Json & before = raw["pruned"][0];
  const Json & after = refined["pruned"][0];
  EXPECT_EQ(after["tolerance"], before["tolerance"]);
  // All of what the tolerance leaves, but for some of its rim.
  EXPECT_LE(after["vertices"], before["vertices"]);
  EXPECT_GT(after["vertices"].get<double>(), 0.9 * before["vertices"].get<double>());
  EXPECT_FALSE(before.contains("hairs_removed"));
  EXPECT_TRUE(after["hairs_removed"].is_number_unsigned());
  EXPECT_EQ(after["betti"], refined["shape"]["betti"]);
  EXPECT_TRUE(refined["certificate"]["covered"] && refined["certificate"]["passed"]);
  const double moved = after["max_displacement_vox"].get<double>();
  EXPECT_GT(moved, 0.01);
  EXPECT_LE(after["boundary_gap_mm"].get<double>(), after["tolerance_mm"].get<double>() + 1e-9);
  // The skeleton has the same branches, at other places.
  for (const char * number : { "betti", "branches", "tips" })
  {
    EXPECT_EQ(refined["skeleton"][number], raw["skeleton"][number]) << number;
  }
  EXPECT_NE(refined["skeleton"]["mean_radius_mm"], raw["skeleton"]["mean_radius_mm"]);
}

TEST_F(RefineCommand, AMeshBringsItsCoreNearerStillAndThreadsDoNotMatter)
{
  WriteMesh();
  const std::vector<std::string> core{ "core", Path("mesh.off"), "--lambda", "3mm", "--force" };
  const auto                     with = [&](std::vector<std::string> options) {
    options.insert(options.begin(), core.begin(), core.end());
    Run(options);
  };
  with({ "--spacing", "1,1,2", "-o", Path("raw.vtp") });
  with({ "--spacing", "1,1,2", "--refine", "mesh", "-o", Path("m.vtp"), "--threads", "1" });
  with({ "--spacing", "1,1,2", "--refine", "mesh", "-o", Path("m2.vtp"), "--threads", "3" });
  EXPECT_EQ(ReadAll(m_Folder / "m.vtp"), ReadAll(m_Folder / "m2.vtp"));
  EXPECT_LT(MeanHeight("m.vtp", { 0, 0, 0 }), 0.4 * MeanHeight("raw.vtp", { 0, 0, 0 }));
  ExpectVerified("mesh.off", "m.vtp");
}

TEST_F(RefineCommand, VerifyFindsWhatWasDamaged)
{
  WriteEllipsoid(1);
  Run({ "core", Path("labels.nrrd"), "--lambda", "3mm", "--refine", "labels", "-o", Path("l.vtp") });
  const MedialModel good = ReadModel(m_Folder / "l.vtp");
  const auto        expect = [&](const std::string & check, const std::function<void(ModelPart &)> & damage) {
    MedialModel model = good;
    damage(model.parts[0]);
    WriteModel(m_Folder / "d.vtp", "d.vtp", model);
    const ProgramResult result = RunProgram({ "verify", Path("labels.nrrd"), Path("d.vtp") });
    EXPECT_EQ(result.code, 4) << check;
    EXPECT_NE(result.output.find("FAILED  " + check), std::string::npos) << check << ": " << result.output;
  };
  expect("origins equidistant", [](ModelPart & part) { part.core.positions[5][0] += 1e-6; });
  expect("displacement", [](ModelPart & part) {
    part.core.positions[5][2] += 1.2 - part.displacement[5][2];
    part.displacement[5][2] = 1.2;
  });
  expect("faces not turned over", [](ModelPart & part) {
    // A corner laid over the middle of the opposite side, and as far beyond.
    const auto corners = part.core.cells.FaceVertices(0);
    auto &     p = part.core.positions;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double move = p[corners[1]][k] + p[corners[2]][k] - 2 * p[corners[0]][k];
      p[corners[0]][k] += move;
      part.displacement[corners[0]][k] += move;
    }
  });
  expect("radius", [](ModelPart & part) { part.core.radius[3] += 4; });
  expect("vertices inside", [](ModelPart & part) {
    part.core.positions[2][2] += 40;
    part.displacement[2][2] += 40;
  });
}

TEST_F(RefineCommand, WhatMakesNoSenseIsRefusedInOneLine)
{
  WriteEllipsoid(1);
  const auto refuse = [&](int code, const std::vector<std::string> & words, std::vector<std::string> options) {
    std::vector<std::string> all{ "core", Path("labels.nrrd"), "-o", Path("x.vtp") };
    all.insert(all.end(), options.begin(), options.end());
    ExpectRefusal(RunProgram(all), code, words);
    EXPECT_EQ(m_Folder.Names().count("x.vtp"), 0U);
  };
  refuse(2, { "--refine" }, { "--refine", "magic" });
  refuse(2, { "grey values", "--grey FILE" }, { "--refine", "grey" });
  refuse(2, { "no mesh" }, { "--refine", "mesh" });
  refuse(2, { "--grey-range" }, { "--refine", "grey", "--grey", Path("grey.nrrd") });
  refuse(2, { "--refine grey" }, { "--grey", Path("grey.nrrd"), "--grey-range", "500:inf" });
  refuse(2, { "no end" }, { "--refine", "grey", "--grey", Path("grey.nrrd"), "--grey-range", "-inf:inf" });
  refuse(3, { "nothing.nrrd" }, { "--refine", "grey", "--grey", Path("nothing.nrrd"), "--grey-range", "500:inf" });
  // A grey scan that lies elsewhere.
  TestScan other({ 39, 38, 37 });
  other.spacing = { 1, 1, 1.1 };
  WriteNrrd(m_Folder / "other.nrrd", other);
  refuse(3, { "other.nrrd", "same size" }, { "--refine", "grey", "--grey", Path("other.nrrd"), "--grey-range", "1:2" });
  Run({ "core", Path("labels.nrrd"), "--refine", "labels", "-o", Path("l.vtp") });
  ExpectRefusal(RunProgram({ "prune", Path("l.vtp"), "--lambda", "4mm", "-o", Path("x.vtp") }),
                3,
                { "l.vtp", "measures of its edges", "--keep-edges" });
  ExpectRefusal(RunProgram({ "skeleton", Path("l.vtp"), "--refine", "labels", "-o", Path("x.vtp") }),
                2,
                { "--refine", "needs a scan" });
}

} // namespace
} // namespace voxelcore::testing
