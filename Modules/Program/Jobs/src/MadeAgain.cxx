#include "MadeAgain.h"

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

/** Why it cannot be made again; empty when it can. */
std::string
Obstacle(const CoreReport & made, const ImageGeometry & geometry)
{
  const ImageGeometry & then = made.input.geometry;
  if (made.version != VoxelCoreVersion())
  {
    return "it was made by VoxelCore " + made.version;
  }
  if (then.size != geometry.size || then.spacing != geometry.spacing || then.origin != geometry.origin ||
      then.direction != geometry.direction)
  {
    return "the scan does not lie where the one lay that it was made from";
  }
  return made.parameters.refine.greyRange ? "the scan with its grey values is not here" : "";
}

} // namespace

MadeAgain::MadeAgain(const CoreReport &            made,
                     const InputScan &             volume,
                     const std::filesystem::path & scan,
                     std::vector<std::string> &    notes)
  : m_Made(made)
  , m_Geometry(volume.geometry)
  , m_Needed(!made.parameters.refine.surface.empty() || !made.parameters.tolerances.empty())
{
  if (!m_Needed)
  {
    return;
  }
  const std::string obstacle = Obstacle(made, volume.geometry);
  if (!obstacle.empty())
  {
    m_Needed = false;
    notes.push_back("the core was not made again to compare its numbers: " + obstacle);
    return;
  }
  RefineOptions refine;
  refine.surface = made.parameters.refine.surface;
  m_Surface = MakeSurfaceSource(refine, scan, RecordedReading(made.parameters), volume);
}

ModelPart
MadeAgain::MakeAgain(const LabelShape &       label,
                     const PrunedRecord &     pruned,
                     bool                     thickness,
                     const ProgressCallback & progress) const
{
  // A refined core may have been pruned further than it was when it was refined.
  const RefinedAt & at = m_Made.parameters.refine.at.value_or(
    RefinedAt{ pruned.lambda, pruned.tolerance ? pruned.tolerance->height : std::string() });
  CertifiedRequest request;
  request.lambdas = { ParseLambda(at.lambda) };
  if (!at.tolerance.empty())
  {
    request.tolerances = { ParseTolerance(at.tolerance) };
  }
  request.surface = m_Surface;
  if (thickness)
  {
    request.thickness = ThicknessRequest{};
  }
  LabelOutcome outcome = ProcessLabel({ label, 0, {} }, m_Geometry, std::move(request), progress);
  ModelPart    again = std::move(outcome.parts.front());
  if (thickness)
  {
    again.thickness.assign(outcome.thickness->atVertices.begin(), outcome.thickness->atVertices.end());
  }
  if (m_Made.parameters.refine.at)
  {
    const CertifiedShape shape{ label.name, outcome.record.shape, outcome.record.box, m_Geometry };
    CertifiedCore        refined{ outcome.record.pruned.front(), std::move(again) };
    auto further = pruned.tolerance ? PruneCertified(refined, shape, { ParseTolerance(pruned.tolerance->height) })
                                    : PruneCertified(std::move(refined), shape, { ParseLambda(pruned.lambda) });
    again = std::move(further.front().core);
  }
  return again;
}

std::optional<VerificationCheck>
MadeAgain::Check(const ModelPart &        part,
                 const LabelShape &       label,
                 const PrunedRecord &     pruned,
                 const ProgressCallback & progress) const
{
  if (!m_Needed)
  {
    return std::nullopt;
  }
  ModelPart       again = MakeAgain(label, pruned, !part.thickness.empty(), progress);
  MedialComplex & core = again.core;
  again.component = part.component;
  if (m_Made.parameters.model.triangles)
  {
    core = Triangulated(core);
  }
  // Of all parts of a file what never goes has one tolerance.
  const double own = GreatestTolerance(core);
  if (const double never = GreatestTolerance(part.core); never > own)
  {
    for (auto * values : { &core.tolerances.vertices, &core.tolerances.edges, &core.tolerances.faces })
    {
      std::replace(values->begin(), values->end(), own, never);
    }
  }
  for (std::size_t edge = 0; edge < core.edgeLambda.size() && edge < part.core.edgeLambda.size(); ++edge)
  {
    // What the file does not hold is not compared.
    if (std::isnan(part.core.edgeLambda[edge]))
    {
      core.edgeLambda[edge] = part.core.edgeLambda[edge];
    }
  }
  VerificationCheck check{ "made again", true, 0, {} };
  if (!SameBits(part, again))
  {
    check = { "made again",
              false,
              1,
              "the scan gives other places, radii, measures, tolerances or thickness than the file has." };
  }
  return check;
}

} // namespace voxelcore
