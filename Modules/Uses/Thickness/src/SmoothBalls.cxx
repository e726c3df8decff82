#include "voxelcore/Thickness/SmoothBalls.h"

#include "PlaceGrid.h"
#include "SquareGrid.h"
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
#include <utility>

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
constexpr double kApart = 1e-3;        ///< of VoxelSize(): of places that are nearer, rounding tells where one is
constexpr double kLess = 15.0 / 16;    ///< of a radius that is too great for the labels: the next to be tried

/** Side of the cube with a voxel's diagonal, mm. */
double
VoxelSize(const Vector3 & sides)
{
  return Length(sides) / std::sqrt(3.0);
}

/** Lengths in mm. */
class BallFinder
{
public:
  BallFinder(SurfacePlaces places, double voxel)
    : m_Places(std::move(places))
    , m_Grid(
        m_Places.size(),
        [this](std::size_t i) { return m_Places[i].at; },
        kCube * voxel)
    , m_Voxel(voxel)
  {
    m_Grid.Arrange(m_Places);
    Vector3 low = m_Places.front().at;
    Vector3 high = low;
    for (const SurfacePlace & place : m_Places)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], place.at[axis]);
        high[axis] = std::max(high[axis], place.at[axis]);
      }
    }
    m_Most = Distance(low, high);
  }

  /** The balls at places first to end - 1 of those in an order of which near ones are neighbours. */
  void
  Find(std::size_t first, std::size_t end, std::vector<Ball> & found) const
  {
    Search search;
    for (std::size_t i = first; i < end; ++i)
    {
      found[m_Grid.Order()[i]] = At(i, search);
    }
  }

private:
  static constexpr double kCube = 2;      ///< of VoxelSize(): a cube of the grid
  static constexpr double kGrowth = 1.25; ///< from one place's ball to the next one's

  /** What searches before have left; no result depends on it. */
  struct Search
  {
    std::array<std::size_t, 8> others{}; ///< places that the last balls touched
    std::size_t                next = 0; ///< of these to be replaced
    double                     radius = 0;
    std::vector<std::size_t>   near; ///< places
  };

  /** The greatest one that touches a place from within; none, of radius 0, where nothing ends it. Of each other place
   *  the ball that touches both is known, and the least of these is looked for: in balls that grow until there is one,
   *  and that shrink with what is found, as smaller ones lie in greater ones. */
  Ball
  At(std::size_t index, Search & search) const
  {
    const SurfacePlace & own = m_Places[index];
    const double         shell = kNearlyTouches * m_Voxel;
    Ball                 ball;
    std::size_t          ending = index;
    // What the ball nearly touches is looked for, too.
    const auto wider = [&] { return Ball{ AddScaled(own.at, -ball.radius, own.normal), ball.radius + shell }; };
    const auto touch = [&](std::size_t other) {
      const Vector3 gap = Minus(own.at, m_Places[other].at);
      const double  across = 2 * Dot(own.normal, gap);
      const double  squared = Dot(gap, gap);
      if (squared > m_Apart && squared <= ball.radius * across * (1 + kTouches) && squared / across <= ball.radius)
      {
        ball.radius = squared / across;
        ending = other;
      }
    };
    for (double radius = std::max(2 * m_Voxel, kGrowth * search.radius); ending == index; radius *= 2)
    {
      ball.radius = radius;
      for (const std::size_t other : search.others)
      {
        touch(other);
      }
      search.near.clear();
      Ball around = wider();
      m_Grid.Visit(around, [&](std::size_t other) {
        search.near.push_back(other);
        const double before = ball.radius;
        touch(other);
        const bool isSmaller = ball.radius < before;
        if (isSmaller)
        {
          around = wider();
        }
        return isSmaller;
      });
      if (ending == index && radius > m_Most)
      {
        return {};
      }
    }
    search.radius = ball.radius;
    if (std::find(search.others.begin(), search.others.end(), ending) == search.others.end())
    {
      search.others[search.next++ % search.others.size()] = ending;
    }
    if (ball.radius > m_Most)
    {
      return {};
    }
    ball.centre = AddScaled(own.at, -ball.radius, own.normal);
    ball.radius = MeanDistance(ball, shell, search.near);
    return ball;
  }

  /** Along normals, of the surface at places that are at most a little farther than those that end the ball. */
  double
  MeanDistance(const Ball & ball, double shell, std::vector<std::size_t> & near) const
  {
    const double reach = ball.radius + shell;
    const auto   isFar = [&](std::size_t i) {
      const Vector3 gap = Minus(m_Places[i].at, ball.centre);
      return Dot(gap, gap) >= reach * reach;
    };
    near.erase(std::remove_if(near.begin(), near.end(), isFar), near.end());
    const auto & order = m_Grid.Order(); // sums depend on their order, and this one goes by where the body is cut
    std::sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) { return order[a] < order[b]; });
    double sum = 0;
    double weights = 0;
    for (const std::size_t i : near)
    {
      const Vector3 gap = Minus(m_Places[i].at, ball.centre);
      const double  along = Dot(m_Places[i].normal, gap);
      const double  part = 1 - (Length(gap) - ball.radius) / shell;
      if (along > 0)
      {
        sum += m_Places[i].area * part * part * along;
        weights += m_Places[i].area * part * part;
      }
    }
    return weights > 0 ? std::min(sum / weights, reach) : ball.radius;
  }

  SurfacePlaces m_Places; ///< in the grid's order
  PlaceGrid     m_Grid;
  double        m_Voxel;
  double        m_Apart = kApart * kApart * m_Voxel * m_Voxel;
  double        m_Most = 0;
};

