// Damaged files of formats that are read through ITK and GDCM: whatever happens to the helper, this program gets a
// volume or a refusal of one line. What happens inside the helper, ItkReaderGTest.cxx looks at.

#include "ForeignBytes.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/ProcessUse.h"

#include <iostream>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

void
ReadMutations(int countOfEach)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::mt19937                       random(seed);
  std::map<std::string, std::string> seeds{ { "a.mrc", MrcBytes() },
                                            { "a.gipl", GiplBytes() },
                                            { "a.vtk", VtkBytes(false) },
                                            { "b.vtk", VtkBytes(true) },
                                            { "a.dcm", DicomSegmentationBytes() } };
  int                                refused = 0;
  int                                read = 0;
  for (const auto & [name, original] : seeds)
  {
    for (int n = 0; n < countOfEach; ++n)
    {
      std::string bytes = original;
      bytes[random() % bytes.size()] = static_cast<char>(random());
      if (n % 8 == 0)
      {
        bytes.resize(random() % bytes.size() + 1);
      }
      const auto   path = folder.Write(name, bytes);
      const double begin = ProcessorSeconds();
      try
      {
        ReadLabelVolume(path);
        ++read;
      }
      catch (const InputError & error)
      {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      }
      ASSERT_LT(ProcessorSeconds() - begin, 10.0) << name << " change " << n;
    }
  }
  std::cout << read << " read, " << refused << " refused\n";
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

} // namespace

TEST(DamagedForeign, FilesEndInAVolumeOrARefusal)
{
  ReadMutations(5);
}

TEST(HeavyDamagedForeign, FilesEndInAVolumeOrARefusal)
{
  ReadMutations(300);
}
