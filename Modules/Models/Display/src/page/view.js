// The view: a camera of parallel projection, turned by mouse, touch and keys; colours; what is under the pointer; PNG.
/* global THREE, Page */
if (Page) Page.view = (function () {
  'use strict';
  const { $, model, meshes, names, unitOf, valueText, mapColor, branchColor } = Page;
  const canvas = $('view'), stage = $('stage');
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  } catch (error) {
    window.pageFailed('This page cannot be shown: the browser gives no 3-D graphics (WebGL). Allow hardware acceleration in ' +
      'its settings, or open the page in another browser.');
    return null;
  }
  canvas.addEventListener('webglcontextlost', () =>
    window.pageFailed('This page cannot be shown any longer: the browser took its 3-D graphics (WebGL) away. Open it again.'));

  const scene = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  const target = new THREE.Vector3(), size = meshes.size, away = 10 * size;
  meshes.build(scene);
  const parts = meshes.parts;
  const state = { width: 1, height: 1, mmPerPixel: 1, dark: false, moved: false, coloring: model.ranges.Thickness ? 'Thickness' : 'Radius', range: null, chosen: null,
    opacity: { surface: 0.35, medial: 1, curves: 1 }, shown: { surface: true, medial: true, curves: true },
    marked: null, covered: { left: 0, bottom: 0 } }; // a branch in a colour of its own, { label, line, color }; pixels that something hides

  // ---- colours ----
  const chosenRange = () => state.range || (model.ownRanges.includes(state.coloring) ? 'label' : 'middle'); // until one is chosen
  const rangeOf = label => {
    const range = model.ranges[state.coloring], own = label.ranges[state.coloring];
    if (chosenRange() === 'full') return [range.least, range.greatest];
    if (chosenRange() === 'label' && own) return [own.low, own.high];
    return [range.low, range.high];
  };
  const ranged = () => state.coloring in model.ranges;
  const named = model.labels.filter(label => label.curves && label.curves.names);
  named.reduce((first, label) => { label.firstBranch = first; return first + label.curves.names.length; }, 0);
  function paint() {
    for (const part of parts) {
      const { label, kind, valuesAt, branchAt, lineAt } = part.userData, colors = part.geometry.attributes.color.array;
      const byLabel = state.coloring === 'Label', values = ranged() ? valuesAt(state.coloring) : null;
      const plain = byLabel ? label.color.map(c => 255 * c) : kind !== 'surface' ? [150, 150, 150]
        : state.dark ? [206, 214, 226] : [122, 133, 150];
      const [low, high] = !ranged() || kind === 'surface' ? [0, 0] : rangeOf(label), byBranch = state.coloring === 'Branch' && branchAt;
      const marked = lineAt && state.marked && state.marked.label === label ? state.marked : null;
      for (let i = 0; 3 * i < colors.length; ++i) {
        const value = values ? values[i] : NaN;
        const c = marked && lineAt[i] === marked.line ? marked.color : byBranch ? branchColor(label.firstBranch + branchAt[i]) : Number.isNaN(value) ? plain : mapColor(high > low ? (value - low) / (high - low) : 0.5);
        colors[3 * i] = c[0];
        colors[3 * i + 1] = c[1];
        colors[3 * i + 2] = c[2];
      }
      part.geometry.attributes.color.needsUpdate = true;
    }
    draw();
  }
  function coloringOfBar() {
    const name = state.coloring;
    if (!ranged()) return { name };
    const range = model.ranges[name], chosen = state.chosen && state.chosen.ranges[name];
    const own = chosenRange() === 'label' && !chosen;
    const [low, high] = rangeOf(chosen ? state.chosen : { ranges: {} });
    const least = chosen ? chosen.least : range.least, greatest = chosen ? chosen.greatest : range.greatest;
    const note = chosenRange() === 'full' ? 'all values' : own ? 'each label, 2nd–98th percentile' : '2nd–98th percentile';
    return { name, low, high, note, own, below: !own && least < low, above: !own && greatest > high };
  }

  // ---- what is visible ----
  function showParts() {
    for (const part of parts) {
      const { label, kind } = part.userData, faded = state.chosen && label !== state.chosen;
      const opacity = state.opacity[kind] * (faded ? 0.15 : 1), solid = opacity > 0.995;
      part.visible = label.visible && state.shown[kind];
      part.material.uniforms.opacity.value = opacity;
      part.material.transparent = !solid;
      part.material.depthWrite = solid || (kind !== 'surface' && !faded);
      if (kind === 'surface') {
        const { front } = part.userData;
        part.renderOrder = 2;
        front.renderOrder = 1;
        front.material.transparent = true; // drawn after all that is solid
        front.visible = part.visible && !solid && !faded;
      }
    }
    draw();
  }

  // ---- camera ----
  function place() {
    camera.position.set(0, 0, away).applyQuaternion(camera.quaternion).add(target);
    camera.right = state.width / 2 * state.mmPerPixel;
    camera.left = -camera.right;
    camera.top = state.height / 2 * state.mmPerPixel;
    camera.bottom = -camera.top;
    camera.near = 0;
    camera.far = 2 * away;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    draw();
  }
  const axis = k => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k);
  function turn(dx, dy) {
    const long = Math.hypot(dx, dy);
    if (!long) return;
    const angle = Math.PI * long / Math.min(state.width, state.height);
    camera.quaternion.multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(dy / long, dx / long, 0), -angle));
    state.moved = true;
    place();
  }
  function shift(dx, dy) {
    target.addScaledVector(axis(0), -dx * state.mmPerPixel).addScaledVector(axis(1), dy * state.mmPerPixel);
    state.moved = true;
    place();
  }
  // What is at (x, y), in pixels from the middle, stays there.
  function zoom(factor, x, y) {
    const next = Math.min(Math.max(state.mmPerPixel / factor, size / 1e6), size);
    const change = state.mmPerPixel - next;
    target.addScaledVector(axis(0), x * change).addScaledVector(axis(1), -y * change);
    state.mmPerPixel = next;
    state.moved = true;
    place();
  }
  // Frames what is visible, beside the colour bar and above the scale bar.
  function fit() {
    camera.updateMatrixWorld();
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity], axes = [0, 1, 2].map(axis);
    for (const part of parts) {
      if (!part.visible) continue;
      const at = part.geometry.attributes.position.array;
      for (let i = 0; i < at.length; i += 3) {
        for (let k = 0; k < 3; ++k) {
          const a = axes[k], along = at[i] * a.x + at[i + 1] * a.y + at[i + 2] * a.z;
          if (along < low[k]) low[k] = along;
          if (along > high[k]) high[k] = along;
        }
      }
    }
    if (low[0] > high[0]) return;
    const small = state.width < 640;
    const edge = { left: 24, right: small ? 24 : 116, top: 28, bottom: small ? 84 : 48 };
    if (small) edge.top = ranged() ? 72 : 64;
    edge.left = Math.max(edge.left, state.covered.left);
    edge.bottom = Math.max(edge.bottom, state.covered.bottom);
    const wide = Math.max(state.width - edge.left - edge.right, 40), tall = Math.max(state.height - edge.top - edge.bottom, 40);
    const needed = Math.max((high[0] - low[0]) / wide, (high[1] - low[1]) / tall);
    state.mmPerPixel = needed > 0 ? needed : size / Math.min(wide, tall);
    target.set(0, 0, 0);
    for (let k = 0; k < 3; ++k) target.addScaledVector(axes[k], (low[k] + high[k]) / 2);
    target.addScaledVector(axes[0], (edge.right - edge.left) / 2 * state.mmPerPixel);
    target.addScaledVector(axes[1], (edge.top - edge.bottom) / 2 * state.mmPerPixel);
    state.moved = false;
    place();
  }
  // Looks from `from` with `up` upwards, both in LPS.
  function lookFrom(from, up) {
    camera.quaternion.setFromRotationMatrix(new THREE.Matrix4().lookAt(new THREE.Vector3(...from), new THREE.Vector3(), new THREE.Vector3(...up)));
    place();
    fit();
  }
  function resize() {
    const box = stage.getBoundingClientRect();
    if (!(box.width > 0 && box.height > 0)) return;
    state.width = box.width;
    state.height = box.height;
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(box.width, box.height, false);
    $('overlay').width = Math.round(box.width * window.devicePixelRatio);
    $('overlay').height = Math.round(box.height * window.devicePixelRatio);
    place();
    if (!state.moved) fit();
    render();
  }

  // ---- drawing ----
  function overlayScene() {
    const inverse = camera.quaternion.clone().conjugate();
    return { width: state.width, height: state.height, mmPerPixel: state.mmPerPixel, dark: state.dark, coloring: coloringOfBar(),
      axes: [0, 1, 2].map(k => new THREE.Vector3(...model.axes.map(a => a[k])).applyQuaternion(inverse).toArray()) };
  }
  function renderModel() {
    renderer.setClearColor(state.dark ? 0x14171a : 0xffffff);
    renderer.render(scene, camera);
  }
  function render() {
    renderModel();
    const pen = $('overlay').getContext('2d'), ratio = window.devicePixelRatio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, state.width, state.height);
    const bar = Page.overlay.draw(pen, overlayScene());
    stage.dataset.scale = bar.words;
  }
  let asked = false;
  function draw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; render(); });
  }
  // The picture with all that is written over it, at least twice as fine as the screen; handed to `take` as a canvas.
  function picture() {
    const ratio = Math.max(2, window.devicePixelRatio), sheet = document.createElement('canvas');
    renderer.setPixelRatio(ratio);
    renderer.setSize(state.width, state.height, false);
    for (const part of parts) part.material.uniforms.pixels.value = meshes.dotPixels * ratio;
    renderModel();
    sheet.width = canvas.width;
    sheet.height = canvas.height;
    const pen = sheet.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    Page.overlay.draw(pen, overlayScene());
    for (const part of parts) part.material.uniforms.pixels.value = meshes.dotPixels * window.devicePixelRatio;
    resize();
    return sheet;
  }

  // ---- mouse, touch, keys ----
  const fingers = new Map();
  const middleOf = () => {
    const all = [...fingers.values()], n = all.length;
    const x = all.reduce((sum, f) => sum + f.x, 0) / n, y = all.reduce((sum, f) => sum + f.y, 0) / n;
    return { x, y, spread: n > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
  };
  const fromMiddle = (x, y) => {
    const box = canvas.getBoundingClientRect();
    return [x - box.left - box.width / 2, y - box.top - box.height / 2];
  };
  let pressed = null;
  const taps = []; // are told of clicks and taps
  canvas.addEventListener('pointerdown', event => {
    try { canvas.setPointerCapture(event.pointerId); } catch (error) { /* a pointer that is gone already */ }
    canvas.focus({ preventScroll: true });
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    pressed = fingers.size === 1 ? { x: event.clientX, y: event.clientY } : null;
  });
  canvas.addEventListener('pointermove', event => {
    if (!fingers.has(event.pointerId)) {
      if (event.pointerType !== 'touch') lookSoon(event.clientX, event.clientY);
      return;
    }
    const before = middleOf();
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const now = middleOf(), dx = now.x - before.x, dy = now.y - before.y;
    if (pressed && Math.hypot(now.x - pressed.x, now.y - pressed.y) > 5) pressed = null;
    if (fingers.size > 1) {
      shift(dx, dy);
      if (before.spread > 0 && now.spread > 0) zoom(now.spread / before.spread, ...fromMiddle(now.x, now.y));
    } else if (event.shiftKey || (event.buttons & 6)) shift(dx, dy);
    else turn(dx, dy);
  });
  for (const name of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(name, event => {
      fingers.delete(event.pointerId);
      if (pressed && name === 'pointerup') {
        lookSoon(event.clientX, event.clientY);
        if (event.button === 0) for (const tap of taps) tap(event.clientX, event.clientY, event.pointerType === 'touch');
      }
      pressed = null;
    });
  }
  canvas.addEventListener('pointerleave', event => { if (event.pointerType === 'mouse') $('under').hidden = true; });
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    zoom(Math.exp(-Math.max(-120, Math.min(120, event.deltaY * lines)) / 400), ...fromMiddle(event.clientX, event.clientY));
  }, { passive: false });
  const keys = { ArrowLeft: () => turn(-30, 0), ArrowRight: () => turn(30, 0), ArrowUp: () => turn(0, -30), ArrowDown: () => turn(0, 30),
    '+': () => zoom(1.2, 0, 0), '=': () => zoom(1.2, 0, 0), '-': () => zoom(1 / 1.2, 0, 0), f: fit, F: fit };
  canvas.addEventListener('keydown', event => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });

  // ---- under the pointer ----
  const ray = new THREE.Raycaster();
  let spot = null;
  function lookSoon(x, y) {
    if (!spot) setTimeout(() => { const [a, b] = spot; spot = null; look(a, b); }, 30);
    spot = [x, y];
  }
  // What is seen at a place of the window, of the parts that are wanted.
  function hitAt(x, y, isWanted = () => true) {
    const [right, down] = fromMiddle(x, y);
    ray.params.Points.threshold = 6 * state.mmPerPixel;
    ray.linePrecision = 4 * state.mmPerPixel;
    ray.setFromCamera(new THREE.Vector2(2 * right / state.width, -2 * down / state.height), camera);
    const hits = ray.intersectObjects(parts.filter(part =>
      part.visible && isWanted(part) && (!state.chosen || part.userData.label === state.chosen)));
    return hits.find(h => h.object.userData.kind !== 'surface') || hits[0];
  }
  function cornerOf(hit) {
    const { attributes, index } = hit.object.geometry;
    const corners = hit.face ? [hit.face.a, hit.face.b, hit.face.c] : hit.object.isPoints ? [hit.index] : [index.array[hit.index]];
    const distance = corners.map(i => new THREE.Vector3().fromBufferAttribute(attributes.position, i).distanceTo(hit.point));
    return corners[distance.indexOf(Math.min(...distance))];
  }
  // Of the point at `at` in an array, in pixels from the middle.
  function pixelsOf(array, at) {
    const { x, y } = new THREE.Vector3().fromArray(array, at).project(camera);
    return [x * state.width / 2, -y * state.height / 2];
  }
  function placeText(shown) {
    const digits = Math.max(1, Math.ceil(2 - Math.log10(size)));
    const at = [0, 1, 2].map(k => model.axes.reduce((sum, a, i) => sum + a[k] * shown[i], 0));
    const place = at.map(v => v.toFixed(Math.min(digits, 12))).join(', ');
    return (model.anatomical ? 'LPS ' : 'x, y, z ') + place + ' ' + model.units[0].name;
  }
  function look(x, y) {
    const hit = hitAt(x, y), box = $('under');
    box.hidden = !hit;
    if (!hit) return;
    const { label, kind, valuesAt, branchAt } = hit.object.userData, nearest = cornerOf(hit);
    const lines = [label.name + (model.groups ? '' : ' (' + label.label + ')')];
    if (branchAt) lines.push(label.curves.names[branchAt[nearest]]);
    for (const name of Object.keys(model.ranges)) {
      const values = kind === 'surface' ? null : valuesAt(name);
      if (values && !Number.isNaN(values[nearest])) lines.push(names[name] + ' ' + valueText(values[nearest], unitOf(name, values[nearest])));
    }
    lines.push(placeText(hit.point.toArray().map((v, k) => v + meshes.middle[k])));
    box.textContent = '';
    for (const line of lines) {
      const row = document.createElement('div');
      row.textContent = line;
      box.append(row);
    }
  }

  new ResizeObserver(resize).observe(stage);
  return { state, scene, parts, named, ranged, chosenRange, paint, showParts, fit, lookFrom, resize, draw, picture, taps, hitAt, cornerOf, pixelsOf, fromMiddle, placeText,
    sight: () => axis(2).negate(), canvas };
})();
