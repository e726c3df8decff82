#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::ordered_json;

/** Places and radii that need all bits of a double. */
SkeletonGraph
Points(std::size_t count, double seed)
{
  SkeletonGraph graph;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double t = static_cast<double>(i) + seed;
    graph.positions.push_back({ t / 3, std::sin(t), -t * t / 7 });
    graph.radius.push_back(0.5 + 1 / (t + 2));
    graph.erosionThickness.push_back(i % 5 == 3 ? std::numeric_limits<double>::infinity() : t / 11);
  }
  return graph;
}

/** Label 3: a cycle with a tail, and a point by itself. Label 7, component 2: a face that stays and a curve on it. */
SkeletonModel
Mixed()
{
  SkeletonModel model;
  model.provenance = "{}";
  SkeletonPart ring;
  ring.label = 3;
  ring.name = "a, \"b\"";
  ring.graph = Points(7, 0.1);
  SortBranches(ring.graph, { { 0, 1, 2 }, { 2, 3, 4, 5, 2 } }, true);
  ring.table = MeasureBranches(ring.graph);
  SkeletonPart plate;
  plate.label = 7;
  plate.component = 2;
  plate.name = "plate";
  plate.graph = Points(6, 40.3);
  plate.graph.faceOffsets = { 0, 4 };
  plate.graph.faceVertices = { 0, 1, 2, 3 };
  plate.graph.closedFace = { 1 };
  SortBranches(plate.graph, { { 3, 4, 5 } }, true);
  plate.table = MeasureBranches(plate.graph);
  model.parts = { ring, plate };
  return model;
}

TEST(SkeletonModel, AVtpIsReadAsItWasWritten)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  for (const auto unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    model.unit = unit;
    WriteSkeletonVtp(folder / "a.vtp", model);
    const SkeletonModel read = ReadSkeletonVtp(folder / "a.vtp");
    EXPECT_EQ(read.unit, unit);
    EXPECT_EQ(read.provenance, model.provenance);
    ASSERT_EQ(read.parts.size(), 2U);
    for (std::size_t p = 0; p < 2; ++p)
    {
      const SkeletonGraph & a = read.parts[p].graph;
      const SkeletonGraph & b = model.parts[p].graph;
      EXPECT_EQ(read.parts[p].label, model.parts[p].label);
      EXPECT_EQ(read.parts[p].component, model.parts[p].component);
      EXPECT_EQ(a.positions, b.positions);
      EXPECT_EQ(a.radius, b.radius);
      EXPECT_EQ(a.erosionThickness, b.erosionThickness);
      EXPECT_EQ(a.branchOffsets, b.branchOffsets);
      EXPECT_EQ(a.branchPoints, b.branchPoints);
      EXPECT_EQ(a.nodePoints, b.nodePoints);
      EXPECT_EQ(a.nodeKinds, b.nodeKinds);
      EXPECT_EQ(a.faceOffsets, b.faceOffsets);
      EXPECT_EQ(a.faceVertices, b.faceVertices);
      EXPECT_EQ(a.closedFace, b.closedFace);
      EXPECT_TRUE(read.parts[p].name.empty());
      EXPECT_TRUE(read.parts[p].table.branches.empty());
    }
    // What is written of what was read, measured anew, is the same file.
    SkeletonModel again = read;
    for (std::size_t p = 0; p < 2; ++p)
    {
      again.parts[p].table = MeasureBranches(again.parts[p].graph);
    }
    WriteSkeletonVtp(folder / "b.vtp", again);
    EXPECT_EQ(ReadAll(folder / "b.vtp"), ReadAll(folder / "a.vtp"));
  }
}

