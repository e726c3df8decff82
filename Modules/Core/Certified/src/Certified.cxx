#include "voxelcore/Certified/Certified.h"

#include "CertifiedWork.h"
#include "CheckedLattice.h"
#include "Frames.h"
#include "RequestStages.h"
#include "SingleLayer.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** What a skeleton is made of: the body, as it goes on where the scan's border cuts it, and of a single layer its two
 *  halves. */
class BodyOfCurves
{
public:
  BodyOfCurves(const VoxelShape & shape, const ImageGeometry & geometry, const CertifiedRequest & request)
    : m_Geometry(geometry)
    , m_Box(shape.Box())
  {
    if (!request.skeleton)
    {
      return;
    }
    if (request.scan && request.skeleton->border != BorderEnds::Closed)
    {
      ExtendedShape extended = UpToBorder(shape, geometry, *request.scan, *request.skeleton);
      m_Sections = std::move(extended.sections);
      if (extended.shape.Box().size != shape.Box().size)
      {
        m_GoesOn = { *request.scan, shape.Box(), ComputeShapeTopology(shape), request.skeleton->border, m_Sections };
        m_Shape = std::move(extended.shape);
      }
    }
    // Cells and surfaces that others give are those of whole voxels.
    const auto layer = request.cells || RefinesCurves(request)
                         ? std::nullopt
                         : SingleLayer(m_GoesOn ? m_Shape : shape, geometry.spacing);
    if (layer)
    {
      m_Halved.emplace(*layer, geometry);
      m_Shape = m_Halved->Halve(m_GoesOn ? m_Shape : shape);
      if (m_GoesOn)
      {
        m_GoesOn = m_Halved->Halve(*m_GoesOn);
      }
    }
  }

  /** Whether it is not the body as it is. */
  bool
  IsAnother() const
  {
    return m_GoesOn || m_Halved;
  }

  /** The request must be for a skeleton, and nothing of the body as it is. */
  CertifiedResult
  Run(const CertifiedRequest & request, const ProgressCallback & progress)
  {
    const ImageGeometry & geometry = m_Halved ? m_Halved->Geometry() : m_Geometry;
    RequireTrueLattice(ComputeLatticeWeights(geometry), geometry, m_Shape.Box(), request.name);
    CertifiedResult result = RunCertified(std::move(m_Shape),
                                          geometry,
                                          m_Halved ? m_Halved->Halve(request) : request,
                                          progress,
                                          m_GoesOn ? &*m_GoesOn : nullptr);
    result.shape.box = m_Box;
    return result;
  }

  /** Where the scan's border cuts the body. */
  void
  Tell(CertifiedResult & result)
  {
    if (!m_Sections.empty())
    {
      result.skeleton->border = { std::move(m_Sections), result.skeleton->border ? result.skeleton->border->ends : 0 };
    }
  }

private:
  const ImageGeometry &       m_Geometry;
  VoxelBox                    m_Box;
  VoxelShape                  m_Shape; ///< where it is another
  std::vector<BorderSection>  m_Sections;
  std::optional<BeyondBorder> m_GoesOn;
  std::optional<HalvedLayer>  m_Halved;
};

CertifiedResult
RunOfBodies(VoxelShape               shape,
            const ImageGeometry &    geometry,
            const CertifiedRequest & request,
            const ProgressCallback & progress)
{
  BodyOfCurves    body(shape, geometry, request);
  CertifiedResult result;
  if (!body.IsAnother())
  {
    result = RunCertified(std::move(shape), geometry, request, progress);
  }
  else
  {
    CertifiedRequest curves = request;
    curves.refineCores = false;
    curves.thickness.reset();
    curves.spendsCores = true;
    if (request.spendsCores && !request.thickness)
    {
      result = body.Run(curves, progress);
    }
    else
    {
      CertifiedRequest within = request;
      within.skeleton.reset();
      StagePlan plan(progress, { 0.5, 0.5 });
      result = RunCertified(std::move(shape), geometry, within, plan.Next());
      CertifiedResult beyond = body.Run(curves, plan.Next());
      result.skeleton = std::move(beyond.skeleton);
      result.seconds.shape += beyond.seconds.shape;
      result.seconds.delaunay += beyond.seconds.delaunay;
      result.seconds.core += beyond.seconds.core;
      result.seconds.prune += beyond.seconds.prune;
      result.seconds.skeleton += beyond.seconds.skeleton;
    }
  }
  body.Tell(result);
  return result;
}

} // namespace

