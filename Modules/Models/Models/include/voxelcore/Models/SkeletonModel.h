#pragma once
// Curve skeletons as files: .vtp for viewers and for VoxelCore, .swc .mrk.json .graphml for others, .csv tables.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"
#include "voxelcore/Skeleton/SomaTree.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

using SkeletonPart = MeasuredSkeleton;

struct SkeletonModel
{
  std::vector<SkeletonPart> parts;                           ///< by label, then component
  std::string               provenance;                      ///< JSON text of the field array Provenance
  SpatialUnit               unit = SpatialUnit::Millimetres; ///< of all lengths
  std::string               rounded{};                       ///< as of MedialModel
};

/** Whether its branches have lives, as those of a map of probabilities. */
bool
HasLives(const SkeletonModel & model);

/** Whether a person gave names to some of its branches. */
bool
HasNames(const SkeletonModel & model);

/** Of a part whose branches have lives per point the highest threshold of those it is on; empty without lives. */
std::vector<double>
PointConfidence(const SkeletonPart & part);

/** XML polydata: isolated points as verts, a poly line per branch, polygons of faces that stay. Point arrays Radius
 *  (SectionRadii()), BallRadius, MaximumInscribedSphereRadius (the same under VMTK's name), ErosionThickness; cell
 *  arrays BranchId (per part, from 0; -1 for verts and polygons), Label, Component, Closed (1 for faces of closed
 *  surfaces), and of branches Length, Tortuosity, Level, Strahler (0 elsewhere); where they have lives
 *  LowestThreshold, HighestThreshold and Persistence, the difference. Of a network Label is that of each
 *  branch; there are the point arrays Label and Contact (1 where labels meet), too, and the field array LabelNames, a
 *  line "value name" a label. Where branches have names there is the field array BranchNames, a line "cell name" for
 *  each that has one. Equal models give equal bytes. \throws OutputError */
void
WriteSkeletonVtp(const std::filesystem::path & path, const SkeletonModel & model);

/** Reads what WriteSkeletonVtp wrote, also where another program saved it again, as ReadModel does with
 *  Precision::AsSaved; names of labels and tables are empty. \throws InputError */
SkeletonModel
ReadSkeletonVtp(const std::filesystem::path & path);

/** The same, none where the file holds no skeleton or cannot be read at all. \throws InputError for a damaged one */
std::optional<SkeletonModel>
ReadSkeletonIfAny(const std::filesystem::path & path);

/** SWC in micrometres (in voxels where the unit is the voxel), LPS axes: `id type x y z radius parent`, parents
 *  first. Cycles are cut (CutLoops), which the header lists; where faces stay a tree begins anew. `root` as in
 *  MeasureOptions. Types are 0, or of a network 5 and on by label.
 *
 *  With a soma the tree begins at its middle, a point of type 1 with its radius, and branches at the ball's surface
 *  (CutAtSoma). Other points have type 3, dendrite, or of a network that of labels whose names say so: 2 for axon, 3
 *  for dendrite, 4 for apical. Without a place each part has its soma; with one, the part has it that the place is in
 *  or nearest to. Components that do not reach it stay trees of their own. \throws OutputError */
void
WriteSwc(const std::filesystem::path &     path,
         const SkeletonModel &             model,
         const MeasureOptions &            options,
         const std::optional<SomaChoice> & soma = {});

/** A Slicer curve per branch, in LPS mm (or voxels), its radii as a measurement. \throws OutputError */
void
WriteMarkups(const std::filesystem::path & path, const SkeletonModel & model);

/** GraphML: nodes with place, radius and kind, edges with the numbers of their branches, and in "points" x y z radius
 *  of each point between the ends, from the source on. The graph's "unit" is that of lengths. \throws OutputError */
void
WriteGraphMl(const std::filesystem::path & path, const SkeletonModel & model);

/** Wavefront OBJ: an object a label, in it a group with a line a branch; isolated points as points. LPS, in the unit of
 *  the model, as a comment says; radii have no place in it. \throws OutputError */
void
WriteSkeletonObj(const std::filesystem::path & path, const SkeletonModel & model);

/** Neuroglancer's precomputed skeletons, whose unit must be mm: a file for each label, named by its value, with points
 *  in nanometres, edges, and the radius of a round cross-section at each point; `names/info`, the labels' names; and at
 *  last `info`. `place` gives the path to write each at. \throws OutputError */
void
WritePrecomputedSkeletons(const std::function<std::filesystem::path(const std::string & name)> & place,
                          const SkeletonModel &                                                  model);

/** Comma-separated values, a row per branch; columns as SkeletonColumnsJson() says. \throws OutputError */
void
WriteBranchCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units = {});

/** A row per label and level of the hierarchy; level "all" sums up a label. Of a network there are rows for each of its
 *  labels, and rows of label 0, called "network", for the whole. \throws OutputError */
void
WriteSummaryCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units = {});

/** A row per contact of labels of networks, or gap between them. \throws OutputError */
void
WriteContactsCsv(const std::filesystem::path & path, const SkeletonModel & model, HeadUnits units = {});

/** A text as a field of a .csv: quoted where it has to be, with an apostrophe in front where a spreadsheet would take
 *  it for a formula (it begins with one of = + - @ or a control character). */
std::string
CsvField(const std::string & text);

/** The data dictionary of the tables as JSON: meaning and unit of each column. `network`: with that of contacts;
 *  `lives`, `names`: with the columns that these have. */
std::string
SkeletonColumnsJson(SpatialUnit unit, bool network = false, bool lives = false, bool names = false);

} // namespace voxelcore
