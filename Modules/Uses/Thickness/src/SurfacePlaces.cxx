#include "SurfacePlaces.h"

#include "PlaceTree.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::size_t kSquaresAtATime = 256;
constexpr int         kTurns = 2; ///< of the normal: after two more it turns by a degree or so

// Part of the weight that a slope, and a bend, of the quadric costs, lengths being parts of the reach: so little that
// it tells only where there are too few squares to fit one.
constexpr double kCost = 1e-4;

constexpr std::size_t kTerms = 6;
using Terms = std::array<double, kTerms>;

/** A square system, symmetric and positive. */
struct Equations
{
  std::array<Terms, kTerms> left{};
  Terms                     right{};

  /** By Cholesky's method; only what lies below the diagonal is looked at. */
  Terms
  Solve() const
  {
    std::array<Terms, kTerms> root{};
    for (std::size_t row = 0; row < kTerms; ++row)
    {
      for (std::size_t column = 0; column <= row; ++column)
      {
        double rest = left[row][column];
        for (std::size_t k = 0; k < column; ++k)
        {
          rest -= root[row][k] * root[column][k];
        }
        root[row][column] = row == column ? std::sqrt(std::max(rest, 1e-18 * left[0][0])) : rest / root[column][column];
      }
    }
    Terms terms = right;
    for (std::size_t row = 0; row < kTerms; ++row)
    {
      for (std::size_t k = 0; k < row; ++k)
      {
        terms[row] -= root[row][k] * terms[k];
      }
      terms[row] /= root[row][row];
    }
    for (std::size_t row = kTerms; row-- > 0;)
    {
      for (std::size_t k = row + 1; k < kTerms; ++k)
      {
        terms[row] -= root[k][row] * terms[k];
      }
      terms[row] /= root[row][row];
    }
    return terms;
  }
};

Vector3
Direction(const Vector3 & v)
{
  const double length = Length(v);
  return { v[0] / length, v[1] / length, v[2] / length };
}

/** A unit vector across another. */
Vector3
Across(const Vector3 & normal)
{
  std::size_t least = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    least = std::abs(normal[axis]) < std::abs(normal[least]) ? axis : least;
  }
  Vector3 along{};
  along[least] = 1;
  return Direction(Cross(normal, along));
}

void
ForEachSquare(std::size_t count, const std::function<void(std::size_t)> & work, const ProgressCallback & progress)
{
  const std::size_t chunks = (count + kSquaresAtATime - 1) / kSquaresAtATime;
  RunEach(
    chunks,
    [&](std::size_t chunk) {
      for (std::size_t i = chunk * kSquaresAtATime; i < std::min((chunk + 1) * kSquaresAtATime, count); ++i)
      {
        work(i);
      }
    },
    [&](std::size_t done) {
      ReportProgress(progress, "thickness", static_cast<double>(done) / static_cast<double>(chunks));
    });
}

} // namespace

std::vector<FacingSquare>
FacingSquares(const VoxelShape & shape)
{
  std::vector<FacingSquare> squares;
  const VoxelBox &          box = shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto here = shape.Row(y, z);
      const auto before = shape.RowAnywhere(y - 1, z);
      const auto after = shape.RowAnywhere(y + 1, z);
      const auto below = shape.RowAnywhere(y, z - 1);
      const auto above = shape.RowAnywhere(y, z + 1);
      for (std::size_t word = 0; word < here.size(); ++word)
      {
        const std::uint64_t in = here[word];
        if (in == 0)
        {
          continue;
        }
        const std::uint64_t                left = in << 1U | (word > 0 ? here[word - 1] >> 63U : 0);
        const std::uint64_t                right = in >> 1U | (word + 1 < here.size() ? here[word + 1] << 63U : 0);
        const std::array<std::uint64_t, 6> out{ in & ~left,        in & ~right,       in & ~before[word],
                                                in & ~after[word], in & ~below[word], in & ~above[word] };
        for (std::uint64_t rest = out[0] | out[1] | out[2] | out[3] | out[4] | out[5]; rest != 0; rest &= rest - 1)
        {
          const auto bit = static_cast<unsigned>(std::countr_zero(rest));
          for (std::size_t side = 0; side < 6; ++side)
          {
            if ((out[side] >> bit & 1U) != 0)
            {
              squares.push_back(
                { { box.lower[0] + static_cast<std::int32_t>(64 * word + bit), box.lower[1] + y, box.lower[2] + z },
                  static_cast<std::uint8_t>(side / 2),
                  static_cast<std::int8_t>(side % 2 == 0 ? -1 : 1) });
            }
          }
        }
      }
    }
  }
  return squares;
}

Vector3
SidesOf(const SpacingWeights & weights)
{
  Vector3 sides{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    sides[axis] = static_cast<double>(weights.weight[axis]) * weights.unit;
  }
  return sides;
}

Vector3
MiddleOf(const FacingSquare & square, const Vector3 & sides)
{
  Vector3 middle{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    middle[axis] = (square.voxel[axis] + (axis == square.axis ? 0.5 + 0.5 * square.way : 0.5)) * sides[axis];
  }
  return middle;
}

struct LabelPlaces::Middles
{
  Middles(const std::vector<FacingSquare> & all, const Vector3 & sidesMm)
    : squares(all)
    , sides(sidesMm)
    , middles(PlacesOf(all, sidesMm))
    , tree(middles)
  {}

