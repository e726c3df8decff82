#include "SurfacePlaces.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kSquaresAtATime = 256;
constexpr int         kTurns = 2; ///< of the normal: after two more it turns by a degree or so

// Part of the weight that a slope, and a bend, of the quadric costs, lengths being parts of the reach: so little that
// it tells only where there are too few squares to fit one.
constexpr double kCost = 1e-4;

constexpr std::size_t kTerms = 6;    // 1, x, y, xx, xy, yy
constexpr std::size_t kMoments = 15; // of x and y up to the fourth order
using Terms = std::array<double, kTerms>;

/** A square system, symmetric and positive; only what lies below the diagonal is looked at. */
struct Equations
{
  std::array<Terms, kTerms> left{};
  Terms                     right{};

  /** By Cholesky's method. */
  Terms
  Solve() const
  {
    std::array<Terms, kTerms> root{};
    Terms                     over{}; // 1 / what is on the diagonal
    for (std::size_t row = 0; row < kTerms; ++row)
    {
      for (std::size_t column = 0; column <= row; ++column)
      {
        double rest = left[row][column];
        for (std::size_t k = 0; k < column; ++k)
        {
          rest -= root[row][k] * root[column][k];
        }
        if (row == column)
        {
          over[row] = 1 / std::sqrt(std::max(rest, 1e-18 * left[0][0]));
        }
        else
        {
          root[row][column] = rest * over[column];
        }
      }
    }
    Terms terms = right;
    for (std::size_t row = 0; row < kTerms; ++row)
    {
      for (std::size_t k = 0; k < row; ++k)
      {
        terms[row] -= root[row][k] * terms[k];
      }
      terms[row] *= over[row];
    }
    for (std::size_t row = kTerms; row-- > 0;)
    {
      for (std::size_t k = row + 1; k < kTerms; ++k)
      {
        terms[row] -= root[k][row] * terms[k];
      }
      terms[row] *= over[row];
    }
    return terms;
  }
};

constexpr std::size_t kLanes = 4; ///< each sums up every fourth square, whatever processor does it

/** Squares around one: how far their middles are from its, in parts of the reach, and what they weigh. The last lanes
 *  are filled up with what weighs nothing. */
struct AroundSquare
{
  std::array<std::vector<double>, 3> gaps;
  std::vector<double>                weights;
  std::vector<std::uint8_t>          facing; ///< FacingOf()
  std::size_t                        count = 0;

  void
  Clear()
  {
    count = 0;
  }
  void
  Add(const Vector3 & gap, double weight, std::uint8_t way)
  {
    if (count % kLanes == 0)
    {
      Fill();
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      gaps[axis][count] = gap[axis];
    }
    weights[count] = weight;
    facing[count] = way;
    ++count;
  }

private:
  void
  Fill()
  {
    if (weights.size() == count)
    {
      weights.resize(count + kLanes);
      facing.resize(count + kLanes);
      for (std::vector<double> & along : gaps)
      {
        along.resize(count + kLanes);
      }
    }
    std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(count), kLanes, 0.0);
  }
};

/** Which of six ways a square faces. */
std::uint8_t
FacingOf(const FacingSquare & square)
{
  return static_cast<std::uint8_t>(2 * square.axis + (square.way > 0 ? 1 : 0));
}

/** Moments of squares, as they are seen along a normal across which u and v are; then their heights' to the second. */
using MomentSums = std::array<double, kMoments + kTerms>;

