#include "voxelcore/Certified.h"

#include "CertificateText.h"
#include "CrossCheck.h"
#include "PruneStages.h"
#include "RefinedResults.h"
#include "RequestStages.h"
#include "voxelcore/BallCoverage.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/ParallelTasks.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/StagePlan.h"
#include "voxelcore/Stopwatch.h"
#include "voxelcore/Verification.h"
#include "voxelcore/VoxelCore.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

/** As ended in files: what never goes, and what would go beyond the scan's diagonal, has that height. */
void
EndTolerances(ToleranceValues & values, const ImageGeometry & geometry)
{
  const double end = ScanDiagonal(geometry);
  for (auto * one : { &values.vertices, &values.edges, &values.faces })
  {
    RunInParts(one->size() > 10000, one->size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        (*one)[i] = std::min((*one)[i], end);
      }
    });
  }
}

/** From the labels alone. */
SurfaceSource
UsualSurface(const CertifiedRequest & request, const Vector3 & spacing)
{
  if (!RefinesUsually(request.tolerances))
  {
    return {};
  }
  return [spacing](const VoxelShape & shape, const ProgressCallback & progress) {
    return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(shape, spacing, progress));
  };
}

/** Largest distance of a boundary vertex to the balls of a core, in mm. */
double
BoundaryGapOf(const PlacedCore & core, const VoxelShape & voxels, const ImageGeometry & geometry)
{
  std::vector<std::array<double, 3>> positions = core.core.positions;
  for (auto & position : positions)
  {
    position = PhysicalToLattice(geometry, position);
  }
  return LargestBoundaryGap(voxels, ComputeSpacingWeights(geometry.spacing), positions, core.core.radius).largest;
}

/** By how much a boundary gap measured in LPS mm may exceed a height by rounding, mm. */
double
BoundaryGapTolerance(const ImageGeometry & geometry)
{
  return 4 * PositionTolerance(geometry) * *std::max_element(geometry.spacing.begin(), geometry.spacing.end());
}

/** What becomes of one request. */
class Work
{
public:
  Work(VoxelShape               voxels,
       const ImageGeometry &    geometry,
       const CertifiedRequest & request,
       const ProgressCallback & progress)
    : m_Voxels(std::move(voxels))
    , m_Request(request)
    , m_Weights(ComputeLatticeWeights(geometry))
    , m_Plan(progress, StageTimes(request))
  {
    RequireLengthsIn(geometry.unit, request);
    m_Result.shape = { request.name, {}, m_Voxels.Box(), geometry };
    for (const Lambda & lambda : request.lambdas)
    {
      m_Thresholds.push_back(LambdaInMillimetres(lambda, m_Weights, geometry.spacing, m_Voxels.Box()));
    }
  }

