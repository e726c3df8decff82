#include "voxelcore/FittedBalls.h"

#include "BallEnvelope.h"
#include "GrowthEquations.h"
#include "RoundParts.h"
#include "ThinPlates.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kReach = 3; ///< cubes
constexpr int          kStraightenings = 4;
constexpr double       kRim = 1e-3;       ///< weight of squares at rims
constexpr double       kPiece = 0.5;      ///< of a ball's radius: squares about it are cut into no larger pieces
constexpr double       kLeastPiece = 0.2; ///< of the shortest side
constexpr double       kNoise = 0.5;      ///< of the longest side: radii along a line that are alike
constexpr std::int32_t kLayers = 8;       ///< of voxels, that one thread looks through

using Cube = std::array<std::int32_t, 3>;
using Cubes = std::map<Cube, GrowthEquations>;

/** What the squares tell. */
struct Squares
{
  Cubes      cubes; ///< of balls of sheets
  RoundParts round;
};

/** Whether balls at a vertex are round where a body may have edges: on edges with one face, ends of lines, points. */
std::vector<std::uint8_t>
FindRims(const CellComplex & cells)
{
  const std::vector<Cofaces> faces = CountEdgeCofaces(cells);
  const std::vector<Cofaces> edges = CountVertexCofaces(cells);
  std::vector<std::uint8_t>  rims(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (const ElementIndex end : cells.edges[edge])
    {
      rims[end] = faces[edge].count == 1 ? 1 : rims[end];
    }
  }
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    rims[vertex] = edges[vertex].count <= 1 ? 1 : rims[vertex];
  }
  return rims;
}

/** Centres averaged with those of the vertices around, so many times; ends of lines stay. */
std::vector<Vector3>
Straightened(const CellComplex & cells, std::vector<Vector3> centres, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    std::vector<Vector3>       sums = centres;
    std::vector<std::uint32_t> counts(centres.size(), 1);
    for (const auto & ends : cells.edges)
    {
      for (std::size_t end = 0; end < 2; ++end)
      {
        sums[ends[end]] = AddScaled(sums[ends[end]], 1, centres[ends[1 - end]]);
        ++counts[ends[end]];
      }
    }
    for (std::size_t i = 0; i < centres.size(); ++i)
    {
      centres[i] = counts[i] > 2 ? AddScaled({ 0, 0, 0 }, 1.0 / counts[i], sums[i]) : centres[i];
    }
  }
  return centres;
}

class Fitter
{
public:
  Fitter(const VoxelShape & shape, const SpacingWeights & weights, const CellComplex & cells, PaintingBalls & balls)
    : m_Shape(shape)
    , m_Weights(weights)
    , m_Balls(balls)
    , m_Cells(cells)
    , m_Rims(FindRims(cells))
    , m_Bends(FindBends(cells))
    , m_Envelope(cells, balls, weights)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Sides[axis] = static_cast<double>(weights.weight[axis]) * weights.unit;
    }
    m_Longest = *std::max_element(m_Sides.begin(), m_Sides.end());
    m_Shortest = *std::min_element(m_Sides.begin(), m_Sides.end());
    m_Cube = m_Longest + m_Shortest;
    m_Places.reserve(balls.Count());
    for (const Vector3 & centre : balls.centres)
    {
      m_Places.push_back(Times(centre, m_Sides));
    }
  }

  void
  Fit(const ProgressCallback & progress)
  {
    const Squares          all = SumSquares();
    std::map<Cube, double> growths;
    std::vector<Cube>      cubeOf;
    ReportProgress(progress, "thickness", 0.8);
    for (const Vector3 & centre : m_Balls.centres)
    {
      cubeOf.push_back(CubeOf(centre));
      growths.emplace(cubeOf.back(), 0);
    }
    std::vector<std::pair<const Cube, double> *> items;
    items.reserve(growths.size());
    for (auto & item : growths)
    {
      items.push_back(&item);
    }
    RunInParts(items.size() > 1000, items.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        items[i]->second = GrowthAt(all.cubes, items[i]->first);
      }
    });
    const std::vector<RoundRadius> round = RoundRadii(m_Cells,
                                                      m_Bends,
                                                      m_Places,
                                                      m_Balls.radius,
                                                      all.round,
                                                      { kReach * m_Cube, kNoise * m_Longest, m_Longest });
    const auto                     told = [&](std::size_t i) {
      const double around = round[i].before + growths.at(cubeOf[i]);
      return around + round[i].part * (round[i].after - around);
    };
    const std::vector<double> thin = ThinPlatesAtRims(told);
    for (std::size_t i = 0; i < m_Balls.Count(); ++i)
    {
      const double wanted = (thin[i] > 0 ? thin[i] / 2 : told(i)) - m_Balls.radius[i];
      const double growth = std::clamp(wanted, -m_Balls.radius[i] / 2, m_Longest);
      m_Balls.radius[i] += growth;
      m_Balls.value[i] += growth;
    }
  }

