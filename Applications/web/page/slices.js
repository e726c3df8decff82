// Three slices of the scan through one place, and what they cut of the result.

const kNames = ['x', 'y', 'z'];
const kEnds = [
  ['R', 'L'],
  ['A', 'P'],
  ['I', 'S'],
]; // against and along x, y, z of LPS
const kNear = 0.75; // voxels: how far from a slice a curve is still drawn

/** Which array axis runs mostly along x, y, z of the scan's space, and which way: each is taken once. */
export function axesOfSpace(axes) {
  const left = new Set([0, 1, 2]);
  const pairs = axes.flatMap((way, axis) => {
    const length = Math.hypot(...way);
    return way.map((part, space) => ({ axis, space, part: part / length }));
  });
  pairs.sort((a, b) => Math.abs(b.part) - Math.abs(a.part));
  const found = [];
  for (const { axis, space, part } of pairs) {
    if (found[space] || !left.has(axis)) continue;
    found[space] = { axis, sign: part < 0 ? -1 : 1 };
    left.delete(axis);
  }
  return found;
}

/** The inverse of a matrix whose columns are `axes`, by rows. */
function inverseOf([a, b, c]) {
  const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const rows = [cross(b, c), cross(c, a), cross(a, b)];
  const volume = a.reduce((sum, part, k) => sum + part * rows[0][k], 0);
  return rows.map((row) => row.map((part) => part / volume));
}

/** A mesh's lines that are on no face, as cells. */
export function freeLines({ polys, lines }) {
  const key = (a, b) => (a < b ? a * 0x4000000 + b : b * 0x4000000 + a);
  const onFaces = new Set();
  for (let cell = 0; cell + 1 < polys.offsets.length; ++cell) {
    let last = polys.connectivity[polys.offsets[cell + 1] - 1];
    for (let i = polys.offsets[cell]; i < polys.offsets[cell + 1]; ++i) {
      onFaces.add(key(last, polys.connectivity[i]));
      last = polys.connectivity[i];
    }
  }
  const free = { offsets: [0], connectivity: [] };
  for (let cell = 0; cell + 1 < lines.offsets.length; ++cell) {
    for (let i = lines.offsets[cell] + 1; i < lines.offsets[cell + 1]; ++i) {
      const [a, b] = [lines.connectivity[i - 1], lines.connectivity[i]];
      if (!onFaces.has(key(a, b))) free.offsets.push(free.connectivity.push(a, b));
    }
  }
  return free;
}

/** What plane `axis` = `at` cuts of a mesh whose points are in voxels, and lines near it: pairs of points. */
export function cut(points, { polys, lines }, axis, at) {
  const segments = [];
  const height = (i) => points[3 * i + axis] - at;
  const between = (i, j) => {
    const part = height(i) / (height(i) - height(j));
    return [0, 1, 2].map((k) => points[3 * i + k] + part * (points[3 * j + k] - points[3 * i + k]));
  };
  for (let cell = 0; cell + 1 < polys.offsets.length; ++cell) {
    const first = polys.offsets[cell];
    const end = polys.offsets[cell + 1];
    let last = polys.connectivity[end - 1];
    let begun = null;
    for (let i = first; i < end; ++i) {
      const next = polys.connectivity[i];
      if (height(last) < 0 !== height(next) < 0) {
        const crossing = between(last, next);
        if (begun) {
          segments.push([begun, crossing]);
          begun = null;
        } else {
          begun = crossing;
        }
      }
      last = next;
    }
  }
  for (let cell = 0; cell + 1 < lines.offsets.length; ++cell) {
    for (let i = lines.offsets[cell] + 1; i < lines.offsets[cell + 1]; ++i) {
      const [a, b] = [lines.connectivity[i - 1], lines.connectivity[i]];
      if (Math.min(Math.abs(height(a)), Math.abs(height(b))) <= kNear || height(a) < 0 !== height(b) < 0) {
        segments.push([a, b].map((corner) => [0, 1, 2].map((k) => points[3 * corner + k])));
      }
    }
  }
  return segments;
}

