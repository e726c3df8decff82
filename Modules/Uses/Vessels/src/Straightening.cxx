#include "voxelcore/Vessels/Straightening.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/PolynomialFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double      kWindowInRadii = 2; // to each side; what is thick zigzags in proportion
constexpr double      kLeastWindow = 6;   // in sides of the cube with a voxel's diagonal, as FitBranches() has it
constexpr std::size_t kDegree = 3;
constexpr double      kDense = 0.25; // between places that the fit is of, in sides
constexpr double      kTurn = 0.5;   // between places that directions are carried along, in sides
constexpr double      kBend = 1;     // to each side, over which curvature is measured, in sides
constexpr double      kSlack = 1e-9; // of the distance of planes
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

using BranchEnds = std::array<ElementIndex, 2>;

/** Points of a line with how far along it they are. */
struct Line
{
  std::vector<Vector3> places;
  std::vector<double>  radius;
  std::vector<double>  arc;

  void
  Add(const Vector3 & place, double wide)
  {
    arc.push_back(places.empty() ? 0 : arc.back() + Distance(places.back(), place));
    places.push_back(place);
    radius.push_back(wide);
  }

  /** The last of its pieces that begins before a length. */
  std::size_t
  PieceAt(double along) const
  {
    const auto after = ranges::lower_bound(arc, along) - arc.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(arc) - 1)) - 1;
  }

  std::pair<Vector3, double>
  At(double along) const
  {
    const std::size_t i = PieceAt(along);
    const double      gap = arc[i + 1] - arc[i];
    const double      t = gap > 0 ? std::clamp((along - arc[i]) / gap, 0.0, 1.0) : 0;
    return { AddScaled(places[i], t, Minus(places[i + 1], places[i])), (1 - t) * radius[i] + t * radius[i + 1] };
  }
};

Line
LineOf(const SkeletonGraph & graph, ElementIndex branch)
{
  Line line;
  for (const ElementIndex point : graph.Branch(branch))
  {
    line.Add(graph.positions[point], SectionRadii(graph)[point]);
  }
  return line;
}

Line
LineOf(const SkeletonWay & way)
{
  Line line;
  for (std::size_t i = 0; i < way.places.size(); ++i)
  {
    line.Add(way.places[i], way.radius[i]);
  }
  return line;
}

/** Adds a part of a branch, from one length along it to another, that may be less. */
void
Append(SkeletonWay & way, const Line & line, ElementIndex branch, double from, double to)
{
  const auto add = [&](const std::pair<Vector3, double> & at) {
    if (way.places.empty() || way.places.back() != at.first)
    {
      way.places.push_back(at.first);
      way.radius.push_back(at.second);
      way.branches.push_back(branch);
    }
  };
  add(line.At(from));
  const auto within = [&](std::size_t i) {
    return line.arc[i] > std::min(from, to) && line.arc[i] < std::max(from, to);
  };
  for (std::size_t k = 0; k < line.arc.size(); ++k)
  {
    const std::size_t i = from < to ? k : line.arc.size() - 1 - k;
    if (within(i))
    {
      add({ line.places[i], line.radius[i] });
    }
  }
  add(line.At(to));
}

void
RequireLength(const SkeletonWay & way)
{
  if (way.places.size() < 2)
  {
    throw UsageError("the way has no length; choose another branch, or ends that differ");
  }
}

/** A place on a branch. */
struct OnBranch
{
  ElementIndex branch = kNoBranch;
  double       arc = 0;
};

OnBranch
NearestOn(const std::vector<Line> & lines, const Vector3 & place)
{
  OnBranch nearest;
  double   least = std::numeric_limits<double>::infinity();
  for (std::size_t branch = 0; branch < lines.size(); ++branch)
  {
    const Line & line = lines[branch];
    for (std::size_t i = 1; i < line.places.size(); ++i)
    {
      const Vector3 way = Minus(line.places[i], line.places[i - 1]);
      const double  square = Dot(way, way);
      const double  t = square > 0 ? std::clamp(Dot(Minus(place, line.places[i - 1]), way) / square, 0.0, 1.0) : 0;
      const double  distance = Distance(place, AddScaled(line.places[i - 1], t, way));
      if (distance < least)
      {
        least = distance;
        nearest = { static_cast<ElementIndex>(branch), line.arc[i - 1] + t * (line.arc[i] - line.arc[i - 1]) };
      }
    }
  }
  return nearest;
}

