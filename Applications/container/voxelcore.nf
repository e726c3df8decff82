// Scans through VoxelCore, one process each, in the image.
//   nextflow run Applications/container/voxelcore.nf --scans 'scans/*.nii.gz' --out results -with-apptainer voxelcore.sif
// Further parameters: --options '--tolerance 1.2diag' (of core), --cpus 2, --memory '8 GB'.
// -with-docker or -with-podman take an image's name. A scan that fails is tried again once with twice the memory, and
// then left out; Nextflow names it at the end.
nextflow.enable.dsl = 2

params.scans = null
params.out = 'results'
params.options = ''
params.cpus = 2
params.memory = '4 GB'

process VOXELCORE {
    tag "${scan.simpleName}"
    cpus params.cpus
    memory { (params.memory as nextflow.util.MemoryUnit) * task.attempt }
    errorStrategy { task.attempt < 2 ? 'retry' : 'ignore' }
    publishDir params.out, mode: 'copy'

    input:
    path scan

    output:
    path "${scan.simpleName}/*"

    script:
    def name = scan.simpleName
    """
    mkdir -p '${name}'
    voxelcore core ${scan} -o '${name}/${name}_medial.vtp' --report '${name}/${name}_report.json' --threads ${task.cpus} --quiet ${params.options}
    voxelcore skeleton ${scan} -o '${name}/${name}_skeleton.vtp' --also csv --threads ${task.cpus} --quiet
    voxelcore thickness ${scan} -o '${name}/${name}_thickness.nrrd' --table '${name}/${name}_thickness.csv' --threads ${task.cpus} --quiet
    """
}

workflow {
    if (!params.scans) {
        error "give --scans 'scans/*.nii.gz'"
    }
    VOXELCORE(Channel.fromPath(params.scans, checkIfExists: true))
}
