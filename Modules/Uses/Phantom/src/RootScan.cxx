#include "voxelcore/Phantom/RootScan.h"

#include "Kinds.h"
#include "RootGrowth.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{
namespace
{

constexpr std::int32_t kScanSlab = 16; // planes in memory at a time
constexpr double       kTorn = 0.3;    // what is left of the root where it is torn

/** A round cone between two balls, and what it does to a voxel. */
struct Cone
{
  ConeEnd a;
  ConeEnd b;
};

void
Require(bool good, const char * what)
{
  if (!good)
  {
    throw UsageError(std::string("a scan of a root: ") + what);
  }
}

void
CheckScanOptions(const RootScanOptions & options)
{
  CheckPhantomOptions(options.root);
  Require(options.root.kind == "root", "choose the phantom 'root'");
  Require(options.hollow >= 0 && options.hollow <= 0.9, "give a hollow part of 0 to 0.9");
  Require(options.holes >= 0 && options.holes <= 10000, "give 0 to 10000 holes");
  Require(options.breaks >= 0 && options.breaks <= 10000, "give 0 to 10000 breaks");
  Require(options.noise >= 0 && options.noise <= 10, "give noise of 0 to 10 times the contrast");
  Require(options.rings >= 0 && options.rings <= 10, "give rings of 0 to 10 times the contrast");
  Require(!options.soil || std::isfinite(*options.soil), "give the height of the soil plane in mm");
}

/** The part of each voxel, 0 to 1, that lies in a union of cones, a slab of planes at a time. */
class Occupancy
{
public:
  Occupancy(const PhantomOptions & options, std::vector<Cone> cones)
    : m_Options(options)
    , m_Cones(std::move(cones))
    , m_Values(static_cast<std::size_t>(options.size[0]) * static_cast<std::size_t>(options.size[1]) * kScanSlab)
  {}

  /** Planes firstZ to lastZ, at most kScanSlab. */
  const std::vector<float> &
  Slab(std::int32_t firstZ, std::int32_t lastZ)
  {
    std::fill(m_Values.begin(), m_Values.end(), 0.0F);
    for (const Cone & cone : m_Cones)
    {
      Add(cone, firstZ, lastZ);
    }
    return m_Values;
  }

private:
  void
  Add(const Cone & cone, std::int32_t firstZ, std::int32_t lastZ)
  {
    const Vector3 & spacing = m_Options.spacing;
    const double    reach = std::max(cone.a.radius, cone.b.radius) + std::max({ spacing[0], spacing[1], spacing[2] });
    const auto      within = [&](std::size_t axis) {
      return VoxelsWithin(m_Options, axis, cone.a.position[axis], cone.b.position[axis], reach);
    };
    const auto [lowZ, highZ] = within(2);
    if (lowZ > lastZ || highZ < firstZ)
    {
      return;
    }
    const auto [lowX, highX] = within(0);
    const auto [lowY, highY] = within(1);
    const Vector3 along = Minus(cone.b.position, cone.a.position);
    const double  squared = Dot(along, along);
    const auto    row = static_cast<std::size_t>(m_Options.size[0]);
    const auto    plane = row * static_cast<std::size_t>(m_Options.size[1]);
    for (std::int32_t z = std::max(lowZ, firstZ); z <= std::min(highZ, lastZ); ++z)
    {
      for (std::int32_t y = lowY; y <= highY; ++y)
      {
        for (std::int32_t x = lowX; x <= highX; ++x)
        {
          const Vector3 centre{ (x + 0.5) * spacing[0], (y + 0.5) * spacing[1], (z + 0.5) * spacing[2] };
          const Vector3 offset = Minus(centre, cone.a.position);
          const double  t = squared > 0 ? std::clamp(Dot(offset, along) / squared, 0.0, 1.0) : 0.0;
          const Vector3 away = AddScaled(offset, -t, along);
          const double  distance = std::sqrt(Dot(away, away));
          const double  radius = cone.a.radius + t * (cone.b.radius - cone.a.radius);
          // How wide the voxel is across the surface: what a flat surface leaves of it changes linearly over that.
          double width = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            width += distance > 0 ? std::abs(away[axis]) / distance * spacing[axis] : spacing[axis] / 3;
          }
          const auto part = static_cast<float>(std::clamp(0.5 - (distance - radius) / width, 0.0, 1.0));
          float &    value = m_Values[static_cast<std::size_t>(z - firstZ) * plane + static_cast<std::size_t>(y) * row +
                                   static_cast<std::size_t>(x)];
          value = std::max(value, part);
        }
      }
    }
  }

  const PhantomOptions & m_Options;
  std::vector<Cone>      m_Cones;
  std::vector<float>     m_Values;
};