PaintingBalls
BallsAt(SurfacePlaces places, const VoxelShape & shape, const Vector3 & sides, const ProgressCallback & progress)
{
  constexpr std::size_t chunk = 256;
  std::vector<Ball>     found(places.size());
  const BallFinder      finder(std::move(places), VoxelSize(sides));
  const std::size_t     chunks = (found.size() + chunk - 1) / chunk;
  RunEach(
    chunks,
    [&](std::size_t part) { finder.Find(part * chunk, std::min((part + 1) * chunk, found.size()), found); },
    [&](std::size_t done) {
      ReportProgress(progress, "thickness", static_cast<double>(done) / static_cast<double>(chunks));
    });
  PaintingBalls balls;
  for (const Ball & ball : found)
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
    , m_Squares(m_Boxes, weights)
    , m_Unit(weights.unit)
    , m_More(MoreThanBetween(weights))
  {}

  /** Of the greatest ball in it about a place, mm; `most` where that is less, 0 outside. */
  double
  RadiusAt(const Vector3 & place, double most) const
  {
    const Vector3 there{ place[0] + 0.5, place[1] + 0.5, place[2] + 0.5 };
    const auto    index = [&](std::size_t axis) { return static_cast<std::int32_t>(std::floor(there[axis])); };
    if (!m_Boxes.Contains(index(0), index(1), index(2)))
    {
      return 0;
    }
    const double within = (most - m_More) / m_Unit;
    return within <= 0 || m_Squares.IsFree(there, within)
             ? most
             : std::min(most, m_Unit * m_Squares.Distance(there, within) + m_More);
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
  SquareGrid m_Squares;
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
    StagePlan     plan(progress, { 0.5, 0.5 });
    SurfacePlaces places = PlacesOn(*surface, squares, sides, plan.Next("thickness"));
    return KeptToLabels(BallsAt(std::move(places), shape, sides, plan.Next("thickness")), shape, weights);
  }
  StagePlan                  plan(progress, { 0.05, 0.05, 0.02, 0.48, 0.4 });
  const double               voxel = VoxelSize(sides);
  std::vector<double>        reaches(squares.size());
  std::optional<LabelPlaces> labels(std::in_place, squares, sides);
  const VoxelRanks           ranks(shape);
  {
    const std::vector<double> first(squares.size(), kFirstReach * voxel);
    SurfacePlaces             places = labels->Find(first, plan.Next("thickness"));
    const PaintingBalls       balls = BallsAt(std::move(places), shape, sides, plan.Next("thickness"));
    const VoxelOwners         owners = OwnersAmong(balls, shape, weights, plan.Next("thickness"));
    const VoxelValues         map = ThicknessOfOwners(shape, weights, balls, owners);
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      const auto & voxelBehind = squares[i].voxel;
      const double radius = 0.5 * map.values[ranks.At(voxelBehind[0], voxelBehind[1], voxelBehind[2])] / voxel;
      reaches[i] = voxel * std::clamp(kReachOfRadius * radius + kReachBeyond, kLeastReach, kMostReach);
    }
  }
  SurfacePlaces places = labels->Find(reaches, plan.Next("thickness"));
  labels.reset();
  return KeptToLabels(BallsAt(std::move(places), shape, sides, plan.Next("thickness")), shape, weights);
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
  const SquareGrid  squares(shape, weights);
  const double      beyond = MostBeyondVoxels(weights);
  std::atomic<bool> lie = true;
  RunInParts(balls.Count() > 1000, balls.Count(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && lie; ++i)
    {
      const double within = (balls.radius[i] - beyond) / weights.unit;
      if (within > 0 && !squares.IsFree(balls.centres[i], within))
      {
        lie = false;
      }
    }
  });
  return lie;
}

} // namespace voxelcore
