#include "MadeAgain.h"

#include "JobTools.h"
#include "voxelcore/CoreJob.h"

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
  CertifiedRequest request;
  request.lambdas = { ParseLambda(pruned.lambda) };
  if (pruned.tolerance)
  {
    request.tolerances = { ParseTolerance(pruned.tolerance->height) };
  }
  request.surface = m_Surface;
  LabelOutcome    outcome = ProcessLabel({ label, 0, {} }, m_Geometry, std::move(request), progress);
  ModelPart       again = std::move(outcome.parts.front());
  MedialComplex & core = again.core;
  again.component = part.component;
  if (m_Made.parameters.model.triangles)
  {
    core = Triangulated(core);
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
    check = { "made again", false, 1, "the scan gives other places, radii, measures or tolerances than the file has." };
  }
  return check;
}

} // namespace voxelcore
