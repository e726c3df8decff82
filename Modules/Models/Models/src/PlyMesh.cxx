#include "MeshNumbers.h"
#include "voxelcore/Base/TextFields.h"

#include <array>
#include <limits>

namespace voxelcore
{
namespace
{

enum class Encoding
{
  Text,
  Little,
  Big
};

struct Property
{
  std::string name;
  NumberType  type;
  bool        isList = false;
  NumberType  countType{ 'u', 1 };
};

struct Element
{
  std::string           name;
  std::int64_t          count = 0;
  std::vector<Property> properties;
};

NumberType
ScalarOf(const MeshText & text, std::string_view name)
{
  struct Named
  {
    std::string_view one;
    std::string_view other;
    NumberType       type;
  };
  static constexpr std::array<Named, 8> types{ { { "char", "int8", { 'i', 1 } },
                                                 { "uchar", "uint8", { 'u', 1 } },
                                                 { "short", "int16", { 'i', 2 } },
                                                 { "ushort", "uint16", { 'u', 2 } },
                                                 { "int", "int32", { 'i', 4 } },
                                                 { "uint", "uint32", { 'u', 4 } },
                                                 { "float", "float32", { 'f', 4 } },
                                                 { "double", "float64", { 'f', 8 } } } };
  for (const Named & named : types)
  {
    if (name == named.one || name == named.other)
    {
      return named.type;
    }
  }
  text.Require(false, "a property of a type that PLY does not have");
  return {};
}

/** The values behind the header, one after the other. */
class Values
{
public:
  Values(std::string_view body, Encoding encoding)
    : m_Body(body)
    , m_Encoding(encoding)
    , m_Text(body)
  {}

  /** Elements of text stand in a line each. */
  void
  BeginElement(const Element & element, std::int64_t index)
  {
    m_Element = &element;
    m_Index = index;
    if (m_Encoding == Encoding::Text && !m_Text.NextLine('\0'))
    {
      EndsEarly();
    }
  }

  double
  Next(const NumberType & type)
  {
    if (m_Encoding == Encoding::Text)
    {
      return type.kind == 'f' ? m_Text.Coordinate() : static_cast<double>(m_Text.Whole(m_Text.Word()));
    }
    if (m_Body.size() - m_At < type.bytes)
    {
      EndsEarly();
    }
    const char * const at = m_Body.data() + m_At;
    m_At += type.bytes;
    return LoadNumber<double>(at, type, m_Encoding == Encoding::Big, false);
  }

  void
  Fail(const std::string & reason) const
  {
    throw UnfitFile{ m_Element->name + " " + std::to_string(m_Index) + ": " + reason };
  }

private:
  [[noreturn]] void
  EndsEarly() const
  {
    throw UnfitFile{ "it ends after " + std::to_string(m_Index) + " of " + std::to_string(m_Element->count) + " " +
                     m_Element->name + " elements" };
  }

