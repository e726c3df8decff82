// Meshes that the program wrote, as the viewer of the offline page takes them: a description in JSON, and numbers in
// base64 (PageModel.cxx says what each means). All triangles are shown.

const kMost = 65534; // codes of values run from 0 to this; 65535: none

class Numbers {
  parts = [];
  bytes = 0;

  add(values) {
    const at = this.bytes;
    this.parts.push([at, values]);
    this.bytes = Math.ceil((at + values.byteLength) / 4) * 4;
    return [at, values.length, values.BYTES_PER_ELEMENT];
  }

  indices(values, points) {
    return this.add(points <= 65536 ? Uint16Array.from(values) : Uint32Array.from(values));
  }

  all() {
    const whole = new Uint8Array(this.bytes);
    for (const [at, values] of this.parts) {
      whole.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), at);
    }
    return whole;
  }
}

function adler32(bytes) {
  let a = 1;
  let b = 0;
  for (let at = 0; at < bytes.length;) {
    for (const end = Math.min(at + 3800, bytes.length); at < end; ++at) {
      // no sum leaves 32 bits
      a += bytes[at];
      b += a;
    }
    a %= 65521;
    b %= 65521;
  }
  return b * 65536 + a;
}

function base64(bytes) {
  const kPiece = 3 * 8192;
  let text = '';
  for (let at = 0; at < bytes.length; at += kPiece) {
    text += btoa(String.fromCharCode(...bytes.subarray(at, at + kPiece)));
  }
  return text;
}

/** Least and greatest, and the 2nd and 98th percentile, of what is finite; null where nothing is. */
export function rangeOf(lists) {
  let count = 0;
  for (const values of lists) for (const value of values) if (Number.isFinite(value)) ++count;
  if (count === 0) return null;
  const sorted = new Float64Array(count);
  let to = 0;
  for (const values of lists) for (const value of values) if (Number.isFinite(value)) sorted[to++] = value;
  sorted.sort();
  const at = (part) => sorted[Math.round(part * (count - 1))];
  return { low: at(0.02), high: at(0.98), least: sorted[0], greatest: sorted[count - 1] };
}

/** Lengths at the points of a mesh; of vectors theirs. */
function lengthsOf(mesh) {
  const found = {};
  for (const [name, values] of Object.entries(mesh.pointArrays)) {
    const size = mesh.components[name] ?? 1;
    if (size === 1) {
      found[name] = values;
    } else {
      found[name] = Float64Array.from({ length: values.length / size }, (_, i) =>
        Math.hypot(...values.subarray(size * i, size * i + size)),
      );
    }
  }
  return found;
}

/** The cells of each label: {verts: [cell, ...], lines, polys}, by number; the first of all is cell 0. */
function cellsByLabel(mesh) {
  const labels = mesh.cellArrays.Label;
  const found = new Map();
  let first = 0;
  for (const kind of ['verts', 'lines', 'polys']) {
    const count = mesh[kind].offsets.length - 1;
    for (let i = 0; i < count; ++i) {
      const label = labels ? labels[first + i] : 1;
      if (!found.has(label)) found.set(label, { verts: [], lines: [], polys: [] });
      found.get(label)[kind].push(i);
    }
    first += count;
  }
  return found;
}