VOXELCORE_EIGHT_LANES void
SumMoments(const AroundSquare & around,
           const double *       weights,
           const Vector3 &      normal,
           const Vector3 &      u,
           const Vector3 &      v,
           MomentSums &         sums)
{
  std::array<FourDoubles, kMoments + kTerms> all{};
  for (std::size_t i = 0; i < around.count; i += kLanes)
  {
    const FourDoubles dx = FourAt(around.gaps[0].data() + i)->lanes;
    const FourDoubles dy = FourAt(around.gaps[1].data() + i)->lanes;
    const FourDoubles dz = FourAt(around.gaps[2].data() + i)->lanes;
    const FourDoubles x = dx * u[0] + dy * u[1] + dz * u[2];
    const FourDoubles y = dx * v[0] + dy * v[1] + dz * v[2];
    const FourDoubles height = dx * normal[0] + dy * normal[1] + dz * normal[2];
    const FourDoubles w = FourAt(weights + i)->lanes;
    const FourDoubles wx = w * x;
    const FourDoubles wy = w * y;
    const FourDoubles wxx = wx * x;
    const FourDoubles wxy = wx * y;
    const FourDoubles wyy = wy * y;
    const FourDoubles wxxx = wxx * x;
    const FourDoubles wxxy = wxx * y;
    const FourDoubles wxyy = wyy * x;
    const FourDoubles wyyy = wyy * y;
    all[0] += w;
    all[1] += wx;
    all[2] += wy;
    all[3] += wxx;
    all[4] += wxy;
    all[5] += wyy;
    all[6] += wxxx;
    all[7] += wxxy;
    all[8] += wxyy;
    all[9] += wyyy;
    all[10] += wxxx * x;
    all[11] += wxxx * y;
    all[12] += wxxy * y;
    all[13] += wyyy * x;
    all[14] += wyyy * y;
    all[15] += w * height;
    all[16] += wx * height;
    all[17] += wy * height;
    all[18] += wxx * height;
    all[19] += wxy * height;
    all[20] += wyy * height;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    sums[i] = (all[i][0] + all[i][1]) + (all[i][2] + all[i][3]);
  }
}

/** The normal equations of the quadric that fits best. */
Equations
EquationsOf(const MomentSums & s)
{
  Equations fit;
  fit.left[0] = { s[0] };
  fit.left[1] = { s[1], s[3] };
  fit.left[2] = { s[2], s[4], s[5] };
  fit.left[3] = { s[3], s[6], s[7], s[10] };
  fit.left[4] = { s[4], s[7], s[8], s[11], s[12] };
  fit.left[5] = { s[5], s[8], s[9], s[12], s[13], s[14] };
  std::copy(s.begin() + kMoments, s.end(), fit.right.begin());
  return fit;
}

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

/** work(first, end) for parts of the squares. */
void
ForSquares(std::size_t                                           count,
           const std::function<void(std::size_t, std::size_t)> & work,
           const ProgressCallback &                              progress)
{
  const std::size_t chunks = (count + kSquaresAtATime - 1) / kSquaresAtATime;
  RunEach(
    chunks,
    [&](std::size_t chunk) { work(chunk * kSquaresAtATime, std::min((chunk + 1) * kSquaresAtATime, count)); },
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
  {
    middles.reserve(all.size());
    for (const FacingSquare & square : all)
    {
      middles.push_back(voxelcore::MiddleOf(square, sidesMm));
    }
    if (all.empty())
    {
      return;
    }
    std::array<std::int32_t, 2> most = lowest = { all.front().voxel[1], all.front().voxel[2] };
    for (const FacingSquare & square : all)
    {
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        lowest[axis] = std::min(lowest[axis], square.voxel[axis + 1]);
        most[axis] = std::max(most[axis], square.voxel[axis + 1]);
      }
    }
    rows = { most[0] - lowest[0] + 1, most[1] - lowest[1] + 1 };
    rowBegin.assign(static_cast<std::size_t>(rows[0]) * static_cast<std::size_t>(rows[1]) + 1, 0);
    for (const FacingSquare & square : all)
    {
      ++rowBegin[RowAt(square.voxel[1], square.voxel[2]) + 1];
    }
    std::partial_sum(rowBegin.begin(), rowBegin.end(), rowBegin.begin());
  }

  std::size_t
  RowAt(std::int32_t y, std::int32_t z) const
  {
    return static_cast<std::size_t>(z - lowest[1]) * static_cast<std::size_t>(rows[0]) +
           static_cast<std::size_t>(y - lowest[0]);
  }

  double
  AreaOf(const FacingSquare & square) const
  {
    return sides[(square.axis + 1U) % 3] * sides[(square.axis + 2U) % 3];
  }

  const std::vector<FacingSquare> & squares;
  Vector3                           sides;
  std::vector<Vector3>              middles;
  std::array<std::int32_t, 2>       lowest{}; ///< y, z
  std::array<std::int32_t, 2>       rows{};
  std::vector<std::uint32_t>        rowBegin; ///< of each row of voxels
};

