#include "voxelcore/Roots/RootEdits.h"

#include "RootSteps.h"
#include "RootWhorls.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr std::array<std::pair<RootEdit::Kind, const char *>, 4> kWords{ { { RootEdit::Kind::Remove, "remove" },
                                                                           { RootEdit::Kind::Stem, "stem" },
                                                                           { RootEdit::Kind::Parent, "parent " },
                                                                           { RootEdit::Kind::Continues,
                                                                             "continues " } } };

class Editor
{
public:
  Editor(const SkeletonGraph & graph, const RootHierarchy & roots)
    : m_Graph(graph)
    , m_Edited{ roots, {} }
    , m_Axes(m_Edited.roots.axes)
    , m_Is(roots.axes.size())
    , m_IsGone(roots.axes.size(), 0)
  {
    for (ElementIndex i = 0; i < m_Is.size(); ++i)
    {
      m_Is[i] = i;
    }
  }

  EditedRoots
  Run(std::span<const RootEdit> edits, const RootRules & rules)
  {
    Check(edits);
    ForEach(edits, RootEdit::Kind::Continues, [&](const RootEdit & edit) { Continue(edit.root, edit.other); });
    ForEach(edits, RootEdit::Kind::Parent, [&](const RootEdit & edit) { Hang(m_Is[edit.root], m_Is[edit.other]); });
    ForEach(edits, RootEdit::Kind::Stem, [&](const RootEdit & edit) {
      m_Axes[m_Is[edit.root]].parent = kNoRoot;
      m_Axes[m_Is[edit.root]].loose = false;
    });
    ForEach(edits, RootEdit::Kind::Remove, [&](const RootEdit & edit) { m_IsGone[m_Is[edit.root]] = 1; });
    for (const RootEdit & edit : edits)
    {
      if (!edit.name.empty())
      {
        m_Axes[m_Is[edit.root]].name = edit.name;
      }
    }
    Finish(rules);
    return std::move(m_Edited);
  }

private:
  void
  Check(std::span<const RootEdit> edits) const
  {
    std::vector<char> hasOne(m_Axes.size(), 0);
    for (const RootEdit & edit : edits)
    {
      const bool hasOther = edit.kind == RootEdit::Kind::Parent || edit.kind == RootEdit::Kind::Continues;
      for (const ElementIndex root : { edit.root, hasOther ? edit.other : edit.root })
      {
        if (root >= m_Axes.size())
        {
          throw UsageError("root " + std::to_string(root) + " is not there; roots are 0 to " +
                           std::to_string(m_Axes.size() - 1));
        }
      }
      if (edit.kind != RootEdit::Kind::None && std::exchange(hasOne[edit.root], 1) != 0)
      {
        throw UsageError("root " + std::to_string(edit.root) + " has two edits");
      }
    }
  }

  template <typename TWork>
  static void
  ForEach(std::span<const RootEdit> edits, RootEdit::Kind kind, const TWork & work)
  {
    for (const RootEdit & edit : edits)
    {
      if (edit.kind == kind)
      {
        work(edit);
      }
    }
  }

  const Vector3 &
  Place(ElementIndex point) const
  {
    return m_Graph.positions[point];
  }

  /** Turns round what hangs on nothing where its tip is nearer to the other root. */
  void
  BeginNear(ElementIndex axis, ElementIndex other)
  {
    auto &     points = m_Axes[axis].points;
    auto &     line = m_Axes[other].points;
    const auto away = [&](ElementIndex point) {
      return Distance(Place(point), Place(line[NearestPoint(m_Graph, line, Place(point))]));
    };
    if (m_Axes[axis].parent == kNoRoot && away(points.back()) < away(points.front()))
    {
      ranges::reverse(points);
      for (RootAxis & child : m_Axes)
      {
        child.parentPoint = child.parent == axis ? points.size() - 1 - child.parentPoint : child.parentPoint;
      }
    }
  }

  void
  Continue(ElementIndex which, ElementIndex what)
  {
    const ElementIndex next = m_Is[which];
    const ElementIndex before = m_Is[what];
    if (next == before)
    {
      throw UsageError("root " + std::to_string(which) + " would go on from itself; name another");
    }
    BeginNear(next, before);
    RootAxis &        first = m_Axes[before];
    RootAxis &        second = m_Axes[next];
    const std::size_t at = NearestPoint(m_Graph, first.points, Place(second.points.front()));
    // What the first one was from there on; a stub within its own thickness is none.
    const ElementIndex        joint = first.points[at];
    std::vector<ElementIndex> tail(first.points.begin() + static_cast<std::ptrdiff_t>(at), first.points.end());
    const bool        isStub = Distance(Place(tail.front()), Place(tail.back())) <= SectionRadii(m_Graph)[joint];
    const std::size_t shift = at + (second.points.front() == joint ? 0 : 1);
    for (ElementIndex child = 0; child < m_Axes.size(); ++child)
    {
      RootAxis & axis = m_Axes[child];
      if (axis.parent == next)
      {
        axis.parent = before;
        axis.parentPoint += shift;
      }
      else if (axis.parent == before && child != next && axis.parentPoint > at)
      {
        axis.parent = isStub ? before : next;
        axis.parentPoint = isStub ? at : axis.parentPoint - at;
      }
    }
    first.points.resize(at);
    first.points.push_back(joint);
    first.points.insert(first.points.end(),
                        second.points.begin() + (second.points.front() == joint ? 1 : 0),
                        second.points.end());
    std::swap(first.endsAtContact, second.endsAtContact);
    second.points = std::move(tail);
    second.parent = before;
    second.parentPoint = at;
    m_IsGone[next] = isStub ? 1 : m_IsGone[next];
    for (ElementIndex & is : m_Is)
    {
      is = is == next ? before : is;
    }
  }

