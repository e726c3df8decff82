// Behind the scripts of the offline page: the place that the slices beside it show, taps that choose another, and edits
// that are done at once.
/* global THREE, Page */
if (Page && Page.view && window.parent !== window)
  (function () {
    'use strict';
    const { $, edits, meshes, view } = Page;
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

    let asked = false; // the slices' answer is the voxel of what was tapped here
    view.taps.push((x, y) => {
      const hit = view.hitAt(x, y);
      if (!hit) return;
      const place = hit.point.toArray().map((at, k) => at + meshes.middle[k]);
      asked = true;
      window.parent.postMessage({ place }, '*'); // a page from disk has no origin
    });
    window.addEventListener('message', ({ source, data }) => {
      if (source !== window.parent) return;
      if (data.edits) edits?.take(data.edits);
      if (!Array.isArray(data.place)) return;
      cross.position.set(...data.place.map((at, k) => at - meshes.middle[k]));
      cross.visible = true;
      view.draw();
      if (!asked && data.isChosen) edits?.spot(data.place);
      asked = false;
    });
    if (edits) {
      const apply = Object.assign(document.createElement('button'), { id: 'edit-apply', type: 'button' });
      apply.textContent = 'Apply now';
      apply.addEventListener('click', () => window.parent.postMessage({ apply: true }, '*'));
      $('edit-save').before(apply);
      $('edit-how').hidden = true;
      edits.changes.push((all) => window.parent.postMessage({ edits: all, table: edits.table() }, '*'));
    }
    window.parent.postMessage({ ready: true }, '*');
  })();
