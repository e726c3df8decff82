#pragma once
// `voxelcore roots`: a scan of a root system in, its roots, their traits and RSML out.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Roots/GreyLevels.h"
#include "voxelcore/Roots/RootFiles.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct RootsOptions
{
  /** Where a result is written: "roots.csv" in the folder, with the prefix. */
  std::filesystem::path
  Place(const std::string & file) const
  {
    return output / (prefix + file);
  }


  std::filesystem::path              scan;    ///< grey values or a mask; or a mesh
  ReadOptions                        reading; ///< must give one label, or grey values
  std::optional<std::int64_t>        resolution;
  ShapeEditOptions                   edits;
  bool                               asIs = false;      ///< without CleanForRoots(), and loops stay
  bool                               keepLoops = false; ///< roots that touch stay joined
  std::optional<double>              kernel;            ///< grey values from here on are never cut
  std::optional<double>              neighbourhood;     ///< none below is filled
  SkeletonRequest                    stage;
  RootRules                          rules;
  std::filesystem::path              annotations;     ///< what is said of single roots (RootEdits.h); may be empty
  std::optional<double>              soilDepth;       ///< mm below the base of the first stem
  std::filesystem::path              output;          ///< a folder
  std::string                        prefix;          ///< of the names of all files in it
  bool                               pictures = true; ///< where the build can
  std::size_t                        htmlTriangles = 500000;
  std::map<std::string, std::string> further; ///< recorded
  Engine                             engine = Engine::Auto;
  int                                threads = 0; ///< only recorded
  bool                               force = false;
  std::string                        command; ///< only recorded
};

/** One cut or fill, with its voxels. */
struct RootsChange : EditRecord::Change
{
  VoxelChanges runs;
  double       brightest = 0; ///< of a cut, where there are grey values
  double       darkest = 0;   ///< of a fill
};

/** What was done to make a tree of the mask. */
struct RootsTopology
{
  TopologyNumbers           before;
  TopologyNumbers           after;
  bool                      asAsked = true;
  std::string               reason; ///< of what was missed
  std::uint64_t             cuts = 0;
  std::uint64_t             fills = 0;
  std::uint64_t             voxelsAdded = 0;
  std::uint64_t             voxelsRemoved = 0;
  std::vector<RootsChange>  parts;   ///< the costliest first
  VoxelChanges              changes; ///< all of them
  std::optional<GreyLevels> levels;  ///< of a grey scan; nothing at or above the kernel's was cut
  SkeletonGraph             graph;   ///< of the mask before; loops where roots touch
  RootHierarchy             roots;   ///< in it, each going on through its contacts
  std::vector<double>       torn;    ///< gaps in it that were bridged, mm
};

struct RootsResult
{
  CoreReport                   report;
  RootModel                    model;
  std::optional<RootsTopology> topology; ///< where something was changed
  std::vector<std::string>     warnings;
  std::vector<std::string>     notes;
};

/** "z-": a direction along an axis; none for "auto". \throws UsageError */
std::optional<Vector3>
ParseUp(const std::string & text);

/** "z-" for (0, 0, -1). */
std::string
UpText(const Vector3 & up);

/** What is done to a root's mask before anything is computed unless the user says otherwise: flips of single voxels are
 *  mended, cavities are filled, the largest piece stays. What the user asks for of these takes precedence. Hollows are
 *  filled, too, unless the user closes or fills otherwise; through holes how wide is looked at for each scan: 2.5, 4 or
 *  6 voxels (by the largest spacing), whichever leaves the fewest loops, cavities and pieces. */
void
CleanForRoots(ShapeEditOptions & edits);

/** Reads, proposes a threshold where grey values come without one (ProposedThreshold), cleans, cuts roots apart where
 *  they touch so that pieces, loops and cavities are as few as can be or as asked for, computes a certified medial
 *  surface and skeleton, finds the roots, measures them. Writes into the folder: mask.nrrd, medial.vtp, skeleton.vtp,
 *  roots.rsml, roots.swc, roots.graphml, roots.csv, levels.csv, plant.csv, profile.csv, columns.json, changes.txt
 *  (cuts and fills), annotations.csv and annotations.mrk.json (what is said of each root), report.json and page.html
 *  (the summary); with pictures roots.png and roots.html (3-D), too. Everything is written or nothing.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
RootsResult
RunRootsJob(const RootsOptions & options, const JobContext & context = {});

/** For people: levels, traits, what to look at. */
std::string
RootsText(const RootsResult & result);

} // namespace voxelcore