private:
  /** Per vertex. Within sheets a plate's voxels have no gaps. */
  template <typename TRadius>
  std::vector<double>
  ThinPlatesAtRims(TRadius radiusOf) const
  {
    const ThinPlates    plates(m_Shape, m_Weights);
    std::vector<double> found(m_Balls.Count(), 0);
    RunInParts(found.size() > 1000, found.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        found[i] = IsSide(static_cast<ElementIndex>(i)) ? 0.0 : plates.ThicknessAt(m_Balls.centres[i], radiusOf(i));
      }
    });
    return found;
  }

  Cube
  CubeOf(const Vector3 & place) const
  {
    Cube cube{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cube[axis] = static_cast<std::int32_t>(std::floor(place[axis] * m_Sides[axis] / m_Cube));
    }
    return cube;
  }

  /** Of parts of the scan in their order, so that sums are always the same. */
  Squares
  SumSquares() const
  {
    const std::int32_t   height = m_Shape.Box().size[2] + 1;
    const auto           parts = static_cast<std::size_t>((height + kLayers - 1) / kLayers);
    std::vector<Squares> found(parts);
    RunEach(parts, [&](std::size_t part) {
      const auto first = static_cast<std::int32_t>(part) * kLayers;
      for (std::int32_t z = first; z < std::min(first + kLayers, height); ++z)
      {
        AddLayer(z, found[part]);
      }
    });
    Squares all;
    for (Squares & part : found)
    {
      for (const auto & [cube, equations] : part.cubes)
      {
        all.cubes[cube].Add(equations, 1);
      }
      for (const auto & [vertex, sums] : part.round)
      {
        all.round[vertex].Add(sums, 1);
      }
      part = {};
    }
    return all;
  }

  void
  AddLayer(std::int32_t z, Squares & squares) const
  {
    std::size_t likely = 0;
    for (std::int32_t y = 0; y <= m_Shape.Box().size[1]; ++y)
    {
      const auto    here = m_Shape.RowAnywhere(y, z);
      const auto    before = m_Shape.RowAnywhere(y - 1, z);
      const auto    below = m_Shape.RowAnywhere(y, z - 1);
      std::uint64_t carry = 0;
      const auto    add = [&](std::size_t axis, std::uint64_t changes, std::uint64_t in, std::size_t word) {
        for (; changes != 0; changes &= changes - 1)
        {
          const auto bit = static_cast<unsigned>(std::countr_zero(changes));
          AddSquare(axis, { static_cast<std::int32_t>(64 * word + bit), y, z }, (in >> bit & 1U) != 0, likely, squares);
        }
      };
      for (std::size_t word = 0; word < m_Shape.WordsPerRow(); ++word)
      {
        add(0, here[word] ^ (here[word] << 1U | carry), here[word], word);
        add(1, here[word] ^ before[word], here[word], word);
        add(2, here[word] ^ below[word], here[word], word);
        carry = here[word] >> 63U;
      }
      add(0, carry, 0, m_Shape.WordsPerRow());
    }
  }

  /** The square before a voxel along an axis; the voxel is in, or that before it is. */
  void
  AddSquare(std::size_t axis, const Cube & voxel, bool isIn, std::size_t & likely, Squares & squares) const
  {
    Vector3 middle{};
    for (std::size_t a = 0; a < 3; ++a)
    {
      middle[a] = m_Shape.Box().lower[a] + voxel[a] + (a == axis ? 0.0 : 0.5);
    }
    const NearestBall ball = m_Envelope.Find(middle, likely);
    const double      area = (isIn ? -1 : 1) * m_Sides[(axis + 1) % 3] * m_Sides[(axis + 2) % 3];
    squares.cubes[CubeOf(m_Balls.centres[ball.vertex])].AddSquare(ball.way,
                                                                  ball.gap,
                                                                  area * ball.way[axis] *
                                                                    (IsSide(ball.vertex) ? 1.0 : kRim));
    if (m_Bends[ball.vertex] != 0)
    {
      AddPieces(axis, middle, ball.distance, area, likely, squares.round);
    }
  }

  bool
  IsSide(ElementIndex vertex) const
  {
    return m_Bends[vertex] == 0 && m_Rims[vertex] == 0;
  }

  /** Ways change across squares as near as these. */
  void
  AddPieces(std::size_t     axis,
            const Vector3 & middle,
            double          distance,
            double          area,
            std::size_t &   likely,
            RoundParts &    round) const
  {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const double      piece = std::max(kPiece * distance, kLeastPiece * m_Shortest);
    const auto        countU = static_cast<int>(std::ceil(m_Sides[u] / piece));
    const auto        countV = static_cast<int>(std::ceil(m_Sides[v] / piece));
    for (int i = 0; i < countU; ++i)
    {
      for (int j = 0; j < countV; ++j)
      {
        Vector3 place = middle;
        place[u] += (i + 0.5) / countU - 0.5;
        place[v] += (j + 0.5) / countV - 0.5;
        const NearestBall ball = m_Envelope.Find(place, likely);
        if (const int bends = m_Bends[ball.vertex]; bends != 0)
        {
          const double across = area / (countU * countV) * ball.way[axis] * (m_Rims[ball.vertex] != 0 ? kRim : 1.0);
          round[ball.vertex].AddSquare(across, std::max(ball.distance, piece / 2), bends);
        }
      }
    }
  }

  static double
  GrowthAt(const Cubes & all, const Cube & cube)
  {
    GrowthEquations about;
    for (std::int32_t z = 1 - kReach; z < kReach; ++z)
    {
      for (std::int32_t y = 1 - kReach; y < kReach; ++y)
      {
        for (std::int32_t x = 1 - kReach; x < kReach; ++x)
        {
          const double left = 1 - static_cast<double>(x * x + y * y + z * z) / (kReach * kReach);
          const auto   at = all.find({ cube[0] + x, cube[1] + y, cube[2] + z });
          if (left > 0 && at != all.end())
          {
            about.Add(at->second, left * left);
          }
        }
      }
    }
    return about.Growth();
  }

  const VoxelShape &        m_Shape;
  const SpacingWeights &    m_Weights;
  PaintingBalls &           m_Balls;
  const CellComplex &       m_Cells;
  std::vector<std::uint8_t> m_Rims;
  std::vector<std::uint8_t> m_Bends;
  std::vector<Vector3>      m_Places; ///< of centres, mm
  BallEnvelope              m_Envelope;
  Vector3                   m_Sides{}; ///< mm a lattice unit
  double                    m_Longest = 0;
  double                    m_Shortest = 0;
  double                    m_Cube = 0; ///< side of a cube, mm
};

} // namespace

void
FitBalls(const VoxelShape &       shape,
         const SpacingWeights &   weights,
         const CellComplex &      cells,
         PaintingBalls &          balls,
         const ProgressCallback & progress)
{
  ReportProgress(progress, "thickness", 0);
  if (balls.Count() > 0)
  {
    std::vector<Vector3> centres = Straightened(cells, balls.centres, kStraightenings);
    balls.centres.swap(centres);
    Fitter(shape, weights, cells, balls).Fit(progress);
    balls.centres.swap(centres);
  }
}

} // namespace voxelcore
