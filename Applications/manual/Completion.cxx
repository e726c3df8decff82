#include "Texts.h"
#include "voxelcore/Base/Text.h"

namespace voxelcore
{
namespace
{

template <typename TRange>
std::string
Joined(const TRange & words, const std::string & separator)
{
  std::string text;
  for (const auto & word : words)
  {
    text += (text.empty() ? "" : separator) + std::string(word);
  }
  return text;
}

bool
IsPath(const Parameter & parameter)
{
  return parameter.kind == ParameterKind::Input || parameter.kind == ParameterKind::Output;
}

/** Text within single quotes of a shell, within brackets and before colons of _arguments. */
std::string
ZshText(std::string_view text)
{
  std::string quoted;
  for (const char c : text)
  {
    if (c == '\'')
    {
      quoted += "'\\''";
    }
    else
    {
      quoted += (c == '[' || c == ']' || c == ':' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    }
  }
  return quoted;
}

} // namespace

std::vector<std::string>
FlagsOf(const Parameter & parameter)
{
  return parameter.flags.empty() ? std::vector<std::string>() : SplitText(parameter.flags, ',');
}

std::vector<std::string>
WordsOf(const Parameter & parameter)
{
  return parameter.kind == ParameterKind::Choice ? SplitText(parameter.placeholder, '|') : std::vector<std::string>();
}

std::string
BashCompletion()
{
  std::string names;
  std::string cases;
  for (const Command & command : Commands())
  {
    names += " " + std::string(command.name);
    std::string flags = "--help";
    std::string values;
    bool        takesPaths = false;
    for (const Parameter & parameter : command.rows)
    {
      const auto own = FlagsOf(parameter);
      flags += (own.empty() ? "" : " ") + Joined(own, " ");
      takesPaths = takesPaths || (own.empty() && IsPath(parameter));
      if (own.empty() || parameter.kind == ParameterKind::Flag)
      {
        continue;
      }
      const std::string what = IsPath(parameter)
                                 ? "_voxelcore_paths"
                                 : "COMPREPLY=($(compgen -W '" + Joined(WordsOf(parameter), " ") + "' -- \"$word\"))";
      values += "        " + Joined(own, "|") + ") " + what + "; return ;;\n";
    }
    cases += "    " + std::string(command.name) + ")\n      case \"$before\" in\n";
    cases += values;
    cases += "      esac\n      flags='" + flags + "'\n" +
             (takesPaths ? "      [[ $word == -* ]] || { _voxelcore_paths; return; }\n" : "") + "      ;;\n";
  }
  return "# bash completion for voxelcore\n"
         "_voxelcore_paths()\n{\n"
         "  compopt -o filenames 2>/dev/null\n"
         "  mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n}\n\n"
         "_voxelcore()\n{\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} flags\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '--help --version" +
         names +
         "' -- \"$word\"))\n    return\n  fi\n"
         "  case \"${COMP_WORDS[1]}\" in\n" +
         cases +
         "    *) return ;;\n  esac\n"
         "  COMPREPLY=($(compgen -W \"$flags\" -- \"$word\"))\n}\n"
         "complete -F _voxelcore voxelcore\n";
}

std::string
ZshCompletion()
{
  std::string names;
  std::string cases;
  for (const Command & command : Commands())
  {
    names += "    '" + std::string(command.name) + ":" + ZshText(command.description) + "'\n";
    cases += "      " + std::string(command.name) + ")\n        _arguments -s '--help[how to use it]'";
    for (const Parameter & parameter : command.rows)
    {
      const auto  flags = FlagsOf(parameter);
      std::string value;
      if (parameter.kind != ParameterKind::Flag)
      {
        const auto words = WordsOf(parameter);
        value = ":" + ZshText(parameter.placeholder) + ":" +
                (IsPath(parameter) ? "_files"
                 : words.empty()   ? ""
                                   : "(" + Joined(words, " ") + ")");
      }
      cases += " \\\n          ";
      if (flags.empty())
      {
        cases += "'" + value + "'";
        continue;
      }
      const std::string text = "'[" + ZshText(parameter.description) + "]" + value + "'";
      cases += flags.size() == 1 ? std::string(flags.front()) + text
                                 : "'(" + Joined(flags, " ") + ")'{" + Joined(flags, ",") + "}" + text;
    }
    cases += "\n        ;;\n";
  }
  return "#compdef voxelcore\n"
         "_voxelcore()\n{\n"
         "  local line state\n"
         "  local -a commands\n"
         "  commands=(\n" +
         names +
         "  )\n"
         "  _arguments -C '--version[version, engines and libraries]' '--help[how to use it]' '1:command:->command' "
         "'*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands ;;\n"
         "    argument)\n      case $line[1] in\n" +
         cases +
         "      esac\n      ;;\n  esac\n}\n"
         "_voxelcore \"$@\"\n";
}

} // namespace voxelcore
