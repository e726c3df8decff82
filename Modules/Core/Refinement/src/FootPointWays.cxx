// The ways of feet along the surface.

#include "FootPoints.h"

#include "voxelcore/Base/Hypot.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

// What is left to the foot of the plane through the surface at a place.
Vector3
SlideOf(const Vector3 & place, const SurfacePoint & foot)
{
  const Vector3 gap = Minus(place, foot.position);
  return AddScaled(gap, -Dot(gap, foot.normal), foot.normal);
}

// Of a quadratic form the least value among all directions, by what it makes of two at right angles.
double
LeastOf(const std::array<Vector3, 2> & ways, const std::array<Vector3, 2> & made)
{
  const double a = Dot(ways[0], made[0]);
  const double b = Dot(ways[1], made[1]);
  const double c = 0.5 * (Dot(ways[0], made[1]) + Dot(ways[1], made[0]));
  return 0.5 * (a + b) - Hypot(0.5 * (a - b), c);
}

// A slide stretched along two directions: stretch(bend) by the bends of the distance along them.
template <typename TStretch>
Vector3
Stretched(const Vector3 & slide, const DistanceBends & bends, TStretch stretch)
{
  Vector3 way{ 0, 0, 0 };
  for (std::size_t i = 0; i < 2; ++i)
  {
    way = AddScaled(way, stretch(bends.bends[i]) * Dot(slide, bends.directions[i]), bends.directions[i]);
  }
  return way;
}

// 1 + r + r^2 + r^3 with r = 1 - bend: what four steps of the slide that is left go in all, but never beyond the foot.
double
LikeFourSteps(double bend)
{
  const double rest = 1 - std::max(bend, 0.0);
  return bend >= 1 ? 1 / bend : (1 + rest) * (1 + rest * rest);
}

constexpr double kLongestStride = 2.0; // voxels
constexpr double kTurn = 0.3;          // cosine: beyond it is another side of the surface

} // namespace

// Whether the way along the ball from where the surface passes a boundary vertex to a foot falls all along, but for
// ripples. The cosine of the angle between both is at most `most`.
bool
FootPointFinder::Falls(const Vector3 & place, std::uint32_t point, const FootPoint & to, double most) const
{
  constexpr double     opposite = -0.9; // cosine: there are many ways
  const double         ripples = Ripples() * m_Voxel;
  const SurfacePoint & anchor = m_Anchors[point];
  const Vector3        first = Minus(anchor.position, place);
  const Vector3        last = Minus(to.position, place);
  const double         distance = Length(first);
  double               farthest = distance + ripples;
  const double         cosine = Dot(first, last) / (distance * to.distance);
  if (!anchor.found || to.distance > farthest || !(cosine >= opposite) || cosine > most)
  {
    return false;
  }
  const auto   steps = static_cast<int>(std::ceil(Distance(first, last) / m_Voxel));
  SurfacePoint before = anchor;
  SurfacePoint next;
  for (int step = 1; step <= steps; ++step)
  {
    const double  part = step / (steps + 1.0);
    const Vector3 ray = AddScaled(first, part, Minus(last, first));
    const double  away = distance + part * (to.distance - distance);
    const double  rise = TryFoot(place, AddScaled(place, away / Length(ray), ray), before, farthest, next);
    if (!(rise <= 0))
    {
      return false;
    }
    farthest = std::min(farthest, farthest + rise + ripples);
    before = next;
  }
  return true;
}

// A try to come nearer to `place` by way of `to`, a place beside the surface. Returns how much farther than `distance`
// the surface is there, at `next`; infinity where it is another side of it.
double
FootPointFinder::TryFoot(const Vector3 &      place,
                         const Vector3 &      to,
                         const SurfacePoint & foot,
                         double               distance,
                         SurfacePoint &       next) const
{
  next = m_Input.surface->Project(to, m_Voxel);
  return !next.found || std::abs(Dot(next.normal, foot.normal)) < kTurn ? std::numeric_limits<double>::infinity()
                                                                        : Distance(place, next.position) - distance;
}

