#include "MeshSurface.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <string>

namespace voxelcore
{
namespace
{

using Triangle = std::array<std::uint32_t, 3>;

/** For each point the first that is equal. */
std::vector<std::uint32_t>
WeldPoints(const std::vector<Vector3> & points)
{
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/** One side of one triangle, from the smaller point to the greater or back. */
struct EdgeUse
{
  std::uint32_t from;
  std::uint32_t to;
  std::uint32_t triangle;
  bool          isForward;

  bool
  IsSameEdge(const EdgeUse & other) const
  {
    return from == other.from && to == other.to;
  }
};

std::vector<EdgeUse>
SortedEdges(const std::vector<Triangle> & triangles)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::uint32_t a = triangles[t][c];
      const std::uint32_t b = triangles[t][(c + 1) % 3];
      uses.push_back({ std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b });
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse & a, const EdgeUse & b) {
    return std::array{ a.from, a.to, a.triangle } < std::array{ b.from, b.to, b.triangle };
  });
  return uses;
}

/** Calls visit(begin, end) for the uses of each edge. */
template <typename Visit>
void
ForEachEdge(const std::vector<EdgeUse> & uses, const Visit & visit)
{
  for (std::size_t begin = 0; begin < uses.size();)
  {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].IsSameEdge(uses[begin]))
    {
      ++end;
    }
    visit(begin, end);
    begin = end;
  }
}

struct EdgeCounts
{
  std::uint64_t open = 0;       ///< on an odd number of triangles
  std::uint64_t unbalanced = 0; ///< gone along more often in one direction than in the other
};

EdgeCounts
CountEdges(const std::vector<Triangle> & triangles)
{
  const auto uses = SortedEdges(triangles);
  EdgeCounts counts;
  ForEachEdge(uses, [&](std::size_t begin, std::size_t end) {
    std::int64_t sum = 0;
    for (std::size_t i = begin; i < end; ++i)
    {
      sum += uses[i].isForward ? 1 : -1;
    }
    counts.open += (end - begin) % 2;
    counts.unbalanced += sum != 0 ? 1 : 0;
  });
  return counts;
}

/** Triangles with the same corners become one where they are many, or, with `cancel`, one or none by their number. */
std::vector<Triangle>
WithoutDuplicates(const std::vector<Triangle> & triangles, bool cancel)
{
  const auto sorted = [&](std::uint32_t t) {
    Triangle corners = triangles[t];
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Triangle first = sorted(a);
    const Triangle second = sorted(b);
    return first != second ? first < second : a < b;
  });
  std::vector<std::uint32_t> kept;
  for (std::size_t begin = 0; begin < order.size();)
  {
    std::size_t end = begin + 1;
    while (end < order.size() && sorted(order[end]) == sorted(order[begin]))
    {
      ++end;
    }
    if (!cancel || (end - begin) % 2 != 0)
    {
      kept.push_back(order[begin]);
    }
    begin = end;
  }
  std::sort(kept.begin(), kept.end());
  std::vector<Triangle> result;
  result.reserve(kept.size());
  for (const std::uint32_t t : kept)
  {
    result.push_back(triangles[t]);
  }
  return result;
}

double
AreaOf(const TriangleMesh & mesh, const Triangle & t)
{
  const Vector3 & a = mesh.points[t[0]];
  const Vector3 & b = mesh.points[t[1]];
  const Vector3 & c = mesh.points[t[2]];
  double          squared = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    const double      part = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    squared += part * part;
  }
  return std::sqrt(squared);
}

/** Turns triangles until both at each edge with two of them agree, the smaller area of each piece.
 *  Returns whether that was possible everywhere. */
