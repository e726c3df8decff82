// The helper program's work on damaged files, in a process each: 10,000 of a format would take hours with the program
// itself, which loads ITK's libraries anew for each.

#include "ForeignBytes.h"
#include "RunReader.h"
#include "ScanBytes.h"
#include "voxelcore/ItkReader/ItkProcess.h"

#include <itkHDF5ImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkMINCImageIO.h>

#include <array>
#include <chrono>
#include <fcntl.h>
#include <iostream>
#include <random>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

struct Ended
{
  int         status = 0;
  double      seconds = 0; ///< of the processor
  long        megabytes = 0;
  std::string refusal;
};

/** The helper's work in a child, voxels thrown away. */
Ended
RunOn(const std::string & format, const std::filesystem::path & path)
{
  std::array<int, 2> orders{};
  std::array<int, 2> refusal{};
  if (pipe2(orders.data(), O_CLOEXEC) != 0 || pipe2(refusal.data(), O_CLOEXEC) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    dup2(orders[0], STDIN_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    dup2(refusal[1], STDERR_FILENO);
    std::string           word = format;
    std::string           file = path.string();
    std::array<char *, 3> words{ word.data(), word.data(), file.data() };
    _exit(itkreader::RunReader(3, words.data()));
  }
  static_cast<void>(!write(orders[1], "0 0\n", 4)); // while this end is open, a child that has ended is no SIGPIPE
  close(orders[0]);
  close(orders[1]);
  close(refusal[1]);
  Ended                  ended;
  std::array<char, 4096> text{};
  for (::ssize_t got = 1; got > 0;)
  {
    got = read(refusal[0], text.data(), text.size());
    ended.refusal.append(text.data(), static_cast<std::size_t>(std::max<::ssize_t>(0, got)));
  }
  close(refusal[0]);
  rusage usage{};
  wait4(child, &ended.status, 0, &usage);
  ended.seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                  1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  ended.megabytes = usage.ru_maxrss / 1024;
  return ended;
}

/** What ITK itself writes. */
template <typename TImageIO>
std::string
WrittenByItk(const TempFolder & folder, const std::string & name)
{
  using Image = itk::Image<unsigned char, 3>;
  {
    auto image = Image::New();
    image->SetRegions(Image::SizeType{ { 6, 5, 4 } });
    image->Allocate();
    const auto values = ForeignValues();
    std::copy(values.begin(), values.end(), image->GetBufferPointer());
    auto writer = itk::ImageFileWriter<Image>::New();
    writer->SetImageIO(TImageIO::New());
    writer->SetFileName((folder / name).string());
    writer->SetInput(image);
    writer->Update();
  } // which closes the file
  return ReadAll(folder / name);
}

/** Where temporary files go as long as this object lives. */
class ScopedTemporaryFolder
{
public:
  explicit ScopedTemporaryFolder(const std::filesystem::path & folder)
    : m_Former(std::filesystem::temp_directory_path().string())
  {
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ScopedTemporaryFolder(const ScopedTemporaryFolder &) = delete;
  ScopedTemporaryFolder &
  operator=(const ScopedTemporaryFolder &) = delete;
  ~ScopedTemporaryFolder()
  {
    setenv("TMPDIR", m_Former.c_str(), 1);
  }

private:
  std::string m_Former;
};

struct Seed
{
  std::string format;
  std::string name;
  std::string bytes;
};

void
Damage(int countOfEach)
{
  const TempFolder folder;
  const unsigned   seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  ::testing::Test::RecordProperty("seed", std::to_string(seed));
  std::mt19937 random(seed);
  for (const auto & [name, bytes] : DicomSeriesBytes())
  {
    folder.Write("series/" + name, bytes);
  }
  const std::vector<Seed> seeds{
    { "mrc", "a.mrc", MrcBytes() },
    { "gipl", "a.gipl", GiplBytes() },
    { "gipl", "a.gipl.gz", Gzip(GiplBytes()) },
    { "vtk", "a.vtk", VtkBytes(false) },
    { "vtk", "b.vtk", VtkBytes(true) },
    { "dicom", "a.dcm", DicomSegmentationBytes() },
    { "dicom", "series/IM2", DicomSeriesBytes().at("IM2") },
    { "hdf5", "a.h5", WrittenByItk<itk::HDF5ImageIO>(folder, "a.h5") },
    { "minc", "a.mnc", WrittenByItk<itk::MINCImageIO>(folder, "a.mnc") },
  };
  for (const Seed & one : seeds)
  {
    const Ended whole = RunOn(one.format, folder.Write(one.name, one.bytes));
    ASSERT_EQ(whole.status, 0) << one.name << ": " << whole.refusal;
    int    read = 0;
    int    refused = 0;
    int    crashed = 0;
    int    slow = 0;
    double longest = 0;
    long   largest = 0;
    for (int n = 0; n < countOfEach; ++n)
    {
      std::string bytes = one.bytes;
      for (std::size_t changes = 1 + (n % 4 == 0 ? random() % 4 : 0); changes > 0; --changes)
      {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
      if (n % 16 == 0)
      {
        bytes.resize(random() % bytes.size() + 1);
      }
      const Ended ended = RunOn(one.format, folder.Write(one.name, bytes));
      const bool  exited = WIFEXITED(ended.status);
      read += exited && WEXITSTATUS(ended.status) == 0 ? 1 : 0;
      refused += exited && WEXITSTATUS(ended.status) == 3 ? 1 : 0;
      slow += WIFSIGNALED(ended.status) && WTERMSIG(ended.status) == SIGXCPU ? 1 : 0;
      crashed += WIFSIGNALED(ended.status) && WTERMSIG(ended.status) != SIGXCPU ? 1 : 0;
      if (WIFSIGNALED(ended.status) && std::getenv("VOXELCORE_KEEP_DAMAGED") != nullptr)
      {
        const std::filesystem::path kept = std::getenv("VOXELCORE_KEEP_DAMAGED");
        const std::string           name = std::filesystem::path(one.name).filename().string();
        std::filesystem::copy_file(
          folder / one.name,
          kept / ("signal" + std::to_string(WTERMSIG(ended.status)) + "-" + std::to_string(n) + "-" + name),
          std::filesystem::copy_options::overwrite_existing);
      }
      longest = std::max(longest, ended.seconds);
      largest = std::max(largest, ended.megabytes);
      if (exited && WEXITSTATUS(ended.status) != 0)
      {
        EXPECT_EQ(WEXITSTATUS(ended.status), 3);
        EXPECT_EQ(ended.refusal.find('\n'), std::string::npos) << ended.refusal;
        EXPECT_NE(ended.refusal.find(folder.Path().string()), std::string::npos) << ended.refusal;
      }
    }
    std::cout << one.name << ": " << read << " read, " << refused << " refused, " << crashed << " crashed the helper, "
              << slow << " stopped by its time limit; at most " << longest << " s and " << largest << " MB"
              << std::endl;
    folder.Write(one.name, one.bytes);
    EXPECT_EQ(read + refused + crashed + slow, countOfEach);
    EXPECT_GT(refused, 0);
    EXPECT_LT(longest, 10);
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(largest - whole.megabytes, 300) << one.name;
#endif
  }
}

} // namespace

TEST(ItkReader, DamagedFilesTakeNoMoreThanTheirDue)
{
  Damage(20);
}

TEST(ItkReader, LibrariesLeaveNoTemporaryFilesBehind)
{
  const TempFolder  folder;
  const auto        temporary = folder / "temporary";
  const std::string bytes = WrittenByItk<itk::MINCImageIO>(folder, "a.mnc");
  const auto        path = folder / "a.mnc";
  std::filesystem::create_directory(temporary);
  const ScopedTemporaryFolder scope(temporary);
  ASSERT_EQ(RunOn("minc", path).status, 0);
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
  int refused = 0;
  for (std::size_t length = 100; length < bytes.size(); length += bytes.size() / 10)
  {
    folder.Write("a.mnc", bytes.substr(0, length));
    refused += RunOn("minc", path).status != 0 ? 1 : 0;
    EXPECT_TRUE(std::filesystem::is_empty(temporary)) << "cut off after " << length << " bytes";
  }
  EXPECT_GT(refused, 0);
  folder.Write("a.mnc", bytes);
  OpenByItk(path, ItkFormat::Minc, {}); // kills its process, and does not wait for what is removed then
  for (int looks = 0; looks < 1000 && !std::filesystem::is_empty(temporary); ++looks)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
}

TEST(HeavyItkReader, TenThousandDamagedFilesOfEachFormatTakeNoMoreThanTheirDue)
{
  Damage(10000);
}
