#include "voxelcore/Vessels/VesselLesions.h"

#include "HealthyCalibre.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/DomeBranches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kLeastDegree = 0.2; // sections of healthy tubes are off by a tenth in thick slices
constexpr double kLeastScatters = 3;
constexpr double kIll = 0.1; // where a lesion begins and ends

/** A branch as its points, those that tell its diameter. */
struct Calibres
{
  CalibreAlong                  along;
  std::vector<Vector3>          places;
  std::vector<std::uint8_t>     isFirst; ///< whether points before it do not tell
  std::optional<HealthyCalibre> healthy;
  double                        length = 0;
};

bool
TellsCalibre(const BranchSection & section)
{
  return std::isfinite(section.area) && section.runsInto == kNoBranch && !section.isCut;
}

/** `sections` of this branch. A point tells its diameter when the sections before and behind it do, and no dome is
 *  beside it: that is, its ball and those of domes are apart, by `diagonal` as balls in voxels are smaller. */
Calibres
CalibresOf(const SkeletonGraph &           graph,
           std::size_t                     branch,
           std::span<const BranchSection>  sections,
           const std::vector<DomeBranch> & domes,
           double                          diagonal)
{
  Calibres                    of;
  const auto                  points = graph.Branch(branch);
  const std::vector<double> & radius = SectionRadii(graph);
  bool                        isFirst = true;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector3 & place = graph.positions[points[i]];
    of.length += i > 0 ? Distance(place, graph.positions[points[i - 1]]) : 0;
    const auto behind = ranges::lower_bound(sections, of.length, {}, &BranchSection::arc);
    const bool isBesideDome = ranges::any_of(domes, [&](const DomeBranch & dome) {
      return Distance(place, graph.positions[dome.greatest]) <
             graph.radius[dome.greatest] + graph.radius[points[i]] + diagonal;
    });
    const bool tells = !isBesideDome && (behind == sections.end() || TellsCalibre(*behind)) &&
                       (behind == sections.begin() || TellsCalibre(*std::prev(behind)));
    if (tells && radius[points[i]] > 0)
    {
      of.along.arc.push_back(of.length);
      of.along.diameter.push_back(2 * radius[points[i]]);
      of.places.push_back(place);
      of.isFirst.push_back(isFirst ? 1 : 0);
    }
    isFirst = !tells;
  }
  of.healthy = FitHealthyCalibre(of.along);
  return of;
}

/** The stenoses, or the bulges, of one branch. */
class LesionsAlong
{
public:
  LesionsAlong(const SkeletonGraph &           graph,
               std::size_t                     branch,
               const Calibres &                calibres,
               const std::vector<DomeBranch> & domes)
    : m_Graph(graph)
    , m_Branch(branch)
    , m_Calibres(calibres)
    , m_Domes(domes)
  {}

  void
  Find(LesionKind kind, std::vector<VesselLesion> & lesions) const
  {
    const std::size_t count = m_Calibres.places.size();
    for (std::size_t first = 0; first < count;)
    {
      std::size_t end = first;
      std::size_t most = first;
      while (end < count && Degree(kind, end) >= kIll && (end == first || m_Calibres.isFirst[end] == 0))
      {
        most = Degree(kind, end) > Degree(kind, most) ? end : most;
        ++end;
      }
      if (end > first && IsLesion(kind, most) && GoesOn(kind, first, end))
      {
        lesions.push_back(Lesion(kind, first, most, end - 1));
      }
      first = std::max(end, first + 1);
    }
  }

private:
  double
  Reference(std::size_t i) const
  {
    return m_Calibres.healthy->At(m_Calibres.along.arc[i]);
  }

  double
  Degree(LesionKind kind, std::size_t i) const
  {
    const double over = m_Calibres.along.diameter[i] / Reference(i) - 1;
    return kind == LesionKind::Stenosis ? -over : over;
  }

  bool
  IsLesion(LesionKind kind, std::size_t i) const
  {
    return Degree(kind, i) >= std::max(kLeastDegree, kLeastScatters * m_Calibres.healthy->scatter / Reference(i));
  }

  /** Whether the vessel goes on beyond both ends. Where nothing is known of it up to a junction, it does for stenoses,
   *  as those at the origin of a branch are frequent. Beside a dome the diameter is not sure. */
  bool
  GoesOn(LesionKind kind, std::size_t first, std::size_t end) const
  {
    const auto leadsOn = [&](std::size_t side) {
      const ElementIndex node = m_Graph.branchNodes[m_Branch][side];
      return kind == LesionKind::Stenosis && m_Graph.nodeKinds[node] != NodeKind::Tip &&
             ranges::find(m_Domes, node, &DomeBranch::node) == m_Domes.end();
    };
    const std::size_t count = m_Calibres.places.size();
    return (first > 0 ? m_Calibres.isFirst[first] == 0 : leadsOn(0)) &&
           (end < count ? m_Calibres.isFirst[end] == 0 : leadsOn(1));
  }

