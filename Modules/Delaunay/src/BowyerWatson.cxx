#include "BowyerWatson.h"

#include "InsertionComplex.h"
#include "InsertionOrder.h"
#include "SharedProgress.h"

#include "voxelcore/Error.h"
#include "voxelcore/ParallelTasks.h"

#include <omp.h>

#include <algorithm>
#include <functional>

namespace voxelcore
{

namespace
{

constexpr std::size_t worthAThread = 2000; // points

// The first points that span space, in positive orientation.
template <typename TNumber>
std::array<std::uint32_t, 4>
FirstTetrahedron(const PointPredicates<TNumber> & points)
{
  const auto count = static_cast<std::uint32_t>(points.Size());
  for (std::uint32_t c = 2; c < count; ++c)
  {
    const LatticePoint & o = points[0];
    const LatticePoint & a = points[1];
    const LatticePoint & b = points[c];
    const std::int64_t   ux = a.x - o.x, uy = a.y - o.y, uz = a.z - o.z;
    const std::int64_t   vx = b.x - o.x, vy = b.y - o.y, vz = b.z - o.z;
    if (uy * vz == uz * vy && uz * vx == ux * vz && ux * vy == uy * vx)
    {
      continue;
    }
    for (std::uint32_t d = 2; d < count; ++d)
    {
      const TNumber side = points.Orient(0, 1, c, d);
      if (side != 0)
      {
        return side > 0 ? std::array<std::uint32_t, 4>{ 0, 1, c, d } : std::array<std::uint32_t, 4>{ 1, 0, c, d };
      }
    }
    break;
  }
  throw Error("the points of a Delaunay tetrahedralization lie in one plane; please report this input");
}

// Cuts the points into slabs along their longest side, with about the same number each.
std::vector<std::uint8_t>
CutIntoSlabs(const std::vector<LatticePoint> & points, std::size_t slabs)
{
  const auto coordinate = [](const LatticePoint & p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; };
  std::vector<std::int32_t> sorted(points.size());
  int                       longest = 0;
  std::int64_t              length = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), [&](const auto & a, const auto & b) {
      return coordinate(a, axis) < coordinate(b, axis);
    });
    const std::int64_t own = std::int64_t{ coordinate(*high, axis) } - coordinate(*low, axis);
    if (own > length)
    {
      length = own;
      longest = axis;
    }
  }
  std::transform(points.begin(), points.end(), sorted.begin(), [&](const auto & p) { return coordinate(p, longest); });
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::int32_t> cuts; // the first coordinate of each slab but the first
  for (std::size_t slab = 1; slab < slabs; ++slab)
  {
    cuts.push_back(sorted[sorted.size() * slab / slabs]);
  }
  std::vector<std::uint8_t> slabOf(points.size());
  std::transform(points.begin(), points.end(), slabOf.begin(), [&](const auto & p) {
    return static_cast<std::uint8_t>(std::upper_bound(cuts.begin(), cuts.end(), coordinate(p, longest)) - cuts.begin());
  });
  return slabOf;
}

template <typename TNumber>
class Insertion
{
public:
  Insertion(std::vector<LatticePoint> points, const SpacingWeights & weights, const ProgressCallback & progress)
    : m_Complex(std::move(points), weights)
    , m_Progress(progress)
    , m_Count(static_cast<std::uint32_t>(m_Complex.Points().Size()))
    , m_First(FirstTetrahedron(m_Complex.Points()))
  {
    m_Complex.Start(m_First);
  }

  // Adds points first .. last - 1.
  void
  AddAlone(std::uint32_t first, std::uint32_t last)
  {
    for (std::uint32_t p = first; p < last; ++p)
    {
      if ((p & 0x3FFFU) == 0)
      {
        ReportProgress(m_Progress, "delaunay", static_cast<double>(p) / m_Count);
      }
      if (!IsFirst(p))
      {
        m_Complex.Insert(m_Alone, p);
      }
    }
  }

