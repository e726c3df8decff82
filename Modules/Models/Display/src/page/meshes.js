// What is drawn: a few objects a label.
/* global THREE, Page */
if (Page) Page.meshes = (function () {
  'use strict';
  const { model, numbers, places, valuesOf } = Page;

  // Mostly the colour itself, a little darker where a face turns away, so that colours are those of the colour bar. GLASS
  // is a surface seen by its outline, SMOOTH has normals, DOT is a point.
  const vertexShader = `
    attribute vec3 color;
    uniform float pixels;
    varying vec3 vColor, vPlace, vNormal;
    void main() {
      vColor = color;
      #ifdef SMOOTH
        vNormal = normalMatrix * normal;
      #endif
      vec4 place = modelViewMatrix * vec4(position, 1.0);
      vPlace = place.xyz;
      gl_Position = projectionMatrix * place;
      gl_PointSize = pixels;
    }`;
  const fragmentShader = `
    uniform float opacity;
    varying vec3 vColor, vPlace, vNormal;
    void main() {
      float shade = 1.0, alpha = opacity;
      #ifdef DOT
        if (length(gl_PointCoord - 0.5) > 0.5) discard;
      #else
        #ifdef SMOOTH
          vec3 n = normalize(vNormal);
        #else
          vec3 n = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
        #endif
        #ifndef LINE
          shade = 0.68 + 0.32 * abs(dot(n, vec3(0.206, 0.310, 0.928)));
        #endif
        #ifdef GLASS
          float rim = 1.0 - abs(n.z);
          if (alpha < 0.995) alpha *= 0.25 + 0.75 * rim * rim;
        #endif
      #endif
      gl_FragColor = vec4(vColor * shade, alpha);
    }`;
  const dotPixels = 7;
  function material(defines) {
    const made = new THREE.ShaderMaterial({ vertexShader, fragmentShader, defines, side: THREE.DoubleSide,
      uniforms: { opacity: { value: 1 }, pixels: { value: dotPixels * window.devicePixelRatio } } });
    made.extensions.derivatives = true;
    return made;
  }

  function shape(points, index) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Uint8Array(points.length), 3, true));
    if (index) geometry.setIndex(new THREE.BufferAttribute(index, 1));
    return geometry;
  }

  // Tubes around poly lines; per corner the point, the line it belongs to and the point's place among those of all lines.
  function tubes(mesh, points, radius, least) {
    const sides = 10, at = [], owner = [], branch = [], entry = [], index = [];
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
        const first = at.length / 3, r = Math.max(radius ? 0.35 * radius[lines[k]] : 0, least);
        for (let s = 0; s < sides; ++s) {
          const angle = 2 * Math.PI * s / sides;
          const p = here.clone().addScaledVector(normal, r * Math.cos(angle)).addScaledVector(other, r * Math.sin(angle));
          at.push(p.x, p.y, p.z);
          owner.push(lines[k]);
          branch.push(l);
          entry.push(k);
          if (k > offsets[l]) {
            const t = (s + 1) % sides;
            index.push(first + s - sides, first + t - sides, first + s, first + s, first + t - sides, first + t);
          }
        }
      }
    }
    return { points: Float32Array.from(at), owner: Uint32Array.from(owner), branch: Uint32Array.from(branch), entry: Uint32Array.from(entry), index: Uint32Array.from(index) };
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
  if (whole.isEmpty()) whole.expandByPoint(new THREE.Vector3());
  const middle = whole.getCenter(new THREE.Vector3()).toArray();
  let size = whole.getSize(new THREE.Vector3()).length();
  if (!(size > 0)) { // a single point: its ball
    const radius = model.ranges.Radius ? model.ranges.Radius.high : 0;
    size = radius > 0 ? 2 * radius : 1;
  }

  // kind; object; valuesAt(name): a number a corner, or null; of curves lineAt and entryAt: the line of each corner, and its
  // point's place among those of all lines; branchAt: lineAt of curves with names
  const parts = [];
  function add(scene, label, kind, object, valuesAt) {
    object.userData = { label, kind, valuesAt };
    scene.add(object);
    parts.push(object);
  }
  function build(scene) {
    for (const label of model.labels) {
      if (label.surface) {
        const geometry = shape(places(label.surface, middle), numbers(label.surface.triangles));
        geometry.computeVertexNormals();
        const glass = new THREE.Mesh(geometry, material({ GLASS: 1, SMOOTH: 1 })), front = new THREE.Mesh(geometry, material({ SMOOTH: 1 }));
        add(scene, label, 'surface', glass, () => null);
        // Of surfaces one behind the other only the first is seen, lest they add up to a fog: its depth goes before its colour.
        front.material.colorWrite = false;
        glass.userData.front = front;
        scene.add(front);
      }
      for (const kind of ['medial', 'curves']) {
        const mesh = label[kind];
        if (!mesh) continue;
        const points = places(mesh, middle), valuesAt = name => valuesOf(mesh, name);
        if (mesh.triangles[1]) add(scene, label, kind, new THREE.Mesh(shape(points, numbers(mesh.triangles)), material({})), valuesAt);
        if (mesh.dots[1]) add(scene, label, kind, new THREE.Points(shape(points, numbers(mesh.dots)), material({ DOT: 1 })), valuesAt);
        if (mesh.segments[1]) {
          add(scene, label, kind, new THREE.LineSegments(shape(points, numbers(mesh.segments)), material({ LINE: 1 })), valuesAt);
        }
        if (mesh.lines[1]) {
          const tube = tubes(mesh, points, valuesOf(mesh, 'Radius'), size / 1500);
          const geometry = shape(tube.points, tube.index);
          geometry.computeVertexNormals();
          add(scene, label, kind, new THREE.Mesh(geometry, material({ SMOOTH: 1 })), name => {
            const values = valuesOf(mesh, name);
            return values && Float32Array.from(tube.owner, i => values[i]);
          });
          Object.assign(parts[parts.length - 1].userData, { lineAt: tube.branch, entryAt: tube.entry, branchAt: mesh.names && tube.branch });
        }
      }
    }
  }

  return { build, parts, middle, size, dotPixels, shape, material };
})();
