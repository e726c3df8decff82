#include "voxelcore/Options/OptionsJson.h"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

namespace voxelcore
{

std::string
OptionsJson(std::span<const Command> commands)
{
  static constexpr std::array kKinds = { "input", "inputs", "output", "text", "integer", "real", "choice", "flag" };
  nlohmann::ordered_json      table{ { "commands", nlohmann::json::array() }, { "options", nlohmann::json::array() } };
  // A row that commands share, by its name and what they may differ in.
  std::map<std::array<std::string_view, 4>, std::size_t> there;
  for (const Command & command : commands)
  {
    table["commands"].push_back(
      { { "name", command.name }, { "description", command.description }, { "footer", command.footer } });
    for (const Parameter & parameter : command.rows)
    {
      const auto [at, isNew] =
        there.try_emplace({ parameter.name, parameter.placeholder, parameter.defaultValue, parameter.description },
                          table["options"].size());
      if (!isNew)
      {
        table["options"][at->second]["commands"].push_back(command.name);
        continue;
      }
      table["options"].push_back({ { "name", parameter.name },
                                   { "flags", parameter.flags },
                                   { "kind", kKinds.at(static_cast<std::size_t>(parameter.kind)) },
                                   { "placeholder", parameter.placeholder },
                                   { "default", parameter.defaultValue },
                                   { "required", parameter.required },
                                   { "commands", { command.name } },
                                   { "description", parameter.description },
                                   { "group", GroupHeading(parameter.group) } });
    }
  }
  return table.dump(1) + "\n";
}

} // namespace voxelcore
