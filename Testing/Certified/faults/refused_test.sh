#!/usr/bin/env bash
# Whatever a lower room gets wrong, program and pipelines give no result, and leave nothing behind.
# usage: refused_test.sh PROGRAM [VTK_EXAMPLE [ITK_EXAMPLE]]      all linked with SeededFault.cxx
set -euo pipefail

program=$1 vtk=${2:-} itk=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "refused_test.sh: $*" >&2; exit 1; }
"$program" phantom thick-and-thin --size 32 -o scan.nrrd -q
"$program" phantom thick-and-thin --size 32 -o scan.mha -q
"$program" core scan.nrrd --tolerance 0 --keep-edges -o whole.vtp -q
"$program" core scan.nrrd --tolerance 0 --refine labels --keep-edges -o refined.vtp -q
before=$(ls)

# refused FAULT EXIT_CODE COMMAND...
refused() {
  local fault=$1 expected=$2 code=0
  shift 2
  "$@" >"$folder.log" 2>&1 || fail "without a fault: $*: $(cat "$folder.log")"
  rm -rf out*
  VOXELCORE_SEEDED_FAULT=$fault "$@" >"$folder.log" 2>&1 || code=$?
  [ "$code" -ne 0 ] || fail "a fault in $fault went through: $*"
  [ "$expected" = any ] || [ "$code" = "$expected" ] || fail "a fault in $fault: exit $code: $(cat "$folder.log")"
  grep -q 'certificate failed' "$folder.log" || fail "a fault in $fault: $(cat "$folder.log")"
  [ "$(ls)" = "$before" ] || fail "a fault in $fault left $(ls)"
}
refused core 4 "$program" core scan.nrrd -o out.vtp
refused pruning 4 "$program" core scan.nrrd --lambda 1.5vox -o out.vtp
refused tolerance 4 "$program" core scan.nrrd --refine off -o out.vtp
refused refinement 4 "$program" core scan.nrrd --lambda 2.5vox --refine labels -o out.vtp
refused refinement 4 "$program" core scan.nrrd --refine labels -o out.vtp
refused skeleton 4 "$program" skeleton scan.nrrd -o out.vtp
for core in whole refined; do
  refused pruning 4 "$program" prune $core.vtp --lambda 2vox -o out.vtp
  refused tolerance 4 "$program" prune $core.vtp --tolerance 2diag -o out.vtp
done
[ -z "$vtk" ] || { refused core any "$vtk" scan.mha 2 3 out.vtp; refused pruning any "$vtk" scan.mha 2 3 out.vtp; }
[ -z "$itk" ] || { refused core any "$itk" scan.mha 2vox out.vtp; refused pruning any "$itk" scan.mha 2vox out.vtp; }
rm -f "$folder.log"
echo "every seeded fault is refused"
