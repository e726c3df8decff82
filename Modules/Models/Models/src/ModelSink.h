#pragma once
// Where a model's arrays go: to VTK's polydata in memory, or straight into a file.

#include "voxelcore/Models/MedialModel.h"

#include <cstdint>
#include <string>
#include <type_traits>

namespace voxelcore
{

/** Makes room for arrays, under sections and names as ModelSource has them. Pointers stay valid until the sink ends;
 *  the caller fills them. */
class ModelSink
{
public:
  template <typename Index>
  struct CellBuffers
  {
    Index * offsets; ///< cells + 1
    Index * points;
  };

  virtual ~ModelSink() = default;
  virtual double *
  Reals(const char * section, const char * name, std::uint64_t tuples, int components = 1) = 0;
  virtual std::int64_t *
  Wholes(const char * section, const char * name, std::uint64_t tuples, int components = 1) = 0;
  /** A field of one string. */
  virtual void
  Text(const char * name, const std::string & value) = 0;

  /** Of the section Verts, Lines or Polys, in this order. Index: 32 or 64 bits. */
  template <typename Index>
  CellBuffers<Index>
  Cells(const char * section, std::uint64_t cells, std::uint64_t corners)
  {
    if constexpr (std::is_same_v<Index, std::int32_t>)
    {
      return NarrowCells(section, cells, corners);
    }
    else
    {
      return WideCells(section, cells, corners);
    }
  }

protected:
  virtual CellBuffers<std::int32_t>
  NarrowCells(const char * section, std::uint64_t cells, std::uint64_t corners) = 0;
  virtual CellBuffers<std::int64_t>
  WideCells(const char * section, std::uint64_t cells, std::uint64_t corners) = 0;
};

/** All that a .vtp holds of a model, with `keepEdges` also EdgeVertices and EdgeLambda.
 *  \throws UsageError when edges are to be kept whose measures are not known. */
void
WriteParts(const MedialModel & model, bool keepEdges, ModelSink & sink);

} // namespace voxelcore
