#!/usr/bin/env bash
# The program for Windows under Wine: names of files with blanks, umlauts and signs beyond 16 bits, drive letters, long
# names; Ctrl-C ends it and leaves nothing; what a kill leaves the next run removes.
# usage: windows_test.sh PROGRAM DATA FOLDER    PROGRAM: the native one; DATA: the test scans; FOLDER: to work in;
# VOXELCORE_PORTABLE as for windows.sh
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$(realpath "$1")
data=$(realpath "$2")
rm -rf "$3"
mkdir -p "$3"
cd "$3"
fail() {
  echo "windows_test.sh: $1" >&2
  exit 1
}
windows() { sh "$here/windows.sh" "$@"; }

"$program" core "$data/gyroid.nrrd" -o expected.vtp -q
try() { # SCAN OUTPUT, as Windows writes them, and the OUTPUT here
  windows core "$1" -o "$2" -q </dev/null
  cmp expected.vtp "$3" || fail "$2: the bits are others"
}
mkdir 'Pätient 1 😀'
cp "$data/gyroid.nrrd" 'Pätient 1 😀/Schädel ß 日本.nrrd'
try 'Pätient 1 😀\Schädel ß 日本.nrrd' 'Pätient 1 😀\Größe.vtp' 'Pätient 1 😀/Größe.vtp'
try "Z:${PWD//\//\\}\\Pätient 1 😀\\Schädel ß 日本.nrrd" "z:$PWD/drive.vtp" drive.vtp
long=$(printf 'long%.0s' {1..40})
mkdir -p "$long/$long"
cp "$data/gyroid.nrrd" "$long/$long/$long.nrrd"
try "$long\\$long\\$long.nrrd" "$long\\$long\\out-$long.vtp" "$long/$long/out-$long.vtp"
windows info 'Pätient 1 😀\Schädel ß 日本.nrrd' | grep -q 'Schädel ß 日本' || fail "info does not name the file"

# A batch has a process for each case, and the files of the native one.
mkdir 'scans ü'
cp "$data/gyroid.nrrd" 'scans ü/one.nrrd'
cp "$data/gyroid.nrrd" 'scans ü/two 2.nrrd'
echo no >'scans ü/bad.nrrd'
code=0
windows batch 'scans ü' -o 'batch ß' --memory 4GB -q </dev/null >batch.txt 2>&1 || code=$?
[ "$code" = 1 ] || fail "batch gave exit code $code: $(cat batch.txt)"
"$program" batch 'scans ü' -o expected -q >/dev/null 2>&1 || true
for file in sub-one/sub-one_medial.vtp sub-one/sub-one_skeleton.vtp; do
  cmp "expected/$file" "batch ß/$file" || fail "$file of a batch: the bits are others"
done
cmp <(cut -d, -f1,3 expected/cases.csv) <(cut -d, -f1,3 'batch ß/cases.csv') || fail "the cases are others"
windows batch 'scans ü' -o 'batch ß' </dev/null >batch.txt 2>&1 || true # the bad one fails again
grep -q '2 of them before' batch.txt || fail "a batch begins anew: $(cat batch.txt)"

# A run that lasts, until its temporary files are there.
windows phantom gyroid --size 256 -o large.nrrd -q </dev/null
mkdir stopped
begin_and_kill() { # SIGNAL; a shell's own background processes ignore SIGINT
  /usr/bin/python3 - "$here/windows.sh" "$1" <<'END'
import os, signal, subprocess, sys, time
run = subprocess.Popen(["sh", sys.argv[1], "core", "large.nrrd", "-o", "stopped/core.vtp", "-q"],
                       stdin=subprocess.DEVNULL, stderr=open("messages", "w"))
for _ in range(600):
    if os.listdir("stopped") or run.poll() is not None:
        break
    time.sleep(0.1)
if run.poll() is not None or not os.listdir("stopped"):
    sys.exit("the run was too short, or wrote nothing")
run.send_signal(getattr(signal, sys.argv[2]))
print(run.wait(60))
END
}
code=$(begin_and_kill SIGINT)
[ "$code" = 130 ] || fail "Ctrl-C gave exit code $code: $(cat messages)"
grep -q 'interrupted; nothing was written' messages || fail "Ctrl-C says $(cat messages)"
[ -z "$(ls -A stopped)" ] || fail "Ctrl-C left $(ls -A stopped)"
begin_and_kill SIGKILL >/dev/null
windows core "$data/gyroid.nrrd" -o stopped/other.vtp -q </dev/null
[ "$(ls -A stopped)" = other.vtp ] || fail "a kill left $(ls -A stopped)"
echo "Windows: works"
