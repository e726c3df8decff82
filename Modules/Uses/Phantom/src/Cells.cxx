// Bodies that fill a volume as cells fill brain tissue seen under an electron microscope.

#include "RoundCone.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

/** Part of a body. */
struct Limb
{
  ConeEnd       from{};
  ConeEnd       to{};
  std::uint32_t body = 0;
};

/** Voxels x to x + length - 1 of a row. */
struct Run
{
  std::int32_t x;
  std::int32_t length;
  std::int32_t y;
  std::int32_t z;
};

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::int32_t  kSlab = 16; // planes at a time

/** What belongs to whom: a voxel belongs to the first limb that holds its centre, else to the nearest seed. */
class Tissue
{
public:
  explicit Tissue(const PhantomOptions & options)
    : m_Options(options)
    , m_Sides(Sides(options))
  {
    const auto   count = static_cast<std::uint32_t>(options.cells.value_or(2000));
    const double volume = m_Sides[0] * m_Sides[1] * m_Sides[2];
    m_Unit = std::cbrt(volume / count);
    // Three bodies in ten lie between the others, two are fragments, and the rest are neurites.
    const double apart = std::cbrt(volume / std::max(1.0, 0.3 * count));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Grid[axis] = static_cast<std::int32_t>(std::clamp(m_Sides[axis] / apart + 0.5, 1.0, 1.0 * count));
    }
    while (std::int64_t{ m_Grid[0] } * m_Grid[1] * m_Grid[2] > std::int64_t{ count })
    {
      --*std::max_element(m_Grid.begin(), m_Grid.end());
    }
    PlaceSeeds();
    const auto          left = count - static_cast<std::uint32_t>(m_Seeds.size());
    const std::uint32_t fragments = std::min(left, count / 5);
    for (std::uint32_t i = 0; i < fragments; ++i)
    {
      GrowFragment(i);
    }
    for (std::uint32_t i = fragments; i < left; ++i)
    {
      GrowNeurite(i);
    }
    m_FirstSeed = left;
  }

  std::uint32_t
  BodyCount() const
  {
    return m_FirstSeed + static_cast<std::uint32_t>(m_Seeds.size());
  }

  /** Adds the runs of each body in planes firstZ to lastZ; `owners` is room for them. */
  void
  Fill(std::int32_t                    firstZ,
       std::int32_t                    lastZ,
       std::vector<std::uint32_t> &    owners,
       std::vector<std::vector<Run>> & runs) const
  {
    const auto nx = static_cast<std::size_t>(m_Options.size[0]);
    const auto ny = static_cast<std::size_t>(m_Options.size[1]);
    owners.assign(nx * ny * static_cast<std::size_t>(lastZ - firstZ + 1), kNobody);
    const auto rowOf = [&](std::int32_t y, std::int32_t z) {
      return owners.data() + (static_cast<std::size_t>(z - firstZ) * ny + static_cast<std::size_t>(y)) * nx;
    };
    for (const Limb & limb : m_Limbs)
    {
      VisitRoundCone(m_Options, limb.from, limb.to, firstZ, lastZ, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        std::uint32_t & owner = rowOf(y, z)[x];
        owner = std::min(owner, limb.body);
      });
    }
    std::vector<Vector3> near; // seeds: distance squared across the row, place along it, number
    for (std::int32_t z = firstZ; z <= lastZ; ++z)
    {
      for (std::int32_t y = 0; y < m_Options.size[1]; ++y)
      {
        FillRest(rowOf(y, z), y, z, near);
        AddRuns(rowOf(y, z), y, z, runs);
      }
    }
  }

