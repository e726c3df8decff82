#include "RootsApart.h"

#include "voxelcore/Jobs/JobTools.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Masks/DepthSimplification.h"
#include "voxelcore/Roots/RootCentring.h"
#include "voxelcore/Roots/RootContacts.h"
#include "voxelcore/Roots/RootRoughness.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr int kMostRounds = 4;

/** How far numbers are from those asked for, or from one piece and nothing else. */
std::int64_t
Excess(const TopologyNumbers & numbers, const TopologyRequest & request)
{
  const auto & [pieces, loops, cavities] = numbers.betti;
  if (!request.IsGiven())
  {
    return pieces + loops + cavities - 1;
  }
  return std::abs(pieces - request.pieces.value_or(pieces)) + std::abs(loops - request.loops.value_or(loops)) +
         std::abs(cavities - request.cavities.value_or(cavities));
}

bool
Has(const TopologyNumbers & numbers, const TopologyRequest & request)
{
  return Excess(numbers, request) == 0;
}

SkeletonGraph
SkeletonOfMask(const LabelShape &              mask,
               const ImageGeometry &           geometry,
               const std::optional<VoxelBox> & scan,
               const CoreOptions &             core,
               const ProgressCallback &        progress)
{
  CertifiedRequest request;
  request.name = LabelText(mask.value, mask.name);
  request.skeleton = core.skeleton;
  request.scan = scan;
  request.lambdas = { core.skeleton->lambda };
  request.spendsCores = true;
  request.engine = core.engine;
  CertifiedResult result = ComputeCertified(mask.shape, geometry, request, progress);
  return std::move(result.skeleton->skeleton.graph);
}

constexpr double kCostOfLevel = 4096; ///< from the shape's level to the background's, or to the bright voxels'

/** What a change costs by grey values: in a wall a small part of what it costs elsewhere. */
class GreyCost
{
public:
  GreyCost(const VoxelShape & shape, const BandValues & values, const GreyLevels & levels)
    : m_Shape(shape)
    , m_Values(values)
    , m_Levels(levels)
  {}

  /** How far the value is from the shape's level, 1 for the background and for bright voxels. Filled on purpose: as
   *  bright as can be; taken out: as dark. */
  double
  operator()(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const double value = m_Values.At(x, y, z);
    const bool   isIn = m_Shape.Contains(x, y, z);
    if (isIn != (value >= m_Levels.shape))
    {
      return 2;
    }
    const double range = isIn ? m_Levels.bright - m_Levels.shape : m_Levels.shape - m_Levels.background;
    return range > 0 ? std::min(2.0, std::abs(value - m_Levels.shape) / range) : 1;
  }

private:
  const VoxelShape & m_Shape;
  const BandValues & m_Values;
  const GreyLevels & m_Levels;
};

/** The values near the mask, which is in its frame; none where there is no grey scan. */
std::optional<BandValues>
ReadBand(const CoreOptions & core, const BodyFrame & frame, VoxelShape around, const ProgressCallback & progress)
{
  if (!core.reading.threshold || core.resolution || IsMeshFile(core.scan))
  {
    return std::nullopt;
  }
  BandValues values(std::move(around));
  VisitGreyRows(
    core.scan,
    frame.Leave(values.Band().Box()),
    core.reading,
    [&](std::int32_t y, std::int32_t z, std::span<const float> row) {
      values.SetRow(y - frame.Lower()[1], z - frame.Lower()[2], row);
    },
    progress);
  return values;
}

double
MedianOf(std::vector<float> values, double otherwise)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.empty() ? otherwise : *middle;
}

void
CentreByValues(const ImageGeometry & geometry,
               const CoreOptions &   core,
               const BandValues &    values,
               const RootHierarchy & roots,
               SkeletonGraph &       graph)
{
  if (std::isfinite(core.reading.threshold->second))
  {
    return; // what is brighter is no root
  }
  const double       level = core.reading.threshold->first;
  std::vector<float> dark;
  std::vector<float> bright;
  for (const float value : values.All())
  {
    (value < level ? dark : bright).push_back(value);
  }
  const double background = MedianOf(std::move(dark), level);
  const double root = MedianOf(std::move(bright), level);
  if (root > background)
  {
    CentreRoots(graph, roots, geometry, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      return values.Band().Contains(x, y, z) ? (values.At(x, y, z) - background) / (root - background) : 0.0;
    });
  }
}

