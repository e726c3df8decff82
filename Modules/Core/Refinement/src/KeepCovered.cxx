#include "KeepCovered.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr int kWhole = 16; // steps of a vertex' whole way

/** The balls of a part on their ways between where they were and where refinement put them. */
class BallWays
{
public:
  BallWays(const RefinementInput & input,
           const PointTree &       boundary,
           const ToleranceAt &     tolerance,
           const FormerBalls &     former,
           RefinedCore &           refined)
    : m_Input(input)
    , m_Boundary(boundary)
    , m_Weights(ComputeSpacingWeights(input.spacing))
    , m_Tolerance(tolerance)
    , m_Former(former)
    , m_Refined(refined)
    , m_Moves(refined.displacement)
    , m_Radius(refined.core.radius)
    , m_Steps(m_Radius.size(), kWhole)
    , m_Cover(input.Boundary().size(), 0)
  {}

  CoveredBoundary
  Run()
  {
    std::vector<std::uint32_t> open = FindOpen(m_Cover.size(), [](std::size_t i) { return i; });
    while (!open.empty())
    {
      const std::vector<std::uint8_t> changed = GoBack(open);
      if (std::find(changed.begin(), changed.end(), 1) == changed.end())
      {
        break; // what is still open was so before
      }
      std::vector<std::size_t> again;
      for (std::size_t point = 0; point < m_Cover.size(); ++point)
      {
        if (m_Cover[point] != kNone && changed[m_Cover[point]] != 0)
        {
          again.push_back(point);
        }
      }
      again.insert(again.end(), open.begin(), open.end());
      std::sort(again.begin(), again.end());
      open = FindOpen(again.size(), [&](std::size_t i) { return again[i]; });
    }
    std::vector<ElementIndex> back;
    for (std::size_t vertex = 0; vertex < m_Steps.size(); ++vertex)
    {
      if (m_Steps[vertex] < kWhole)
      {
        back.push_back(static_cast<ElementIndex>(vertex));
      }
    }
    return { std::move(*m_Balls), std::move(m_Cover), std::move(back) };
  }

private:
  static constexpr std::uint32_t kNone = CoveredBoundary::kOpen;

  struct Ball
  {
    Vector3 move;
    double  radius;
  };