// Before, the array Radius was that of the balls, beside SectionRadius.
TEST(SkeletonModel, LivesOfBranchesComeBackAndStandInTheTable)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  EXPECT_FALSE(HasLives(model));
  EXPECT_TRUE(PointConfidence(model.parts[0]).empty());
  model.parts[0].lives = { { 0.1, 0.4 }, { 0.3, 0.9 } };
  model.parts[1].lives = { { 0.2, 0.2 } };
  ASSERT_EQ(model.parts[0].graph.BranchCount(), 2U);
  ASSERT_EQ(model.parts[1].graph.BranchCount(), 1U);
  WriteSkeletonVtp(folder / "a.vtp", model);
  const SkeletonModel read = ReadSkeletonVtp(folder / "a.vtp");
  for (std::size_t part = 0; part < 2; ++part)
  {
    ASSERT_EQ(read.parts[part].lives.size(), model.parts[part].lives.size());
    for (std::size_t branch = 0; branch < model.parts[part].lives.size(); ++branch)
    {
      EXPECT_EQ(read.parts[part].lives[branch].lowest, model.parts[part].lives[branch].lowest);
      EXPECT_EQ(read.parts[part].lives[branch].highest, model.parts[part].lives[branch].highest);
    }
  }
  const auto confidence = PointConfidence(model.parts[0]);
  EXPECT_EQ(confidence[0], 0.4);
  EXPECT_EQ(confidence[2], 0.9); // both meet here
  EXPECT_EQ(confidence[6], 0);   // a point by itself
  WriteBranchCsv(folder / "a.csv", model);
  const std::string table = ReadAll(folder / "a.csv");
  EXPECT_NE(table.find(",lowest_threshold,highest_threshold,persistence\n"), std::string::npos);
  EXPECT_NE(table.find(",0.3,0.9,0.6\n"), std::string::npos);
  const Json columns = Json::parse(SkeletonColumnsJson(model.unit, false, true));
  EXPECT_TRUE(columns.at("branches").contains("persistence"));
  EXPECT_FALSE(Json::parse(SkeletonColumnsJson(model.unit)).at("branches").contains("persistence"));
  model.parts[1].lives = { { 0.2, 1.5 } };
  WriteSkeletonVtp(folder / "b.vtp", model);
  EXPECT_THROW(ReadSkeletonVtp(folder / "b.vtp"), InputError);
}

TEST(SkeletonModel, NamesOfBranchesComeBackAndStandInTheTable)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  EXPECT_FALSE(HasNames(model));
  model.parts[0].names = { "", "left, upper" };
  ASSERT_EQ(model.parts[0].graph.BranchCount(), 2U);
  WriteSkeletonVtp(folder / "a.vtp", model);
  const SkeletonModel read = ReadSkeletonVtp(folder / "a.vtp");
  EXPECT_EQ(read.parts[0].names, model.parts[0].names);
  EXPECT_TRUE(HasNames(read));
  WriteBranchCsv(folder / "a.csv", model);
  const std::string table = ReadAll(folder / "a.csv");
  EXPECT_NE(table.find(",branch_name\n"), std::string::npos);
  EXPECT_NE(table.find(",\"left, upper\"\n"), std::string::npos);
  EXPECT_TRUE(Json::parse(SkeletonColumnsJson(model.unit, false, false, true)).at("branches").contains("branch_name"));
  EXPECT_FALSE(Json::parse(SkeletonColumnsJson(model.unit)).at("branches").contains("branch_name"));
  model.parts[0].names = { "", "" };
  WriteSkeletonVtp(folder / "b.vtp", model);
  EXPECT_FALSE(HasNames(ReadSkeletonVtp(folder / "b.vtp")));
}

TEST(SkeletonModel, RadiiOfOlderFilesAreTakenAsTheyWereMeant)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  for (SkeletonPart & part : model.parts)
  {
    part.graph.sectionRadius = part.graph.radius;
    for (double & radius : part.graph.sectionRadius)
    {
      radius += 0.25;
    }
  }
  WriteSkeletonVtp(folder / "new.vtp", model);
  std::string bytes = ReadAll(folder / "new.vtp");
  const auto  rename = [&bytes](const std::string & from, const std::string & to) {
    const std::size_t at = bytes.find("Name=\"" + from + "\"");
    ASSERT_NE(at, std::string::npos) << from;
    bytes.replace(at, from.size() + 7, "Name=\"" + to + "\"");
  };
  rename("Radius", "SectionRadius");
  rename("BallRadius", "Radius");
  WriteAll(folder / "old.vtp", bytes);
  for (const char * name : { "new.vtp", "old.vtp" })
  {
    const SkeletonModel read = ReadSkeletonVtp(folder / name);
    ASSERT_EQ(read.parts.size(), model.parts.size()) << name;
    for (std::size_t p = 0; p < read.parts.size(); ++p)
    {
      EXPECT_EQ(read.parts[p].graph.radius, model.parts[p].graph.radius) << name;
      EXPECT_EQ(read.parts[p].graph.sectionRadius, model.parts[p].graph.sectionRadius) << name;
    }
    EXPECT_TRUE(ReadSkeletonIfAny(folder / name).has_value());
  }
  WriteAll(folder / "none.vtp", "no file of VTK");
  EXPECT_FALSE(ReadSkeletonIfAny(folder / "none.vtp").has_value());
  rename("SectionRadius", "Other");
  rename("Radius", "Another");
  WriteAll(folder / "bad.vtp", bytes);
  EXPECT_THROW(ReadSkeletonIfAny(folder / "bad.vtp"), InputError) << "it is a skeleton, and damaged";
}

