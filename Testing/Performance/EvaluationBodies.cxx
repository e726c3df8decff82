#include "EvaluationBodies.h"

#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace voxelcore::evaluation
{
namespace
{

constexpr double kStep = 0.25;

Vector
AddScaled(const Vector & a, const Vector & b, double t)
{
  return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

double
Length(const Vector & v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double
Distance(const Vector & a, const Vector & b)
{
  return Length({ a[0] - b[0], a[1] - b[1], a[2] - b[2] });
}

void
AddSegment(const Vector & a, const Vector & b, std::vector<Vector> & samples)
{
  const int steps = std::max(1, static_cast<int>(std::ceil(Distance(a, b) / kStep)));
  for (int i = 0; i <= steps; ++i)
  {
    samples.push_back(AddScaled(a, b, static_cast<double>(i) / steps));
  }
}

// Balls of linearly changing radius along a segment; for equal radii a capsule.
double
ConeDistance(const Vector & p, const Vector & a, const Vector & b, double ra, double rb)
{
  const double length = Distance(a, b);
  double       t = 0;
  for (int i = 0; i < 3; ++i)
  {
    t += (p[static_cast<std::size_t>(i)] - a[static_cast<std::size_t>(i)]) *
         (b[static_cast<std::size_t>(i)] - a[static_cast<std::size_t>(i)]);
  }
  t /= length * length;
  // Normals lean by the slope of the radius.
  const Vector foot = AddScaled(a, b, t);
  const double slope = (rb - ra) / length;
  t += Distance(p, foot) * slope / std::sqrt(std::max(1e-12, 1 - slope * slope)) / length;
  t = std::clamp(t, 0.0, 1.0);
  return Distance(p, AddScaled(a, b, t)) - (ra + t * (rb - ra));
}

Body
Cone(const std::string & name, double length, double ra, double rb)
{
  Body         body;
  const Vector a{ -length / 2, 0, 0 };
  const Vector b{ length / 2, 0, 0 };
  body.name = name;
  body.reach = length / 2 + std::max(ra, rb);
  body.distance = [=](const Vector & p) { return ConeDistance(p, a, b, ra, rb); };
  AddSegment(a, b, body.axis);
  body.tips = { a, b };
  return body;
}

// All within half the thickness of a rectangle at z = 0.
double
PlateDistance(const Vector & p, const Vector & centre, double x, double y, double thickness)
{
  const double dx = std::max(0.0, std::abs(p[0] - centre[0]) - x / 2);
  const double dy = std::max(0.0, std::abs(p[1] - centre[1]) - y / 2);
  return Length({ dx, dy, p[2] - centre[2] }) - thickness / 2;
}

void
AddPlate(const Vector & centre, double x, double y, std::vector<Vector> & samples)
{
  const int steps = static_cast<int>(std::ceil(y / kStep));
  for (int i = 0; i <= steps; ++i)
  {
    const double at = centre[1] - y / 2 + y * i / steps;
    AddSegment({ centre[0] - x / 2, at, centre[2] }, { centre[0] + x / 2, at, centre[2] }, samples);
  }
}

Body
Slab(double thickness)
{
  Body body;
  body.name = "slab " + std::to_string(static_cast<int>(thickness));
  const double x = 40;
  const double y = 24;
  body.reach = std::sqrt(x * x + y * y) / 2 + thickness / 2;
  body.distance = [=](const Vector & p) { return PlateDistance(p, { 0, 0, 0 }, x, y, thickness); };
  AddPlate({ 0, 0, 0 }, x, y, body.axis);
  return body;
}

// The nearest point of the surface is (s_i^2 p_i / (s_i^2 - t)) with t from 0 to the square of the shortest semi-axis.
double
EllipsoidDepth(const Vector & p, const Vector & semi)
{
  const auto foot = [&](double t) {
    Vector q{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      q[i] = semi[i] * semi[i] * p[i] / (semi[i] * semi[i] - t);
    }
    return q;
  };
  const auto level = [&](const Vector & q) { return Length({ q[0] / semi[0], q[1] / semi[1], q[2] / semi[2] }); };
  double     low = 0;
  double     high = semi[2] * semi[2] * (1 - 1e-12);
  for (int i = 0; i < 100; ++i)
  {
    const double middle = 0.5 * (low + high);
    (level(foot(middle)) < 1 ? low : high) = middle;
  }
  Vector       q = foot(low);
  const double flat = (q[0] * q[0]) / (semi[0] * semi[0]) + (q[1] * q[1]) / (semi[1] * semi[1]);
  if (level(q) < 1 - 1e-6 && flat < 1)
  {
    q[2] = semi[2] * std::sqrt(1 - flat); // on the axis both sides are as near
  }
  return Distance(p, q);
}

Body
Ellipsoid()
{
  Body             body;
  constexpr double a = 27;
  constexpr double b = 18;
  constexpr double c = 12;
  body.name = "ellipsoid";
  body.reach = a;
  body.distance = [](const Vector & p) {
    // First order: value over gradient.
    const double k = Length({ p[0] / a, p[1] / b, p[2] / c });
    const double g = Length({ p[0] / (a * a), p[1] / (b * b), p[2] / (c * c) });
    return g > 0 ? k * (k - 1) / g : -c;
  };
  body.depth = [](const Vector & p) { return EllipsoidDepth(p, { a, b, c }); };
  // Centres of curvature of the shortest axis bound it: an ellipse.
  const double rx = (a * a - c * c) / a;
  const double ry = (b * b - c * c) / b;
  for (double y = -ry; y <= ry; y += kStep)
  {
    const double half = rx * std::sqrt(std::max(0.0, 1 - y * y / (ry * ry)));
    AddSegment({ -half, y, 0 }, { half, y, 0 }, body.axis);
  }
  return body;
}

// A thick capsule with rods of radius 1.5, 2 and 3 and a plate three thick.
Body
ThickAndThin()
{
  Body             body;
  const Vector     a{ -14, 0, 0 };
  const Vector     b{ 14, 0, 0 };
  constexpr double thick = 11;
  body.name = "thick and thin";
  body.reach = 34;
  struct Rod
  {
    Vector from, to;
    double radius;
  };
  const std::vector<Rod> rods{ { { -12, 0, 0 }, { -12, 30, 0 }, 1.5 },
                               { { -3, 0, 0 }, { -3, 26, 12 }, 2 },
                               { { 8, 0, 0 }, { 8, 22, -20 }, 3 } };
  const Vector           plateCentre{ 0, -19, 0 };
  body.distance = [=](const Vector & p) {
    double d = ConeDistance(p, a, b, thick, thick);
    for (const Rod & rod : rods)
    {
      d = std::min(d, ConeDistance(p, rod.from, rod.to, rod.radius, rod.radius));
    }
    return std::min(d, PlateDistance(p, plateCentre, 20, 18, 3));
  };
  AddSegment(a, b, body.axis);
  body.tips = { a, b };
  for (const Rod & rod : rods)
  {
    // Outside the thick part and a little more, as the branch bends where it joins.
    const double length = Distance(rod.from, rod.to);
    AddSegment(AddScaled(rod.from, rod.to, (thick + 3) / length), rod.to, body.axis);
    AddSegment(rod.from, AddScaled(rod.from, rod.to, (thick + 3) / length), body.allowed);
    body.tips.push_back(rod.to);
  }
  AddPlate({ 0, -21.5, 0 }, 20, 13, body.axis);
  AddPlate({ 0, -8, 0 }, 20, 16, body.allowed);
  return body;
}

// A root system of thirteen branches, radii 1.5 to 3.2, no two of which come nearer than three lengths to each other.
class Root
{
public:
  static constexpr double side = 72;

  explicit Root(Body & body)
  {
    PhantomOptions options;
    options.kind = "root";
    options.size = { 72, 72, 72 };
    options.seed = 18;
    options.detail = 1.5;
    options.laterals = 7;
    options.subLaterals = 1;
    const std::vector<CentreLinePoint> lines = RootCentreLines(options);
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      const Vector & p = lines[i].position;
      m_Places.push_back({ p[0] - side / 2, p[1] - side / 2, p[2] - side / 2 });
      body.reach = std::max(body.reach, Length(m_Places[i]) + lines[i].radius);
      if (i + 1 == lines.size() || lines[i + 1].branch != lines[i].branch)
      {
        body.tips.push_back(m_Places[i]);
      }
    }
    body.tips.push_back(m_Places[0]);
    m_Cones.resize(cells * cells * cells);
    Vector joint{ 0, 0, 0 };
    double joined = 0; // what begins a branch lies in the branch before it
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
      const auto parent = static_cast<std::size_t>(lines[i].parent);
      if (lines[parent].branch != lines[i].branch)
      {
        joint = m_Places[parent];
        joined = lines[parent].radius + 3;
      }
      const bool free = lines[i].branch == lines[0].branch || Distance(m_Places[i], joint) > joined;
      AddSegment(m_Places[parent], m_Places[i], free ? body.axis : body.allowed);
      AddCone({ m_Places[parent],
                m_Places[i],
                lines[parent].radius,
                lines[i].radius,
                Distance(m_Places[parent], m_Places[i]) + std::max(lines[parent].radius, lines[i].radius) });
    }
  }

  double
  operator()(const Vector & p) const
  {
    double nearest = near;
    for (const Rod & rod : m_Cones[CellOf(p)])
    {
      const double reach = nearest + rod.reach;
      const double x = p[0] - rod.from[0];
      const double y = p[1] - rod.from[1];
      const double z = p[2] - rod.from[2];
      if (x * x + y * y + z * z < reach * reach)
      {
        nearest = std::min(nearest, ConeDistance(p, rod.from, rod.to, rod.first, rod.last));
      }
    }
    return nearest;
  }

private:
  struct Rod
  {
    Vector from, to;
    double first, last; // radii
    double reach;       // of its surface from where it begins
  };
  // Each cell lists the cones whose surface comes that near to some place in it: only there the distance is asked for.
  static constexpr double      near = 5;
  static constexpr double      cell = 4;
  static constexpr std::size_t cells = 32;

  static std::size_t
  Index(double x)
  {
    return static_cast<std::size_t>(std::clamp(std::floor(x / cell) + cells / 2, 0.0, cells - 1.0));
  }
  static std::size_t
  CellOf(const Vector & p)
  {
    return (Index(p[2]) * cells + Index(p[1])) * cells + Index(p[0]);
  }
  void
  AddCone(const Rod & rod)
  {
    std::array<std::size_t, 3> low{};
    std::array<std::size_t, 3> high{};
    const double               reach = near + std::max(rod.first, rod.last);
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = Index(std::min(rod.from[k], rod.to[k]) - reach);
      high[k] = Index(std::max(rod.from[k], rod.to[k]) + reach);
    }
    for (std::size_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::size_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::size_t x = low[0]; x <= high[0]; ++x)
        {
          m_Cones[(z * cells + y) * cells + x].push_back(rod);
        }
      }
    }
  }

  std::vector<Vector>           m_Places;
  std::vector<std::vector<Rod>> m_Cones;
};

