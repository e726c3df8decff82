#include "voxelcore/Corrections/TreeEdits.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Skeleton/LoopClosers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;
using Change = std::array<std::int64_t, 3>;

constexpr std::array<std::pair<TreeEdit::Kind, const char *>, 7> kWords{ { { TreeEdit::Kind::Cut, "cut" },
                                                                           { TreeEdit::Kind::Remove, "remove" },
                                                                           { TreeEdit::Kind::Join, "join" },
                                                                           { TreeEdit::Kind::Path, "path" },
                                                                           { TreeEdit::Kind::Root, "root" },
                                                                           { TreeEdit::Kind::Loop, "loop" },
                                                                           { TreeEdit::Kind::Background,
                                                                             "background" } } };

/** In which kinds are done: each finds the body as it needs it. What is cut off is not removed with the rest, and paths
 *  run where something was removed. */
constexpr std::array<TreeEdit::Kind, 8> kOrder{ TreeEdit::Kind::Root, TreeEdit::Kind::None,
                                                TreeEdit::Kind::Loop, TreeEdit::Kind::Background,
                                                TreeEdit::Kind::Cut,  TreeEdit::Kind::Remove,
                                                TreeEdit::Kind::Join, TreeEdit::Kind::Path };

constexpr std::size_t kMostPlaces = 1000; // of a path that a person has drawn

/** Radii out to which a cut goes: sections are seldom flatter than the first; the last keeps off what touches it. */
constexpr std::array<double, 3> kReach{ 2, 4, 1.4 };
/** Parts of its radius, and voxel diagonals, that a line is thick: thicker where beside rough walls it leaves holes,
 *  then thinner where it touches others on its way. */
constexpr std::array<std::pair<double, double>, 5> kThick{ { { 1, 0 }, { 1, 0.5 }, { 1, 1 }, { 0.5, 0 }, { 0, 0 } } };
/** Voxel diagonals by which the place of a branch, tip or cut may be off, whatever the radius: thin branches and their
 *  ends move by voxels when a threshold does (for 2 % by up to three in a root one to two voxels thick). */
constexpr double kOff = 1.5;

constexpr double kRounding = 1e-9;

const std::string kNoBranchThere = "no branch passes there";
const std::string kNoTipThere = "no tip is there";
const std::string kTearsOthers = "without it the body would fall apart, or its loops would change";
const std::string kIsGone = "an edit before it has taken that off";

struct LinePoint
{
  Vector3 place{};
  double  radius = 0;
};

/** A branch from its base on. From a tip it goes on straight to the surface. */
using Line = std::vector<LinePoint>;

/** A slab across a line. */
struct Slab
{
  Vector3            place{};
  double             reach = 0;
  std::vector<Voxel> voxels; ///< that hang together with the place
};

Voxel
Neighbour(const Voxel & voxel, std::int32_t n)
{
  return { voxel[0] + n % 3 - 1, voxel[1] + n / 3 % 3 - 1, voxel[2] + n / 9 - 1 };
}

bool
ShareAFace(const Voxel & a, const Voxel & b)
{
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) == 1;
}

/** Calls visit(x, y, z) for each voxel of a box. */
template <typename TVisit>
void
ForVoxels(const VoxelBox & box, const TVisit & visit)
{
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        visit(Voxel{ x, y, z });
      }
    }
  }
}

/** A body parted by a slab. */
struct Parted
{
  std::vector<Voxel> taken;
  Voxel              before{};
  Voxel              behind{};
};

class Editor
{
public:
  Editor(const VoxelShape & shape, const ImageGeometry & geometry, const MeasuredSkeleton & tree)
    : m_Before(shape)
    , m_Shape(shape)
    , m_Betti(ComputeShapeTopology(shape).betti)
    , m_Geometry(geometry)
    , m_Graph(tree.graph)
    , m_Table(tree.table)
    , m_Radii(SectionRadii(tree.graph))
    , m_Diagonal(Length(geometry.spacing))
    , m_Widest(m_Diagonal)
  {}

