#include "RefinementScores.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::evaluation
{
namespace
{

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

} // namespace

Truth::Truth(const KnownBody & body)
  : m_Axis(body.axis.vertices, body.axis.triangles)
  , m_Surface(body.surface.vertices, body.surface.triangles)
{
  for (const auto & triangle : body.pruned.triangles)
  {
    const auto & v = body.pruned.vertices;
    AddSamples({ v[triangle[0]], v[triangle[1]], v[triangle[2]] }, { 0, 0, 0 }, body.reach / 60, m_Samples);
  }
}

Scores
Truth::Score(const MedialComplex & core, const KnownGrid & grid, double voxel) const
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
    backward[i] = { std::sqrt(tree.FindNearest(m_Samples[i].place, 1e9).squaredDistance) / voxel, m_Samples[i].weight };
  }
  scores.forward = SpreadOf(std::move(forward));
  scores.backward = SpreadOf(std::move(backward));
  scores.bias = SpreadOf(std::move(bias)).mean;
  return scores;
}

} // namespace voxelcore::evaluation