bool
OrientPieces(const TriangleMesh & mesh, MeshSurface & surface)
{
  auto &     triangles = surface.triangles;
  const auto uses = SortedEdges(triangles);
  struct Link
  {
    std::uint32_t from;
    std::uint32_t to;
    bool          agrees;
  };
  std::vector<Link> links;
  ForEachEdge(uses, [&](std::size_t begin, std::size_t end) {
    if (end - begin == 2)
    {
      const bool agrees = uses[begin].isForward != uses[begin + 1].isForward;
      links.push_back({ uses[begin].triangle, uses[begin + 1].triangle, agrees });
      links.push_back({ uses[begin + 1].triangle, uses[begin].triangle, agrees });
    }
  });
  std::vector<std::size_t> first(triangles.size() + 1, 0);
  std::sort(links.begin(), links.end(), [](const Link & a, const Link & b) { return a.from < b.from; });
  for (const Link & link : links)
  {
    ++first[link.from + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());

  enum class State : std::uint8_t
  {
    Unseen,
    Kept,
    Turned
  };
  std::vector<State>         state(triangles.size(), State::Unseen);
  std::vector<std::uint32_t> piece;
  bool                       isPossible = true;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed)
  {
    if (state[seed] != State::Unseen)
    {
      continue;
    }
    piece.assign(1, static_cast<std::uint32_t>(seed));
    state[seed] = State::Kept;
    for (std::size_t next = 0; next < piece.size(); ++next)
    {
      const std::uint32_t t = piece[next];
      for (std::size_t i = first[t]; i < first[t + 1]; ++i)
      {
        const State wanted = (state[t] == State::Kept) == links[i].agrees ? State::Kept : State::Turned;
        State &     other = state[links[i].to];
        if (other == State::Unseen)
        {
          other = wanted;
          piece.push_back(links[i].to);
        }
        isPossible = isPossible && other == wanted;
      }
    }
    double area[2] = { 0, 0 };
    for (const std::uint32_t t : piece)
    {
      area[state[t] == State::Turned ? 1 : 0] += AreaOf(mesh, triangles[t]);
    }
    const State minority = area[1] > area[0] ? State::Kept : State::Turned;
    for (const std::uint32_t t : piece)
    {
      if (state[t] == minority)
      {
        std::swap(triangles[t][1], triangles[t][2]);
        ++surface.findings.flipped;
      }
    }
  }
  return isPossible;
}

std::uint64_t
CountPieces(const std::vector<Triangle> & triangles)
{
  const auto uses = SortedEdges(triangles);
  UnionFind  sets(triangles.size());
  for (std::size_t i = 1; i < uses.size(); ++i)
  {
    if (uses[i].IsSameEdge(uses[i - 1]))
    {
      sets.Unite(uses[i].triangle, uses[i - 1].triangle);
    }
  }
  std::uint64_t pieces = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    pieces += sets.Find(t) == t ? 1 : 0;
  }
  return pieces;
}

/** Six times the volume, as floating point sees it. */
double
SignedVolume(const TriangleMesh & mesh, const std::vector<Triangle> & triangles)
{
  double          volume = 0;
  const Vector3 & o = mesh.points[triangles.front()[0]];
  for (const Triangle & t : triangles)
  {
    Vector3 p[3];
    for (std::size_t c = 0; c < 3; ++c)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        p[c][axis] = mesh.points[t[c]][axis] - o[axis];
      }
    }
    volume += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
              p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return volume;
}

} // namespace

