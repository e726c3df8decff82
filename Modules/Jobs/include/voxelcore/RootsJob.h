#pragma once
// `voxelcore roots`: a scan of a root system in, its roots, their traits and RSML out.

#include "voxelcore/CoreJob.h"
#include "voxelcore/RootFiles.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct RootsOptions
{
  std::filesystem::path              scan;    ///< grey values or a mask; or a mesh
  ReadOptions                        reading; ///< must give one label, or grey values
  std::optional<std::int64_t>        resolution;
  ShapeEditOptions                   edits;
  bool                               asIs = false; ///< without CleaningForRoots()
  SkeletonRequest                    stage;
  RootRules                          rules;
  std::optional<double>              soilDepth;       ///< mm below the base of the first stem
  std::filesystem::path              output;          ///< a folder
  bool                               pictures = true; ///< where the build can
  std::size_t                        htmlTriangles = 500000;
  std::map<std::string, std::string> further; ///< recorded
  Engine                             engine = Engine::Auto;
  int                                threads = 0; ///< only recorded
  bool                               force = false;
  std::string                        command; ///< only recorded
};

struct RootsResult
{
  CoreReport               report;
  RootModel                model;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
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

/** Reads, proposes a threshold where grey values come without one (HalfwayThreshold), cleans, computes a certified
 *  medial surface and skeleton, finds the roots, measures them. Writes into the folder: mask.nrrd, medial.vtp,
 *  skeleton.vtp, roots.rsml, roots.csv, levels.csv, plant.csv, profile.csv, columns.json, report.json and page.html
 *  (the summary); with pictures roots.png and roots.html (3-D), too. Everything is written or nothing.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
RootsResult
RunRootsJob(const RootsOptions & options, const JobContext & context = {});

/** For people: levels, traits, what to look at. */
std::string
RootsText(const RootsResult & result);

} // namespace voxelcore