  // Adds the points from `first` on side by side, each thread those of a slab; points whose cavity reaches out of it
  // are returned in order.
  std::vector<std::uint32_t>
  AddSideBySide(std::uint32_t first, const std::vector<std::uint8_t> & slabOf, std::size_t slabs)
  {
    m_Complex.Divide(slabOf);
    // Tetrahedra a point are about as many all the time; who runs out of places leaves points over.
    const double                            perPoint = 1.25 * static_cast<double>(m_Complex.Size()) / first;
    std::vector<Inserter>                   workers(slabs);
    std::vector<std::vector<std::uint32_t>> left(slabs);
    for (std::size_t slab = 0; slab < slabs; ++slab)
    {
      const auto own = static_cast<std::uint8_t>(slab);
      const auto points = std::count(slabOf.begin() + first, slabOf.end(), own);
      const auto places = static_cast<std::size_t>(perPoint * static_cast<double>(points));
      workers[slab].owner = own;
      workers[slab].last = m_Complex.FindOwn(own);
      workers[slab].next = m_Complex.AddPlaces(places);
      workers[slab].end = workers[slab].next + static_cast<std::uint32_t>(places);
    }
    SharedProgress shared(m_Progress);
    RunInParts(true, slabs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t slab = begin; slab < end; ++slab)
      {
        Inserter & worker = workers[slab];
        for (std::uint32_t p = first; p < m_Count; ++p)
        {
          if ((p & 0x3FFFU) == 0)
          {
            ReportProgress(std::ref(shared), "delaunay", static_cast<double>(p) / m_Count);
          }
          if (slabOf[p] == worker.owner && !IsFirst(p) && (worker.last == none || !m_Complex.Insert(worker, p)))
          {
            left[slab].push_back(p);
          }
        }
      }
    });
    std::vector<std::uint32_t> rest;
    for (std::size_t slab = 0; slab < slabs; ++slab)
    {
      Inserter & worker = workers[slab];
      rest.insert(rest.end(), left[slab].begin(), left[slab].end());
      m_Alone.free.insert(m_Alone.free.end(), worker.free.begin(), worker.free.end());
      for (; worker.next < worker.end; ++worker.next)
      {
        m_Alone.free.push_back(worker.next);
      }
      if (!worker.places.empty()) // it has added points, and what the others left of the last place is not known
      {
        m_Alone.last = worker.last;
      }
    }
    std::sort(rest.begin(), rest.end());
    return rest;
  }

  void
  AddRest(const std::vector<std::uint32_t> & rest)
  {
    for (std::size_t i = 0; i < rest.size(); ++i)
    {
      if ((i & 0x3FFFU) == 0)
      {
        ReportProgress(m_Progress, "delaunay", 1.0 - static_cast<double>(rest.size() - i) / m_Count);
      }
      m_Complex.Insert(m_Alone, rest[i]);
    }
  }

  // Finite tetrahedra, with corners renamed by `names`.
  Tetrahedra
  Finish(const std::vector<std::uint32_t> & names) const
  {
    std::vector<std::uint32_t> number(m_Complex.Size(), kOutside);
    std::uint32_t              count = 0;
    for (std::size_t t = 0; t < m_Complex.Size(); ++t)
    {
      if (m_Complex.IsFinite(t))
      {
        number[t] = count++;
      }
    }
    Tetrahedra result;
    result.corners.reserve(count);
    result.neighbours.reserve(count);
    for (std::size_t t = 0; t < m_Complex.Size(); ++t)
    {
      if (number[t] != kOutside)
      {
        const auto & [v, n] = m_Complex[t];
        result.corners.push_back({ names[v[0]], names[v[1]], names[v[2]], names[v[3]] });
        result.neighbours.push_back({ number[n[0]], number[n[1]], number[n[2]], number[n[3]] });
      }
    }
    return result;
  }

private:
  using Inserter = typename InsertionComplex<TNumber>::Inserter;
  static constexpr std::uint32_t none = InsertionComplex<TNumber>::none;

  bool
  IsFirst(std::uint32_t p) const
  {
    return std::find(m_First.begin(), m_First.end(), p) != m_First.end();
  }

  InsertionComplex<TNumber>    m_Complex;
  const ProgressCallback &     m_Progress;
  std::uint32_t                m_Count;
  std::array<std::uint32_t, 4> m_First;
  Inserter                     m_Alone;
};

template <typename TNumber>
Tetrahedra
Run(const std::vector<LatticePoint> & points,
    const SpacingWeights &            weights,
    const Meanwhile &                 meanwhile,
    const ProgressCallback &          progress)
{
  const std::vector<std::uint32_t> order = InsertionOrder(points);
  std::vector<LatticePoint>        sorted(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    sorted[i] = points[order[i]];
  }
  const auto                      count = static_cast<std::uint32_t>(points.size());
  const std::size_t               slabs = std::clamp<std::size_t>(points.size() / worthAThread,
                                                    1,
                                                    static_cast<std::size_t>(std::min(omp_get_max_threads(), 200)));
  const std::vector<std::uint8_t> slabOf = slabs > 1 ? CutIntoSlabs(sorted, slabs) : std::vector<std::uint8_t>();
  Insertion<TNumber>              insertion(std::move(sorted), weights, progress);
  // Among few points tetrahedra are long, and most of them reach from one slab to the next.
  const std::uint32_t alone = slabs > 1 ? count / 8 : count;
  insertion.AddAlone(0, alone);
  const std::vector<std::uint32_t> rest =
    slabs > 1 ? insertion.AddSideBySide(alone, slabOf, slabs) : std::vector<std::uint32_t>();
  Tetrahedra result;
  RunBoth(
    true,
    [&] {
      insertion.AddRest(rest);
      result = insertion.Finish(order);
    },
    [&] { meanwhile(slabs > 1 ? rest.size() : count); });
  return result;
}

} // namespace

Tetrahedra
BowyerWatson(const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const Meanwhile &                 meanwhile,
             const ProgressCallback &          progress)
{
  return FitsSmallIntegers(points, weights) ? Run<std::int64_t>(points, weights, meanwhile, progress)
                                            : Run<__int128>(points, weights, meanwhile, progress);
}

} // namespace voxelcore
