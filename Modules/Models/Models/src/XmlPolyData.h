#pragma once
// The tags of VTK's polydata in XML, and where each array's values are.

#include "XmlArrays.h"

#include <map>
#include <utility>
#include <vector>

namespace voxelcore
{

using XmlAttributes = std::map<std::string, std::string>;
/** By section and name; that of the points is "Points", "". */
using XmlArrayMap = std::map<std::pair<std::string, std::string>, XmlArray>;

struct XmlPiece
{
  XmlAttributes counts;
  XmlArrayMap   arrays;
};

struct XmlPolyData
{
  XmlEncoding           encoding;
  std::vector<XmlPiece> pieces;
  XmlArrayMap           fields; ///< section FieldData
};

/** What a file holds: of a mesh points, polygons and strips, else (`withData`) every array. Views into `bytes`.
 *  \throws UnfitFile */
XmlPolyData
ParseXmlPolyData(std::string_view bytes, bool withData);

/** A whole number of a tag, from 0. \throws UnfitFile */
std::uint64_t
XmlNumber(const XmlAttributes & attributes, const std::string & name, std::int64_t otherwise);

} // namespace voxelcore