  CertifiedResult
  Run()
  {
    MakeWholeCore();
    CertifyWhole();
    if (BurnsBeforePruning(m_Request))
    {
      BurnBeforePruning();
    }
    Stopwatch watch;
    MakeResults();
    m_Result.seconds.prune += watch.Lap();
    if (m_Request.skeleton)
    {
      if (!BurnsBeforePruning(m_Request))
      {
        Burn(CoreToBurn());
      }
      Measure();
    }
    if (m_Request.thickness)
    {
      Stopwatch thickness;
      m_Result.thickness =
        ThicknessOf(m_Result.cores.front(), m_Result.shape, std::move(m_Voxels), std::move(m_Bracket), m_Plan.Next());
      m_Result.seconds.thickness += thickness.Lap();
    }
    return std::move(m_Result);
  }

private:
  /** Frees the points and the cells as soon as it can. */
  void
  MakeWholeCore()
  {
    Stopwatch             watch;
    const ImageGeometry & geometry = m_Result.shape.geometry;
    CertifiedSeconds &    seconds = m_Result.seconds;
    const bool            byTolerance = !m_Request.tolerances.empty();
    MedialComplex         core;
    {
      ReportProgress(m_Plan.Next("shape"), "", 0);
      m_Result.shape.topology = ComputeShapeTopology(m_Voxels);
      m_Result.fine = FindFineTopology(m_Voxels, m_Result.shape.topology);
      std::vector<LatticePoint> points = BoundaryVertices(m_Voxels);
      m_Result.boundaryVertices = points.size();
      seconds.shape += watch.Lap();

      const ProgressCallback part = m_Plan.Next("delaunay");
      const Engine           engine = m_Request.engine;
      DelaunayCells          cells = m_Request.cells ? m_Request.cells(points, part)
                                     : m_Request.crossCheck
                                       ? CrossCheckedCells(m_Voxels, points, m_Weights, engine, m_Request.name, part)
                                       : ComputeDelaunayCells(m_Voxels, points, m_Weights, engine, part);
      seconds.delaunay += watch.Lap();
      if (NeedsBracket(m_Request))
      {
        m_Bracket =
          BracketThickness(m_Voxels, points, cells, m_Weights, m_Request.thickness->bounds, m_Plan.Next("thickness"));
        seconds.thickness += watch.Lap();
      }

      const ProgressCallback building = m_Plan.Next("core");
      ReportProgress(building, "", 0);
      TouchingBalls touching = byTolerance ? LargestTouchingBalls(cells, points, m_Weights) : TouchingBalls();
      if (Refines(m_Request))
      {
        m_Kept.edgePoints = NearestToEdges(cells);
      }
      ReportProgress(building, "", 0.1);
      core = BuildVoxelCore(m_Voxels, points, std::move(cells), m_Weights);
      if (byTolerance)
      {
        RequireEnclosed(core);
        seconds.core += watch.Lap();
        ToleranceValues heights = ComputeTolerances(core,
                                                    m_Weights,
                                                    points,
                                                    std::move(touching),
                                                    m_Thresholds.front(),
                                                    m_Plan.Next("prune"),
                                                    [&] { RequireTopology(core); });
        core.tolerances = std::move(heights);
        EndTolerances(core.tolerances, geometry);
        seconds.prune += watch.Lap();
      }
      if (Refines(m_Request))
      {
        m_Kept.boundary = std::move(points);
      }
    }
    if (!byTolerance)
    {
      RequireEnclosed(core);
    }
    if (Refines(m_Request))
    {
      KeepPlaces(core);
    }
    m_Whole.core = ToPhysical(std::move(core), geometry, 0);
    m_Whole.numbers.lambda = "0";
    seconds.core += watch.Lap();
  }

  /** For TakeBack(): where nothing but its positions will change, these are enough. */
  void
  KeepPlaces(const MedialComplex & core)
  {
    if (IsLeftHanded(m_Result.shape.geometry)) // polygons are turned round, too
    {
      m_Kept.core = core;
    }
    else
    {
      m_Kept.core.positions = core.positions;
    }
  }

  /** Keeps of the whole core what will be refined, and of the places it had in the lattice no others. */
  void
  KeepToRefineLater(const ProgressCallback & progress)
  {
    if (RefinesCores(m_Request))
    {
      m_Refinement.asked = Asked();
    }
    if (RefinesCurves(m_Request))
    {
      m_Refinement.curves = &*m_Curves;
    }
    const Vector3 & spacing = m_Result.shape.geometry.spacing;
    MedialComplex   former = std::move(m_Kept.core);
    MedialComplex & whole = m_Whole.core.core;
    if (IsLeftHanded(m_Result.shape.geometry))
    {
      KeepAsked(spacing, former, m_Refinement, m_Kept, progress);
      return;
    }
    whole.positions.swap(former.positions);
    KeepAsked(spacing, whole, m_Refinement, m_Kept, progress);
    whole.positions.swap(former.positions);
  }

  void
  RequireEnclosed(const MedialComplex & core) const
  {
    if (!IsEnclosed(core, m_Voxels))
    {
      RefuseResult(m_Request.name, "a vertex of the core lies outside the shape");
    }
  }

  void
  RequireTopology(const MedialComplex & core)
  {
    m_Topology = ComputeComplexTopology(core.cells);
    RequireEqualTopology(m_Result.shape.topology, *m_Topology, "its core", m_Request.name);
  }

