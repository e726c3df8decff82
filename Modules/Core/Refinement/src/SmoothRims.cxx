#include "SmoothRims.h"

#include "RimVertices.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{

namespace
{

// Measured on sheets of the AAL atlas: of the vertices along rims 41 % turn by more than 60 degrees at first, 4 % after
// 5 passes and 3 % after 8 more where it still does. More passes over all draw rims in, and triangles hold them up.
constexpr int    kPasses = 5;
constexpr int    kLatePasses = 8;
constexpr double kStep = 0.5;     // of the way
constexpr int    kHalvings = 3;   // of a step that may not be gone
constexpr double kUpright = 0.02; // the least cosine between normals of a triangle before and after

class RimMoves
{
public:
  RimMoves(const RefinementInput & input, const FormerBalls & former, RefinedCore & refined)
    : m_Input(input)
    , m_Former(former)
    , m_Refined(refined)
    , m_Rims(refined.core.cells, std::vector<std::uint8_t>(refined.core.cells.FaceCount(), 1))
    , m_Normals(m_Rims.Count())
    , m_HasMoved(m_Rims.Count(), 0)
  {
    for (std::size_t i = 0; i < m_Rims.Count(); ++i)
    {
      Vector3 sum{ 0, 0, 0 };
      for (const ElementIndex face : m_Rims.Faces(i))
      {
        const Vector3 normal = Normal(face, m_Refined.core.positions);
        sum = AddScaled(sum, Dot(sum, normal) < 0 ? -1 : 1, normal);
      }
      const double length = Length(sum);
      m_Normals[i] = length > 0 ? AddScaled({ 0, 0, 0 }, 1 / length, sum) : sum;
    }
  }

  std::vector<ElementIndex>
  Run()
  {
    for (int pass = 0; pass < kPasses; ++pass)
    {
      for (std::size_t i = 0; i < m_Rims.Count(); ++i)
      {
        Step(i);
      }
    }
    for (int pass = 0; pass < kLatePasses; ++pass)
    {
      const std::vector<std::uint8_t> late = NearTorn();
      for (std::size_t i = 0; i < m_Rims.Count(); ++i)
      {
        if (late[i] != 0)
        {
          Step(i);
        }
      }
    }
    std::vector<ElementIndex> moved;
    for (std::size_t i = 0; i < m_Rims.Count(); ++i)
    {
      if (m_HasMoved[i] != 0)
      {
        moved.push_back(m_Rims.Vertex(i));
      }
    }
    return moved;
  }

private:
  Vector3
  Place(ElementIndex vertex) const
  {
    return Times(m_Refined.core.positions[vertex], m_Input.spacing);
  }

  Vector3
  Normal(std::size_t face, const std::vector<Vector3> & positions) const
  {
    std::array<Vector3, 3> at;
    const auto             corners = m_Refined.core.cells.FaceVertices(face);
    for (std::size_t k = 0; k < 3; ++k)
    {
      at[k] = Times(positions[corners[k]], m_Input.spacing);
    }
    return Cross(Minus(at[1], at[0]), Minus(at[2], at[0]));
  }

  /** Which vertices, or the next ones to which, the rim is torn at. */
  std::vector<std::uint8_t>
  NearTorn() const
  {
    std::vector<std::uint8_t> torn(m_Refined.core.positions.size(), 0);
    for (std::size_t i = 0; i < m_Rims.Count(); ++i)
    {
      const auto & ends = m_Rims.Ends(i);
      if (CosineOfTurn(Place(ends[0]), Place(m_Rims.Vertex(i)), Place(ends[1])) < kTornRim)
      {
        torn[ends[0]] = torn[ends[1]] = torn[m_Rims.Vertex(i)] = 1;
      }
    }
    std::vector<std::uint8_t> near(m_Rims.Count());
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      near[i] = torn[m_Rims.Vertex(i)];
    }
    return near;
  }

  bool
  IsUpright(std::size_t i) const
  {
    const auto faces = m_Rims.Faces(i);
    return std::all_of(faces.begin(), faces.end(), [&](ElementIndex face) {
      const Vector3 before = Normal(face, m_Former.positions);
      const Vector3 now = Normal(face, m_Refined.core.positions);
      return Dot(before, now) > kUpright * Length(before) * Length(now);
    });
  }

  void
  Step(std::size_t i)
  {
    const ElementIndex vertex = m_Rims.Vertex(i);
    const Vector3      place = Place(vertex);
    const auto &       ends = m_Rims.Ends(i);
    const Vector3      middle = AddScaled(AddScaled({ 0, 0, 0 }, 0.5, Place(ends[0])), 0.5, Place(ends[1]));
    Vector3            step = AddScaled({ 0, 0, 0 }, kStep, Minus(middle, place));
    step = Over(AddScaled(step, -Dot(step, m_Normals[i]), m_Normals[i]), m_Input.spacing);
    Vector3 &     position = m_Refined.core.positions[vertex];
    Vector3 &     displacement = m_Refined.displacement[vertex];
    const Vector3 formerPosition = position;
    const Vector3 formerDisplacement = displacement;
    for (int halving = 0; halving <= kHalvings; ++halving)
    {
      constexpr double most = 1 - 1e-9; // voxels, as refinement goes
      displacement = AddScaled(formerDisplacement, std::ldexp(1.0, -halving), step);
      const double length = Length(displacement);
      displacement = AddScaled({ 0, 0, 0 }, length > most ? most / length : 1, displacement);
      position = AddScaled(m_Former.positions[vertex], 1, displacement);
      if (ContainsInside(*m_Input.shape, position) && IsUpright(i))
      {
        m_HasMoved[i] = 1;
        return;
      }
    }
    position = formerPosition;
    displacement = formerDisplacement;
  }

  const RefinementInput &   m_Input;
  const FormerBalls &       m_Former;
  RefinedCore &             m_Refined;
  const RimVertices         m_Rims;
  std::vector<Vector3>      m_Normals; ///< of the sheet at each; of length 1, mm along the grid
  std::vector<std::uint8_t> m_HasMoved;
};

} // namespace

std::vector<ElementIndex>
SmoothRims(const RefinementInput & input, const FormerBalls & former, RefinedCore & refined)
{
  return RimMoves(input, former, refined).Run();
}

} // namespace voxelcore
