// How tidy and how complete medial surfaces of a scan are, whose true ones nobody knows. defaults_by_score.py runs it.
//
//     VoxelCoreScanScores SCAN CORE.vtp
//
// Prints labels, boundary vertices, area (1000 square voxels), rims and seams (length over area, 1/voxel), loose ends a
// label, lost parts (% of the boundary vertices farther than two voxel diagonals from all balls) and the largest gap
// (voxel diagonals). A voxel is the side of the cube with the same diagonal. README.md has the table.

#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/BallTree.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace voxelcore::evaluation
{
namespace
{

struct ScanScores
{
  std::size_t labels = 0;
  std::size_t points = 0;
  double      area = 0;
  double      rims = 0;
  double      seams = 0;
  std::size_t ends = 0;
  std::size_t lost = 0;
  double      gap = 0;
};

void
ScoreCells(const MedialComplex & core, ScanScores & scores)
{
  const CellComplex & cells = core.cells;
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    scores.area += PolygonArea(core.positions, cells.FaceVertices(face));
  }
  const auto facesAt = CountEdgeCofaces(cells);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    const double length = Length(Minus(core.positions[cells.edges[edge][0]], core.positions[cells.edges[edge][1]]));
    scores.rims += facesAt[edge].count == 1 ? length : 0;
    scores.seams += facesAt[edge].count > 2 ? length : 0;
  }
  const auto edgesAt = CountVertexCofaces(cells);
  scores.ends += static_cast<std::size_t>(
    std::count_if(edgesAt.begin(), edgesAt.end(), [](const Cofaces & at) { return at.count == 1; }));
}

void
ScoreBalls(const ModelPart & part, const VoxelShape & shape, const ImageGeometry & geometry, ScanScores & scores)
{
  std::vector<Vector3> places = part.core.positions;
  for (Vector3 & place : places)
  {
    place = PhysicalToLattice(geometry, place);
  }
  const BallTree balls(places, part.core.radius, ComputeSpacingWeights(geometry.spacing));
  const auto     points = BoundaryVertices(shape);
  const double   diagonal = Length(geometry.spacing);
  std::size_t    lost = 0;
  double         largest = 0;
#pragma omp parallel reduction(+ : lost) reduction(max : largest)
  {
    std::size_t nearest = 0;
#pragma omp for schedule(dynamic, 512)
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const LatticePoint & p = points[i];
      const double         gap =
        balls.Gap({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) }, -HUGE_VAL, nearest);
      lost += gap > 2 * diagonal ? 1 : 0;
      largest = std::max(largest, gap);
    }
  }
  scores.lost += lost;
  scores.gap = std::max(scores.gap, largest / diagonal);
  scores.points += points.size();
}

int
Main(const char * scan, const char * file)
{
  const MedialModel model = ReadModel(file);
  const CoreReport  made = ParseProvenance(model.provenance, file);
  ReadOptions       reading = made.parameters.reading;
  reading.labels = "all";
  reading.refuseGrey = false;
  const InputScan volume = ReadScanOrMesh(scan, reading, made.parameters.resolution);
  ScanScores      scores;
  for (const ModelPart & part : model.parts)
  {
    const auto label = std::find_if(volume.labels.begin(), volume.labels.end(), [&](const LabelShape & one) {
      return one.value == part.label;
    });
    if (label == volume.labels.end())
    {
      std::fprintf(stderr, "%s: label %lld is not in the scan\n", file, static_cast<long long>(part.label));
      return 1;
    }
    ++scores.labels;
    ScoreCells(part.core, scores);
    ScoreBalls(part, label->shape, volume.geometry, scores);
  }
  const double voxel = Length(volume.geometry.spacing) / std::sqrt(3.0);
  std::printf("%zu\t%zu\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n",
              scores.labels,
              scores.points,
              scores.area / (voxel * voxel) / 1000,
              scores.rims * voxel / scores.area,
              scores.seams * voxel / scores.area,
              static_cast<double>(scores.ends) / static_cast<double>(scores.labels),
              100.0 * static_cast<double>(scores.lost) / static_cast<double>(scores.points),
              scores.gap);
  return 0;
}

} // namespace
} // namespace voxelcore::evaluation

int
main(int argc, char ** argv)
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: VoxelCoreScanScores SCAN CORE.vtp\n");
    return 2;
  }
  try
  {
    return voxelcore::evaluation::Main(argv[1], argv[2]);
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
