#!/usr/bin/env bash
# A cohort through a real SLURM with one node, on the loopback address, with a munge of its own: once as an array job,
# once by Snakemake; and one volume in blocks. 20 small scans, one that is no scan and one that needs more memory than
# its job has.
# usage: cluster_test.sh PROGRAM SOURCE     exit code 77: cannot be done here, with the reason
set -euo pipefail
program=$1 source=$2

skip() { echo "skipped: $1"; exit 77; }
[ "$(id -u)" -eq 0 ] || skip "starting slurmd needs root"
bash "$source/Applications/install-packages.sh" cluster >/dev/null 2>&1 ||
  skip "the packages of group cluster cannot be installed"
for tool in munged slurmctld slurmd sbatch snakemake python3; do
  command -v "$tool" >/dev/null || skip "there is no $tool"
done

work=$(mktemp -d)
chmod 755 "$work"
pids=()
finish() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap finish EXIT
fail() {
  echo "FAILED: $1" >&2
  tail -n 20 "$work"/*.log >&2 || true
  exit 1
}

# A munge of our own, whose keys and socket lie in the test's folder.
mkdir -p "$work/munge" "$work/state" "$work/spool"
dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
chmod 700 "$work/munge"
chmod 400 "$work/munge/key"
munged --foreground --force --num-threads=2 --key-file="$work/munge/key" --socket="$work/munge/socket" \
  --pid-file="$work/munge/pid" --seed-file="$work/munge/seed" --log-file="$work/munge/log" >"$work/munged.log" 2>&1 &
pids+=($!)

free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }
host=$(hostname -s)
cat >"$work/slurm.conf" <<EOF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=2000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=60 State=UP
EOF
export SLURM_CONF="$work/slurm.conf"
for ((i = 0; i < 100; ++i)); do [ -S "$work/munge/socket" ] && break; sleep 0.1; done
slurmctld -D >"$work/slurmctld.out.log" 2>&1 &
pids+=($!)
slurmd -D >"$work/slurmd.out.log" 2>&1 &
pids+=($!)
for ((i = 0; i < 300; ++i)); do
  sinfo -h -o %T 2>/dev/null | grep -q idle && break
  sleep 0.1
done
sinfo -h -o %T 2>/dev/null | grep -q idle || fail "SLURM does not come up"
echo "SLURM $(sinfo --version | cut -d' ' -f2) on $host"

# 20 scans: 18 small ones, one broken, one whose work takes some 400 MB.
mkdir "$work/scans"
cd "$work"
echo "id,scan" >cohort.csv
kinds=(ellipsoid torus tanglecube)
for ((i = 1; i <= 18; ++i)); do
  "$program" phantom "${kinds[i % 3]}" --size $((20 + i)) -o "scans/s$i.nrrd" --quiet
  echo "s$i,scans/s$i.nrrd" >>cohort.csv
done
echo "this is no scan" >scans/broken.nrrd
"$program" phantom gyroid --size 160 -o scans/large.nrrd --quiet
echo "broken,scans/broken.nrrd" >>cohort.csv
echo "large,scans/large.nrrd" >>cohort.csv

# What both ways must leave.
check() {
  local out=$1
  python3 - "$out" <<'EOF' || fail "$out is not as it should be"
import csv, json, os, sys
out = sys.argv[1]
rows = {row["id"]: row for row in csv.DictReader(open(f"{out}/cases.csv"))}
assert len(rows) == 20, len(rows)
failed = {name: row["reason"] for name, row in rows.items() if row["status"] != "done"}
assert set(failed) == {"broken", "large"}, failed
assert "NRRD" in failed["broken"], failed
assert "killed" in failed["large"], failed
labels = list(csv.DictReader(open(f"{out}/labels.csv")))
assert len(labels) == 18, len(labels)
for row in labels:
    report = json.load(open(f"{out}/{row['folder']}/{row['folder']}_report.json"))
    assert float(row["volume_mm3"]) == report["labels"][0]["volume_mm3"]
assert os.path.getsize(f"{out}/index.html") > 5000
print(f"{out}: 18 done; " + "; ".join(f"{name}: {reason}" for name, reason in sorted(failed.items())))
EOF
}

# 1. An array job. The memory of a job is less than the large case takes; it must cost only itself.
job=$(VOXELCORE=$program sbatch --parsable --array=1-20 --mem=150M \
  "$source/Applications/Snakemake/array.sbatch" cohort.csv array \
  --memory 2GB)
for ((i = 0; i < 1200; ++i)); do
  [ -z "$(squeue -h -j "$job" 2>/dev/null)" ] && break
  sleep 0.25
done
"$program" batch cohort.csv -o array --gather >gather.log 2>&1 && fail "the gathering did not tell of the failures"
check array

# 2. The same manifest by Snakemake, on SLURM. Each job holds a Snakemake, too.
if snakemake -s "$source/Applications/Snakemake/Snakefile" --profile "$source/Applications/Snakemake/slurm" --nocolor \
  --latency-wait 5 --config manifest=cohort.csv out=flow program="$program" mem_mb=300 minutes=5 \
  options="--memory 2GB" \
  >snakemake.log 2>&1; then
  fail "the workflow did not tell of the failures"
fi
check flow

# 3. One volume in blocks, each a job.
"$program" core scans/s18.nrrd -o single.vtp --lambda 1vox --quiet
snakemake -s "$source/Applications/Snakemake/Blocks.smk" --profile "$source/Applications/Snakemake/slurm" \
  --nocolor --latency-wait 5 \
  --config scan=scans/s18.nrrd out=joined.vtp blocks=3 program="$program" mem_mb=150 join_mem_mb=150 minutes=5 \
  options="--lambda 1vox" >blocks.log 2>&1 || fail "the blocks' workflow failed"
cmp single.vtp joined.vtp || fail "the joined file is not that of a single run"
[ -e joined.vtp.parts/s18_blocks-3.vcp ] || fail "the first block left no plan"
for k in 2 3; do
  [ joined.vtp.parts/block-1.done -ot joined.vtp.parts/block-$k.done ] || fail "block $k did not wait for the plan"
done
echo "blocks: the joined file is that of a single run"

# 4. What the guide says, word for word but for the memory of a job, which this node has not.
mkdir readme bin
ln -s "$program" bin/voxelcore
ln -s "$source/Applications" readme/Applications
cp scans/s1.nrrd scans/s2.nrrd readme/
cd readme
printf 'id,scan\none,s1.nrrd\ntwo,s2.nrrd\n' >cohort.csv
export PATH=$work/bin:$PATH SBATCH_MEM_PER_NODE=500M
line=$(sed -n 's/^    \(sbatch .*\)/\1/p' "$source/Applications/manual/guide/cohorts.md")
[ "$(wc -l <<<"$line")" = 1 ] && [ -n "$line" ] || fail "the guide has not one line of sbatch"
bash -euc "$line" >sbatch.log || fail "the guide: $line"
for ((i = 0; i < 1200; ++i)); do
  [ -z "$(squeue -h 2>/dev/null)" ] && break
  sleep 0.25
done
cohorts=$source/Applications/manual/guide/cohorts.md
bash -euc "$(sed -n 's/^    \(voxelcore batch .* --gather\).*/\1/p' "$cohorts")" >gather.log ||
  fail "the guide: --gather"
[ "$(grep -c ',done,' results/cases.csv)" = 2 ] || fail "the guide's array job: $(cat results/cases.csv)"
rm -r results
# The first; the one after it asks for an image.
line=$(sed -n '/^    snakemake .*\\$/,/[^\\]$/p' "$cohorts" | sed '/[^\\]$/q' | sed 's/mem_mb=[0-9]*/mem_mb=500/')
[ -n "$line" ] || fail "the guide has no line of snakemake"
bash -euc "$line --nocolor --latency-wait 5" >snakemake.log 2>&1 || { cat snakemake.log >&2; fail "the guide: $line"; }
[ "$(grep -c ',done,' results/cases.csv)" = 2 ] || fail "the guide's workflow: $(cat results/cases.csv)"
echo "the guide: its array job and its workflow run"