  /** Prunes by lambda at the same time: neither changes the core, and each is work for one processor. */
  void
  CertifyWhole()
  {
    Stopwatch              watch;
    const ProgressCallback prune = m_Plan.Next(RefinesCores(m_Request) ? "core" : "prune");
    ReportProgress(prune, "", 0);
    const MedialComplex & core = m_Whole.core.core;
    RunBoth(
      core.cells.FaceCount() > 10000,
      [&] {
        if (m_Request.tolerances.empty() && !RefinesCores(m_Request))
        {
          m_Pruned = PruneAscending(core, 0, m_Thresholds, prune);
        }
      },
      [&] {
        if (!m_Topology)
        {
          RequireTopology(core);
        }
        // Described in LPS mm, as it stands in the file, so that a file pruned later gets the same figures to the last
        // bit.
        m_Whole.numbers.complex = DescribeComplex(core, *m_Topology);
      });
    m_Result.whole = m_Whole.numbers.complex;
    if (RefinesCores(m_Request) && !RefinesCurves(m_Request))
    {
      KeepToRefineLater(PartOfProgress(prune, "core", 0.5, 1));
      m_WholeIsSpare = true;
    }
    else if (!RefinesCores(m_Request) && !m_Request.tolerances.empty())
    {
      MakePruned();
      m_WholeIsSpare = !Refines(m_Request);
    }
    if (m_WholeIsSpare && !BurnsBeforePruning(m_Request))
    {
      m_Whole = CertifiedCore();
    }
    m_Result.seconds.prune += watch.Lap();
  }

  /** The cores by tolerance that are not refined. */
  void
  MakePruned()
  {
    m_Whole.numbers.lambda = m_Request.lambdas.front().text;
    m_Whole.numbers.lambdaMm = m_Thresholds.front();
    m_Result.cores = PruneCertified(m_Whole, m_Result.shape, m_Request.tolerances);
  }

  /** The results asked for; the whole core is used up. */
  void
  MakeResults()
  {
    if (Refines(m_Request))
    {
      const ProgressCallback refine = m_Plan.Next();
      if (RefinesCurves(m_Request))
      {
        KeepToRefineLater(PartOfProgress(refine, "refine", 0, 0.05));
      }
      if (RefinesCores(m_Request))
      {
        m_Whole = CertifiedCore();
      }
      std::vector<CertifiedCore> refined = RefineAndCertify(m_Voxels,
                                                            m_Result.shape,
                                                            std::move(m_Kept),
                                                            *m_Request.surface,
                                                            std::move(m_Refinement),
                                                            refine);
      if (RefinesCores(m_Request))
      {
        m_Result.cores = std::move(refined);
      }
    }
    if (RefinesCores(m_Request))
    {
      CertifyCoverage();
    }
    else if (m_Request.tolerances.empty())
    {
      if (!m_Request.skeleton && !m_Request.thickness)
      {
        m_Voxels = VoxelShape();
      }
      m_Result.cores = CertifyPruned(std::move(m_Whole),
                                     std::move(m_Pruned),
                                     {},
                                     m_Result.shape,
                                     m_Request.lambdas,
                                     m_Thresholds,
                                     m_Plan.Next("certificate"));
    }
    else
    {
      m_Whole = CertifiedCore();
      CertifyCoverage();
    }
  }

  /** How each result is pruned. */
  std::vector<CoreNumbers>
  Asked() const
  {
    std::vector<CoreNumbers> asked;
    for (std::size_t i = 0; i < m_Request.lambdas.size(); ++i)
    {
      asked.emplace_back();
      asked.back().lambda = m_Request.lambdas[i].text;
      asked.back().lambdaMm = m_Thresholds[i];
    }
    if (m_Request.tolerances.empty())
    {
      return asked;
    }
    asked.resize(m_Request.tolerances.size(), asked.front());
    for (std::size_t i = 0; i < asked.size(); ++i)
    {
      asked[i].tolerance = DescribeTolerance(m_Request.tolerances[i], m_Result.shape.geometry);
    }
    return asked;
  }

  void
  CertifyCoverage()
  {
    if (m_Request.tolerances.empty())
    {
      return;
    }
    const ProgressCallback coverage = m_Plan.Next("certificate");
    for (std::size_t i = 0; i < m_Result.cores.size(); ++i)
    {
      ReportProgress(coverage, "", static_cast<double>(i) / static_cast<double>(m_Result.cores.size()));
      CertifyCoverage(m_Result.cores[i]);
    }
  }

