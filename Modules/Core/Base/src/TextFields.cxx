#include "voxelcore/Base/TextFields.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/PlainText.h"
#include "voxelcore/Base/Text.h"

#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>

namespace voxelcore
{

std::string_view
Trim(std::string_view text)
{
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t          first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
  {
    return {};
  }
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string
LowerCase(std::string_view text)
{
  std::string lower(text);
  for (char & c : lower)
  {
    if (c >= 'A' && c <= 'Z')
    {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return lower;
}

std::vector<std::string_view>
Words(std::string_view text)
{
  constexpr std::string_view    blanks = " \t\r\n\v\f";
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;)
  {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(blanks, end);
  }
  return words;
}

std::optional<std::int64_t>
ParseInteger(std::string_view word)
{
  if (word.size() > 1 && word.front() == '+' && word[1] != '-')
  {
    word.remove_prefix(1);
  }
  std::int64_t value = 0;
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
  {
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>>
ParseReals(std::string_view text)
{
  std::vector<double> values;
  for (const auto word : Words(text))
  {
    const auto value = ParseReal(LowerCase(word));
    if (!value)
    {
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return values;
}

std::string
Printable(std::string_view text, std::size_t longest)
{
  const std::string plain = PlainText(text);
  return plain.size() <= longest ? plain : plain.substr(0, longest) + "...";
}

std::string
Number(double value)
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  if (value == std::floor(value) && std::abs(value) < 1e15)
  {
    out << std::fixed << std::setprecision(0) << value;
  }
  else
  {
    // Six digits read best; all of them where six would make a fraction look whole (0.9999999).
    out << std::setprecision(6) << value;
    double shown = 0;
    std::istringstream(out.str()) >> shown;
    if (shown == std::floor(shown))
    {
      out.str({});
      out << std::setprecision(std::numeric_limits<double>::max_digits10) << value;
    }
  }
  return out.str();
}

std::string
Counted(std::uint64_t count, const std::string & one, const std::string & many)
{
  return Text(count, " ", count == 1 ? one : many);
}

void
RefuseInput(const std::filesystem::path & file, std::string_view wrong, std::string_view remedy)
{
  throw InputError(Text(Printable(file.string(), 4096), ": ", wrong, "; ", remedy));
}

std::optional<double>
MillimetresIn(std::string_view unit)
{
  const std::string u = LowerCase(Trim(unit));
  if (u == "mm" || u == "millimeter" || u == "millimeters" || u == "millimetre" || u == "millimetres")
  {
    return 1.0;
  }
  // The micro sign and the Greek mu in UTF-8, and the micro sign in Latin-1.
  if (u == "um" || u == "\xC2\xB5m" || u == "\xCE\xBCm" || u == "\xB5m" || u == "micron" || u == "microns" ||
      u == "micrometer" || u == "micrometers" || u == "micrometre" || u == "micrometres")
  {
    return 1e-3;
  }
  if (u == "nm" || u == "nanometer" || u == "nanometers" || u == "nanometre" || u == "nanometres")
  {
    return 1e-6;
  }
  if (u == "cm" || u == "centimeter" || u == "centimeters" || u == "centimetre" || u == "centimetres")
  {
    return 10.0;
  }
  if (u == "m" || u == "meter" || u == "meters" || u == "metre" || u == "metres")
  {
    return 1000.0;
  }
  if (u == "inch" || u == "inches" || u == "in")
  {
    return 25.4;
  }
  if (u == "dm")
  {
    return 100.0;
  }
  if (u == "angstrom" || u == "\xC3\x85" || u == "\xC3\xA5")
  {
    return 1e-7;
  }
  if (u == "pm")
  {
    return 1e-9;
  }
  return std::nullopt;
}

std::optional<std::array<double, 3>>
ParseVoxelSize(std::string_view text)
{
  auto parts = SplitText(text, ',');
  if (parts.size() == 1)
  {
    parts.resize(3, parts.front());
  }
  if (parts.size() != 3)
  {
    return std::nullopt;
  }
  std::array<double, 3> sizes{};
  std::string_view      unit; // of the number behind
  for (std::size_t k = 3; k-- > 0;)
  {
    const std::string_view word = Trim(parts[k]);
    const std::size_t      end = word.find_last_of("0123456789.") + 1; // npos + 1 is 0
    const std::string_view own = Trim(word.substr(end));
    if (!own.empty() && unit.empty() && k < 2)
    {
      return std::nullopt; // which one the last number has would be guessed
    }
    unit = own.empty() ? unit : own;
    const auto value = ParseReal(word.substr(0, end));
    const auto mm = unit.empty() ? 1 : MillimetresIn(unit);
    if (!value || !mm)
    {
      return std::nullopt;
    }
    sizes[k] = *mm < 1 ? *value / std::round(1 / *mm) : *value * *mm; // 50 um are the double 0.05
    if (!(sizes[k] > 0) || !std::isfinite(sizes[k]))
    {
      return std::nullopt;
    }
  }
  return sizes;
}

bool
IsVoxelUnit(std::string_view unit)
{
  const std::string u = LowerCase(Trim(unit));
  return u == "voxel" || u == "voxels" || u == "vox" || u == "pixel" || u == "pixels" || u == "px";
}

} // namespace voxelcore
