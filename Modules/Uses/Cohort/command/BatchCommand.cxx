// `voxelcore batch`: its options, and what it runs.

#include "voxelcore/Cohort/BatchJob.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kBatchOwn = std::to_array<Parameter>({
  { "inputs",
    "",
    Inputs,
    "INPUT...",
    "",
    false,
    Group::Input,
    "Scans, folders, quoted 'patterns*', or one manifest.csv" },
  { "html", "--html", Flag, "", "", false, Group::Output, "Write a 3-D page for each case, linked from index.html" },
  { "jobs", "-j,--jobs", Integer, "N", "0", false, Group::Cohort, "Run N cases at a time; 0 means one per processor" },
  { "memory",
    "--memory",
    Text,
    "SIZE",
    "",
    false,
    Group::Cohort,
    "Memory limit for all cases together, such as 12GB; default: 90 % of what is free" },
  { "timeout",
    "--timeout",
    Text,
    "TIME",
    "",
    false,
    Group::Cohort,
    "Time limit per case: 90s, 10m, 2h; default: none" },
  { "no-skeleton", "--no-skeleton", Flag, "", "", false, Group::Cohort, "Compute medial surfaces only" },
  { "bids",
    "--bids",
    Flag,
    "",
    "",
    false,
    Group::Cohort,
    "Also write the results as BIDS derivatives into OUTDIR/bids: names with the scan's entities, tables as .tsv, and "
    "JSON sidecars" },
  { "list",
    "--list",
    Flag,
    "",
    "",
    false,
    Group::Cohort,
    "Print each case's number, folder, id and scan, and run nothing" },
  { "case",
    "--case",
    Integer,
    "K",
    "",
    false,
    Group::Cohort,
    "Run only case K, counted from 1, and write no tables; for clusters" },
  { "gather",
    "--gather",
    Flag,
    "",
    "",
    false,
    Group::Cohort,
    "Write tables and page from the results in OUTDIR, and run nothing; give the options of that run" },
});

constexpr auto kBatchRows = Joined(kBatchOwn, kFolderOutput);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(Folders are searched at any depth; one with several .tif or .png files is one scan. A manifest.csv has the
columns id, scan, and any option of 'voxelcore core' without dashes (lambda, labels, threshold, ...); an empty
field means not given. Commas, semicolons or tabs separate columns. Options on the command line apply to all
cases; a case's own take precedence.

Each case runs in its own process. A failure costs only that case, and the exit code is then 1. Run the same
command again to continue: finished cases are recognised by the content of scan, options and program. OUTDIR
gets a folder sub-<id>/ per case, cases.csv, labels.csv, columns.json, and index.html, which opens offline.

With --roots each case is one of 'voxelcore roots': a season of plants. labels.csv then holds their traits
(plant_...), and plants that stand out are marked.

With --thickness each case is one of 'voxelcore thickness'. Its folder gets the map; labels.csv holds the numbers
(thickness_...), and index.html shows them with a histogram.

On a cluster, run 'batch manifest.csv -o OUT --case $SLURM_ARRAY_TASK_ID' for each case, then 'batch
manifest.csv -o OUT --gather'. Applications/Snakemake does both.

Examples:
  voxelcore batch scans/ -o results --lambda 2vox
  voxelcore batch cohort.csv -o results --jobs 4 --memory 12GB --timeout 30m
  voxelcore batch 'scans/*.nii.gz' -o results --no-skeleton
  voxelcore batch season.csv --roots --up z+ -o season/
  voxelcore batch bones/ --thickness --separation hull -o thickness/)";

Outcome
Run(const Invocation & call)
{
  const BatchOptions options = BatchOptionsFrom(call.values, call.commands);
  if (call.values.contains("list"))
  {
    return { .text = CaseList(options) };
  }
  const BatchResult result = RunBatchJob(options, call.context);
  Outcome           outcome{ .text = BatchText(result) };
  if (!result.failed.empty())
  {
    outcome.failure = std::to_string(result.failed.size()) + " of " + std::to_string(result.cases) +
                      " cases failed, the first, " + result.failed.front().id + ": " + result.failed.front().reason;
  }
  return outcome;
}

} // namespace

constinit const Command kBatchCommand{ .name = "batch",
                                       .description =
                                         "Process many scans: medial surfaces, skeletons, tables and an overview page",
                                       .footer = kFooter,
                                       .place = 130,
                                       .rows = table::kBatchRows,
                                       .run = Run,
                                       .resumes = Resumes::Always,
                                       .runsCases = true };

} // namespace voxelcore