  EditedTree
  Run(std::span<const TreeEdit> edits)
  {
    Widen(edits);
    m_Edited.outcomes.resize(edits.size());
    // First, as it says what springs from what.
    for (std::size_t i = 0; i < edits.size(); ++i)
    {
      if (edits[i].kind == TreeEdit::Kind::Root)
      {
        m_Edited.outcomes[i].misfit = BeginAt(edits[i].place);
      }
    }
    m_Edited.order = OrderOf(edits);
    for (const std::size_t i : m_Edited.order)
    {
      if (edits[i].kind != TreeEdit::Kind::Root)
      {
        m_Outcome = TreeEditOutcome();
        m_Kind = edits[i].kind;
        m_Outcome.misfit = Do(edits[i]);
        m_Edited.outcomes[i] = std::move(m_Outcome);
      }
    }
    m_Edited.shape = CropToVoxels(std::move(m_Shape));
    return std::move(m_Edited);
  }

private:
  /** Numbers of edits, those first that come first. */
  std::vector<std::size_t>
  OrderOf(std::span<const TreeEdit> edits) const
  {
    std::vector<std::array<std::int64_t, 3>> keys;
    for (std::size_t i = 0; i < edits.size(); ++i)
    {
      const auto kind = ranges::find(kOrder, edits[i].kind) - kOrder.begin();
      const auto foot =
        edits[i].kind == TreeEdit::Kind::Remove ? BranchMeant(m_Graph, m_Geometry, edits[i].place) : std::nullopt;
      keys.push_back({ kind, foot ? -m_Table.branches[foot->branch].centrifugal : 0, static_cast<std::int64_t>(i) });
    }
    ranges::sort(keys);
    std::vector<std::size_t> order;
    for (const auto & key : keys)
    {
      order.push_back(static_cast<std::size_t>(key[2]));
    }
    return order;
  }

  double
  Radius(ElementIndex point) const
  {
    return std::max(m_Radii[point], m_Graph.radius[point]);
  }

  double
  Slack(ElementIndex point) const
  {
    return std::max(Radius(point), kOff * m_Diagonal);
  }

  const Vector3 &
  PlaceOf(const BranchPoint & foot) const
  {
    return m_Graph.positions[m_Graph.Branch(foot.branch)[foot.point]];
  }

  /** The tip at a place, other than one. */
  std::optional<ElementIndex>
  TipAt(const Vector3 & place, const std::optional<ElementIndex> & other = {}) const
  {
    std::optional<ElementIndex> found;
    double                      nearest = std::numeric_limits<double>::infinity();
    for (std::size_t node = 0; node < m_Graph.nodePoints.size(); ++node)
    {
      const ElementIndex point = m_Graph.nodePoints[node];
      const double       away = Distance(m_Graph.positions[point], place);
      if (m_Graph.nodeKinds[node] == NodeKind::Tip && point != other && away <= 2 * Slack(point) && away < nearest)
      {
        nearest = away;
        found = point;
      }
    }
    return found;
  }

