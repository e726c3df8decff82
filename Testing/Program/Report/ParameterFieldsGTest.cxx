#include "voxelcore/Report/ParameterFields.h"

#include "voxelcore/Report/CoreReport.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace voxelcore
{
namespace
{

using Json = nlohmann::ordered_json;

/** Any value but the one a field has when nothing is said. */
void
SetOther(bool & field)
{
  field = !field;
}
void
SetOther(std::string & field)
{
  field = "qform";
}
template <typename T>
requires std::is_integral_v<T>
void
SetOther(std::optional<T> & field)
{
  field = 3;
}
void
SetOther(std::optional<std::string> & field)
{
  field = "a/b";
}
void
SetOther(std::optional<std::pair<double, double>> & field)
{
  field = { -1.0 / 3, 1e9 };
}
void
SetOther(std::optional<Vector3> & field)
{
  field = { 0.1, 0.2, 1.0 / 3 };
}
void
SetOther(std::optional<CropRange> & field)
{
  field = CropRange{ { 1, 2, 3 }, { 4, 5, 6 } };
}
void
SetOther(std::optional<RawLayout> & field)
{
  field = ParseRawLayout("3,4,5,uint16");
}

void
SetOther(std::optional<GapWidth> & field)
{
  field = ParseGapWidth("1.5vox");
}
void
SetOther(std::optional<MedianWidth> & field)
{
  field = MedianWidth{ 5 };
}
void
SetOther(std::optional<VoxelChanges> & field)
{
  field = ParseVoxelChanges("-1,2,3x4 +5,6,7");
}
void
SetOther(Connectivity & field)
{
  field = Connectivity::TwentySix;
}
void
SetOther(std::optional<SliceAxis> & field)
{
  field = SliceAxis::J;
}

/** A record of which field number `which` is another, or none. */
CoreReport
With(int which)
{
  CoreReport report;
  report.parameters.lambda = { "0" };
  LabelRecord label;
  label.label = 1;
  label.pruned.resize(1);
  report.labels = { label };
  int        at = 0;
  const auto change = [&](const char *, auto & field) {
    if (at++ == which)
    {
      SetOther(field);
    }
  };
  VisitScanFields(report.parameters, change);
  VisitModelFields(report.parameters.model, change);
  return report;
}

std::vector<std::string>
Names()
{
  std::vector<std::string> names;
  ParameterRecord          record;
  const auto               add = [&](const char * name, const auto &) { names.emplace_back(name); };
  VisitScanFields(record, add);
  VisitModelFields(record.model, add);
  return names;
}

TEST(ParameterFields, NamesAreThoseOfOptionsAndEachIsThereOnce)
{
  const auto names = Names();
  EXPECT_GE(names.size(), 19U);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string & name : names)
  {
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << name;
  }
}

TEST(ParameterFields, EachIsWrittenUnderItsNameAloneAndReadBack)
{
  const auto        names = Names();
  const std::string plain = ProvenanceJson(With(-1), { 0 }, 0);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const std::string text = ProvenanceJson(With(static_cast<int>(i)), { 0 }, 0);
    Json              changed = Json::parse(text).at("parameters");
    Json              before = Json::parse(plain).at("parameters");
    ASSERT_TRUE(changed.contains(names[i])) << names[i];
    EXPECT_NE(changed.at(names[i]), before.contains(names[i]) ? before.at(names[i]) : Json()) << names[i];
    changed.erase(names[i]);
    before.erase(names[i]);
    EXPECT_EQ(changed, before) << names[i] << " changes something else, too";
    EXPECT_EQ(ProvenanceJson(ParseProvenance(text, "a.vtp"), { 0 }, 0), text) << names[i];
  }
}

TEST(ParameterFields, StandInReportsInTheOrderOfTheVisit)
{
  const Json               parameters = Json::parse(ProvenanceJson(With(-1), { 0 }, 0)).at("parameters");
  const auto               names = Names();
  std::vector<std::string> inReport;
  for (const auto & [key, value] : parameters.items())
  {
    if (std::find(names.begin(), names.end(), key) != names.end())
    {
      inReport.push_back(key);
    }
  }
  std::vector<std::string> expected;
  for (const std::string & name : names)
  {
    if (parameters.contains(name)) // some formats' own are only in their files
    {
      expected.push_back(name);
    }
  }
  EXPECT_EQ(inReport, expected);
  EXPECT_GE(expected.size(), 16U);
}

} // namespace
} // namespace voxelcore
