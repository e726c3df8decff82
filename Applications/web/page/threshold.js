// Behind the scripts of the offline page: sliders that hide what is below a tolerance or a radius.
/* global THREE, Page */
if (Page && Page.view)
  (function () {
    'use strict';
    const { $, model, numbers, view } = Page;
    const limits = { Tolerance: 0, Radius: 0 };
    const ofCode = (range, code) =>
      code === 65535 ? Infinity : range.least + ((range.greatest - range.least) * code) / 65534;

    // Per part its elements, `corners` indices each, and what each needs to be shown: at least these numbers. An edge
    // is drawn only where no face on it reaches the tolerance.
    const filters = [];
    for (const part of view.parts) {
      const { label, kind, valuesAt } = part.userData,
        mesh = label[kind];
      if (!mesh.heights || !part.geometry.index) continue;
      const corners = part.isMesh ? 3 : part.isLineSegments ? 2 : 1,
        which = ['', 'dots', 'segments', 'triangles'][corners];
      if (part.geometry.index.count !== mesh[which][1]) continue; // tubes of curves
      const range = model.ranges.Tolerance,
        index = part.geometry.index.array,
        radius = valuesAt('Radius');
      const heights = Float32Array.from(numbers(mesh.heights[which]), (code) => ofCode(range, code));
      const covers =
        corners === 2
          ? Float32Array.from(numbers(mesh.heights.covers), (code) =>
              code === 0 ? -Infinity : ofCode(range, code - 1),
            )
          : null;
      const least = Float32Array.from(heights, (_, e) => {
        let found = Infinity;
        for (let k = 0; k < corners; ++k) found = Math.min(found, radius ? radius[index[corners * e + k]] : Infinity);
        return found;
      });
      filters.push({ part, corners, index, heights, covers, least });
    }
    if (filters.length === 0) return;

    function apply() {
      const { Tolerance, Radius } = limits;
      for (const { part, corners, index, heights, covers, least } of filters) {
        const kept = new index.constructor(index.length);
        let count = 0;
        for (let e = 0; e < heights.length; ++e) {
          if (heights[e] < Tolerance || least[e] < Radius || (covers && covers[e] >= Tolerance)) continue;
          for (let k = 0; k < corners; ++k) kept[count++] = index[corners * e + k];
        }
        part.geometry.setIndex(new THREE.BufferAttribute(kept.subarray(0, count), 1));
      }
      view.draw();
    }

    const box = document.createElement('div');
    box.className = 'grid';
    box.id = 'thresholds';
    for (const name of Object.keys(limits)) {
      const range = model.ranges[name];
      if (!range || !(range.greatest > range.least)) continue;
      const label = document.createElement('label'),
        slider = document.createElement('input'),
        said = document.createElement('output');
      slider.type = 'range';
      slider.id = 'least-' + name.toLowerCase();
      slider.min = 0;
      slider.max = 1000;
      slider.value = 0;
      label.htmlFor = said.htmlFor = slider.id;
      label.textContent = name + ' at least';
      said.style.gridColumn = '2';
      // Tolerances have a few large values far from the rest: equal steps of the slider are equal factors.
      const byFactors = name === 'Tolerance' && range.least > 0,
        part = () => slider.value / 1000;
      const tell = () => {
        const value = byFactors
          ? range.least * Math.pow(range.greatest / range.least, part())
          : range.least + (range.greatest - range.least) * part();
        limits[name] = slider.value > 0 ? value : 0;
        said.textContent = Page.lengthText(value, 3);
        slider.setAttribute('aria-valuetext', said.textContent);
      };
      slider.addEventListener('input', () => {
        tell();
        apply();
      });
      tell();
      box.append(label, slider, said);
    }
    document.querySelector('.kinds').after(box);
    apply();
  })();
