#include "UnknownNames.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <vector>

namespace voxelcore
{

namespace
{

/** What follows the command. */
class Arguments
{
public:
  explicit Arguments(const Command & command)
    : m_Command(command)
  {
    for (const Parameter & parameter : command.rows)
    {
      if (parameter.flags.empty())
      {
        m_Endless = m_Endless || parameter.kind == ParameterKind::Inputs;
        m_Positionals += (m_Positionals.empty() ? "" : " ") + std::string(parameter.placeholder);
        ++m_Room;
        continue;
      }
      for (std::string_view flags = parameter.flags; !flags.empty();)
      {
        const std::size_t end = std::min(flags.find(','), flags.size());
        Add(flags.substr(0, end), &parameter);
        flags.remove_prefix(std::min(end + 1, flags.size()));
      }
    }
    Add("-h", nullptr);
    Add("--help", nullptr);
  }

  /** Takes argument `at` with its value. Gives the number of the next. */
  int
  Take(int argc, const char * const * argv, int at)
  {
    const std::string_view word = argv[at];
    if (word.size() < 2 || word.front() != '-')
    {
      TakePositional(word);
      return at + 1;
    }
    if (word.starts_with("--"))
    {
      const std::string_view name = word.substr(0, word.find('='));
      return at + (!TakesValue(name) || word.size() > name.size() ? 1 : RequireValue(name, argc, at));
    }
    const std::string asLong = "-" + std::string(word.substr(0, word.find('=')));
    if (asLong.size() > 3 && Find(asLong) != nullptr)
    {
      ThrowUsageError(std::string(word) + ": long options begin with two dashes; did you mean '" + asLong + "'?");
    }
    // "-qo FILE": options without values may stand before one with a value.
    for (std::size_t i = 1; i < word.size(); ++i)
    {
      const std::string name = std::string("-") + word[i];
      if (TakesValue(name, asLong))
      {
        return at + (i + 1 < word.size() ? 1 : RequireValue(name, argc, at));
      }
    }
    return at + 1;
  }

  void
  TakePositional(std::string_view word)
  {
    if (m_Endless)
    {
      return;
    }
    if (m_Room == 0)
    {
      ThrowUsageError("'" + std::string(word) + "': one argument too many; '" + std::string(m_Command.name) +
                      "' takes " + m_Positionals);
    }
    --m_Room;
  }

private:
  struct Flag
  {
    std::string_view  name;
    const Parameter * parameter; ///< null for help
  };

  void
  Add(std::string_view name, const Parameter * parameter)
  {
    m_Flags.push_back({ name, parameter });
  }

  /** Of an option there is; the suggestion for one there is not comes from `typed`, or its name. */
  bool
  TakesValue(std::string_view name, std::string_view typed = "") const
  {
    const Flag * const flag = Find(name);
    if (flag == nullptr)
    {
      std::vector<std::string_view> names;
      for (const Flag & one : m_Flags)
      {
        if (one.name.starts_with("--"))
        {
          names.push_back(one.name.substr(2));
        }
      }
      const std::string_view whole = typed.size() > 3 ? typed : name;
      ThrowUsageError(std::string(typed.size() > 3 ? typed.substr(1) : name) + ": unknown option" +
                      DidYouMean(whole.substr(std::min<std::size_t>(2, whole.size())), names, "--"));
    }
    return flag->parameter != nullptr && flag->parameter->kind != ParameterKind::Flag;
  }

  /** The number of arguments of an option whose value is the next. */
  int
  RequireValue(std::string_view name, int argc, int at) const
  {
    if (at + 1 == argc)
    {
      ThrowUsageError(std::string(name) + ": needs a value: " + std::string(Find(name)->parameter->placeholder));
    }
    return 2;
  }

  const Flag *
  Find(std::string_view name) const
  {
    const auto found =
      std::find_if(m_Flags.begin(), m_Flags.end(), [&](const Flag & flag) { return flag.name == name; });
    return found == m_Flags.end() ? nullptr : &*found;
  }

  [[noreturn]] void
  ThrowUsageError(const std::string & what) const
  {
    throw UsageError(what + "; see 'voxelcore " + std::string(m_Command.name) + " --help'");
  }

  const Command &   m_Command;
  std::vector<Flag> m_Flags;
  std::string       m_Positionals;
  int               m_Room = 0; ///< arguments that may still come
  bool              m_Endless = false;
};

} // namespace

void
RequireKnownNames(int argc, const char * const * argv)
{
  const std::string_view first = argc > 1 ? std::string_view(argv[1]) : std::string_view();
  if (first.empty() || first == "-h" || first == "--help" || first == "--version")
  {
    return;
  }
  const auto commands = Commands();
  const auto command =
    std::find_if(commands.begin(), commands.end(), [&](const Command & one) { return one.name == first; });
  if (command == commands.end())
  {
    std::vector<std::string_view> names;
    for (const Command & one : commands)
    {
      names.push_back(one.name);
    }
    throw UsageError((first.starts_with('-') ? std::string(first) + ": a command comes first"
                                             : "'" + std::string(first) + "' is not a command") +
                     DidYouMean(first, names) + "; see 'voxelcore --help'");
  }
  Arguments arguments(*command);
  bool      optionsEnded = false;
  for (int at = 2; at < argc;)
  {
    if (optionsEnded)
    {
      arguments.TakePositional(argv[at++]);
    }
    else if (std::string_view(argv[at]) == "--")
    {
      optionsEnded = true;
      ++at;
    }
    else
    {
      at = arguments.Take(argc, argv, at);
    }
  }
}

} // namespace voxelcore
