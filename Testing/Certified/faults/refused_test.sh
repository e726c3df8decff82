#!/usr/bin/env bash
# Whatever a lower room gets wrong, program and pipelines give no result, and leave nothing behind.
# usage: refused_test.sh PROGRAM [VTK_EXAMPLE [ITK_EXAMPLE]]      all linked with SeededFault.cxx
set -euo pipefail

program=$1 vtk=${2:-} itk=${3:-}
atlas=/usr/share/mricron/templates/aal.nii.gz
folder=$(mktemp -d)
table=$folder.table
trap 'rm -rf "$folder" "$folder.log" "$table"' EXIT
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
  echo "$fault | $(basename "$1") ${2/scan*/}" >>"$table"
}

# verified FAULT COMMAND...: no certificate looks at this; `verify`, without the fault, must refuse the file.
verified() {
  local fault=$1 code=0
  shift
  "$@" >"$folder.log" 2>&1 && "$program" verify scan.nrrd out.vtp >"$folder.log" 2>&1 ||
    fail "without a fault: $*: $(cat "$folder.log")"
  rm -rf out*
  VOXELCORE_SEEDED_FAULT=$fault "$@" >"$folder.log" 2>&1 || fail "a fault in $fault: $*: $(cat "$folder.log")"
  "$program" verify scan.nrrd out.vtp >"$folder.log" 2>&1 || code=$?
  [ "$code" = 4 ] || fail "verify passes a fault in $fault (exit $code): $*"
  rm -rf out*
  echo "$fault | verify" >>"$table"
}

# Topology
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
# Enclosure
refused enclosure 4 "$program" core scan.nrrd --lambda 0 -o out.vtp
refused moves 4 "$program" core scan.nrrd -o out.vtp
# Coverage: more is pruned than was asked for, or refinement does not see where it uncovers the boundary.
refused height 4 "$program" core scan.nrrd --refine off -o out.vtp
refused gap 4 "$program" core scan.nrrd -o out.vtp
[ ! -e "$atlas" ] || for label in 37 71 95 108; do
  refused gap 4 "$program" core "$atlas" --labels $label -o out.vtp
done
# Bounds of thickness
refused bounds 4 "$program" thickness scan.nrrd --refine off --bounds -o out.nrrd
for fault in bounds lower thick thin; do
  refused $fault 4 "$program" thickness scan.nrrd --bounds -o out.nrrd
done
# Balls that reach far out of the voxels are refused without bounds, too.
refused thick 4 "$program" thickness scan.nrrd -o out.nrrd
# Radii and measures, of which a certificate says nothing. When stand-out of branches is promised, its fault goes here.
verified radius "$program" core scan.nrrd --lambda 0 --keep-edges -o out.vtp
verified radius "$program" core scan.nrrd --tolerance 0 --keep-edges -o out.vtp
verified measure "$program" core scan.nrrd --lambda 0 --keep-edges -o out.vtp
[ -z "$vtk" ] || { refused core any "$vtk" scan.mha 2 3 out.vtp; refused pruning any "$vtk" scan.mha 2 3 out.vtp
                   refused enclosure any "$vtk" scan.mha 2 3 out.vtp; }
[ -z "$itk" ] || { refused core any "$itk" scan.mha 2vox out.vtp; refused pruning any "$itk" scan.mha 2vox out.vtp
                   refused enclosure any "$itk" scan.mha 2vox out.vtp; }
echo "fault | refused by"
sort -u "$table"
echo "every seeded fault is refused"
