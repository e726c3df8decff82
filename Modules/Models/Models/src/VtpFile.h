#pragma once
// VTK's polydata in XML, .vtp: its tags, and its arrays in all their encodings: as text, as base64 or raw, plain or
// packed. What is appended stays in the file until it is asked for.
//
// VTK's own reader trusts the numbers in a file: one wrong bit in a count makes it write beyond its memory. What a user
// hands over may be damaged, so every number is checked here against what the file has.

#include "MeshNumbers.h"

#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** An array as its tag describes it. */
struct VtpArray
{
  std::string   format;     ///< ascii, binary or appended
  NumberType    type;       ///< 0 bytes where VTK does not know it
  std::uint64_t offset = 0; ///< into the appended data
  std::uint64_t components = 1;
  std::uint64_t tuples = 0;     ///< as said of a field array
  bool          isText = false; ///< strings, each with a 0 behind it; their letters are the numbers
  std::string   text;           ///< what stands between its tags
};

/** By section ("FieldData", "PointData", "CellData", "Points", "Verts", "Lines", "Strips", "Polys") and name; that of
 *  the points is "Points", "". */
using VtpArrays = std::map<std::pair<std::string, std::string>, VtpArray>;

struct VtpPiece
{
  std::map<std::string, std::string> counts; ///< such as NumberOfPoints
  VtpArrays                          arrays;

  /** \throws UnfitFile for what is no number from 0 on */
  std::uint64_t
  Count(const std::string & name) const;
};

/** Every function throws UnfitFile when the file is damaged. */
class VtpFile
{
public:
  enum class Content
  {
    Mesh, ///< points, polygons and strips
    All
  };

  /** With Content::All a file in WriteVtp's form is checked at once: its header must be as VTK has it, and every array,
   *  also one that nobody here asks for, as long as the file's counts say. */
  VtpFile(const std::filesystem::path & path, Content content);

  std::vector<VtpPiece> pieces;
  VtpArrays             fields;

  /** Whether it has the form in which WriteVtp writes: appended data, raw and little endian, with heads of 64 bits, in
   *  zlib's streams, or as they are, as former versions wrote them. */
  bool
  IsOurs() const;

  /** How many bytes the appended data can stand for. */
  std::uint64_t
  MostAppended() const;

  /** All numbers of an array, as double or std::int64_t; `finite`: others are refused. Memory is in proportion to what
   *  the file holds, whatever its counts say. */
  template <typename Value>
  std::vector<Value>
  Read(const VtpArray & array, bool finite = true);

  /** The strings of a string array, each with its 0. */
  std::string
  ReadTexts(const VtpArray & array);

private:
  class Header;
  class Source;

  /** An array's bytes: blocks one after another, from where `source` stands. */
  struct Blocks;

  Blocks
  Open(const VtpArray & array);
  void
  Unpack(Blocks & blocks, char * to);
  void
  CheckOurs();

  std::ifstream m_File;
  bool          m_IsBigEndian = false;
  NumberType    m_Head{ 'u', 4 };
  std::string   m_Compressor; ///< VTK's name of its class; empty for none
  bool          m_IsAppendedRaw = false;
  bool          m_IsOrderly = true; ///< no tag and no text where VTK has none
  std::uint64_t m_DataBegin = 0;    ///< behind the underscore; 0 where nothing is appended
  std::uint64_t m_DataEnd = 0;
};

} // namespace voxelcore
