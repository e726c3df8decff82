#include "PythonWords.h"

#include "voxelcore/Options/Command.h"

#include <algorithm>
#include <regex>
#include <string_view>

namespace voxelcore
{

namespace
{

/** Keyword arguments that take several numbers as a tuple. */
bool
TakesTuple(std::string_view option)
{
  return option == "spacing" || option == "threshold";
}

/** The option with this flag, -x or --name; null when there is none. */
const Parameter *
FindByFlag(const std::string & flag)
{
  for (const Command & command : Commands())
  {
    for (const Parameter & parameter : command.rows)
    {
      const std::string flags = "," + std::string(parameter.flags) + ",";
      if (!parameter.flags.empty() && flags.find("," + flag + ",") != std::string::npos)
      {
        return &parameter;
      }
    }
  }
  return nullptr;
}

std::string
ValueInPython(std::string_view option, const std::string & value)
{
  if (TakesTuple(option))
  {
    std::string numbers = "(";
    for (const char c : value)
    {
      numbers += c == ',' || c == ':' ? std::string(", ") : std::string(1, c);
    }
    return numbers + ")";
  }
  const bool number = value.find_first_not_of("0123456789.-") == std::string::npos;
  const bool placeholder = std::all_of(value.begin(), value.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  return number || placeholder ? value : "'" + value + "'";
}

/** An option and the value beside it, if any. */
std::string
Translate(const Parameter & parameter, const std::string & flag, const std::string & value)
{
  const std::string keyword = KeywordOf(parameter);
  if (keyword.empty())
  {
    return "the command line's " + flag + (value.empty() ? "" : " " + value);
  }
  if (parameter.kind == ParameterKind::Flag)
  {
    return (keyword.find('=') == std::string::npos ? keyword + "=True" : keyword) + (value.empty() ? "" : " " + value);
  }
  return value.empty() ? keyword : keyword + "=" + ValueInPython(parameter.name, value);
}

/** A message that begins with the option and what was given for it. */
std::string
TranslateRefusal(const std::string & message)
{
  static const std::regex refusal("^(--?[a-z][a-z-]*) (.*): expected ([^]*)$");
  std::smatch             found;
  if (!std::regex_match(message, found, refusal))
  {
    return message;
  }
  const Parameter * parameter = FindByFlag(found[1]);
  return parameter == nullptr ? message : Translate(*parameter, found[1], found[2]) + ": expected " + found[3].str();
}

} // namespace

std::string
InPythonWords(const std::string & message)
{
  // A whole command in quotes, or an option with a value that looks like one: a number, or capitals that stand for it.
  static const std::regex known("'voxelcore [^']*'|--?[a-z][a-z-]*(?: [0-9.A-Z-][A-Za-z0-9.,:%-]*)?");
  const std::string       text = TranslateRefusal(message);
  std::string             translated;
  auto                    copied = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), known), end; match != end; ++match)
  {
    const auto first = (*match)[0].first;
    const auto last = (*match)[0].second;
    const bool word = first == text.cbegin() || std::string_view(" ('[").find(*(first - 1)) != std::string_view::npos;
    const std::string phrase(first, last);
    if (!word || phrase.front() == '\'')
    {
      continue;
    }
    const auto        blank = std::min(phrase.find(' '), phrase.size());
    const std::string flag = phrase.substr(0, blank);
    std::string       value = blank < phrase.size() ? phrase.substr(blank + 1) : std::string();
    const auto        ends = value.find_last_not_of(".,:-");
    const std::string punctuation = ends == std::string::npos ? "" : value.substr(ends + 1);
    value.erase(value.size() - punctuation.size());
    if (const Parameter * parameter = FindByFlag(flag))
    {
      translated.append(copied, first);
      translated += Translate(*parameter, flag, value) + punctuation;
      copied = last;
    }
  }
  translated.append(copied, text.cend());
  return translated;
}

} // namespace voxelcore