  /** Where a branch ends of which the tip was at a place off all branches: the nearest point. The branch of another tip
   *  does not count. */
  std::optional<ElementIndex>
  EndNear(const Vector3 & place, double within, const std::optional<ElementIndex> & other) const
  {
    std::optional<ElementIndex> found;
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto points = m_Graph.Branch(branch);
      if (points.front() == other || points.back() == other)
      {
        continue;
      }
      for (const ElementIndex point : points)
      {
        const double away = Distance(m_Graph.positions[point], place);
        if (away <= Slack(point))
        {
          return std::nullopt;
        }
        if (away <= within)
        {
          found = point;
          within = away;
        }
      }
    }
    return found;
  }

  Voxel
  VoxelAt(const Vector3 & place) const
  {
    const Vector3 at = PhysicalToLattice(m_Geometry, place);
    Voxel         voxel{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      voxel[k] =
        static_cast<std::int32_t>(std::clamp(std::floor(at[k]), -1.0, static_cast<double>(m_Geometry.size[k])));
    }
    return voxel;
  }

  Vector3
  CentreOf(const Voxel & voxel) const
  {
    return LatticeToPhysical(m_Geometry, { voxel[0] + 0.5, voxel[1] + 0.5, voxel[2] + 0.5 });
  }

  bool
  Contains(const Voxel & voxel) const
  {
    return m_Shape.Contains(voxel[0], voxel[1], voxel[2]);
  }

  /** Whether an edit before has taken the voxel at a place off. Lines of thin branches may run beside all voxels. */
  bool
  IsGone(const Vector3 & place) const
  {
    const Voxel voxel = VoxelAt(place);
    return m_Before.Contains(voxel[0], voxel[1], voxel[2]) && !Contains(voxel);
  }

  bool
  IsInScan(const Vector3 & place) const
  {
    const Voxel voxel = VoxelAt(place);
    return ranges::all_of(std::array<std::size_t, 3>{ 0, 1, 2 }, [&](std::size_t k) {
      return voxel[k] >= 0 && voxel[k] < static_cast<std::int32_t>(m_Geometry.size[k]);
    });
  }

  /** The shape in a box that holds what is put in, too. */
  void
  Widen(std::span<const TreeEdit> edits)
  {
    for (std::size_t point = 0; point < m_Graph.positions.size(); ++point)
    {
      m_Widest = std::max(m_Widest, Radius(static_cast<ElementIndex>(point)));
    }
    VoxelBox box = m_Shape.Box();
    for (const TreeEdit & edit : edits)
    {
      for (const Vector3 & place : edit.further)
      {
        if (IsInScan(place) && IsInScan(edit.place))
        {
          // Where the tip or branch is that a place means, too.
          const double reach = 4 * m_Widest;
          box = BoxOfBoth(box, BoxOfBoth(BoxAround(edit.place, reach), BoxAround(place, reach)));
        }
      }
    }
    VoxelShape wide(box);
    PutInto(m_Shape, wide);
    wide.Compact();
    m_Shape = std::move(wide);
  }

  /** Within the scan. */
  VoxelBox
  BoxAround(const Vector3 & place, double reach) const
  {
    const Vector3 at = PhysicalToLattice(m_Geometry, place);
    VoxelBox      box;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double by = reach / m_Geometry.spacing[k];
      const auto   size = static_cast<double>(m_Geometry.size[k]);
      const double low = std::clamp(std::floor(at[k] - by), 0.0, size);
      const double high = std::clamp(std::ceil(at[k] + by), 0.0, size);
      box.lower[k] = static_cast<std::int32_t>(low);
      box.size[k] = static_cast<std::int32_t>(high - low);
    }
    return box;
  }

  void
  Set(const std::vector<Voxel> & voxels, bool isIn)
  {
    const VoxelBox & box = m_Shape.Box();
    for (const Voxel & voxel : voxels)
    {
      const auto at = static_cast<std::uint32_t>(voxel[0] - box.lower[0]);
      const auto row = m_Shape.Row(voxel[1] - box.lower[1], voxel[2] - box.lower[2]);
      const auto bit = std::uint64_t{ 1 } << (at & 63U);
      if (isIn)
      {
        row[at >> 6U] |= bit;
      }
      else
      {
        row[at >> 6U] &= ~bit;
      }
    }
  }

  /** Ends an edit whose voxels are set: keeps them where the topology numbers change as they should, else sets them
   *  back. */
  bool
  Keep(std::vector<Voxel> voxels, bool isIn)
  {
    const Change betti = ComputeShapeTopology(m_Shape).betti;
    Change       change{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      change[k] = betti[k] - m_Betti[k];
    }
    if (!IsChangeOf(m_Kind, change))
    {
      Set(voxels, !isIn);
      return false;
    }
    m_Betti = betti;
    m_Outcome.voxels = std::move(voxels);
    m_Outcome.change = change;
    return true;
  }

  Line
  LineOf(std::size_t branch) const
  {
    Line line;
    for (const ElementIndex point : m_Graph.Branch(branch))
    {
      line.push_back({ m_Graph.positions[point], Radius(point) });
    }
    const bool baseIsLast = m_Table.branches[branch].baseIsLast;
    if (baseIsLast)
    {
      ranges::reverse(line);
    }
    if (m_Graph.nodeKinds[m_Graph.branchNodes[branch][baseIsLast ? 0 : 1]] == NodeKind::Tip)
    {
      const LinePoint tip = line.back();
      const Vector3   way = DirectionAt(line, line.size() - 1);
      const double    step = m_Diagonal / 2;
      for (double along = step; along <= 2 * tip.radius; along += step)
      {
        line.push_back({ AddScaled(tip.place, along, way), tip.radius });
      }
    }
    return line;
  }

  /** Over as much as the line is thick: its points are less than a voxel apart. */
  Vector3
  DirectionAt(const Line & line, std::size_t i) const
  {
    const double reach = std::max(line[i].radius, m_Diagonal);
    std::size_t  first = i;
    std::size_t  last = i;
    while (first > 0 && Distance(line[first].place, line[i].place) < reach)
    {
      --first;
    }
    while (last + 1 < line.size() && Distance(line[last].place, line[i].place) < reach)
    {
      ++last;
    }
    const Vector3 way = Minus(line[last].place, line[first].place);
    const double  length = Length(way);
    return length > 0 ? AddScaled({ 0, 0, 0 }, 1 / length, way) : Vector3{ 0, 0, 1 };
  }

  /** So that no two voxels touch across it. */
  double
  SlabWidth(const Vector3 & normal) const
  {
    double width = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        along += m_Geometry.direction[3 * k + axis] * normal[k];
      }
      width += std::abs(along) * m_Geometry.spacing[axis];
    }
    return width * (1 + kRounding);
  }

  /** What hangs together with a voxel: all next to it, or over faces, that is in the body and taken. */
  template <typename TTakes>
  std::set<Voxel>
  Hanging(const Voxel & seed, bool overFaces, const TTakes & takes) const
  {
    std::set<Voxel>    all;
    std::vector<Voxel> waiting{ seed };
    while (!waiting.empty())
    {
      const Voxel here = waiting.back();
      waiting.pop_back();
      for (std::int32_t n = 0; n < 27; ++n)
      {
        const Voxel next = Neighbour(here, n);
        if ((!overFaces || ShareAFace(here, next)) && Contains(next) && takes(here, next) && all.insert(next).second)
        {
          waiting.push_back(next);
        }
      }
    }
    return all;
  }

  Slab
  SlabAt(const Line & line, std::size_t i, double radii) const
  {
    const Vector3 normal = DirectionAt(line, i);
    const double  width = SlabWidth(normal);
    Slab          slab{ line[i].place, radii * line[i].radius + width, {} };
    // The place may lie on a face of voxels: all around count as next to it.
    const auto all = Hanging(VoxelAt(slab.place), false, [&](const Voxel &, const Voxel & next) {
      const Vector3 way = Minus(CentreOf(next), slab.place);
      return std::abs(Dot(way, normal)) <= width / 2 && Length(way) <= slab.reach;
    });
    slab.voxels.assign(all.begin(), all.end());
    return slab;
  }

  /** A voxel of the body on the line before or behind a slab that was taken out. */
  std::optional<Voxel>
  BesideSlab(const Slab & slab, const Line & line, std::size_t i, bool before) const
  {
    while (before ? i > 0 : i + 1 < line.size())
    {
      i = before ? i - 1 : i + 1;
      const Voxel voxel = VoxelAt(line[i].place);
      if (Contains(voxel))
      {
        return Reaches(slab, voxel) ? std::optional(voxel) : std::nullopt;
      }
    }
    return std::nullopt;
  }

  /** What hangs together with a voxel, over faces, out to the reach of a slab. */
  std::set<Voxel>
  PieceAt(const Voxel & seed, const Slab & slab) const
  {
    std::set<Voxel> piece = Hanging(seed, true, [&](const Voxel & here, const Voxel &) { return Reaches(slab, here); });
    piece.insert(seed);
    return piece;
  }

  bool
  Reaches(const Slab & slab, const Voxel & voxel) const
  {
    return Distance(CentreOf(voxel), slab.place) <= slab.reach;
  }

  /** Takes out a slab, and what is then loose and no larger than it. None where what is before and behind hangs
   *  together within its reach still; then nothing is taken out. */
  std::optional<Parted>
  Part(const Line & line, std::size_t i, double radii)
  {
    const Slab slab = SlabAt(line, i, radii);
    if (slab.voxels.empty())
    {
      return std::nullopt;
    }
    std::vector<Voxel> taken = slab.voxels;
    Set(taken, false);
    const auto before = BesideSlab(slab, line, i, true);
    const auto behind = BesideSlab(slab, line, i, false);
    if (!before || !behind || PieceAt(*before, slab).contains(*behind))
    {
      Set(taken, true);
      return std::nullopt;
    }
    std::set<Voxel> seen;
    for (const Voxel & voxel : slab.voxels)
    {
      for (std::int32_t n = 0; n < 27; ++n)
      {
        const Voxel seed = Neighbour(voxel, n);
        if (!Contains(seed) || seen.contains(seed))
        {
          continue;
        }
        const std::set<Voxel> piece = PieceAt(seed, slab);
        seen.insert(piece.begin(), piece.end());
        const bool isWithin = ranges::all_of(piece, [&](const Voxel & one) { return Reaches(slab, one); });
        if (isWithin && piece.size() <= slab.voxels.size() && !piece.contains(*before) && !piece.contains(*behind))
        {
          const std::vector<Voxel> loose(piece.begin(), piece.end());
          Set(loose, false);
          taken.insert(taken.end(), loose.begin(), loose.end());
        }
      }
    }
    return Parted{ std::move(taken), *before, *behind };
  }

  /** The voxels of the background, within the scan, whose centres lie within `radius` of a line. */
  std::vector<Voxel>
  Tube(const std::vector<Vector3> & line, double radius) const
  {
    const double    reach = std::max(radius, m_Diagonal / 2) * (1 + kRounding); // so that it hangs together
    std::set<Voxel> tube;
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      const Vector3 whole = Minus(line[i], line[i - 1]);
      const double  parts = std::max(1.0, std::ceil(Length(whole) / (4 * reach))); // small boxes along it
      for (double part = 0; part < parts; ++part)
      {
        const Vector3 from = AddScaled(line[i - 1], part / parts, whole);
        const Vector3 way = AddScaled({ 0, 0, 0 }, 1 / parts, whole);
        const double  squared = Dot(way, way);
        ForVoxels(BoxOfBoth(BoxAround(from, reach), BoxAround(AddScaled(from, 1, way), reach)),
                  [&](const Voxel & voxel) {
                    const Vector3 there = Minus(CentreOf(voxel), from);
                    const double  share = squared > 0 ? std::clamp(Dot(there, way) / squared, 0.0, 1.0) : 0;
                    if (Length(AddScaled(there, -share, way)) <= reach && !Contains(voxel))
                    {
                      tube.insert(voxel);
                    }
                  });
      }
    }
    return { tube.begin(), tube.end() };
  }

  std::string
  BeginAt(const Vector3 & place)
  {
    const auto tip = TipAt(place);
    if (!tip || m_Edited.root)
    {
      return tip ? "the hierarchy begins at another place already" : kNoTipThere;
    }
    m_Edited.root = m_Graph.positions[*tip];
    m_Table = MeasureBranches(m_Graph, { { RootChoice::Kind::Point, *m_Edited.root } });
    return "";
  }

  /** Why it was left out; empty when it was done. */
  std::string
  Do(const TreeEdit & edit)
  {
    if (edit.kind == TreeEdit::Kind::Background)
    {
      return TakeOut(VoxelAt(edit.place));
    }
    if (edit.kind == TreeEdit::Kind::Join)
    {
      return Join(edit);
    }
    const auto foot = BranchMeant(m_Graph, m_Geometry, edit.place);
    if (!foot)
    {
      return kNoBranchThere;
    }
    if (edit.kind == TreeEdit::Kind::None)
    {
      return "";
    }
    if (IsGone(PlaceOf(*foot)))
    {
      return kIsGone;
    }
    switch (edit.kind)
    {
      case TreeEdit::Kind::Cut:
        return Cut(*foot);
      case TreeEdit::Kind::Remove:
        return Remove(*foot);
      case TreeEdit::Kind::Loop:
        if (!FindCloserOf(m_Graph, foot->branch))
        {
          return "no loop passes there";
        }
        m_Edited.loops.push_back(PlaceOf(*foot));
        return "";
      default:
        return Path(edit, *foot);
    }
  }

  std::string
  TakeOut(const Voxel & voxel)
  {
    if (!Contains(voxel))
    {
      return "the voxel there is none of the body";
    }
    if (m_Shape.CountVoxels() == 1)
    {
      return "nothing would be left";
    }
    Set({ voxel }, false);
    return Keep({ voxel }, false) ? "" : "it would be a cavity; name voxels from the surface on inwards";
  }

  std::string
  Cut(const BranchPoint & foot)
  {
    const Line      line = LineOf(foot.branch);
    const LinePoint middle{ PlaceOf(foot), Slack(m_Graph.Branch(foot.branch)[foot.point]) };
    // From the place on before and behind.
    std::vector<std::pair<double, std::size_t>> nearestFirst;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      const double away = Distance(line[i].place, middle.place);
      if (away <= middle.radius)
      {
        nearestFirst.emplace_back(away, i);
      }
    }
    ranges::sort(nearestFirst);
    for (const double radii : kReach)
    {
      for (const auto & [away, i] : nearestFirst)
      {
        auto part = Part(line, i, radii);
        if (part && Keep(std::move(part->taken), false))
        {
          return "";
        }
      }
    }
    return "it would not part the body there";
  }

  std::string
  Remove(const BranchPoint & foot)
  {
    const Line line = LineOf(foot.branch);
    if (m_Table.branches[foot.branch].parent == kNoBranch)
    {
      return RemovePiece({ {}, {}, VoxelAt(PlaceOf(foot)) });
    }
    std::string misfit = "its base does not part from the body";
    for (const double radii : kReach)
    {
      for (std::size_t i = 0; i < line.size(); ++i)
      {
        const double from = line[0].radius + SlabWidth(DirectionAt(line, i)) / 2;
        const double away = Distance(line[i].place, line[0].place);
        auto         part = away > from ? Part(line, i, radii) : std::nullopt;
        if (!part)
        {
          continue;
        }
        misfit = RemovePiece(std::move(*part));
        if (misfit != kTearsOthers || away > from + line[0].radius)
        {
          return misfit;
        }
      }
    }
    return misfit;
  }

  /** Takes out the piece behind a slab; without one, that with the voxel. */
  std::string
  RemovePiece(Parted part)
  {
    const auto pieces = SplitComponents(m_Shape);
    const auto isIn = [](const VoxelShape & piece, const Voxel & one) {
      return piece.Contains(one[0], one[1], one[2]);
    };
    const auto piece = ranges::find_if(pieces, [&](const VoxelShape & one) { return isIn(one, part.behind); });
    const bool hangs = !part.taken.empty() && isIn(*piece, part.before);
    if (hangs || pieces.size() == 1)
    {
      Set(part.taken, true);
      return hangs ? "it hangs on the rest elsewhere, too; cut it there first" : "nothing would be left";
    }
    std::vector<Voxel> voxels;
    ForVoxels(piece->Box(), [&](const Voxel & one) {
      if (isIn(*piece, one))
      {
        voxels.push_back(one);
      }
    });
    Set(voxels, false);
    part.taken.insert(part.taken.end(), voxels.begin(), voxels.end());
    return Keep(std::move(part.taken), false) ? "" : kTearsOthers;
  }

  std::string
  Join(const TreeEdit & edit)
  {
    const std::array<Vector3, 2> places{ edit.place, edit.further.at(0) };
    std::vector<Vector3>         line;
    double                       radius = m_Widest;
    // Of two places at one tip, where another has receded, it is at the nearer one.
    std::array<std::optional<ElementIndex>, 2> tips{ TipAt(places[0]), TipAt(places[1]) };
    const bool                                 isOne = tips[0] && tips[0] == tips[1];
    if (isOne)
    {
      const Vector3 &   at = m_Graph.positions[*tips[0]];
      const std::size_t farther = Distance(at, places[0]) > Distance(at, places[1]) ? 0 : 1;
      tips[farther] = TipAt(places[farther], tips[0]);
    }
    for (std::size_t i = 0; i < 2; ++i)
    {
      const auto tip = tips[i];
      const auto end = tip ? tip : EndNear(places[i], Distance(places[0], places[1]), tips[1 - i]);
      if (!end)
      {
        return isOne ? "both places are at one tip" : kNoTipThere;
      }
      line.push_back(m_Graph.positions[*end]);
      radius = std::min(radius, m_Radii[*end]);
      if (!tip)
      {
        line.insert(i == 0 ? line.end() : line.end() - 1, places[i]);
      }
    }
    return Fill(line, radius);
  }

  std::string
  Path(const TreeEdit & edit, const BranchPoint & foot)
  {
    if (!ranges::all_of(edit.further, [&](const Vector3 & place) { return IsInScan(place); }))
    {
      return "it leaves the scan";
    }
    if (edit.radius > m_Widest)
    {
      return "it would be thicker than the whole tree";
    }
    std::vector<Vector3> line{ PlaceOf(foot) };
    line.insert(line.end(), edit.further.begin(), edit.further.end());
    return Fill(line, edit.radius > 0 ? edit.radius : m_Radii[m_Graph.Branch(foot.branch)[foot.point]]);
  }

  /** Puts in a line. */
  std::string
  Fill(const std::vector<Vector3> & line, double radius)
  {
    for (const Vector3 & end : { line.front(), line.back() })
    {
      if (m_Kind == TreeEdit::Kind::Join && IsGone(end))
      {
        return kIsGone;
      }
    }
    for (const auto & [part, more] : kThick)
    {
      auto tube = Tube(line, part * radius + more * m_Diagonal);
      if (tube.empty())
      {
        return "all of its way is in the body already";
      }
      Set(tube, true);
      if (Keep(std::move(tube), true))
      {
        return "";
      }
    }
    return "its way touches other parts of the body: a loop or a cavity would come of it";
  }

  const VoxelShape &          m_Before;
  VoxelShape                  m_Shape;
  Change                      m_Betti;
  const ImageGeometry &       m_Geometry;
  const SkeletonGraph &       m_Graph;
  BranchTable                 m_Table;
  const std::vector<double> & m_Radii;
  double                      m_Diagonal; ///< of a voxel
  double                      m_Widest;   ///< radius of the tree
  EditedTree                  m_Edited;
  TreeEditOutcome             m_Outcome; ///< of the edit that is done now
  TreeEdit::Kind              m_Kind = TreeEdit::Kind::None;
};

} // namespace

