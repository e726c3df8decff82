// Expat reads the tags; every count is held against what the arrays have. VTK 9.1's own reader allocates what the
// counts say, and writes beyond it where they disagree.

#include "XmlPolyData.h"

#include <expat.h>
#include <memory>

namespace voxelcore
{

std::uint64_t
XmlNumber(const XmlAttributes & attributes, const std::string & name, std::int64_t otherwise)
{
  const auto found = attributes.find(name);
  if (found == attributes.end())
  {
    return static_cast<std::uint64_t>(otherwise);
  }
  const auto number = ParseNumber<std::int64_t>(found->second, { 'i', 8 });
  RequireFit(number >= 0, "counts that cannot be");
  return static_cast<std::uint64_t>(number);
}

namespace
{

/** Walks through the tags, as expat calls. No exception may pass through expat: what is wrong is kept. */
class XmlWalk
{
public:
  XmlPolyData data;
  std::size_t appendedAt = 0; ///< behind the tag AppendedData; 0 where there is none

  XmlWalk(std::string_view bytes, bool withData)
    : m_WithData(withData)
    , m_Parser(XML_ParserCreate(nullptr), &XML_ParserFree)
  {
    XML_SetUserData(m_Parser.get(), this);
    XML_SetElementHandler(m_Parser.get(), &XmlWalk::OnBegin, &XmlWalk::OnEnd);
    XML_SetCharacterDataHandler(m_Parser.get(), &XmlWalk::OnText);
    XML_SetStartDoctypeDeclHandler(m_Parser.get(), &XmlWalk::OnDoctype);
    constexpr std::size_t step = std::size_t{ 1 } << 24;
    XML_Status            status = XML_STATUS_OK;
    for (std::size_t at = 0; at < bytes.size() && status == XML_STATUS_OK; at += step)
    {
      const std::string_view part = bytes.substr(at, step);
      status = XML_Parse(m_Parser.get(), part.data(), static_cast<int>(part.size()), at + step >= bytes.size());
    }
    if (!m_Trouble.empty())
    {
      throw UnfitFile{ m_Trouble };
    }
    if (appendedAt == 0 && status != XML_STATUS_OK)
    {
      throw UnfitFile{ "line " + std::to_string(XML_GetCurrentLineNumber(m_Parser.get())) + ": " +
                       XML_ErrorString(XML_GetErrorCode(m_Parser.get())) };
    }
    RequireFit(m_IsPolyData, "it holds no polydata");
  }

private:
  static void
  OnBegin(void * self, const char * name, const char ** attributes)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    walk.Guarded([&] {
      XmlAttributes all;
      for (; *attributes != nullptr; attributes += 2)
      {
        all.emplace(attributes[0], attributes[1]);
      }
      walk.Begin(name, all);
    });
  }
  static void
  OnEnd(void * self, const char * name)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    walk.m_Path.pop_back();
    if (IsArray(name))
    {
      walk.m_Array = nullptr;
    }
  }
  static void
  OnText(void * self, const char * text, int length)
  {
    auto & walk = *static_cast<XmlWalk *>(self);
    if (walk.m_Array != nullptr && IsArray(walk.m_Path.back())) // not what keys within it say
    {
      walk.Guarded([&] { walk.m_Array->text.append(text, static_cast<std::size_t>(length)); });
    }
  }
  static void
  OnDoctype(void * self, const char *, const char *, const char *, int)
  {
    static_cast<XmlWalk *>(self)->Stop("it declares a document type, which no VTK file does");
  }

  template <typename Work>
  void
  Guarded(Work && work)
  {
    try
    {
      work();
    }
    catch (const UnfitFile & unfit)
    {
      Stop(unfit.reason);
    }
    catch (const std::bad_alloc &)
    {
      Stop("it is larger than the memory");
    }
  }

  void
  Stop(const std::string & trouble)
  {
    m_Trouble = m_Trouble.empty() ? trouble : m_Trouble;
    XML_StopParser(m_Parser.get(), XML_FALSE);
  }

