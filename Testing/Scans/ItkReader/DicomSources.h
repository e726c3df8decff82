#pragma once
// DICOM files with changed elements, opened as the helper program opens them, but in this process.

#include "ForeignBytes.h"
#include "ScanBytes.h"
#include "ScanSource.h"
#include "VoxelCoreTesting/Messages.h"

namespace voxelcore::testing::dicom
{

inline std::string
Short(int value)
{
  return Raw<std::uint16_t>(static_cast<std::uint16_t>(value));
}

/** A change of one element: an empty `vr` takes it out. */
struct Change
{
  std::uint16_t group;
  std::uint16_t element;
  const char *  vr;
  std::string   value{};
};

inline std::string
With(std::string file, const std::vector<Change> & changes)
{
  for (const Change & one : changes)
  {
    const std::string vr = one.vr;
    file = WithDicomElement(file,
                            one.group,
                            one.element,
                            vr.empty() ? "" : DicomElement(one.group, one.element, one.vr, one.value));
  }
  return file;
}

/** Bytes of the voxels of one volume. */
inline std::string
Sent(itkreader::ScanSource & source, std::uint64_t volume = 0, std::uint64_t component = 0)
{
  std::string bytes;
  source.Send(volume, component, [&](const char * more, std::size_t count) { bytes.append(more, count); });
  return bytes;
}

/** It is refused in one line that holds the text. */
inline void
ExpectRefusedBy(const std::filesystem::path & path, const std::string & text)
{
  const std::string message = MessageOf([&] {
    const auto source = itkreader::OpenDicom(path);
    Sent(*source);
  });
  EXPECT_NE(message.find(text), std::string::npos) << "'" << text << "' in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

} // namespace voxelcore::testing::dicom
