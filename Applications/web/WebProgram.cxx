// What MainStack.cxx and Signals.cxx do elsewhere, and the table of options for a page's forms. Here the stack has its
// size from the start, and nothing but the page or Node ends the program: it asks for that by Module.isCancelled().

#include "../voxelcore/Ending.h"
#include "../voxelcore/MainStack.h"
#include "voxelcore/Options/Command.h"

#include <emscripten.h>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

EM_JS(int, IsCancelledByCaller, (), { return Module["isCancelled"] && Module["isCancelled"]() ? 1 : 0; });

// {commands: [{name, description, footer}], options: [{name, flags, kind, placeholder, default, required, commands,
// description, group}]}; the text lives as long as the program.
extern "C" EMSCRIPTEN_KEEPALIVE const char *
ParameterTable()
{
  using namespace voxelcore; // NOLINT: a door of the program
  static const std::string text = [] {
    constexpr const char * kinds[] = { "input", "inputs", "output", "text", "integer", "real", "choice", "flag" };
    nlohmann::ordered_json table{ { "commands", nlohmann::json::array() }, { "options", nlohmann::json::array() } };
    for (const Command & command : Commands())
    {
      table["commands"].push_back(
        { { "name", command.name }, { "description", command.description }, { "footer", command.footer } });
    }
    std::map<std::pair<const char *, const char *>, std::size_t> there; // a row that commands share, by its texts
    for (const Command & command : Commands())
    {
      for (const Parameter & parameter : command.rows)
      {
        const auto [at, isNew] = there.emplace(std::pair(parameter.description.data(), parameter.defaultValue.data()),
                                               table["options"].size());
        if (!isNew)
        {
          table["options"][at->second]["commands"].push_back(command.name);
          continue;
        }
        table["options"].push_back({ { "name", parameter.name },
                                     { "flags", parameter.flags },
                                     { "kind", kinds[static_cast<int>(parameter.kind)] },
                                     { "placeholder", parameter.placeholder },
                                     { "default", parameter.defaultValue },
                                     { "required", parameter.required },
                                     { "commands", { command.name } },
                                     { "description", parameter.description },
                                     { "group", GroupHeading(parameter.group) } });
      }
    }
    return table.dump();
  }();
  return text.c_str();
}

namespace voxelcore
{

void
ReserveMainStack()
{}

int
RunWithStack(const std::function<int()> & work)
{
  return work();
}

void
HandleSignals(const TemporaryRegistry & registry, int)
{
  temporaries = &registry;
}

bool
WasInterrupted()
{
  return IsCancelledByCaller() != 0;
}

void
CallOffDeadline()
{}

} // namespace voxelcore
