#pragma once
// VTK's legacy polydata: its sections, its cells, and where the values of each array are.

#include "LegacyWords.h"

#include <map>
#include <utility>

namespace voxelcore
{

/** An array as the words before it describe it. */
struct LegacyArray
{
  NumberType    type; ///< 0 bytes for text and bits
  std::uint64_t components = 1;
  std::uint64_t tuples = 0;
  bool          isText = false;
  std::size_t   begin = 0; ///< behind those words
};

/** Cells of one kind: cell c has the corners up to ends[c]. */
struct LegacyCells
{
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> ends;
};

/** A whole file, attributes included: one that ends within them is cut off, too. VTK 9.1's own reader takes every count
 *  in the file on trust and crashes where one is wrong. */
class LegacyPolyData : private LegacyWords
{
public:
  /** Views into `bytes`. \throws UnfitFile */
  explicit LegacyPolyData(std::string_view bytes);

  std::string_view                                           title;
  LegacyArray                                                points;
  std::map<std::string, LegacyCells>                         cells;  ///< by section: Verts, Lines, Polys, Strips
  std::map<std::pair<std::string, std::string>, LegacyArray> arrays; ///< by section (as of .vtp) and name

  bool
  IsText() const
  {
    return m_IsText;
  }
  /** `finite`: other numbers are refused. \throws UnfitFile */
  template <typename Value>
  std::vector<Value>
  Read(const LegacyArray & array, bool finite)
  {
    RequireFit(array.type.bytes > 0, "an array is not of numbers");
    m_At = array.begin;
    return Numbers<Value>(array.tuples, array.components, array.type, finite);
  }
  /** The first string of an array. \throws UnfitFile */
  std::string
  ReadText(const LegacyArray & array);

private:
  void
  Section(const std::string & word);
  LegacyCells
  ReadCells();
  void
  TakeAttribute(const std::string & word);
  void
  TakeField();
  void
  TakeArray(std::string_view name, std::uint64_t tuples, std::uint64_t components, std::string_view typeName);
  std::string
  TakeString();
  void
  SkipMetadata();

  bool          m_HasPoints = false;
  std::string   m_Section = "FieldData";
  std::uint64_t m_Tuples = 0;
};

} // namespace voxelcore