  static std::vector<Vector3>
  PlacesOf(const std::vector<FacingSquare> & all, const Vector3 & sidesMm)
  {
    std::vector<Vector3> places;
    places.reserve(all.size());
    for (const FacingSquare & square : all)
    {
      places.push_back(MiddleOf(square, sidesMm));
    }
    return places;
  }

  double
  AreaOf(const FacingSquare & square) const
  {
    return sides[(square.axis + 1U) % 3] * sides[(square.axis + 2U) % 3];
  }

  /** Nearer ones count more; up to nothing at the reach. */
  std::vector<double>
  WeightsOf(std::size_t square, double reach, const std::vector<std::uint32_t> & near) const
  {
    std::vector<double> weights;
    weights.reserve(near.size());
    for (const std::uint32_t other : near)
    {
      const Vector3 gap = Minus(middles[other], middles[square]);
      const double  left = 1 - std::min(1.0, Dot(gap, gap) / (reach * reach));
      weights.push_back(left * left * AreaOf(squares[other]));
    }
    return weights;
  }

  void
  Find(std::size_t square, double reach, std::vector<std::uint32_t> & near, SurfacePlaces & found) const
  {
    const FacingSquare & own = squares[square];
    tree.Within(middles[square], reach, near);
    const std::vector<double> weights = WeightsOf(square, reach, near);
    Vector3                   normal{};
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      const FacingSquare & other = squares[near[i]];
      if (other.axis != own.axis || other.way == own.way)
      {
        normal[other.axis] += weights[i] * other.way;
      }
    }
    normal = Direction(normal);
    double  off = 0;
    Vector3 along = normal;
    for (int turn = 0; turn < kTurns; ++turn)
    {
      along = normal;
      off = reach * FitQuadric(square, reach, near, weights, normal);
    }
    const double most = 0.5 * Length(sides);
    found.places[square] = AddScaled(middles[square], std::clamp(off, -most, most), along);
    found.normals[square] = normal;
    found.areas[square] = AreaOf(own) * std::abs(normal[own.axis]);
  }

  /** How far out along the normal the quadric passes, in parts of the reach; the normal becomes its there. */
  double
  FitQuadric(std::size_t                        square,
             double                             reach,
             const std::vector<std::uint32_t> & near,
             const std::vector<double> &        weights,
             Vector3 &                          normal) const
  {
    const Vector3 u = Across(normal);
    const Vector3 v = Cross(normal, u);
    Equations     fit;
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      const FacingSquare & other = squares[near[i]];
      const double         facing = normal[other.axis] * other.way;
      if (facing <= 0)
      {
        continue;
      }
      const Vector3 gap = Minus(middles[near[i]], middles[square]);
      const double  weight = weights[i] * facing;
      const double  x = Dot(gap, u) / reach;
      const double  y = Dot(gap, v) / reach;
      const double  height = Dot(gap, normal) / reach;
      const Terms   terms{ 1, x, y, x * x, x * y, y * y };
      for (std::size_t row = 0; row < kTerms; ++row)
      {
        for (std::size_t column = 0; column <= row; ++column)
        {
          fit.left[row][column] += weight * terms[row] * terms[column];
        }
        fit.right[row] += weight * terms[row] * height;
      }
    }
    const double all = fit.left[0][0];
    if (!(all > 0))
    {
      return 0;
    }
    for (std::size_t row = 1; row < kTerms; ++row)
    {
      fit.left[row][row] += kCost * all;
    }
    const Terms terms = fit.Solve();
    normal = Direction(AddScaled(AddScaled(normal, -terms[1], u), -terms[2], v));
    return terms[0];
  }

  const std::vector<FacingSquare> & squares;
  Vector3                           sides;
  std::vector<Vector3>              middles;
  PlaceTree                         tree;
};

LabelPlaces::LabelPlaces(const std::vector<FacingSquare> & squares, const Vector3 & sides)
  : m_Middles(std::make_unique<const Middles>(squares, sides))
{}

LabelPlaces::~LabelPlaces() = default;

SurfacePlaces
LabelPlaces::Find(const std::vector<double> & reaches, const ProgressCallback & progress) const
{
  SurfacePlaces found(m_Middles->squares.size());
  ForEachSquare(
    reaches.size(),
    [&](std::size_t square) {
      std::vector<std::uint32_t> near;
      m_Middles->Find(square, reaches[square], near, found);
    },
    progress);
  return found;
}

SurfacePlaces
PlacesOn(const SurfaceEstimate &           surface,
         const std::vector<FacingSquare> & squares,
         const Vector3 &                   sides,
         const ProgressCallback &          progress)
{
  SurfacePlaces found(squares.size());
  ForEachSquare(
    squares.size(),
    [&](std::size_t i) {
      const FacingSquare & square = squares[i];
      const Vector3        middle = MiddleOf(square, sides);
      SurfacePoint         point = surface.Project(middle, Length(sides));
      if (!point.found)
      {
        point.position = middle;
        point.normal = {};
        point.normal[square.axis] = 1;
      }
      const double way = point.normal[square.axis] * square.way < 0 ? -1 : 1;
      found.places[i] = point.position;
      found.normals[i] = AddScaled({ 0, 0, 0 }, way, point.normal);
      found.areas[i] =
        sides[(square.axis + 1U) % 3] * sides[(square.axis + 2U) % 3] * std::abs(point.normal[square.axis]);
    },
    progress);
  return found;
}

} // namespace voxelcore
