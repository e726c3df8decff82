// Behind the scripts of the offline page: the place that the slices beside it show, and taps that choose another.
/* global THREE, Page */
if (Page && Page.view && window.parent !== window)
  (function () {
    'use strict';
    const { meshes, view } = Page;
    const scene = view.parts.length > 0 && view.parts[0].parent;
    if (!scene) return;
    const half = meshes.size;
    const cross = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: 0x00a2c7, transparent: true, opacity: 0.8 }),
    );
    const corners = [0, 1, 2].flatMap((k) => [-half, half].flatMap((at) => [0, 1, 2].map((i) => (i === k ? at : 0))));
    cross.geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(corners), 3));
    cross.visible = false;
    scene.add(cross);

    let pressed = null;
    view.canvas.addEventListener('pointerdown', ({ clientX, clientY }) => {
      pressed = [clientX, clientY];
    });
    view.canvas.addEventListener('pointerup', ({ clientX, clientY }) => {
      if (!pressed || Math.hypot(clientX - pressed[0], clientY - pressed[1]) > 5) return; // it was turned
      const hit = view.hitAt(clientX, clientY);
      if (!hit) return;
      const place = hit.point.toArray().map((at, k) => at + meshes.middle[k]);
      window.parent.postMessage({ place }, '*'); // a page from disk has no origin
    });
    window.addEventListener('message', ({ source, data }) => {
      if (source !== window.parent || !Array.isArray(data.place)) return;
      cross.position.set(...data.place.map((at, k) => at - meshes.middle[k]));
      cross.visible = true;
      view.draw();
    });
    window.parent.postMessage({ ready: true }, '*');
  })();
