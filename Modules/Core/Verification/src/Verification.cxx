#include "voxelcore/Verification/Verification.h"

#include "Checks.h"
#include "voxelcore/Lattice/PlaceStep.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Verification/BettiReduction.h"
#include "voxelcore/Verification/OctantScan.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

namespace voxelcore
{
namespace verification
{

std::string
Describe(double value)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

std::string
Describe(const LatticePoint & point)
{
  std::ostringstream text;
  text << "(" << point.x << ", " << point.y << ", " << point.z << ")";
  return text.str();
}

std::string
Describe(const Position & position)
{
  std::ostringstream text;
  text.precision(12);
  text << "(" << position[0] << ", " << position[1] << ", " << position[2] << ")";
  return text.str();
}

std::string
DescribeVertex(const Subject & subject, std::size_t vertex)
{
  return "vertex " + std::to_string(vertex) + " at " + Describe(subject.input.positions[vertex]);
}

std::string
DescribeEdge(const Subject & subject, std::size_t edge)
{
  const auto & ends = subject.cells.edges[edge];
  return "edge " + std::to_string(edge) + " (vertices " + std::to_string(ends[0]) + ", " + std::to_string(ends[1]) +
         ")";
}

std::string
DescribeFace(const Subject & subject, std::size_t face)
{
  return "face " + std::to_string(face) + " (first corner " +
         DescribeVertex(subject, subject.cells.FaceVertices(face)[0]) + ")";
}

namespace
{

std::string
Describe(const TopologyNumbers & numbers)
{
  return "chi " + std::to_string(numbers.euler) + ", b0 " + std::to_string(numbers.betti[0]) + ", b1 " +
         std::to_string(numbers.betti[1]) + ", b2 " + std::to_string(numbers.betti[2]);
}

} // namespace

void
FinishReport(VerificationReport & report)
{
  for (VerificationCheck & check : report.checks)
  {
    report.passed = report.passed && check.passed;
    if (!check.firstOffender.empty() && check.firstOffender[0] >= 'a' && check.firstOffender[0] <= 'z')
    {
      check.firstOffender[0] = static_cast<char>(check.firstOffender[0] - 'a' + 'A');
    }
  }
}

void
RequireExactRange(const VoxelBox & box, const SpacingWeights & weights)
{
  double side = 1;
  double weight = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    side = std::max<double>(side, box.size[a]);
    weight = std::max(weight, static_cast<double>(weights.weight[a]));
  }
  if (72 * weight * weight * std::pow(side, 5) >= std::ldexp(1.0, 127))
  {
    throw InputError(
      "The shape is too large to be verified exactly at these spacings: crop it or coarsen the "
      "spacing's ratio.");
  }
}

void
CheckTopology(VerificationReport & report, const VoxelShape & shape, std::int64_t recount)
{
  report.shapeTopology = ComputeShapeTopology(shape);
  const bool counts = report.shapeTopology.euler == recount;
  report.checks.push_back({ "shape Euler number",
                            counts,
                            counts ? 0U : 1U,
                            counts ? std::string()
                                   : "The shape's Euler number is " + std::to_string(report.shapeTopology.euler) +
                                       ", but corner by corner it is " + std::to_string(recount) + "." });
  const bool equal = report.shapeTopology == report.complexTopology;
  report.checks.push_back({ "topology",
                            equal,
                            equal ? 0U : 1U,
                            equal ? std::string()
                                  : "The shape has " + Describe(report.shapeTopology) + ", the complex " +
                                      Describe(report.complexTopology) + "." });
}

double
PositionRounding(const VoxelBox & box)
{
  double largest = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double lower = box.lower[a];
    largest = std::max({ largest, std::abs(lower), std::abs(lower + box.size[a]) });
  }
  return 4 * std::numeric_limits<double>::epsilon() * largest;
}

namespace
{

constexpr std::array<const char *, 29> kAllChecks{ "arrays",          "numbers",
                                                   "edge ends",       "polygons",
                                                   "polygon edges",   "distinct vertices",
                                                   "distinct edges",  "distinct faces",
                                                   "vertices inside", "vertices equidistant",
                                                   "nothing nearer",  "radius",
                                                   "true spacing",    "edges dual",
                                                   "faces dual",      "faces planar",
                                                   "faces convex",    "faces oriented",
                                                   "vertex measures", "edge measures",
                                                   "face measures",   "measures monotone",
                                                   "vertex order",    "edge order",
                                                   "face order",      "completeness",
                                                   "pruning",         "shape Euler number",
                                                   "topology" };

/** Adds the checks that were not run. */
void
AddUnchecked(VerificationReport & report, bool byTolerance)
{
  for (std::size_t i = report.checks.size(); i < kAllChecks.size(); ++i)
  {
    const std::string_view name = kAllChecks[i];
    report.checks.push_back({ !byTolerance             ? kAllChecks[i]
                              : name == "completeness" ? "tolerances"
                              : name == "pruning"      ? "coverage"
                                                       : kAllChecks[i],
                              false,
                              0,
                              "Not checked: what it builds on is damaged." });
  }
}

void
CheckGeometry(VerificationReport &      report,
              const VerificationInput & input,
              const BoundaryTree &      tree,
              const ProgressCallback &  progress)
{
  const double rounding = PositionRounding(input.shape->Box());
  Subject      subject{ input, *input.cells, tree, rounding + input.positionTolerance, {}, {} };
  ReportProgress(progress, "verify", 0.2);
  subject.sets = FindNearestSets(tree, input.weights, input.positions, subject.tolerance, [&](double fraction) {
    ReportProgress(progress, "verify", 0.2 + 0.3 * fraction);
  });
  FindDualEdges(subject);
  CheckDistinct(report, subject);
  CheckVertices(report, subject);
  CheckTrueSpacing(report, subject);
  CheckDuals(report, subject);
  CheckPolygons(report, subject);
  ReportProgress(progress, "verify", 0.6);
  CheckMeasures(report, subject);
  CheckOrder(report, subject);
  ReportProgress(progress, "verify", 0.8);
  if (input.pruningTolerance)
  {
    CheckTolerances(report, subject);
    CheckCoverage(report, subject.input, subject.tolerance, { *subject.input.pruningTolerance, 0 });
    return;
  }
  CheckCompleteness(report, subject);
  ReportProgress(progress, "verify", 0.85);
  CheckPruning(report, subject);
}

} // namespace
} // namespace verification

double
PositionTolerance(const ImageGeometry & geometry)
{
  const double finest = *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
  return 0.5 * kPlaceStep + 64 * std::numeric_limits<double>::epsilon() * LargestCoordinate(geometry) / finest;
}

VerificationReport
VerifyComplex(const VerificationInput & input, const ProgressCallback & progress)
{
  using namespace verification;
  RequireExactRange(input.shape->Box(), input.weights);
  VerificationReport report;
  ReportProgress(progress, "verify", 0.0);
  OctantScan   scan = ScanOctants(*input.shape);
  const bool   usable = CheckArrays(report, input) && CheckIncidences(report, *input.cells);
  BoundaryTree tree(std::move(scan.boundary), input.weights);
  if (usable)
  {
    CheckGeometry(report, input, tree, progress);
    ReportProgress(progress, "verify", 0.9);
    report.complexTopology = ReduceToTopologyNumbers(*input.cells);
    CheckTopology(report, *input.shape, scan.euler);
  }
  else
  {
    AddUnchecked(report, input.pruningTolerance.has_value());
  }
  FinishReport(report);
  ReportProgress(progress, "verify", 1.0);
  return report;
}

} // namespace voxelcore
