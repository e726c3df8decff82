#include "CertifiedWork.h"

#include "BoundaryCoverage.h"
#include "CertificateText.h"
#include "InscribedThickness.h"
#include "PruneStages.h"
#include "RequestStages.h"
#include "WholeCore.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Stopwatch.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

CertifiedThickness
SmoothThicknessOf(VoxelShape               voxels,
                  const SpacingWeights &   weights,
                  const CertifiedRequest & request,
                  const ProgressCallback & progress)
{
  StagePlan  plan(progress, { request.surface->IsOfShape() ? 0.0 : 0.5, 1.0 });
  const auto surface = SurfaceForThickness(request, voxels, plan.Next("surface"));
  return SmoothThickness(std::move(voxels),
                         weights,
                         surface.get(),
                         request.thickness->bounds,
                         request.name,
                         plan.Next("thickness"));
}

/** What becomes of one request. */
class Work
{
public:
  Work(VoxelShape               voxels,
       const ImageGeometry &    geometry,
       const CertifiedRequest & request,
       const ProgressCallback & progress,
       const BeyondBorder *     goesOn)
    : m_Voxels(std::move(voxels))
    , m_GoesOn(goesOn)
    , m_Request(request)
    , m_Weights(ComputeLatticeWeights(geometry))
    , m_Plan(progress, StageTimes(request))
  {
    RequireLengthsIn(geometry.unit, request);
    m_Result.shape = { request.name, {}, goesOn != nullptr ? goesOn->box : m_Voxels.Box(), geometry };
    for (const Lambda & lambda : request.lambdas)
    {
      m_Thresholds.push_back(LambdaInMillimetres(lambda, m_Weights, geometry.spacing, m_Result.shape.box));
    }
  }

  CertifiedResult
  Run()
  {
    const CoreUse use = LambdasSpendWhole() ? CoreUse::Pruning : CoreUse::Any;
    m_Whole = MakeWholeCore(m_Voxels, m_Request, m_Weights, m_Thresholds.front(), use, m_Plan, m_Result);
    if (m_GoesOn != nullptr)
    {
      RequireEqualTopology(m_GoesOn->topology, m_Result.shape.topology, "it beyond the scan's border", m_Request.name);
    }
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
      Stopwatch skeleton;
      if (!BurnsBeforePruning(m_Request))
      {
        m_Curves = BurnToCurves(CoreToBurn(), nullptr, m_Result.shape, *m_Request.skeleton, m_Plan.Next());
      }
      m_Result.skeleton = MeasureCurves(*m_Curves, m_Voxels, m_Result.shape, *m_Request.skeleton, m_GoesOn);
      RequireEnclosed(m_Result.skeleton->skeleton.graph, m_Voxels, m_Result.shape);
      m_Result.seconds.skeleton += skeleton.Lap();
    }
    if (m_Request.thickness)
    {
      Stopwatch              thickness;
      const ProgressCallback progress = m_Plan.Next();
      m_Result.thickness = RefinesCores(m_Request)
                             ? SmoothThicknessOf(std::move(m_Voxels), m_Weights, m_Request, progress)
                             : ThicknessOf(m_Result.shape, std::move(m_Voxels), std::move(m_Whole.bracket), progress);
      m_Result.thickness->atVertices =
        ThicknessAt(*m_Result.thickness, m_Result.cores.front().core.core.positions, m_Result.shape.geometry);
      m_Result.seconds.thickness += thickness.Lap();
    }
    return std::move(m_Result);
  }

