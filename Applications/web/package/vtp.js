// Reads a .vtp that the program wrote: its arrays are compressed blocks behind the header.

const kinds = {
  Float64: Float64Array, Float32: Float32Array, Int64: BigInt64Array, Int32: Int32Array, UInt8: Uint8Array,
};

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** An array of numbers or a text, from the blocks that begin at `at`. */
async function unpack(bytes, at) {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const number = (index) => Number(view.getBigUint64(at + 8 * index, true));
  const [count, size, last] = [number(0), number(1), number(2)];
  const blocks = [];
  for (let block = 0, from = at + 8 * (3 + count); block < count; ++block) {
    const length = number(3 + block);
    blocks.push(inflate(bytes.subarray(from, from + length)));
    from += length;
  }
  const whole = new Uint8Array(count === 0 ? 0 : (count - (last > 0 ? 1 : 0)) * size + last);
  let to = 0;
  for (const block of await Promise.all(blocks)) {
    whole.set(block, to);
    to += block.length;
  }
  return whole;
}

/** Pages work with plain numbers: whole ones that do not fit 32 bits are labels, and exact as doubles, too. */
function plain(values) {
  if (!(values instanceof BigInt64Array)) return values;
  const fits = values.every((value) => value >= -0x80000000n && value <= 0x7fffffffn);
  return fits ? Int32Array.from(values, Number) : Float64Array.from(values, Number);
}

/**
 * @param {Uint8Array} bytes
 * @returns {Promise<import('./index.js').Mesh>}
 */
export async function readVtp(bytes) {
  const marker = new TextEncoder().encode('<AppendedData');
  let data = 0;
  while (data < bytes.length && !marker.every((byte, index) => bytes[data + index] === byte)) ++data;
  const start = bytes.indexOf(95, data) + 1; // '_'
  if (data >= bytes.length || start === 0) throw new Error('not a .vtp that VoxelCore wrote');
  const header = new TextDecoder().decode(bytes.subarray(0, data));
  const mesh = { points: new Float64Array(0), pointArrays: {}, cellArrays: {}, fields: {}, components: {} };
  const sections = { PointData: mesh.pointArrays, CellData: mesh.cellArrays, FieldData: mesh.fields };
  for (const name of ['Verts', 'Lines', 'Polys']) {
    mesh[name.toLowerCase()] = { offsets: new Int32Array([0]), connectivity: new Int32Array(0) };
  }
  let section = '';
  for (const [, tag, rest] of header.matchAll(/<(\w+)([^>]*)>/g)) {
    if (tag !== 'DataArray' && tag !== 'Array') {
      section = tag;
      continue;
    }
    const attribute = (name) => new RegExp(`\\b${name}="([^"]*)"`).exec(rest)?.[1];
    const raw = await unpack(bytes, start + Number(attribute('offset')));
    const name = attribute('Name');
    const type = attribute('type');
    const values = type === 'String'
      ? new TextDecoder().decode(raw).replace(/\0$/, '').split('\0')
      : plain(new kinds[type](raw.buffer, 0, raw.length / kinds[type].BYTES_PER_ELEMENT));
    if (section === 'Points') {
      mesh.points = values;
    } else if (section === 'Verts' || section === 'Lines' || section === 'Polys') {
      const cells = mesh[section.toLowerCase()];
      cells[name] = name === 'offsets' ? Int32Array.from([0, ...values]) : values;
    } else if (sections[section]) {
      sections[section][name] = values;
      const components = Number(attribute('NumberOfComponents') ?? 1);
      if (components > 1) mesh.components[name] = components;
    }
  }
  return mesh;
}
