#include "voxelcore/Thickness/SmoothBalls.h"

#include "PlaceTree.h"
#include "SquareTree.h"
#include "SurfacePlaces.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Thickness/CoreThickness.h"
#include "voxelcore/Thickness/FineBracket.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace voxelcore
{

namespace
{

// Reaches in VoxelSize(). Chosen on bodies of nine kinds at 1:1:1 and 1:1:2.5 (Testing/Performance/Thickness): 0.2 more
// or less of any of them changes no mean by 0.02 of a voxel. Less than the least and slopes are not told from steps;
// beyond the most, rims of plates are smoothed away.
constexpr double kFirstReach = 3;
constexpr double kLeastReach = 2.5;
constexpr double kMostReach = 5;
constexpr double kReachOfRadius = 0.7;
constexpr double kReachBeyond = 1;

constexpr double kNearlyTouches = 0.5; ///< of VoxelSize(), more than places err
constexpr double kTouches = 1e-9;      ///< of a radius: rounding
constexpr int    kMostSteps = 64;      ///< of shrinking; about four are taken
constexpr double kLess = 15.0 / 16;    ///< of a radius that is too great for the labels: the next to be tried

/** Side of the cube with a voxel's diagonal, mm. */
double
VoxelSize(const Vector3 & sides)
{
  return Length(sides) / std::sqrt(3.0);
}

/** mm */
struct TouchingBall
{
  Vector3 centre{};
  double  radius = 0;
};

class BallFinder
{
public:
  BallFinder(const SurfacePlaces & places, double voxel)
    : m_Surface(places)
    , m_Tree(places.places)
    , m_Voxel(voxel)
  {
    Vector3 low = places.places.front();
    Vector3 high = low;
    for (const Vector3 & place : places.places)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis]);
      }
    }
    m_Most = Distance(low, high);
  }

  /** The greatest one that touches a place from within; none, of radius 0, where nothing ends it. */
  TouchingBall
  At(std::uint32_t index, std::vector<std::uint32_t> & near) const
  {
    const Vector3 & place = m_Surface.places[index];
    const Vector3 & normal = m_Surface.normals[index];
    TouchingBall    ball;
    ball.radius = 2 * m_Voxel;
    NearPlace  nearest;
    const auto isEmpty = [&] {
      ball.centre = AddScaled(place, -ball.radius, normal);
      nearest = m_Tree.Nearest(ball.centre);
      return nearest.index == index || std::sqrt(nearest.squared) >= ball.radius * (1 - kTouches);
    };
    while (isEmpty())
    {
      if (ball.radius > m_Most)
      {
        return {};
      }
      ball.radius *= 2;
    }
    for (int step = 0; step < kMostSteps; ++step)
    {
      const Vector3 gap = Minus(place, m_Surface.places[nearest.index]);
      const double  across = 2 * Dot(normal, gap);
      const double  touching = across > 0 ? Dot(gap, gap) / across : ball.radius;
      if (!(touching < ball.radius))
      {
        break;
      }
      ball.radius = touching;
      if (isEmpty())
      {
        break;
      }
    }
    ball.radius = MeanDistance(ball.centre, std::sqrt(nearest.squared), near);
    return ball;
  }

private:
  /** Along normals, of the surface at places that are at most a little farther than the nearest. */
  double
  MeanDistance(const Vector3 & centre, double nearest, std::vector<std::uint32_t> & near) const
  {
    const double shell = kNearlyTouches * m_Voxel;
    double       sum = 0;
    double       weights = 0;
    m_Tree.Within(centre, nearest + shell, near);
    for (const std::uint32_t index : near)
    {
      const Vector3 gap = Minus(m_Surface.places[index], centre);
      const double  along = Dot(m_Surface.normals[index], gap);
      const double  part = 1 - (Length(gap) - nearest) / shell;
      if (along > 0)
      {
        sum += m_Surface.areas[index] * part * part * along;
        weights += m_Surface.areas[index] * part * part;
      }
    }
    return weights > 0 ? std::min(sum / weights, nearest + shell) : nearest;
  }

  const SurfacePlaces & m_Surface;
  PlaceTree             m_Tree;
  double                m_Voxel;
  double                m_Most = 0;
};