private:
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
    MedialComplex   former = std::move(m_Whole.kept.core);
    MedialComplex & whole = m_Whole.core.core.core;
    if (IsLeftHanded(m_Result.shape.geometry))
    {
      KeepAsked(spacing, former, m_Refinement, m_Whole.kept, progress);
      return;
    }
    whole.positions.swap(former.positions);
    KeepAsked(spacing, whole, m_Refinement, m_Whole.kept, progress);
    whole.positions.swap(former.positions);
  }

  /** What is left of a core that is asked for no more once it has been described takes its place. */
  void
  CertifyWhole()
  {
    Stopwatch              watch;
    const ProgressCallback prune = m_Plan.Next(RefinesCores(m_Request) ? "core" : "prune");
    ReportProgress(prune, "", 0);
    MedialComplex &                core = m_Whole.core.core.core;
    std::optional<TopologyNumbers> counted;
    RunBoth(
      core.cells.FaceCount() > 10000,
      [&] { m_Whole.core.numbers.complex = DescribeComplex(core, m_Result.shape.topology); },
      [&] { counted = ComputeComplexTopology(core.cells); });
    if (!counted)
    {
      RefuseResult(m_Request.name, "its core was not counted");
    }
    RequireEqualTopology(m_Result.shape.topology, *counted, "its core", m_Request.name);
    if (m_Request.tolerances.empty() && !RefinesCores(m_Request))
    {
      m_Pruned = LambdasSpendWhole() ? PruneByLambda(std::move(core), AscendingBeyond(0, m_Thresholds), prune)
                                     : PruneAscending(core, 0, m_Thresholds, prune);
    }
    m_Result.whole = m_Whole.core.numbers.complex;
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
      m_Whole.core = CertifiedCore();
    }
    m_Result.seconds.prune += watch.Lap();
  }

  /** The cores by tolerance that are not refined. */
  void
  MakePruned()
  {
    m_Whole.core.numbers.lambda = m_Request.lambdas.front().text;
    m_Whole.core.numbers.lambdaMm = m_Thresholds.front();
    m_Result.cores = PruneCertified(m_Whole.core, m_Result.shape, m_Request.tolerances);
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
        m_Whole.core = CertifiedCore();
      }
      std::vector<CertifiedCore> refined = RefineAndCertify(m_Voxels,
                                                            m_Result.shape,
                                                            std::move(m_Whole.kept),
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
      CertifyCoverages();
    }
    else if (m_Request.tolerances.empty())
    {
      if (!m_Request.skeleton && !m_Request.thickness)
      {
        m_Voxels = VoxelShape();
      }
      m_Result.cores = CertifyPruned(std::move(m_Whole.core),
                                     std::move(m_Pruned),
                                     {},
                                     m_Result.shape,
                                     m_Request.lambdas,
                                     m_Thresholds,
                                     m_Plan.Next("certificate"));
    }
    else
    {
      m_Whole.core = CertifiedCore();
      CertifyCoverages();
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
      asked[i].tolerance = DescribeTolerance(m_Request.tolerances[i], m_Result.shape);
    }
    return asked;
  }

  void
  CertifyCoverages()
  {
    if (m_Request.tolerances.empty())
    {
      return;
    }
    const ProgressCallback coverage = m_Plan.Next("certificate");
    for (std::size_t i = 0; i < m_Result.cores.size(); ++i)
    {
      ReportProgress(coverage, "", static_cast<double>(i) / static_cast<double>(m_Result.cores.size()));
      if (CertifyCoverage(m_Result.cores[i], m_Voxels, m_Result.shape))
      {
        m_Result.covered = true;
      }
    }
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

  /** Whether the whole core is asked for no more once it has been pruned by lambda. */
  bool
  LambdasSpendWhole() const
  {
    const auto isPruned = [](double threshold) { return threshold > 0; };
    return m_Request.tolerances.empty() && !Refines(m_Request) && !BurnsBeforePruning(m_Request) &&
           ranges::all_of(m_Thresholds, isPruned);
  }

  /** Whether the whole core is asked for no more once it has burned. */
  bool
  SpendsWhole() const
  {
    const auto isWhole = [](double threshold) { return threshold == 0; };
    return m_WholeIsSpare || (m_Request.spendsCores && m_Request.tolerances.empty() && !m_Request.thickness &&
                              !Refines(m_Request) && std::all_of(m_Thresholds.begin(), m_Thresholds.end(), isWhole));
  }

  /** Curves that know their places in the whole core: they may be refined. */
  void
  BurnBeforePruning()
  {
    Stopwatch               watch;
    MedialComplex &         core = m_Whole.core.core.core;
    const SkeletonRequest & request = *m_Request.skeleton;
    if (BurnsWhole(m_Request))
    {
      m_Curves = BurnToCurves(core, m_Result.shape, request, m_Plan.Next());
      RequireNothingStandsOut(*m_Curves, m_Voxels, m_Result.shape, request);
    }
    else if (const LiveElements left = PartToBurn(core, m_Result.shape, request); request.tolerance)
    {
      m_Curves = BurnToCurves(core, &left, m_Result.shape, request, m_Plan.Next());
    }
    else
    {
      PartElements  part;
      MedialComplex burns = ExtractPart(core, left, part);
      m_Curves = BurnToCurves(burns, m_Result.shape, request, m_Plan.Next());
      NameInWhole(part, m_Curves->curves.inSurface);
    }
    if (SpendsWhole())
    {
      core = MedialComplex();
    }
    m_Result.seconds.skeleton += watch.Lap();
  }

  VoxelShape                  m_Voxels;
  const BeyondBorder *        m_GoesOn; ///< null: nothing was added to the voxels
  const CertifiedRequest &    m_Request;
  SpacingWeights              m_Weights;
  StagePlan                   m_Plan;
  std::vector<double>         m_Thresholds;           ///< mm
  WholeCore                   m_Whole;                ///< its core is used up along the way
  RefinementTask              m_Refinement;           ///< once m_Whole.kept is kept for it
  bool                        m_WholeIsSpare = false; ///< what is left to do with it is to burn it
  std::vector<MedialComplex>  m_Pruned;               ///< by lambda, ascending
  std::optional<BurnedCurves> m_Curves;
  CertifiedResult             m_Result;
};

CertifiedResult
MapAlone(const VoxelShape &       shape,
         const ImageGeometry &    geometry,
         const CertifiedRequest & request,
         const ProgressCallback & progress)
{
  RequireLengthsIn(geometry.unit, request);
  Stopwatch       watch;
  CertifiedResult result;
  result.shape = { request.name, {}, shape.Box(), geometry };
  result.thickness = RefinesCores(request)
                       ? SmoothThicknessOf(shape, ComputeLatticeWeights(geometry), request, progress)
                       : InscribedThickness(shape, nullptr, geometry, request, progress);
  result.seconds.thickness = watch.Lap();
  return result;
}

} // namespace

CertifiedResult
RunCertified(VoxelShape               shape,
             const ImageGeometry &    geometry,
             const CertifiedRequest & request,
             const ProgressCallback & progress,
             const BeyondBorder *     goesOn)
{
  if (IsMapAlone(request))
  {
    return MapAlone(shape, geometry, request, progress);
  }
  return Work(std::move(shape), geometry, request, progress, goesOn).Run();
}

} // namespace voxelcore