export class Slices {
  /** @param onPlace is told of each place that is chosen here, in the scan's space */
  constructor(section, onPlace) {
    this.section = section;
    this.onPlace = onPlace;
    this.says = section.querySelector('#place');
    this.planes = [2, 1, 0].map((across) => this.#plane(section.querySelector('#planes'), across));
    new ResizeObserver(() => this.#draw()).observe(section);
  }

  #plane(parent, across) {
    const figure = document.createElement('figure');
    const canvas = Object.assign(document.createElement('canvas'), { width: 1, height: 1 });
    const caption = document.createElement('figcaption');
    const slider = Object.assign(document.createElement('input'), { type: 'range', min: 0, value: 0 });
    slider.setAttribute('aria-label', `Slice across ${kNames[across]}`);
    slider.id = `across-${kNames[across]}`;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `Slice across ${kNames[across]}`);
    caption.append(`Across ${kNames[across]}`, slider);
    figure.append(canvas, caption);
    parent.append(figure);
    const plane = { across, canvas, slider, sheet: document.createElement('canvas') };
    slider.addEventListener('input', () => {
      this.at[this.space[across].axis] = Number(slider.value);
      this.#moved();
    });
    const point = (event) => {
      if (!this.scan || !plane.toVoxel) return;
      const box = canvas.getBoundingClientRect();
      plane.toVoxel(event.clientX - box.left, event.clientY - box.top).forEach(([axis, value]) => {
        this.at[axis] = Math.min(Math.max(Math.round(value), 0), this.scan.size[axis] - 1);
      });
      this.#moved();
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      slider.focus({ preventScroll: true }); // keys and the wheel then go through the slices
      point(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) point(event);
    });
    canvas.addEventListener(
      'wheel',
      (event) => {
        if (document.activeElement !== slider) return; // the page scrolls
        event.preventDefault();
        slider.value = Number(slider.value) - Math.sign(event.deltaY);
        slider.dispatchEvent(new Event('input'));
      },
      { passive: false },
    );
    return plane;
  }

  hide() {
    this.scan = null;
    this.cuts = [];
    this.section.hidden = true;
  }

  /** Words in place of slices. */
  tell(words) {
    this.hide();
    this.section.hidden = false;
    this.section.querySelector('#planes').hidden = true;
    this.says.textContent = words;
  }

  /**
   * @param {import('voxelcore').ShownScan} scan
   * @param {{nameOf: (label: number) => string, colorOf: (label: number) => number[], isAnatomical: boolean}} about
   *   colours are 0 to 1
   */
  show(scan, about) {
    this.scan = scan;
    this.about = about;
    this.cuts = [];
    this.space = axesOfSpace(scan.axes);
    this.inverse = inverseOf(scan.axes);
    this.colors = new Uint32Array(256); // as ImageData has them on machines of today
    for (let code = 0; code < 256; ++code) {
      let color = [code, code, code];
      if (scan.labels && code > 0) {
        const label = scan.labels[code - 1];
        color =
          scan.labels.length === 1 || label === undefined
            ? [130, 130, 130]
            : about.colorOf(label).map((part) => Math.round(200 * part));
      }
      this.colors[code] = (0xff << 24) | (color[2] << 16) | (color[1] << 8) | color[0];
    }
    this.at = this.#middle();
    for (const { across, slider } of this.planes) slider.max = scan.size[this.space[across].axis] - 1;
    this.section.hidden = false;
    this.section.querySelector('#planes').hidden = false;
    this.#moved();
  }

  /** The place in a label that is nearest to the middle of all, so that the first slices show something. */
  #middle() {
    const { size, values, labels } = this.scan;
    const middle = size.map((side) => side >> 1);
    if (!labels) return middle;
    const at = (i) => [i % size[0], Math.floor(i / size[0]) % size[1], Math.floor(i / (size[0] * size[1]))];
    const every = Math.max(1, Math.floor(values.length / 4e6)) | 1; // odd, so that not the same columns are looked at
    const sum = [0, 0, 0];
    let count = 0;
    for (let i = 0; i < values.length; i += every) {
      if (values[i] === 0) continue;
      at(i).forEach((value, k) => (sum[k] += value));
      ++count;
    }
    let [nearest, least] = [middle, Infinity];
    for (let i = 0; i < values.length; i += every) {
      if (values[i] === 0) continue;
      const place = at(i);
      const far = place.reduce((all, value, k) => all + (value - sum[k] / count) ** 2, 0);
      if (far < least) [nearest, least] = [place, far];
    }
    return nearest;
  }

  /** The result: [{kind, mesh}]. */
  outline(meshes) {
    if (!this.scan) return;
    this.cuts = meshes.map(({ kind, mesh }) => ({
      kind,
      points: this.#inVoxels(mesh.points),
      cells: { polys: mesh.polys, lines: freeLines(mesh) },
    }));
    this.#say();
    this.#draw();
  }

  #inVoxels(points) {
    const found = new Float32Array(points.length);
    const { origin } = this.scan;
    for (let i = 0; i < points.length; i += 3) {
      const [x, y, z] = [points[i] - origin[0], points[i + 1] - origin[1], points[i + 2] - origin[2]];
      for (let k = 0; k < 3; ++k) {
        const row = this.inverse[k];
        found[i + k] = row[0] * x + row[1] * y + row[2] * z;
      }
    }
    return found;
  }

  /** Shows the slices through a place of the scan's space. */
  goTo(place) {
    if (!this.scan) return;
    const voxel = this.#inVoxels(Float64Array.from(place));
    this.at = Array.from(voxel, (value, k) => Math.min(Math.max(Math.round(value), 0), this.scan.size[k] - 1));
    this.#moved();
  }

  place() {
    const { origin, axes } = this.scan;
    return origin.map((from, k) => axes.reduce((sum, way, axis) => sum + way[k] * this.at[axis], from));
  }

  #moved() {
    this.#say();
    this.#draw();
    this.onPlace(this.place());
  }

  #say() {
    const { size, step, values, labels, window: shown, unit } = this.scan;
    const code = values[this.at[0] + size[0] * (this.at[1] + size[1] * this.at[2])];
    const place = this.place();
    const number = (value) => value.toLocaleString('en', { maximumSignificantDigits: 5 });
    let what = 'background';
    if (shown) {
      what = `value about ${number(shown[0] + (code / 255) * (shown[1] - shown[0]))}`;
    } else if (code > 0) {
      what = labels.length > 255 ? 'a label' : this.about.nameOf(labels[code - 1]);
    }
    const words = [
      `${this.about.isAnatomical ? 'LPS' : 'x, y, z'} ${place.map(number).join(', ')} ${unit}: ${what}.`,
      ...(step > 1 ? [`Of the scan every ${step}th voxel along each side is shown.`] : []),
      ...(this.cuts.some(({ kind }) => kind === 'medial') ? ['White: the medial surface.'] : []),
      ...(this.cuts.some(({ kind }) => kind === 'curves') ? ['Yellow: the curve skeleton.'] : []),
    ];
    this.says.textContent = words.join(' ');
    for (const { across, slider } of this.planes) {
      slider.value = this.at[this.space[across].axis];
      slider.setAttribute('aria-valuetext', `${kNames[across]} ${number(place[across])} ${unit}`);
    }
  }

  #draw() {
    if (!this.scan || this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      if (this.scan) for (const plane of this.planes) this.#drawPlane(plane);
    });
  }

  #drawPlane(plane) {
    const { scan, space, at } = this;
    const { across, canvas, sheet } = plane;
    // x to the right, or y across x; y downwards as patients lie, z upwards.
    const right = space[across === 0 ? 1 : 0];
    const down = across === 2 ? space[1] : { axis: space[2].axis, sign: -space[2].sign };
    const { axis } = space[across];
    const [wide, tall] = [scan.size[right.axis], scan.size[down.axis]];
    const strides = [1, scan.size[0], scan.size[0] * scan.size[1]];
    if (sheet.width !== wide || sheet.height !== tall) Object.assign(sheet, { width: wide, height: tall });
    const pen = sheet.getContext('2d');
    const image = pen.createImageData(wide, tall);
    const pixels = new Uint32Array(image.data.buffer);
    const walk = ({ axis: along, sign }, side) => ({
      from: sign > 0 ? 0 : (side - 1) * strides[along],
      by: sign * strides[along],
    });
    const [x, y] = [walk(right, wide), walk(down, tall)];
    for (let v = 0, to = 0; v < tall; ++v) {
      let from = at[axis] * strides[axis] + y.from + v * y.by + x.from;
      for (let u = 0; u < wide; ++u, from += x.by) pixels[to++] = this.colors[scan.values[from]];
    }
    pen.putImageData(image, 0, 0);

    // Onto the screen, in true proportions.
    const side = (way) => Math.hypot(...scan.axes[way.axis]);
    const box = canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio;
    canvas.width = Math.round(box.width * ratio);
    canvas.height = Math.round(box.height * ratio);
    const scale = Math.min(box.width / (wide * side(right)), box.height / (tall * side(down)));
    const [perU, perV] = [scale * side(right), scale * side(down)];
    const [left, top] = [(box.width - wide * perU) / 2, (box.height - tall * perV) / 2];
    const ink = canvas.getContext('2d');
    ink.setTransform(ratio, 0, 0, ratio, 0, 0);
    ink.fillStyle = '#000';
    ink.fillRect(0, 0, box.width, box.height);
    ink.imageSmoothingEnabled = !scan.labels;
    ink.drawImage(sheet, left, top, wide * perU, tall * perV);
    const onScreen = (way, count, start, per) => (voxel) =>
      start + ((way.sign > 0 ? voxel[way.axis] : count - 1 - voxel[way.axis]) + 0.5) * per;
    const [screenX, screenY] = [onScreen(right, wide, left, perU), onScreen(down, tall, top, perV)];
    plane.toVoxel = (px, py) => {
      const [u, v] = [(px - left) / perU - 0.5, (py - top) / perV - 0.5];
      return [
        [right.axis, right.sign > 0 ? u : wide - 1 - u],
        [down.axis, down.sign > 0 ? v : tall - 1 - v],
      ];
    };

    ink.lineCap = 'round';
    for (const { kind, points, cells } of this.cuts) {
      const path = new Path2D();
      for (const [a, b] of cut(points, cells, axis, at[axis])) {
        path.moveTo(screenX(a), screenY(a));
        path.lineTo(screenX(b), screenY(b));
      }
      const width = kind === 'curves' ? 3 : 1.5;
      for (const [color, more] of [
        ['rgba(0, 0, 0, 0.6)', 2],
        [kind === 'curves' ? '#ffd21a' : '#fff', 0],
      ]) {
        ink.strokeStyle = color;
        ink.lineWidth = width + more;
        ink.stroke(path);
      }
    }

    // The place, and which way is which.
    ink.strokeStyle = 'rgba(0, 190, 230, 0.7)';
    ink.lineWidth = 1;
    ink.beginPath();
    ink.moveTo(screenX(at), 0);
    ink.lineTo(screenX(at), box.height);
    ink.moveTo(0, screenY(at));
    ink.lineTo(box.width, screenY(at));
    ink.stroke();
    const ends = (space3) => (this.about.isAnatomical ? kEnds[space3] : [`−${kNames[space3]}`, `+${kNames[space3]}`]);
    const [horizontal, vertical] = [ends(across === 0 ? 1 : 0), ends(across === 2 ? 1 : 2)];
    const [upper, lower] = across === 2 ? vertical : [vertical[1], vertical[0]];
    ink.font = '600 12px system-ui, sans-serif';
    ink.textBaseline = 'middle';
    for (const [text, px, py, align] of [
      [horizontal[0], 6, box.height / 2, 'left'],
      [horizontal[1], box.width - 6, box.height / 2, 'right'],
      [upper, box.width / 2, 10, 'center'],
      [lower, box.width / 2, box.height - 10, 'center'],
    ]) {
      ink.textAlign = align;
      ink.strokeStyle = '#000';
      ink.lineWidth = 3;
      ink.strokeText(text, px, py);
      ink.fillStyle = '#fff';
      ink.fillText(text, px, py);
    }
  }
}
