// Shows the labels of a page: what stands in its elements "model" (JSON) and "data" (numbers, base64).
/* global THREE */
(function () {
  'use strict';

  const $ = id => document.getElementById(id);
  const damaged = 'This page cannot be shown: its data are damaged. Copy the file again, or make it anew with voxelcore.';
  let model, bytes;
  try {
    model = JSON.parse($('model').textContent);
    bytes = decode($('data').textContent).buffer;
  } catch (error) {
    window.pageFailed(damaged);
    return;
  }
  if (bytes.byteLength !== model.bytes || adler32(new Uint8Array(bytes)) !== model.adler32) {
    window.pageFailed(damaged);
    return;
  }
  function decode(text) {
    const letters = atob(text), result = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) result[i] = letters.charCodeAt(i);
    return result;
  }
  function adler32(data) {
    let a = 1, b = 0;
    for (let i = 0; i < data.length; ++i) {
      a = (a + data[i]) % 65521;
      b = (b + a) % 65521;
    }
    return (b * 65536 + a);
  }
  const numbers = ([at, count, size]) =>
    size === 2 ? new Uint16Array(bytes, at, count) : new Uint32Array(bytes, at, count);
  const units = { Radius: 'Radius (mm)', Lambda: 'Lambda (mm)', ErosionThickness: 'Erosion thickness (mm)', Label: 'Label' };

  // viridis, by the polynomial M. Zucker fitted to it (CC0)
  const viridis = (function () {
    const c = [[0.2777273272, 0.0054073445, 0.3340998053], [0.1050930431, 1.4046135299, 1.3845901626],
      [-0.3308618287, 0.2148475595, 0.0950951630], [-4.6342304990, -5.7991009734, -19.3324409563],
      [6.2282699363, 14.1799333668, 56.6905526007], [4.7763849977, -13.7451453777, -65.3530326334],
      [-5.4354558559, 4.6458526122, 26.3124352496]];
    return t => [0, 1, 2].map(k => Math.min(1, Math.max(0, c.reduceRight((sum, row) => sum * t + row[k], 0))));
  })();

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: $('view'), antialias: true });
  } catch (error) {
    window.pageFailed('This page cannot be shown: the browser gives no 3-D graphics (WebGL). Allow hardware acceleration in ' +
      'its settings, or open the page in another browser.');
    return;
  }
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setClearColor(0xffffff);
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 1e6);
  camera.up.set(0, 0, 1);
  const light = new THREE.DirectionalLight(0xffffff, 0.75);
  light.position.set(0.3, 0.5, 1);
  camera.add(light);
  scene.add(camera);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x999999, 0.45));

  // ---- meshes ----
  function places(mesh) {
    const codes = numbers(mesh.points);
    const points = new Float32Array(codes.length);
    for (let i = 0; i < codes.length; ++i) {
      const k = i % 3;
      points[i] = mesh.low[k] + (mesh.high[k] - mesh.low[k]) * codes[i] / 65535;
    }
    return points;
  }
  function valuesOf(mesh, name) {
    if (!mesh.values[name]) return null;
    const [low, high] = model.ranges[name];
    return Float32Array.from(numbers(mesh.values[name]), q => q === 65535 ? NaN : low + (high - low) * q / 65534);
  }
  function shape(points, index) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(points.length), 3));
    if (index) geometry.setIndex(new THREE.BufferAttribute(index, 1));
    return geometry;
  }

  // Tubes of half the radius around poly lines; per corner the point of the line it belongs to.
  function tubes(mesh, points, radius) {
    const sides = 8, at = [], owner = [], index = [];
    const lines = numbers(mesh.lines), offsets = numbers(mesh.offsets);
    const P = i => new THREE.Vector3(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    for (let l = 0; l + 1 < offsets.length; ++l) {
      let normal = null;
      for (let k = offsets[l]; k < offsets[l + 1]; ++k) {
        const here = P(lines[k]);
        const along = P(lines[Math.min(k + 1, offsets[l + 1] - 1)]).sub(P(lines[Math.max(k - 1, offsets[l])]));
        if (along.lengthSq() === 0) along.set(0, 0, 1);
        along.normalize();
        if (!normal) normal = Math.abs(along.z) < 0.9 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(1, 0, 0);
        normal = normal.clone().addScaledVector(along, -normal.dot(along)).normalize();
        const other = along.clone().cross(normal);
        const first = at.length / 3, r = Math.max(0.4 * radius[lines[k]], tubes.least);
        for (let s = 0; s < sides; ++s) {
          const angle = 2 * Math.PI * s / sides;
          const p = here.clone().addScaledVector(normal, r * Math.cos(angle)).addScaledVector(other, r * Math.sin(angle));
          at.push(p.x, p.y, p.z);
          owner.push(lines[k]);
          if (k > offsets[l]) {
            const t = (s + 1) % sides;
            index.push(first + s - sides, first + t - sides, first + s, first + s, first + t - sides, first + t);
          }
        }
      }
    }
    return { points: Float32Array.from(at), owner: Uint32Array.from(owner), index: Uint32Array.from(index) };
  }

  const whole = new THREE.Box3();
  for (const label of model.labels) {
    for (const kind of ['surface', 'medial', 'curves']) {
      if (label[kind]) {
        whole.expandByPoint(new THREE.Vector3(...label[kind].low));
        whole.expandByPoint(new THREE.Vector3(...label[kind].high));
      }
    }
  }
  const size = Math.max(whole.getSize(new THREE.Vector3()).length(), 1e-6);
  tubes.least = size / 1500;

  const parts = []; // { label, kind, object, values: name -> array per corner }
  function add(label, kind, object, valuesAt) {
    object.userData = { label, kind, valuesAt };
    scene.add(object);
    parts.push(object);
  }
  // Points by themselves, as large as a fingertip's worth of pixels at any distance.
  function addDots(label, kind, points) {
    if (!label[kind].dots[1]) return;
    add(label, kind, new THREE.Points(shape(points, numbers(label[kind].dots)), new THREE.PointsMaterial({
      vertexColors: THREE.VertexColors, size: 8 * window.devicePixelRatio, sizeAttenuation: false })),
    name => valuesOf(label[kind], name));
  }
  for (const label of model.labels) {
    const color = new THREE.Color(...label.color);
    label.visible = true;
    if (label.surface) {
      const geometry = shape(places(label.surface), numbers(label.surface.triangles));
      geometry.computeVertexNormals();
      const glass = new THREE.MeshPhongMaterial({ color, transparent: true, opacity: 0.16, depthWrite: false,
        side: THREE.DoubleSide, shininess: 5 });
      add(label, 'surface', new THREE.Mesh(geometry, glass), () => null);
    }
    if (label.medial) {
      const points = places(label.medial);
      const geometry = shape(points, numbers(label.medial.triangles));
      const valuesAt = name => valuesOf(label.medial, name);
      add(label, 'medial', new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors,
        side: THREE.DoubleSide, flatShading: true, shininess: 8 })), valuesAt);
      if (label.medial.lines[1]) {
        const lines = shape(points, numbers(label.medial.lines));
        add(label, 'medial', new THREE.LineSegments(lines,
          new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors })), valuesAt);
      }
      addDots(label, 'medial', points);
    }
    if (label.curves) {
      const points = places(label.curves);
      addDots(label, 'curves', points);
      if (label.curves.triangles[1]) {
        add(label, 'curves', new THREE.Mesh(shape(points, numbers(label.curves.triangles)),
          new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, side: THREE.DoubleSide, flatShading: true })),
        name => valuesOf(label.curves, name));
      }
      const tube = tubes(label.curves, points, valuesOf(label.curves, 'Radius'));
      const geometry = shape(tube.points, tube.index);
      geometry.computeVertexNormals();
      add(label, 'curves', new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors,
        side: THREE.DoubleSide, shininess: 20 })), name => {
        const values = valuesOf(label.curves, name);
        return values && Float32Array.from(tube.owner, i => values[i]);
      });
    }
  }

  // ---- colours ----
  const names = Object.keys(model.ranges).concat('Label');
  for (const name of names) $('coloring').add(new Option(name === 'ErosionThickness' ? 'Erosion thickness' : name, name));
  function paint() {
    const name = $('coloring').value;
    const range = model.ranges[name];
    for (const part of parts) {
      if (part.userData.kind === 'surface') continue;
      const values = range ? part.userData.valuesAt(name) : null;
      const colors = part.geometry.attributes.color;
      part.userData.values = values;
      for (let i = 0; i < colors.count; ++i) {
        const c = !range ? part.userData.label.color
          : !values || Number.isNaN(values[i]) ? [0.6, 0.6, 0.6]
          : viridis(range[1] > range[0] ? (values[i] - range[0]) / (range[1] - range[0]) : 0);
        colors.setXYZ(i, c[0], c[1], c[2]);
      }
      colors.needsUpdate = true;
    }
    $('scale').style.display = range ? '' : 'none';
    if (range) drawBar(name, range);
    draw();
  }
  function drawBar(name, [low, high]) {
    $('scaletitle').textContent = units[name];
    const pen = $('bar').getContext('2d');
    pen.clearRect(0, 0, 90, 220);
    for (let y = 0; y < 200; ++y) {
      const c = viridis(1 - y / 199).map(v => Math.round(255 * v));
      pen.fillStyle = 'rgb(' + c.join(',') + ')';
      pen.fillRect(0, 10 + y, 20, 1);
    }
    pen.fillStyle = '#222';
    pen.font = '13px sans-serif';
    pen.textBaseline = 'middle';
    const rough = (high - low) / 4 || 1, power = Math.pow(10, Math.floor(Math.log10(rough)));
    const step = [5, 2, 1].map(f => f * power).find(s => s <= rough * 1.0000001);
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
      const y = 210 - 200 * (high > low ? (k * step - low) / (high - low) : 0.5);
      pen.fillRect(20, y, 5, 1);
      pen.fillText(String(+(k * step).toPrecision(6)), 30, y);
    }
  }

  // ---- which labels, which kinds ----
  function showParts() {
    for (const part of parts) {
      part.visible = part.userData.label.visible && $(part.userData.kind).checked;
    }
    draw();
  }
  let chosen = null;
  function choose(label) {
    chosen = chosen === label ? null : label;
    for (const one of model.labels) one.nameElement.classList.toggle('chosen', one === chosen);
    for (const part of parts) {
      const away = chosen && part.userData.label !== chosen;
      if (part.userData.kind === 'surface') part.material.opacity = away ? 0.04 : chosen ? 0.3 : 0.16;
      else {
        part.material.transparent = !!away;
        part.material.opacity = away ? 0.12 : 1;
      }
      part.material.needsUpdate = true;
    }
    draw();
  }
  for (const label of model.labels) {
    const row = document.createElement('div');
    row.className = 'row';
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = true;
    box.addEventListener('change', () => { label.visible = box.checked; showParts(); });
    const swatch = document.createElement('span');
    swatch.className = 'swatch';
    swatch.style.background = 'rgb(' + label.color.map(v => Math.round(255 * v)).join(',') + ')';
    const name = document.createElement('span');
    name.className = 'name';
    name.textContent = label.name;
    name.title = label.name + ' (' + label.label + ')';
    name.addEventListener('click', () => choose(label));
    row.append(box, swatch, name);
    $('labels').append(row);
    label.box = box;
    label.nameElement = name;
  }
  for (const [id, state] of [['all', true], ['none', false]]) {
    $(id).addEventListener('click', () => {
      for (const label of model.labels) label.visible = label.box.checked = state;
      showParts();
    });
  }
  for (const kind of ['surface', 'medial', 'curves']) {
    $(kind).addEventListener('change', showParts);
    if (!model.labels.some(label => label[kind])) $(kind).parentElement.style.display = 'none';
  }

  // ---- view ----
  const controls = new THREE.TrackballControls(camera, $('view'));
  controls.rotateSpeed = 3;
  controls.zoomSpeed = 1.2;
  controls.staticMoving = true;
  function resetView() {
    controls.target.copy(whole.getCenter(new THREE.Vector3()));
    camera.up.set(0, 0, 1);
    const fit = Math.max(1, 1 / camera.aspect) * size / 2 / Math.tan(Math.PI / 180 * 15) * 0.95;
    camera.position.copy(controls.target).add(new THREE.Vector3(0.45, -1, 0.35).normalize().multiplyScalar(fit)); // LPS
    camera.near = size / 1000;
    camera.far = size * 20;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  }
  $('reset').addEventListener('click', resetView);
  let asked = false;
  function draw() {
    if (!asked) {
      asked = true;
      requestAnimationFrame(() => { asked = false; renderer.render(scene, camera); });
    }
  }
  function resize() {
    renderer.setSize(window.innerWidth, window.innerHeight, false);
    camera.aspect = window.innerWidth / window.innerHeight;
    camera.updateProjectionMatrix();
    controls.handleResize();
    draw();
  }
  window.addEventListener('resize', resize);
  controls.addEventListener('change', draw);
  (function turn() { requestAnimationFrame(turn); controls.update(); })();

  // ---- under the pointer ----
  const ray = new THREE.Raycaster();
  ray.linePrecision = size / 500;
  let pointer = null;
  function look() {
    const at = pointer;
    pointer = null;
    camera.updateMatrixWorld();
    ray.setFromCamera(new THREE.Vector2(2 * at.clientX / window.innerWidth - 1, 1 - 2 * at.clientY / window.innerHeight), camera);
    const hits = ray.intersectObjects(parts.filter(part => part.visible));
    const hit = hits.find(h => h.object.userData.kind !== 'surface') || hits[0];
    const box = $('under');
    if (!hit) {
      box.textContent = '';
      return;
    }
    const { label, kind, valuesAt } = hit.object.userData;
    const lines = [label.name + ' (' + label.label + ')'];
    const corners = hit.face ? [hit.face.a, hit.face.b, hit.face.c] : [hit.object.geometry.index.array[hit.index]];
    const places = hit.object.geometry.attributes.position;
    const distance = corners.map(i => new THREE.Vector3().fromBufferAttribute(places, i).distanceTo(hit.point));
    const nearest = corners[distance.indexOf(Math.min(...distance))];
    for (const name of Object.keys(model.ranges)) {
      const values = kind === 'surface' ? null : valuesAt(name);
      if (values && !Number.isNaN(values[nearest])) {
        lines.push(units[name].replace(' (mm)', ': ') + values[nearest].toPrecision(4) + ' mm');
      }
    }
    lines.push('LPS ' + hit.point.toArray().map(v => v.toFixed(1)).join(', '));
    box.innerHTML = '';
    for (const line of lines) {
      const row = document.createElement('div');
      row.textContent = line;
      box.append(row);
    }
  }
  $('view').addEventListener('mousemove', event => {
    if (!pointer && event.buttons === 0) setTimeout(look, 30);
    pointer = event.buttons === 0 ? event : pointer;
  });

  $('coloring').addEventListener('change', paint);
  $('title').textContent = document.title = model.title;
  $('about').textContent = (model.triangles < model.allTriangles
    ? 'Shown in ' + model.triangles + ' triangles of ' + model.allTriangles + '; files hold all of them. '
    : model.triangles + ' triangles. ') + 'Drag: turn; wheel: zoom; right button: move. VoxelCore, with three.js r' +
    THREE.REVISION + ' (MIT licence).';
  resize();
  resetView();
  paint();
  document.body.dataset.state = 'ready';
})();
