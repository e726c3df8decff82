#pragma once
// Local thickness straight from its definition: every centre on a grid, distances to every voxel that is out.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Thickness/CoreThickness.h"
#include "voxelcore/Thickness/LocalThickness.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace voxelcore::testing
{

/** A shape with all that its thickness is found from. */
struct ShapeCells
{
  ShapeCells(VoxelShape of, const Spacing3 & spacing)
    : shape(std::move(of))
    , weights(ComputeSpacingWeights(spacing))
    , points(BoundaryVertices(shape))
    , cells(ComputeDelaunayCells(shape, points, weights, Engine::Auto))
  {}

  ThicknessBracket
  Bracket() const
  {
    return BracketThickness(shape, points, cells, weights, true);
  }

  VoxelShape                shape;
  SpacingWeights            weights;
  std::vector<LatticePoint> points;
  DelaunayCells             cells;
};

/** Distance of a place to all that is not in, in mm: of the voxels around, layer by layer, until no farther one can be
 *  nearer. */
inline double
BruteDepth(const ShapeCells & of, const Vector3 & place)
{
  Size3  at{};
  double shortest = 1e300;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    at[axis] = static_cast<std::int32_t>(std::floor(place[axis]));
    shortest = std::min(shortest, static_cast<double>(of.weights.weight[axis]) * of.weights.unit);
  }
  double     least = 1e300;
  const auto look = [&](const Size3 & voxel) {
    if (of.shape.Contains(voxel[0], voxel[1], voxel[2]))
    {
      return;
    }
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double beyond = std::max(std::abs(place[axis] - voxel[axis] - 0.5) - 0.5, 0.0) *
                            static_cast<double>(of.weights.weight[axis]) * of.weights.unit;
      squared += beyond * beyond;
    }
    least = std::min(least, squared);
  };
  for (std::int32_t layer = 0;; ++layer)
  {
    // The voxels of this layer have at least layer - 1 whole ones between them and the place.
    const double nearest = std::max(layer - 1, 0) * shortest;
    if (layer > 0 && nearest * nearest >= least)
    {
      return std::sqrt(least);
    }
    for (std::int32_t z = -layer; z <= layer; ++z)
    {
      for (std::int32_t y = -layer; y <= layer; ++y)
      {
        const bool isSide = std::abs(z) == layer || std::abs(y) == layer;
        for (std::int32_t x = -layer; x <= layer; x += isSide || layer == 0 ? 1 : 2 * layer)
        {
          look({ at[0] + x, at[1] + y, at[2] + z });
        }
      }
    }
  }
}

/** The centres of the voxels that are in, in scan order. */
inline std::vector<Vector3>
VoxelCentres(const VoxelShape & shape)
{
  std::vector<Vector3> centres;
  const auto &         box = shape.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          centres.push_back({ x + 0.5, y + 0.5, z + 0.5 });
        }
      }
    }
  }
  return centres;
}

/** Gives each centre the value of a ball that holds it, if that is greater. */
inline void
PaintByBrute(const ShapeCells &       of,
             std::span<const Vector3> centres,
             const Vector3 &          ball,
             double                   radius,
             double                   value,
             std::span<double>        greatest)
{
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = (centres[i][axis] - ball[axis]) * static_cast<double>(of.weights.weight[axis]) * of.weights.unit;
      squared += d * d;
    }
    if (squared <= radius * radius * (1 + 2e-10))
    {
      greatest[i] = std::max(greatest[i], value);
    }
  }
}

/** At each voxel the diameter of the largest inscribed ball that holds its centre, of those with a centre on a grid of
 *  quarter voxels or at a vertex of the core. */
inline std::vector<double>
BruteThickness(const ShapeCells & of)
{
  const auto &        box = of.shape.Box();
  const VoxelRanks    ranks(of.shape);
  std::vector<double> greatest(of.shape.CountVoxels(), 0);
  const auto          take = [&](const Vector3 & place) {
    const double depth = BruteDepth(of, place);
    Size3        first{};
    Size3        last{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double reach = depth / (static_cast<double>(of.weights.weight[axis]) * of.weights.unit) + 1e-6;
      first[axis] = static_cast<std::int32_t>(std::ceil(place[axis] - reach - 0.5));
      last[axis] = static_cast<std::int32_t>(std::floor(place[axis] + reach - 0.5));
    }
    for (std::int32_t z = first[2]; z <= last[2] && depth > 0; ++z)
    {
      for (std::int32_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::int32_t x = first[0]; x <= last[0]; ++x)
        {
          if (of.shape.Contains(x, y, z))
          {
            const Vector3 centre{ x + 0.5, y + 0.5, z + 0.5 };
            PaintByBrute(of, { &centre, 1 }, place, depth, 2 * depth, { &greatest[ranks.At(x, y, z)], 1 });
          }
        }
      }
    }
  };
  for (std::int32_t z = 1; z < 4 * box.size[2]; ++z)
  {
    for (std::int32_t y = 1; y < 4 * box.size[1]; ++y)
    {
      for (std::int32_t x = 1; x < 4 * box.size[0]; ++x)
      {
        take({ box.lower[0] + 0.25 * x, box.lower[1] + 0.25 * y, box.lower[2] + 0.25 * z });
      }
    }
  }
  for (const Vector3 & vertex : of.cells.centres)
  {
    take(vertex);
  }
  return greatest;
}

} // namespace voxelcore::testing
