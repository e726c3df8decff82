// Random volumes, one after the other: the whole core by both engines and, of tiny ones, straight from its definition,
// rechecked by Verification; or everything that is certified, by both engines.
//
// usage: RandomVolumes definition|engines|certified FIRST_SEED COUNT
// Prints "ok N", or what differs with its seed, and then exits with 1.

#include "VoxelCoreTesting/BruteCore.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Verification/Verification.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Most are small; few reach the greatest side. */
std::int32_t
Side(Random & random, std::int32_t greatest)
{
  const double u = random.Unit();
  return 1 + static_cast<std::int32_t>(u * u * u * greatest);
}

/** Every density; half of them smoothed by majority, so that there are blobs, tubes and plates instead of dust. */
RandomVolume
MakeVolume(std::uint64_t seed, std::int32_t greatest)
{
  Random       random(seed);
  RandomVolume volume;
  volume.seed = seed;
  const Size3 size{ std::min(greatest, Side(random, greatest + 1)),
                    std::min(greatest, Side(random, greatest + 1)),
                    std::min(greatest, Side(random, greatest + 1)) };
  volume.density = 0.02 + 0.96 * random.Unit();
  if (random.Chance(0.5))
  {
    for (double & spacing : volume.spacing)
    {
      spacing = static_cast<double>(random.Between(1, random.Chance(0.3) ? 128 : 5));
    }
  }
  volume.shape = RandomShape(random, size, volume.density);
  for (std::int64_t turn = random.Between(-1, 2); turn > 0; --turn)
  {
    const VoxelShape before = volume.shape;
    volume.shape = ShapeWhere(size, [&](int x, int y, int z) {
      int in = 0;
      for (int k = 0; k < 27; ++k)
      {
        in += before.Contains(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1) ? 1 : 0;
      }
      return in > 13;
    });
  }
  return volume;
}

/** The double nearest to an exact number. */
double
Nearest(const BigRational & exact)
{
  const double value = static_cast<double>(exact);
  for (const double candidate : { value, std::nextafter(value, HUGE_VAL), std::nextafter(value, -HUGE_VAL) })
  {
    if (IsNearestDouble(candidate, exact))
    {
      return candidate;
    }
  }
  return std::nan("");
}

std::string
DifferenceFromDefinition(const MedialComplex & core, const VoxelShape & shape, const SpacingWeights & weights)
{
  const BruteCore brute = MakeBruteCore(shape, weights);
  const auto      measure = [&](const BigRational & squared) { return std::sqrt(Nearest(squared)) * weights.unit; };
  if (core.cells.vertexCount != brute.centres.size() || core.cells.edges.size() != brute.edges.size() ||
      core.cells.FaceCount() != brute.faces.size())
  {
    return "another number of elements than by definition";
  }
  for (std::size_t v = 0; v < brute.centres.size(); ++v)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (core.positions[v][axis] != Nearest(brute.centres[v][axis]))
      {
        return "a vertex lies elsewhere than by definition";
      }
    }
    if (core.radius[v] != measure(brute.squaredRadius[v]) || core.vertexLambda[v] != measure(brute.squaredMeasure[v]))
    {
      return "a vertex has another measure than by definition";
    }
  }
  std::size_t edge = 0;
  for (const auto & [ends, squared] : brute.edges)
  {
    if (core.cells.edges[edge] != std::array<ElementIndex, 2>{ ends[0], ends[1] } ||
        core.edgeLambda[edge] != measure(squared))
    {
      return "an edge is another than by definition";
    }
    ++edge;
  }
  std::size_t face = 0;
  for (const auto & [corners, squared] : brute.faces)
  {
    const auto polygon = core.cells.FaceVertices(face);
    Indices    sorted(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    if (sorted != corners || core.faceLambda[face] != measure(squared))
    {
      return "a face is another than by definition";
    }
    ++face;
  }
  return {};
}