/** The roots by directions of curves that lie where values say that the middle of roots is; the graph is as before. */
RootHierarchy
RootsByValues(const ImageGeometry &             geometry,
              const CoreOptions &               core,
              const std::optional<BandValues> & values,
              const RootRules &                 rules,
              const SkeletonGraph &             graph,
              const RootBulges &                bulges)
{
  RootHierarchy roots = FindRoots(graph, rules);
  if (values)
  {
    SkeletonGraph centred = graph;
    CentreByValues(geometry, core, *values, roots, centred);
    roots = FindRoots(centred, rules);
  }
  roots.bulges = bulges;
  return roots;
}

RootRules
InFrame(RootRules rules, const BodyFrame & frame)
{
  frame.Enter(rules.stem);
  return rules;
}

/** Back to the scan, with what was found. */
void
LeaveFrame(const BodyFrame & frame, SkeletonGraph & graph, RootHierarchy & roots)
{
  frame.Leave(graph.positions);
  frame.Leave(graph.medial);
  for (RootMeeting & meeting : roots.meetings)
  {
    meeting.position = frame.Leave(meeting.position);
  }
  for (RootWhorl & whorl : roots.whorls)
  {
    whorl.position = frame.Leave(whorl.position);
  }
}

/** One cut or fill with its voxels as runs, both in the scan. */
RootsChange
ChangeOf(const TopologyChange & change, const ImageGeometry & scan, const BodyFrame & frame)
{
  const auto & at = change.centre;
  RootsChange  one{ { change.isFill,
                      LatticeToPhysical(scan, frame.LeaveLattice({ at[0] + 0.5, at[1] + 0.5, at[2] + 0.5 })),
                      change.voxels,
                      0,
                      change.difference },
                   {} };
  for (const auto & inFrame : change.where)
  {
    const auto       voxel = frame.Leave(VoxelBox{ inFrame, { 1, 1, 1 } }).lower;
    VoxelRun * const last = one.runs.empty() ? nullptr : &one.runs.back();
    if (last != nullptr && last->first[1] == voxel[1] && last->first[2] == voxel[2] &&
        last->first[0] + last->length == voxel[0])
    {
      ++last->length;
    }
    else
    {
      one.runs.push_back({ change.isFill, voxel, 1 });
    }
  }
  return one;
}

} // namespace