TEST(SkeletonModel, DamagedFilesAreRefused)
{
  const TemporaryFolder folder;
  WriteSkeletonVtp(folder / "a.vtp", Mixed());
  const std::string bytes = ReadAll(folder / "a.vtp");
  EXPECT_THROW(ReadSkeletonVtp(folder / "none.vtp"), InputError);
  WriteModel(folder / "core.vtp", "core.vtp", MixedModel(), {});
  EXPECT_THROW(ReadSkeletonVtp(folder / "core.vtp"), InputError) << "a core is no skeleton";
  for (std::size_t length = 0; length + 40 < bytes.size(); length += 97)
  {
    WriteAll(folder / "b.vtp", bytes.substr(0, length));
    EXPECT_THROW(ReadSkeletonVtp(folder / "b.vtp"), InputError) << length;
  }
  for (const char * name : { "Name=\"Radius\"", "Name=\"BranchId\"", "Name=\"Label\"", "Name=\"ErosionThickness\"" })
  {
    std::string damaged = bytes;
    const auto  at = damaged.find(name);
    ASSERT_NE(at, std::string::npos) << name;
    damaged[at + 6] = '_';
    WriteAll(folder / "b.vtp", damaged);
    EXPECT_THROW(ReadSkeletonVtp(folder / "b.vtp"), InputError) << name;
  }
}

/** A row of an SWC. */
struct SwcPoint
{
  long    id = 0;
  long    type = 0;
  Vector3 place{};
  double  radius = 0;
  long    parent = 0;
};

std::vector<SwcPoint>
SwcPoints(const std::string & text)
{
  std::istringstream    file(text);
  std::vector<SwcPoint> points;
  for (std::string line; std::getline(file, line);)
  {
    if (line[0] != '#')
    {
      SwcPoint           one;
      std::istringstream row(line);
      EXPECT_TRUE(row >> one.id >> one.type >> one.place[0] >> one.place[1] >> one.place[2] >> one.radius >> one.parent)
        << line;
      points.push_back(one);
    }
  }
  return points;
}

/** A neuron of random branches: a soma of radius 6 with lines that zigzag out of it and fork. Two of them meet
 *  again. */
SkeletonPart
RandomNeuron(std::mt19937_64 & random)
{
  const auto    within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  SkeletonPart  part;
  const Vector3 centre{ within(-50, 50), within(-50, 50), within(-50, 50) };
  const auto    add = [&](const Vector3 & place) {
    part.graph.positions.push_back(place);
    part.graph.radius.push_back(std::max(within(.5, 1), 6 - Distance(place, centre)));
    part.graph.erosionThickness.push_back(0);
    return static_cast<ElementIndex>(part.graph.positions.size() - 1);
  };
  const auto anyWay = [&] {
    std::normal_distribution<double> normal;
    const Vector3                    way{ normal(random), normal(random), normal(random) };
    return AddScaled({}, 1 / Length(way), way);
  };
  std::vector<std::vector<ElementIndex>> lines;
  const ElementIndex                     soma = add(centre);
  std::vector<ElementIndex>              ends;
  const auto                             grow = [&](ElementIndex from, const Vector3 & way, int steps) {
    lines.push_back({ from });
    for (int i = 0; i < steps; ++i)
    {
      const Vector3 last = part.graph.positions[lines.back().back()];
      lines.back().push_back(add(AddScaled(AddScaled(last, .8, way), .3, anyWay())));
    }
    return lines.back().back();
  };
  for (int branch = 0; branch < 5; ++branch)
  {
    const Vector3      way = anyWay();
    const ElementIndex fork = grow(soma, way, 14);
    ends.push_back(grow(fork, AddScaled(AddScaled({}, .7, way), .7, anyWay()), 10));
    ends.push_back(grow(fork, AddScaled(AddScaled({}, .7, way), .7, anyWay()), 10));
  }
  lines.push_back({ ends[0], ends[3] }); // a cycle through the soma
  SortBranches(part.graph, lines, true);
  part.label = 1;
  part.table = MeasureBranches(part.graph);
  return part;
}