/** Bit by bit; also -0 and 0 differ. */
template <typename Value>
bool
SameBytes(const std::vector<Value> & a, const std::vector<Value> & b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

bool
SameCore(const MedialComplex & a, const MedialComplex & b)
{
  return a.cells.vertexCount == b.cells.vertexCount && SameBytes(a.cells.edges, b.cells.edges) &&
         SameBytes(a.cells.faceOffsets, b.cells.faceOffsets) && SameBytes(a.cells.faceVertices, b.cells.faceVertices) &&
         SameBytes(a.positions, b.positions) && SameBytes(a.radius, b.radius) &&
         SameBytes(a.vertexLambda, b.vertexLambda) && SameBytes(a.edgeLambda, b.edgeLambda) &&
         SameBytes(a.faceLambda, b.faceLambda);
}

std::string
Verified(const MedialComplex & core, const RandomVolume & volume, const SpacingWeights & weights)
{
  VerificationInput input;
  input.shape = &volume.shape;
  input.weights = weights;
  input.spacing = volume.spacing;
  input.cells = &core.cells;
  input.positions = core.positions;
  input.radius = core.radius;
  input.vertexLambda = core.vertexLambda;
  input.edgeLambda = core.edgeLambda;
  input.faceLambda = core.faceLambda;
  const VerificationReport report = VerifyComplex(input);
  for (const VerificationCheck & check : report.checks)
  {
    if (!check.passed)
    {
      return check.name + ": " + check.firstOffender;
    }
  }
  return {};
}

std::string
TryEngines(const RandomVolume & volume, bool byDefinition)
{
  const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
  const MedialComplex  core = ComputeVoxelCore(volume.shape, weights, Engine::Lattice);
  if (byDefinition)
  {
    const std::string difference = DifferenceFromDefinition(core, volume.shape, weights);
    if (!difference.empty())
    {
      return difference;
    }
  }
  else if (HasEngine(Engine::TetGen) && !SameCore(core, ComputeVoxelCore(volume.shape, weights, Engine::TetGen)))
  {
    return "TetGen gives another core";
  }
  return volume.shape.CountVoxels() == 0 ? std::string() : Verified(core, volume, weights);
}

/** Pruned, refined, with skeleton and thickness: certified, or a CertificateError. */
std::string
TryCertified(const RandomVolume & volume)
{
  if (volume.shape.CountVoxels() == 0)
  {
    return {};
  }
  ImageGeometry geometry;
  geometry.spacing = volume.spacing;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    geometry.size[axis] = volume.shape.Box().size[axis];
  }
  CertifiedRequest request;
  request.crossCheck = HasEngine(Engine::TetGen);
  request.skeleton.emplace();
  request.skeleton->standOut = ParseLambda("3vox");
  request.skeleton->smooth = ParseLambda("6vox");
  request.thickness.emplace();
  const CertifiedResult result = ComputeCertified(volume.shape, geometry, request);
  const bool            isChecked = result.skeleton && result.skeleton->standOut;
  return result.cores.empty() || !isChecked || !result.thickness ? "something is missing" : "";
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "usage: RandomVolumes definition|engines|certified FIRST_SEED COUNT\n";
    return 2;
  }
  const std::string   kind = argv[1];
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[3], nullptr, 10);
  int                 found = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed)
  {
    const RandomVolume volume = kind == "definition" ? MakeRandomVolume(seed, 1, seed % 5 == 0 ? 4 : 3)
                                                     : MakeVolume(seed, seed % 8 == 0 ? 48 : 12);
    std::string        trouble;
    try
    {
      trouble = kind == "certified" ? TryCertified(volume) : TryEngines(volume, kind == "definition");
    }
    catch (const std::exception & error)
    {
      trouble = error.what();
    }
    if (!trouble.empty())
    {
      std::cout << volume.Describe() << ": " << trouble << std::endl;
      ++found;
    }
  }
  std::cout << "ok " << count - static_cast<std::uint64_t>(found) << std::endl;
  return found > 0 ? 1 : 0;
}
