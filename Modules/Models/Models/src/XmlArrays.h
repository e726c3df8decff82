#pragma once
// Arrays of VTK's XML files, in all their encodings: as text, as base64 or raw, plain or compressed.

#include "MeshNumbers.h"

namespace voxelcore
{

/** What a file says of all of its arrays. */
struct XmlEncoding
{
  bool             isBigEndian = false;
  NumberType       header{ 'u', 4 };
  std::string      compressor; ///< VTK's name of its class; empty for none
  std::string_view appended;   ///< behind the underscore
  bool             isAppendedRaw = false;
};

/** An array as its tag describes it. */
struct XmlArray
{
  std::string   format;
  NumberType    type;
  std::uint64_t offset = 0; ///< into the appended data
  std::string   text;       ///< what stands between its tags
  std::uint64_t components = 1;
  bool          isText = false; ///< strings, each with a 0 behind it; their letters are the numbers
};

/** The type of that name; 0 bytes where it is none of numbers. */
NumberType
XmlNumberType(std::string_view name);

/** All numbers of an array, as double or std::int64_t; `finite`: others are refused. Memory is in proportion to what
 *  the file holds, whatever its counts say. Throws UnfitFile when it is damaged. */
template <typename Value>
std::vector<Value>
ReadXmlArray(const XmlArray & array, const XmlEncoding & encoding, bool finite = true);

} // namespace voxelcore