/** A part of a branch, between nodes or places. */
struct Piece
{
  std::array<std::size_t, 2> ends{}; ///< nodes; after these the places
  ElementIndex               branch = 0;
  std::array<double, 2>      arcs{};

  double
  Length() const
  {
    return arcs[1] - arcs[0];
  }
};

/** All branches, cut at places that lie on them. */
std::vector<Piece>
PiecesBetween(const SkeletonGraph & graph, const std::vector<Line> & lines, std::span<const OnBranch> places)
{
  std::vector<Piece> pieces;
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    std::vector<std::pair<double, std::size_t>> cuts;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (places[i].branch == branch)
      {
        cuts.emplace_back(places[i].arc, graph.nodePoints.size() + i);
      }
    }
    ranges::sort(cuts);
    cuts.emplace_back(lines[branch].arc.back(), graph.branchNodes[branch][1]);
    std::pair<double, std::size_t> from(0, graph.branchNodes[branch][0]);
    for (const auto & to : cuts)
    {
      pieces.push_back({ { from.second, to.second }, branch, { from.first, to.first } });
      from = to;
    }
  }
  return pieces;
}

/** Per vertex the piece by which the shortest way from one of them comes (Dijkstra 1959); none where none does. */
std::vector<std::size_t>
ShortestWays(const std::vector<Piece> & pieces, std::size_t vertices, std::size_t from)
{
  std::vector<std::vector<std::size_t>> at(vertices);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    at[pieces[i].ends[0]].push_back(i);
    at[pieces[i].ends[1]].push_back(i);
  }
  std::vector<std::size_t> into(vertices, kNone);
  std::vector<double>      length(vertices, std::numeric_limits<double>::infinity());
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  length[from] = 0;
  next.emplace(0, from);
  while (!next.empty())
  {
    const auto [way, vertex] = next.top();
    next.pop();
    if (way > length[vertex])
    {
      continue;
    }
    for (const std::size_t i : at[vertex])
    {
      const std::size_t other = pieces[i].ends[pieces[i].ends[0] == vertex ? 1 : 0];
      if (way + pieces[i].Length() < length[other])
      {
        length[other] = way + pieces[i].Length();
        into[other] = i;
        next.emplace(length[other], other);
      }
    }
  }
  return into;
}

Vector3
Unit(const Vector3 & way)
{
  return AddScaled({}, 1 / Length(way), way);
}

/** A way's places a quarter of a voxel apart, and the curve that is fitted to them. */
class SmoothCurve
{
public:
  SmoothCurve(const SkeletonWay & way, double side)
    : m_IsClosed(way.isClosed)
    , m_LeastWindow(kLeastWindow * side)
  {
    const Line line = LineOf(way);
    m_Length = line.arc.back();
    m_Count = static_cast<std::size_t>(std::max(8.0, std::ceil(m_Length / (kDense * side))));
    for (std::size_t i = 0; i <= m_Count; ++i)
    {
      const auto at = line.At(Parameter(i));
      m_Places.Add(at.first, at.second);
    }
  }

  std::size_t
  Count() const
  {
    return m_Count;
  }

  /** Lengths along the way, not along the curve. */
  double
  Parameter(std::size_t i) const
  {
    return m_Length * static_cast<double>(i) / static_cast<double>(m_Count);
  }

