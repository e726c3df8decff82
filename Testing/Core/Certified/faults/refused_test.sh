#!/usr/bin/env bash
# Whatever a lower room gets wrong, program and pipelines give no result and leave nothing behind, or `verify` refuses
# what they wrote. Prints by fault who refuses it; each fault of SeededFault.cxx must be refused in each way that a
# result is made, or stand below with the reason why that way does not meet it.
# usage: refused_test.sh program|atlas PROGRAM      refused_test.sh VTK|ITK PROGRAM WAY
# All are linked with SeededFault.cxx. `atlas`: the fault of 27 November 2026 on the labels where it passed.
set -euo pipefail

kind=$1 program=$2 way=${3:-}
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(mktemp -d)
table=$folder.table
trap 'rm -rf "$folder" "$folder.log" "$table"' EXIT
cd "$folder"
fail() { echo "refused_test.sh: $*" >&2; exit 1; }
declare -A sound=()

# works COMMAND...: once, without a fault.
works() {
  [ -z "${sound[$*]:-}" ] || return 0
  "$@" >"$folder.log" 2>&1 || fail "without a fault: $*: $(cat "$folder.log")"
  sound[$*]=yes
}

# run FAULT COMMAND...: its exit code is in `code`.
run() {
  code=0
  VOXELCORE_SEEDED_FAULT=$1 "${@:2}" >"$folder.log" 2>&1 || code=$?
}

# refused FAULT EXIT_CODE COMMAND...
refused() {
  local fault=$1 expected=$2
  shift 2
  works "$@"
  rm -rf out*
  run "$fault" "$@"
  [ "$code" -ne 0 ] || fail "a fault in $fault went through: $*"
  [ "$expected" = any ] || [ "$code" = "$expected" ] || fail "a fault in $fault: exit $code: $(cat "$folder.log")"
  grep -q 'certificate failed' "$folder.log" || fail "a fault in $fault: $(cat "$folder.log")"
  [ "$(ls)" = "$before" ] || fail "a fault in $fault left $(ls)"
  echo "$fault $kind" >>"$table"
}

# verified FAULT COMMAND...: no certificate looks at this; `verify`, with the fault and without, must refuse the file.
verified() {
  local fault=$1 mode
  shift
  if [ -z "${sound[verify $*]:-}" ]; then
    { "$@" && "$program" verify "$scan" out.vtp; } >"$folder.log" 2>&1 ||
      fail "without a fault: $*: $(cat "$folder.log")"
    sound[verify $*]=yes
  fi
  rm -rf out*
  run "$fault" "$@"
  [ "$code" = 0 ] || fail "a fault in $fault: $*: $(cat "$folder.log")"
  for mode in '' "$fault"; do
    run "$mode" "$program" verify "$scan" out.vtp
    [ "$code" = 4 ] || fail "verify${mode:+, with it,} passes a fault in $fault (exit $code): $*: $(cat "$folder.log")"
  done
  rm -rf out*
  printf '%s\n' "$fault $kind" "$fault verify" >>"$table"
}

if [ "$kind" = atlas ]; then
  atlas=/usr/share/mricron/templates/aal.nii.gz
  [ -e "$atlas" ] || exit 77
  before=
  for label in 37 38 41 71 95 108; do
    refused gap 4 "$program" core "$atlas" --labels $label -o out.vtp
  done
  exit
fi

