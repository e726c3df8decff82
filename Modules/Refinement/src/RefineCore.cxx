#include "voxelcore/Refinement.h"

#include "WorkingCore.h"

#include "voxelcore/SimplePairCollapse.h"

namespace voxelcore
{

EdgePoints
NearestToEdges(const DelaunayCells & cells)
{
  EdgePoints edges;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    if (cells.facetCells[facet][1] != kOutside)
    {
      const auto polygon = cells.FacetPoints(facet);
      edges.points.insert(edges.points.end(), polygon.begin(), polygon.end());
      edges.offsets.push_back(edges.points.size());
    }
  }
  return edges;
}

namespace
{

// More is moved than is left in the end, as measures that are taken again may be greater.
constexpr double kWorkingPart = 0.75;

} // namespace

std::vector<RefinedCore>
RefineCore(const RefinementInput & input, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  std::vector<RefinedCore> refined;
  SimplePairCollapse       collapse(input.core->cells,
                              input.core->vertexLambda,
                              input.core->edgeLambda,
                              input.core->faceLambda);
  for (const double threshold : thresholds)
  {
    collapse.CollapseBelow(kWorkingPart * threshold, progress);
    WorkingCore      working(input, collapse.Live());
    const FootFinder finder(input, working.UsedPoints(), progress);
    working.Move(finder, progress);
    refined.push_back(working.Finish(finder, threshold));
  }
  return refined;
}

} // namespace voxelcore
