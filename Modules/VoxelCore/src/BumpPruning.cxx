#include "voxelcore/BumpPruning.h"

#include "BumpCollapse.h"

#include "voxelcore/Error.h"
#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace voxelcore
{

namespace
{

[[noreturn]] void
RefuseHeight(std::string_view text, const char * why)
{
  throw UsageError("bump height '" + std::string(text) + "' " + why +
                   "; write a number and mm, vox or diag, for example 1.5mm, 2vox or 1diag");
}

std::vector<std::uint8_t>
Above(const std::vector<double> & values, double height)
{
  std::vector<std::uint8_t> live(values.size());
  std::transform(values.begin(), values.end(), live.begin(), [height](double value) { return value > height ? 1 : 0; });
  return live;
}

} // namespace

BumpHeight
ParseBumpHeight(std::string_view text)
{
  // Blanks around the number and before the unit are the user's; one within a number could mean anything.
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  BumpHeight height;
  height.text.clear();
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (!blank(text[i]))
    {
      height.text.push_back(text[i]);
    }
    else if (!height.text.empty() && i + 1 < text.size() &&
             std::string_view("0123456789.").find(text[i + 1]) != std::string_view::npos)
    {
      RefuseHeight(text, "has a blank before a digit");
    }
  }
  const char * first = height.text.data();
  const char * last = first + height.text.size();
  const auto   parsed = std::from_chars(first, last, height.value);
  if (parsed.ec != std::errc{} || !std::isfinite(height.value))
  {
    RefuseHeight(text, "is not a number");
  }
  if (std::signbit(height.value) && height.value != 0.0)
  {
    RefuseHeight(text, "is negative");
  }
  height.value = std::abs(height.value);
  const std::string_view unit(parsed.ptr, static_cast<std::size_t>(last - parsed.ptr));
  if (unit.empty() || unit == "mm")
  {
    height.unit = BumpHeight::Unit::Millimetre;
  }
  else if (unit == "vox")
  {
    height.unit = BumpHeight::Unit::Voxel;
  }
  else if (unit == "diag")
  {
    height.unit = BumpHeight::Unit::Diagonal;
  }
  else
  {
    RefuseHeight(text, "has an unknown unit");
  }
  return height;
}

double
BumpHeightInMillimetres(const BumpHeight & height, const std::array<double, 3> & spacing)
{
  switch (height.unit)
  {
    case BumpHeight::Unit::Millimetre:
      return height.value;
    case BumpHeight::Unit::Voxel:
      return height.value * std::min({ spacing[0], spacing[1], spacing[2] });
    case BumpHeight::Unit::Diagonal:
      break;
  }
  return height.value * std::sqrt(spacing[0] * spacing[0] + spacing[1] * spacing[1] + spacing[2] * spacing[2]);
}

std::vector<ElementIndex>
LargestTouchingBalls(const DelaunayCells &             cells,
                     const std::vector<LatticePoint> & points,
                     const SpacingWeights &            weights)
{
  std::vector<ElementIndex> touching(points.size(), kOutside);
  std::vector<double>       largest(points.size(), -1.0);
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    for (const std::uint32_t point : cells.FacetPoints(facet))
    {
      const LatticePoint & p = points[point];
      for (const std::uint32_t cell : cells.facetCells[facet])
      {
        if (cell == kOutside || cell == touching[point])
        {
          continue;
        }
        const auto & c = cells.centres[cell];
        const double dx = static_cast<double>(weights.weight[0]) * (c[0] - p.x);
        const double dy = static_cast<double>(weights.weight[1]) * (c[1] - p.y);
        const double dz = static_cast<double>(weights.weight[2]) * (c[2] - p.z);
        const double squared = dx * dx + dy * dy + dz * dz;
        if (squared > largest[point] || (squared == largest[point] && cell < touching[point]))
        {
          largest[point] = squared;
          touching[point] = cell;
        }
      }
    }
  }
  return touching;
}

BumpValues
ComputeBumps(const MedialComplex &             core,
             const SpacingWeights &            weights,
             const std::vector<LatticePoint> & points,
             const std::vector<ElementIndex> & touching,
             const ProgressCallback &          progress)
{
  return BumpCollapse(core, weights, points, touching).Run(progress);
}

MedialComplex
PruneByBumps(const MedialComplex & core, const BumpValues & bumps, double height)
{
  const LiveElements live{ Above(bumps.vertices, height), Above(bumps.edges, height), Above(bumps.faces, height) };
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  MedialComplex             part;
  part.cells = ExtractLive(core.cells, live, vertices, edges, faces);
  const auto gather = [](const auto & from, const std::vector<ElementIndex> & ids, auto & to) {
    to.reserve(ids.size());
    for (const ElementIndex id : ids)
    {
      to.push_back(from[id]);
    }
  };
  gather(core.positions, vertices, part.positions);
  gather(core.radius, vertices, part.radius);
  gather(core.vertexLambda, vertices, part.vertexLambda);
  gather(core.edgeLambda, edges, part.edgeLambda);
  gather(core.faceLambda, faces, part.faceLambda);
  return part;
}

} // namespace voxelcore
