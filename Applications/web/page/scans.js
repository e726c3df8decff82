// What was dropped or chosen: files by name, and which of them the program is to open.

/** Reads what a drop holds, folders too. */
export async function filesOfDrop(transfer) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter((entry) => entry);
  if (entries.length === 0) return [...transfer.files].map((file) => ({ name: file.name, data: file }));
  const found = [];
  const look = async (entry) => {
    if (entry.isFile) {
      const file = await new Promise((resolve, reject) => {
        entry.file(resolve, reject);
      });
      found.push({ name: entry.fullPath.replace(/^\//, ''), data: file });
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      // a reader gives some at a time
      const some = await new Promise((resolve, reject) => {
        reader.readEntries(resolve, reject);
      });
      if (some.length === 0) return;
      for (const one of some) await look(one);
    }
  };
  for (const entry of entries) await look(entry);
  return found;
}

export function filesOfInput(input) {
  return [...input.files].map((file) => ({ name: file.webkitRelativePath || file.name, data: file }));
}

const stem = (name) => name.replace(/\.[^./]*$/, '');

/** What among `files` can be opened: files, but not data beside a header of the same name; or the folder of a scan that
 *  is a folder, such as one of slices. */
export function scansAmong(files) {
  const names = files.map(({ name }) => name).filter((name) => !/(^|\/)\./.test(name));
  const headers = new Set(names.filter((name) => /\.(nhdr|mhd|hdr)$/i.test(name)).map(stem));
  const isData = (name) =>
    /\.(raw|zraw|img|bin)(\.gz)?$/i.test(name) && headers.has(stem(name.replace(/\.gz$/i, '')));
  const isNames = (name) => /\.(txt|label|ctab|lut)$/i.test(name); // of labels
  const scans = names.filter((name) => !isData(name) && (!isNames(name) || names.every(isNames)));
  const [folder] = (scans[0] ?? '').split('/');
  const isPart = (name) =>
    name.startsWith(`${folder}/`) && (/\.(png|bmp|jpe?g|tiff?|dcm|ima)$/i.test(name) || !/\.[^/]*$/.test(name));
  const isVolume = files.some(({ name }) => /\/(\.zarray|\.zattrs|zarr\.json|info)$/.test(name));
  return isVolume || (scans.length > 1 && scans.every(isPart)) ? [folder] : scans;
}

/** The name without folder and endings, for results. */
export function baseOf(name) {
  return (
    name
      .replace(/^.*\//, '')
      .replace(
        /(\.seg)?\.(nii|nrrd|nhdr|mha|mhd|tiff?|mgz|mgh|npy|hdr|img|png|stl|obj|ply|off|vtk|vti)(\.gz)?$/i,
        '',
      ) || 'scan'
  );
}
