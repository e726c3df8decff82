#include "voxelcore/SmoothBalls.h"

#include "PlaceTree.h"
#include "SquareTree.h"
#include "SurfacePlaces.h"
#include "voxelcore/CoreThickness.h"
#include "voxelcore/ParallelTasks.h"
#include "voxelcore/StagePlan.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

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
    return BallsAt(places, shape, sides, plan.Next("thickness"));
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
  return BallsAt(places, shape, sides, plan.Next("thickness"));
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