  Vector3
  At(double along) const
  {
    const double  radius = RadiusAt(along);
    const double  most = m_IsClosed ? 0.25 * m_Length : m_Length;
    const double  window = std::min(most, std::max(m_LeastWindow, kWindowInRadii * radius));
    const double  step = m_Length / static_cast<double>(m_Count);
    const auto    count = static_cast<std::int64_t>(m_Count);
    auto          first = static_cast<std::int64_t>(std::ceil((along - window) / step));
    auto          last = static_cast<std::int64_t>(std::floor((along + window) / step));
    const Vector3 base = m_Places.At(std::clamp(along, 0.0, m_Length)).first;
    if (!m_IsClosed)
    {
      first = std::max<std::int64_t>(first, 0);
      last = std::min(last, count);
    }
    PolynomialFit fit;
    for (std::int64_t i = first; i <= last; ++i)
    {
      const double u = (static_cast<double>(i) * step - along) / window;
      const double near = std::max(0.0, 1 - u * u);
      // The last place of a closed way is its first.
      const auto place = static_cast<std::size_t>(m_IsClosed ? (i % count + count) % count : i);
      fit.Add(u, near * near, Minus(m_Places.places[place], base));
    }
    Vector3 value{};
    double  leverage = 0;
    return fit.Value(kDegree, value, leverage) ? AddScaled(base, 1, value) : base;
  }

  double
  RadiusAt(double along) const
  {
    return m_Places.At(std::clamp(along, 0.0, m_Length)).second;
  }

private:
  bool        m_IsClosed;
  double      m_LeastWindow;
  double      m_Length = 0;
  std::size_t m_Count = 0;
  Line        m_Places;
};

/** Directions across a curve carried on to the next of its places, by two reflections: in the plane halfway between the
 *  places, and in that halfway between the directions of the curve. */
Vector3
CarriedOn(const Vector3 & across, const AxisPlane & from, const AxisPlane & to)
{
  const auto mirrored = [](const Vector3 & one, const Vector3 & normal) {
    const double square = Dot(normal, normal);
    return square > 0 ? AddScaled(one, -2 * Dot(normal, one) / square, normal) : one;
  };
  const Vector3 way = Minus(to.place, from.place);
  const Vector3 bend = Minus(to.along, mirrored(from.along, way));
  const Vector3 carried = mirrored(mirrored(across, way), bend);
  return Unit(AddScaled(carried, -Dot(carried, to.along), to.along)); // rounding must not add up
}

/** Where and how a plane lies at a length along the axis, between and beyond those that are given. */
AxisPlane
PlaneAt(std::span<const AxisPlane> planes, std::size_t i, double t)
{
  const AxisPlane & a = planes[i];
  const AxisPlane & b = planes[i + 1];
  AxisPlane         plane = a;
  plane.arc = (1 - t) * a.arc + t * b.arc;
  plane.place = AddScaled(a.place, t, Minus(b.place, a.place));
  plane.across = AddScaled(a.across, t, Minus(b.across, a.across));
  plane.up = AddScaled(a.up, t, Minus(b.up, a.up));
  return plane;
}

/** Coordinates in a plane. */
std::array<double, 2>
InPlane(const AxisPlane & plane, const Vector3 & place)
{
  const Vector3 way = Minus(place, plane.place);
  const double  aa = Dot(plane.across, plane.across);
  const double  ab = Dot(plane.across, plane.up);
  const double  bb = Dot(plane.up, plane.up);
  const double  a = Dot(way, plane.across);
  const double  b = Dot(way, plane.up);
  const double  determinant = aa * bb - ab * ab;
  return { (a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant };
}

double
Beyond(const AxisPlane & plane, const Vector3 & place)
{
  return Dot(Minus(place, plane.place), Cross(plane.across, plane.up));
}

/** A place in a plane in indices of the scan's voxels, their middles being whole numbers. */
struct IndexPlane
{
  Vector3 origin{};
  Vector3 across{};
  Vector3 up{};

  IndexPlane(const AxisPlane & plane, const PlaneGrid & grid, const ImageGeometry & geometry)
  {
    const auto index = [&](const Vector3 & place) {
      return AddScaled(PhysicalToLattice(geometry, place), -0.5, { 1, 1, 1 });
    };
    origin = index(plane.place);
    across = Minus(index(AddScaled(plane.place, grid.spacing[0], plane.across)), origin);
    up = Minus(index(AddScaled(plane.place, grid.spacing[1], plane.up)), origin);
  }

  Vector3
  At(std::int32_t a, std::int32_t b) const
  {
    return AddScaled(AddScaled(origin, a, across), b, up);
  }
};

} // namespace

