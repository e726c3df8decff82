#include "SavedSource.h"

#include "voxelcore/Base/Library.h"

#include <charconv>
#include <cmath>

namespace voxelcore
{
namespace
{

/** Decimal digits that a value takes; 0 for multiples of 2^-20, which text of any program holds in full. */
int
Digits(double value)
{
  if (!std::isfinite(value) || std::ldexp(value, 20) == std::trunc(std::ldexp(value, 20)))
  {
    return 0;
  }
  std::array<char, 40> text{};
  const auto end = to_chars(text.data(), text.data() + text.size(), std::abs(value), std::chars_format::scientific).ptr;
  const std::string_view word(text.data(), static_cast<std::size_t>(end - text.data()));
  return static_cast<int>(word.find('e')) - (word[1] == '.' ? 1 : 0);
}

std::string
Listed(const std::vector<std::string> & names)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text + (names.size() == 1 && names.front() != "points" ? " is" : " are");
}

} // namespace

std::string
SavedSource::Rounded() const
{
  std::string text;
  if (!m_Single.empty())
  {
    text = "its " + Listed(m_Single) + " in single precision";
  }
  if (!m_Short.empty())
  {
    text += (text.empty() ? "" : " and ") + ("its " + Listed(m_Short)) + " text of few digits";
  }
  return text;
}

void
SavedSource::Remember(const std::string & name, NumberType type, bool isText, const std::vector<double> & values)
{
  if (type.kind == 'f' && type.bytes == 4)
  {
    m_Single.push_back(name);
    return;
  }
  int most = 0;
  for (std::size_t i = 0; isText && i < values.size(); ++i)
  {
    most = std::max(most, Digits(values[i]));
  }
  // Of doubles in full some take 16 or 17.
  if (most > 0 && most < 16)
  {
    m_Short.push_back(name);
  }
}

std::vector<std::int64_t>
SavedSource::AsWholes(const std::vector<double> & values)
{
  std::vector<std::int64_t> wholes(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    RequireFit(std::abs(values[i]) <= 0x1p53 && values[i] == std::trunc(values[i]),
               "an array of whole numbers holds others");
    wholes[i] = static_cast<std::int64_t>(values[i]);
  }
  return wholes;
}

void
SavedSource::Missing(const std::string & section, const std::string & name)
{
  throw UnfitFile{ "its array " + section + "/" + name + " is missing" };
}

XmlSource::XmlSource(const std::filesystem::path & path)
  : m_File(path, VtpFile::Content::All)
{
  RequireFit(m_File.pieces.size() == 1, "it has several pieces, or none");
}

std::uint64_t
XmlSource::PieceCount(const std::string & attribute) const
{
  return m_File.pieces.front().Count(attribute);
}

const VtpArrays &
XmlSource::ArraysOf(const std::string & section) const
{
  return section == "FieldData" ? m_File.fields : m_File.pieces.front().arrays;
}

bool
XmlSource::Has(const std::string & section, const std::string & name) const
{
  return ArraysOf(section).contains({ section, section == "Points" ? "" : name });
}

const VtpArray &
XmlSource::Find(const std::string & section, const std::string & name, int components) const
{
  const VtpArrays & arrays = ArraysOf(section);
  const auto        found = arrays.find({ section, section == "Points" ? "" : name });
  if (found == arrays.end())
  {
    Missing(section, name);
  }
  RequireFit(found->second.components == static_cast<std::uint64_t>(components),
             "an array has another number of components");
  return found->second;
}

std::vector<double>
XmlSource::ReadReals(const std::string & section, const std::string & name, int components)
{
  if (section == "Points" && PieceCount("NumberOfPoints") == 0)
  {
    return {};
  }
  const VtpArray & array = Find(section, name, components);
  auto             values = m_File.Read<double>(array, section == "Points");
  Remember(section == "Points" ? "points" : name, array.type, array.format == "ascii", values);
  return values;
}

std::vector<std::int64_t>
XmlSource::ReadWholes(const std::string & section, const std::string & name, int components)
{
  const VtpArray & array = Find(section, name, components);
  return array.type.kind == 'f' ? AsWholes(m_File.Read<double>(array)) : m_File.Read<std::int64_t>(array);
}

std::vector<std::int64_t>
XmlSource::ReadIndices(const std::string & section, const std::string & name)
{
  return PieceCount("NumberOf" + section) == 0 ? std::vector<std::int64_t>() : ReadWholes(section, name, 1);
}

std::string
XmlSource::ReadText(const std::string & section, const std::string & name)
{
  std::string text = m_File.ReadTexts(Find(section, name, 1));
  RequireFit(!text.empty() && text.find('\0') == text.size() - 1, "a text is damaged");
  text.pop_back();
  return text;
}

LegacySource::LegacySource(std::string bytes)
  : m_Bytes(std::move(bytes))
  , m_Data(m_Bytes)
{
  // Slicer says it there, whatever a field of the same name has kept.
  RequireFit(m_Data.title.find("SPACE=RAS") == std::string_view::npos, "its points are in RAS; save it in LPS");
}

const LegacyCells &
LegacySource::Cells(const std::string & section) const
{
  static const LegacyCells none;
  const auto               found = m_Data.cells.find(section);
  return found == m_Data.cells.end() ? none : found->second;
}

std::uint64_t
LegacySource::PieceCount(const std::string & attribute) const
{
  return attribute == "NumberOfPoints" ? m_Data.points.tuples : Cells(attribute.substr(8)).ends.size();
}

bool
LegacySource::Has(const std::string & section, const std::string & name) const
{
  const bool saysLps = name == "SPACE" && m_Data.title.find("SPACE=LPS") != std::string_view::npos;
  return saysLps || m_Data.arrays.contains({ section, name });
}

const LegacyArray &
LegacySource::Find(const std::string & section, const std::string & name, int components) const
{
  const auto found = m_Data.arrays.find({ section, name });
  if (section != "Points" && found == m_Data.arrays.end())
  {
    Missing(section, name);
  }
  const LegacyArray & array = section == "Points" ? m_Data.points : found->second;
  RequireFit(array.components == static_cast<std::uint64_t>(components), "an array has another number of components");
  return array;
}

std::vector<double>
LegacySource::ReadReals(const std::string & section, const std::string & name, int components)
{
  const LegacyArray & array = Find(section, name, components);
  auto                values = m_Data.Read<double>(array, section == "Points");
  Remember(section == "Points" ? "points" : name, array.type, m_Data.IsText(), values);
  return values;
}

std::vector<std::int64_t>
LegacySource::ReadWholes(const std::string & section, const std::string & name, int components)
{
  const LegacyArray & array = Find(section, name, components);
  return array.type.kind == 'f' ? AsWholes(m_Data.Read<double>(array, true)) : m_Data.Read<std::int64_t>(array, true);
}

std::vector<std::int64_t>
LegacySource::ReadIndices(const std::string & section, const std::string & name)
{
  return name == "offsets" ? Cells(section).ends : Cells(section).corners;
}

std::string
LegacySource::ReadText(const std::string & section, const std::string & name)
{
  if (name == "SPACE" && !m_Data.arrays.contains({ section, name }) && Has(section, name))
  {
    return "LPS";
  }
  return m_Data.ReadText(Find(section, name, 1));
}

} // namespace voxelcore