  VesselLesion
  Lesion(LesionKind kind, std::size_t first, std::size_t most, std::size_t last) const
  {
    VesselLesion lesion;
    lesion.kind = kind;
    lesion.branch = static_cast<ElementIndex>(m_Branch);
    lesion.arc = m_Calibres.along.arc[most];
    lesion.begin = m_Calibres.along.arc[first];
    lesion.end = m_Calibres.along.arc[last];
    lesion.place = m_Calibres.places[most];
    lesion.diameter = m_Calibres.along.diameter[most];
    lesion.reference = Reference(most);
    return lesion;
  }

  const SkeletonGraph & m_Graph;
  std::size_t           m_Branch;
  const Calibres &      m_Calibres;

  const std::vector<DomeBranch> & m_Domes;
};

/** The body beyond planes at right angles to an axis: of each plane what hangs together with the middle of a dome's
 *  greatest ball. Planes go down from there to the dome's foot, on the vessel, or to where the vessel begins. */
class DomeLayers
{
public:
  /** The first place of `vessel` is the foot. */
  DomeLayers(const SectionBody &          body,
             const std::vector<Vector3> & vessel,
             const Vector3 &              middle,
             double                       radius,
             const Vector3 &              axis)
    : m_Shape(body.shape)
    , m_Seen(body.shape->Box())
    , m_VoxelVolume(body.geometry.spacing[0] * body.geometry.spacing[1] * body.geometry.spacing[2])
  {
    // Of a lattice place p the height over the foot is slope . p - atFoot, in mm.
    const ImageGeometry & geometry = body.geometry;
    const Vector3         zero = LatticeToPhysical(geometry, { 0, 0, 0 });
    for (std::size_t k = 0; k < 3; ++k)
    {
      Vector3 unit{};
      unit[k] = 1;
      m_Slope[k] = Dot(Minus(LatticeToPhysical(geometry, unit), zero), axis);
      m_Thick = std::max(m_Thick, std::abs(m_Slope[k]));
      m_Corner += 0.5 * std::abs(m_Slope[k]);
    }
    m_AtFoot = Dot(Minus(vessel.front(), zero), axis);
    m_Middle = Dot(Minus(middle, vessel.front()), axis);
    for (const Vector3 & place : vessel)
    {
      m_Vessel = std::max(m_Vessel, Dot(Minus(place, vessel.front()), axis));
    }
    // Where a layer holds so much more than the dome's greatest one, it is of the vessel.
    const double most = kVesselInSections * std::numbers::pi * radius * radius * m_Thick / m_VoxelVolume;
    Flood(PhysicalToLattice(geometry, middle), most);
  }

  /** Area of the layer around a plane at this height, mm^2. */
  double
  Area(double height) const
  {
    return (Volume(height - 0.5 * m_Thick) - Volume(height + 0.5 * m_Thick)) / m_Thick;
  }

  /** Of what is beyond a plane, mm^3. */
  double
  Volume(double height) const
  {
    const auto end = ranges::upper_bound(m_Levels, height, ranges::greater());
    return static_cast<double>(end - m_Levels.begin()) * m_VoxelVolume;
  }

  /** Height of the least layer below the middle. */
  double
  Neck() const
  {
    return Best([&](double a, double b) { return a < b; }, m_Levels.back() + 0.5 * m_Thick, m_Middle);
  }

  /** Height of the greatest layer beyond a plane. */
  double
  Widest(double neck) const
  {
    return Best([&](double a, double b) { return a > b; }, neck, m_Top);
  }

  /** Height of the farthest point. */
  double
  Top() const
  {
    return m_Top;
  }

private:
  static constexpr double kVesselInSections = 3;
  static constexpr double kStepsInLayer = 4;
  static constexpr double kRounding = 1e-6; // of a voxel: the middle may lie between two

  using Voxel = std::array<std::int32_t, 3>;

  template <typename IsBetter>
  double
  Best(const IsBetter & isBetter, double from, double to) const
  {
    double best = to;
    for (double step = 0; to - step * m_Thick / kStepsInLayer >= from; ++step)
    {
      const double height = to - step * m_Thick / kStepsInLayer;
      best = isBetter(Area(height), Area(best)) ? height : best;
    }
    return best;
  }