/** Fits quadrics to squares, which are asked for in their order: in each row of voxels around theirs the part within
 *  reach moves on with them. */
class LabelPlaces::Fitter
{
public:
  Fitter(const Middles & middles, const std::vector<double> & reaches)
    : m_All(middles)
    , m_Reaches(reaches)
  {}

  SurfacePlace
  Find(std::size_t square)
  {
    const double reach = m_Reaches[square];
    FindAround(square, reach);
    const FacingSquare & own = m_All.squares[square];
    Vector3              normal{};
    for (std::size_t i = 0; i < m_Around.count; ++i)
    {
      const std::uint8_t facing = m_Around.facing[i];
      if (facing != (FacingOf(own) ^ 1U))
      {
        normal[facing / 2] += m_Around.weights[i] * ((facing & 1U) != 0 ? 1 : -1);
      }
    }
    normal = Direction(normal);
    double  off = 0;
    Vector3 along = normal;
    for (int turn = 0; turn < kTurns; ++turn)
    {
      along = normal;
      off = reach * FitQuadric(normal);
    }
    const double most = 0.5 * Length(m_All.sides);
    return { AddScaled(m_All.middles[square], std::clamp(off, -most, most), along),
             normal,
             m_All.AreaOf(own) * std::abs(normal[own.axis]) };
  }

private:
  struct Row
  {
    std::uint32_t first; ///< of its squares, no farther behind than the greatest reach
    std::uint32_t end;
    double        squared; ///< of how far, at least, its middles are beside those of the square's row
    std::int32_t  across;  ///< voxels that the greatest reach reaches along it
  };

  /** Along an axis, how far two middles are apart, at least, in voxels so far apart. */
  double
  GapOf(std::int32_t voxels, std::size_t axis) const
  {
    return std::max(std::abs(voxels) - 1, 0) * m_All.sides[axis];
  }

  /** Along an axis, the most voxels between two whose middles are so far apart. */
  std::int32_t
  VoxelsIn(double length, std::size_t axis) const
  {
    return static_cast<std::int32_t>(std::min(std::floor(length / m_All.sides[axis]), 1e9)) + 1;
  }

  /** Begins a row of voxels with one of its squares. */
  void
  EnterRow(std::size_t i, std::size_t row)
  {
    m_Row = row;
    double reach = 0;
    for (std::size_t other = i; other < m_All.rowBegin[row + 1]; ++other)
    {
      reach = std::max(reach, m_Reaches[other]);
    }
    const auto &                      voxel = m_All.squares[i].voxel;
    const std::array<std::int32_t, 2> wide{ VoxelsIn(reach, 1), VoxelsIn(reach, 2) };
    const auto first = [&](std::size_t axis) { return std::max(voxel[axis + 1] - wide[axis], m_All.lowest[axis]); };
    const auto last = [&](std::size_t axis) {
      return std::min(voxel[axis + 1] + wide[axis], m_All.lowest[axis] + m_All.rows[axis] - 1);
    };
    m_Rows.clear();
    for (std::int32_t z = first(1); z <= last(1); ++z)
    {
      for (std::int32_t y = first(0); y <= last(0); ++y)
      {
        const double      gapY = GapOf(y - voxel[1], 1);
        const double      gapZ = GapOf(z - voxel[2], 2);
        const double      beside = gapY * gapY + gapZ * gapZ;
        const std::size_t other = m_All.RowAt(y, z);
        Row               near{ m_All.rowBegin[other], m_All.rowBegin[other + 1], beside, 0 };
        if (near.first < near.end && beside < reach * reach)
        {
          near.across = VoxelsIn(std::sqrt(reach * reach - beside), 0);
          const auto begin = m_All.squares.begin();
          near.first = static_cast<std::uint32_t>(
            std::partition_point(begin + near.first,
                                 begin + near.end,
                                 [&](const FacingSquare & one) { return one.voxel[0] < voxel[0] - near.across; }) -
            begin);
          m_Rows.push_back(near);
        }
      }
    }
  }