Body
RootSystem()
{
  Body body;
  body.name = "root";
  const auto root = std::make_shared<const Root>(body);
  body.distance = [root](const Vector & p) { return (*root)(p); };
  return body;
}

} // namespace

std::vector<Body>
EvaluationBodies()
{
  std::vector<Body> bodies{ Ellipsoid() };
  for (const double radius : { 1.5, 2.0, 3.0, 5.0, 8.0 })
  {
    char name[32];
    std::snprintf(name, sizeof(name), "capsule %.1f", radius);
    bodies.push_back(Cone(name, 36, radius, radius));
  }
  for (const double thickness : { 3.0, 6.0, 12.0, 20.0 })
  {
    bodies.push_back(Slab(thickness));
  }
  bodies.push_back(Cone("cone", 40, 10, 2));
  bodies.push_back(ThickAndThin());
  bodies.push_back(RootSystem());
  for (Body & body : bodies)
  {
    if (!body.depth)
    {
      body.depth = [distance = body.distance](const Vector & p) { return -distance(p); };
    }
  }
  return bodies;
}

Placement
Place(const Body & body, const Vector & spacing, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const auto      uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  // A random unit quaternion (Shoemake).
  constexpr double turn = 6.283185307179586;
  const double     u = uniform();
  const double     v = turn * uniform();
  const double     w = turn * uniform();
  const double     q[4] = { std::sqrt(1 - u) * std::sin(v),
                            std::sqrt(1 - u) * std::cos(v),
                            std::sqrt(u) * std::sin(w),
                            std::sqrt(u) * std::cos(w) };
  Placement        placement;
  placement.axes = {
    { { 1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] + q[2] * q[3]), 2 * (q[0] * q[2] - q[1] * q[3]) },
      { 2 * (q[0] * q[1] - q[2] * q[3]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]), 2 * (q[1] * q[2] + q[0] * q[3]) },
      { 2 * (q[0] * q[2] + q[1] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 1 - 2 * (q[0] * q[0] + q[1] * q[1]) } }
  };
  placement.spacing = spacing;
  for (std::size_t i = 0; i < 3; ++i)
  {
    placement.shift[i] = spacing[i] * uniform();
    placement.size[i] = static_cast<std::int32_t>(std::ceil(2 * body.reach / spacing[i])) + 8;
  }
  return placement;
}

Vector
ToBody(const Placement & placement, const Vector & lattice)
{
  Vector p{ 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double mm = (lattice[i] - 0.5 * placement.size[i]) * placement.spacing[i] + placement.shift[i];
    for (std::size_t j = 0; j < 3; ++j)
    {
      p[j] += mm * placement.axes[i][j];
    }
  }
  return p;
}

VoxelShape
Sample(const Body & body, const Placement & placement, double noise, std::uint64_t seed)
{
  VoxelShape                       shape(VoxelBox{ { 0, 0, 0 }, placement.size });
  std::mt19937_64                  random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double voxel = std::cbrt(placement.spacing[0] * placement.spacing[1] * placement.spacing[2]);
  for (std::int32_t z = 0; z < placement.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < placement.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < placement.size[0]; ++x)
      {
        double d = body.distance(ToBody(placement, { x + 0.5, y + 0.5, z + 0.5 }));
        if (noise > 0 && std::abs(d) < 4 * noise * voxel)
        {
          d += noise * voxel * normal(random);
        }
        if (d <= 0)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  if (noise > 0)
  {
    shape = FillCavities(KeepLargestComponents(std::move(shape), 1).shape).shape;
  }
  return shape;
}

} // namespace voxelcore::evaluation