PaintingBalls
BallsAt(const SurfacePlaces &    places,
        const VoxelShape &       shape,
        const Vector3 &          sides,
        const ProgressCallback & progress)
{
  constexpr std::size_t     chunk = 256;
  const BallFinder          finder(places, VoxelSize(sides));
  std::vector<TouchingBall> found(places.places.size());
  const std::size_t         chunks = (found.size() + chunk - 1) / chunk;
  RunEach(
    chunks,
    [&](std::size_t part) {
      std::vector<std::uint32_t> near;
      for (std::size_t i = part * chunk; i < std::min((part + 1) * chunk, found.size()); ++i)
      {
        found[i] = finder.At(static_cast<std::uint32_t>(i), near);
      }
    },
    [&](std::size_t done) {
      ReportProgress(progress, "thickness", static_cast<double>(done) / static_cast<double>(chunks));
    });
  PaintingBalls balls;
  for (const TouchingBall & ball : found)
  {
    const Vector3 centre = Over(ball.centre, sides);
    if (ball.radius > 0 && shape.Contains(static_cast<std::int32_t>(std::floor(centre[0])),
                                          static_cast<std::int32_t>(std::floor(centre[1])),
                                          static_cast<std::int32_t>(std::floor(centre[2]))))
    {
      balls.Add(centre, ball.radius, ball.radius);
    }
  }
  return balls;
}

/** The boxes between eight centres of which one is in, the voxel that a box is named for the last of them. */
VoxelShape
BetweenCentres(const VoxelShape & shape)
{
  const VoxelBox & box = shape.Box();
  VoxelShape       between({ box.lower, { box.size[0] + 1, box.size[1] + 1, box.size[2] + 1 } });
  for (std::int32_t z = 0; z < between.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < between.Box().size[1]; ++y)
    {
      const auto to = between.Row(y, z);
      for (std::int32_t from = 0; from < 4; ++from)
      {
        const std::int32_t fromY = y - from % 2;
        const std::int32_t fromZ = z - from / 2;
        if (fromY < 0 || fromZ < 0 || fromY >= box.size[1] || fromZ >= box.size[2])
        {
          continue;
        }
        const auto    row = shape.Row(fromY, fromZ);
        std::uint64_t carried = 0;
        for (std::size_t word = 0; word < to.size(); ++word)
        {
          const std::uint64_t in = word < row.size() ? row[word] : 0;
          to[word] |= in | in << 1U | carried;
          carried = in >> 63U;
        }
      }
    }
    if (z % 8 == 7)
    {
      between.Compact(z - 7, z + 1);
    }
  }
  between.Compact();
  return between;
}

/** What the smooth surfaces that labels allow can have inside. */
class AllowedBody
{
public:
  AllowedBody(const VoxelShape & shape, const SpacingWeights & weights)
    : m_Boxes(BetweenCentres(shape))
    , m_Tree(m_Boxes, weights)
    , m_Unit(weights.unit)
    , m_More(MoreThanBetween(weights))
  {}

  /** Of the greatest ball in it about a place, mm; `most` where that is less, 0 outside. */
  double
  RadiusAt(const Vector3 & place, double most) const
  {
    const Vector3 there{ place[0] + 0.5, place[1] + 0.5, place[2] + 0.5 };
    const auto    index = [&](std::size_t axis) { return static_cast<std::int32_t>(std::floor(there[axis])); };
    return m_Boxes.Contains(index(0), index(1), index(2))
             ? std::min(most, m_Unit * m_Tree.Distance(there, most / m_Unit) + m_More)
             : 0;
  }

private:
  /** By so much at least, mm, SmoothBracket() lets surfaces reach beyond these boxes: half a part of a voxel. */
  static double
  MoreThanBetween(const SpacingWeights & weights)
  {
    const std::array<std::int32_t, 3> parts = PartsForBounds(weights);
    const Vector3                     sides = SidesOf(weights);
    double                            least = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least = std::min(least, 0.5 * sides[axis] / parts[axis]);
    }
    return least;
  }

  VoxelShape m_Boxes;
  SquareTree m_Tree;
  double     m_Unit;
  double     m_More;
};

PaintingBalls
KeptToLabels(PaintingBalls balls, const VoxelShape & shape, const SpacingWeights & weights)
{
  const AllowedBody body(shape, weights);
  RunInParts(balls.Count() > 1000, balls.Count(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      balls.radius[i] = body.RadiusAt(balls.centres[i], balls.radius[i]);
      balls.value[i] = balls.radius[i];
    }
  });
  return balls;
}

/** The radius of a ball in the body that holds a place, at most that of the ball it is towards, mm: that ball, pushed
 *  on to the place, made smaller until it lies in the body there. */
