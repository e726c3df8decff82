// What is written over the picture: colour bar, scale bar, directions. The same on the screen and in a saved picture.
/* global Page */
if (Page) Page.overlay = (function () {
  'use strict';
  const { model, names, unitFor, unitOf, roundDown, digits, mapColor } = Page;
  const font = size => size + 'px system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif';

  function colorBar(pen, scene, ink, soft) {
    const { width, height, coloring } = scene, { name, low, high, note, below, above, own } = coloring;
    const long = Math.round(width < 640 ? Math.min(130, 0.2 * height) : Math.min(220, 0.32 * height)), x = width - 92, y = 58, wide = 14;
    const unit = unitOf(name, Math.max(Math.abs(low), Math.abs(high)));
    pen.textAlign = 'left';
    pen.textBaseline = 'middle';
    pen.fillStyle = ink;
    pen.font = '600 ' + font(13);
    pen.textAlign = 'right';
    pen.fillText(names[name] + (own || !unit.name ? '' : ' (' + unit.name + ')'), width - 14, 20);
    pen.font = font(11);
    pen.fillStyle = soft;
    pen.fillText(note, width - 14, 37);
    pen.textAlign = 'left';
    for (let i = 0; i < long; ++i) {
      pen.fillStyle = 'rgb(' + mapColor(1 - (i + 0.5) / long).map(Math.round).join(',') + ')';
      pen.fillRect(x, y + i, wide, 1.5);
    }
    for (const [there, tip, side] of [[above, y - 8, y - 1], [below, y + long + 8, y + long + 1]]) { // values beyond the bar
      if (!there) continue;
      pen.fillStyle = 'rgb(' + mapColor(there === above && tip < y ? 1 : 0).map(Math.round).join(',') + ')';
      pen.beginPath();
      pen.moveTo(x, side);
      pen.lineTo(x + wide / 2, tip);
      pen.lineTo(x + wide, side);
      pen.fill();
    }
    pen.font = font(12);
    pen.fillStyle = ink;
    const tick = (at, words) => {
      pen.fillRect(x + wide, Math.round(at), 4, 1);
      pen.fillText(words, x + wide + 8, at + 0.5);
    };
    if (own) {
      tick(y, 'high');
      tick(y + long, 'low');
      return;
    }
    const a = low / unit.size, b = high / unit.size;
    if (!(b > a)) {
      tick(y + long / 2, digits(a));
      return;
    }
    const step = roundDown((b - a) / 4 * 1.3);
    for (let k = Math.ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k) {
      tick(y + long * (1 - (k * step - a) / (b - a)), digits(k * step));
    }
  }

  // The names of up to a dozen labels, where they are what colours mean.
  function legend(pen, scene, ink) {
    const shown = model.labels.filter(label => label.visible);
    if (shown.length > 12 || scene.width < 500) return;
    pen.font = font(12);
    pen.textAlign = 'right';
    pen.textBaseline = 'middle';
    shown.forEach((label, i) => {
      const y = 22 + 20 * i;
      pen.fillStyle = ink;
      pen.fillText(label.name.length > 32 ? label.name.substr(0, 31) + '…' : label.name, scene.width - 34, y);
      pen.fillStyle = 'rgb(' + label.color.map(v => Math.round(255 * v)).join(',') + ')';
      pen.fillRect(scene.width - 26, y - 6, 12, 12);
    });
  }

  // Parallel projection: the bar holds everywhere in the picture.
  function scaleBar(pen, scene, ink) {
    const length = roundDown(scene.mmPerPixel * Math.min(180, 0.36 * scene.width));
    const unit = unitFor(length), long = length / scene.mmPerPixel, x = 20, y = scene.height - 20;
    pen.fillStyle = ink;
    pen.fillRect(x, y - 1, long, 3);
    pen.fillRect(x, y - 5, 1.5, 11);
    pen.fillRect(x + long - 1.5, y - 5, 1.5, 11);
    pen.font = font(13);
    pen.textAlign = 'left';
    pen.textBaseline = 'alphabetic';
    const words = digits(length / unit.size) + ' ' + unit.name;
    pen.fillText(words, x, y - 9);
    return { words, pixels: long, length };
  }

  // Axes x, y, z as they point in the picture: letters of the patient where the scan names a space, else of the axes.
  function directions(pen, scene, ink, soft) {
    const x = 58, y = scene.height - 112, arm = 26;
    const ends = [];
    scene.axes.forEach(([right, up, near], axis) => {
      ends.push([right, up, near, model.anatomical ? 'LPS'[axis] : 'xyz'[axis], axis]);
      ends.push([-right, -up, -near, model.anatomical ? 'RAI'[axis] : '', axis]);
    });
    const placed = []; // the letters of an axis lie as far from the centre as they must, so that none overprints another
    const distances = scene.axes.map(([right, up]) => {
      const long = Math.hypot(right, up);
      if (long <= 0.3) return 0;
      let far = arm * long + 9;
      const place = () => [far * right / long, far * up / long];
      while (placed.some(([a, b]) => Math.min(Math.hypot(place()[0] - a, place()[1] - b), Math.hypot(place()[0] + a, place()[1] + b)) < 13)) far += 2;
      placed.push(place());
      return far;
    });
    ends.sort((one, other) => one[2] - other[2]);
    pen.font = '600 ' + font(13);
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    for (const [right, up, near, letter, axis] of ends) {
      pen.strokeStyle = pen.fillStyle = near > -0.15 ? ink : soft;
      pen.globalAlpha = near > -0.15 ? 1 : 0.65;
      pen.lineWidth = letter ? 1.6 : 0.8;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + arm * right, y - arm * up);
      pen.stroke();
      const away = distances[axis] / Math.hypot(right, up);
      if (distances[axis] > 0) pen.fillText(letter, x + away * right, y - away * up);
    }
    pen.globalAlpha = 1;
  }

  // Gives the scale bar it drew.
  function draw(pen, scene) {
    const ink = scene.dark ? '#eceff2' : '#1d2126', soft = scene.dark ? '#a3abb4' : '#5d6670';
    if (scene.coloring.name in model.ranges) colorBar(pen, scene, ink, soft);
    else if (scene.coloring.name === 'Label') legend(pen, scene, ink);
    directions(pen, scene, ink, soft);
    return scaleBar(pen, scene, ink);
  }
  return { draw };
})();