  void
  Begin(const std::string & name, const XmlAttributes & attributes)
  {
    const std::string section = m_Path.empty() ? "" : m_Path.back();
    m_Path.push_back(name);
    RequireFit(m_Path.size() < 64, "its tags are nested too deeply");
    const auto text = [&](const char * attribute, const char * otherwise) {
      const auto found = attributes.find(attribute);
      return found == attributes.end() ? std::string(otherwise) : found->second;
    };
    if (name == "VTKFile")
    {
      ReadEncoding(text("type", ""), text("byte_order", "LittleEndian"), text("header_type", "UInt32"));
      data.encoding.compressor = text("compressor", "");
    }
    else if (name == "Piece")
    {
      RequireFit(section == "PolyData", "a piece is out of place");
      data.pieces.push_back({ attributes, {} });
    }
    else if (name == "AppendedData")
    {
      RequireFit(text("encoding", "") == "raw" || text("encoding", "") == "base64",
                 "its appended data are neither raw nor base64");
      data.encoding.isAppendedRaw = text("encoding", "") == "raw";
      // What follows may be no XML.
      appendedAt = static_cast<std::size_t>(XML_GetCurrentByteIndex(m_Parser.get())) +
                   static_cast<std::size_t>(XML_GetCurrentByteCount(m_Parser.get()));
      XML_StopParser(m_Parser.get(), XML_FALSE);
    }
    else if (IsArray(name))
    {
      AddArray(section, attributes);
    }
  }

  static bool
  IsArray(std::string_view name)
  {
    return name == "DataArray" || name == "Array";
  }

  void
  AddArray(const std::string & section, const XmlAttributes & attributes)
  {
    const bool arePoints = section == "Points";
    const bool areCells = section == "Polys" || section == "Strips" || section == "Verts" || section == "Lines";
    const bool areValues = section == "PointData" || section == "CellData" || section == "FieldData";
    const bool isOfMesh = arePoints || section == "Polys" || section == "Strips";
    if (!isOfMesh && (!m_WithData || !(areCells || areValues)))
    {
      return;
    }
    const auto text = [&](const char * attribute, const char * otherwise) {
      const auto found = attributes.find(attribute);
      return found == attributes.end() ? std::string(otherwise) : found->second;
    };
    RequireFit(section == "FieldData" || !data.pieces.empty(), "an array is out of place");
    const bool isText = text("type", "") == "String";
    XmlArray   array{ text("format", "ascii"),
                    isText ? NumberType{ 'u', 1 } : XmlNumberType(text("type", "")),
                    XmlNumber(attributes, "offset", 0),
                    "",
                    XmlNumber(attributes, "NumberOfComponents", 1),
                    isText };
    RequireFit(areValues || array.components == (arePoints ? 3 : 1), "an array has the wrong number of components");
    XmlArrayMap & arrays = section == "FieldData" ? data.fields : data.pieces.back().arrays;
    const auto [place, isNew] = arrays.emplace(std::pair(section, arePoints ? "" : text("Name", "")), std::move(array));
    RequireFit(isNew || areValues, "an array is there twice");
    m_Array = isNew ? &place->second : nullptr; // as VTK, which finds the first of a name
  }

  void
  ReadEncoding(const std::string & type, const std::string & order, const std::string & header)
  {
    RequireFit(m_Path.size() == 1 && type == "PolyData", "it holds no polydata");
    RequireFit(order == "LittleEndian" || order == "BigEndian", "an unknown order of bytes");
    RequireFit(header == "UInt32" || header == "UInt64", "headers of an unknown type");
    m_IsPolyData = true;
    data.encoding.isBigEndian = order == "BigEndian";
    data.encoding.header = { 'u', header == "UInt32" ? std::size_t{ 4 } : std::size_t{ 8 } };
  }

  bool                                                         m_WithData;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> m_Parser;
  std::vector<std::string>                                     m_Path;
  XmlArray *                                                   m_Array = nullptr;
  bool                                                         m_IsPolyData = false;
  std::string                                                  m_Trouble;
};

/** The appended data, from behind the underscore to the tags that end the file. */
std::string_view
AppendedData(std::string_view bytes, std::size_t begin)
{
  const auto drop = [&](std::string_view ending) {
    bytes = bytes.substr(0, bytes.find_last_not_of(" \r\n\t") + 1);
    RequireFit(bytes.ends_with(ending) && bytes.size() - ending.size() >= begin, "it ends too early");
    bytes.remove_suffix(ending.size());
  };
  drop("</VTKFile>");
  drop("</AppendedData>");
  const std::size_t mark = bytes.find_first_not_of(" \r\n\t", begin);
  RequireFit(mark != std::string_view::npos && bytes[mark] == '_', "its appended data are damaged");
  return bytes.substr(mark + 1);
}

} // namespace

XmlPolyData
ParseXmlPolyData(std::string_view bytes, bool withData)
{
  RequireFit(bytes.starts_with("<?xml") || bytes.starts_with("<VTKFile"), "it is no VTK file in XML");
  XmlWalk walk(bytes, withData);
  if (walk.appendedAt > 0)
  {
    walk.data.encoding.appended = AppendedData(bytes, walk.appendedAt);
  }
  return std::move(walk.data);
}

} // namespace voxelcore
