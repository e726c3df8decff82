#!/usr/bin/env bash
# An option is one row, and a command one folder and its name: both, put into a copy of the sources, are found wherever
# options and commands are.
# usage: one_row_test.sh SOURCE_DIR [CMAKE OPTIONS]
set -euo pipefail

sources=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "one_row_test.sh: $1" >&2
  exit 1
}

mkdir "$folder/source"
cp -r "$sources"/{CMakeLists.txt,LICENSE,Modules,Applications} "$folder/source/"
cd "$folder"
rows=source/Modules/Program/Options/inner/voxelcore/Options/SharedRows.h
sed -i '/^inline constexpr auto kShapeRows = /a\
  { "trial-option", "--trial-option", Text, "WORD", "", false, Group::ShapeEdits, "Try what a row gives", {}, true },' \
  $rows
grep -q trial-option $rows || fail "the row was not put in"

street=source/Modules/Uses/Trial
mkdir -p $street/command
sed -i 's/ Cohort)/ Trial Cohort)/' source/Modules/CMake/VoxelCoreRooms.cmake
cat >$street/CMakeLists.txt <<'CMAKE'
add_library(VoxelCoreTrial INTERFACE)
add_library(VoxelCore::Trial ALIAS VoxelCoreTrial)
set_target_properties(VoxelCoreTrial PROPERTIES EXPORT_NAME Trial)
voxelcore_command(Trial Trial)
CMAKE
cat >$street/command/TrialCommand.cxx <<'CPP'
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{
namespace table
{
constexpr auto kTrialOwn = std::to_array<Parameter>({
  { "trial-word", "--trial-word", Choice, "loud|low", "low", false, Group::Output, "How it is said" },
});
constexpr auto kTrialRows = Joined(kRunRows, kScanArgument, kTrialOwn);
} // namespace table

namespace
{
std::vector<std::string>
CaseArguments(const CasePlace & place)
{
  return { "--trial-word", "loud" };
}
CaseInput
Understand(const ParameterValues &)
{
  return {};
}
constexpr AsCase kAsCase{
  .arguments = CaseArguments, .understand = Understand, .flag = "--trial", .description = "Try it on each scan"
};
} // namespace

extern constinit const Command kTrialCommand{
  .name = "trial",
  .description = "Try what a folder gives",
  .footer = "Example:\n  voxelcore trial scan.nrrd",
  .place = 45,
  .rows = table::kTrialRows,
  .run =
    [](const Invocation & call) {
      const std::string word = ChoiceOf(call.values, kTrialCommand, "trial-word");
      return Outcome{ .text = call.values.at("scan") + " " + word + "\n" };
    },
  .asCase = &kAsCase
};
} // namespace voxelcore
CPP

export CCACHE_BASEDIR=$folder CCACHE_NOHASHDIR=1
cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DVOXELCORE_PYTHON=ON "$@" >cmake.log
ninja -C build >ninja.log || { tail -30 ninja.log; fail "it does not build"; }
program=build/bin/voxelcore

"$program" core --help | grep -qE -- '--trial-option WORD .*Try what a row gives' || fail "not in the help"
grep -q 'trial.*option' build/manual/voxelcore-core.1 || fail "not in the manual page"
grep -q -- '--trial-option' build/manual/voxelcore.bash || fail "not in bash's completion"
grep -q -- '--trial-option' build/manual/_voxelcore || fail "not in zsh's completion"

"$program" --help | grep -q 'trial .*Try what a folder gives' || fail "a street's command is not in the help"
test "$("$program" trial scan.nrrd --trial-word loud)" = "scan.nrrd loud" || fail "it does not run"
! "$program" trial scan.nrrd --trial-word lout 2>error.txt || fail "a wrong choice runs"
grep -q "did you mean 'loud'" error.txt || fail "its choices are not told"
test -s build/manual/voxelcore-trial.1 || fail "no manual page of a street's command"
grep -q -- '--trial-word' build/manual/voxelcore.bash || fail "not in bash's completion"
grep -q 'trial:Try what a folder gives' build/manual/_voxelcore || fail "not in zsh's completion"
"$program" batch --help | grep -qE -- '--trial +Try it on each scan' || fail "batch does not run it"

# What a .vtp says of how it was made; its arrays are packed.
provenance() {
  /usr/bin/python3 -c 'import sys, vtk
reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
print(reader.GetOutput().GetFieldData().GetAbstractArray("Provenance").GetValue(0))' "$1"
}

"$program" phantom ellipsoid --size 20 -o scan.nrrd -q
"$program" core scan.nrrd --trial-option word --tolerance 0 --report core.json -o core.vtp -q
grep -q '"trial_option": "word"' core.json || fail "not in the report"
provenance core.vtp | grep -q '"trial_option":"word"' || fail "not in the file"
"$program" core scan.nrrd --tolerance 0 -o plain.vtp -q
! provenance plain.vtp | grep -q trial_option || fail "recorded though it was not given"
"$program" verify scan.nrrd core.vtp -q || fail "verify does not take the file"
"$program" prune core.vtp --tolerance 1diag -o pruned.vtp -q
provenance pruned.vtp | grep -q '"trial_option":"word"' || fail "not read back from a file"
"$program" skeleton scan.nrrd --trial-option word -o skeleton.vtp -q
provenance skeleton.vtp | grep -q '"trial_option":"word"' || fail "not in a skeleton's file"
printf 'id,scan,trial-option\na,scan.nrrd,word\n' >cases.csv
"$program" batch cases.csv -o cases -q
grep -rq '"trial_option": "word"' cases || fail "not a column of a manifest"

PYTHONPATH=build/python /usr/bin/python3 - <<'PYTHON' || fail "not in Python"
import numpy, voxelcore
core = voxelcore.core(numpy.ones((5, 5, 5), int), trial_option="word")
assert core.report["parameters"]["trial_option"] == "word"
assert "trial_option : str, optional\n        Try what a row gives" in voxelcore.core.__doc__
PYTHON
echo "One row is an option and one folder a command everywhere."