std::optional<RootsTopology>
TellRootsApart(LabelShape &             mask,
               const ImageGeometry &    scan,
               const CoreOptions &      core,
               const RootRules &        inScan,
               const ApartRequest &     request,
               RootEditing &            editing,
               const ProgressCallback & progress)
{
  const TopologyNumbers numbers = ComputeShapeTopology(mask.shape);
  if (Has(numbers, request.topology))
  {
    return std::nullopt;
  }
  const VoxelShape      whole = CropToVoxels(std::move(mask.shape));
  const BodyFrame       frame(scan, whole.Box());
  const ImageGeometry & geometry = frame.Geometry();
  const RootRules       rules = InFrame(inScan, frame);
  const auto            border = request.scan ? std::optional(frame.Enter(*request.scan)) : std::nullopt;
  mask.shape = MovedTo({ 0, 0, 0 }, whole);
  SkeletonGraph     graph = SkeletonOfMask(mask, geometry, border, core, PartOfProgress(progress, 0, 0.5));
  const RootBulges  bulges = LeaveOutBulges(mask.shape, geometry, rules, graph);
  auto              torn = JoinTornRoots(graph, rules);
  const LatticeBall ball = BallOfDepth(request.depth, geometry);
  RootsTopology     topology;
  VoxelShape        kernel(mask.shape.Box());
  VoxelShape        neighbourhood = VoxelsAround(mask.shape, ball);
  const auto        values = ReadBand(core, frame, neighbourhood, PartOfProgress(progress, 0.5, 0.6));
  RootHierarchy     roots = RootsByValues(geometry, core, values, rules, graph, bulges);
  if (numbers.betti[0] == 1)
  {
    roots = editing(graph, roots, frame);
  }
  const VoxelShape walls = ContactWalls(mask.shape, geometry, graph, roots);
  ChangeCost       inVoxels = DepthCost(mask.shape, ball);
  // Of a change in a wall, of another; and that which is reported.
  std::function<double(std::int32_t, std::int32_t, std::int32_t)> cost =
    [&](std::int32_t x, std::int32_t y, std::int32_t z) { return inVoxels(x, y, z) / kCostOfOneVoxel; };
  if (values)
  {
    const double level = core.reading.threshold->first;
    topology.levels = ProposeLevels(mask.shape, *values, level);
    topology.levels->neighbourhood = request.neighbourhood.value_or(topology.levels->neighbourhood);
    if (topology.levels->neighbourhood > level || request.kernel.value_or(level) < level)
    {
      throw UsageError("--neighborhood must be at most the threshold, " + Number(level) + ", and --kernel at least");
    }
    neighbourhood = AtLeast(mask.shape, *values, level, topology.levels->neighbourhood);
    if (request.kernel)
    {
      topology.levels->kernel = *request.kernel;
      kernel = AtLeast(mask.shape, *values, level, *request.kernel);
    }
    cost = GreyCost(mask.shape, *values, *topology.levels);
  }
  const ChangeCost guided = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const auto by = static_cast<std::uint32_t>(std::min(8.0, cost(x, y, z)) * kCostOfLevel);
    return walls.Contains(x, y, z) ? 1 + by / 16 : static_cast<std::uint32_t>(kCostOfLevel) + by;
  };
  SimplifiedShape simplified =
    SimplifyTopology(kernel, mask.shape, neighbourhood, guided, request.topology, PartOfProgress(progress, 0.6, 0.9));
  // What great clusters of cuts and fills have left may go when it is looked at by itself.
  for (int round = 1; round < kMostRounds && !Has(simplified.after, request.topology); ++round)
  {
    SimplifiedShape again = SimplifyTopology(kernel,
                                             simplified.shape,
                                             neighbourhood,
                                             guided,
                                             request.topology,
                                             PartOfProgress(progress, 0.9, 1));
    if (Excess(again.after, request.topology) >= Excess(simplified.after, request.topology))
    {
      break;
    }
    again.before = simplified.before;
    again.changes.insert(again.changes.end(), simplified.changes.begin(), simplified.changes.end());
    simplified = std::move(again);
  }
  topology.before = simplified.before;
  topology.after = simplified.after;
  topology.asAsked = Has(simplified.after, request.topology);
  if (!topology.asAsked)
  {
    topology.reason = "with all that may be filled, there are " + CountsText(ComputeShapeTopology(neighbourhood)) +
                      (request.kernel ? "; what is never cut has " + CountsText(ComputeShapeTopology(kernel)) : "");
  }
  for (const TopologyChange & change : simplified.changes)
  {
    RootsChange one = ChangeOf(change, scan, frame);
    one.brightest = -std::numeric_limits<double>::infinity();
    one.darkest = std::numeric_limits<double>::infinity();
    for (const auto & at : change.where)
    {
      one.cost += cost(at[0], at[1], at[2]);
      if (values)
      {
        one.brightest = std::max<double>(one.brightest, values->At(at[0], at[1], at[2]));
        one.darkest = std::min<double>(one.darkest, values->At(at[0], at[1], at[2]));
      }
    }
    if (values && !change.isFill && one.brightest >= topology.levels->kernel)
    {
      topology.levels->kernel = std::nextafter(one.brightest, std::numeric_limits<double>::infinity());
    }
    ++(change.isFill ? topology.fills : topology.cuts);
    (change.isFill ? topology.voxelsAdded : topology.voxelsRemoved) += change.voxels;
    topology.parts.push_back(std::move(one));
  }
  ranges::stable_sort(topology.parts, ranges::greater{}, &RootsChange::cost);
  if (values)
  {
    CentreByValues(geometry, core, *values, roots, graph);
  }
  LeaveFrame(frame, graph, roots);
  topology.graph = std::move(graph);
  topology.roots = std::move(roots);
  topology.torn = std::move(torn);
  mask.shape = MovedTo(frame.Leave(simplified.shape.Box()).lower, simplified.shape);
  topology.changes = ChangesBetween(whole, mask.shape);
  mask.voxels = mask.shape.CountVoxels();
  return topology;
}

