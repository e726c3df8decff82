#pragma once
// The values given to a command, read by kind.

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Options/Command.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace voxelcore
{

/** An option's name as reports and Python have it, with underscores. */
inline std::string
WithUnderscores(std::string_view option)
{
  std::string name(option);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/** The values given to one command, read with its defaults. */
class ParameterReader
{
public:
  /** `rows`: of the command. */
  ParameterReader(const ParameterValues & values, std::span<const Parameter> rows)
    : m_Values(values)
    , m_Rows(rows)
  {}

  ParameterReader(const ParameterValues & values, const Command & command)
    : ParameterReader(values, command.rows)
  {}

  const ParameterValues &
  Values() const
  {
    return m_Values;
  }

  std::span<const Parameter>
  Rows() const
  {
    return m_Rows;
  }

  /** The option's row; null where the command has no such option. */
  const Parameter *
  Find(std::string_view name) const
  {
    return FindParameter(m_Rows, name);
  }

  const Parameter &
  Describe(std::string_view name) const
  {
    const Parameter * const found = Find(name);
    if (found == nullptr)
    {
      throw std::logic_error("no such parameter: " + std::string(name));
    }
    return *found;
  }

  /** What parse(text) makes of the value; its errors name the option. */
  template <typename TParse>
  auto
  Parsed(std::string_view name, const TParse & parse) const
  {
    try
    {
      return parse(Text(name));
    }
    catch (const UsageError & error)
    {
      throw UsageError("--" + std::string(name) + ": " + error.what());
    }
  }

  std::string
  Text(std::string_view name) const
  {
    const auto found = m_Values.find(name);
    return found != m_Values.end() ? found->second : std::string(Describe(name).defaultValue);
  }

  bool
  IsSet(std::string_view name) const
  {
    return Text(name) == "true";
  }

  bool
  IsGiven(std::string_view name) const
  {
    return m_Values.find(name) != m_Values.end();
  }

  [[noreturn]] void
  ThrowUsageError(std::string_view name, const std::string & expected) const
  {
    const Parameter & parameter = Describe(name);
    const auto        comma = parameter.flags.find(',');
    const auto        flag = comma == std::string_view::npos ? parameter.flags : parameter.flags.substr(comma + 1);
    const std::string given = Text(name);
    throw UsageError((flag.empty() ? std::string(parameter.placeholder) : std::string(flag)) +
                     (given.empty() ? "" : " " + given) + ": expected " + expected);
  }

  std::int64_t
  Whole(std::string_view name, std::int64_t least, std::int64_t most) const
  {
    const std::string text = Text(name);
    std::int64_t      value = 0;
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
    {
      ThrowUsageError(name,
                      "a whole number from " + std::to_string(least) +
                        (most < std::numeric_limits<std::int64_t>::max() ? " to " + std::to_string(most) : " up"));
    }
    return value;
  }

  /** A finite number; none when it is not given. */
  std::optional<double>
  Real(std::string_view name) const
  {
    if (!IsGiven(name))
    {
      return std::nullopt;
    }
    const auto value = ParseReal(Text(name));
    if (!value || !std::isfinite(*value))
    {
      ThrowUsageError(name, "a number");
    }
    return value;
  }

  std::string
  Choice(std::string_view name) const
  {
    std::string                   text = Text(name);
    const std::string_view        all = Describe(name).placeholder;
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < all.size();)
    {
      const std::size_t end = std::min(all.find('|', at), all.size());
      words.push_back(all.substr(at, end - at));
      at = end + 1;
    }
    if (std::find(words.begin(), words.end(), text) == words.end())
    {
      ThrowUsageError(name, "one of " + std::string(all) + DidYouMean(text, words));
    }
    return text;
  }

  /** LO:HI with LO <= HI. */
  std::pair<double, double>
  Range(std::string_view name) const
  {
    const auto parts = SplitText(Text(name), ':');
    const auto low = ParseReal(parts.front());
    const auto high = ParseReal(parts.back());
    if (parts.size() != 2 || !low || !high || !(*low <= *high))
    {
      ThrowUsageError(name, "LO:HI with LO <= HI, such as 300:3000 (inf is allowed)");
    }
    return { *low, *high };
  }

  /** A voxel size in mm. */
  Vector3
  Spacing(std::string_view name = "spacing") const
  {
    const auto size = ParseVoxelSize(Text(name));
    if (!size)
    {
      ThrowUsageError(name, "one or three numbers above 0, in mm or with a unit, such as 0.5,0.5,2 or 50um");
    }
    return *size;
  }

  /** The first of the resolutions given. */
  std::optional<std::int64_t>
  FirstResolution() const
  {
    const auto resolutions = IsGiven("resolution") ? ParseResolutions(Text("resolution")) : std::vector<std::int64_t>();
    if (resolutions.size() > 1 && !Describe("resolution").placeholder.ends_with("..]"))
    {
      throw UsageError("--resolution " + Text("resolution") + ": expected one value");
    }
    return resolutions.empty() ? std::nullopt : std::optional(resolutions.front());
  }

  std::filesystem::path
  File(std::string_view name) const
  {
    if (Text(name).empty())
    {
      ThrowUsageError(name, "a file name");
    }
    return Text(name);
  }

  std::optional<std::filesystem::path>
  FileIfGiven(std::string_view name) const
  {
    return IsGiven(name) ? std::optional(File(name)) : std::nullopt;
  }

private:
  const ParameterValues &    m_Values;
  std::span<const Parameter> m_Rows;
};

} // namespace voxelcore