bool
IsChangeOf(TreeEdit::Kind kind, const std::array<std::int64_t, 3> & change)
{
  switch (kind)
  {
    case TreeEdit::Kind::Cut:
      return change == Change{ 1, 0, 0 } || change == Change{ 0, -1, 0 };
    case TreeEdit::Kind::Remove:
      return change[0] <= 0 && change[0] >= -1 && change[1] <= 0 && change[2] <= 0;
    case TreeEdit::Kind::Join:
      return change == Change{ -1, 0, 0 } || change == Change{ 0, 1, 0 };
    case TreeEdit::Kind::Path:
      return change == Change{ 0, 0, 0 } || change == Change{ -1, 0, 0 } || change == Change{ 0, 1, 0 };
    case TreeEdit::Kind::Background:
      return change[2] <= 0;
    default:
      return change == Change{};
  }
}

std::string
TreeEditText(const TreeEdit & edit)
{
  const auto word = ranges::find(kWords, edit.kind, &decltype(kWords)::value_type::first);
  if (word == kWords.end())
  {
    return {};
  }
  std::string text = word->second;
  for (std::size_t i = 0; i < edit.further.size(); ++i)
  {
    text += i > 0 ? ";" : "";
    for (const double coordinate : edit.further[i])
    {
      text += " " + RoundTripText(coordinate);
    }
  }
  return text + (edit.radius > 0 ? " radius " + RoundTripText(edit.radius) : "");
}

