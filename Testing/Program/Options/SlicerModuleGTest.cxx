#include "voxelcore/Options/SlicerModule.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace voxelcore
{
namespace
{

constexpr std::array<CommandId, 2> kModules{ CommandId::Core, CommandId::Skeleton };

/** What stands between the tags of this name, in order. */
std::vector<std::string>
Texts(const std::string & xml, const std::string & tag)
{
  std::vector<std::string> texts;
  const std::string        begins = "<" + tag + ">";
  const std::string        ends = "</" + tag + ">";
  for (auto at = xml.find(begins); at != std::string::npos; at = xml.find(begins, at))
  {
    at += begins.size();
    texts.push_back(xml.substr(at, xml.find(ends, at) - at));
  }
  return texts;
}

std::string
Message(CommandId command, const std::vector<std::string> & arguments)
{
  try
  {
    ParseSlicerCall(command, arguments);
  }
  catch (const UsageError & error)
  {
    return error.what();
  }
  return "";
}

TEST(SlicerModule, EachFlagOfTheDescriptionIsAnOptionOfTheCommand)
{
  for (const CommandId command : kModules)
  {
    const std::string           xml = SlicerXml(command);
    const auto                  flags = Texts(xml, "longflag");
    const auto                  names = Texts(xml, "name");
    const std::set<std::string> different(names.begin(), names.end());
    EXPECT_EQ(different.size(), names.size()) << "names are there once";
    EXPECT_GT(flags.size(), 10U);
    for (const std::string & flag : flags)
    {
      const auto parameters = Parameters();
      const auto row = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter & parameter) {
        return BelongsTo(parameter, command) && "--" + std::string(parameter.name) == flag;
      });
      ASSERT_NE(row, parameters.end()) << flag;
      // A call with it is understood, and arrives under the row's name.
      std::vector<std::string> arguments{ flag, "in.nrrd", "out.vtp" };
      if (row->kind != ParameterKind::Flag)
      {
        arguments.insert(arguments.begin() + 1, "some words");
      }
      if (flag != "--lambda")
      {
        const SlicerCall call = ParseSlicerCall(command, arguments);
        EXPECT_EQ(call.values.at(std::string(row->name)), row->kind == ParameterKind::Flag ? "true" : "some words");
      }
    }
    for (const char * hidden : { "--progress", "--force", "--json", "--report", "--output", "--also" })
    {
      EXPECT_EQ(std::count(flags.begin(), flags.end(), hidden), 0) << hidden;
      EXPECT_NE(Message(command, { hidden, "in.nrrd", "out.vtp" }).find("there is no such option"), std::string::npos)
        << hidden;
    }
  }
}

TEST(SlicerModule, FilesStandLastInTheOrderOfTheirIndex)
{
  for (const CommandId command : kModules)
  {
    const std::string xml = SlicerXml(command);
    EXPECT_EQ(Texts(xml, "index"), (std::vector<std::string>{ "0", "1" }));
    EXPECT_LT(xml.find("<name>LabelVolume</name>"), xml.find("<index>0</index>"));
    const SlicerCall call = ParseSlicerCall(command, { "--labels", "1,2", "in.nrrd", "out.vtp" });
    EXPECT_EQ(call.values.at("scan"), "in.nrrd");
    EXPECT_EQ(call.values.at("output"), "out.vtp");
    EXPECT_EQ(call.values.at("labels"), "1,2");
    EXPECT_EQ(call.values.at("force"), "true") << "Slicer's files are there already";
    EXPECT_FALSE(call.wantsXml);
    EXPECT_FALSE(call.returnParameterFile);
  }
}

TEST(SlicerModule, EveryElementIsClosed)
{
  for (const CommandId command : kModules)
  {
    const std::string        xml = SlicerXml(command);
    std::vector<std::string> open;
    for (auto at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1))
    {
      if (xml.compare(at, 9, "<![CDATA[") == 0)
      {
        at = xml.find("]]>", at);
        ASSERT_NE(at, std::string::npos);
        continue;
      }
      if (xml[at + 1] == '?')
      {
        continue;
      }
      const bool        closes = xml[at + 1] == '/';
      const auto        from = at + (closes ? 2 : 1);
      const std::string name = xml.substr(from, xml.find_first_of(" >", from) - from);
      if (closes)
      {
        ASSERT_FALSE(open.empty());
        ASSERT_EQ(open.back(), name);
        open.pop_back();
      }
      else
      {
        open.push_back(name);
      }
    }
    EXPECT_TRUE(open.empty());
  }
}

TEST(SlicerModule, EmptyTextFieldsAreNotGiven)
{
  const SlicerCall call =
    ParseSlicerCall(CommandId::Core,
                    { "--labels", "", "--crop", "", "--returnparameterfile", "/tmp/r.txt", "in.nrrd", "out.vtp" });
  EXPECT_FALSE(call.values.contains("labels"));
  EXPECT_FALSE(call.values.contains("crop"));
  EXPECT_EQ(call.returnParameterFile, "/tmp/r.txt");
  EXPECT_TRUE(ParseSlicerCall(CommandId::Core, { "--xml" }).wantsXml);
}

TEST(SlicerModule, WrongCallsAreRefused)
{
  for (const CommandId command : kModules)
  {
    EXPECT_NE(Message(command, { "in.nrrd" }), "");
    EXPECT_NE(Message(command, {}), "");
    EXPECT_NE(Message(command, { "in.nrrd", "" }), "");
    EXPECT_NE(Message(command, { "a", "b", "c" }), "");
    EXPECT_NE(Message(command, { "in.nrrd", "out.vtp", "--labels" }).find("needs a value"), std::string::npos);
  }
  EXPECT_NE(Message(CommandId::Core, { "--lambda", "0,1", "in.nrrd", "out.vtp" }).find("one value"), std::string::npos);
  EXPECT_THROW(SlicerXml(CommandId::Info), std::logic_error);
}

TEST(SlicerModule, WhatIsReturnedIsSummedOverLabelsAndDescribed)
{
  CoreReport report;
  report.labels.resize(2);
  report.seconds.total = 1.5;
  for (LabelRecord & label : report.labels)
  {
    label.shape.betti = { 1, 3, 0 };
    label.pruned.resize(2);
    label.pruned.back().complex.faces = 2000000000;
    label.pruned.back().complex.areaMm2 = 0.25;
    label.skeleton.emplace();
    label.skeleton->numbers.branches = 4;
    label.skeleton->numbers.totalLength = 12.5;
  }
  EXPECT_EQ(SlicerReturnText(CommandId::Core, report),
            "faces = 4000000000\narea = 0.5\nb0 = 2\nb1 = 6\nb2 = 0\nseconds = 1.5\n");
  EXPECT_EQ(SlicerReturnText(CommandId::Skeleton, report),
            "branches = 8\nlength = 25\nb0 = 2\nb1 = 6\nb2 = 0\nseconds = 1.5\n");
  for (const CommandId command : kModules)
  {
    const auto names = Texts(SlicerXml(command), "name");
    for (const char * name : { "b0", "b1", "b2", "seconds" })
    {
      EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    }
  }
}

} // namespace
} // namespace voxelcore
