#pragma once
// Results of a cohort under the names of BIDS derivatives. https://bids-specification.readthedocs.io

#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Cohort/Manifest.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

/** What the names of a scan's derivatives begin with. */
struct BidsPlace
{
  std::string folder;   ///< "sub-01/ses-pre/anat"
  std::string entities; ///< "sub-01_ses-pre_acq-hr_space-MNI_desc-voxelcore"
};

/** Of a scan named as BIDS has it all entities in their order; `desc-voxelcore` where it has no `desc`. Of others the
 *  subject is the case's folder, letters and digits alone. */
BidsPlace
BidsPlaceOf(const std::string & scan, const std::string & caseFolder);

/** \throws InputError where two cases would have the same names */
void
RequireBidsPlaces(const std::vector<CohortCase> & cases);

/** Fills `target`, which is made, with the dataset: dataset_description.json, and the outputs of each done case in
 *  `folder` (by the name of its folder) as links of the file system or copies, tables as .tsv, each with a sidecar.
 *  \throws InputError as above; OutputError */
void
WriteBidsDataset(const std::filesystem::path &                                   target,
                 const std::filesystem::path &                                   folder,
                 const std::string &                                             description,
                 const std::vector<std::pair<std::string, const CaseRecord *>> & cases);

} // namespace voxelcore