/** Everything that is root, lumen or torn, as cones; and where holes and breaks are. */
class ScannedRoot
{
public:
  ScannedRoot(const RootScanOptions & options, const std::vector<GrownPoint> & points)
    : m_Options(options)
    , m_Points(points)
    , m_Voxel(std::max({ options.root.spacing[0], options.root.spacing[1], options.root.spacing[2] }))
    , m_ToEnd(points.size(), 0)
  {
    for (std::size_t i = points.size(); i-- > 0;)
    {
      if (i + 1 < points.size() && points[i + 1].branch == points[i].branch)
      {
        m_ToEnd[i] = m_ToEnd[i + 1] + Distance(points[i].position, points[i + 1].position);
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t before = points[i].parent < 0 ? i : static_cast<std::size_t>(points[i].parent);
      body.push_back({ points[before], points[i] });
      const double from = LumenRadius(before);
      const double to = LumenRadius(i);
      if (from > 0 && to > 0 && points[before].branch == points[i].branch)
      {
        lumen.push_back({ { points[before].position, from }, { points[i].position, to } });
      }
    }
    AddHoles();
    AddBreaks();
  }

  std::vector<Cone>    body;
  std::vector<Cone>    lumen; ///< with the holes
  std::vector<Cone>    torn;
  std::vector<Vector3> holes;
  std::vector<Vector3> breaks;

private:
  /** 0 where the root is solid: it is too thin, or ends. */
  double
  LumenRadius(std::size_t i) const
  {
    const double radius = m_Points[i].radius;
    const double lumenRadius = std::min(m_Options.hollow * radius, radius - 1.8 * m_Voxel);
    const bool   atTop = m_Points[i].order == 0 && Distance(m_Points[i].position, m_Points[0].position) < radius;
    return lumenRadius >= 1.2 * m_Voxel && m_ToEnd[i] > radius && !atTop ? lumenRadius : 0;
  }

  /** Places along roots, evenly spread over the points `fits` lets pass; tangents are known there. */
  template <typename Fits>
  std::vector<std::size_t>
  Places(int count, std::uint64_t stream, const Fits & fits) const
  {
    std::vector<std::size_t> candidates;
    for (std::size_t i = 1; i + 1 < m_Points.size(); ++i)
    {
      if (m_Points[i - 1].branch == m_Points[i].branch && m_Points[i + 1].branch == m_Points[i].branch && fits(i))
      {
        candidates.push_back(i);
      }
    }
    SplitMix64               random(m_Options.root.seed, stream);
    std::vector<std::size_t> places;
    for (int i = 0; i < count && !candidates.empty(); ++i)
    {
      const double at = (i + random.Uniform()) / count * static_cast<double>(candidates.size());
      places.push_back(candidates[std::min(candidates.size() - 1, static_cast<std::size_t>(at))]);
    }
    return places;
  }

  Vector3
  Tangent(std::size_t i) const
  {
    return Direction(Minus(m_Points[i + 1].position, m_Points[i - 1].position));
  }

  void
  AddHoles()
  {
    SplitMix64 random(m_Options.root.seed, (std::uint64_t{ 1 } << 51) + 1);
    for (const std::size_t i :
         Places(m_Options.holes, std::uint64_t{ 1 } << 51, [this](std::size_t k) { return LumenRadius(k) > 0; }))
    {
      const Vector3 tangent = Tangent(i);
      Vector3       sideways = RandomInBall(random);
      sideways = Direction(AddScaled(sideways, -Dot(sideways, tangent), tangent));
      const Vector3 outside = AddScaled(m_Points[i].position, m_Points[i].radius + m_Voxel, sideways);
      lumen.push_back({ { m_Points[i].position, m_Voxel }, { outside, m_Voxel } });
      holes.push_back(AddScaled(m_Points[i].position, m_Points[i].radius, sideways));
    }
  }

  void
  AddBreaks()
  {
    const auto fits = [this](std::size_t k) {
      // Not where it springs from another, not right at a tip.
      const double radius = m_Points[k].radius;
      std::size_t  base = k;
      double       way = 0;
      while (m_Points[base].parent >= 0 && m_Points[base].branch == m_Points[k].branch && way < 12 * radius)
      {
        const auto before = static_cast<std::size_t>(m_Points[base].parent);
        way += Distance(m_Points[base].position, m_Points[before].position);
        base = before;
      }
      return m_Points[k].order > 0 && m_ToEnd[k] > 8 * radius && way >= 12 * radius;
    };
    for (const std::size_t i : Places(m_Options.breaks, std::uint64_t{ 1 } << 52, fits))
    {
      const ConeEnd from{ AddScaled(m_Points[i].position, -0.4 * m_Voxel, Tangent(i)), 0 };
      const ConeEnd to{ AddScaled(m_Points[i].position, 0.4 * m_Voxel, Tangent(i)), 0 };
      const double  radius = m_Points[i].radius + 0.5 * m_Voxel;
      torn.push_back({ { from.position, radius }, { to.position, radius } });
      breaks.push_back(m_Points[i].position);
    }
  }

  const RootScanOptions &         m_Options;
  const std::vector<GrownPoint> & m_Points;
  double                          m_Voxel;
  std::vector<double>             m_ToEnd; ///< mm along the branch
};

/** Nearly normal, by the sum of uniform numbers. */
double
Normal(SplitMix64 & random)
{
  double sum = 0;
  for (int i = 0; i < 6; ++i)
  {
    sum += random.Uniform();
  }
  return (sum - 3) * std::sqrt(2.0);
}

/** -1 to 1, the same for all voxels of a ring, which drifts over slices. */
double
RingAt(const PhantomOptions & options, std::int32_t x, std::int32_t y, std::int32_t z)
{
  const double dx = (x + 0.5 - 0.5 * options.size[0]) * options.spacing[0];
  const double dy = (y + 0.5 - 0.5 * options.size[1]) * options.spacing[1];
  const double smallest = std::min(options.spacing[0], options.spacing[1]);
  const auto   ring = static_cast<std::uint64_t>(std::sqrt(dx * dx + dy * dy) / (1.5 * smallest));
  SplitMix64   random(options.seed, (std::uint64_t{ 1 } << 53) + ring * 4096 + static_cast<std::uint64_t>(z / 32));
  return random.Uniform(-1, 1);
}

} // namespace