private:
  void
  PlaceSeeds()
  {
    SplitMix64 random(m_Options.seed, 1);
    for (std::int32_t k = 0; k < m_Grid[2]; ++k)
    {
      for (std::int32_t j = 0; j < m_Grid[1]; ++j)
      {
        for (std::int32_t i = 0; i < m_Grid[0]; ++i)
        {
          Vector3 seed{};
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            const std::int32_t at = axis == 0 ? i : axis == 1 ? j : k;
            seed[axis] = (at + random.Uniform(0.25, 0.75)) * m_Sides[axis] / m_Grid[axis];
          }
          m_Seeds.push_back(seed);
        }
      }
    }
  }

  Vector3
  RandomPlace(SplitMix64 & random) const
  {
    return { random.Uniform(0, m_Sides[0]), random.Uniform(0, m_Sides[1]), random.Uniform(0, m_Sides[2]) };
  }

  void
  GrowFragment(std::uint32_t body)
  {
    SplitMix64    random(m_Options.seed, 2 + std::uint64_t{ body });
    const Vector3 place = RandomPlace(random);
    const double  radius = m_Unit * random.Uniform(0.02, 0.09);
    const Vector3 end = AddScaled(place, 2 * radius, RandomInBall(random));
    m_Limbs.push_back({ { place, radius }, { end, 0.7 * radius }, body });
  }

  struct Sprout
  {
    Vector3 place{};
    Vector3 direction{};
    double  radius = 0;
    double  length = 0;
    int     order = 0;
  };

  /** Both ways from a place, with branches. Few are thick, most are slender. */
  void
  GrowNeurite(std::uint32_t body)
  {
    SplitMix64          random(m_Options.seed, 2 + std::uint64_t{ body });
    const double        chance = random.Uniform();
    const double        radius = m_Unit * (0.05 + 0.28 * chance * chance * chance);
    const Vector3       place = RandomPlace(random);
    const Vector3       direction = Direction(RandomInBall(random));
    const Vector3       back{ -direction[0], -direction[1], -direction[2] };
    std::vector<Sprout> sprouts{ { place, direction, radius, m_Unit * random.Uniform(1, 6), 0 },
                                 { place, back, radius, m_Unit * random.Uniform(1, 6), 0 } };
    for (std::size_t i = 0; i < sprouts.size(); ++i)
    {
      Grow(sprouts[i], body, random, sprouts);
    }
  }

  void
  Grow(const Sprout sprout, std::uint32_t body, SplitMix64 & random, std::vector<Sprout> & sprouts)
  {
    const double step = std::max(0.1 * m_Unit, 0.7 * sprout.radius);
    ConeEnd      end{ sprout.place, sprout.radius };
    Vector3      direction = sprout.direction;
    double       swelling = 0;
    double       done = 0;
    while (done < sprout.length && IsInside(end.position))
    {
      direction = Direction(AddScaled(direction, 0.45, RandomInBall(random)));
      swelling = 0.8 * swelling + random.Uniform(-0.25, 0.25); // within 1.25
      const ConeEnd next{ AddScaled(end.position, step, direction), sprout.radius * (1 + 0.5 * swelling) };
      m_Limbs.push_back({ end, next, body });
      end = next;
      if (sprout.order < 3 && random.Uniform() < 0.08)
      {
        sprouts.push_back({ end.position,
                            Direction(AddScaled(direction, 2, RandomInBall(random))),
                            std::max(0.7 * sprout.radius, 0.045 * m_Unit),
                            sprout.length * random.Uniform(0.15, 0.6),
                            sprout.order + 1 });
      }
      done += step;
    }
  }

  bool
  IsInside(const Vector3 & place) const
  {
    return place[0] >= 0 && place[1] >= 0 && place[2] >= 0 && place[0] <= m_Sides[0] && place[1] <= m_Sides[1] &&
           place[2] <= m_Sides[2];
  }

  /** Gives what no limb holds to the nearest seed, which lies in the same cell of the grid or beside it. */
  void
  FillRest(std::uint32_t * row, std::int32_t y, std::int32_t z, std::vector<Vector3> & near) const
  {
    const double placeY = (y + 0.5) * m_Options.spacing[1];
    const double placeZ = (z + 0.5) * m_Options.spacing[2];
    const auto   cellOf = [&](double place, std::size_t axis) {
      return std::min(static_cast<std::int32_t>(place / m_Sides[axis] * m_Grid[axis]), m_Grid[axis] - 1);
    };
    const std::int32_t cellY = cellOf(placeY, 1);
    const std::int32_t cellZ = cellOf(placeZ, 2);
    std::int32_t       known = -1; // whose seeds are in `near`
    for (std::int32_t x = 0; x < m_Options.size[0]; ++x)
    {
      if (row[x] != kNobody)
      {
        continue;
      }
      const double place = (x + 0.5) * m_Options.spacing[0];
      if (const std::int32_t cell = cellOf(place, 0); cell != known)
      {
        known = cell;
        FindSeeds({ cell, cellY, cellZ }, placeY, placeZ, near);
      }
      double best = std::numeric_limits<double>::infinity();
      double number = 0;
      for (const Vector3 & seed : near)
      {
        const double squared = seed[0] + (place - seed[1]) * (place - seed[1]);
        number = squared < best ? seed[2] : number;
        best = std::min(best, squared);
      }
      row[x] = m_FirstSeed + static_cast<std::uint32_t>(number);
    }
  }

  void
  FindSeeds(const std::array<std::int32_t, 3> & cell, double placeY, double placeZ, std::vector<Vector3> & near) const
  {
    near.clear();
    const auto first = [&](std::size_t axis) { return std::max(cell[axis] - 1, 0); };
    const auto last = [&](std::size_t axis) { return std::min(cell[axis] + 1, m_Grid[axis] - 1); };
    for (std::int32_t k = first(2); k <= last(2); ++k)
    {
      for (std::int32_t j = first(1); j <= last(1); ++j)
      {
        for (std::int32_t i = first(0); i <= last(0); ++i)
        {
          const auto      number = static_cast<std::size_t>((k * m_Grid[1] + j) * m_Grid[0] + i);
          const Vector3 & seed = m_Seeds[number];
          const double    dy = placeY - seed[1];
          const double    dz = placeZ - seed[2];
          near.push_back({ dy * dy + dz * dz, seed[0], static_cast<double>(number) });
        }
      }
    }
  }

  void
  AddRuns(const std::uint32_t * row, std::int32_t y, std::int32_t z, std::vector<std::vector<Run>> & runs) const
  {
    for (std::int32_t x = 0; x < m_Options.size[0];)
    {
      const std::int32_t first = x;
      while (x < m_Options.size[0] && row[x] == row[first])
      {
        ++x;
      }
      runs[row[first]].push_back({ first, x - first, y, z });
    }
  }

  const PhantomOptions &      m_Options;
  Vector3                     m_Sides;
  double                      m_Unit = 0; // side of the cube that is a body's share of the volume
  std::array<std::int32_t, 3> m_Grid{};   // of the seeds
  std::vector<Vector3>        m_Seeds;
  std::vector<Limb>           m_Limbs; // body by body
  std::uint32_t               m_FirstSeed = 0;
};