// Near the axis of a tube the surface falls less than its ripples and facets do, and the way down cannot be told from
// its normal. So where no slope is left, ways at right angles are tried with long strides, until slopes beside the foot
// show that it lies lower than all around nearly as that of a flat surface does.
void
FootPointFinder::Descend(const Vector3 & place, FootPoint & begin) const
{
  constexpr int    steps = 120;
  const double     shortest = Ripples() > 0 ? 0.3 : 0.1; // voxels
  constexpr double ofRadius = 0.25;
  constexpr double ofFlatRise = 0.2;
  constexpr double ofFlatRiseAfar = 0.5; // where bends are not so well known
  constexpr double leastBend = 0.25;
  constexpr double ofFlatRiseOfTwo = 0.6; // on two ways at right angles: then at least 0.2 on all
  SurfacePoint     foot{ begin.position, begin.normal, begin.found };
  double           distance = Distance(place, foot.position);
  begin.distance = distance;
  if (!foot.found)
  {
    return;
  }
  const double longest = std::max(kLongestStride * m_Voxel, ofRadius * distance);
  double       stride = std::max(0.5 * m_Voxel, ofRadius * distance);
  bool         flat = false;
  SurfacePoint next;
  // Facets have no slopes to go by, so that on a mesh ways are tried all around.
  const bool bySlopes = Ripples() > 0;
  // What is nearly as near lies along the ball, not along the surface's tangents, which leave a tube soon. From one
  // shallow ripple to the next it would be a long way.
  constexpr double ofRipples = 0.1;
  const double     shallowest = ofRipples * Ripples() * m_Voxel;
  double           rise = 0;
  const auto       descends = [&](double length, const Vector3 & way) {
    const Vector3 ray = Minus(AddScaled(foot.position, length, way), place);
    const double  away = Length(ray);
    const Vector3 to = away > 0 ? AddScaled(place, distance / away, ray) : place;
    rise = TryFoot(place, to, foot, distance, next);
    if (rise >= -shallowest)
    {
      return false;
    }
    foot = next;
    distance += rise;
    return true;
  };
  Vector3       slide{};
  double        length = 0;
  bool          slopes = false;
  bool          known = false;
  DistanceBends bends;
  // Whole steps down have failed from this foot, and would again with any stride that is as long as they are.
  bool hasFailed = false;
  bool isNew = true;
  for (int step = 0; step < steps && stride >= shortest * m_Voxel; ++step)
  {
    if (isNew)
    {
      slide = SlideOf(place, foot);
      length = Length(slide);
      slopes = length >= m_Close * m_Voxel;
      const FootPoint at{ begin.point, foot.position, distance, foot.normal, true };
      known = bySlopes && BendsAt(place, at, 1, bends);
      flat = flat || (known && bends.bends[0] > ofFlatRise) ||
             (!known && bySlopes && BendsAt(place, at, 2, bends) && bends.bends[0] > ofFlatRiseAfar);
      hasFailed = false;
    }
    if (flat && !slopes)
    {
      break;
    }
    isNew = true;
    if (known && slopes)
    {
      const Vector3 way = Stretched(slide, bends, [&](double bend) { return 1 / std::max(bend, leastBend); });
      const double  far = Length(way);
      // All of the way falls by so much. Bends tell it so well that half of the least is not worth a try.
      if (flat && Dot(slide, way) < shallowest * distance)
      {
        break;
      }
      if (!(hasFailed && far <= stride) && descends(std::min(1.0, stride / far), way))
      {
        stride = std::min(longest, 2 * stride);
        continue;
      }
    }
    const bool   atMost = flat || bySlopes;
    const double part = (atMost ? std::min(stride, length) : stride) / length;
    if ((bySlopes ? slopes : length > 0) && !(hasFailed && length <= stride) && descends(part, slide))
    {
      stride = std::min(longest, 2 * stride);
      continue;
    }
    hasFailed = atMost;
    if (!flat)
    {
      const std::array<Vector3, 2> ways = TangentsOf(foot.normal, slide);
      std::array<Vector3, 2>       back{};
      bool                         found = true;
      bool                         lower = false;
      double                       least = std::numeric_limits<double>::infinity();
      for (std::size_t way = 0; way < 4 && !lower && !flat; ++way)
      {
        lower = descends(way < 2 ? stride : -stride, ways[way % 2]);
        least = std::min(least, rise);
        if (bySlopes && !lower && way < 2)
        {
          found = found && next.found;
          back[way] = AddScaled({ 0, 0, 0 }, 1 / stride, Minus(slide, SlideOf(place, next)));
          flat = way == 1 && found && LeastOf(ways, back) > ofFlatRise;
        }
      }
      if (lower)
      {
        continue;
      }
      flat = flat || (!bySlopes && least > ofFlatRiseOfTwo * stride * stride / (2 * distance));
    }
    isNew = false;
    stride *= 0.5;
  }
  begin = { begin.point, foot.position, distance, foot.normal, true };
}

// From where the surface passes the boundary vertex downhill towards where a ball about `place` touches it. Where it is
// nearly as near in many directions, as about the axis of a tube, going all the way would lead to the deepest ripple,
// and both foot points of a pair to the same: a few steps reach the foot on all that is flatter.
void
FootPointFinder::Slide(const Vector3 & place, double most, FootPoint & begin) const
{
  int              steps = Ripples() > 0 ? 4 : 24;
  constexpr double shortest = 1.0 / 16;
  const double     nearly = Ripples() > 0 ? 0.5 : 0; // voxels: what does not fall there is a ripple
  const Vector3    home = Place(begin.point);
  SurfacePoint     foot{ begin.position, begin.normal, begin.found };
  begin.distance = Distance(place, foot.position);
  if (!foot.found)
  {
    return;
  }
  const double radius = Distance(place, home);
  const double reach = std::min(most, 1.5 * std::sqrt(2 * radius * m_Voxel) + 2 * m_Voxel);
  double       distance = begin.distance;
  double       shorter = 1;
  SurfacePoint next;
  // As far as those steps would lead on a surface that bends as this one does.
  DistanceBends bends;
  bool          stretched = BendsAt(place, begin, 1, bends);
  for (int step = 0; step < steps && shorter >= shortest; ++step)
  {
    const Vector3 left = SlideOf(place, foot);
    if (Length(left) < m_Close * m_Voxel)
    {
      break;
    }
    const Vector3 slide = stretched ? Stretched(left, bends, LikeFourSteps) : left;
    const double  length = Length(slide);
    if (shorter * length < m_Close * m_Voxel)
    {
      break;
    }
    const double part = shorter * std::min(1.0, kLongestStride * m_Voxel / length);
    const double rise = TryFoot(place, AddScaled(foot.position, part, slide), foot, distance, next);
    const bool   fails = rise >= 0 || Distance(next.position, home) > reach;
    if (stretched) // it stands for three of the steps, or for none, which then begin with a whole one
    {
      stretched = false;
      steps += fails ? 1 : -2;
      shorter *= fails ? 2 : 1;
    }
    if (fails)
    {
      if (length < nearly * m_Voxel)
      {
        break;
      }
      // A crease that draws back from `place` is nearest itself: steps end on it from either side only if they get
      // shorter.
      shorter *= 0.5;
      continue;
    }
    foot = next;
    distance += rise;
  }
  begin = { begin.point, foot.position, distance, foot.normal, true };
}

} // namespace voxelcore