/** One label's part of a mesh: its points, numbered anew, and what is drawn over them. */
function shownPart(mesh, cells, kind) {
  const number = new Map();
  const origin = [];
  const point = (old) => {
    let found = number.get(old);
    if (found === undefined) {
      found = origin.length;
      number.set(old, found);
      origin.push(old);
    }
    return found;
  };
  const corners = (of, i) =>
    Array.from(mesh[of].connectivity.subarray(mesh[of].offsets[i], mesh[of].offsets[i + 1]), point);
  const heights = kind === 'medial' ? mesh.cellArrays.Tolerance : undefined;
  const firstLine = mesh.verts.offsets.length - 1;
  const firstPoly = firstLine + mesh.lines.offsets.length - 1;
  const shown = { origin, triangles: [], segments: [], lines: [], offsets: [0], dots: [] };
  const of = { triangles: [], segments: [], dots: [], covers: [] };
  const cover = new Map(); // of an edge: the greatest height of the faces on it
  const key = (a, b) => (a < b ? a * 0x4000000 + b : b * 0x4000000 + a);
  for (const i of cells.polys) {
    const face = corners('polys', i);
    const height = heights?.[firstPoly + i] ?? Infinity;
    for (let k = 2; k < face.length; ++k) {
      shown.triangles.push(face[0], face[k - 1], face[k]);
      of.triangles.push(height);
    }
    for (let k = 0; k < face.length; ++k) {
      const edge = key(face[k], face[(k + 1) % face.length]);
      cover.set(edge, Math.max(cover.get(edge) ?? -Infinity, height));
    }
  }
  for (const i of cells.lines) {
    const line = corners('lines', i);
    if (kind === 'curves') {
      shown.lines.push(...line);
      shown.offsets.push(shown.lines.length);
    } else {
      for (let k = 1; k < line.length; ++k) {
        const over = cover.get(key(line[k - 1], line[k])) ?? -Infinity;
        if (!heights && over > -Infinity) continue;
        shown.segments.push(line[k - 1], line[k]);
        of.segments.push(heights?.[firstLine + i] ?? Infinity);
        of.covers.push(over);
      }
    }
  }
  for (const i of cells.verts) {
    for (const dot of corners('verts', i)) {
      shown.dots.push(dot);
      of.dots.push(heights?.[i] ?? Infinity);
    }
  }
  return { ...shown, heights: heights && of };
}

const kNames = {
  Tolerance: 'Tolerance',
  RadiusMargin: 'Radius margin',
  Displacement: 'Displacement',
  SectionRadius: 'Section radius',
  MaximumInscribedSphereRadius: 'Inscribed radius',
};

/** A colour for each label, by its place among those of the scan: hues by the golden angle, as branches have them. */
export function colorOf(index) {
  const hue = (160 + index * 137.508) % 360;
  const light = [0.45, 0.55, 0.36][index % 3];
  const spread = 0.75 * Math.min(light, 1 - light);
  return [0, 8, 4].map((n) => {
    const k = (n + hue / 30) % 12;
    return light - spread * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  });
}

function unitsOf(unit) {
  if (unit !== 'mm') return [{ name: 'vox', size: 1, from: 0 }];
  return [
    { name: 'mm', size: 1, from: 0.1 },
    { name: 'µm', size: 1e-3, from: 1e-4 },
    { name: 'nm', size: 1e-6, from: 0 },
  ];
}

/**
 * @param {{kind: 'medial'|'curves', mesh: object}[]} meshes
 * @param {{title: string, names: Map<number, string>, colors: (label: number) => number[], map: string[], voxel: number}}
 *   about voxel: least spacing of the scan; 0 where the curves are not edited
 * @returns {{json: string, numbers: string}} what stands in the elements `model` and `data` of the viewer's page
 */