SkeletonWay
WayAlong(const SkeletonGraph & graph, std::span<const ElementIndex> branches)
{
  for (const ElementIndex branch : branches)
  {
    if (branch >= graph.BranchCount())
    {
      throw UsageError(Text("there is no branch ", branch, "; they are 0 to ", graph.BranchCount() - 1));
    }
  }
  const auto   endsOf = [&](std::size_t i) { return graph.branchNodes[branches[i]]; };
  const auto   has = [](const BranchEnds & ends, ElementIndex node) { return ends[0] == node || ends[1] == node; };
  const bool   turned = branches.size() > 1 && !has(endsOf(1), endsOf(0)[1]);
  SkeletonWay  way;
  ElementIndex at = branches.empty() ? 0 : endsOf(0)[turned ? 1 : 0];
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    if (!has(endsOf(i), at))
    {
      throw UsageError(
        Text("branch ", branches[i], " does not begin where branch ", branches[i - 1], " ends; give them in a row"));
    }
    const Line line = LineOf(graph, branches[i]);
    const bool isForward = endsOf(i)[0] == at;
    Append(way, line, branches[i], isForward ? 0 : line.arc.back(), isForward ? line.arc.back() : 0);
    at = endsOf(i)[isForward ? 1 : 0];
  }
  RequireLength(way);
  way.isClosed = way.places.front() == way.places.back();
  return way;
}

SkeletonWay
WayBetween(const SkeletonGraph & graph, const Vector3 & from, const Vector3 & to)
{
  std::vector<Line> lines;
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    lines.push_back(LineOf(graph, branch));
  }
  if (lines.empty())
  {
    throw UsageError("the skeleton has no branches; make it with --prune-branches 0");
  }
  const std::array<OnBranch, 2>             places{ NearestOn(lines, from), NearestOn(lines, to) };
  const std::vector<Piece>                  pieces = PiecesBetween(graph, lines, places);
  const std::size_t                         begin = graph.nodePoints.size();
  const auto                                into = ShortestWays(pieces, begin + 2, begin);
  std::vector<std::pair<std::size_t, bool>> steps; // backwards, with whether the piece is gone forward
  for (std::size_t vertex = begin + 1; vertex != begin;)
  {
    const std::size_t piece = into[vertex];
    if (piece == kNone)
    {
      throw UsageError("no way along branches leads from one point to the other");
    }
    steps.emplace_back(piece, pieces[piece].ends[1] == vertex);
    vertex = pieces[piece].ends[steps.back().second ? 0 : 1];
  }
  SkeletonWay way;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
  {
    const Piece & piece = pieces[step->first];
    const auto [first, last] = piece.arcs;
    Append(way, lines[piece.branch], piece.branch, step->second ? first : last, step->second ? last : first);
  }
  RequireLength(way);
  return way;
}

double
WayLength(const SkeletonWay & way)
{
  return LineOf(way).arc.back();
}

