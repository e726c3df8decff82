#pragma once
// The look of --help: groups of options in the table's order, lines of one width.

#include <CLI/CLI.hpp>

namespace voxelcore
{

class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter();

  std::string
  make_help(const CLI::App * app, std::string name, CLI::AppFormatMode mode) const override;
  std::string
  make_usage(const CLI::App * app, std::string name) const override;
  std::string
  make_subcommand(const CLI::App * sub) const override;
  std::string
  make_option(const CLI::Option * option, bool isPositional) const override;
};

} // namespace voxelcore