export function pageModel(meshes, { title, names, colors, map, voxel }) {
  const numbers = new Numbers();
  const each = meshes.map(({ kind, mesh }) => ({ kind, mesh, lengths: lengthsOf(mesh), cells: cellsByLabel(mesh) }));
  const ranges = {};
  for (const name of new Set(each.flatMap(({ lengths }) => Object.keys(lengths)))) {
    const range = rangeOf(each.filter(({ lengths }) => lengths[name]).map(({ lengths }) => lengths[name]));
    if (range) ranges[name] = range;
  }
  const order = ['Radius', 'Lambda', 'ErosionThickness', 'Thickness'];
  const arrays = [
    ...order.filter((name) => ranges[name]),
    ...Object.keys(ranges).filter((name) => !order.includes(name)),
  ];
  const code = ({ least, greatest }, value) =>
    Number.isFinite(value)
      ? Math.round(
          ((Math.min(Math.max(value, least), greatest) - least) / Math.max(greatest - least, 1e-300)) * kMost,
        )
      : 65535;
  const whole = new Set(each.flatMap(({ cells }) => [...cells.keys()]));
  let triangles = 0;
  const labels = [...whole]
    .sort((a, b) => a - b)
    .map((label) => {
      const made = { name: names.get(label) ?? `label-${label}`, label, color: colors(label), ranges: {} };
      const own = {};
      for (const { kind, mesh, lengths, cells } of each) {
        if (!cells.has(label)) continue;
        const part = shownPart(mesh, cells.get(label), kind);
        const { origin } = part;
        if (origin.length === 0) continue;
        triangles += part.triangles.length / 3;
        const low = [0, 1, 2].map((k) =>
          origin.reduce((least, i) => Math.min(least, mesh.points[3 * i + k]), Infinity),
        );
        const high = [0, 1, 2].map((k) =>
          origin.reduce((most, i) => Math.max(most, mesh.points[3 * i + k]), -Infinity),
        );
        const points = new Uint16Array(3 * origin.length);
        origin.forEach((old, i) => {
          for (let k = 0; k < 3; ++k) {
            const side = high[k] > low[k] ? high[k] - low[k] : 1;
            points[3 * i + k] = Math.round(((mesh.points[3 * old + k] - low[k]) / side) * 65535);
          }
        });
        const shown = { low, high, points: numbers.add(points) };
        for (const name of ['triangles', 'segments', 'lines', 'dots'])
          shown[name] = numbers.indices(part[name], origin.length);
        shown.offsets = numbers.add(Uint32Array.from(part.offsets));
        shown.values = {};
        for (const name of arrays) {
          if (!lengths[name]) continue;
          const values = origin.map((i) => lengths[name][i]);
          shown.values[name] = numbers.add(Uint16Array.from(values, (value) => code(ranges[name], value)));
          (own[name] ??= []).push(values);
        }
        if (part.heights && ranges.Tolerance) {
          const codes = (values) => numbers.add(Uint16Array.from(values, (value) => code(ranges.Tolerance, value)));
          const { triangles: faces, segments, dots, covers } = part.heights;
          shown.heights = {
            triangles: codes(faces),
            segments: codes(segments),
            dots: codes(dots),
            // 0: on no face
            covers: numbers.add(
              Uint16Array.from(covers, (value) =>
                value === -Infinity ? 0 : Math.min(code(ranges.Tolerance, value), kMost) + 1,
              ),
            ),
          };
        }
        if (kind === 'curves') {
          const ids = mesh.cellArrays.BranchId;
          const first = mesh.verts.offsets.length - 1;
          shown.numbers = cells.get(label).lines.map((i) => (ids ? ids[first + i] : i));
          shown.names = shown.numbers.map((branch) => `branch ${branch}`);
        }
        made[kind] = shown;
      }
      for (const [name, lists] of Object.entries(own)) made.ranges[name] = rangeOf(lists) ?? ranges[name];
      return made;
    });
  const bytes = numbers.all();
  const { fields } = each[0].mesh;
  const model = {
    title,
    anatomical: fields.SPACE?.[0] === 'LPS',
    byLabel: labels.length > 1,
    voxel,
    groups: '',
    axes: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
    units: unitsOf(fields.Units?.[0] ?? 'mm'),
    bytes: bytes.length,
    adler32: adler32(bytes),
    map,
    names: kNames,
    ranges: Object.fromEntries(arrays.map((name) => [name, ranges[name]])),
    ownRanges: [],
    triangles,
    allTriangles: triangles,
    labels,
  };
  return { json: JSON.stringify(model).replaceAll('<', '\\u003c'), numbers: base64(bytes) };
}

/** The whole page: a file that shows the model by itself, offline. */
export function pageOf(template, { json, numbers }) {
  return template.replace('@MODEL@', () => json).replace('@DATA@', () => numbers);
}
