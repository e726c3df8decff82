// How well pruned cores match known medial axes: lambda pruning, and pruning by bump height, on bodies at random
// rotations, three resolutions and two spacings, clean and rough. Half of the seeds were for tuning; the other half shows
// what is worth of it elsewhere. README.md has the table and what the columns mean.
//
//     VoxelCoreBumpEvaluation [--seeds tuned|aside] [--rotations N] [--body NAME] [--noise SD] [--mend-shape]
//                             [--smooth-shape] [--bumps H,H..] [--each] [--quick]

#include "ErosionPruning.h"
#include "EvaluationBodies.h"

#include "voxelcore/BallCoverage.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/BumpPruning.h"
#include "voxelcore/ComplexTopology.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ShapeSmoothing.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/VoxelCore.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <map>
#include <string>

namespace voxelcore::evaluation
{
namespace
{

struct Scores
{
  double spurArea = 0;
  double spurLength = 0;
  double extraEnds = 0;
  double lostEnds = 0;
  double lost = 0;
  double toTruth = 0;
  double toCore = 0;
  double gap = 0;
  double rotations = 0;
  double resolutions = 0;
  double seconds = 0;
};

std::array<double Scores::*, 11>
Columns()
{
  return { &Scores::spurArea,  &Scores::spurLength,  &Scores::extraEnds, &Scores::lostEnds,
           &Scores::lost,      &Scores::toTruth,     &Scores::toCore,    &Scores::gap,
           &Scores::rotations, &Scores::resolutions, &Scores::seconds };
}

class Points
{
public:
  explicit Points(const std::vector<Vector> & points)
    : m_Radii(points.size(), 0.0)
    , m_Tree(points, m_Radii, SpacingWeights{})
  {}

  double
  Distance(const Vector & p) const
  {
    return m_Tree.Gap(p);
  }

private:
  std::vector<double> m_Radii;
  BallTree            m_Tree;
};

double
Percentile95(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double
Percentile95(const std::vector<Vector> & from, const Points & to)
{
  std::vector<double> distances;
  for (const Vector & p : from)
  {
    distances.push_back(to.Distance(p));
  }
  return Percentile95(std::move(distances));
}

Vector
Middle(const std::vector<Vector> & at, std::span<const ElementIndex> corners)
{
  Vector sum{ 0, 0, 0 };
  for (const ElementIndex corner : corners)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      sum[i] += at[corner][i] / static_cast<double>(corners.size());
    }
  }
  return sum;
}

double
Length(const Vector & a, const Vector & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

double
Area(const std::vector<Vector> & at, std::span<const ElementIndex> corners)
{
  Vector sum{ 0, 0, 0 };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    const Vector & o = at[corners[0]];
    const Vector & p = at[corners[i]];
    const Vector & q = at[corners[i + 1]];
    for (std::size_t j = 0; j < 3; ++j)
    {
      const std::size_t k = (j + 1) % 3;
      const std::size_t l = (j + 2) % 3;
      sum[j] += 0.5 * ((p[k] - o[k]) * (q[l] - o[l]) - (p[l] - o[l]) * (q[k] - o[k]));
    }
  }
  return Length(sum, { 0, 0, 0 });
}

// A core in the body's place, as points about half a voxel apart, and its scores.
struct Result
{
  Scores              scores;
  std::vector<Vector> points;
};

Result
Score(const MedialComplex & core, const Body & body, const Placement & placement, const Points & truth, double voxel)
{
  const CellComplex & cells = core.cells;
  Result              result;
  Scores &            scores = result.scores;
  std::vector<Vector> at;
  for (const auto & position : core.positions)
  {
    at.push_back(ToBody(placement, position));
  }
  result.points = at;
  std::vector<int> facesAt(cells.edges.size(), 0);
  std::vector<int> edgesAt(cells.vertexCount, 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const Vector middle = Middle(at, cells.FaceVertices(face));
    result.points.push_back(middle);
    if (truth.Distance(middle) > 2 * voxel)
    {
      scores.spurArea += Area(at, cells.FaceVertices(face)) / (voxel * voxel);
    }
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      ++facesAt[edge];
    }
  }
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    const Vector & a = at[cells.edges[edge][0]];
    const Vector & b = at[cells.edges[edge][1]];
    const int      steps = static_cast<int>(2 * Length(a, b) / voxel) + 1;
    for (int i = 1; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / (steps + 1);
      result.points.push_back({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) });
    }
    if (facesAt[edge] == 0 && truth.Distance(Middle(at, cells.edges[edge])) > 2 * voxel)
    {
      scores.spurLength += Length(a, b) / voxel;
    }
    ++edgesAt[cells.edges[edge][0]];
    ++edgesAt[cells.edges[edge][1]];
  }
  scores.extraEnds = static_cast<double>(std::count(edgesAt.begin(), edgesAt.end(), 1));
  const Points found(result.points);
  for (const Vector & tip : body.tips)
  {
    scores.lostEnds += found.Distance(tip) > 3 * voxel ? 1 : 0;
  }
  // An end that stands for a true one is none too many.
  scores.extraEnds -= static_cast<double>(body.tips.size()) - scores.lostEnds;
  for (const Vector & p : body.axis)
  {
    scores.lost += found.Distance(p) > 2 * voxel ? 100.0 / static_cast<double>(body.axis.size()) : 0;
  }
  scores.toTruth = Percentile95(result.points, truth) / voxel;
  scores.toCore = Percentile95(body.axis, found) / voxel;
  return result;
}