scan=scan.mha # which all of them read
"$program" phantom thick-and-thin --size 32 -o $scan -q
slices=slices.mha # for what counts in thick slices only
"$program" phantom thick-and-thin --size 40 --spacing 1,1,4 -o $slices -q
if [ "$kind" = program ]; then
  "$program" core $scan --tolerance 0 --keep-edges -o whole.vtp -q
  "$program" core $scan --tolerance 0 --refine labels --keep-edges -o refined.vtp -q
  before=$(ls)
  # Topology
  refused core 4 "$program" core $scan -o out.vtp
  refused pruning 4 "$program" core $scan --lambda 1.5vox -o out.vtp
  refused tolerance 4 "$program" core $scan --refine off -o out.vtp
  refused refinement 4 "$program" core $scan --lambda 2.5vox --refine labels -o out.vtp
  refused refinement 4 "$program" core $scan -o out.vtp
  refused skeleton 4 "$program" skeleton $scan -o out.vtp
  for core in whole refined; do
    refused pruning 4 "$program" prune $core.vtp --lambda 2vox -o out.vtp
    refused tolerance 4 "$program" prune $core.vtp --tolerance 2diag -o out.vtp
  done
  # Enclosure
  refused enclosure 4 "$program" core $scan --lambda 0 --keep-edges -o out.vtp
  refused moves 4 "$program" core $scan -o out.vtp
  # Coverage: more is pruned than was asked for, or refinement does not see where it uncovers the boundary.
  refused height 4 "$program" core $scan --refine off -o out.vtp
  refused gap 4 "$program" core $scan -o out.vtp
  refused direction 4 "$program" core $slices --refine off -o out.vtp
  refused direction 4 "$program" core $slices -o out.vtp
  # Branches: only what stands out by ten times as much has one.
  refused branches 4 "$program" skeleton $scan -o out.vtp
  # Bounds of thickness. Balls that reach far out of the voxels are refused without bounds, too.
  refused bounds 4 "$program" thickness $scan --refine off --bounds -o out.nrrd
  for fault in bounds lower thick thin; do
    refused $fault 4 "$program" thickness $scan --bounds -o out.nrrd
  done
  refused thick 4 "$program" thickness $scan -o out.nrrd
  # What makers and checkers share
  for fault in weights place; do
    for options in '' '--refine off' '--lambda 1.5vox'; do
      refused $fault 4 "$program" core $scan $options -o out.vtp
    done
    refused $fault 4 "$program" core $scan --lambda 0 --keep-edges -o out.vtp
    refused $fault 4 "$program" skeleton $scan -o out.vtp
    run $fault "$program" verify $scan whole.vtp
    [ "$code" = 3 ] || [ "$code" = 4 ] || fail "verify passes with a fault in $fault: $(cat "$folder.log")"
    echo "$fault verify" >>"$table"
  done
  refused weights 4 "$program" thickness $scan -o out.nrrd
  refused weights 4 "$program" thickness $scan --refine off --bounds -o out.nrrd
  refused each 4 "$program" core $scan -o out.vtp
  refused both 4 "$program" core $scan --lambda 0 --keep-edges -o out.vtp
  # Radii and measures, of which a certificate says nothing.
  verified radius "$program" core $scan --lambda 0 --keep-edges -o out.vtp
  verified radius "$program" core $scan --tolerance 0 --keep-edges -o out.vtp
  verified measure "$program" core $scan --lambda 0 --keep-edges -o out.vtp
  verified ball "$program" core $scan -o out.vtp
else
  before=$(ls)
  refused core any "$way" whole $scan out.vtp
  refused pruning any "$way" pruned $scan out.vtp
  refused tolerance any "$way" exact $scan out.vtp
  refused refinement any "$way" refined $scan out.vtp
  refused enclosure any "$way" whole $scan out.vtp
  refused moves any "$way" refined $scan out.vtp
  refused height any "$way" exact $scan out.vtp
  refused gap any "$way" refined $scan out.vtp
  refused direction any "$way" exact $slices out.vtp
  for fault in weights place; do
    for what in whole refined; do
      refused $fault any "$way" $what $scan out.vtp
    done
  done
  refused each any "$way" refined $scan out.vtp
  refused both any "$way" whole $scan out.vtp
  verified radius "$way" whole $scan out.vtp
  verified measure "$way" whole $scan out.vtp
  verified ball "$way" refined $scan out.vtp
  if [ "$kind" = ITK ]; then
    refused thick any "$way" thickness $scan out.mha
    refused weights any "$way" thickness $scan out.mha
  fi
fi

# What a way does not meet: the filters give no skeleton, and of thickness only ITK's a map, without bounds. What a
# certificate refuses never comes to be a file for `verify`. With parts of its work lost a maker crashes or never ends;
# that checkers lose none is held by FaultGTest.
none() {
  case "$1 $2" in
    "parts "*) return 0 ;;
    "skeleton "[VI]TK | "branches "[VI]TK | "bounds "[VI]TK | "lower "[VI]TK | "thin "[VI]TK | "thick VTK") return 0 ;;
    "weights verify" | "place verify") [ "$kind" != program ] ;;
    "radius verify" | "measure verify" | "ball verify") return 1 ;;
    *" verify") return 0 ;;
    *) return 1 ;;
  esac
}
echo "| fault | $kind | verify |"
for fault in $(grep -oE 'IsSeeded\("[a-z]+"\)' "$source/SeededFault.cxx" | sed 's/.*"\(.*\)".*/\1/' | sort -u); do
  line="| $fault |"
  for by in "$kind" verify; do
    if grep -qx "$fault $by" "$table"; then
      line+=" refused |"
    elif none "$fault" "$by"; then
      line+=" - |"
    else
      fail "nothing tries a fault in $fault by $by"
    fi
  done
  echo "$line"
done