  std::string_view m_Body;
  Encoding         m_Encoding;
  MeshText         m_Text;
  std::size_t      m_At = 0;
  const Element *  m_Element = nullptr;
  std::int64_t     m_Index = 0;
};

std::vector<Element>
ParseHeader(std::string_view header, Encoding & encoding)
{
  MeshText             text(header);
  std::vector<Element> elements;
  bool                 hasFormat = false;
  text.NextLine('\0'); // "ply"
  while (text.NextLine('\0'))
  {
    const std::string_view word = text.Word();
    if (word == "format")
    {
      const std::string_view name = text.Word();
      text.Require(name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian",
                   "a format that PLY does not have");
      encoding = name == "ascii" ? Encoding::Text : name == "binary_big_endian" ? Encoding::Big : Encoding::Little;
      hasFormat = true;
    }
    else if (word == "element")
    {
      elements.emplace_back();
      elements.back().name = text.Word();
      elements.back().count = text.Whole(text.Word());
      text.Require(elements.back().count >= 0 && elements.back().count < 0xfffffff0, "a count that cannot be");
    }
    else if (word == "property")
    {
      text.Require(!elements.empty(), "a property of no element");
      Property         property;
      std::string_view type = text.Word();
      property.isList = type == "list";
      if (property.isList)
      {
        property.countType = ScalarOf(text, text.Word());
        text.Require(property.countType.kind != 'f', "a list whose length is no whole number");
        type = text.Word();
      }
      property.type = ScalarOf(text, type);
      property.name = text.Word();
      elements.back().properties.push_back(std::move(property));
    }
    else
    {
      text.Require(word == "comment" || word == "obj_info", "a line of its header that PLY does not have");
    }
  }
  RequireFit(hasFormat, "its header does not say its format");
  return elements;
}

void
ReadVertex(const Element & element, Values & values, MeshFile & file)
{
  Vector3  point{};
  unsigned found = 0;
  for (const Property & property : element.properties)
  {
    if (property.isList)
    {
      values.Fail("a list among the properties of a point");
    }
    const double      value = values.Next(property.type);
    const std::size_t axis = property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : 3;
    if (axis < 3)
    {
      if (!std::isfinite(value))
      {
        values.Fail("a coordinate is not a finite number");
      }
      point[axis] = value;
      found |= 1U << axis;
    }
  }
  if (found != 7U)
  {
    values.Fail("it has no x, y and z");
  }
  file.mesh.points.push_back(point);
}

void
ReadOther(const Element & element, Values & values, std::int64_t pointCount, MeshFile & file)
{
  std::vector<std::uint32_t> corners;
  const bool                 isFace = element.name == "face";
  bool                       hasCorners = false;
  for (const Property & property : element.properties)
  {
    const bool holdsCorners =
      isFace && property.isList && (property.name == "vertex_indices" || property.name == "vertex_index");
    const double count = property.isList ? values.Next(property.countType) : 1;
    // Text holds numbers that no type of a count does.
    if (count < 0 || count > std::numeric_limits<std::uint32_t>::max() ||
        (holdsCorners && count > static_cast<double>(pointCount)))
    {
      values.Fail("a list of " + Number(count));
    }
    for (auto left = static_cast<std::uint32_t>(count); left > 0; --left)
    {
      const double value = values.Next(property.type);
      if (holdsCorners)
      {
        if (!(value >= 0 && value < static_cast<double>(pointCount)) || value != std::floor(value))
        {
          values.Fail("a corner that is none of the " + std::to_string(pointCount) + " points");
        }
        corners.push_back(static_cast<std::uint32_t>(value));
      }
    }
    hasCorners = hasCorners || holdsCorners;
  }
  if (isFace && !hasCorners)
  {
    values.Fail("it has no list vertex_indices");
  }
  AddPolygon(file, corners);
}

} // namespace

MeshFile
ParsePly(std::string_view bytes)
{
  constexpr std::string_view mark = "end_header";
  RequireFit(bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n"), "it does not begin with 'ply'");
  const std::size_t end = bytes.find(mark);
  RequireFit(end != std::string_view::npos, "its header does not end");
  std::size_t body = end + mark.size();
  body += bytes.substr(body, 2) == "\r\n" ? 2 : 1;
  RequireFit(body <= bytes.size(), "it ends behind its header");

  Encoding     encoding = Encoding::Text;
  const auto   elements = ParseHeader(bytes.substr(0, end), encoding);
  Values       values(bytes.substr(body), encoding);
  MeshFile     file;
  std::int64_t pointCount = -1;
  file.format = "PLY";
  for (const Element & element : elements)
  {
    if (element.name == "vertex")
    {
      RequireFit(pointCount < 0, "it has two elements 'vertex'");
      pointCount = element.count;
    }
    RequireFit(element.name != "tristrips", "triangle strips are not read; write it with faces");
    RequireFit(element.name != "face" || pointCount >= 0, "its faces come before its points");
    // A number of nothings is not worth the wait, but points must be there.
    const bool isRead = !element.properties.empty() || element.name == "vertex";
    for (std::int64_t i = 0; i < element.count && isRead; ++i)
    {
      values.BeginElement(element, i);
      element.name == "vertex" ? ReadVertex(element, values, file) : ReadOther(element, values, pointCount, file);
    }
  }
  return file;
}

} // namespace voxelcore