double
Seconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Options
{
  std::uint64_t            firstSeed = 1;
  int                      rotations = 3;
  std::string              body;
  double                   noise = 0;
  bool                     each = false;
  bool                     quick = false;
  bool                     mend = false;
  bool                     smooth = false;
  std::vector<std::string> heights{ "1.5vox", "1diag", "2vox", "2.5vox" };
  std::vector<double>      lambdas{ 1, 1.5, 2, 2.5, 4 };
};

using Table = std::map<std::string, std::pair<Scores, int>>;

// One way of pruning on one body in all its samples.
void
Evaluate(const Body & body, const Options & options, std::vector<std::string> & names, Table & table)
{
  std::vector<Vector> all = body.axis;
  all.insert(all.end(), body.allowed.begin(), body.allowed.end());
  const Points truth(all);
  struct Sampled
  {
    std::vector<Vector> points;
    double              voxel;
  };
  // The first rotation at the finest and each coarser resolution, to compare with.
  std::map<std::string, Sampled> firstOfSpacing;
  std::map<std::string, Sampled> finest;
  for (const bool thick : { false, true })
  {
    for (const double fine : options.quick ? std::vector<double>{ 1.0 } : std::vector<double>{ 0.5, 0.7, 1.0 })
    {
      const Vector spacing = thick ? Vector{ fine, fine, 2.5 * fine } : Vector{ fine, fine, fine };
      // Lengths in the scores are in voxels: the side of a cube with the same diagonal.
      const double voxel = fine * std::sqrt((2 + (thick ? 6.25 : 1.0)) / 3);
      for (int rotation = 0; rotation < options.rotations; ++rotation)
      {
        const std::uint64_t  seed = options.firstSeed + 2 * static_cast<std::uint64_t>(rotation);
        const Placement      placement = Place(body, spacing, seed);
        VoxelShape           shape = Sample(body, placement, options.noise, seed);
        if (options.mend)
        {
          shape = MendShape(shape).shape;
        }
        if (options.smooth)
        {
          shape = SmoothShape(shape).shape;
        }
        const SpacingWeights weights = ComputeSpacingWeights(spacing);
        const auto           points = BoundaryVertices(shape);
        DelaunayCells        delaunay = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
        auto                 touching = LargestTouchingBalls(delaunay, points, weights);
        MedialComplex        core = BuildVoxelCore(shape, points, std::move(delaunay), weights);
        const auto           topology = ComputeComplexTopology(core.cells);
        const auto           add = [&](const std::string & name, const MedialComplex & pruned, double seconds) {
          Result result = Score(pruned, body, placement, truth, voxel);
          if (ComputeComplexTopology(pruned.cells) != topology)
          {
            std::fprintf(stderr, "%s of %s changed the topology\n", name.c_str(), body.name.c_str());
            std::exit(4);
          }
          result.scores.gap = LargestBoundaryGap(shape, weights, pruned.positions, pruned.radius).largest / voxel;
          result.scores.seconds = seconds;
          const Points found(result.points);
          const auto   compare = [&](const Sampled & other, double unit) {
            return std::max(Percentile95(other.points, found), Percentile95(result.points, Points(other.points))) /
                   unit;
          };
          const std::string key = name + (thick ? "t" : "c") + std::to_string(fine);
          const auto        first = firstOfSpacing.try_emplace(key, Sampled{ result.points, voxel });
          result.scores.rotations = first.second ? 0 : compare(first.first->second, voxel);
          const std::string fineKey = name + (thick ? "t" : "c") + std::to_string(rotation);
          const auto        second = finest.try_emplace(fineKey, Sampled{ result.points, voxel });
          result.scores.resolutions = second.second ? 0 : compare(second.first->second, voxel);
          if (table.find(name) == table.end())
          {
            names.push_back(name);
          }
          auto & [sum, count] = table[name];
          for (const auto column : Columns())
          {
            // How stable it is, and how large the gap, is a matter of the worst.
            const bool worst = column == &Scores::gap || column == &Scores::rotations || column == &Scores::resolutions;
            sum.*column = worst ? std::max(sum.*column, result.scores.*column) : sum.*column + result.scores.*column;
          }
          ++count;
        };
        double     start = Seconds();
        const auto lambdas = PruneByLambda(core, [&] {
          std::vector<double> thresholds;
          for (const double lambda : options.lambdas)
          {
            thresholds.push_back(lambda * fine);
          }
          return thresholds;
        }());
        double     seconds = (Seconds() - start) / static_cast<double>(std::max<std::size_t>(1, lambdas.size()));
        for (std::size_t i = 0; i < lambdas.size(); ++i)
        {
          char name[32];
          std::snprintf(name, sizeof(name), "lambda %.3gvox", options.lambdas[i]);
          add(name, lambdas[i], seconds);
        }
        start = Seconds();
        const auto eroded = PruneByErosionThickness(core, weights, fine, { 1.0 * fine, 2.0 * fine, 3.0 * fine });
        seconds = (Seconds() - start) / 3;
        for (std::size_t i = 0; i < eroded.size(); ++i)
        {
          add("erosion thickness " + std::to_string(i + 1) + "vox", eroded[i], seconds);
        }
        start = Seconds();
        core.bumps = ComputeBumps(core, weights, points, std::move(touching));
        seconds = Seconds() - start;
        for (const std::string & text : options.heights)
        {
          add("bumps " + text, PruneByBumps(core, BumpHeightInMillimetres(ParseBumpHeight(text), spacing)), seconds);
        }
      }
    }
  }
}

