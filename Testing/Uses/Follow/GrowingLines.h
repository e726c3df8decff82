#pragma once
// Trees of lines that grow, for tests.

#include "Uses/Compare/CompareGraphs.h"
#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Follow/RigidMotion.h"
#include "voxelcore/Lattice/Vectors.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore::testing
{

using Line = std::vector<Vector3>;

/** A way with steps of 1 mm whose direction wanders, not seldom against its first. */
inline Line
Wander(Random & random, const Vector3 & start, const Vector3 & way, int steps)
{
  Line    line{ start };
  Vector3 going = way;
  for (int step = 0; step < steps; ++step)
  {
    for (double & part : going)
    {
      part += 0.3 * (random.Unit() - 0.5);
    }
    going = AddScaled({}, 1 / Length(going), going);
    line.push_back(AddScaled(line.back(), 1, going));
  }
  return line;
}

/** A stem along z of 40 mm, and laterals that spring from its points; those are points of the stem's line, too. */
inline std::vector<Line>
RandomTree(Random & random, int laterals)
{
  std::vector<Line> lines{ Wander(random, { 3, -5, 8 }, { 0, 0, 1 }, 40) };
  for (int i = 0; i < laterals; ++i)
  {
    const double angle = 7 * random.Unit();
    const auto   at = static_cast<std::size_t>(random.Between(4, 34));
    lines.push_back(Wander(random,
                           lines[0][at],
                           { std::cos(angle), std::sin(angle), 0.4 * random.Unit() },
                           static_cast<int>(random.Between(6, 20))));
  }
  return lines;
}

/** Lines cut where others begin, as a skeleton has them. */
inline SkeletonGraph
TreeOf(const std::vector<Line> & lines, double radius)
{
  std::vector<Line> pieces;
  for (const Line & line : lines)
  {
    Line piece{ line.front() };
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      piece.push_back(line[i]);
      const bool begins = std::any_of(lines.begin(), lines.end(), [&](const Line & other) {
        return &other != &line && other.front() == line[i];
      });
      if (begins || i + 1 == line.size())
      {
        pieces.push_back(std::exchange(piece, { line[i] }));
      }
    }
  }
  return GraphOf(pieces, radius);
}

/** Any rotation, and a shift of some centimetres. */
inline RigidMotion
RandomMotion(Random & random)
{
  std::array<double, 4> q{};
  double                norm = 0;
  for (double & part : q)
  {
    part = 2 * random.Unit() - 1;
    norm += part * part;
  }
  for (double & part : q)
  {
    part /= std::sqrt(norm);
  }
  const auto [w, x, y, z] = q;
  RigidMotion motion;
  motion.rotation = { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                      2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                      2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y) };
  motion.shift = { 50 * random.Unit(), -30 * random.Unit(), 20 * random.Unit() };
  return motion;
}

inline SkeletonGraph
Moved(SkeletonGraph graph, const RigidMotion & motion)
{
  for (Vector3 & place : graph.positions)
  {
    place = motion(place);
  }
  return graph;
}

} // namespace voxelcore::testing