TEST(SkeletonModel, SwcWithASomaIsOneTreeThatBeginsAtIt)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64       random(seed);
  const TemporaryFolder folder;
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    SkeletonModel model;
    model.provenance = "{}";
    model.parts = { RandomNeuron(random) };
    const Vector3 centre = model.parts[0].graph.positions[0];
    SomaChoice    choice;
    if (repeat % 2 == 0)
    {
      choice.place = AddScaled(centre, 2.5, { 0, 1, 0 });
    }
    WriteSwc(folder / "n.swc", model, {}, choice);
    const auto points = SwcPoints(ReadAll(folder / "n.swc"));
    ASSERT_GT(points.size(), 50U);
    EXPECT_EQ(points[0].type, 1);
    EXPECT_EQ(points[0].parent, -1);
    EXPECT_NEAR(Distance(points[0].place, AddScaled({}, 1000, centre)), 0, .01);
    EXPECT_NEAR(points[0].radius, 6000, .01);
    std::size_t stems = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      EXPECT_EQ(points[i].id, static_cast<long>(i + 1));
      EXPECT_GE(points[i].parent, 1) << "one tree";
      EXPECT_LT(points[i].parent, points[i].id) << "parents first";
      EXPECT_EQ(points[i].type, 3);
      const double away = Distance(points[i].place, points[0].place);
      EXPECT_GT(away, 5999.9) << "nothing inside";
      if (points[i].parent == 1)
      {
        EXPECT_NEAR(away, 6000, .1);
        ++stems;
      }
    }
    EXPECT_GE(stems, 5U);
    EXPECT_NE(ReadAll(folder / "n.swc").find("# a cycle was cut"), std::string::npos);
  }
}

TEST(SkeletonModel, SwcTypesFollowTheNamesOfLabelsAroundASoma)
{
  SkeletonModel model;
  model.provenance = "{}";
  SkeletonPart part;
  for (int i = 0; i < 9; ++i)
  {
    part.graph.positions.push_back({ 3. * i, 0, 0 });
    part.graph.radius.push_back(i == 3 ? 4 : 1);
    part.graph.erosionThickness.push_back(0);
    part.graph.labels.push_back(i < 3 ? 7 : i < 6 ? 8 : 9);
    part.graph.contact.push_back(i == 3 || i == 6 ? 1 : 0);
  }
  part.network.emplace();
  part.network->labels = { { 7, "Axon 1", 0, 0 }, { 8, "soma", 0, 0 }, { 9, "basal dendrite", 0, 0 } };
  SortBranches(part.graph, { { 0, 1, 2, 3 }, { 3, 4, 5, 6 }, { 6, 7, 8 } }, false);
  part.table = MeasureBranches(part.graph);
  model.parts = { part };
  const TemporaryFolder folder;
  WriteSwc(folder / "n.swc", model, {}, SomaChoice());
  std::map<double, long> types;
  for (const SwcPoint & point : SwcPoints(ReadAll(folder / "n.swc")))
  {
    types[std::round(point.place[0] / 1000)] = point.type;
  }
  EXPECT_EQ(types.at(9), 1);
  EXPECT_EQ(types.at(0), 2);
  EXPECT_EQ(types.at(3), 2);
  EXPECT_EQ(types.at(15), 6) << "another label keeps its place in the list";
  EXPECT_EQ(types.at(24), 3);
}