  /** The highest voxels that are reached first. */
  void
  Flood(const Vector3 & from, double most)
  {
    std::priority_queue<std::pair<double, Voxel>> next;
    const auto                                    add = [&](const Voxel & v) {
      if (m_Shape->Contains(v[0], v[1], v[2]) && !m_Seen.Contains(v[0], v[1], v[2]))
      {
        m_Seen.Insert(v[0], v[1], v[2]);
        next.emplace(Dot(m_Slope, { v[0] + 0.5, v[1] + 0.5, v[2] + 0.5 }) - m_AtFoot, v);
      }
    };
    const auto voxel = [](double at) { return static_cast<std::int32_t>(std::floor(at)); };
    for (const double beside : { -kRounding, kRounding })
    {
      add({ voxel(from[0] + beside), voxel(from[1] + beside), voxel(from[2] + beside) });
    }
    // The first voxel may be lower by a part of a voxel.
    m_Middle = std::min(m_Middle, next.top().first);
    double level = m_Middle;
    while (!next.empty())
    {
      const auto [height, at] = next.top();
      next.pop();
      if (height < level)
      {
        if (level == m_Middle)
        {
          ranges::sort(m_Levels, ranges::greater());
        }
        level = height;
        if (level < m_Vessel || static_cast<double>(m_Levels.size()) - Volume(level + m_Thick) / m_VoxelVolume > most)
        {
          break;
        }
      }
      m_Levels.push_back(level == m_Middle ? height : level);
      // A smooth surface lies between the middle of the last voxel and its corner.
      m_Top = std::max(m_Top, height + 0.5 * m_Corner);
      for (std::size_t k = 0; k < 3; ++k)
      {
        for (const std::int32_t step : { -1, 1 })
        {
          Voxel beside = at;
          beside[k] += step;
          add(beside);
        }
      }
    }
  }

  const VoxelShape *  m_Shape;
  VoxelShape          m_Seen;
  double              m_VoxelVolume;
  Vector3             m_Slope{};
  double              m_AtFoot = 0;
  double              m_Middle = 0;
  double              m_Vessel = 0; ///< greatest height of its line
  double              m_Thick = 0;  ///< of a layer: as far as voxels of a row along the grid are apart
  double              m_Corner = 0; ///< of a voxel, over its middle
  double              m_Top = 0;
  std::vector<double> m_Levels; ///< descending: of each voxel its height, or how low planes had gone
                                ///< when it was reached
};

/** What the branches of a vessel have at one of their nodes, but for one of them; NaN where none has a line. */
double
VesselAt(const SkeletonGraph & graph, const std::vector<Calibres> & calibres, ElementIndex node, std::size_t except)
{
  double sum = 0;
  double count = 0;
  for (std::size_t branch = 0; branch < calibres.size(); ++branch)
  {
    for (const std::size_t end : { 0U, 1U })
    {
      if (branch != except && graph.branchNodes[branch][end] == node && calibres[branch].healthy)
      {
        sum += calibres[branch].healthy->At(end == 0 ? 0 : calibres[branch].length);
        count += 1;
      }
    }
  }
  return sum / count;
}

/** The vessel's line as far from a dome's foot as the dome reaches, from the foot on. */
std::vector<Vector3>
VesselAround(const SkeletonGraph & graph, const DomeBranch & dome)
{
  const Vector3 &      foot = graph.positions[graph.nodePoints[dome.node]];
  const double         reach = Distance(graph.positions[dome.greatest], foot) + graph.radius[dome.greatest];
  std::vector<Vector3> vessel{ foot };
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto [first, last] = graph.branchNodes[branch];
    if (branch != dome.branch && (first == dome.node || last == dome.node))
    {
      for (const ElementIndex point : graph.Branch(branch))
      {
        if (Distance(graph.positions[point], foot) < reach)
        {
          vessel.push_back(graph.positions[point]);
        }
      }
    }
  }
  return vessel;
}

/** Unit length: the way from a dome's foot, where VesselAround() begins, to the middle of its greatest ball; where the
 *  vessel goes straight on past the foot, the part of that at right angles to the vessel. */
Vector3
AcrossVessel(const std::vector<Vector3> & vessel, const Vector3 & middle)
{
  const Vector3 & foot = vessel.front();
  const Vector3   way = Minus(middle, foot);
  // The two places farthest from each other, one of which is farthest from the foot.
  const Vector3 one = *ranges::max_element(vessel, {}, [&](const Vector3 & place) { return Distance(place, foot); });
  const Vector3 other = *ranges::max_element(vessel, {}, [&](const Vector3 & place) { return Distance(place, one); });
  const Vector3 chord = Minus(other, one);
  // Between two branches of a fork, domes continue the stem.
  constexpr double kStraight = 120;
  const bool       goesOn = AngleDegrees(Minus(one, foot), Minus(other, foot)) > kStraight;
  const Vector3    across = goesOn ? AddScaled(way, -Dot(way, chord) / Dot(chord, chord), chord) : way;
  return AddScaled({}, 1 / Length(across), across);
}