VoxelShape
ShapeOfRuns(const std::vector<Run> & runs)
{
  std::array<std::int32_t, 3> low{ runs.front().x, runs.front().y, runs.front().z };
  std::array<std::int32_t, 3> high = low;
  for (const Run & run : runs)
  {
    const std::array<std::int32_t, 3> first{ run.x, run.y, run.z };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], first[axis]);
      high[axis] = std::max(high[axis], first[axis] + (axis == 0 ? run.length - 1 : 0));
    }
  }
  VoxelShape shape(VoxelBox{ low, { high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1 } });
  for (const Run & run : runs)
  {
    for (std::int32_t x = run.x; x < run.x + run.length; ++x)
    {
      shape.Insert(x, run.y, run.z);
    }
  }
  return shape;
}

} // namespace

std::vector<VoxelShape>
MakeCells(const PhantomOptions & options, const ProgressCallback & progress)
{
  const Tissue       tissue(options);
  const std::int32_t planes = options.size[2];
  const auto         slabs = static_cast<std::size_t>((planes + kSlab - 1) / kSlab);
  // Parts are consecutive slabs, so that their runs follow one another.
  std::vector<std::vector<std::vector<Run>>> runs(slabs);
  RunInParts(slabs > 1, slabs, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> owners;
    for (std::size_t slab = first; slab < last; ++slab)
    {
      if (first == 0)
      {
        ReportProgress(progress, "sampling", 0.8 * static_cast<double>(slab) / static_cast<double>(last));
      }
      auto & mine = runs[first];
      mine.resize(tissue.BodyCount());
      const auto firstZ = static_cast<std::int32_t>(slab) * kSlab;
      tissue.Fill(firstZ, std::min(firstZ + kSlab, planes) - 1, owners, mine);
    }
  });
  std::vector<VoxelShape> shapes;
  std::vector<Run>        all;
  for (std::uint32_t body = 0; body < tissue.BodyCount(); ++body)
  {
    if (body % 64 == 0)
    {
      ReportProgress(progress, "sampling", 0.8 + 0.2 * body / tissue.BodyCount());
    }
    all.clear();
    for (auto & part : runs)
    {
      if (!part.empty())
      {
        all.insert(all.end(), part[body].begin(), part[body].end());
        std::vector<Run>().swap(part[body]);
      }
    }
    if (!all.empty()) // others may hold all of it
    {
      shapes.push_back(ShapeOfRuns(all));
    }
  }
  return shapes;
}

} // namespace voxelcore
