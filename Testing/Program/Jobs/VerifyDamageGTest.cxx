// Files damaged array by array: verify must refuse each, whatever made it.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "VoxelCoreTesting/UnpackedVtp.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/PruneJob.h"
#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Options/Requests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace voxelcore::testing
{
namespace
{

/** An array of a .vtp with raw appended data: where its values are in the file. */
struct ArrayPlace
{
  std::string type;
  std::size_t begin = 0;
  std::size_t bytes = 0;
};

/** By section and name, read by plain searching. */
std::map<std::string, ArrayPlace>
ArraysOf(const std::string & file)
{
  const std::size_t                 tag = file.find("<AppendedData");
  const std::size_t                 data = file.find('_', tag) + 1;
  std::map<std::string, ArrayPlace> arrays;
  std::string                       section;
  for (std::size_t at = file.find('<'); at < tag; at = file.find('<', at + 1))
  {
    const std::string text = file.substr(at, file.find('>', at) - at);
    const auto        value = [&text](const std::string & name) {
      const std::size_t from = text.find(" " + name + "=\"") + name.size() + 3;
      return text.substr(from, text.find('"', from) - from);
    };
    if (text.starts_with("<DataArray ") || text.starts_with("<Array "))
    {
      const std::size_t offset = data + std::stoul(value("offset"));
      std::uint64_t     bytes = 0;
      std::memcpy(&bytes, file.data() + offset, sizeof bytes);
      arrays[section + "/" + value("Name")] = { value("type"), offset + sizeof bytes, bytes };
    }
    else if (text[1] != '/')
    {
      section = text.substr(1, text.find(' ') - 1);
    }
  }
  return arrays;
}

/** Changes a list of values. */
using Damage = std::function<void(std::vector<double> & values)>;

/** The file with one array changed; whole numbers are rounded. */
template <typename Value>
std::string
Changed(std::string file, const ArrayPlace & array, const Damage & damage)
{
  std::vector<Value> values(array.bytes / sizeof(Value));
  std::memcpy(values.data(), file.data() + array.begin, array.bytes);
  std::vector<double> reals(values.begin(), values.end());
  damage(reals);
  std::transform(reals.begin(), reals.end(), values.begin(), [](double real) { return static_cast<Value>(real); });
  std::memcpy(file.data() + array.begin, values.data(), array.bytes);
  return file;
}

std::string
Changed(const std::string & file, const ArrayPlace & array, const Damage & damage)
{
  return array.type == "Float64" ? Changed<double>(file, array, damage)
         : array.type == "Int64" ? Changed<std::int64_t>(file, array, damage)
         : array.type == "Int32" ? Changed<std::int32_t>(file, array, damage)
                                 : file;
}

const std::vector<std::pair<std::string, Damage>> &
Damages()
{
  static const std::vector<std::pair<std::string, Damage>> damages{
    { "tripled",
      [](auto & values) {
        for (double & value : values)
        {
          value *= 3;
        }
      } },
    { "a hundredth less",
      [](auto & values) {
        for (double & value : values)
        {
          value *= 0.99;
        }
      } },
    { "zeroed", [](auto & values) { std::fill(values.begin(), values.end(), 0.0); } },
    { "reversed", [](auto & values) { std::reverse(values.begin(), values.end()); } },
    { "two exchanged",
      [](auto & values) {
        const auto other = std::find_if(values.begin(), values.end(), [&](double v) { return v != values.back(); });
        if (other != values.end())
        {
          std::swap(*other, values.back());
        }
      } },
    { "the middle one denormal",
      [](auto & values) {
        if (!values.empty())
        {
          values[values.size() / 2] = 2.6e-311;
        }
      } },
    { "the middle one a tenth greater",
      [](auto & values) {
        if (!values.empty())
        {
          values[values.size() / 2] *= 1.1;
        }
      } },
  };
  return damages;
}

class VerifyDamage : public ::testing::Test
{
protected:
  std::string
  At(const std::string & name) const
  {
    return m_Folder / name;
  }

  void
  MakeScan(const std::string & size) const
  {
    RunPhantomJob(PhantomOptionsFrom({ { "kind", "thick-and-thin" },
                                       { "size", size },
                                       { "spacing", "0.5,0.5,0.75" },
                                       { "output", At("scan.nrrd") } }));
  }

  /** A core's file. */
  std::string
  MakeCore(ParameterValues more) const
  {
    more.insert({ { "scan", At("scan.nrrd") }, { "output", At("core.vtp") }, { "force", "true" } });
    RunCoreJob(CoreOptionsFrom(more));
    return UnpackedVtp(ReadAll(At("core.vtp")));
  }

  bool
  IsAccepted(const std::string & file) const
  {
    WriteAll(At("damaged.vtp"), file);
    try
    {
      return RunVerifyJob({ At("scan.nrrd"), At("damaged.vtp") }).passed;
    }
    catch (const InputError &)
    {
      return false;
    }
  }

  /** Every array of the file, damaged in every way. */
  void
  ExpectEveryDamageIsSeen(const std::string & file) const
  {
    ASSERT_TRUE(IsAccepted(file));
    int changed = 0;
    for (const auto & [name, array] : ArraysOf(file))
    {
      for (const auto & [what, damage] : Damages())
      {
        const std::string damaged = Changed(file, array, damage);
        if (damaged != file)
        {
          ++changed;
          EXPECT_FALSE(IsAccepted(damaged)) << name << ' ' << what;
        }
      }
    }
    EXPECT_GT(changed, 40);
  }

  TemporaryFolder m_Folder;
};

TEST_F(VerifyDamage, RefinedMeasuresAndRadiiThatNothingHasAreRefused)
{
  MakeScan("24");
  const std::string file = MakeCore({ { "lambda", "1.5vox" }, { "refine", "labels" } });
  ASSERT_TRUE(IsAccepted(file));
  auto       arrays = ArraysOf(file);
  const auto tripled = Damages()[0].second;
  const auto denormal = Damages()[5].second;
  EXPECT_FALSE(IsAccepted(Changed(file, arrays.at("PointData/Radius"), denormal)));
  EXPECT_FALSE(IsAccepted(Changed(file, arrays.at("PointData/Lambda"), tripled)));
  EXPECT_FALSE(IsAccepted(Changed(file, arrays.at("CellData/Lambda"), tripled)));
  const std::string both = Changed(file, arrays.at("PointData/Lambda"), tripled);
  EXPECT_FALSE(IsAccepted(Changed(both, arrays.at("CellData/Lambda"), tripled)));
}

TEST_F(VerifyDamage, AFileThatVtkCannotOpenIsRefused)
{
  MakeScan("16");
  const std::string file = MakeCore({ { "lambda", "1.5vox" } });
  ASSERT_TRUE(IsAccepted(file));
  const auto with = [&file](const std::string & from, const std::string & to) {
    std::string other = file;
    const auto  at = other.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    other.replace(at, from.size(), to);
    return other;
  };
  for (const auto & [from, to] : std::vector<std::pair<std::string, std::string>>{
         { "   </CellData>", "  \xDF</CellData>" },          // between the tags
         { "</CellData>", "</PellData>" },                   // a tag that nothing opened
         { "</CellData>", "<!CellData>" },                   //
         { "    </FieldData>\n", "" },                       // one that nothing closes
         { "RangeMin=\"", "RangeMin=\"<" },                  // a bracket in an attribute
         { "RangeMin=\"", "RangeMin=\"&" },                  //
         { "RangeMin=\"", "RangeMax=\"1\" RangeMin=\"" },    // an attribute that is there twice
         { "NumberOfTuples=\"1\"", "NumberOfTuples=\"9\"" }, // of a text
         { "NumberOfStrips=\"0\"", "NumberOfStrips=\"4\"" }, // of cells that nobody looks at
         { "version=\"1.0\"", "version=\"9.0\"" },           //
         { "<Strips>", "<Stripe>" } })
  {
    EXPECT_FALSE(IsAccepted(with(from, to))) << from << " -> " << to;
  }
}

class HeavyVerifyDamage : public VerifyDamage
{};

TEST_F(HeavyVerifyDamage, OfAWholeCoreIsSeen)
{
  MakeScan("20");
  ExpectEveryDamageIsSeen(MakeCore({ { "lambda", "0" }, { "keep-edges", "true" } }));
}

TEST_F(HeavyVerifyDamage, OfACorePrunedByLambdaIsSeen)
{
  MakeScan("24");
  ExpectEveryDamageIsSeen(MakeCore({ { "lambda", "1.5vox" } }));
}

TEST_F(HeavyVerifyDamage, OfACorePrunedByToleranceIsSeen)
{
  MakeScan("24");
  ExpectEveryDamageIsSeen(MakeCore({ { "lambda", "0" }, { "tolerance", "0.5diag" } }));
  ExpectEveryDamageIsSeen(MakeCore({ { "lambda", "0" }, { "tolerance", "1.2diag" }, { "triangles", "true" } }));
}

TEST_F(HeavyVerifyDamage, OfARefinedCoreIsSeen)
{
  MakeScan("24");
  ExpectEveryDamageIsSeen(MakeCore({ { "lambda", "1.5vox" }, { "refine", "labels" }, { "keep-edges", "true" } }));
}

TEST_F(HeavyVerifyDamage, OfARefinedCorePrunedByToleranceIsSeen)
{
  MakeScan("24");
  MakeCore({ { "tolerance", "0.5diag" }, { "refine", "labels" } });
  ParameterValues further{ { "core", At("core.vtp") }, { "output", At("further.vtp") }, { "tolerance", "1.2diag" } };
  RunPruneJob(PruneOptionsFrom(further));
  ExpectEveryDamageIsSeen(UnpackedVtp(ReadAll(At("further.vtp"))));
}

TEST_F(VerifyDamage, OfANumberThatIsNoLengthIsToldWhereTheFileIsRead)
{
  MakeScan("24");
  const std::string file = MakeCore({ { "tolerance", "1.2diag" }, { "refine", "labels" } });
  const auto        arrays = ArraysOf(file);
  WriteAll(At("damaged.vtp"), Changed(file, arrays.at("PointData/Radius"), [](auto & values) {
             values[values.size() / 2] = std::numeric_limits<double>::quiet_NaN();
           }));
  EXPECT_THROW(RunVerifyJob({ At("scan.nrrd"), At("damaged.vtp") }), InputError);
}

} // namespace
} // namespace voxelcore::testing