VesselLesion
MeasureDome(const SkeletonGraph & graph, const DomeBranch & dome, const SectionBody & body)
{
  const auto points = graph.Branch(dome.branch);
  const bool isForward = graph.branchNodes[dome.branch][0] == dome.node;
  // The branch from the vessel on.
  std::vector<Vector3> line;
  for (const ElementIndex point : points)
  {
    line.push_back(graph.positions[point]);
  }
  if (!isForward)
  {
    ranges::reverse(line);
  }
  const Vector3              foot = line.front();
  const Vector3              middle = graph.positions[dome.greatest];
  const std::vector<Vector3> vessel = VesselAround(graph, dome);
  const Vector3              axis = AcrossVessel(vessel, middle);
  const DomeLayers           layers(body, vessel, middle, graph.radius[dome.greatest], axis);
  const double               neck = layers.Neck();
  const auto   circle = [&](double height) { return 2 * std::sqrt(layers.Area(height) / std::numbers::pi); };
  VesselLesion lesion;
  lesion.kind = LesionKind::Dome;
  lesion.branch = static_cast<ElementIndex>(dome.branch);
  lesion.diameter = circle(layers.Widest(neck));
  lesion.neckWidth = circle(neck);
  lesion.height = layers.Top() - neck;
  lesion.volume = layers.Volume(neck);
  // Where the branch comes through the neck.
  const auto heightOf = [&](const Vector3 & place) { return Dot(Minus(place, foot), axis); };
  double     arc = 0;
  double     length = 0;
  bool       isBelow = true;
  lesion.place = foot;
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    const double step = Distance(line[i], line[i - 1]);
    if (isBelow && heightOf(line[i]) >= neck)
    {
      isBelow = false;
      const double from = heightOf(line[i - 1]);
      const double t = std::clamp((neck - from) / (heightOf(line[i]) - from), 0.0, 1.0);
      arc = length + t * step;
      lesion.place = AddScaled(line[i - 1], t, Minus(line[i], line[i - 1]));
    }
    length += step;
  }
  lesion.arc = isForward ? arc : length - arc;
  lesion.begin = isForward ? arc : 0;
  lesion.end = isForward ? length : length - arc;
  return lesion;
}

} // namespace

double
VesselLesion::DegreeByDiameter() const
{
  return kind == LesionKind::Dome ? kNone : std::abs(diameter / reference - 1);
}

double
VesselLesion::DegreeByArea() const
{
  const double ratio = diameter / reference;
  return kind == LesionKind::Dome ? kNone : std::abs(ratio * ratio - 1);
}

std::vector<VesselLesion>
FindLesions(const SkeletonGraph & graph, const std::vector<BranchSection> & sections, const SectionBody & body)
{
  const auto of = [&](std::size_t branch) {
    const auto range = ranges::equal_range(sections, static_cast<ElementIndex>(branch), {}, &BranchSection::branch);
    return std::span(sections).subspan(static_cast<std::size_t>(range.begin() - sections.begin()), range.size());
  };
  std::vector<DomeBranch> domes = DomesOf(graph);
  std::erase_if(domes, [&](const DomeBranch & dome) {
    return graph.radius[dome.greatest] < (1 + kLeastDegree) * graph.radius[graph.nodePoints[dome.node]];
  });
  std::vector<Calibres> calibres;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    calibres.push_back(CalibresOf(graph, branch, of(branch), domes, Length(body.geometry.spacing)));
  }
  std::vector<VesselLesion> lesions;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto dome = ranges::find(domes, branch, &DomeBranch::branch);
    const auto before = static_cast<std::ptrdiff_t>(lesions.size());
    if (dome != domes.end())
    {
      lesions.push_back(MeasureDome(graph, *dome, body));
      lesions.back().reference = VesselAt(graph, calibres, dome->node, branch);
    }
    else if (calibres[branch].healthy)
    {
      const LesionsAlong along(graph, branch, calibres[branch], domes);
      along.Find(LesionKind::Stenosis, lesions);
      along.Find(LesionKind::Bulge, lesions);
    }
    std::sort(lesions.begin() + before, lesions.end(), [](const VesselLesion & a, const VesselLesion & b) {
      return a.arc < b.arc;
    });
  }
  return lesions;
}

} // namespace voxelcore
