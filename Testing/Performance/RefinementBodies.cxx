#include "RefinementBodies.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::evaluation
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

double
Norm(const Vector3 & v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void
AddTriangle(const Vector3 & a, const Vector3 & b, const Vector3 & c, TriangleSet & set)
{
  const auto first = static_cast<std::uint32_t>(set.vertices.size());
  set.vertices.insert(set.vertices.end(), { a, b, c });
  set.triangles.push_back({ first, first + 1, first + 2 });
}

void
AddQuad(const Vector3 & a, const Vector3 & b, const Vector3 & c, const Vector3 & d, TriangleSet & set)
{
  AddTriangle(a, b, c, set);
  AddTriangle(a, c, d, set);
}

// A patch point(u, v), 0 <= u, v <= 1.
template <typename TPoint>
void
AddPatch(int nu, int nv, TPoint point, TriangleSet & set)
{
  const auto first = static_cast<std::uint32_t>(set.vertices.size());
  for (int j = 0; j <= nv; ++j)
  {
    for (int i = 0; i <= nu; ++i)
    {
      set.vertices.push_back(point(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
    }
  }
  const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (nu + 1) + i); };
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      set.triangles.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      set.triangles.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
}

KnownBody
Ellipsoid(double size, double lambda)
{
  KnownBody    body;
  const double a = 0.45 * size;
  const double b = 0.30 * size;
  const double c = 0.20 * size;
  body.name = "ellipsoid";
  body.reach = a;
  body.value = [=](const Vector3 & p) { return c * (Norm({ p[0] / a, p[1] / b, p[2] / c }) - 1); };
  AddPatch(
    768,
    384,
    [=](double u, double v) {
      const double s = std::sin(kPi * v);
      return Vector3{ a * s * std::cos(2 * kPi * u), b * s * std::sin(2 * kPi * u), c * std::cos(kPi * v) };
    },
    body.surface);
  // The centres of curvature along the shortest axis bound it; lambda scales it (paper, section 5).
  const auto disc = [=](double scale, TriangleSet & set) {
    const double ra = scale * (a * a - c * c) / a;
    const double rb = scale * (b * b - c * c) / b;
    AddPatch(
      512,
      24,
      [=](double u, double v) {
        return Vector3{ ra * v * std::cos(2 * kPi * u), rb * v * std::sin(2 * kPi * u), 0 };
      },
      set);
  };
  disc(1, body.axis);
  disc(std::sqrt(1 - lambda * lambda / (c * c)), body.pruned);
  return body;
}

KnownBody
Torus(double size)
{
  KnownBody    body;
  const double ring = 0.35 * size;
  const double tube = 0.12 * size;
  body.name = "torus";
  body.reach = ring + tube;
  body.value = [=](const Vector3 & p) {
    const double d = std::sqrt(p[0] * p[0] + p[1] * p[1]) - ring;
    return std::sqrt(d * d + p[2] * p[2]) - tube;
  };
  AddPatch(
    1024,
    256,
    [=](double u, double v) {
      const double d = ring + tube * std::cos(2 * kPi * v);
      return Vector3{ d * std::cos(2 * kPi * u), d * std::sin(2 * kPi * u), tube * std::sin(2 * kPi * v) };
    },
    body.surface);
  constexpr int parts = 4096;
  for (int i = 0; i < parts; ++i)
  {
    const auto at = [=](int k) {
      return Vector3{ ring * std::cos(2 * kPi * k / parts), ring * std::sin(2 * kPi * k / parts), 0 };
    };
    AddTriangle(at(i), at(i + 1), at(i + 1), body.axis);
  }
  body.pruned = body.axis;
  return body;
}

// The part of a sphere of radius r about a centre with azimuth from, to and z / r = cos(polar angle), in units of pi.
void
AddSphere(const Vector3 & centre, double r, double from, double to, double polarFrom, double polarTo, TriangleSet & set)
{
  AddPatch(
    256,
    256,
    [=](double u, double v) {
      const double azimuth = from + u * (to - from);
      const double polar = kPi * (polarFrom + v * (polarTo - polarFrom));
      const double s = r * std::sin(polar);
      return Vector3{ centre[0] + s * std::cos(azimuth),
                      centre[1] + s * std::sin(azimuth),
                      centre[2] + r * std::cos(polar) };
    },
    set);
}

KnownBody
Capsule(double size)
{
  KnownBody    body;
  const double half = 0.30 * size;
  const double r = 0.14 * size;
  body.name = "capsule";
  body.reach = half + r;
  body.value = [=](const Vector3 & p) { return Norm({ p[0], p[1], p[2] - std::clamp(p[2], -half, half) }) - r; };
  AddPatch(
    512,
    64,
    [=](double u, double v) {
      return Vector3{ r * std::cos(2 * kPi * u), r * std::sin(2 * kPi * u), half * (2 * v - 1) };
    },
    body.surface);
  AddSphere({ 0, 0, half }, r, 0, 2 * kPi, 0, 0.5, body.surface);
  AddSphere({ 0, 0, -half }, r, 0, 2 * kPi, 0.5, 1, body.surface);
  AddTriangle({ 0, 0, -half }, { 0, 0, half }, { 0, 0, half }, body.axis);
  body.pruned = body.axis;
  return body;
}

// All within r of a rectangle at z = 0.
KnownBody
RoundedSlab(double size)
{
  KnownBody    body;
  const double x = 0.36 * size;
  const double y = 0.24 * size;
  const double r = 0.10 * size;
  body.name = "rounded slab";
  body.reach = std::sqrt(x * x + y * y) + r;
  body.value = [=](const Vector3 & p) {
    return Norm({ std::max(0.0, std::abs(p[0]) - x), std::max(0.0, std::abs(p[1]) - y), p[2] }) - r;
  };
  AddQuad({ -x, -y, r }, { x, -y, r }, { x, y, r }, { -x, y, r }, body.surface);
  AddQuad({ -x, -y, -r }, { x, -y, -r }, { x, y, -r }, { -x, y, -r }, body.surface);
  for (const double side : { -1.0, 1.0 })
  {
    AddPatch(
      1,
      256,
      [=](double u, double v) {
        return Vector3{ x * (2 * u - 1), side * (y + r * std::sin(kPi * v)), r * std::cos(kPi * v) };
      },
      body.surface);
    AddPatch(
      1,
      256,
      [=](double u, double v) {
        return Vector3{ side * (x + r * std::sin(kPi * v)), y * (2 * u - 1), r * std::cos(kPi * v) };
      },
      body.surface);
    AddSphere({ x, side * y, 0 }, r, side > 0 ? 0 : -0.5 * kPi, side > 0 ? 0.5 * kPi : 0, 0, 1, body.surface);
    AddSphere({ -x, side * y, 0 }, r, side > 0 ? 0.5 * kPi : kPi, side > 0 ? kPi : 1.5 * kPi, 0, 1, body.surface);
  }
  AddQuad({ -x, -y, 0 }, { x, -y, 0 }, { x, y, 0 }, { -x, y, 0 }, body.axis);
  body.pruned = body.axis;
  return body;
}

// Between the walls at distance d from both: a strip from depth `from` to the depth c of the middle.
void
AddBoxAxis(double a, double b, double c, double from, TriangleSet & set)
{
  for (const double s : { -1.0, 1.0 })
  {
    for (const double t : { -1.0, 1.0 })
    {
      const auto alongX = [=](double d, double end) { return Vector3{ end * (a - d), s * (b - d), t * (c - d) }; };
      const auto alongY = [=](double d, double end) { return Vector3{ s * (a - d), end * (b - d), t * (c - d) }; };
      const auto alongZ = [=](double d, double end) { return Vector3{ s * (a - d), t * (b - d), end * (c - d) }; };
      AddQuad(alongX(from, -1), alongX(from, 1), alongX(c, 1), alongX(c, -1), set);
      AddQuad(alongY(from, -1), alongY(from, 1), alongY(c, 1), alongY(c, -1), set);
      AddQuad(alongZ(from, -1), alongZ(from, 1), alongZ(c, 1), alongZ(c, -1), set);
    }
  }
  AddQuad({ -(a - c), -(b - c), 0 }, { a - c, -(b - c), 0 }, { a - c, b - c, 0 }, { -(a - c), b - c, 0 }, set);
}

KnownBody
SharpBox(double size, double lambda)
{
  KnownBody    body;
  const double a = 0.38 * size;
  const double b = 0.27 * size;
  const double c = 0.17 * size;
  body.name = "sharp box";
  body.reach = Norm({ a, b, c });
  body.value = [=](const Vector3 & p) {
    return std::max({ std::abs(p[0]) - a, std::abs(p[1]) - b, std::abs(p[2]) - c });
  };
  for (const double s : { -1.0, 1.0 })
  {
    AddQuad({ -a, -b, s * c }, { a, -b, s * c }, { a, b, s * c }, { -a, b, s * c }, body.surface);
    AddQuad({ -a, s * b, -c }, { a, s * b, -c }, { a, s * b, c }, { -a, s * b, c }, body.surface);
    AddQuad({ s * a, -b, -c }, { s * a, b, -c }, { s * a, b, c }, { s * a, -b, c }, body.surface);
  }
  AddBoxAxis(a, b, c, 0, body.axis);
  AddBoxAxis(a, b, c, std::sqrt(2.0) * lambda, body.pruned);
  return body;
}

// All within r of three rectangles that meet along z at equal angles.
// Where the seam of three sheets ends, under the top of its body, each crease between two walls turns away as the
// crease between two round ends. Balls touch it twice: on its upright part, and on its bent part at angle t (0 where it
// begins to bend, 90 degrees at the top). Their centres are a roof over the seam's end. `away` is how far from the
// seam, towards the crease, and `below` how far under the beginning of the bend.
struct RoofPoint
{
  double away = 0;
  double below = 0;
  double measure = 0; ///< half the distance between its feet
};

// Both feet are equally far, and the second is nearest along the bend:
// below^2 - r^2 sin^2 t / 3 + 2 below r sin t + x (1 - cos t) = 0, x = 2 r cos t / sin t (r sin t / 3 - below), away =
// x sqrt(3) / 4 r.
RoofPoint
RoofAt(double t, double r)
{
  const double sine = std::sin(t);
  const double rest = 1 - std::cos(t);
  RoofPoint    point;
  point.below = rest * r * (std::sqrt(1 / (sine * sine) + 1.0 / 3) - 1 / sine);
  point.away = std::sqrt(3.0) / 2 * std::cos(t) / sine * (r * sine / 3 - point.below);
  point.measure = 0.5 * Norm({ 2 * r / std::sqrt(3.0) * rest, point.below + r * sine, 0 });
  return point;
}

KnownBody
Junction(double size, double lambda)
{
  KnownBody    body;
  const double arm = 0.36 * size;
  const double half = 0.28 * size;
  const double r = 0.09 * size;
  body.name = "Y of sheets";
  body.reach = std::sqrt(arm * arm + half * half) + r;
  const auto direction = [](int k) { return Vector3{ std::cos(2 * kPi * k / 3), std::sin(2 * kPi * k / 3), 0 }; };
  std::array<Vector3, 3> arms{ direction(0), direction(1), direction(2) };
  body.value = [=](const Vector3 & p) {
    const double z = std::max(0.0, std::abs(p[2]) - half);
    double       best = 1e300;
    for (const Vector3 & e : arms)
    {
      const double along = std::clamp(p[0] * e[0] + p[1] * e[1], 0.0, arm);
      best = std::min(best, Norm({ p[0] - along * e[0], p[1] - along * e[1], z }));
    }
    return best - r;
  };
  const double tan60 = std::sqrt(3.0);
  for (int k = 0; k < 3; ++k)
  {
    const Vector3 e = arms[static_cast<std::size_t>(k)];
    const auto    at = [=](double along, double aside, double z) {
      return Vector3{ along * e[0] - aside * e[1], along * e[1] + aside * e[0], z };
    };
    for (const double side : { -1.0, 1.0 })
    {
      // Walls begin at the crease; the round ends above and below begin where the next arm's do.
      AddQuad(at(r / tan60, side * r, -half),
              at(arm, side * r, -half),
              at(arm, side * r, half),
              at(r / tan60, side * r, half),
              body.surface);
      AddPatch(
        64,
        256,
        [=](double u, double v) {
          const double aside = r * std::cos(kPi * v);
          const double from = std::abs(aside) / tan60;
          return at(from + u * (arm - from), aside, side * (half + r * std::sin(kPi * v)));
        },
        body.surface);
      AddSphere(at(arm, 0, side * half),
                r,
                2 * kPi * k / 3 - 0.5 * kPi,
                2 * kPi * k / 3 + 0.5 * kPi,
                side > 0 ? 0 : 0.5,
                side > 0 ? 0.5 : 1,
                body.surface);
    }
    AddPatch(
      1,
      256,
      [=](double u, double v) { return at(arm + r * std::sin(kPi * v), r * std::cos(kPi * v), half * (2 * u - 1)); },
      body.surface);
    AddQuad({ 0, 0, -half }, at(arm, 0, -half), at(arm, 0, half), { 0, 0, half }, body.axis);
  }
  // Above a roof a ball about a sheet touches both of its creases on their bends, at t, r cos t to either side. Balls
  // of one t are on a straight line, from the roof to half a length up.
  const double    last = std::acos(std::min(1.0, lambda / r));
  const RoofPoint ridge = RoofAt(last, r);
  for (const Vector3 & e : arms)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const auto addUpTo = [&](int parts, auto along, auto below) {
        AddPatch(
          parts,
          32,
          [&](double u, double v) {
            return Vector3{ along(u) * e[0], along(u) * e[1], side * v * (half - below(u)) };
          },
          body.pruned);
      };
      const auto on = [=](double u) { return RoofAt(0.5 * kPi + u * (last - 0.5 * kPi), r); };
      addUpTo(
        32,
        [&](double u) { return 2 * on(u).away; },
        [&](double u) { return on(u).below; });
      const double end = r * std::cos(last) / std::sqrt(3.0);
      addUpTo(
        1,
        [&](double u) { return 2 * ridge.away + u * (end - 2 * ridge.away); },
        [&](double u) { return (1 - u) * ridge.below; });
      addUpTo(
        1,
        [&](double u) { return end + u * (arm - end); },
        [](double) { return 0.0; });
    }
  }
  const auto roofs = [&](double from, TriangleSet & set) {
    for (int k = 0; k < 3; ++k)
    {
      // Towards the crease between two arms, as wide as their sheets let it.
      const Vector3 & e = arms[static_cast<std::size_t>(k)];
      for (const double side : { -1.0, 1.0 })
      {
        AddPatch(
          1,
          32,
          [=](double u, double v) {
            const RoofPoint point = RoofAt(from + v * (0.5 * kPi - from), r);
            const double    aside = point.away * std::sqrt(3.0) * (2 * u - 1);
            return Vector3{ -point.away * e[0] - aside * e[1],
                            -point.away * e[1] + aside * e[0],
                            side * (half - point.below) };
          },
          set);
      }
    }
  };
  roofs(1e-3, body.axis);
  double low = 1e-3;
  double high = 0.5 * kPi;
  while (high - low > 1e-6)
  {
    const double middle = 0.5 * (low + high);
    (RoofAt(middle, r).measure < lambda ? low : high) = middle;
  }
  roofs(high, body.pruned);
  return body;
}

} // namespace

std::vector<KnownBody>
KnownBodies(double size, double lambda)
{
  return { Ellipsoid(size, lambda), Torus(size),           Capsule(size), RoundedSlab(size),
           SharpBox(size, lambda),  Junction(size, lambda) };
}

} // namespace voxelcore::evaluation