StraightAxis
StraightenWay(const SkeletonWay & way, double side, double step)
{
  const SmoothCurve   curve(way, side);
  std::vector<double> arc{ 0 }; // along the curve
  Vector3             before = curve.At(0);
  for (std::size_t i = 1; i <= curve.Count(); ++i)
  {
    const Vector3 place = curve.At(curve.Parameter(i));
    arc.push_back(arc.back() + Distance(before, place));
    before = place;
  }
  StraightAxis axis;
  axis.length = arc.back();
  const double perArc = curve.Parameter(curve.Count()) / axis.length;
  const auto   parameterAt = [&](double along) {
    const auto   after = ranges::lower_bound(arc, along) - arc.begin();
    const auto   i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(arc) - 1));
    const double t = (along - arc[i - 1]) / (arc[i] - arc[i - 1]);
    return (1 - t) * curve.Parameter(i - 1) + t * curve.Parameter(i);
  };
  const auto planeAt = [&](double along) {
    AxisPlane    plane;
    const double at = parameterAt(along);
    const double small = 0.5 * kDense * side * perArc;
    plane.arc = along;
    plane.place = curve.At(at);
    plane.along = Unit(Minus(curve.At(at + small), curve.At(at - small)));
    plane.radius = curve.RadiusAt(at);
    const double reach = std::min(kBend * side, 0.5 * axis.length) * perArc;
    const double middle =
      way.isClosed ? at : std::clamp(at, reach, std::max(reach, curve.Parameter(curve.Count()) - reach));
    const Vector3 there = curve.At(middle);
    const Vector3 one = Minus(there, curve.At(middle - reach));
    const Vector3 other = Minus(curve.At(middle + reach), there);
    plane.bend = Length(Minus(Unit(other), Unit(one))) / (0.5 * (Length(one) + Length(other)));
    return plane;
  };
  // A last plane that only rounding puts beyond the end is in.
  const auto count = static_cast<std::size_t>(std::floor(axis.length / step + 1e-9)) + 1;
  const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(step / (kTurn * side))));
  AxisPlane  last;
  for (std::size_t i = 0; i < (count - 1) * parts + 1; ++i)
  {
    AxisPlane plane = planeAt(std::min(axis.length, step * static_cast<double>(i) / static_cast<double>(parts)));
    if (i == 0)
    {
      std::size_t farthest = 0;
      for (std::size_t k = 1; k < 3; ++k)
      {
        farthest = std::abs(plane.along[k]) < std::abs(plane.along[farthest]) ? k : farthest;
      }
      Vector3 direction{};
      direction[farthest] = 1;
      plane.across = Unit(AddScaled(direction, -plane.along[farthest], plane.along));
    }
    else
    {
      plane.across = CarriedOn(last.across, last, plane);
    }
    plane.up = Cross(plane.along, plane.across);
    last = plane;
    if (i % parts == 0)
    {
      axis.planes.push_back(plane);
    }
  }
  // Branches are those of the way at the same share of its length, which smoothing changes little.
  const std::vector<double> wayArc = LineOf(way).arc;
  for (AxisPlane & plane : axis.planes)
  {
    const auto i = ranges::lower_bound(wayArc, parameterAt(plane.arc)) - wayArc.begin();
    plane.branch = way.branches[static_cast<std::size_t>(std::min<std::ptrdiff_t>(i, std::ssize(wayArc) - 1))];
  }
  return axis;
}

Vector3
FromStraight(std::span<const AxisPlane> planes, const Vector3 & straight)
{
  if (planes.size() < 2)
  {
    return AddScaled(AddScaled(planes[0].place, straight[0], planes[0].across), straight[1], planes[0].up);
  }
  const auto      after = ranges::lower_bound(planes, straight[2], {}, &AxisPlane::arc) - planes.begin();
  const auto      i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(planes) - 1)) - 1;
  const AxisPlane plane = PlaneAt(planes, i, (straight[2] - planes[i].arc) / (planes[i + 1].arc - planes[i].arc));
  return AddScaled(AddScaled(plane.place, straight[0], plane.across), straight[1], plane.up);
}

std::optional<Vector3>
ToStraight(std::span<const AxisPlane> planes, const Vector3 & place)
{
  std::optional<Vector3> nearest;
  double                 least = std::numeric_limits<double>::infinity();
  // What lies in the first or the last plane is not lost to rounding.
  const auto beyond = [&](std::size_t i) {
    const std::size_t last = planes.size() - 1;
    return Beyond(i == 0      ? PlaneAt(planes, 0, -kSlack)
                  : i == last ? PlaneAt(planes, last - 1, 1 + kSlack)
                              : planes[i],
                  place);
  };
  for (std::size_t i = 0; i + 1 < planes.size(); ++i)
  {
    const double before = beyond(i);
    if (before * beyond(i + 1) > 0)
    {
      continue;
    }
    double        low = -kSlack;
    double        high = 1 + kSlack;
    constexpr int kSteps = 60;
    for (int step = 0; step < kSteps; ++step)
    {
      const double middle = 0.5 * (low + high);
      (Beyond(PlaneAt(planes, i, middle), place) * before > 0 ? low : high) = middle;
    }
    const AxisPlane plane = PlaneAt(planes, i, high);
    const auto [a, b] = InPlane(plane, place);
    if (a * a + b * b < least)
    {
      least = a * a + b * b;
      nearest = { a, b, plane.arc };
    }
  }
  return nearest;
}

