#include "WholeSheets.h"

#include "RimStrip.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

using Level = RimStrip::Level;

constexpr double kStaircase = 0.8;  ///< voxel diagonals
constexpr double kWide = 0.643;     ///< of the radius
constexpr double kStraight = -0.82; ///< cosine between the directions of two faces away from their edge, at most
constexpr double kTie = 1e-6;       ///< cosines that differ by less are equal: neither is the straightest
constexpr double kTooth = 0.5;      ///< of the way round a face
constexpr int    kQuarters = 3;     ///< of its height, up to which a sheet is whole that is to go

constexpr std::size_t kPart = 8192; ///< faces that a thread takes at a time

bool
IsWide(const MedialComplex & core, ElementIndex face)
{
  const auto corners = core.cells.FaceVertices(face);
  double     sum = 0;
  for (const ElementIndex corner : corners)
  {
    sum += core.radius[corner];
  }
  return core.faceLambda[face] * static_cast<double>(corners.size()) >= kWide * sum;
}

// Away from one of its edges, within the face, of any length.
BallCentre
Away(const CellComplex & cells, const std::vector<CoreBall> & balls, ElementIndex face, ElementIndex edge)
{
  const BallCentre & p = balls[cells.edges[edge][0]].centre;
  const BallCentre & q = balls[cells.edges[edge][1]].centre;
  const auto         corners = cells.FaceVertices(face);
  BallCentre         away{};
  for (const ElementIndex corner : corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      away[axis] += balls[corner].centre[axis] - p[axis];
    }
  }
  const double along = Dot(away, { q[0] - p[0], q[1] - p[1], q[2] - p[2] }) / SquaredDistance(p, q);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    away[axis] -= along * (q[axis] - p[axis]);
  }
  return away;
}

double
Cosine(const BallCentre & a, const BallCentre & b)
{
  return Dot(a, b) / std::sqrt(Dot(a, a) * Dot(b, b));
}

// A face and one of its sheet beside it.
struct Join
{
  ElementIndex from; // of the strip, or what stays
  ElementIndex to;
  double       length; // of their edge, mm
};

// The sheets that a strip belongs to.
class Sheets
{
public:
  Sheets(const MedialComplex & core, const std::vector<CoreBall> & balls, const RimStrip & strip)
    : m_Core(core)
    , m_Balls(balls)
    , m_Strip(strip)
  {
    JoinPairs();
    JoinSeams();
    SortJoins();
  }

  // Of each face that of the last of its sheet, or three quarters of it where the sheet goes, but its own where that is
  // higher, and on teeth.
  std::vector<Level>
  Levels(Level highest) const;

private:
  double
  Length(ElementIndex edge) const
  {
    const auto & ends = m_Core.cells.edges[edge];
    return std::sqrt(SquaredDistance(m_Balls[ends[0]].centre, m_Balls[ends[1]].centre));
  }
  std::span<const Join>
  JoinsOf(ElementIndex node) const
  {
    return { m_Joins.data() + m_Offsets[node], m_Joins.data() + m_Offsets[node + 1] };
  }
  void
  JoinPairs();
  void
  JoinPairsOf(ElementIndex                      first,
              ElementIndex                      end,
              const std::vector<std::uint8_t> & wide,
              std::vector<Join> &               joins) const;
  void
  JoinSeams();
  void
  JoinStraightest(std::span<const RimStrip::Meeting> seam);
  void
  SortJoins();
  bool
  IsTooth(ElementIndex face, const std::vector<Level> & levels) const;

  const MedialComplex &         m_Core;
  const std::vector<CoreBall> & m_Balls;
  const RimStrip &              m_Strip;
  std::vector<Join>             m_Joins;   // by `from`
  std::vector<std::uint32_t>    m_Offsets; // of each node
};

void
Sheets::JoinPairs()
{
  const std::vector<ElementIndex> & faces = m_Strip.Faces();
  std::vector<std::uint8_t>         wide(faces.size());
  std::vector<std::vector<Join>>    parts(faces.size() / kPart + 1);
  const auto                        forParts = [&](const auto & work) {
    const auto one = [&](std::size_t part) {
      work(part,
           static_cast<ElementIndex>(part * kPart),
           static_cast<ElementIndex>(std::min((part + 1) * kPart, faces.size())));
    };
    parts.size() > 1 ? RunEach(parts.size(), one) : one(0);
  };
  forParts([&](std::size_t, ElementIndex first, ElementIndex end) {
    for (ElementIndex face = first; face < end; ++face)
    {
      wide[face] = IsWide(m_Core, faces[face]) ? 1 : 0;
    }
  });
  forParts([&](std::size_t part, ElementIndex first, ElementIndex end) { JoinPairsOf(first, end, wide, parts[part]); });
  for (std::vector<Join> & part : parts)
  {
    m_Joins.insert(m_Joins.end(), part.begin(), part.end());
    std::vector<Join>().swap(part);
  }
}

// Of two faces alone at an edge each is the straightest for the other, if straight enough.
void
Sheets::JoinPairsOf(ElementIndex                      first,
                    ElementIndex                      end,
                    const std::vector<std::uint8_t> & wide,
                    std::vector<Join> &               joins) const
{
  const std::vector<ElementIndex> & faces = m_Strip.Faces();
  for (ElementIndex face = first; face < end; ++face)
  {
    for (const ElementIndex edge : m_Strip.EdgesOf(face))
    {
      const ElementIndex other = m_Strip.FacesAt(edge).exclusiveOr ^ face;
      if (m_Strip.FacesAt(edge).count == 2 && face < other && wide[face] != 0 && wide[other] != 0)
      {
        const ElementIndex at = m_Strip.EdgeOfCore(edge);
        const BallCentre   one = Away(m_Core.cells, m_Balls, faces[face], at);
        if (Cosine(one, Away(m_Core.cells, m_Balls, faces[other], at)) < kStraight - kTie)
        {
          const double length = Length(at);
          joins.push_back({ face, other, length });
          joins.push_back({ other, face, length });
        }
      }
    }
  }
}

