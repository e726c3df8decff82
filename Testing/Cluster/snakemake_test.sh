#!/usr/bin/env bash
# A cohort by Snakemake on this machine: what failed or changed is done again, and nothing else; a dry run changes
# nothing.
# usage: snakemake_test.sh PROGRAM SOURCE     exit code 77: there is no Snakemake
set -euo pipefail
program=$1 source=$2
command -v snakemake >/dev/null || { echo "skipped: there is no snakemake"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $1" >&2; tail -n 20 log >&2; exit 1; }
flow() {
  snakemake -s "$source/Applications/Snakemake/Snakefile" --cores 2 --nocolor "$@" \
    --config manifest=cohort.csv out=results program="$program" >log 2>&1
}
digest() { sha256sum "results/sub-$1/sub-$1_case.json"; }

for k in 1 2 3; do "$program" phantom torus --size $((12 + k)) -o s$k.nrrd --quiet; done
printf 'id,scan\none,s1.nrrd\ntwo,s2.nrrd\n"odd\xc2\x85id",s1.nrrd\nnone,none.nrrd\n' >cohort.csv
flow && fail "it did not tell of the case that failed"
[ "$(grep -c ',done,' results/cases.csv)" = 3 ] || fail "not all that can be done is done"
grep -q 'none.nrrd: no such file' results/cases.csv || fail "the tables do not say what failed"

before=$(digest none)
flow --dry-run || fail "the dry run failed"
[ "$(digest none)" = "$before" ] || fail "a dry run took the reason of a case that failed"

one=$(digest one) two=$(digest two)
cp s3.nrrd s2.nrrd
cp s3.nrrd none.nrrd
flow || fail "a case that failed was not run again"
[ "$(grep -c ',done,' results/cases.csv)" = 4 ] || fail "not all is done"
[ "$(digest one)" = "$one" ] || fail "what had not changed was done again"
[ "$(digest two)" != "$two" ] || fail "the case of a changed scan was not done again"

if snakemake -s "$source/Applications/Snakemake/Snakefile" --cores 1 \
  --config manifest=cohort.csv 'out=a{b}' program="$program" >log 2>&1; then
  fail "braces in the name of the folder were taken"
fi
grep -q 'name another folder' log || fail "it does not say what is wrong with braces"
echo "Snakemake does what failed or changed, and nothing else."
