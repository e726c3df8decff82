# One volume larger than a machine: its blocks as jobs, then the join; the file is that of a single run, bit for bit.
#   snakemake -s Applications/Snakemake/Blocks.smk --profile Applications/Snakemake/slurm --config scan=huge.nrrd out=huge.vtp blocks=8
# Of a scan that no machine shall read whole, cut by its size alone (one shape: reading="--binary", say):
#   ... --config scan=huge.zarr out=huge.vtp size=16384,16384,16384 block_size=512 reading=--binary
# and the blocks alone, without the join, with `snakemake ... blocks`.
# With image=voxelcore.sif and --use-singularity jobs run in an image (Applications/container).
# Further --config keys: program (voxelcore), reading ("--threshold 300:3000", for blocks and join), options ("--lambda 2vox",
# for the join alone), mem_mb (4000, of a block), first_mem_mb (of the first block, which reads the whole scan: mem_mb),
# join_mem_mb (16000), minutes (120), threads (1).
import os
import shlex


SCAN = str(config["scan"])
OUT = str(config["out"])
if set("{}") & set(SCAN + OUT):
    raise WorkflowError(f"{SCAN}, {OUT}: Snakemake takes braces in file names for names of its own; rename the file")
if "block_size" in config:
    SIDE = int(config["block_size"])
    N = 1
    for length in str(config["size"]).replace("x", ",").split(","):
        N *= -(-int(length) // SIDE)
    CUT = f"--block-size {SIDE}"
else:
    N = int(config["blocks"])
    CUT = f"--blocks {N}"
WAIT = "block_size" not in config
PARTS = OUT + ".parts"
CORE = f"{shlex.quote(str(config.get('program', 'voxelcore')))} core {shlex.quote(SCAN)} {config.get('reading', '')}"


if "image" in config:

    container: os.path.abspath(config["image"]) if os.path.exists(str(config["image"])) else str(config["image"])


localrules: all, blocks


rule all:
    input:
        OUT,


rule blocks:
    input:
        expand(PARTS + "/block-{k}.done", k=range(1, N + 1)),


def memory(wildcards):
    return int(config.get("first_mem_mb" if WAIT and wildcards.k == "1" else "mem_mb", config.get("mem_mb", 4000)))


# The first block reads the whole scan and leaves a plan by which the others read only their part of it: they wait. That
# it was done again is no reason to do them again. Of a scan cut by its size each block reads its part.
rule block:
    input:
        SCAN,
        lambda wildcards: [] if wildcards.k == "1" or not WAIT else ancient(PARTS + "/block-1.done"),
    output:
        touch(PARTS + "/block-{k}.done"),
    threads: int(config.get("threads", 1))
    resources:
        mem_mb=memory,
        runtime=int(config.get("minutes", 120)),
    shell:
        CORE + f" {CUT} --block {{wildcards.k}} -o {shlex.quote(PARTS)}/ --threads {{threads}} --force"


rule join:
    input:
        SCAN,
        expand(PARTS + "/block-{k}.done", k=range(1, N + 1)),
    output:
        OUT,
    threads: int(config.get("threads", 1))
    resources:
        mem_mb=int(config.get("join_mem_mb", 16000)),
        runtime=int(config.get("minutes", 120)),
    shell:
        CORE + f" --join {shlex.quote(PARTS)} -o {{output:q}} --threads {{threads}} {config.get('options', '')}"
