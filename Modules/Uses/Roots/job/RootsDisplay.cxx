#include "RootsDisplay.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Display/HtmlPage.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/Display/RenderPicture.h"
#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace voxelcore
{

namespace
{

/** Turns places so that `up` becomes the third axis. */
class Upright
{
public:
  explicit Upright(const Vector3 & up)
    : m_Z(up)
  {
    const Vector3 side = std::abs(up[0]) < 0.9 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 };
    m_X = AddScaled(side, -Dot(side, up), up);
    m_X = AddScaled({ 0, 0, 0 }, 1 / Length(m_X), m_X);
    m_Y = Cross(m_Z, m_X);
  }

  Vector3
  operator()(const Vector3 & place) const
  {
    return { Dot(place, m_X), Dot(place, m_Y), Dot(place, m_Z) };
  }

  /** The axes of the turned space. */
  std::array<Vector3, 3>
  Axes() const
  {
    return { m_X, m_Y, m_Z };
  }

private:
  Vector3 m_X{};
  Vector3 m_Y{};
  Vector3 m_Z{};
};

constexpr std::int32_t kMostLevels = 8; // with a colour of their own; the last is for more, too
constexpr Color        kStemColor{ 0.2, 0.14, 0.1 };
constexpr std::size_t  kEvenOver = 3; // points to each side over which shown radii are evened out

/** The point from which a root is drawn: not on its parent's axis, where its tube would show through the parent's. */
std::size_t
FirstShown(const RootModel & model, const RootAxis & axis)
{
  if (axis.parent == kNoRoot)
  {
    return 0;
  }
  const ElementIndex origin = model.roots.axes[axis.parent].points[axis.parentPoint];
  const double       inside = 0.3 * SectionRadii(model.graph)[origin];
  std::size_t        first = 0;
  while (first + 2 < axis.points.size() &&
         Distance(model.graph.positions[axis.points[first]], model.graph.positions[origin]) < inside)
  {
    ++first;
  }
  return first;
}

/** The radii that are drawn, from a point on: evened out, and within the parent no greater than where it leaves it. */
std::vector<double>
ShownRadii(const RootModel & model, const RootAxis & axis, std::size_t first)
{
  std::vector<double> radii;
  for (std::size_t i = first; i < axis.points.size(); ++i)
  {
    const std::size_t from = i < first + kEvenOver ? first : i - kEvenOver;
    const std::size_t to = std::min(i + kEvenOver, axis.points.size() - 1);
    double            sum = 0;
    for (std::size_t k = from; k <= to; ++k)
    {
      sum += SectionRadii(model.graph)[axis.points[k]];
    }
    radii.push_back(sum / static_cast<double>(to - from + 1));
  }
  if (axis.parent == kNoRoot)
  {
    return radii;
  }
  const RootAxis & parent = model.roots.axes[axis.parent];
  for (std::size_t i = radii.size(); i-- > 0;)
  {
    const Vector3 &    place = model.graph.positions[axis.points[first + i]];
    const ElementIndex nearest =
      ranges::min(parent.points, {}, [&](ElementIndex point) { return Distance(place, model.graph.positions[point]); });
    if (i + 1 < radii.size() && Distance(place, model.graph.positions[nearest]) < SectionRadii(model.graph)[nearest])
    {
      radii[i] = std::min(radii[i], radii[i + 1]);
    }
  }
  return radii;
}

/** What stands under the pointer. */
std::string
RootWords(const RootModel & model, std::size_t number)
{
  const RootAxis &   axis = model.roots.axes[number];
  const RootRecord & record = model.traits.roots[number];
  const LengthUnit   unit = LengthUnit::For(model.traits.depth, model.unit);
  return "root " + std::to_string(number) +
         (axis.parent == kNoRoot ? std::string() : " of " + std::to_string(axis.parent)) + ", " +
         unit.Text(record.length) + " " + unit.Name() + " long, " + unit.Text(record.meanDiameter) + " " + unit.Name() +
         " thick";
}

/** A label per level, with its roots as curves, and one with the surface of all. */
DisplayContent
ContentOf(const RootModel & model, const VoxelShape & shape, const ImageGeometry & geometry)
{
  const Upright                        turn(model.roots.up);
  DisplayContent                       content;
  std::map<std::int32_t, DisplayLabel> levels;
  for (std::size_t number = 0; number < model.roots.axes.size(); ++number)
  {
    const RootAxis & axis = model.roots.axes[number];
    const auto       level = std::min(axis.level, kMostLevels);
    DisplayLabel &   label = levels[level];
    label.label = level;
    label.name = level == 0 ? std::string("stem") : "level " + std::to_string(level);
    label.name += level == kMostLevels ? " and more" : "";
    SkeletonGraph & curves = label.curves;
    label.curveNames.push_back(RootWords(model, number));
    const std::size_t         first = FirstShown(model, axis);
    const std::vector<double> radii = ShownRadii(model, axis, first);
    for (std::size_t i = first; i < axis.points.size(); ++i)
    {
      const ElementIndex point = axis.points[i];
      curves.branchPoints.push_back(static_cast<ElementIndex>(curves.positions.size()));
      curves.positions.push_back(turn(model.graph.positions[point]));
      curves.radius.push_back(radii[i - first]);
      curves.erosionThickness.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    for (const ElementIndex point :
         { static_cast<ElementIndex>(curves.branchOffsets.back()), curves.branchPoints.back() })
    {
      curves.nodePoints.push_back(point);
      curves.nodeKinds.push_back(NodeKind::Tip);
    }
    curves.branchOffsets.push_back(curves.branchPoints.size());
    const auto nodes = static_cast<ElementIndex>(curves.nodePoints.size());
    curves.branchNodes.push_back({ nodes - 2, nodes - 1 });
  }
  for (auto & [level, label] : levels)
  {
    const double last = std::max(2, levels.rbegin()->first - 1);
    label.color = level == 0 ? kStemColor : LengthColor((level - 1) / last);
    content.labels.push_back(std::move(label));
  }
  DisplayLabel surface;
  surface.label = static_cast<std::int64_t>(levels.size());
  surface.name = "surface";
  surface.color = { 0.75, 0.72, 0.65 };
  surface.surface = LabelSurface(shape, geometry);
  for (auto & point : surface.surface.points)
  {
    const Vector3 turned = turn({ point[0], point[1], point[2] });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<float>(turned[axis]);
    }
  }
  content.labels.push_back(std::move(surface));
  content.unit = model.unit;
  return content;
}

} // namespace

bool
DrawsRoots()
{
  return HasHtml();
}

void
DrawRoots(const RootModel &        model,
          const VoxelShape &       shape,
          const ImageGeometry &    geometry,
          const RootsOptions &     options,
          OutputTransaction &      transaction,
          const ProgressCallback & progress)
{
  const DisplayContent content = ContentOf(model, shape, geometry);
  PictureOptions       picture;
  picture.view = PictureView::Front;
  picture.coloring = PictureColoring::Label;
  picture.tubes = 0.6;
  picture.shrink = true;
  picture.anatomical = false;
  picture.title = model.name;
  RenderPictures(
    content,
    picture,
    [&](int, const Picture & drawn) { WritePng(transaction.Stage(options.Place("roots.png")), drawn); },
    PartOfProgress(progress, 0, 0.5));
  HtmlOptions page;
  page.title = "Roots of " + model.name;
  page.byLabel = true;
  page.axes = Upright(model.roots.up).Axes();
  page.groups = "Level";
  page.figures = RootsFigures(model);
  page.triangles = options.htmlTriangles;
  page.anatomical = false;
  WriteHtml(transaction.Stage(options.Place("roots.html")), content, page, PartOfProgress(progress, 0.5, 1));
}

} // namespace voxelcore
