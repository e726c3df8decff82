// The program on files that VTK saved again: the same results, or a line that says what was lost.

#include "Models/Models/ModelFixtures.h"
#include "Models/Models/VtkMeshForms.h"

#include <gtest/gtest.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdlib>
#include <sys/wait.h>

namespace voxelcore::testing
{
namespace
{

class SavedAgainCommands : public ::testing::Test
{
protected:
  /** Runs the program; arguments that name files here are given as "@name". Its exit code; stderr is kept. */
  int
  Run(const std::string & arguments)
  {
    std::string command = std::string("'") + VOXELCORE_PROGRAM + "' ";
    for (const char c : arguments)
    {
      command += c == '@' ? (m_Folder / "").string() : std::string(1, c);
    }
    const int status = std::system((command + (arguments.starts_with("verify") ? " -q" : " --progress none --force") +
                                    " > /dev/null 2> '" + (m_Folder / "error.txt").string() + "'")
                                     .c_str());
    m_Error = ReadAll(m_Folder / "error.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::map<std::string, std::string>
  SavedAgain(const std::string & name, bool single = false, const char * lost = "")
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((m_Folder / name).c_str());
    reader->Update();
    vtkPolyData & data = *reader->GetOutput();
    if (single)
    {
      vtkNew<vtkPoints> points;
      points->SetDataTypeToFloat();
      points->DeepCopy(data.GetPoints());
      data.SetPoints(points);
    }
    data.GetFieldData()->RemoveArray(lost);
    auto forms = XmlFormsOf(data);
    forms.merge(LegacyFormsOf(data));
    return forms;
  }

  std::string
  Bytes(const std::string & name) const
  {
    return ReadAll(m_Folder / name);
  }

  TemporaryFolder m_Folder;
  std::string     m_Error;
};

const std::vector<std::string> kForms{ "ascii-32.vtp",
                                       "base64vtkZLibDataCompressor-32.vtp",
                                       "raw-64.vtp",
                                       "binary-42.vtk",
                                       "binary-51.vtk" };

TEST_F(SavedAgainCommands, GiveTheSameResults)
{
  ASSERT_EQ(Run("phantom torus --size 20 --spacing 0.5,0.5,1 -o @scan.mha"), 0);
  ASSERT_EQ(Run("core @scan.mha --lambda 0 --keep-edges -o @core.vtp --with-skeleton"), 0);
  const std::vector<std::array<std::string, 2>> jobs{ { "skeleton @CORE -o @", "out.vtp" },
                                                      { "prune @CORE --lambda 1mm -o @", "out.vtp" },
                                                      { "sheets @CORE -o @", "out.vtp" },
                                                      { "reconstruct @CORE -o @", "out.nrrd" },
                                                      { "measure @SKEL -o @", "out.csv" } };
  const auto run = [&](const std::string & job, const std::string & core, const std::string & skeleton) {
    std::string text = job;
    for (const auto & [word, name] : { std::pair(std::string("CORE"), core), std::pair(std::string("SKEL"), skeleton) })
    {
      const std::size_t at = text.find(word);
      at != std::string::npos ? text.replace(at, 4, name) : text;
    }
    return Run(text);
  };
  const auto cores = SavedAgain("core.vtp");
  const auto skeletons = SavedAgain("core_skeleton.vtp");
  for (const auto & [job, output] : jobs)
  {
    ASSERT_EQ(run(job + output, "core.vtp", "core_skeleton.vtp"), 0) << job << m_Error;
    const std::string result = output == "out.csv" ? "out_branches.csv" : output;
    const std::string expected = Bytes(result);
    for (const std::string & form : kForms)
    {
      WriteAll(m_Folder / ("core-" + form), cores.at(form));
      WriteAll(m_Folder / ("skel-" + form), skeletons.at(form));
      ASSERT_EQ(run(job + output, "core-" + form, "skel-" + form), 0) << job << form << m_Error;
      EXPECT_EQ(m_Error, "") << job << form;
      EXPECT_TRUE(Bytes(result) == expected) << job << form;
    }
  }
  for (const std::string & form : kForms)
  {
    EXPECT_EQ(Run("verify @scan.mha @core-" + form), 0) << form << m_Error;
  }
}

TEST_F(SavedAgainCommands, SayWhatWasLost)
{
  ASSERT_EQ(Run("phantom torus --size 20 -o @scan.mha"), 0);
  ASSERT_EQ(Run("core @scan.mha --lambda 0 --keep-edges -o @core.vtp --with-skeleton"), 0);
  const auto expectLine = [&](const std::string & words) {
    EXPECT_NE(m_Error.find(words), std::string::npos) << m_Error;
    EXPECT_EQ(std::count(m_Error.begin(), m_Error.end(), '\n'), 1) << m_Error;
  };
  for (const std::string & form : kForms)
  {
    WriteAll(m_Folder / ("a-" + form), SavedAgain("core.vtp", true).at(form));
    WriteAll(m_Folder / ("s-" + form), SavedAgain("core_skeleton.vtp", true).at(form));
    EXPECT_EQ(Run("skeleton @a-" + form + " -o @out.vtp"), 0) << m_Error;
    expectLine("its points are in single precision");
    EXPECT_EQ(Run("measure @s-" + form + " -o @out.csv"), 0) << m_Error;
    expectLine("its points are in single precision");
    EXPECT_EQ(Run("prune @a-" + form + " --lambda 1mm -o @out.vtp"), 3);
    expectLine("every digit is needed");
    EXPECT_EQ(Run("verify @scan.mha @a-" + form), 3);
    expectLine("every digit is needed");
    WriteAll(m_Folder / ("a-" + form), SavedAgain("core.vtp", false, "Provenance").at(form));
    EXPECT_EQ(Run("skeleton @a-" + form + " -o @out.vtp"), 3);
    expectLine("its field Provenance");
    WriteAll(m_Folder / ("a-" + form), SavedAgain("core.vtp", false, "Units").at(form));
    EXPECT_EQ(Run("skeleton @a-" + form + " -o @out.vtp"), 3);
    expectLine("FieldData/Units is missing");
  }
}

TEST_F(SavedAgainCommands, PicturesShowWhatOtherProgramsSaved)
{
  ASSERT_EQ(Run("phantom torus --size 20 -o @scan.mha"), 0);
  ASSERT_EQ(Run("core @scan.mha -o @core.vtp --with-skeleton"), 0);
  ASSERT_EQ(Run("core @scan.mha --lambda 0 -o @core.ply"), 0);
  const int code = Run("render @core.vtp @core_skeleton.vtp -o @expected.png --size 200x200");
  if (code == 2 && m_Error.find("render is off") != std::string::npos)
  {
    GTEST_SKIP() << m_Error;
  }
  ASSERT_EQ(code, 0) << m_Error;
  for (const std::string & form : kForms)
  {
    WriteAll(m_Folder / ("core-" + form), SavedAgain("core.vtp").at(form));
    WriteAll(m_Folder / ("skel-" + form), SavedAgain("core_skeleton.vtp").at(form));
    EXPECT_EQ(Run("render @core-" + form + " @skel-" + form + " -o @a.png --size 200x200"), 0) << m_Error;
    EXPECT_TRUE(Bytes("a.png") == Bytes("expected.png")) << form;
    WriteAll(m_Folder / ("plain-" + form), SavedAgain("core.vtp", true, "Provenance").at(form));
    EXPECT_EQ(Run("render @plain-" + form + " -o @plain.png --size 200x200"), 0) << m_Error;
    EXPECT_GT(Bytes("plain.png").size(), 2000U);
  }
  EXPECT_EQ(Run("render @core.ply -o @ply.png --size 200x200"), 0) << m_Error;
  EXPECT_EQ(Run("render @core.ply --color Lambda -o @ply.png --size 200x200"), 2);
  EXPECT_EQ(Run("render @core.ply --scan @scan.mha -o @ply.png --size 200x200"), 2);
}

} // namespace
} // namespace voxelcore::testing