TreeEdit
ParseTreeEdit(const std::string & text)
{
  const std::string_view plain = Trim(text);
  TreeEdit               edit;
  if (plain.empty())
  {
    return edit;
  }
  const auto refuse = [&](bool when) {
    if (when)
    {
      throw UsageError("'" + Printable(plain) +
                       "' is no edit; expected cut, remove, join X Y Z, path X Y Z; X Y Z, root, loop or background");
    }
  };
  const std::size_t word = std::min(plain.find_first_of(" \t"), plain.size());
  const auto found = ranges::find_if(kWords, [&](const auto & pair) { return plain.substr(0, word) == pair.second; });
  refuse(found == kWords.end());
  edit.kind = found->first;
  std::string_view  places = plain.substr(word);
  const std::size_t radius = places.find(" radius ");
  if (edit.kind == TreeEdit::Kind::Path && radius != std::string_view::npos)
  {
    edit.radius = ParseReal(Trim(places.substr(radius + 8))).value_or(0);
    refuse(!(edit.radius > 0) || !std::isfinite(edit.radius));
    places = places.substr(0, radius);
  }
  if (!Trim(places).empty())
  {
    for (const std::string & place : SplitText(places, ';'))
    {
      const auto numbers = ParseReals(place);
      refuse(!numbers || numbers->size() != 3 || edit.further.size() == kMostPlaces);
      edit.further.push_back({ (*numbers)[0], (*numbers)[1], (*numbers)[2] });
      refuse(!ranges::all_of(edit.further.back(), [](double number) { return std::isfinite(number); }));
    }
  }
  const bool takesOne = edit.kind == TreeEdit::Kind::Join;
  const bool takesSome = takesOne || edit.kind == TreeEdit::Kind::Path;
  refuse(takesSome == edit.further.empty() || (takesOne && edit.further.size() != 1));
  return edit;
}

EditedTree
EditTree(const VoxelShape &        shape,
         const ImageGeometry &     geometry,
         const MeasuredSkeleton &  tree,
         std::span<const TreeEdit> edits)
{
  return Editor(shape, geometry, tree).Run(edits);
}

std::optional<BranchPoint>
BranchMeant(const SkeletonGraph & graph, const ImageGeometry & geometry, const Vector3 & place)
{
  return BranchAt(graph, place, kOff * Length(geometry.spacing));
}

Vector3
PlaceOfBranch(const SkeletonGraph & graph, std::size_t branch)
{
  const auto points = graph.Branch(branch);
  return graph.positions[points[points.size() / 2]];
}

} // namespace voxelcore
