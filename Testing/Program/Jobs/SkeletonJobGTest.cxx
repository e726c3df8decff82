#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Options/Requests.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <omp.h>
#include <sstream>

namespace voxelcore::testing
{

namespace
{

using Json = nlohmann::ordered_json;

std::string
Bytes(const std::filesystem::path & path)
{
  const std::string bytes = ReadAll(path);
  EXPECT_FALSE(bytes.empty()) << path;
  return bytes;
}

/** The numbers of each label in a report. */
Json
Labels(const std::filesystem::path & report)
{
  return Json::parse(ReadAll(report)).at("labels");
}

class SkeletonJob : public ::testing::Test
{
protected:
  std::filesystem::path
  At(const std::string & name) const
  {
    return m_Folder.Path() / name;
  }

  void
  MakePhantom(const std::string & kind, const std::string & name) const
  {
    RunPhantomJob(PhantomOptionsFrom({ { "kind", kind }, { "size", "48" }, { "output", At(name).string() } }));
  }

  SkeletonResult
  Skeleton(const std::string & input, const std::string & output, ParameterValues more = {}) const
  {
    more["scan"] = At(input).string();
    more["output"] = At(output).string();
    return RunSkeletonJob(SkeletonOptionsFrom(more));
  }

  TemporaryFolder m_Folder;
};

TEST_F(SkeletonJob, ScanItsWholeCoreAndTheCoreCommandGiveTheSameBytes)
{
  MakePhantom("root", "root.nrrd");
  const ParameterValues more{ { "also", "csv,swc,mrk.json,graphml" },
                              { "root", "top" },
                              { "prune-branches", "4vox" },
                              { "stand-out", "2%" } };
  ParameterValues       asInCore = more;
  asInCore.insert({ { "border", "closed" }, { "cavities", "keep" } });
  Skeleton("root.nrrd", "a.vtp", asInCore);
  ParameterValues core = more;
  core.insert({ { "scan", At("root.nrrd").string() },
                { "lambda", "0,1.5vox" },
                { "keep-edges", "true" },
                { "with-skeleton", "true" },
                { "report", At("b.json").string() },
                { "output", At("b.vtp").string() } });
  const CoreResult both = RunCoreJob(CoreOptionsFrom(core));
  Skeleton("b_lambda-0.vtp", "c.vtp", more);
  EXPECT_GT(ReadSkeletonVtp(At("a.vtp")).parts.at(0).graph.BranchCount(), 3U);
  for (const char * ending : { ".vtp", "_branches.csv", "_summary.csv", ".swc", ".mrk.json", ".graphml" })
  {
    EXPECT_EQ(Bytes(At(std::string("a") + ending)), Bytes(At(std::string("b_skeleton") + ending))) << ending;
    EXPECT_EQ(Bytes(At(std::string("a") + ending)), Bytes(At(std::string("c") + ending))) << ending;
  }
  EXPECT_TRUE(std::filesystem::exists(At("b_lambda-1.5vox.vtp")));
  const Json certificate = Labels(At("b.json")).at(0).at("certificate");
  EXPECT_EQ(certificate.dump(), R"({"topology":true,"enclosed":true,"skeleton":true,"stand_out":true,"passed":true})");
  EXPECT_EQ(both.report.labels.at(0).skeleton->output, At("b_skeleton.vtp").string());
  // A core file says nothing of skeletons that were made beside it.
  EXPECT_EQ(ReadModel(At("b_lambda-0.vtp")).provenance.find("skeleton"), std::string::npos);
}

TEST_F(SkeletonJob, RefinedOneIsTheSameAloneAndBesideACoreAndIsMeasuredAsItIs)
{
  MakePhantom("torus", "torus.nrrd");
  const ParameterValues more{ { "refine", "labels" }, { "also", "csv" } };
  Skeleton("torus.nrrd", "a.vtp", more);
  ParameterValues core = more;
  core.insert(
    { { "scan", At("torus.nrrd").string() }, { "with-skeleton", "true" }, { "output", At("b.vtp").string() } });
  RunCoreJob(CoreOptionsFrom(core));
  EXPECT_EQ(Bytes(At("a_branches.csv")), Bytes(At("b_skeleton_branches.csv")));
  EXPECT_EQ(ReadModel(At("b.vtp")).refined, "labels");
  const SkeletonModel refined = ReadSkeletonVtp(At("a.vtp"));
  const CoreReport    made = ParseProvenance(refined.provenance, "it");
  EXPECT_TRUE(made.skeleton->refined);
  EXPECT_EQ(made.parameters.refine.surface, "labels");
  // Measured later, radii are as little shifted as at once.
  MeasureJobOptions measure;
  measure.skeleton = At("a.vtp");
  measure.output = At("c.csv");
  RunMeasureJob(measure);
  EXPECT_EQ(Bytes(At("a_branches.csv")), Bytes(At("c_branches.csv")));
  // That of the voxels has the same branches elsewhere.
  Skeleton("torus.nrrd", "d.vtp", { { "also", "csv" } });
  const SkeletonModel plain = ReadSkeletonVtp(At("d.vtp"));
  EXPECT_FALSE(ParseProvenance(plain.provenance, "it").skeleton->refined);
  EXPECT_EQ(plain.parts[0].graph.branchPoints, refined.parts[0].graph.branchPoints);
  EXPECT_NE(plain.parts[0].graph.positions, refined.parts[0].graph.positions);
}

TEST_F(SkeletonJob, OneOfARefinedCoreHasItsRadiiAndTopology)
{
  MakePhantom("torus", "torus.nrrd");
  RunCoreJob(CoreOptionsFrom(
    { { "scan", At("torus.nrrd").string() }, { "refine", "labels" }, { "output", At("core.vtp").string() } }));
  Skeleton("core.vtp", "a.vtp");
  const SkeletonModel model = ReadSkeletonVtp(At("a.vtp"));
  const CoreReport    made = ParseProvenance(model.provenance, "it");
  EXPECT_TRUE(made.skeleton->refined);
  EXPECT_EQ(made.labels.at(0).skeleton->topology, made.labels.at(0).shape);
  const std::vector<double> radii = ReadModel(At("core.vtp")).parts.at(0).core.radius;
  for (const double radius : model.parts.at(0).graph.radius)
  {
    EXPECT_NE(std::find(radii.begin(), radii.end(), radius), radii.end());
  }
  EXPECT_THROW(Skeleton("core.vtp", "b.vtp", { { "refine", "labels" } }), UsageError);
}

TEST_F(SkeletonJob, FolderHoldsAFilePerLabelAndOneTable)
{
  RunPhantomJob(PhantomOptionsFrom(
    { { "kind", "noise" }, { "size", "10" }, { "density", "0.1" }, { "output", At("noise.nrrd").string() } }));
  Skeleton("noise.nrrd", "all.vtp", { { "split-components", "true" }, { "also", "csv" } });
  const auto names = [&](int threads) {
    const int             before = omp_get_max_threads();
    const std::string     folder = "folder" + std::to_string(threads);
    std::set<std::string> found;
    omp_set_num_threads(threads);
    const SkeletonResult result =
      Skeleton("noise.nrrd",
               folder + "/",
               { { "split-components", "true" }, { "also", "csv,swc" }, { "report", At(folder + ".json").string() } });
    omp_set_num_threads(before);
    EXPECT_GT(result.report.labels.size(), 20U);
    EXPECT_EQ(Labels(At(folder + ".json")).size(), result.report.labels.size());
    EXPECT_EQ(Bytes(At(folder) / "noise_skeleton_branches.csv"), Bytes(At("all_branches.csv")));
    EXPECT_EQ(Bytes(At(folder) / "noise_skeleton_summary.csv"), Bytes(At("all_summary.csv")));
    for (const LabelRecord & label : result.report.labels)
    {
      const std::string stem = "noise_label-1_component-" + std::to_string(label.component) + "_skeleton";
      EXPECT_EQ(label.skeleton->output, At(folder + "/" + stem + ".vtp").string());
      const SkeletonModel model = ReadSkeletonVtp(label.skeleton->output);
      EXPECT_EQ(model.parts.at(0).component, label.component);
      EXPECT_EQ(ParseProvenance(model.provenance, "it").labels.size(), 1U);
      found.insert(stem + ".vtp" + Bytes(At(folder) / (stem + ".vtp")));
      found.insert(Bytes(At(folder) / (stem + ".swc")));
    }
    return found;
  };
  EXPECT_EQ(names(1), names(3));
}

TEST_F(SkeletonJob, WrittenFilesSayHowTheyWereMade)
{
  MakePhantom("torus", "torus.nrrd");
  Skeleton("torus.nrrd",
           "a.vtp",
           { { "root", "1.5,-2,3" },
             { "cut-loops", "true" },
             { "smooth", "0" },
             { "crop", ":,:,0:48" },
             { "prune-branches", "0.5r" } });
  const Json made = Json::parse(ReadSkeletonVtp(At("a.vtp")).provenance);
  EXPECT_EQ(
    made.at("skeleton").dump(),
    R"({"lambda":"0","stand_out":"3vox","plates":null,"smooth":"0","prune_branches":null,)"
    R"("prune_branches_radii":0.5,"cut_loops":true,"split_at_junctions":false,"root":"1.5,-2,3","border":"open"})");
  EXPECT_EQ(made.at("parameters").at("crop").dump(), "[[0,48],[0,48],[0,48]]");
  EXPECT_EQ(made.at("labels").at(0).at("skeleton").at("cuts").size(), 1U);
  EXPECT_EQ(made.at("labels").at(0).at("skeleton").at("betti").dump(), "[1,1,0]");
  EXPECT_EQ(made.at("labels").at(0).at("skeleton").at("cycles"), 0);
  EXPECT_FALSE(made.contains("command"));
  // Measured again it keeps that and adds what is new.
  RunMeasureJob(MeasureOptionsFrom(
    { { "skeleton", At("a.vtp").string() }, { "output", At("b.vtp").string() }, { "prune-branches", "2%" } }));
  const Json again = Json::parse(ReadSkeletonVtp(At("b.vtp")).provenance).at("skeleton");
  EXPECT_EQ(again.at("cut_loops"), true);
  EXPECT_EQ(again.at("prune_branches"), "2%");
  EXPECT_EQ(again.at("root"), "thickest");
}

TEST_F(SkeletonJob, OptionsThatWouldDoNothingAreRefused)
{
  MakePhantom("ball", "ball.nrrd");
  const ParameterValues core{ { "scan", At("ball.nrrd").string() }, { "output", At("core.vtp").string() } };
  for (const auto & [name, value] : ParameterValues{ { "root", "top" }, { "also", "csv" }, { "cut-loops", "true" } })
  {
    ParameterValues values = core;
    values[name] = value;
    EXPECT_THROW(CoreOptionsFrom(values), UsageError) << name;
    values["with-skeleton"] = "true";
    EXPECT_NO_THROW(CoreOptionsFrom(values)) << name;
  }
  RunCoreJob(CoreOptionsFrom(core));
  for (const auto & [name, value] : ParameterValues{ { "labels", "1" },
                                                     { "lambda", "1mm" },
                                                     { "engine", "lattice" },
                                                     { "crop", ":,:,0:9" },
                                                     { "largest", "1" } })
  {
    EXPECT_THROW(Skeleton("core.vtp", "a.vtp", { { name, value } }), UsageError) << name;
  }
  EXPECT_NO_THROW(Skeleton("core.vtp", "a.vtp", { { "threads", "1" } }));
}

TEST_F(SkeletonJob, EveryColumnIsExplained)
{
  MakePhantom("root", "root.nrrd");
  Skeleton("root.nrrd", "a.vtp", { { "also", "csv" } });
  const Json explained = Json::parse(Bytes(At("a_columns.json")));
  for (const char * table : { "branches", "summary" })
  {
    std::istringstream text(Bytes(At(std::string("a_") + table + ".csv")));
    std::string        head;
    std::getline(text, head);
    std::vector<std::string> names;
    std::istringstream       columns(head);
    for (std::string name; std::getline(columns, name, ',');)
    {
      names.push_back(name);
    }
    std::vector<std::string> keys;
    for (const auto & [key, value] : explained.at(table).items())
    {
      keys.push_back(key);
    }
    EXPECT_EQ(names, keys);
    for (std::string row; std::getline(text, row);)
    {
      EXPECT_EQ(static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1, names.size()) << row;
    }
    const auto meaning = explained.at(table).at("mean_radius").at("Description").get<std::string>();
    EXPECT_NE(meaning.find(std::string(table) == "branches" ? "cross-section" : "weighted by length"),
              std::string::npos)
      << meaning;
  }
}

TEST_F(SkeletonJob, MeasuringAgainGivesTheSameTables)
{
  MakePhantom("root", "root.nrrd");
  Skeleton("root.nrrd", "a.vtp", { { "also", "csv,swc,mrk.json,graphml,ma" }, { "root", "top" } });
  RunMeasureJob(MeasureOptionsFrom(
    { { "skeleton", At("a.vtp").string() }, { "output", At("b.csv").string() }, { "root", "top" } }));
  EXPECT_EQ(Bytes(At("a_branches.csv")), Bytes(At("b_branches.csv")));
  EXPECT_EQ(Bytes(At("a_summary.csv")), Bytes(At("b_summary.csv")));
  for (const char * name : { "a.swc", "a.mrk.json", "a.graphml", "a.ma", "a.r", "a_columns.json" })
  {
    EXPECT_FALSE(Bytes(At(name)).empty()) << name;
  }
}

TEST_F(SkeletonJob, SwcIsATreeWithParentsFirst)
{
  MakePhantom("torus", "torus.nrrd");
  Skeleton("torus.nrrd", "a.vtp", { { "also", "swc" } });
  std::ifstream file(At("a.swc"));
  std::string   line;
  int           roots = 0;
  long          count = 0;
  bool          saysCut = false;
  while (std::getline(file, line))
  {
    if (line[0] == '#')
    {
      saysCut |= line.find("cut") != std::string::npos;
      continue;
    }
    std::istringstream row(line);
    long               id = 0;
    long               type = 0;
    long               parent = 0;
    double             x = 0;
    double             y = 0;
    double             z = 0;
    double             radius = 0;
    ASSERT_TRUE(row >> id >> type >> x >> y >> z >> radius >> parent) << line;
    EXPECT_EQ(id, ++count);
    EXPECT_LT(parent, id);
    roots += parent == -1;
  }
  EXPECT_EQ(roots, 1);
  EXPECT_TRUE(saysCut);
  EXPECT_GT(count, 20);
}

TEST_F(SkeletonJob, WrongInputLeavesNothing)
{
  MakePhantom("ball", "ball.nrrd");
  EXPECT_THROW(Skeleton("ball.nrrd", "a.stl"), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "also", "xyz" } }), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "root", "1,2" } }), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "prune-branches", "-1r" } }), UsageError);
  EXPECT_THROW(Skeleton("none.nrrd", "a.vtp"), InputError);
  EXPECT_THROW(Skeleton("none.vtp", "a.vtp"), InputError);
  EXPECT_FALSE(std::filesystem::exists(At("a.vtp")));
  Skeleton("ball.nrrd", "a.vtp");
  EXPECT_THROW(Skeleton("a.vtp", "b.vtp"), InputError); // a skeleton is no core
  EXPECT_THROW(
    RunMeasureJob(MeasureOptionsFrom({ { "skeleton", At("ball.nrrd").string() }, { "output", At("b.csv").string() } })),
    InputError);
}

