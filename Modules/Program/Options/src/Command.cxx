#include "voxelcore/Options/Command.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Options/AssembleCommands.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"

#include <list>
#include <utility>

namespace voxelcore
{

namespace
{

/** Puts a row behind those of its heading, unless its name is there. */
void
Add(std::vector<Parameter> & rows, const Parameter & row)
{
  if (FindParameter(rows, row.name) == nullptr)
  {
    rows.insert(ranges::find_if(rows, [&](const Parameter & other) { return other.group > row.group; }), row);
  }
}

/** The first of an extension's options that is given. */
std::string
FlagGiven(const Extension & extension, const ParameterValues & values)
{
  const auto row =
    ranges::find_if(extension.rows, [&](const Parameter & parameter) { return values.contains(parameter.name); });
  return row == extension.rows.end() ? std::string() : std::string(row->flags);
}

} // namespace

std::vector<Command>
AssembleCommands(std::span<const Command * const> commands, std::span<const Extension * const> extensions)
{
  static std::list<std::vector<Parameter>>         rowsOf;
  static std::list<std::vector<const Extension *>> extensionsOf;
  std::vector<Command>                             all;
  for (const Command * const one : commands)
  {
    all.push_back(*one);
  }
  std::stable_sort(all.begin(), all.end(), [](const Command & a, const Command & b) { return a.place < b.place; });
  const std::vector<Parameter> ofCases = OptionsOfCases(all);
  for (Command & command : all)
  {
    std::vector<Parameter> &         rows = rowsOf.emplace_back(command.rows.begin(), command.rows.end());
    std::vector<const Extension *> & own = extensionsOf.emplace_back();
    for (const Extension * const one : extensions)
    {
      if (one->command == command.name)
      {
        own.push_back(one);
        for (const Parameter & row : one->rows)
        {
          Add(rows, row);
        }
      }
    }
    if (command.runsCases)
    {
      for (const Command * const one : commands)
      {
        if (one->asCase != nullptr && !one->asCase->flag.empty())
        {
          Add(rows,
              { one->name,
                one->asCase->flag,
                ParameterKind::Flag,
                "",
                "",
                false,
                ParameterGroup::Cohort,
                one->asCase->description });
        }
      }
      for (const Parameter & row : ofCases)
      {
        if (!row.flags.empty()) // of what is beside the scan each case has its own
        {
          Add(rows, row);
        }
      }
    }
    command.rows = rows;
    command.extensions = own;
  }
  return all;
}

Outcome
RunCommand(const Command & command, const Invocation & call)
{
  const Extension * asked = nullptr;
  for (const Extension * const one : command.extensions)
  {
    if (one->isAsked(call.values))
    {
      if (asked != nullptr)
      {
        throw UsageError(FlagGiven(*asked, call.values) + " does not go with " + FlagGiven(*one, call.values) +
                         "; give either");
      }
      asked = one;
    }
  }
  return asked != nullptr ? asked->run(call) : command.run(call);
}

const Parameter *
FindParameter(std::span<const Parameter> rows, std::string_view name)
{
  const auto found = ranges::find(rows, name, &Parameter::name);
  return found == rows.end() ? nullptr : &*found;
}

std::vector<Parameter>
OptionsOfCases(std::span<const Command> commands)
{
  std::vector<Parameter> all;
  for (const Command & command : commands)
  {
    for (const Parameter & row : command.asCase != nullptr ? command.rows : std::span<const Parameter>())
    {
      const bool isBeside = row.name == command.asCase->beside;
      if (isBeside || (row.kind != ParameterKind::Input && row.kind != ParameterKind::Output && !row.ofOneRun))
      {
        Add(all, row);
      }
    }
  }
  return all;
}

std::string
ValueOf(const ParameterValues & values, const Command & command, std::string_view name)
{
  return ParameterReader(values, command).Text(name);
}

std::string
ChoiceOf(const ParameterValues & values, const Command & command, std::string_view name)
{
  return ParameterReader(values, command).Choice(name);
}

int
ThreadsFrom(const ParameterValues & values)
{
  return static_cast<int>(ParameterReader(values, table::kRunRows).Whole("threads", 0, 4096));
}

} // namespace voxelcore
