#pragma once
// Which options change a result: the one list from which they are read off a command line, written into reports and
// files, and read back. A field's name is its option's, with underscores for dashes.

namespace voxelcore
{

/** Calls visit(name, field) for each field of `options.reading`, `options.resolution` and `options.edits`, in the order
 *  in which reports have them. `options` is what a job was asked for or the record of one. */
template <typename TOptions, typename TVisit>
void
VisitScanFields(TOptions & options, TVisit && visit)
{
  visit("binary", options.reading.binary);
  visit("threshold", options.reading.threshold);
  visit("volume", options.reading.volume);
  visit("component", options.reading.component);
  visit("level", options.reading.level);
  visit("raw", options.reading.raw);
  visit("dataset", options.reading.dataset);
  visit("spacing", options.reading.spacing);
  visit("resolution", options.resolution);
  visit("cap", options.reading.mesh.cap);
  visit("cover", options.reading.mesh.cover);
  visit("orthonormalize", options.reading.orthonormalize);
  visit("nifti_form", options.reading.niftiForm);
  visit("crop", options.reading.crop);
  visit("median", options.edits.median);
  visit("denoise", options.edits.denoise);
  visit("mend_shape", options.edits.mend);
  visit("close", options.edits.close);
  visit("fill_hollows", options.edits.fillHollows);
  visit("fill_slices", options.edits.fillSlices);
  visit("connectivity", options.edits.connectivity);
  visit("fill_cavities", options.edits.fillCavities);
  visit("min_voxels", options.edits.minVoxels);
  visit("largest", options.edits.largest);
  visit("smooth_shape", options.edits.smooth);
  visit("simplify_topology", options.edits.simplify);
  visit("pieces", options.edits.topology.pieces);
  visit("loops", options.edits.topology.loops);
  visit("cavities", options.edits.topology.cavities);
  visit("change_voxels", options.edits.change);
  visit("split_components", options.edits.splitComponents);
}

/** The same of how a model is written. */
template <typename TModel, typename TVisit>
void
VisitModelFields(TModel & model, TVisit && visit)
{
  visit("triangles", model.triangles);
  visit("keep_edges", model.keepEdges);
}

} // namespace voxelcore