MeshSurface
PrepareSurface(const TriangleMesh & mesh)
{
  MeshSurface surface;
  surface.findings.triangles = mesh.triangles.size();
  const auto weld = WeldPoints(mesh.points);
  for (const Triangle & given : mesh.triangles)
  {
    const Triangle t{ weld[given[0]], weld[given[1]], weld[given[2]] };
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    {
      ++surface.findings.degenerate;
      continue;
    }
    surface.triangles.push_back(t);
  }
  if (surface.triangles.empty())
  {
    throw InputError("it bounds nothing: no triangle has three corners that differ; write it anew");
  }
  surface.findings.pieces = CountPieces(surface.triangles);

  EdgeCounts counts = CountEdges(surface.triangles);
  if (counts.unbalanced != 0)
  {
    // A triangle that is there twice closes nothing; two that cancel may be a wall between two parts.
    for (const bool cancel : { false, true })
    {
      auto             fewer = WithoutDuplicates(surface.triangles, cancel);
      const EdgeCounts without = CountEdges(fewer);
      if (!fewer.empty() && fewer.size() < surface.triangles.size() && (without.open == 0 || !cancel))
      {
        const bool isBetter =
          without.open < counts.open || (without.open == 0 && without.unbalanced < counts.unbalanced);
        if (isBetter)
        {
          surface.findings.duplicates = mesh.triangles.size() - surface.findings.degenerate - fewer.size();
          surface.triangles = std::move(fewer);
          counts = without;
        }
      }
    }
  }
  if (counts.unbalanced != 0)
  {
    surface.isOriented = OrientPieces(mesh, surface);
    counts = CountEdges(surface.triangles);
  }
  else
  {
    surface.isOriented = true;
  }
  surface.findings.openEdges = counts.open;
  surface.findings.rule = counts.unbalanced == 0 ? InsideRule::Winding
                          : counts.open == 0     ? InsideRule::Parity
                                                 : InsideRule::Votes;
  if (surface.findings.rule == InsideRule::Parity)
  {
    surface.isOriented = false;
  }
  surface.sense = SignedVolume(mesh, surface.triangles) < 0 ? -1 : 1;
  return surface;
}

std::uint64_t
CapHoles(TriangleMesh & mesh)
{
  const auto            weld = WeldPoints(mesh.points);
  std::vector<Triangle> triangles;
  for (const Triangle & t : mesh.triangles)
  {
    triangles.push_back({ weld[t[0]], weld[t[1]], weld[t[2]] });
    if (triangles.back()[0] == triangles.back()[1] || triangles.back()[1] == triangles.back()[2] ||
        triangles.back()[2] == triangles.back()[0])
    {
      triangles.pop_back();
    }
  }
  // Open edges as a cap has them, against their triangle. Each point has an even number of them, so that any walk along
  // them comes back; where it meets itself a hole ends.
  struct OpenEdge
  {
    std::uint32_t from;
    std::uint32_t to;
    bool          isUsed = false;
  };
  std::vector<OpenEdge>                             open;
  std::map<std::uint32_t, std::vector<std::size_t>> around;
  const auto                                        uses = SortedEdges(triangles);
  ForEachEdge(uses, [&](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 != 0)
    {
      const EdgeUse & use = uses[begin];
      around[use.from].push_back(open.size());
      around[use.to].push_back(open.size());
      open.push_back(use.isForward ? OpenEdge{ use.to, use.from } : OpenEdge{ use.from, use.to });
    }
  });
  const auto cap = [&mesh](std::span<const std::uint32_t> loop) {
    Vector3 middle{ 0, 0, 0 };
    for (const std::uint32_t corner : loop)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        middle[axis] += mesh.points[corner][axis] / static_cast<double>(loop.size());
      }
    }
    const auto centre = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(middle);
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      mesh.triangles.push_back({ centre, loop[i], loop[(i + 1) % loop.size()] });
    }
  };
  std::uint64_t holes = 0;
  for (const OpenEdge & first : open)
  {
    std::vector<std::uint32_t> way{ first.from };
    for (;;)
    {
      const std::uint32_t at = way.back();
      const auto &        edges = around[at];
      const auto next = std::find_if(edges.begin(), edges.end(), [&](std::size_t e) { return !open[e].isUsed; });
      if (next == edges.end())
      {
        break; // back where it began
      }
      open[*next].isUsed = true;
      const std::uint32_t to = open[*next].from == at ? open[*next].to : open[*next].from;
      const auto          met = std::find(way.begin(), way.end(), to);
      if (met == way.end())
      {
        way.push_back(to);
        continue;
      }
      cap(std::span(way).subspan(static_cast<std::size_t>(met - way.begin())));
      ++holes;
      way.erase(met + 1, way.end());
    }
  }
  return holes;
}

} // namespace voxelcore
