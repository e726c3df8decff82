#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/AssembleCommands.h"
#include "voxelcore/Options/Command.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <set>

namespace voxelcore
{
namespace
{

TEST(Command, NamesAndFlagsAreUniqueWithinACommand)
{
  for (const Command & command : Commands())
  {
    std::set<std::string_view> names;
    std::set<std::string_view> flags;
    bool                       optionsBegan = false;
    for (const Parameter & parameter : command.rows)
    {
      EXPECT_TRUE(names.insert(parameter.name).second) << command.name << " " << parameter.name;
      EXPECT_TRUE(flags.insert(parameter.flags.empty() ? parameter.placeholder : parameter.flags).second)
        << command.name << " " << parameter.flags;
      EXPECT_FALSE(parameter.description.empty()) << parameter.name;
      EXPECT_EQ(parameter.description.find('\n'), std::string_view::npos) << parameter.name;
      EXPECT_EQ(parameter.kind == ParameterKind::Flag, parameter.placeholder.empty()) << parameter.name;
      EXPECT_FALSE(optionsBegan && parameter.flags.empty()) << "positionals come first: " << parameter.name;
      optionsBegan = optionsBegan || !parameter.flags.empty();
    }
    EXPECT_FALSE(names.empty()) << command.name;
    EXPECT_NE(command.footer.find("voxelcore " + std::string(command.name)), std::string_view::npos)
      << command.name << " has no example";
  }
}

TEST(Command, OptionsOfAGroupStandTogetherInTheOrderOfTheHeadings)
{
  std::set<std::string_view> headings;
  for (const Command & command : Commands())
  {
    ParameterGroup last = ParameterGroup::Input;
    for (const Parameter & parameter : command.rows)
    {
      EXPECT_LE(last, parameter.group) << command.name << " " << parameter.name;
      last = parameter.group;
      headings.insert(GroupHeading(parameter.group));
    }
  }
  EXPECT_EQ(headings.size(), 14U);
}

/** "--words" in a text. */
std::set<std::string>
OptionsNamedIn(std::string_view text)
{
  std::set<std::string> names;
  for (std::size_t at = 0; (at = text.find("--", at)) != std::string_view::npos;)
  {
    const std::size_t end = std::min(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at), text.size());
    names.emplace(text.substr(at, end - at));
    at = end;
  }
  return names;
}

TEST(Command, DescriptionsNameOnlyOptionsTheirCommandHas)
{
  for (const Command & command : Commands())
  {
    std::set<std::string> own;
    for (const Parameter & parameter : command.rows)
    {
      own.merge(OptionsNamedIn(parameter.flags));
    }
    for (const Parameter & parameter : command.rows)
    {
      for (const std::string & named : OptionsNamedIn(parameter.description))
      {
        EXPECT_TRUE(own.contains(named)) << command.name << " --help: " << parameter.flags << " speaks of " << named;
      }
    }
  }
}

constexpr std::array<Parameter, 2> kRows{ {
  { "scan", "", ParameterKind::Input, "SCAN", "", true, ParameterGroup::Input, "A scan" },
  { "far", "--far", ParameterKind::Flag, "", "", false, ParameterGroup::Running, "Go far" },
} };

constexpr std::array<Parameter, 2> kMoreRows{ {
  { "far", "--far", ParameterKind::Flag, "", "", false, ParameterGroup::Running, "Another of this name" },
  { "wide", "--wide", ParameterKind::Flag, "", "", false, ParameterGroup::Output, "Go wide" },
} };

Outcome
SayOne(const Invocation &)
{
  return { .text = "one" };
}

Outcome
SayMore(const Invocation &)
{
  return { .text = "more" };
}

const AsCase  kAsCase{ .arguments = nullptr, .understand = nullptr, .flag = "--one", .description = "Run one" };
const Command kOne{ .name = "one", .place = 2, .rows = kRows, .run = SayOne, .asCase = &kAsCase };
const Command kMany{ .name = "many", .place = 1, .rows = {}, .run = SayOne, .runsCases = true };

const Extension kMore{ .command = "one",
                       .rows = kMoreRows,
                       .isAsked = [](const ParameterValues & values) { return values.contains("wide"); },
                       .run = SayMore };

std::vector<std::string_view>
NamesOf(const Command & command)
{
  std::vector<std::string_view> names;
  for (const Parameter & row : command.rows)
  {
    names.push_back(row.name);
  }
  return names;
}

TEST(Command, AnExtensionAddsOptionsAndRunsWhereItIsAskedFor)
{
  const std::array<const Command *, 2>   commands{ &kOne, &kMany };
  const std::array<const Extension *, 1> extensions{ &kMore };
  const auto                             all = AssembleCommands(commands, extensions);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "many") << "by their places";
  EXPECT_EQ(NamesOf(all[1]), (std::vector<std::string_view>{ "scan", "wide", "far" }));
  EXPECT_EQ(FindParameter(all[1].rows, "far")->description, "Go far") << "the command's own comes first";
  const JobContext      context;
  const ParameterValues plain;
  const ParameterValues wide{ { "wide", "true" } };
  EXPECT_EQ(RunCommand(all[1], { plain, "", 1, context, all, {} }).text, "one");
  EXPECT_EQ(RunCommand(all[1], { wide, "", 1, context, all, {} }).text, "more");
  const std::array<const Extension *, 2> two{ &kMore, &kMore };
  const auto                             both = AssembleCommands(commands, two);
  EXPECT_THROW(RunCommand(both[1], { wide, "", 1, context, both, {} }), UsageError);
}

TEST(Command, ABatchTakesWhatItsCasesTakeButPathsAndAFlagForEachKind)
{
  const std::array<const Command *, 2> commands{ &kOne, &kMany };
  const auto                           all = AssembleCommands(commands, {});
  EXPECT_EQ(NamesOf(all[0]), (std::vector<std::string_view>{ "one", "far" }));
}

} // namespace
} // namespace voxelcore