  /** Measures how far the boundary lies from what is left, by other means than those that pruned it. What was pruned by
   *  lambda first was promised nothing. */
  void
  CertifyCoverage(CertifiedCore & core)
  {
    const ImageGeometry & geometry = m_Result.shape.geometry;
    ToleranceNumbers &    tolerance = *core.numbers.tolerance;
    tolerance.boundaryGapMm = BoundaryGapOf(core.core, m_Voxels, geometry);
    if (core.numbers.lambdaMm > 0)
    {
      return;
    }
    const double promised =
      core.numbers.refined ? RefinedGapBound(tolerance.heightMm, geometry.spacing) : tolerance.heightMm;
    if (*tolerance.boundaryGapMm > promised + BoundaryGapTolerance(geometry))
    {
      RefuseResult(m_Request.name,
                   "a boundary vertex lies " + std::to_string(*tolerance.boundaryGapMm) + InUnit(" mm", geometry.unit) +
                     " from its core pruned at tolerance " + tolerance.height);
    }
    m_Result.covered = true;
  }

  const MedialComplex &
  CoreToBurn() const
  {
    for (std::size_t i = 0; i < m_Request.lambdas.size(); ++i)
    {
      if (m_Request.lambdas[i].text == m_Request.skeleton->lambda.text)
      {
        return m_Result.cores[i].core.core;
      }
    }
    throw UsageError(m_Request.name + ": a skeleton is asked for of a core that is not: lambda " +
                     m_Request.skeleton->lambda.text);
  }

  /** Whether the whole core is asked for no more once it has burned. */
  bool
  SpendsWhole() const
  {
    const auto isWhole = [](double threshold) { return threshold == 0; };
    return m_WholeIsSpare || (m_Request.spendsCores && m_Request.tolerances.empty() && !m_Request.thickness &&
                              !Refines(m_Request) && std::all_of(m_Thresholds.begin(), m_Thresholds.end(), isWhole));
  }

  void
  Burn(const MedialComplex & core,
       const LiveElements *  part = nullptr,
       MedialComplex *       spent = nullptr,
       bool                  givesBack = false)
  {
    Stopwatch watch;
    m_Curves = BurnToCurves(core, part, m_Result.shape, *m_Request.skeleton, m_Plan.Next(), spent, givesBack);
    m_Result.seconds.skeleton += watch.Lap();
  }

  /** Curves that know their places in the whole core: they may be refined. */
  void
  BurnBeforePruning()
  {
    MedialComplex &       core = m_Whole.core.core;
    MedialComplex * const spent = SpendsWhole() ? &core : nullptr;
    if (BurnsWhole(m_Request))
    {
      Burn(core, nullptr, &core, !SpendsWhole());
      return;
    }
    const LiveElements left = PartToBurn(core, m_Result.shape, *m_Request.skeleton);
    if (m_Request.skeleton->tolerance)
    {
      Burn(core, &left, spent);
      return;
    }
    PartElements  part;
    MedialComplex burns = ExtractPart(core, left, part);
    if (spent != nullptr)
    {
      *spent = MedialComplex();
    }
    Burn(burns, nullptr, &burns);
    NameInWhole(part, m_Curves->curves.inSurface);
  }

  void
  Measure()
  {
    Stopwatch watch;
    m_Result.skeleton = MeasureCurves(*m_Curves, m_Voxels, m_Result.shape, *m_Request.skeleton);
    m_Result.seconds.skeleton += watch.Lap();
  }

  VoxelShape                     m_Voxels;
  const CertifiedRequest &       m_Request;
  SpacingWeights                 m_Weights;
  StagePlan                      m_Plan;
  std::vector<double>            m_Thresholds; ///< mm
  RefinementParts                m_Kept;       ///< where there is something to refine
  RefinementTask                 m_Refinement; ///< once m_Kept is kept for it
  std::optional<TopologyNumbers> m_Topology;   ///< of the whole core, once it was found to be the shape's
  CertifiedCore                  m_Whole;
  bool                           m_WholeIsSpare = false; ///< what is left to do with it is to burn it
  std::vector<MedialComplex>     m_Pruned;               ///< by lambda, ascending
  std::optional<BurnedCurves>    m_Curves;
  ThicknessBracket               m_Bracket;
  CertifiedResult                m_Result;
};

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
  CertifiedRequest complete = request;
  CompletePruning(complete.lambdas, complete.tolerances);
  if (!complete.surface)
  {
    complete.surface = UsualSurface(complete, geometry.spacing);
  }
  RequireSense(complete);
  const ProgressCallback forward = ForwardOnly(progress);
  CertifiedResult        result = Work(std::move(shape), geometry, complete, forward).Run();
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