RootHierarchy
FindRootsByGrey(const VoxelShape &    mask,
                const ImageGeometry & scan,
                const CoreOptions &   core,
                const RootRules &     inScan,
                const GapWidth &      depth,
                RootEditing &         editing,
                SkeletonGraph &       graph,
                std::vector<double> & torn)
{
  const VoxelShape      whole = CropToVoxels(mask);
  const BodyFrame       frame(scan, whole.Box());
  const ImageGeometry & geometry = frame.Geometry();
  const RootRules       rules = InFrame(inScan, frame);
  frame.Enter(graph.positions);
  frame.Enter(graph.medial);
  const VoxelShape body = MovedTo({ 0, 0, 0 }, whole);
  const RootBulges bulges = LeaveOutBulges(body, geometry, rules, graph);
  torn = JoinTornRoots(graph, rules);
  const auto    values = ReadBand(core, frame, VoxelsAround(body, BallOfDepth(depth, geometry)), {});
  RootHierarchy roots = editing(graph, RootsByValues(geometry, core, values, rules, graph, bulges), frame);
  if (values)
  {
    CentreByValues(geometry, core, *values, roots, graph);
  }
  LeaveFrame(frame, graph, roots);
  return roots;
}

std::string
RootChangesText(const std::optional<RootsTopology> & topology, SpatialUnit unit)
{
  std::string text =
    "# Cuts (-) and fills (+) that made the mask, voxels I,J,K from 0, xN for N along I.\n"
    "# Take out a cut that you do not want, add your own, and give the file to --change-voxels.\n";
  if (!topology)
  {
    return text + "# Nothing was cut or filled.\n";
  }
  const std::string name = unit == SpatialUnit::Millimetres ? "mm" : "voxels";
  for (const RootsChange & change : topology->parts)
  {
    text += "\n# " + std::string(change.isFill ? "fill" : "cut") + " at " + Number(change.centre[0]) + ", " +
            Number(change.centre[1]) + ", " + Number(change.centre[2]) + " " + name + ": " +
            Counted(change.voxels, "voxel", "voxels") + ", cost " + Number(change.cost) + "\n" +
            VoxelChangesText(change.runs) + "\n";
  }
  return text;
}

namespace
{

/** Up to where cuts went, or where they had to end. */
std::string
KernelText(const RootsTopology & topology)
{
  double brightest = -std::numeric_limits<double>::infinity();
  for (const RootsChange & change : topology.parts)
  {
    brightest = change.isFill ? brightest : std::max(brightest, change.brightest);
  }
  return topology.levels->kernel == std::nextafter(brightest, std::numeric_limits<double>::infinity())
           ? "nothing cut above " + Number(brightest)
           : "nothing cut from " + Number(topology.levels->kernel) + " on";
}

} // namespace

std::string
RootsTopologyText(const RootsTopology & topology)
{
  return CountsText(topology.before) + " became " + CountsText(topology.after) + " by " +
         Counted(topology.cuts, "cut", "cuts") + " of " + Counted(topology.voxelsRemoved, "voxel", "voxels") + " and " +
         Counted(topology.fills, "fill", "fills") + " of " + std::to_string(topology.voxelsAdded) +
         (topology.levels ? "; levels: shape " + Number(topology.levels->shape) + " (Otsu near the boundary " +
                              Number(topology.levels->otsu) + ", valley " + Number(topology.levels->valley) + "), " +
                              KernelText(topology) + ", nothing filled below " + Number(topology.levels->neighbourhood)
                          : "") +
         (topology.asAsked ? "" : "; not what was asked: " + topology.reason);
}

} // namespace voxelcore
