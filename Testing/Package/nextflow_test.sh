#!/usr/bin/env bash
# The script of voxelcore.nf without Nextflow: filled in as Nextflow fills it in for a scan whose name has a blank, and
# run by bash; it makes what the workflow hands on.
# usage: nextflow_test.sh PROGRAM
set -euo pipefail
program=$(realpath "$1")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
workflow=$source/Applications/container/voxelcore.nf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "nextflow_test.sh: $1" >&2; exit 1; }
cd "$work"
export PATH=$(dirname "$program"):/usr/bin:/bin
voxelcore phantom torus --size 32 -o "a scan.nii.gz" -q

script=$(sed -n '/^    """$/,/^    """$/p' "$workflow" | grep -v '"""')
[ "$(grep -c '^ *voxelcore ' <<<"$script")" = 3 ] || fail "this is not the script: $script"
# Of what stands in a script Nextflow escapes paths alone.
script=${script//'${scan}'/a\\ scan.nii.gz}
script=${script//'${name}'/a scan}
script=${script//'${task.cpus}'/2}
script=${script//'${params.options}'/--tolerance 1.5diag}
[[ $script != *'$'* ]] || fail "what is filled in here? $script"
bash -euo pipefail -c "$script" || fail "the script fails"
for file in medial.vtp report.json skeleton.vtp skeleton_branches.csv thickness.nrrd thickness.csv; do
  [ -s "a scan/a scan_$file" ] || fail "no a scan_$file among $(ls "a scan")"
done
grep -q 'path "${scan.simpleName}/\*"' "$workflow" || fail "what does the workflow hand on?"
grep -q '1.5diag' "a scan/a scan_report.json" || fail "options are not handed on"
voxelcore verify "a scan.nii.gz" "a scan/a scan_medial.vtp" -q
echo "the script of voxelcore.nf: works"
