#pragma once
// Centerlines and networks of pipes as files for other programs.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Vessels/Centerlines.h"
#include "voxelcore/Vessels/FlowNetwork.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** XML polydata as VMTK's branch extractor gives it: a poly line per tract with points of its own; point array
 *  MaximumInscribedSphereRadius; cell arrays CenterlineIds, TractIds, GroupIds, Blanking (1 in bifurcations), and
 *  Label. \throws OutputError */
void
WriteCenterlineVtp(const std::filesystem::path & path, const std::vector<CenterlineTract> & tracts, SpatialUnit unit);

/** Comma-separated values: a row per segment, and in `nodes` a row per node. `parts` are those of the network.
 *  \throws OutputError */
void
WriteFlowCsv(const std::filesystem::path &         segments,
             const std::filesystem::path &         nodes,
             const FlowNetwork &                   network,
             const std::vector<MeasuredSkeleton> & parts,
             HeadUnits                             units = {});

/** What the columns of both mean, as JSON. */
std::string
FlowColumnsJson(SpatialUnit unit);

/** Input of svZeroDSolver (github.com/SimVascular/svZeroDSolver) in centimetres, grams and seconds, of a network in mm:
 *  a BloodVessel per segment with the resistance of Poiseuille and the inertance of blood (density 1.06, viscosity
 *  0.04), capacitance 0, and its branch and label; a NORMAL_JUNCTION per inner node. Flow and pressure at the ends are
 *  examples: 1 cm^3/s in all together, shared by area, and pressure 0. \throws OutputError */
void
WriteFlowJson(const std::filesystem::path &         path,
              const FlowNetwork &                   network,
              const std::vector<MeasuredSkeleton> & parts);

/** Configuration of openBF (insigneo.github.io/openBF) in metres and pascals, of a network in mm with one inlet, and
 *  in `inlet` its inflow: a vessel per segment with the radius of the even pipe of the same resistance, and numbers of
 *  nodes from 1, the inlet. A second segment between the same nodes is cut in its middle, as openBF knows vessels by
 *  their nodes. Blood as above; Young's modulus (400 kPa), no reflection at outlets, and inflow (1 cm^3/s) are
 *  examples. `inlet` is called NAME_inlet.dat. \throws InputError for a network with several inlets or none, and for a
 *  junction of more than three vessels, or with none that leads out of it; OutputError */
void
WriteFlowYaml(const std::filesystem::path &         path,
              const std::filesystem::path &         inlet,
              const std::string &                   name,
              const FlowNetwork &                   network,
              const std::vector<MeasuredSkeleton> & parts);

} // namespace voxelcore