  Vector3
  PlaceOf(std::size_t point) const
  {
    const LatticePoint & p = m_Input.Boundary()[point];
    return { static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) };
  }

  double
  Gap(std::size_t point, const Vector3 & centre, double radius) const
  {
    return BallTree({ &centre, 1 }, { &radius, 1 }, m_Weights).Gap(PlaceOf(point));
  }

  /** The ball of a vertex so many steps from where it was; none where it may not be. */
  std::optional<Ball>
  At(std::size_t vertex, int step) const
  {
    const Vector3 & from = m_Former.positions[vertex];
    if (step == 0)
    {
      return Ball{ { 0, 0, 0 }, m_Former.radius[vertex] };
    }
    const double  part = static_cast<double>(step) / kWhole;
    const Vector3 move = AddScaled({ 0, 0, 0 }, part, m_Moves[vertex]);
    const Vector3 place = AddScaled(from, 1, move);
    if (!ContainsInside(*m_Input.shape, place))
    {
      return std::nullopt;
    }
    const double half = 0.5 * Length(m_Input.spacing);
    const double radius = m_Former.radius[vertex] + part * (m_Radius[vertex] - m_Former.radius[vertex]);
    // The nearest boundary vertex was as far as the former radius.
    const double farthest = m_Former.radius[vertex] + Length(Times(move, m_Input.spacing)) + 1e-6 * half;
    const double nearest = std::sqrt(m_Boundary.SquaredDistance(Times(place, m_Input.spacing), farthest));
    return Ball{ move, std::clamp(radius, nearest - half, nearest + half) };
  }

  void
  Put(std::size_t vertex, int step)
  {
    std::optional<Ball> ball = At(vertex, step);
    for (; !ball; ball = At(vertex, step))
    {
      --step;
    }
    m_Steps[vertex] = step;
    m_Refined.displacement[vertex] = ball->move;
    m_Refined.core.positions[vertex] = AddScaled(m_Former.positions[vertex], 1, ball->move);
    m_Refined.core.radius[vertex] = ball->radius;
  }

  /** Which of some boundary vertices lie beyond their tolerance, ascending; notes a ball that covers each other one. */
  template <typename TPoint>
  std::vector<std::uint32_t>
  FindOpen(std::size_t count, const TPoint & pointAt)
  {
    m_Balls.emplace(m_Refined.core.positions, m_Refined.core.radius, m_Weights);
    const BallTree & balls = *m_Balls;
    const auto       last = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel if (last > 4096)
    {
      std::size_t nearest = 0;
#pragma omp for schedule(dynamic, 512)
      for (std::ptrdiff_t i = 0; i < last; ++i)
      {
        const std::size_t point = pointAt(static_cast<std::size_t>(i));
        const double      most = m_Tolerance(point);
        const double      gap = balls.Gap(PlaceOf(point), most, nearest);
        m_Cover[point] = gap <= most ? balls.BallOf(nearest) : kNone;
      }
    }
    std::vector<std::uint32_t> open;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (m_Cover[pointAt(i)] == kNone)
      {
        open.push_back(static_cast<std::uint32_t>(pointAt(i)));
      }
    }
    return open;
  }

  /** How many steps a ball may keep and cover a boundary vertex: less than it has. */
  int
  StepsToCover(std::size_t point, std::size_t vertex) const
  {
    for (int step = m_Steps[vertex] - 1; step > 0; --step)
    {
      const std::optional<Ball> ball = At(vertex, step);
      if (ball && Gap(point, AddScaled(m_Former.positions[vertex], 1, ball->move), ball->radius) <= m_Tolerance(point))
      {
        return step;
      }
    }
    return 0;
  }

  /** Of each open boundary vertex one ball goes back, as far as it must. Says which have. */
  std::vector<std::uint8_t>
  GoBack(const std::vector<std::uint32_t> & open)
  {
    if (!m_FormerBalls)
    {
      m_FormerBalls.emplace(m_Former.positions, m_Former.radius, m_Weights);
    }
    std::vector<std::pair<std::uint32_t, int>> wanted(open.size(), { kNone, 0 });
    const auto                                 last = static_cast<std::ptrdiff_t>(open.size());
    FirstFailure                               failure;
#pragma omp parallel if (last > 64)
    {
      std::vector<std::uint32_t> kept;
#pragma omp for schedule(dynamic, 16)
      for (std::ptrdiff_t i = 0; i < last; ++i)
      {
        auto & [vertex, steps] = wanted[static_cast<std::size_t>(i)];
        const std::uint32_t point = open[static_cast<std::size_t>(i)];
        failure.Guard(static_cast<std::size_t>(i),
                      [&] { m_FormerBalls->FindWithin(PlaceOf(point), m_Tolerance(point), kept); });
        for (const std::uint32_t one : kept)
        {
          const int needed = m_Steps[one] > 0 ? StepsToCover(point, one) : -1;
          if (needed >= 0 && (vertex == kNone || needed > steps))
          {
            vertex = one;
            steps = needed;
          }
        }
      }
    }
    failure.Rethrow();
    std::vector<int> target = m_Steps;
    for (const auto & [vertex, steps] : wanted)
    {
      if (vertex != kNone)
      {
        target[vertex] = std::min(target[vertex], steps);
      }
    }
    std::vector<std::uint8_t> changed(m_Steps.size(), 0);
    const auto                lower = [&](std::size_t vertex, int steps) {
      if (steps < m_Steps[vertex])
      {
        Put(vertex, steps);
        changed[vertex] = 1;
      }
    };
    for (std::size_t vertex = 0; vertex < target.size(); ++vertex)
    {
      lower(vertex, target[vertex]);
    }
    for (auto turned = FindTurned(changed); !turned.empty(); turned = FindTurned(changed))
    {
      for (const std::size_t face : turned)
      {
        for (const ElementIndex corner : m_Refined.core.cells.FaceVertices(face))
        {
          lower(corner, m_Steps[corner] / 2);
        }
      }
    }
    return changed;
  }

  Vector3
  Normal(std::span<const ElementIndex> corners, const std::vector<Vector3> & positions) const
  {
    std::array<Vector3, 3> at;
    for (std::size_t i = 0; i < 3; ++i)
    {
      at[i] = Times(positions[corners[i]], m_Input.spacing);
    }
    return Cross(Minus(at[1], at[0]), Minus(at[2], at[0]));
  }

  /** The triangles with a corner that has gone back and one that is not where it was, which lie the other way round. */
  std::vector<std::size_t>
  FindTurned(const std::vector<std::uint8_t> & changed) const
  {
    const CellComplex &      cells = m_Refined.core.cells;
    std::vector<std::size_t> turned;
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      const auto corners = cells.FaceVertices(face);
      const auto any = [&](const auto & isSo) { return std::any_of(corners.begin(), corners.end(), isSo); };
      if (any([&](ElementIndex corner) { return changed[corner] != 0; }) && any([&](ElementIndex corner) {
            return m_Refined.displacement[corner] != Vector3{ 0, 0, 0 };
          }) &&
          !(Dot(Normal(corners, m_Former.positions), Normal(corners, m_Refined.core.positions)) > 0))
      {
        turned.push_back(face);
      }
    }
    return turned;
  }

  const RefinementInput &    m_Input;
  const PointTree &          m_Boundary;
  const SpacingWeights       m_Weights;
  const ToleranceAt &        m_Tolerance;
  const FormerBalls &        m_Former;
  RefinedCore &              m_Refined;
  const std::vector<Vector3> m_Moves;  ///< whole ways
  const std::vector<double>  m_Radius; ///< at their ends
  std::vector<int>           m_Steps;  ///< of the way, by vertex
  std::vector<std::uint32_t> m_Cover;  ///< a ball that covers each boundary vertex
  std::optional<BallTree>    m_Balls;  ///< since they last went back
  std::optional<BallTree>    m_FormerBalls;
};

} // namespace

CoveredBoundary
KeepBoundaryCovered(const RefinementInput & input,
                    const PointTree &       boundary,
                    const ToleranceAt &     tolerance,
                    const FormerBalls &     former,
                    RefinedCore &           refined)
{
  return BallWays(input, boundary, tolerance, former, refined).Run();
}

} // namespace voxelcore
