#pragma once
// Topology-preserving removal of simple pairs in order of a measure (paper, section 4, step 3; Liu et al. 2010).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Complex/CellComplex.h"

#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

/** The elements of a complex that are left, one flag (0 or 1) each. */
struct LiveElements
{
  std::vector<std::uint8_t> vertices;
  std::vector<std::uint8_t> edges;
  std::vector<std::uint8_t> faces;
};

/** A simple pair is an element e and an element f one dimension higher such that e bounds f and nothing else.
 *  Pairs of which both measures lie below the threshold are removed, always the smallest of all pairs simple at that
 *  moment: by measure of e, then of f, then dimension of e, then index of e. So afterwards no such pair is left. Where
 *  measures do not fall along incidences (face <= edge <= vertex, as the radius measure's), collapsing to one threshold
 *  and on to a greater one equals collapsing to the greater.
 *  The complex and the measures must outlive the object. */
class SimplePairCollapse
{
public:
  /** Measures in any unit, one per element, none NaN. */
  SimplePairCollapse(const CellComplex &     complex,
                     std::span<const double> vertexMeasure,
                     std::span<const double> edgeMeasure,
                     std::span<const double> faceMeasure);

  /** Removes all pairs below the threshold, which must not decrease from call to call.
   *  \throws Cancelled when the callback says so. */
  void
  CollapseBelow(double threshold, const ProgressCallback & progress = {});

  const LiveElements &
  Live() const
  {
    return m_Live;
  }

  /** The same of one that is done, whose memory for going on is given back. */
  LiveElements
  TakeLive() &&
  {
    std::vector<Cofaces>().swap(m_VertexCofaces);
    std::vector<Cofaces>().swap(m_EdgeCofaces);
    return std::move(m_Live);
  }

private:
  const CellComplex *     m_Complex;
  std::span<const double> m_VertexMeasure;
  std::span<const double> m_EdgeMeasure;
  std::span<const double> m_FaceMeasure;
  LiveElements            m_Live;
  std::vector<Cofaces>    m_VertexCofaces; // live ones
  std::vector<Cofaces>    m_EdgeCofaces;
};

/** The live part as a complex of its own; the order of elements is kept.
 *  vertexIds, edgeIds, faceIds receive, per element of the result, its index in `complex`. */
CellComplex
ExtractLive(const CellComplex &         complex,
            const LiveElements &        live,
            std::vector<ElementIndex> & vertexIds,
            std::vector<ElementIndex> & edgeIds,
            std::vector<ElementIndex> & faceIds);

/** The same in place; what is left over is given back. Corners of faces may be missing: they are made of the edges. */
void
KeepLive(CellComplex &               complex,
         const LiveElements &        live,
         std::vector<ElementIndex> & vertexIds,
         std::vector<ElementIndex> & edgeIds,
         std::vector<ElementIndex> & faceIds);

} // namespace voxelcore
