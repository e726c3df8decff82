#pragma once
// One volume in parts: `core --blocks N --block K` computes one part, by itself, on any machine; `core --join` makes of
// all of them the file that a single run writes, bit for bit. See HaloBlocks.h for why.

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Lattice/TopologyNumbers.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct BlockOptions
{
  CoreOptions core;       ///< scan, reading, edits, engine, threads, force; its output is a folder
  std::size_t blocks = 1; ///< into how many each label is cut
  std::size_t block = 1;  ///< which one, from 1

  /** Instead of `blocks`: cut the scan, whatever it holds, into blocks of so many voxels along each axis. Then no block
   *  ever reads the whole. For one shape: binary, a threshold, or one value as the labels. */
  std::optional<std::int32_t> side;
};

/** What a part holds of one label. */
struct BlockPart
{
  std::int64_t          label = 0;
  std::int64_t          component = 0;
  std::string           name;
  std::uint64_t         cells = 0;
  std::uint64_t         boundaryVertices = 0; ///< of the whole label; kNotCounted where nobody knows
  std::uint64_t         ownVertices = 0;      ///< of the block
  std::uint64_t         subshapeVertices = 0; ///< of what was computed: the block and its halo
  std::filesystem::path file;
};

struct BlockResult
{
  std::vector<BlockPart>   parts; ///< one per label
  std::vector<std::string> warnings;
  std::size_t              blocks = 1; ///< into how many each label is cut
};

/** "<folder>/<scan>_label-<value>_block-<k>-of-<n>.vcb"; of a component "..._label-<value>_component-<c>_block-...". */
std::filesystem::path
BlockPath(const BlockOptions & options, std::int64_t label, std::int64_t component);

/** Into how many blocks a scan is cut with options.side; options.blocks without it. Reads the header alone.
 *  \throws UsageError, InputError */
std::size_t
CountBlocks(const BlockOptions & options);

/** Computes one block of every label and writes each into a file of its own. All files appear, or none. Unless labels
 *  are edited, the first run keeps a plan beside them, "<folder>/<scan>_blocks-<n>.vcp"; later ones read only the part
 *  of the scan that their block needs, as long as scan and options are those of the plan.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
BlockResult
RunBlockJob(const BlockOptions & options, const JobContext & context = {});

/** The cells of a label from the parts in `folder`. Their points must be those of the label in the scan at hand, and
 *  the numbers that the parts' voxels add up to must be `topology`, its own.
 *  \throws InputError when parts are missing, of different cuts, or of another scan; CertificateError */
DelaunayCells
JoinParts(const std::filesystem::path &     folder,
          const std::filesystem::path &     scan,
          std::int64_t                      label,
          std::int64_t                      component,
          const std::vector<LatticePoint> & points,
          const TopologyNumbers &           topology,
          const ProgressCallback &          progress = {});

/** A line per label, for people. */
std::string
BlockText(const BlockResult & result, const BlockOptions & options);

} // namespace voxelcore
