#include "voxelcore/Options/OptionsJson.h"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace voxelcore
{

std::string
OptionsJson(std::span<const Command> commands)
{
  static constexpr std::array kKinds = { "input", "inputs", "output", "text", "integer", "real", "choice", "flag" };
  nlohmann::ordered_json      table{ { "commands", nlohmann::json::array() }, { "options", nlohmann::json::array() } };
  std::map<std::pair<const char *, const char *>, std::size_t> there; // a row that commands share, by its texts
  for (const Command & command : commands)
  {
    table["commands"].push_back(
      { { "name", command.name }, { "description", command.description }, { "footer", command.footer } });
    for (const Parameter & parameter : command.rows)
    {
      const auto [at, isNew] =
        there.emplace(std::pair(parameter.description.data(), parameter.defaultValue.data()), table["options"].size());
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