TEST_F(SkeletonJob, CoreWhoseCellsAreNotWhatItsProvenanceSaysIsRefused)
{
  MakePhantom("ball", "ball.nrrd");
  RunCoreJob(CoreOptionsFrom(
    { { "scan", At("ball.nrrd").string() }, { "lambda", "1.5vox" }, { "output", At("core.vtp").string() } }));
  EXPECT_NO_THROW(Skeleton("core.vtp", "a.vtp"));
  // A point from elsewhere has come in: a component more.
  MedialModel     model = ReadModel(At("core.vtp"));
  MedialComplex & core = model.parts.at(0).core;
  core.positions.push_back(core.positions.at(0));
  core.radius.push_back(core.radius.at(0));
  core.vertexLambda.push_back(core.vertexLambda.at(0));
  ++core.cells.vertexCount;
  WriteModel(At("other.vtp"), At("other.vtp"), model);
  try
  {
    Skeleton("other.vtp", "b.vtp");
    FAIL() << "no refusal";
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("does not fit its cells"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(At("b.vtp")));
}

TEST_F(SkeletonJob, RootsHaveTrueCentreLines)
{
  RunPhantomJob(PhantomOptionsFrom({ { "kind", "root" },
                                     { "size", "48" },
                                     { "output", At("root.nrrd").string() },
                                     { "centre-lines", At("root.swc").string() } }));
  EXPECT_NE(Bytes(At("root.swc")).find("\n1 0 "), std::string::npos);
  EXPECT_THROW(
    RunPhantomJob(PhantomOptionsFrom(
      { { "kind", "ball" }, { "output", At("ball.nrrd").string() }, { "centre-lines", At("ball.swc").string() } })),
    UsageError);
}

} // namespace

} // namespace voxelcore::testing