VoxelBox
VoxelsAt(std::span<const AxisPlane> planes, const PlaneGrid & grid, const ImageGeometry & geometry)
{
  Vector3 lower{};
  Vector3 upper{};
  lower.fill(std::numeric_limits<double>::infinity());
  upper.fill(-std::numeric_limits<double>::infinity());
  for (const AxisPlane & one : planes)
  {
    const IndexPlane plane(one, grid, geometry);
    for (const std::int32_t a : { -grid.half[0], grid.half[0] })
    {
      for (const std::int32_t b : { -grid.half[1], grid.half[1] })
      {
        const Vector3 corner = plane.At(a, b);
        for (std::size_t k = 0; k < 3; ++k)
        {
          lower[k] = std::min(lower[k], corner[k]);
          upper[k] = std::max(upper[k], corner[k]);
        }
      }
    }
  }
  VoxelBox box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto   size = static_cast<double>(geometry.size[k]);
    const double first = std::clamp(std::floor(lower[k]) - 1, 0.0, size);
    const double end = std::clamp(std::floor(upper[k]) + 3, 0.0, size);
    box.lower[k] = static_cast<std::int32_t>(first);
    box.size[k] = static_cast<std::int32_t>(std::max(0.0, end - first));
  }
  return ranges::count(box.size, 0) > 0 ? VoxelBox() : box;
}

void
SamplePlane(const AxisPlane & plane,
            const PlaneGrid & grid,
            const ScanPart &  scan,
            bool              isLinear,
            float             outside,
            std::span<float>  values)
{
  const IndexPlane indices(plane, grid, scan.geometry);
  const auto       sizeX = static_cast<std::size_t>(scan.box.size[0]);
  const auto       sizeXY = sizeX * static_cast<std::size_t>(scan.box.size[1]);
  std::size_t      at = 0;
  for (std::int32_t b = -grid.half[1]; b <= grid.half[1]; ++b)
  {
    for (std::int32_t a = -grid.half[0]; a <= grid.half[0]; ++a, ++at)
    {
      const Vector3              index = indices.At(a, b);
      std::array<std::size_t, 3> first{};
      std::array<std::size_t, 3> second{};
      Vector3                    part{};
      bool                       isIn = true;
      for (std::size_t k = 0; k < 3 && isIn; ++k)
      {
        const auto last = static_cast<double>(scan.geometry.size[k] - 1);
        isIn = index[k] >= -0.5 && index[k] <= last + 0.5;
        const double inside = std::clamp(isLinear ? index[k] : std::floor(index[k] + 0.5), 0.0, last);
        const double low = std::floor(inside);
        part[k] = inside - low;
        first[k] = static_cast<std::size_t>(static_cast<std::int32_t>(isIn ? low : 0) - scan.box.lower[k]);
        second[k] = first[k] + (part[k] > 0 ? 1 : 0);
      }
      if (!isIn)
      {
        values[at] = outside;
        continue;
      }
      const auto row = [&](std::size_t y, std::size_t z) {
        const float * const from = scan.values.data() + z * sizeXY + y * sizeX;
        return (1 - part[0]) * from[first[0]] + part[0] * from[second[0]];
      };
      const auto layer = [&](std::size_t z) { return (1 - part[1]) * row(first[1], z) + part[1] * row(second[1], z); };
      values[at] = static_cast<float>((1 - part[2]) * layer(first[2]) + part[2] * layer(second[2]));
    }
  }
}

} // namespace voxelcore
