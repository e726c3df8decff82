#include "CrossCheck.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Base/Text.h"

#include <algorithm>
#include <cstring>

namespace voxelcore
{

namespace
{

std::string
Text(double value)
{
  return RoundTripText(value);
}

std::string
Text(std::uint32_t index)
{
  return index == kOutside ? "outside" : std::to_string(index);
}

template <typename List>
std::string
ListText(const List & list)
{
  std::string text;
  for (const auto & value : list)
  {
    text += (text.empty() ? "(" : ", ") + Text(value);
  }
  return text.empty() ? "()" : text + ")";
}

std::string
Differ(const std::string & what, const std::string & lattice, const std::string & tetgen)
{
  return what + ": lattice " + lattice + ", tetgen " + tetgen;
}

std::string
Differ(const std::string & what, std::size_t lattice, std::size_t tetgen)
{
  return Differ(what, std::to_string(lattice), std::to_string(tetgen));
}

} // namespace

std::string
FirstDifference(const DelaunayCells & lattice, const DelaunayCells & tetgen)
{
  // The first cell or facet that differs says more than two counts, so counts come last.
  const std::size_t cells = std::min(lattice.CellCount(), tetgen.CellCount());
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    // Bits, not values: -0 is not 0 in a file. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-*)
    if (std::memcmp(&lattice.centres[cell], &tetgen.centres[cell], sizeof(lattice.centres[cell])) != 0)
    {
      return Differ("centre of cell " + std::to_string(cell),
                    ListText(lattice.centres[cell]),
                    ListText(tetgen.centres[cell]));
    }
  }
  if (lattice.CellCount() != tetgen.CellCount())
  {
    return Differ("number of cells", lattice.CellCount(), tetgen.CellCount());
  }
  const std::size_t facets = std::min(lattice.FacetCount(), tetgen.FacetCount());
  for (std::size_t facet = 0; facet < facets; ++facet)
  {
    if (lattice.facetCells[facet] != tetgen.facetCells[facet])
    {
      return Differ("cells of facet " + std::to_string(facet),
                    ListText(lattice.facetCells[facet]),
                    ListText(tetgen.facetCells[facet]));
    }
    const auto a = lattice.FacetPoints(facet);
    const auto b = tetgen.FacetPoints(facet);
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end()))
    {
      return Differ("points of facet " + std::to_string(facet), ListText(a), ListText(b));
    }
  }
  if (lattice.FacetCount() != tetgen.FacetCount())
  {
    return Differ("number of facets", lattice.FacetCount(), tetgen.FacetCount());
  }
  return {};
}

DelaunayCells
CrossCheckedCells(const VoxelShape &                shape,
                  const std::vector<LatticePoint> & points,
                  const SpacingWeights &            weights,
                  Engine                            engine,
                  const std::string &               labelText,
                  const ProgressCallback &          progress)
{
  constexpr double latticeEnds = 0.1; // TetGen takes ten times as long and more
  DelaunayCells    lattice =
    ComputeDelaunayCells(shape, points, weights, Engine::Lattice, PartOfProgress(progress, "delaunay", 0, latticeEnds));
  DelaunayCells tetgen =
    ComputeDelaunayCells(shape, points, weights, Engine::TetGen, PartOfProgress(progress, "delaunay", latticeEnds, 1));
  const std::string difference = FirstDifference(lattice, tetgen);
  if (!difference.empty())
  {
    throw CertificateError(labelText + ": cross-check failed: the engines differ in the " + difference +
                           "; nothing was written; this is a fault of VoxelCore, please report it with the scan");
  }
  return engine == Engine::TetGen ? std::move(tetgen) : std::move(lattice);
}

} // namespace voxelcore