  /** Squares within reach, in their order. Nearer ones count more; up to nothing at the reach. */
  void
  FindAround(std::size_t of, double reach)
  {
    const FacingSquare & own = m_All.squares[of];
    const std::size_t    row = m_All.RowAt(own.voxel[1], own.voxel[2]);
    if (row != m_Row)
    {
      EnterRow(of, row);
    }
    const Vector3 & middle = m_All.middles[of];
    const double    squared = reach * reach;
    const double    over = 1 / reach;
    m_Around.Clear();
    for (Row & near : m_Rows)
    {
      if (near.squared >= squared)
      {
        continue;
      }
      while (near.first < near.end && m_All.squares[near.first].voxel[0] < own.voxel[0] - near.across)
      {
        ++near.first;
      }
      for (std::uint32_t i = near.first; i < near.end; ++i)
      {
        const FacingSquare & other = m_All.squares[i];
        if (other.voxel[0] > own.voxel[0] + near.across)
        {
          break;
        }
        const Vector3 gap = Minus(m_All.middles[i], middle);
        const double  away = Dot(gap, gap);
        if (away < squared)
        {
          const double left = 1 - away / squared;
          m_Around.Add({ gap[0] * over, gap[1] * over, gap[2] * over },
                       left * left * m_All.AreaOf(other),
                       FacingOf(other));
        }
      }
    }
  }

  /** How far out along the normal the quadric passes, in parts of the reach; the normal becomes its there. */
  double
  FitQuadric(Vector3 & normal)
  {
    const Vector3 u = Across(normal);
    const Vector3 v = Cross(normal, u);
    // As seen along the normal; those that face the other way do not count.
    const std::array<double, 6> facing{
      std::max(-normal[0], 0.0), std::max(normal[0], 0.0),  std::max(-normal[1], 0.0),
      std::max(normal[1], 0.0),  std::max(-normal[2], 0.0), std::max(normal[2], 0.0)
    };
    m_Seen.resize(m_Around.weights.size());
    for (std::size_t i = 0; i < m_Seen.size(); ++i)
    {
      m_Seen[i] = m_Around.weights[i] * facing[m_Around.facing[i]];
    }
    MomentSums sums;
    SumMoments(m_Around, m_Seen.data(), normal, u, v, sums);
    const double all = sums[0];
    if (!(all > 0))
    {
      return 0;
    }
    Equations fit = EquationsOf(sums);
    for (std::size_t row = 1; row < kTerms; ++row)
    {
      fit.left[row][row] += kCost * all;
    }
    const Terms terms = fit.Solve();
    normal = Direction(AddScaled(AddScaled(normal, -terms[1], u), -terms[2], v));
    return terms[0];
  }

  const Middles &             m_All;
  const std::vector<double> & m_Reaches; ///< of these
  std::size_t                 m_Row = std::numeric_limits<std::size_t>::max();
  std::vector<Row>            m_Rows;
  AroundSquare                m_Around;
  std::vector<double>         m_Seen; ///< what squares weigh as seen along a normal
};

LabelPlaces::LabelPlaces(const std::vector<FacingSquare> & squares, const Vector3 & sides)
  : m_Middles(std::make_unique<const Middles>(squares, sides))
{}

LabelPlaces::~LabelPlaces() = default;

SurfacePlaces
LabelPlaces::Find(const std::vector<double> & reaches, const ProgressCallback & progress) const
{
  SurfacePlaces found(reaches.size());
  ForSquares(
    reaches.size(),
    [&](std::size_t first, std::size_t end) {
      Fitter fitter(*m_Middles, reaches);
      for (std::size_t i = first; i < end; ++i)
      {
        found[i] = fitter.Find(i);
      }
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
  ForSquares(
    squares.size(),
    [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i)
      {
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
        found[i] = { point.position,
                     AddScaled({ 0, 0, 0 }, way, point.normal),
                     sides[(square.axis + 1U) % 3] * sides[(square.axis + 2U) % 3] *
                       std::abs(point.normal[square.axis]) };
      }
    },
    progress);
  return found;
}

} // namespace voxelcore
