#include "CommandLine.h"

#include "HelpFormatter.h"
#include "UnknownNames.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Report/CoreReport.h"

#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr const char * kFooter = R"(
'voxelcore COMMAND --help' explains a command, with examples. Lengths are in mm, positions in files are LPS.
Results appear complete or not at all.
Exit codes: 0 done; 1 failed, such as a full disk; 2 wrong usage; 3 input unreadable or unfit; 4 a certificate failed or
'verify' disagrees; 130 interrupted.
Example: voxelcore core scan.nii.gz -o medial.vtp)";

std::string
Quoted(const std::string & word)
{
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                              "_-./:,=+%@") == std::string::npos)
  {
    return word;
  }
  std::string text = "'";
  for (const char c : word)
  {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

void
AddParameter(CLI::App & app, const Parameter & parameter, ParameterValues & values)
{
  const std::string name(parameter.name);
  const std::string description(parameter.description);
  if (parameter.kind == ParameterKind::Flag)
  {
    app
      .add_flag_callback(
        std::string(parameter.flags),
        [&values, name] { values[name] = "true"; },
        description)
      ->group(std::string(GroupHeading(parameter.group)));
    return;
  }
  if (parameter.kind == ParameterKind::Inputs)
  {
    const auto join = [&values, name](const std::vector<std::string> & given) {
      for (const std::string & one : given)
      {
        if (one.find('\n') != std::string::npos)
        {
          throw UsageError(one + ": a file name with a line end cannot be given; rename the file, or name its folder");
        }
        std::string & all = values[name];
        all += (all.empty() ? "" : "\n") + one;
      }
    };
    CLI::Option * const option = app.add_option_function<std::vector<std::string>>(
      std::string(parameter.placeholder.substr(0, parameter.placeholder.find('.'))),
      join,
      description);
    option->type_name("")->required(parameter.required);
    return;
  }
  const std::string flags(parameter.flags.empty() ? parameter.placeholder : parameter.flags);
  CLI::Option *     option = app.add_option_function<std::string>(
    flags,
    [&values, name](const std::string & value) { values[name] = value; },
    description);
  option->type_name(parameter.flags.empty() ? "" : std::string(parameter.placeholder));
  option->required(parameter.required)->group(std::string(GroupHeading(parameter.group)));
  if (!parameter.defaultValue.empty())
  {
    option->default_str(std::string(parameter.defaultValue));
  }
}

/** First line only: some of CLI11's messages run on. Of an option given twice it says how many it counted. */
std::string
MessageOf(const CLI::ParseError & error)
{
  const std::string text = error.what();
  return dynamic_cast<const CLI::ArgumentMismatch *>(&error) != nullptr
           ? text.substr(0, text.find(':')) + ": is given more than once"
           : text.substr(0, text.find('\n'));
}

} // namespace

CommandLine
ParseCommandLine(int argc, char ** argv)
{
  CommandLine line;
  for (int i = 0; i < argc; ++i)
  {
    line.whole += (i > 0 ? " " : "") + Quoted(argv[i]);
  }
  CLI::App app("Certified medial surfaces of segmented CT and MRI volumes", "voxelcore");
  app.set_version_flag("--version", VersionText());
  app.footer(kFooter);
  app.require_subcommand(0, 1);
  app.allow_windows_style_options(false); // the same command line on every system
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this help");
  app.get_option("--version")->description("Print version, engines and libraries");
  std::vector<std::pair<const Command *, CLI::App *>> commands;
  for (const Command & command : Commands())
  {
    CLI::App * sub = app.add_subcommand(std::string(command.name), std::string(command.description));
    sub->group("Commands")->footer("\n" + std::string(command.footer));
    sub->set_help_flag(); // added last: groups appear in the order of their first option
    commands.emplace_back(&command, sub);
    for (const Parameter & parameter : command.rows)
    {
      AddParameter(*sub, parameter, line.values);
    }
    sub->set_help_flag("-h,--help", "Print this help")->group(std::string(GroupHeading(ParameterGroup::Running)));
  }
  std::vector<std::string> arguments;
  std::vector<char *>      renamed;
  arguments.reserve(static_cast<std::size_t>(argc));
  renamed.reserve(static_cast<std::size_t>(argc));
  for (int i = 0; i < argc; ++i)
  {
    arguments.push_back(WithoutFormerName(argv[i]));
  }
  for (std::string & argument : arguments)
  {
    renamed.push_back(argument.data());
  }
  RequireKnownNames(argc, renamed.data());
  std::string helpHint = "; see 'voxelcore --help'";
  try
  {
    app.parse(argc, renamed.data());
  }
  catch (const CLI::CallForHelp &)
  {
    const auto chosen = app.get_subcommands();
    line.text = chosen.empty() ? app.help() : chosen.front()->help();
    return line;
  }
  catch (const CLI::CallForVersion & version)
  {
    line.text = version.what();
    return line;
  }
  catch (const CLI::ParseError & error)
  {
    const auto chosen = app.get_subcommands();
    if (!chosen.empty())
    {
      helpHint = "; see 'voxelcore " + chosen.front()->get_name() + " --help'";
    }
    throw UsageError(MessageOf(error) + helpHint);
  }
  for (const auto & [command, sub] : commands)
  {
    if (sub->parsed())
    {
      line.command = command;
    }
  }
  if (line.command == nullptr)
  {
    throw UsageError("no command given" + helpHint);
  }
  return line;
}

} // namespace voxelcore
