#pragma once
// The part of a core that is being refined: where its vertices have moved to, and what its elements measure there.

#include "CorePart.h"
#include "FootPoints.h"
#include "KeepCovered.h"
#include "Triangles.h"
#include "VertexPairs.h"

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/Refinement.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace voxelcore
{

/** Of an element, by the widths of its corners. */
double
MeasureOf(std::span<const double> widths);

/** The part of a core that is worked on, as triangles, and between which boundary vertices each of its elements
 *  lies. */
class RefinementState
{
public:
  RefinementState(const RefinementInput & input, CorePart part);

  /** Of the balls that touch each boundary vertex, mm; 0 where none does. */
  std::vector<double>
  GreatestRadii() const;

  /** Moves vertices to where their balls touch alike, and measures them there. Where nothing is pruned, those on lines
   *  are measured when Finish() has moved them on. */
  void
  Move(const FootPointFinder & finder, bool isPruned, const ProgressCallback & progress);

  /** What is left at a threshold in mm (0: all, without measures), and where its balls were before they were moved. */
  RefinedCore
  Finish(const FootPointFinder & finder, double threshold, FormerBalls & former);

  /** Smooths the rims of what Finish() left at threshold 0, and takes radii there. */
  void
  MoveRims(const FootPointFinder & finder, const FormerBalls & former, RefinedCore & refined);

  /** Of what Finish() left at threshold 0 some vertices have gone elsewhere: they are measured there. */
  void
  MeasureAgain(const FootPointFinder & finder, const std::vector<ElementIndex> & moved, const RefinedCore & refined);

  /** What Finish() left at threshold 0 gets its measures. Once. */
  void
  GiveMeasures(MedialComplex & core);

private:
  std::span<const PointPair>
  Pairs(std::size_t vertex) const
  {
    return m_Pairs.Of(vertex);
  }

  Vector3
  Place(std::size_t vertex) const
  {
    return Times(AddScaled(m_Positions[vertex], 1, m_Displacement[vertex]), m_Input.spacing);
  }

  /** Returns how far, in voxels. */
  double
  MoveVertex(const FootPointFinder &    finder,
             std::size_t                vertex,
             std::span<const PointPair> pairs,
             std::vector<FootPoint> &   footPoints);
  void
  MoveInPasses(const FootPointFinder &    finder,
               std::size_t                vertex,
               std::span<const PointPair> pairs,
               std::vector<FootPoint> &   footPoints);
  double
  MeasureAt(const FootPointFinder &    finder,
            const Vector3 &            place,
            std::span<const PointPair> pairs,
            std::vector<FootPoint> &   footPoints,
            std::span<double>          widths,
            double &                   swelling) const;
  void
  MeasureVertex(const FootPointFinder & finder, std::size_t vertex, std::vector<FootPoint> & footPoints);
  void
  MeasureVertices(const FootPointFinder & finder, const std::vector<ElementIndex> & vertices);
  double
  WidthAt(ElementIndex vertex, const PointPair & pair) const;
  void
  MeasureElements(const CellComplex & cells);
  std::vector<ElementIndex>
  MoveLines(const FootPointFinder & finder, const CorePart & part, const std::vector<Vector3> & wanted);
  std::vector<ElementIndex>
  MoveRims(const FootPointFinder & finder, const CorePart & part, double threshold);
  /** Whether it has moved. */
  bool
  MoveRimVertex(const FootPointFinder &  finder,
                double                   threshold,
                ElementIndex             vertex,
                const Vector3 &          outwards,
                std::vector<PointPair> & pairs);
  /** A vertex where it is, with what was measured there. */
  struct Corner
  {
    Vector3             displacement{};
    double              radius = 0;
    double              swelling = 0;
    std::vector<double> widths;
  };
  using FacesAt = std::function<std::span<const std::pair<ElementIndex, ElementIndex>>(ElementIndex)>;
  Corner
  CornerAt(ElementIndex vertex) const;
  void
  Put(ElementIndex vertex, const Corner & corner);
  double
  MeasureOfFace(ElementIndex face) const;
  bool
  HasTurned(ElementIndex face) const;
  void
  DrawIn(const FootPointFinder & finder,
         double                  threshold,
         ElementIndex            vertex,
         std::uint32_t           width,
         const Vector3 &         to);
  bool
  DrawIn(const FootPointFinder & finder,
         double                  threshold,
         ElementIndex            face,
         const FacesAt &         facesAt,
         std::array<Corner, 3> & drawn);
  std::vector<ElementIndex>
  TakeBackAtRims(const FootPointFinder & finder, CorePart & part, double threshold);
  CorePart
  LendAll();
  LiveElements
  Collapse(const CorePart & part, double threshold) const;

  const RefinementInput &   m_Input;    ///< core and edgePoints are asked for in the constructor alone
  CellComplex               m_Cells;    ///< lent to what is refined as it is
  std::vector<ElementIndex> m_Polygons; ///< of each triangle the face it is a part of; given with the cells
  VertexPairs               m_Pairs;
  std::vector<Vector3>      m_Positions;
  std::vector<Vector3>      m_Displacement;
  std::vector<double>       m_FormerRadius;
  std::vector<double>       m_FormerLambda;

  std::vector<double>                               m_Widths;       ///< of each pair of each vertex, mm
  std::vector<std::uint32_t>                        m_CornerWidths; ///< whose each corner of each triangle's is
  std::vector<double>                               m_Radius;
  std::vector<double>                               m_Swelling; ///< by how much of a radius walls are too thick, mm
  std::vector<double>                               m_VertexMeasure;
  std::vector<double>                               m_EdgeMeasure;
  std::vector<double>                               m_FaceMeasure;
  std::vector<std::pair<ElementIndex, std::size_t>> m_LooseEdges; ///< with where its pairs end in m_LoosePairs
  std::vector<PointPair>                            m_LoosePairs;
};

} // namespace voxelcore
