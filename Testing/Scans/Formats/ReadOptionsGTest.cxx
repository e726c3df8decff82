// What a caller says of a scan: it holds for every format, or is refused where it has no sense.

#include "voxelcore/Formats/ReadOptions.h"
#include "NrrdFixtures.h"

#include <functional>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

class ReadOptionsOf : public ::testing::Test
{
protected:
  void
  Reads(const std::filesystem::path & path, const std::function<void(ReadOptions &)> & set) const
  {
    ReadOptions options;
    set(options);
    ReadLabelVolume(path, options);
  }

  const TempFolder            m_Folder;
  const std::filesystem::path m_Nrrd =
    m_Folder.Write("a.nrrd", Nrrd(nrrd::Lines(), RawAll<std::uint8_t>(nrrd::kValues)));
  const std::filesystem::path m_Nifti =
    m_Folder.Write("a.nii", Nifti({ .dim = { 3, 2, 2 } }, RawAll<std::uint8_t>(nrrd::kValues)));
};

} // namespace

TEST_F(ReadOptionsOf, NoneReadWhatTheFileSays)
{
  for (const auto & path : { m_Nrrd, m_Nifti })
  {
    nrrd::ExpectValues(ReadLabelVolume(path));
  }
}

TEST_F(ReadOptionsOf, AScanThatLacksWhatIsAskedForIsRefused)
{
  for (const auto & path : { m_Nrrd, m_Nifti })
  {
    SCOPED_TRACE(path);
    EXPECT_THROW(Reads(path, [](ReadOptions & o) { o.volume = 1; }), InputError);
    EXPECT_THROW(Reads(path, [](ReadOptions & o) { o.volume = -1; }), InputError);
    EXPECT_THROW(Reads(path, [](ReadOptions & o) { o.component = 1; }), InputError);
    EXPECT_THROW(Reads(path, [](ReadOptions & o) { o.level = 0; }), UsageError);
    EXPECT_THROW(Reads(path, [](ReadOptions & o) { o.raw = ParseRawLayout("9,9,9,uint8"); }), InputError);
    EXPECT_NO_THROW(Reads(path, [](ReadOptions & o) { o.volume = 0; }));
    EXPECT_NO_THROW(Reads(path, [](ReadOptions & o) { o.component = 0; }));
  }
}

TEST_F(ReadOptionsOf, ANiftiFormThatIsNotThereIsRefused)
{
  EXPECT_THROW(Reads(m_Nifti, [](ReadOptions & o) { o.niftiForm = "sform"; }), InputError);
  EXPECT_THROW(Reads(m_Nifti, [](ReadOptions & o) { o.niftiForm = "qform"; }), InputError);
  const auto both = m_Folder.Write("b.nii",
                                   Nifti({ .dim = { 3, 2, 2 },
                                           .qformCode = 1,
                                           .sformCode = 1,
                                           .qoffset = { 1, 2, 3 },
                                           .srow = { 1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6 } },
                                         RawAll<std::uint8_t>(nrrd::kValues)));
  for (const auto & [form, x] : { std::pair("qform", -1.0), std::pair("sform", -4.0) }) // LPS
  {
    ReadOptions options;
    options.niftiForm = form;
    EXPECT_NEAR(ReadLabelVolume(both, options).geometry.origin[0], x, 1e-6) << form;
  }
}

TEST_F(ReadOptionsOf, ALayoutOfBareVoxelsGoesBeforeTheNameAndTheHeader)
{
  ReadOptions options;
  options.raw = ParseRawLayout("3,2,2,uint8");
  const LabelMap map = ReadLabelVolume(m_Folder.Write("bare.nrrd", RawAll<std::uint8_t>(nrrd::kValues)), options);
  EXPECT_EQ(map.format, "raw");
  nrrd::ExpectValues(map);
}
