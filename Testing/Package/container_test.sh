#!/usr/bin/env bash
# Builds the image of Applications/container/Containerfile on a Debian 12 made by debootstrap, and works in it as a user
# without rights: the bits of the program here, the Python module, a picture. Then the workflows and the Nextflow
# process in the image, by a stand-in for Apptainer that runs what it is told in the image; what the recipes of
# Apptainer and conda say, as far as it can be run without them.
# usage: container_test.sh BUILD_DIR      exit 77: it cannot be done here, with the reason
# VOXELCORE_DEBIAN_MIRROR: another mirror
set -euo pipefail

build=$(realpath "$1")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/container
mirror=${VOXELCORE_DEBIAN_MIRROR:-http://deb.debian.org/debian}
atlas=/usr/share/mricron/templates/JHU-WhiteMatter-labels-2mm.nii.gz
limit=600 # MB
fail() { echo "container_test.sh: $1" >&2; exit 1; }
skip() { echo "container_test.sh: $1" >&2; exit 77; }
[ "$(id -u)" = 0 ] || skip "only root can do without the rights that user namespaces give"
for group in container package cluster; do
  bash "$source/Applications/install-packages.sh" "$group" >/dev/null 2>&1 ||
    skip "the packages of group $group cannot be installed"
done
[ -r "$atlas" ] || skip "mricron-data is not installed"

mkdir -p "$scratch"
# Without user namespaces and without a network of its own; layers as plain folders where they cannot be laid over each
# other.
mkdir -p "$scratch/try/lower" "$scratch/try/upper" "$scratch/try/work" "$scratch/try/all"
export BUILDAH_ISOLATION=chroot STORAGE_DRIVER=vfs
if mount -t overlay overlay "$scratch/try/all" \
  -o "lowerdir=$scratch/try/lower,upperdir=$scratch/try/upper,workdir=$scratch/try/work" 2>/dev/null; then
  umount "$scratch/try/all"
  STORAGE_DRIVER=overlay
fi
storage=(buildah --root "$scratch/store" --runroot "$scratch/run")
box=
leave() {
  [ -z "$box" ] || "${storage[@]}" rm "$box" >/dev/null 2>&1 || true
  # Its files may belong to other users.
  "${storage[@]}" rmi --all --force >/dev/null 2>&1 || true
  rm -rf --one-file-system "$scratch"
}
trap leave EXIT

# Debian 12 as small as the image debian:12-slim: without documents and lists.
debootstrap --variant=minbase bookworm "$scratch/base" "$mirror" >"$scratch/debootstrap.log" 2>&1 ||
  skip "debootstrap has no Debian: $(tail -n 1 "$scratch/debootstrap.log")"
(cd "$scratch/base" && rm -rf usr/share/doc/* usr/share/man/* usr/share/info/* usr/share/locale/* var/cache/apt/* \
  var/lib/apt/lists/* && printf 'path-exclude /usr/share/%s/*\n' doc man info locale >etc/dpkg/dpkg.cfg.d/slim)
box=$("${storage[@]}" from scratch)
"${storage[@]}" add -q "$box" "$scratch/base" / >/dev/null
"${storage[@]}" commit -q "$box" localhost/debian:12-slim >/dev/null
"${storage[@]}" rm "$box" >/dev/null
box=
rm -rf --one-file-system "$scratch/base"

# The Containerfile as it stands, but for where Debian comes from; with this machine's compiler cache.
volumes=()
if command -v ccache >/dev/null; then
  cache=$(ccache --get-config cache_dir)
  mkdir -p "$cache"
  volumes=(--volume "$cache:/root/.cache/ccache")
  [ ! -d "$HOME/.config/ccache" ] || volumes+=(--volume "$HOME/.config/ccache:/root/.config/ccache:ro")
fi
# When its steps are done, buildah takes minutes to remove what they left.
(cd "$source" && "${storage[@]}" bud --build-arg BASE=localhost/debian:12-slim \
  --build-arg OPTIONS=-DVOXELCORE_WERROR=ON --pull-never \
  "${volumes[@]}" -f Applications/container/Containerfile -t voxelcore . >"$scratch/build.log" 2>&1) ||
  { tail -n 30 "$scratch/build.log" >&2; fail "the image cannot be built"; }
box=$("${storage[@]}" from --pull-never localhost/voxelcore)
root=$("${storage[@]}" mount "$box")
size=$(du -sm --one-file-system "$root" | cut -f1)
echo "the image has $size MB"
[ "$size" -lt "$limit" ] || fail "the image has $size MB, over $limit"

# As its user.
data=$scratch/data
mkdir -p "$data"
cp "$atlas" "$data/scan.nii.gz"
chown -R 1000 "$data"
chmod 755 "$scratch"
in_image() { # FOLDER COMMAND...: as a user of the image, in a folder that has the same name there
  local folder=$1
  shift
  "${storage[@]}" run --user voxelcore --volume "$folder:$folder" --workingdir "$folder" "$box" -- "$@"
}
[ "$(in_image "$data" id -u)" = 1000 ] || fail "the image's user has rights"
! in_image "$data" touch /usr/bin/mine 2>/dev/null || fail "the image's user writes where it should not"
entry=$("${storage[@]}" inspect --type image --format '{{.OCIv1.Config.User}} {{.OCIv1.Config.Entrypoint}}' voxelcore)
[ "$entry" = "voxelcore [voxelcore]" ] || fail "user and entry of the image: $entry"
in_image "$data" voxelcore core scan.nii.gz -o core.vtp -q
in_image "$data" voxelcore skeleton scan.nii.gz -o skeleton.vtp -q
in_image "$data" voxelcore thickness scan.nii.gz -o thickness.nrrd --table thickness.csv -q
in_image "$data" voxelcore verify scan.nii.gz core.vtp -q
in_image "$data" voxelcore render core.vtp -o core.png -q
in_image "$data" python3 -c "
import numpy, voxelcore
assert voxelcore.core(numpy.ones((9, 9, 3), bool)).topology == {'euler': 1, 'betti': (1, 0, 0)}"
for name in core.vtp skeleton.vtp thickness.nrrd thickness.csv core.png; do
  [ "$(stat -c %u "$data/$name")" = 1000 ] || fail "$name does not belong to the user"
done
for command in core skeleton; do
  "$build/bin/voxelcore" $command "$data/scan.nii.gz" -o "$scratch/here.vtp" --force -q
  cmp "$scratch/here.vtp" "$data/$command.vtp" || fail "$command: the bits are others in the image"
done
"$build/bin/voxelcore" thickness "$data/scan.nii.gz" -o "$scratch/here.nrrd" --force -q
cmp "$scratch/here.nrrd" "$data/thickness.nrrd" || fail "thickness: the bits are others in the image"

# By podman, as voxelcore.sh calls it; where it may start containers.
cat >"$scratch/storage.conf" <<EOF
[storage]
driver = "$STORAGE_DRIVER"
graphroot = "$scratch/store"
runroot = "$scratch/run"
EOF
cat >"$scratch/containers.conf" <<'EOF'
[containers]
netns = "host"
default_ulimits = ["nofile=1024:1024", "nproc=4096:4096"]
[engine]
runtime = "runc"
cgroup_manager = "cgroupfs"
events_logger = "file"
EOF
by_podman() {
  (cd "$data" && CONTAINERS_STORAGE_CONF=$scratch/storage.conf CONTAINERS_CONF=$scratch/containers.conf \
    VOXELCORE_RUNTIME=podman VOXELCORE_IMAGE=localhost/voxelcore \
    bash "$source/Applications/container/voxelcore.sh" "$@")
}
if by_podman --version >"$scratch/podman.log" 2>&1; then
  by_podman core scan.nii.gz -o by-podman.vtp -q
  cmp "$data/core.vtp" "$data/by-podman.vtp" || fail "podman: the bits are others"
  echo "podman: works"
else
  echo "podman starts no container here: $(tail -n 1 "$scratch/podman.log")"
fi

# A stand-in for Apptainer: it understands what Snakemake and voxelcore.sh say, and runs it in the image; like Apptainer
# as the user who calls.
mkdir -p "$scratch/bin" "$scratch/flow/scans"
cat >"$scratch/bin/apptainer" <<EOF
#!/usr/bin/env bash
set -euo pipefail
[ "\$1" != --version ] || { echo "apptainer version 1.1.9"; exit 0; }
[ "\$1" = exec ] || { echo "stand-in: \$1 is not known" >&2; exit 1; }
shift
where=\$PWD
while [[ "\$1" = -* ]]; do
  case "\$1" in
    --pwd | --home) where=\$2; shift 2 ;;
    --bind) shift 2 ;;
    *) echo "stand-in: \$1 is not known" >&2; exit 1 ;;
  esac
done
[ "\$(basename "\$1")" = voxelcore.sif ] || { echo "stand-in: no image \$1" >&2; exit 1; }
shift
echo "\$*" >>"$scratch/apptainer.log"
exec ${storage[*]} run --user "\$(id -u)" --volume "$scratch/flow:$scratch/flow" --workingdir "\$where" "$box" -- "\$@"
EOF
chmod +x "$scratch/bin/apptainer"
ln -sf apptainer "$scratch/bin/singularity"
cd "$scratch/flow"
touch voxelcore.sif
for ((i = 1; i <= 3; ++i)); do
  "$build/bin/voxelcore" phantom torus --size $((20 + i)) -o "scans/s$i.nrrd" -q
done
printf 'id,scan\none,scans/s1.nrrd\ntwo,scans/s2.nrrd\n' >cohort.csv
export PATH=$scratch/bin:/usr/sbin:/usr/bin:/sbin:/bin BUILDAH_ISOLATION STORAGE_DRIVER
flow() { # WHAT ARGUMENT...
  local what=$1
  shift
  snakemake --nocolor --cores 2 --use-singularity "$@" >"$scratch/$what.log" 2>&1 ||
    { tail -n 30 "$scratch/$what.log" >&2; fail "the workflow $what fails in the image"; }
}
flow cohort -s "$source/Applications/Snakemake/Snakefile" --config manifest=cohort.csv out=results image=voxelcore.sif
[ "$(grep -c ',done,' results/cases.csv)" = 2 ] || fail "the cohort in the image: $(cat results/cases.csv)"
"$build/bin/voxelcore" batch cohort.csv -o here -q
cmp here/sub-one/sub-one_medial.vtp results/sub-one/sub-one_medial.vtp ||
  fail "the cohort's bits are others in the image"
flow blocks -s "$source/Applications/Snakemake/Blocks.smk" \
  --config scan=scans/s3.nrrd out=joined.vtp blocks=2 image=voxelcore.sif options="--lambda 1vox"
"$build/bin/voxelcore" core scans/s3.nrrd -o single.vtp --lambda 1vox -q
cmp single.vtp joined.vtp || fail "the joined file is not that of a single run"
[ "$(grep -c 'voxelcore core\|batch' "$scratch/apptainer.log")" -ge 5 ] || fail "the jobs did not run in the image"

# What Nextflow's process would run, with its variables filled in.
mkdir nextflow
cp scans/s1.nrrd nextflow/
sed -n '/^    """$/,/^    """$/p' "$source/Applications/container/voxelcore.nf" | sed '/"""/d' |
  sed 's/\${name}/s1/g; s/\${scan}/s1.nrrd/g; s/\${task.cpus}/1/g; s/\${params.options}//g' >nextflow/script.sh
[ "$(grep -c voxelcore nextflow/script.sh)" = 3 ] || fail "the Nextflow process has other commands"
! grep -q '\$' nextflow/script.sh || fail "variables of the Nextflow process: $(grep '\$' nextflow/script.sh)"
(cd nextflow && apptainer exec voxelcore.sif bash -euo pipefail script.sh) ||
  fail "the Nextflow process's commands fail"
[ -s nextflow/s1/s1_thickness.csv ] && [ -s nextflow/s1/s1_skeleton_branches.csv ] ||
  fail "the Nextflow process's files"

# The Apptainer recipe takes the steps of the Containerfile, word for word.
steps() { grep -o 'bash /[a-z/]*build.sh .*' "$1" | sed 's/ \${OPTIONS}$//'; }
recipes=$source/Applications/container
[ "$(steps "$recipes/voxelcore.def")" = "$(steps "$recipes/Containerfile")" ] ||
  fail "voxelcore.def and Containerfile take other steps"
echo "container: works"