void
CompletePruning(std::vector<Lambda> & lambdas, std::vector<Tolerance> & tolerances)
{
  if (lambdas.empty() && tolerances.empty())
  {
    tolerances.push_back(ParseTolerance(kUsualTolerance));
  }
  if (lambdas.empty())
  {
    lambdas.emplace_back();
  }
}

bool
RefinesUsually(const std::vector<Tolerance> & tolerances)
{
  return !tolerances.empty() &&
         std::all_of(tolerances.begin(), tolerances.end(), [](const Tolerance & height) { return height.value > 0; });
}

void
RequireLengthsIn(SpatialUnit unit, const CertifiedRequest & request)
{
  for (const Lambda & lambda : request.lambdas)
  {
    RequireLengthIn(unit, lambda);
  }
  for (const Tolerance & height : request.tolerances)
  {
    RequireLengthIn(unit, height);
  }
  if (request.skeleton)
  {
    RequireLengthsIn(unit, *request.skeleton);
  }
}

CertifiedResult
ComputeCertified(VoxelShape               shape,
                 const ImageGeometry &    geometry,
                 const CertifiedRequest & request,
                 const ProgressCallback & progress)
{
  CertifiedRequest complete = CompleteRequest(request, geometry.spacing);
  if (!IsMapAlone(complete))
  {
    RequireDistinctPositions(geometry);
  }
  const ProgressCallback forward = ForwardOnly(progress);
  shape = CropToVoxels(std::move(shape));
  const BodyFrame frame(geometry, shape.Box());
  shape = MovedTo({ 0, 0, 0 }, shape);
  const RootChoice     root = complete.skeleton ? complete.skeleton->branches.root : RootChoice();
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  RequireTrueLattice(weights, geometry, frame.Leave(shape.Box()), request.name);
  RequireTrueLattice(weights, frame.Geometry(), shape.Box(), request.name);
  const CertifiedRequest there = InFrame(std::move(complete), frame, weights);
  CertifiedResult        result = RunOfBodies(std::move(shape), frame.Geometry(), there, forward);
  result.shape.box = frame.Leave(result.shape.box);
  result.shape.geometry = geometry;
  for (CertifiedCore & core : result.cores)
  {
    LeaveFrame(frame, core.core);
  }
  if (result.skeleton)
  {
    LeaveFrame(frame, root, *result.skeleton);
  }
  if (result.thickness)
  {
    LeaveFrame(frame, *result.thickness);
  }
  ReportProgress(forward, "done", 1);
  return result;
}

CoreOrigin
OriginOf(const CertifiedResult & result, std::int64_t label, std::string name, std::uint64_t voxels)
{
  return {
    label, std::move(name), voxels, result.shape.box, result.boundaryVertices, result.shape.topology, result.whole, true
  };
}

CorePruning
PruningOf(const CoreNumbers & numbers)
{
  CorePruning pruning{ numbers.lambda, numbers.lambdaMm, numbers.complex };
  if (numbers.tolerance)
  {
    pruning.tolerance = numbers.tolerance->height;
    pruning.toleranceMm = numbers.tolerance->heightMm;
  }
  if (numbers.refined)
  {
    pruning.refined = "labels";
    pruning.meanMove = numbers.refined->meanDisplacement;
    pruning.farthestMove = numbers.refined->maxDisplacement;
  }
  return pruning;
}

} // namespace voxelcore
