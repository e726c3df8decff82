#pragma once
// A model's arrays in memory, as files of VTK's have them.

#include "ModelSink.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** The arrays of a model in memory. */
class PlainArrays : public ModelSink
{
public:
  struct Array
  {
    std::string               section;
    std::string               name;
    std::string               text;    ///< of a field of one string
    std::vector<double>       reals;   ///< or
    std::vector<std::int64_t> wholes;  ///< or
    std::vector<std::int32_t> indices; ///< 32 bits wide, of cells
    std::uint64_t             tuples = 0;
    int                       components = 1;
    bool                      isText = false;
    bool                      isReal = false;
    bool                      isNarrow = false;

    std::uint64_t
    Values() const
    {
      return tuples * static_cast<std::uint64_t>(components);
    }
    double
    Value(std::uint64_t i) const
    {
      return isReal ? reals[i] : static_cast<double>(isNarrow ? indices[i] : wholes[i]);
    }
  };

  double *
  Reals(const char * section, const char * name, std::uint64_t tuples, int components) override;
  std::int64_t *
  Wholes(const char * section, const char * name, std::uint64_t tuples, int components) override;
  void
  Text(const char * name, const std::string & value) override;

  /** Values that are there, tuple after tuple. */
  void
  Take(const char * section, const std::string & name, std::vector<double> values, int components = 1);
  void
  Take(const char * section, const std::string & name, std::vector<std::int64_t> values);

  std::vector<const Array *>
  Of(std::string_view section) const;
  /** What the sink was asked for; cells have arrays of their own. */
  const Array &
  Named(std::string_view section, std::string_view name) const;
  /** Of Verts, Lines or Polys. */
  std::uint64_t
  CellCount(std::string_view section) const
  {
    return Named(section, "offsets").tuples - 1;
  }
  std::uint64_t
  PointCount() const
  {
    return Named("Points", "Points").tuples;
  }

protected:
  CellBuffers<std::int32_t>
  NarrowCells(const char * section, std::uint64_t cells, std::uint64_t corners) override;
  CellBuffers<std::int64_t>
  WideCells(const char * section, std::uint64_t cells, std::uint64_t corners) override;

private:
  Array &
  Add(const char * section, const std::string & name, std::uint64_t tuples, int components);

  std::deque<Array> m_Arrays; // whose addresses stay
};

} // namespace voxelcore