  void
  Hang(ElementIndex axis, ElementIndex parent)
  {
    BeginNear(axis, parent);
    auto &            points = m_Axes[axis].points;
    const std::size_t at = NearestPoint(m_Graph, m_Axes[parent].points, Place(points.front()));
    if (m_Axes[axis].parent == kNoRoot && axis != parent && points.front() != m_Axes[parent].points[at])
    {
      points.insert(points.begin(), m_Axes[parent].points[at]);
      for (RootAxis & child : m_Axes)
      {
        child.parentPoint += child.parent == axis ? 1 : 0;
      }
    }
    m_Axes[axis].parent = parent;
    m_Axes[axis].parentPoint = at;
  }

  /** Levels, what is gone, and all that follows from the axes. */
  void
  Finish(const RootRules & rules)
  {
    const std::size_t count = m_Axes.size();
    for (ElementIndex i = 0; i < count; ++i)
    {
      RootAxis &   axis = m_Axes[i];
      ElementIndex stem = i;
      axis.level = 0;
      for (; m_Axes[stem].parent != kNoRoot; stem = m_Axes[stem].parent)
      {
        m_IsGone[i] = m_IsGone[i] != 0 || m_IsGone[m_Axes[stem].parent] != 0 ? 1 : 0;
        if (static_cast<std::size_t>(++axis.level) > count)
        {
          throw UsageError("root " + std::to_string(i) + " would spring from itself; name another");
        }
      }
      axis.stem = stem;
      axis.children = 0;
    }
    if (count > 0 && ranges::all_of(m_IsGone, [](char gone) { return gone != 0; }))
    {
      throw UsageError("the edits remove all roots");
    }
    std::vector<ElementIndex> place(count, kNoRoot);
    std::vector<RootAxis>     kept;
    for (ElementIndex i = 0; i < count; ++i)
    {
      if (m_IsGone[i] == 0)
      {
        place[i] = static_cast<ElementIndex>(kept.size());
        kept.push_back(std::move(m_Axes[i]));
      }
    }
    for (RootAxis & axis : kept)
    {
      axis.parent = axis.parent == kNoRoot ? kNoRoot : place[axis.parent];
      axis.stem = place[axis.stem];
    }
    m_Axes = std::move(kept);
    for (RootAxis & axis : m_Axes)
    {
      axis.loose = m_Axes[axis.stem].loose;
      if (axis.parent != kNoRoot)
      {
        ++m_Axes[axis.parent].children;
      }
    }
    FindOwners();
    const std::vector<ElementIndex> sorted = SortByLevel(m_Edited.roots);
    for (ElementIndex i = 0; i < count; ++i)
    {
      const ElementIndex now = place[m_Is[i]];
      m_Edited.now.push_back(now == kNoRoot ? kNoRoot : sorted[now]);
    }
    m_Edited.roots.whorls.clear();
    FindWhorls(m_Graph, rules, m_Edited.roots);
  }

  /** Each branch belongs to the axis that runs along it. */
  void
  FindOwners()
  {
    const RootSteps steps(m_Edited.roots);
    m_Edited.roots.leftOut.resize(m_Edited.roots.rootOf.size(), LeftOut::No);
    for (std::size_t branch = 0; branch < m_Edited.roots.rootOf.size(); ++branch)
    {
      ElementIndex &     root = m_Edited.roots.rootOf[branch];
      LeftOut &          why = m_Edited.roots.leftOut[branch];
      const ElementIndex owner = steps.OwnerOf(m_Graph.Branch(branch));
      root = root != kNoRoot ? owner : kNoRoot;
      why = owner == kNoRoot && why == LeftOut::No ? LeftOut::Removed : why;
    }
  }

  const SkeletonGraph &     m_Graph;
  EditedRoots               m_Edited;
  std::vector<RootAxis> &   m_Axes;
  std::vector<ElementIndex> m_Is; ///< the axis that each is part of now
  std::vector<char>         m_IsGone;
};

} // namespace

std::string
RootEditText(const RootEdit & edit)
{
  for (const auto & [kind, word] : kWords)
  {
    if (kind == edit.kind)
    {
      return word + (edit.other == kNoRoot ? std::string() : std::to_string(edit.other));
    }
  }
  return {};
}

RootEdit
ParseRootEdit(const std::string & text)
{
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos)
  {
    return {};
  }
  const std::string plain = text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
  for (const auto & [kind, word] : kWords)
  {
    const std::string_view start(word);
    if (!start.ends_with(' ') && plain == start)
    {
      return { 0, kind };
    }
    if (start.ends_with(' ') && plain.starts_with(start))
    {
      RootEdit           edit{ 0, kind };
      const char * const end = plain.data() + plain.size();
      const char * const from = plain.data() + std::min(plain.find_first_not_of(' ', start.size()), plain.size());
      const auto [at, error] = from_chars(from, end, edit.other);
      if (error == std::errc() && at == end && edit.other != kNoRoot)
      {
        return edit;
      }
    }
  }
  throw UsageError("'" + plain + "' is no edit; expected remove, parent N, continues N or stem");
}

EditedRoots
EditRoots(const SkeletonGraph &     graph,
          const RootHierarchy &     roots,
          std::span<const RootEdit> edits,
          const RootRules &         rules)
{
  return Editor(graph, roots).Run(edits, rules);
}

} // namespace voxelcore
