#include "HelpFormatter.h"

#include <sstream>

namespace voxelcore
{

namespace
{

constexpr std::size_t kColumn = 34; ///< where descriptions begin
constexpr std::size_t kWidth = 112; ///< that of the footers

/** "  left      right", the right part in as many lines as it needs. */
std::string
TwoColumns(const std::string & left, const std::string & right)
{
  std::string line = "  " + left;
  std::string text;
  if (line.size() + 2 > kColumn)
  {
    text = line + "\n";
    line.clear();
  }
  line.resize(kColumn, ' ');
  std::istringstream words(right);
  bool               begins = true;
  for (std::string word; words >> word; begins = false)
  {
    if (!begins && line.size() + 1 + word.size() > kWidth)
    {
      text += line + "\n";
      line.assign(kColumn, ' ');
      begins = true;
    }
    line += (begins ? "" : " ") + word;
  }
  return text + line + "\n";
}

} // namespace

HelpFormatter::HelpFormatter()
{
  label("Positionals", "Arguments");
}

std::string
HelpFormatter::make_help(const CLI::App * app, std::string name, CLI::AppFormatMode mode) const
{
  // CLI11 leaves two empty lines between groups.
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n", "\n\n");
}

std::string
HelpFormatter::make_usage(const CLI::App * app, std::string /*name*/) const
{
  if (app->get_parent() == nullptr)
  {
    return "Usage: " + app->get_name() + " COMMAND [OPTIONS]\n";
  }
  std::string text = "Usage: " + app->get_parent()->get_name() + " " + app->get_name() + " [OPTIONS]";
  for (const CLI::Option * option : app->get_options())
  {
    if (option->get_positional())
    {
      text += " " + make_option_usage(option);
    }
  }
  for (const CLI::Option * option : app->get_options())
  {
    if (!option->get_positional() && option->get_required())
    {
      const auto & shorts = option->get_snames();
      text += " " + (shorts.empty() ? "--" + option->get_lnames().front() : "-" + shorts.front()) + " " +
              option->get_type_name();
    }
  }
  return text + "\n";
}

std::string
HelpFormatter::make_subcommand(const CLI::App * sub) const
{
  return TwoColumns(sub->get_name(), sub->get_description());
}

std::string
HelpFormatter::make_option(const CLI::Option * option, bool isPositional) const
{
  std::string left = make_option_name(option, isPositional);
  std::string right = option->get_description();
  if (!isPositional && option->get_type_size() != 0)
  {
    left += " " + option->get_type_name();
    left += option->get_required() ? " (required)" : "";
    right += option->get_default_str().empty() ? "" : " (default: " + option->get_default_str() + ")";
  }
  return TwoColumns(left, right);
}

} // namespace voxelcore
