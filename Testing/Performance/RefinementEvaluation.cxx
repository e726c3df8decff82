// How near cores are to known medial axes, raw and refined, against resolution. README.md has the table.
//
//     VoxelCoreRefinementEvaluation [--sizes 64,128,256] [--sources raw,labels,grey,mesh] [--body NAME] [--rotation R]
//                                   [--spacing 1,1,2] [--lambda PART]

#include "RefinementBodies.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/Refinement.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/TriangleTree.h"
#include "voxelcore/VoxelCore.h"

#include <algorithm>
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

struct Spread
{
  double mean = 0;
  double percentile99 = 0;
  double largest = 0;
};

// Of values with weights.
Spread
SpreadOf(std::vector<std::array<double, 2>> values)
{
  Spread spread;
  double weight = 0;
  std::sort(values.begin(), values.end());
  for (const auto & [value, w] : values)
  {
    spread.mean += value * w;
    weight += w;
  }
  if (weight > 0)
  {
    spread.mean /= weight;
    spread.largest = values.back()[0];
    double sum = 0;
    for (const auto & [value, w] : values)
    {
      sum += w;
      if (sum >= 0.99 * weight)
      {
        spread.percentile99 = value;
        break;
      }
    }
  }
  return spread;
}

struct Sample
{
  Vector3 place;
  double  radius;
  double  weight;
};

Vector3
Mix(const Vector3 & a, const Vector3 & b, const Vector3 & c, double u, double v)
{
  Vector3 p;
  for (std::size_t i = 0; i < 3; ++i)
  {
    p[i] = a[i] + u * (b[i] - a[i]) + v * (c[i] - a[i]);
  }
  return p;
}

double
Gap(const Vector3 & a, const Vector3 & b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double
Area(const Vector3 & a, const Vector3 & b, const Vector3 & c)
{
  const double x = Gap(a, b);
  const double y = Gap(b, c);
  const double z = Gap(c, a);
  const double s = 0.5 * (x + y + z);
  return std::sqrt(std::max(0.0, s * (s - x) * (s - y) * (s - z)));
}

// Triangles by area; a degenerate one is a segment and counts as a strip one step wide.
void
AddSamples(const std::array<Vector3, 3> & at,
           const std::array<double, 3> &  radius,
           double                         step,
           std::vector<Sample> &          samples)
{
  const double longest = std::max({ Gap(at[0], at[1]), Gap(at[1], at[2]), Gap(at[2], at[0]) });
  const double area = Area(at[0], at[1], at[2]);
  const int    parts = std::max(1, static_cast<int>(std::ceil(longest / step)));
  const auto   add = [&](double u, double v, double weight) {
    samples.push_back({ Mix(at[0], at[1], at[2], u, v),
                        radius[0] + u * (radius[1] - radius[0]) + v * (radius[2] - radius[0]),
                        weight });
  };
  if (at[1] == at[2])
  {
    for (int i = 0; i < parts; ++i)
    {
      add((i + 0.5) / parts, 0, step * longest / parts);
    }
    return;
  }
  for (int i = 0; i < parts; ++i)
  {
    for (int j = 0; i + j < parts; ++j)
    {
      add((i + 1.0 / 3) / parts, (j + 1.0 / 3) / parts, area / parts / parts);
      if (i + j + 1 < parts)
      {
        add((i + 2.0 / 3) / parts, (j + 2.0 / 3) / parts, area / parts / parts);
      }
    }
  }
}

// A core as triangles and loose edges in the body's place.
struct PlacedCore
{
  TriangleSet         set;
  std::vector<Sample> samples;
};

PlacedCore
PlaceCore(const MedialComplex & core, const KnownGrid & grid, double step)
{
  PlacedCore placed;
  for (const Vector3 & p : core.positions)
  {
    placed.set.vertices.push_back(
      grid.ToBody({ p[0] * grid.spacing[0], p[1] * grid.spacing[1], p[2] * grid.spacing[2] }));
  }
  const auto add = [&](ElementIndex a, ElementIndex b, ElementIndex c) {
    const auto & v = placed.set.vertices;
    placed.set.triangles.push_back({ a, b, c });
    AddSamples({ v[a], v[b], v[c] }, { core.radius[a], core.radius[b], core.radius[c] }, step, placed.samples);
  };
  std::vector<char> onFace(core.cells.edges.size(), 0);
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto corners = core.cells.FaceVertices(face);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
      add(corners[0], corners[i], corners[i + 1]);
    }
    for (const ElementIndex edge : core.cells.FaceEdges(face))
    {
      onFace[edge] = 1;
    }
  }
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (onFace[edge] == 0)
    {
      add(core.cells.edges[edge][0], core.cells.edges[edge][1], core.cells.edges[edge][1]);
    }
  }
  return placed;
}

struct Scores
{
  Spread        forward;
  Spread        backward;
  double        bias = 0;
  double        seconds = 0;
  std::uint64_t triangles = 0;
  bool          topology = true;
};

class Truth
{
public:
  explicit Truth(const KnownBody & body)
    : m_Axis(body.axis.vertices, body.axis.triangles)
    , m_Surface(body.surface.vertices, body.surface.triangles)
  {
    for (const auto & triangle : body.pruned.triangles)
    {
      const auto & v = body.pruned.vertices;
      AddSamples({ v[triangle[0]], v[triangle[1]], v[triangle[2]] }, { 0, 0, 0 }, body.reach / 60, m_Samples);
    }
  }

  // In units of `voxel`.
  Scores
  Score(const MedialComplex & core, const KnownGrid & grid, double voxel) const
  {
    const PlacedCore                   placed = PlaceCore(core, grid, 0.5 * voxel);
    Scores                             scores;
    std::vector<std::array<double, 2>> forward(placed.samples.size());
    std::vector<std::array<double, 2>> bias(placed.samples.size());
    const auto                         count = static_cast<std::ptrdiff_t>(placed.samples.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::ptrdiff_t k = 0; k < count; ++k)
    {
      const auto     i = static_cast<std::size_t>(k);
      const Sample & sample = placed.samples[i];
      forward[i] = { std::sqrt(m_Axis.FindNearest(sample.place, 1e9).squaredDistance) / voxel, sample.weight };
      bias[i] = { (sample.radius - std::sqrt(m_Surface.FindNearest(sample.place, 1e9).squaredDistance)) / voxel,
                  sample.weight };
    }
    const TriangleTree                 tree(placed.set.vertices, placed.set.triangles);
    std::vector<std::array<double, 2>> backward(m_Samples.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(m_Samples.size()); ++k)
    {
      const auto i = static_cast<std::size_t>(k);
      backward[i] = { std::sqrt(tree.FindNearest(m_Samples[i].place, 1e9).squaredDistance) / voxel,
                      m_Samples[i].weight };
    }
    scores.forward = SpreadOf(std::move(forward));
    scores.backward = SpreadOf(std::move(backward));
    scores.bias = SpreadOf(std::move(bias)).mean;
    scores.triangles = placed.set.triangles.size();
    return scores;
  }

private:
  TriangleTree        m_Axis;
  TriangleTree        m_Surface;
  std::vector<Sample> m_Samples;
};

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