void
Print(const std::string & title, const std::vector<std::string> & names, const Table & table)
{
  std::printf(
    "\n%s\n\n| | spur area | spur length | extra ends | lost ends | lost %% | core to truth | truth to core | "
    "gap | rotations | resolutions | s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    title.c_str());
  for (const std::string & name : names)
  {
    const auto & [sum, count] = table.at(name);
    std::printf("| %s |", name.c_str());
    for (const auto column : Columns())
    {
      const bool worst = column == &Scores::gap || column == &Scores::rotations || column == &Scores::resolutions;
      std::printf(" %.*f |", column == &Scores::seconds ? 3 : 2, sum.*column / (worst ? 1 : count));
    }
    std::printf("\n");
  }
  std::fflush(stdout);
}

std::vector<std::string>
Split(const std::string & text)
{
  std::vector<std::string> parts;
  for (std::size_t first = 0; first <= text.size();)
  {
    const std::size_t comma = std::min(text.find(',', first), text.size());
    parts.push_back(text.substr(first, comma - first));
    first = comma + 1;
  }
  return parts;
}

int
Main(int argc, char ** argv)
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    const auto        value = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
    if (option == "--seeds")
    {
      options.firstSeed = value() == "aside" ? 2 : 1;
    }
    else if (option == "--rotations")
    {
      options.rotations = std::stoi(value());
    }
    else if (option == "--body")
    {
      options.body = value();
    }
    else if (option == "--noise")
    {
      options.noise = std::stod(value());
    }
    else if (option == "--bumps")
    {
      options.heights = Split(value());
    }
    else if (option == "--each")
    {
      options.each = true;
    }
    else if (option == "--mend-shape")
    {
      options.mend = true;
    }
    else if (option == "--smooth-shape")
    {
      options.smooth = true;
    }
    else if (option == "--quick")
    {
      options.quick = true;
    }
    else
    {
      std::fprintf(stderr, "unknown option %s\n", option.c_str());
      return 2;
    }
  }
  Table                    total;
  std::vector<std::string> names;
  for (const Body & body : EvaluationBodies())
  {
    if (!options.body.empty() && body.name.find(options.body) == std::string::npos)
    {
      continue;
    }
    Table                    table;
    std::vector<std::string> own;
    Evaluate(body, options, own, table);
    if (options.each)
    {
      Print(body.name, own, table);
    }
    for (const auto & [name, entry] : table)
    {
      auto & [sum, count] = total[name];
      for (const auto column : Columns())
      {
        const bool worst = column == &Scores::gap || column == &Scores::rotations || column == &Scores::resolutions;
        sum.*column = worst ? std::max(sum.*column, entry.first.*column) : sum.*column + entry.first.*column;
      }
      count += entry.second;
    }
    names = own;
  }
  if (!total.empty())
  {
    Print("all", names, total);
  }
  return 0;
}

} // namespace
} // namespace voxelcore::evaluation

int
main(int argc, char ** argv)
{
  return voxelcore::evaluation::Main(argc, argv);
}
