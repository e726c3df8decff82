# One volume larger than a machine: its blocks as jobs, then the join; the file is that of a single run, bit for bit.
#   snakemake -s Applications/Snakemake/Blocks.smk --profile Applications/Snakemake/slurm --config scan=huge.nrrd out=huge.vtp blocks=8
# Further --config keys: program (voxelcore), reading ("--threshold 300:3000", for blocks and join), options ("--lambda 2vox",
# for the join alone), mem_mb (4000, of a block), first_mem_mb (of the first block, which reads the whole scan: mem_mb),
# join_mem_mb (16000), minutes (120), threads (1).
import shlex

SCAN = str(config["scan"])
OUT = str(config["out"])
N = int(config["blocks"])
PARTS = OUT + ".parts"
CORE = f"{shlex.quote(str(config.get('program', 'voxelcore')))} core {shlex.quote(SCAN)} {config.get('reading', '')}"


localrules: all


rule all:
    input:
        OUT,


def memory(wildcards):
    return int(config.get("first_mem_mb" if wildcards.k == "1" else "mem_mb", config.get("mem_mb", 4000)))


# The first block reads the whole scan and leaves a plan by which the others read only their part of it: they wait. That
# it was done again is no reason to do them again.
rule block:
    input:
        SCAN,
        lambda wildcards: [] if wildcards.k == "1" else ancient(PARTS + "/block-1.done"),
    output:
        touch(PARTS + "/block-{k}.done"),
    threads: int(config.get("threads", 1))
    resources:
        mem_mb=memory,
        runtime=int(config.get("minutes", 120)),
    shell:
        CORE + f" --blocks {N} --block {{wildcards.k}} -o {shlex.quote(PARTS)}/ --threads {{threads}} --force"


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