TEST(SkeletonModel, SwcIsAForestInMicrometresOrVoxels)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  for (const auto unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    model.unit = unit;
    const double scale = unit == SpatialUnit::Voxels ? 1 : 1000;
    WriteSwc(folder / "a.swc", model, {});
    std::istringstream file(ReadAll(folder / "a.swc"));
    std::string        line;
    std::string        header;
    long               count = 0;
    int                roots = 0;
    std::size_t        known = 0;
    while (std::getline(file, line))
    {
      if (line[0] == '#')
      {
        header += line + "\n";
        continue;
      }
      std::istringstream    row(line);
      long                  id = 0;
      long                  type = 0;
      long                  parent = 0;
      std::array<double, 3> place{};
      double                radius = 0;
      ASSERT_TRUE(row >> id >> type >> place[0] >> place[1] >> place[2] >> radius >> parent) << line;
      EXPECT_EQ(id, ++count);
      EXPECT_TRUE(parent == -1 || (parent >= 1 && parent < id)) << line;
      roots += parent == -1 ? 1 : 0;
      for (const SkeletonPart & part : model.parts)
      {
        for (std::size_t point = 0; point < part.graph.positions.size(); ++point)
        {
          const auto & p = part.graph.positions[point];
          known += std::abs(scale * p[0] - place[0]) < 1e-5 * scale &&
                       std::abs(scale * p[1] - place[1]) < 1e-5 * scale &&
                       std::abs(scale * p[2] - place[2]) < 1e-5 * scale &&
                       std::abs(scale * part.graph.radius[point] - radius) < 1e-5 * scale
                     ? 1
                     : 0;
        }
      }
    }
    // The ring's 6 points and one of them twice, where it is cut; the point by itself; the curve's 3.
    EXPECT_EQ(count, 7 + 1 + 3);
    EXPECT_EQ(known, static_cast<std::size_t>(count));
    EXPECT_EQ(roots, 3);
    EXPECT_NE(header.find("a cycle was cut at"), std::string::npos);
    EXPECT_NE(header.find(unit == SpatialUnit::Voxels ? "# voxels" : "# micrometres"), std::string::npos);
  }
}

TEST(SkeletonModel, MarkupsHoldACurveForEachBranch)
{
  const TemporaryFolder folder;
  const SkeletonModel   model = Mixed();
  WriteMarkups(folder / "a.mrk.json", model);
  const Json  curves = Json::parse(ReadAll(folder / "a.mrk.json")).at("markups");
  std::size_t at = 0;
  for (const SkeletonPart & part : model.parts)
  {
    for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch, ++at)
    {
      const Json & curve = curves.at(at);
      EXPECT_EQ(curve.at("coordinateSystem"), "LPS");
      EXPECT_EQ(curve.at("coordinateUnits"), "mm");
      const auto points = part.graph.Branch(branch);
      ASSERT_EQ(curve.at("controlPoints").size(), points.size());
      const Json & radii = curve.at("measurements").at(0).at("controlPointValues");
      ASSERT_EQ(radii.size(), points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        EXPECT_NEAR(radii.at(i).get<double>(), part.graph.radius[points[i]], 1e-8);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          EXPECT_NEAR(curve.at("controlPoints").at(i).at("position").at(axis).get<double>(),
                      part.graph.positions[points[i]][axis],
                      1e-6);
        }
      }
    }
  }
  EXPECT_EQ(curves.size(), at);
}

TEST(SkeletonModel, GraphMlHasANodeForEachNodeAndAnEdgeForEachBranch)
{
  const TemporaryFolder folder;
  const SkeletonModel   model = Mixed();
  WriteGraphMl(folder / "a.graphml", model);
  const std::string text = ReadAll(folder / "a.graphml");
  const auto        count = [&](const std::string & what) {
    std::size_t found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    {
      ++found;
    }
    return found;
  };
  std::size_t nodes = 0;
  std::size_t branches = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    const SkeletonGraph & graph = model.parts[p].graph;
    nodes += graph.nodePoints.size();
    branches += graph.BranchCount();
    for (const auto & ends : graph.branchNodes)
    {
      const std::string stem = "p" + std::to_string(p) + "n";
      EXPECT_GE(count("source=\"" + stem + std::to_string(ends[0]) + "\" target=\"" + stem + std::to_string(ends[1])),
                1U);
    }
  }
  EXPECT_EQ(count("<node id="), nodes);
  EXPECT_EQ(count("<edge source="), branches);
  EXPECT_EQ(count("<data key=\"kind\">isolated</data>"), 1U);
  EXPECT_EQ(count("<data key=\"kind\">surface</data>"), 1U);
}

/** The fields of a row, quotes taken off. */
std::vector<std::string>
Fields(const std::string & row)
{
  std::vector<std::string> fields(1);
  bool                     quoted = false;
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    if (row[i] == '"')
    {
      const bool isTwice = quoted && i + 1 < row.size() && row[i + 1] == '"';
      if (isTwice)
      {
        fields.back() += row[++i];
      }
      else
      {
        quoted = !quoted;
      }
    }
    else if (row[i] == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += row[i];
    }
  }
  return fields;
}

