#pragma once
// The values given to a command, read by kind.

#include "voxelcore/DidYouMean.h"
#include "voxelcore/Error.h"
#include "voxelcore/Parameters.h"
#include "voxelcore/ParseReal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace voxelcore
{

/** The values given to one command, read with its defaults. */
class ParameterReader
{
public:
  ParameterReader(const ParameterValues & values, CommandId command)
    : m_Values(values)
    , m_Command(command)
  {}

  const Parameter &
  Describe(std::string_view name) const
  {
    for (const Parameter & parameter : Parameters())
    {
      if (parameter.name == name && BelongsTo(parameter, m_Command))
      {
        return parameter;
      }
    }
    throw std::logic_error("no such parameter: " + std::string(name));
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
  Refuse(std::string_view name, const std::string & expected) const
  {
    const Parameter & parameter = Describe(name);
    const auto        comma = parameter.flags.find(',');
    const auto        flag = comma == std::string_view::npos ? parameter.flags : parameter.flags.substr(comma + 1);
    throw UsageError((flag.empty() ? std::string(parameter.placeholder) : std::string(flag)) + " " + Text(name) +
                     ": expected " + expected);
  }

  std::int64_t
  Whole(std::string_view name, std::int64_t least, std::int64_t most) const
  {
    const std::string text = Text(name);
    std::int64_t      value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
    {
      Refuse(name,
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
      Refuse(name, "a number");
    }
    return value;
  }

  std::string
  Choice(std::string_view name) const
  {
    const std::string             text = Text(name);
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
      Refuse(name, "one of " + std::string(all) + DidYouMean(text, words));
    }
    return text;
  }

private:
  const ParameterValues & m_Values;
  CommandId               m_Command;
};

} // namespace voxelcore