RootScan
MakeRootScan(const RootScanOptions & options, const ProgressCallback & progress)
{
  CheckScanOptions(options);
  const PhantomOptions & root = options.root;
  const GrownRoot        grown = GrowRoot(root);
  ScannedRoot            scanned(options, grown.points);
  RootScan               scan;
  scan.lines = CentreLinesOfRoot(root);
  scan.contacts = ContactsOfRoot(root);
  const auto inLattice = [&](const Vector3 & place) {
    return Vector3{ place[0] / root.spacing[0], place[1] / root.spacing[1], place[2] / root.spacing[2] };
  };
  std::transform(scanned.holes.begin(), scanned.holes.end(), std::back_inserter(scan.holes), inLattice);
  std::transform(scanned.breaks.begin(), scanned.breaks.end(), std::back_inserter(scan.breaks), inLattice);

  Occupancy         bodies(root, std::move(scanned.body));
  Occupancy         lumens(root, std::move(scanned.lumen));
  Occupancy         tears(root, std::move(scanned.torn));
  const auto        row = static_cast<std::size_t>(root.size[0]);
  const std::size_t plane = row * static_cast<std::size_t>(root.size[1]);
  scan.values.resize(plane * static_cast<std::size_t>(root.size[2]));
  for (std::int32_t firstZ = 0; firstZ < root.size[2]; firstZ += kScanSlab)
  {
    ReportProgress(progress, "sampling", static_cast<double>(firstZ) / root.size[2]);
    const std::int32_t lastZ = std::min(firstZ + kScanSlab, root.size[2]) - 1;
    const auto &       body = bodies.Slab(firstZ, lastZ);
    const auto &       lumen = lumens.Slab(firstZ, lastZ);
    const auto &       torn = tears.Slab(firstZ, lastZ);
    for (std::int32_t z = firstZ; z <= lastZ; ++z)
    {
      SplitMix64   random(root.seed, (std::uint64_t{ 1 } << 54) + static_cast<std::uint64_t>(z));
      const bool   inSoil = options.soil && (z + 0.5) * root.spacing[2] < *options.soil;
      const double air = inSoil ? kRootScanSoil : kRootScanAir;
      for (std::int32_t y = 0; y < root.size[1]; ++y)
      {
        for (std::int32_t x = 0; x < root.size[0]; ++x)
        {
          const std::size_t at = static_cast<std::size_t>(z - firstZ) * plane + static_cast<std::size_t>(y) * row +
                                 static_cast<std::size_t>(x);
          const double part = std::min<double>(body[at], 1 - lumen[at]) * (1 - (1 - kTorn) * torn[at]);
          double       value = air + part * (kRootScanRoot - air);
          if (options.noise > 0)
          {
            value += options.noise * Normal(random) * (kRootScanRoot - kRootScanAir);
          }
          if (options.rings > 0)
          {
            value += options.rings * RingAt(root, x, y, z) * (kRootScanRoot - kRootScanAir);
          }
          scan.values[static_cast<std::size_t>(z) * plane + static_cast<std::size_t>(y) * row +
                      static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0));
        }
      }
    }
  }
  return scan;
}

} // namespace voxelcore