double
PushedRadius(const AllowedBody & body,
             const Vector3 &     place,
             const Vector3 &     towards,
             double              most,
             const Vector3 &     sides)
{
  const Vector3 way = Minus(towards, place);
  const double  length = Length(Times(way, sides));
  double        radius = std::min(most, length);
  const double  least = 0.5 * *std::min_element(sides.begin(), sides.end());
  while (radius > least && body.RadiusAt(AddScaled(place, radius / length, way), radius) < radius)
  {
    radius *= kLess;
  }
  return std::max(radius, least);
}

} // namespace

PaintingBalls
SmoothBalls(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const SurfaceEstimate *  surface,
            const ProgressCallback & progress)
{
  const std::vector<FacingSquare> squares = FacingSquares(shape);
  if (squares.empty())
  {
    return {};
  }
  const Vector3 sides = SidesOf(weights);
  if (surface != nullptr)
  {
    StagePlan           plan(progress, { 0.5, 0.5 });
    const SurfacePlaces places = PlacesOn(*surface, squares, sides, plan.Next("thickness"));
    return KeptToLabels(BallsAt(places, shape, sides, plan.Next("thickness")), shape, weights);
  }
  StagePlan           plan(progress, { 0.2, 0.2, 0.1, 0.3, 0.2 });
  const LabelPlaces   labels(squares, sides);
  const double        voxel = VoxelSize(sides);
  std::vector<double> reaches(squares.size(), kFirstReach * voxel);
  {
    const SurfacePlaces places = labels.Find(reaches, plan.Next("thickness"));
    const PaintingBalls balls = BallsAt(places, shape, sides, plan.Next("thickness"));
    const VoxelOwners   owners = OwnersAmong(balls, shape, weights, plan.Next("thickness"));
    const VoxelValues   map = ThicknessOfOwners(shape, weights, balls, owners);
    const VoxelRanks    ranks(shape);
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      const auto & voxelBehind = squares[i].voxel;
      const double radius = 0.5 * map.values[ranks.At(voxelBehind[0], voxelBehind[1], voxelBehind[2])] / voxel;
      reaches[i] = voxel * std::clamp(kReachOfRadius * radius + kReachBeyond, kLeastReach, kMostReach);
    }
  }
  const SurfacePlaces places = labels.Find(reaches, plan.Next("thickness"));
  return KeptToLabels(BallsAt(places, shape, sides, plan.Next("thickness")), shape, weights);
}

VoxelValues
SmoothThicknessOf(const VoxelShape &     shape,
                  const SpacingWeights & weights,
                  const PaintingBalls &  balls,
                  const VoxelOwners &    owners)
{
  const Vector3              sides = SidesOf(weights);
  const VoxelBox &           box = shape.Box();
  VoxelValues                map = ThicknessOfOwners(shape, weights, balls, owners);
  std::optional<AllowedBody> body;
  std::size_t                at = 0;
  const auto                 mend = [&](const Vector3 & place) {
    const std::uint32_t owner = owners.values[at];
    if (owner == 0)
    {
      return;
    }
    const Vector3 & centre = balls.centres[owner - 1];
    const double    radius = balls.radius[owner - 1];
    if (Length(Times(Minus(centre, place), sides)) <= radius * (1 + kTouches))
    {
      return;
    }
    if (!body)
    {
      body.emplace(shape, weights);
    }
    map.values[at] = static_cast<float>(2 * PushedRadius(*body, place, centre, radius, sides));
  };
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto bits = shape.Row(y, z);
      for (std::size_t word = 0; word < bits.size(); ++word)
      {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1, ++at)
        {
          const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(rest);
          mend({ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 });
        }
      }
    }
  }
  return map;
}

double
MostBeyondVoxels(const SpacingWeights & weights)
{
  const Vector3 sides = SidesOf(weights);
  const double  widest = std::sqrt(Dot(sides, sides) - std::pow(*std::min_element(sides.begin(), sides.end()), 2));
  return (0.5 * Length(sides) + 0.5 * widest + kNearlyTouches * VoxelSize(sides)) * (1 + kTouches);
}

bool
LieInVoxels(const PaintingBalls & balls, const VoxelShape & shape, const SpacingWeights & weights)
{
  const SquareTree  tree(shape, weights);
  const double      beyond = MostBeyondVoxels(weights);
  std::atomic<bool> lie = true;
  RunInParts(balls.Count() > 1000, balls.Count(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && lie; ++i)
    {
      const double within = balls.radius[i] / weights.unit;
      if (balls.radius[i] > weights.unit * tree.Distance(balls.centres[i], within) + beyond)
      {
        lie = false;
      }
    }
  });
  return lie;
}

} // namespace voxelcore
