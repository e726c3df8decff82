// How near cores are to known medial axes, raw and refined, against resolution. README.md has the table.
//
//     VoxelCoreRefinementEvaluation [--sizes 64,128,256] [--sources raw,labels,grey,mesh] [--body NAME] [--rotation R]
//                                   [--spacing 1,1,2] [--lambda PART]

#include "RefinementScores.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace voxelcore::evaluation
{
namespace
{

struct Settings
{
  std::vector<int>         sizes{ 64, 128 };
  std::vector<std::string> sources{ "raw", "labels", "grey", "mesh", "raw4" };
  std::string              body;
  Vector3                  spacing{ 1, 1, 1 };
  int                      rotation = 0;
  double                   lambda = 0.05;
};

double
Seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::unique_ptr<SurfaceEstimate>
MakeSurface(const std::string & source, const KnownBody & body, const KnownGrid & grid, const VoxelShape & shape)
{
  if (source == "labels")
  {
    return SurfaceFromLabels(shape, grid.spacing);
  }
  if (source == "grey")
  {
    return SurfaceFromGrey(
      shape,
      grid.spacing,
      VoxelBox{ { 0, 0, 0 }, grid.size },
      [&](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values) {
        for (float & value : values)
        {
          value = static_cast<float>(std::round(1000 * PartInside(body, grid, { x++, y, z })) - 499.5);
        }
      });
  }
  TriangleSet placed = body.surface;
  for (Vector3 & vertex : placed.vertices)
  {
    vertex = grid.ToGrid(vertex);
  }
  return SurfaceFromTriangles(placed.vertices, placed.triangles);
}

// A scan thresholded at half: for most voxels their centre decides as well.
VoxelShape
ThresholdGrey(VoxelShape shape, const KnownBody & body, const KnownGrid & grid)
{
  VoxelShape other(VoxelBox{ { 0, 0, 0 }, grid.size });
#pragma omp parallel for schedule(dynamic)
  for (std::int32_t z = 0; z < grid.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grid.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grid.size[0]; ++x)
      {
        const bool in = shape.Contains(x, y, z);
        const bool near = shape.Contains(x - 1, y, z) != in || shape.Contains(x + 1, y, z) != in ||
                          shape.Contains(x, y - 1, z) != in || shape.Contains(x, y + 1, z) != in ||
                          shape.Contains(x, y, z - 1) != in || shape.Contains(x, y, z + 1) != in;
        if (near ? PartInside(body, grid, { x, y, z }) >= 0.4995 : in)
        {
          other.Insert(x, y, z);
        }
      }
    }
  }
  return CropToVoxels(other);
}

Scores
Evaluate(const std::string & source, const KnownBody & body, const Truth & truth, const Settings & settings, int n)
{
  const bool   fine = source == "raw4";
  const double size = n;
  Vector3      spacing = settings.spacing;
  const double voxel = std::cbrt(spacing[0] * spacing[1] * spacing[2]);
  for (double & side : spacing)
  {
    side /= voxel * (fine ? 4 : 1); // so that a voxel's volume is 1 at n
  }
  const KnownGrid      grid = PlaceGrid(body, spacing, settings.rotation);
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  VoxelShape           shape = Digitize(body, grid);
  if (source == "grey")
  {
    shape = ThresholdGrey(std::move(shape), body, grid);
  }
  const double        start = Seconds();
  const auto          points = BoundaryVertices(shape);
  DelaunayCells       cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
  const bool          raw = source == "raw" || fine;
  const EdgePoints    edgePoints = raw ? EdgePoints{} : NearestToEdges(cells);
  const MedialComplex core = BuildVoxelCore(shape, points, std::move(cells), weights);
  MedialComplex       result;
  double              before = Seconds() - start;
  if (raw)
  {
    result = std::move(PruneByLambda(core, { settings.lambda * size })[0]);
    before = 0;
  }
  else
  {
    const auto surface = MakeSurface(source, body, grid, shape);
    result = std::move(
      RefineCore({ &shape, &points, &core, &edgePoints, surface.get(), spacing }, { settings.lambda * size })[0].core);
  }
  const double seconds = Seconds() - start - before;
  Scores       scores = truth.Score(result, grid, 1.0);
  scores.seconds = seconds;
  scores.topology = ComputeComplexTopology(result.cells) == ComputeShapeTopology(shape);
  return scores;
}

std::vector<std::string>
SplitCommas(const std::string & text)
{
  std::vector<std::string> parts;
  std::istringstream       in(text);
  for (std::string part; std::getline(in, part, ',');)
  {
    parts.push_back(part);
  }
  return parts;
}

int
Run(const Settings & settings)
{
  std::printf(
    "| body | n | surface | forward mean | 99 %% | largest | backward mean | 99 %% | largest | radius | s |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool passed = true;
  for (const int n : settings.sizes)
  {
    for (const KnownBody & body : KnownBodies(n, settings.lambda * n))
    {
      if (!settings.body.empty() && body.name.find(settings.body) == std::string::npos)
      {
        continue;
      }
      const Truth truth(body);
      for (const std::string & source : settings.sources)
      {
        const Scores s = Evaluate(source, body, truth, settings, n);
        std::printf("| %s | %d | %s | %.4f | %.3f | %.2f | %.4f | %.3f | %.2f | %+.4f | %.2f |%s\n",
                    body.name.c_str(),
                    n,
                    source == "raw4" ? "raw at 4n" : source.c_str(),
                    s.forward.mean,
                    s.forward.percentile99,
                    s.forward.largest,
                    s.backward.mean,
                    s.backward.percentile99,
                    s.backward.largest,
                    s.bias,
                    s.seconds,
                    s.topology ? "" : " TOPOLOGY");
        std::fflush(stdout);
        passed = passed && s.topology;
      }
    }
  }
  return passed ? 0 : 1;
}

} // namespace
} // namespace voxelcore::evaluation

int
main(int argc, char ** argv)
{
  using namespace voxelcore::evaluation;
  Settings settings;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string option = argv[i];
    const std::string value = argv[i + 1];
    if (option == "--sizes")
    {
      settings.sizes.clear();
      for (const std::string & part : SplitCommas(value))
      {
        settings.sizes.push_back(std::stoi(part));
      }
    }
    else if (option == "--sources")
    {
      settings.sources = SplitCommas(value);
    }
    else if (option == "--spacing")
    {
      const auto parts = SplitCommas(value);
      settings.spacing = { std::stod(parts.at(0)), std::stod(parts.at(1)), std::stod(parts.at(2)) };
    }
    else if (option == "--body")
    {
      settings.body = value;
    }
    else if (option == "--rotation")
    {
      settings.rotation = std::stoi(value);
    }
    else if (option == "--lambda")
    {
      settings.lambda = std::stod(value);
    }
    else
    {
      std::fprintf(stderr, "unknown option %s\n", option.c_str());
      return 2;
    }
  }
  return Run(settings);
}