TEST(SkeletonModel, TablesHaveTheColumnsThatAreExplained)
{
  const TemporaryFolder folder;
  SkeletonModel         model = Mixed();
  for (const auto unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    model.unit = unit;
    WriteBranchCsv(folder / "branches.csv", model);
    WriteSummaryCsv(folder / "summary.csv", model);
    const std::string text = SkeletonColumnsJson(unit);
    const Json        explained = Json::parse(text);
    EXPECT_EQ(text.find("\"mm") != std::string::npos, unit == SpatialUnit::Millimetres);
    for (const char * table : { "branches", "summary" })
    {
      std::istringstream       file(ReadAll(folder / (std::string(table) + ".csv")));
      std::string              row;
      std::vector<std::string> keys;
      for (const auto & [key, value] : explained.at(table).items())
      {
        keys.push_back(key);
      }
      std::getline(file, row);
      EXPECT_EQ(Fields(row), keys) << table;
      std::size_t rows = 0;
      while (std::getline(file, row))
      {
        const auto fields = Fields(row);
        ASSERT_EQ(fields.size(), keys.size()) << row;
        EXPECT_EQ(fields[0], rows < 2 ? "3" : fields[0]) << row;
        if (fields[0] == "3")
        {
          EXPECT_EQ(fields[1], "a, \"b\"") << "the name comes back";
        }
        ++rows;
      }
      if (std::string(table) == "branches")
      {
        EXPECT_EQ(rows, model.parts[0].graph.BranchCount() + model.parts[1].graph.BranchCount());
      }
    }
  }
}

TEST(SkeletonModel, FieldsAreQuotedWhereTheyHaveToBe)
{
  EXPECT_EQ(CsvField("plain text"), "plain text");
  EXPECT_EQ(CsvField(""), "");
  for (const char * text : { "a,b", "a\"b", "\"", "a\nb", ",,", "\"a\"" })
  {
    const std::string field = CsvField(text);
    EXPECT_EQ(field.front(), '"') << text;
    EXPECT_EQ(Fields(field), (std::vector<std::string>{ text }));
  }
}

TEST(SkeletonModel, NamesThatASpreadsheetWouldComputeAreText)
{
  for (const std::string text : { "=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "=HYPERLINK(\"http://a\",\"b\")" })
  {
    EXPECT_EQ(Fields(CsvField(text)), (std::vector<std::string>{ "'" + text }));
  }
}

TEST(SkeletonModel, EqualModelsGiveEqualBytesAndWhatCannotBeWrittenLeavesNothing)
{
  const TemporaryFolder folder;
  const auto            write = [&](const std::string & stem, const SkeletonModel & model) {
    WriteSkeletonVtp(folder / (stem + ".vtp"), model);
    WriteSwc(folder / (stem + ".swc"), model, {});
    WriteMarkups(folder / (stem + ".mrk.json"), model);
    WriteGraphMl(folder / (stem + ".graphml"), model);
    WriteBranchCsv(folder / (stem + ".branches.csv"), model);
    WriteSummaryCsv(folder / (stem + ".summary.csv"), model);
  };
  write("a", Mixed());
  write("b", Mixed());
  for (const char * ending : { ".vtp", ".swc", ".mrk.json", ".graphml", ".branches.csv", ".summary.csv" })
  {
    EXPECT_FALSE(ReadAll(folder / (std::string("a") + ending)).empty());
    EXPECT_EQ(ReadAll(folder / (std::string("a") + ending)), ReadAll(folder / (std::string("b") + ending))) << ending;
  }
  const SkeletonModel         model = Mixed();
  const std::filesystem::path nowhere = folder / "nowhere";
  EXPECT_THROW(WriteSkeletonVtp(nowhere / "a.vtp", model), OutputError);
  EXPECT_THROW(WriteSwc(nowhere / "a.swc", model, {}), OutputError);
  EXPECT_THROW(WriteMarkups(nowhere / "a.mrk.json", model), OutputError);
  EXPECT_THROW(WriteGraphMl(nowhere / "a.graphml", model), OutputError);
  EXPECT_THROW(WriteBranchCsv(nowhere / "a.csv", model), OutputError);
  EXPECT_THROW(WriteSummaryCsv(nowhere / "a.csv", model), OutputError);
  EXPECT_FALSE(std::filesystem::exists(nowhere));
}

} // namespace
} // namespace voxelcore::testing
