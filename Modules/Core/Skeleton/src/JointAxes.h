#pragma once
// The axes of branches that meet, from where their bodies are apart.

#include "ParabolaFit.h"
#include "voxelcore/Skeleton/UnitVector.h"
#include "WayLine.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace voxelcore
{

/** 0 at and before the first, 1 at and behind the second. */
inline double
FromNoToYes(const std::array<double, 2> & range, double value)
{
  const double t = std::clamp((value - range[0]) / (range[1] - range[0]), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/** A branch from a junction on. */
struct Arm
{
  std::vector<ElementIndex> points;
  WayLine                   line;
  std::vector<double>       radii;      ///< per point
  double                    leaves = 0; ///< the way on which it leaves the junction's ball
  double                    free = 0;   ///< where it comes near its other end
  double                    radius = 0;
  Vector3                   direction{};
  double                    from = 0; ///< of the axis
  double                    to = 0;
};

/** The arm of a branch that meets a junction at its end `end`, 0 or 1. Where the branch lies within the junction's
 *  ball, `leaves` is 0. */
Arm
ArmOf(const SkeletonGraph & graph, std::size_t branch, std::size_t end, double diagonal);

/** A straight line. */
struct Axis
{
  Vector3 middle{};
  Vector3 direction{};
};

/** The axis of the branch that goes through, by the way from the junction; negative on one side. */
class ThroughAxis
{
public:
  bool
  Fit(const Arm & before, const Arm & behind, const Vector3 & junction)
  {
    m_Scale = std::max(Distance(before.line.At(before.to), junction), Distance(behind.line.At(behind.to), junction));
    ParabolaFit parabola;
    for (const auto & [arm, sign] : { std::pair{ &before, -1 }, { &behind, 1 } })
    {
      std::vector<std::size_t> used;
      for (std::size_t i = 0; i < arm->points.size(); ++i)
      {
        if (arm->line.way[i] >= arm->from && arm->line.way[i] <= arm->to)
        {
          used.push_back(i);
        }
      }
      for (const std::size_t i : used)
      {
        const Vector3 & place = arm->line.places[i];
        parabola.Add(sign * Distance(place, junction) / m_Scale, 1 / static_cast<double>(used.size()), place);
      }
    }
    return parabola.Coefficients(m_Factors);
  }

  Vector3
  At(double way) const
  {
    const double u = way / m_Scale;
    return AddScaled(AddScaled(m_Factors[0], u, m_Factors[1]), u * u, m_Factors[2]);
  }

  Vector3
  DirectionAt(double way) const
  {
    return Unit(AddScaled(m_Factors[1], 2 * way / m_Scale, m_Factors[2]));
  }

private:
  Vector3 m_Factors[3]{};
  double  m_Scale = 1;
};

/** Least squares by the way along it. */
inline Axis
AxisOf(const Arm & arm)
{
  double  count = 0;
  double  sum = 0;
  Vector3 places{};
  Vector3 products{};
  for (std::size_t i = 0; i < arm.points.size(); ++i)
  {
    const double way = arm.line.way[i] - arm.from;
    if (way >= 0 && arm.line.way[i] <= arm.to)
    {
      ++count;
      sum += way;
      places = AddScaled(places, 1, arm.line.places[i]);
      products = AddScaled(products, way, arm.line.places[i]);
    }
  }
  if (count < 2)
  {
    const Vector3 a = arm.line.At(arm.from);
    return { a, Unit(Minus(arm.line.At(arm.to), a)) };
  }
  return { AddScaled({}, 1 / count, places), Unit(AddScaled(AddScaled({}, count, products), -sum, places)) };
}

/** How an arm bends from `from` on, over twice its axis. A bend that noise may have made counts little. */
struct ArmBend
{
  Vector3 direction{}; ///< in which it leaves its junction, if it bends there as much
  Vector3 turn{};      ///< across the plane in which it bends, as long as it does
};

inline ArmBend
BendOf(const Arm & arm, double voxel)
{
  // Points along a curve are as independent as one in two voxels; a bend of three standard deviations counts half.
  constexpr double kIndependent = 2;
  constexpr double kBendPrior = 9;
  const double     length = std::min(2 * (arm.to - arm.from), arm.free - arm.from);
  ArmBend          result{ AxisOf(arm).direction, {} };
  const auto       isUsed = [&](double way) { return way >= arm.from && way <= arm.from + length; };
  ParabolaFit      fit;
  for (std::size_t i = 0; i < arm.points.size(); ++i)
  {
    if (isUsed(arm.line.way[i]))
    {
      fit.Add((arm.line.way[i] - arm.from) / length, 1, arm.line.places[i]);
    }
  }
  Vector3      factors[3]{};
  const double independent = length / (kIndependent * voxel);
  if (independent <= 3 || !fit.Coefficients(factors))
  {
    return result;
  }
  double squares = 0;
  for (std::size_t i = 0; i < arm.points.size(); ++i)
  {
    if (isUsed(arm.line.way[i]))
    {
      const double  u = (arm.line.way[i] - arm.from) / length;
      const Vector3 on = AddScaled(AddScaled(factors[0], u, factors[1]), u * u, factors[2]);
      squares += Dot(Minus(arm.line.places[i], on), Minus(arm.line.places[i], on)) / fit.moments[0];
    }
  }
  // Of places spread evenly over 0 to 1 the variance of what stands before u^2 is 180 times theirs over their number.
  const double noise = 180 * squares / (independent - 3);
  const double bend = Dot(factors[2], factors[2]);
  const double part = bend > 0 ? bend / (bend + kBendPrior * noise) : 0;
  // In the middle of the way the slope is its mean.
  const Vector3 middle = AddScaled(factors[1], 1, factors[2]);
  result.direction = Unit(AddScaled(middle, -part * (2 * arm.from / length + 1), factors[2]));
  result.turn = AddScaled({}, part / (length * length), Cross(Unit(middle), factors[2]));
  return result;
}

/** From 0 to 1: whether two arms bend as much, in the same plane, as parts of one curve. */
inline double
BendAlike(const ArmBend & a, const ArmBend & b)
{
  const double most = std::max(Dot(a.turn, a.turn), Dot(b.turn, b.turn));
  return most > 0 ? std::max(0.0, -Dot(a.turn, b.turn) / most) : 0;
}

} // namespace voxelcore