void
Sheets::JoinSeams()
{
  const std::span<const RimStrip::Meeting> all = m_Strip.Meetings();
  for (std::size_t first = 0, last = 0; first < all.size(); first = last)
  {
    while (last < all.size() && all[last].edge == all[first].edge)
    {
      ++last;
    }
    JoinStraightest(all.subspan(first, last - first));
  }
}

// Pairs go on as one sheet that are the straightest for both.
void
Sheets::JoinStraightest(std::span<const RimStrip::Meeting> seam)
{
  std::vector<BallCentre> directions;
  directions.reserve(seam.size());
  for (const RimStrip::Meeting & meeting : seam)
  {
    directions.push_back(Away(m_Core.cells, m_Balls, meeting.face, meeting.edge));
  }
  const auto straightest = [&](std::size_t i) {
    std::size_t best = i;
    double      least = kStraight;
    double      second = kStraight;
    for (std::size_t j = 0; j < seam.size(); ++j)
    {
      const double cosine = Cosine(directions[i], directions[j]);
      if (j != i && cosine < least)
      {
        second = std::exchange(least, cosine);
        best = j;
      }
      else if (j != i)
      {
        second = std::min(second, cosine);
      }
    }
    return least < second - kTie ? best : i;
  };
  for (std::size_t i = 0; i < seam.size(); ++i)
  {
    const std::size_t j = straightest(i);
    if (i < j && straightest(j) == i && IsWide(m_Core, seam[i].face) && IsWide(m_Core, seam[j].face))
    {
      const double length = Length(seam[i].edge);
      m_Joins.push_back({ seam[i].node, seam[j].node, length });
      m_Joins.push_back({ seam[j].node, seam[i].node, length });
    }
  }
}

void
Sheets::SortJoins()
{
  m_Offsets.assign(m_Strip.Faces().size() + 2, 0);
  for (const Join & join : m_Joins)
  {
    ++m_Offsets[join.from + 1];
  }
  std::partial_sum(m_Offsets.begin(), m_Offsets.end(), m_Offsets.begin());
  std::vector<Join>          sorted(m_Joins.size());
  std::vector<std::uint32_t> next(m_Offsets.begin(), m_Offsets.end() - 1);
  for (const Join & join : m_Joins)
  {
    sorted[next[join.from]++] = join;
  }
  m_Joins.swap(sorted);
}

// Whether less than half of the way round a face is joined to what has its level.
bool
Sheets::IsTooth(ElementIndex face, const std::vector<Level> & levels) const
{
  double joined = 0;
  for (const Join & join : JoinsOf(face))
  {
    joined += levels[join.to] >= levels[face] ? join.length : 0;
  }
  double around = 0;
  for (const ElementIndex edge : m_Core.cells.FaceEdges(m_Strip.Faces()[face]))
  {
    around += Length(edge);
  }
  return joined < (kTooth - kTie) * around;
}

std::vector<Level>
Sheets::Levels(Level highest) const
{
  std::vector<Level> own = m_Strip.FaceLevels();
  own.push_back(highest);
  UnionFind sheets(own.size());
  for (const Join & join : m_Joins)
  {
    sheets.Unite(join.from, join.to);
  }
  std::vector<Level> ofSheets(own.size(), 0);
  for (std::size_t node = 0; node < own.size(); ++node)
  {
    Level & sheet = ofSheets[sheets.Find(node)];
    sheet = std::max(sheet, own[node]);
  }
  std::vector<Level>        levels;
  std::vector<ElementIndex> raised;
  levels.reserve(own.size());
  const std::uint32_t staying = sheets.Find(m_Strip.Staying());
  for (ElementIndex node = 0; node < own.size(); ++node)
  {
    const std::uint32_t sheet = sheets.Find(node);
    const int           level = sheet == staying ? ofSheets[sheet] : ofSheets[sheet] * kQuarters / 4;
    levels.push_back(std::max(own[node], static_cast<Level>(level)));
    if (levels[node] != own[node])
    {
      raised.push_back(node);
    }
  }
  // What goes makes teeth of others, never the other way: the same ones go in any order.
  while (!raised.empty())
  {
    const ElementIndex face = raised.back();
    raised.pop_back();
    if (levels[face] != own[face] && IsTooth(face, levels))
    {
      levels[face] = own[face];
      for (const Join & join : JoinsOf(face))
      {
        raised.push_back(join.to);
      }
    }
  }
  levels.pop_back();
  return levels;
}

} // namespace

void
KeepSheetsWhole(const MedialComplex &         core,
                const std::vector<CoreBall> & balls,
                const ToleranceLevels &       levels,
                ToleranceValues &             values)
{
  RimStrip strip(core.cells, values, levels, kStaircase * levels.Diagonal(), levels.Measured());
  if (!strip.Faces().empty())
  {
    const auto highest = static_cast<Level>(levels.LevelOf(levels.Measured()));
    strip.RaiseTo(Sheets(core, balls, strip).Levels(highest));
    strip.Collapse(levels, values);
  }
}

} // namespace voxelcore
